//! The flow of an Instruction List: a block begins at each label. Blocks are checked in the order in which they are reached, so that the
//! type of the current result is known at a label before what stands behind it is looked at (language reference §6.3).
//!
//! A current result that crosses a label lives in a variable of that label, which every way to it assigns, if it is read there.

use super::{Cr, List};
use crate::hir::convert::{Flex, Operand};
use crate::hir::model::*;
use crate::syntax::ast::Name;
use crate::syntax::il::{Line, When};
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;

/// A block: lines between two labels.
pub(super) struct Block {
    /// First line and the one behind the last.
    pub lines: (usize, usize),
    pub label: Option<LabelId>,
    /// The label's place.
    pub span: Span,
    /// The current result at its start, once somebody reads it.
    pub entry: Option<Place>,
    pub reached: bool,
    pub out: Vec<Out>,
}

/// A way into a block.
pub(super) struct Edge {
    pub to: usize,
    pub cr: Cr,
    pub span: Span,
}

/// A statement, or one that depends on what the block at the end of an edge needs.
pub(super) enum Out {
    Stmt(Stmt),
    /// Falls into the next block.
    Enter(usize),
    Jump {
        condition: Option<Expr>,
        edge: Option<usize>,
        label: LabelId,
        span: Span,
    },
}

impl<'t> List<'_, '_, 't> {
    /// Splits the lines at their labels.
    pub(super) fn split(&mut self, lines: &'t [Line], span: Span) {
        let block = |from, label, span| Block { lines: (from, from), label, span, entry: None, reached: false, out: Vec::new() };
        self.blocks.push(block(0, None, span));
        for (i, line) in lines.iter().enumerate() {
            if let Some(name) = &line.label
                && self.b.declare_label(name)
            {
                let id = self.b.scope.labels.fresh();
                self.labels.insert(name.key(), (self.blocks.len(), id));
                self.blocks.push(block(i, Some(id), name.span));
            }
            if let Some(last) = self.blocks.last_mut() {
                last.lines.1 = i + 1;
            }
        }
    }

    /// Checks all blocks.
    pub(super) fn blocks(&mut self, lines: &'t [Line]) {
        self.todo.push(0);
        self.blocks[0].reached = true;
        while let Some(next) = self.todo.pop() {
            self.block(next, lines, true);
        }
        for i in 0..self.blocks.len() {
            if !self.blocks[i].reached {
                self.block(i, lines, false);
            }
        }
    }

    fn block(&mut self, index: usize, lines: &'t [Line], reached: bool) {
        let (from, to) = self.blocks[index].lines;
        self.open = reached;
        self.cr = if index > 0 && reached { Cr::Entry(index) } else { Cr::Undefined };
        for line in lines.get(from..to).unwrap_or_default() {
            if let Some(instr) = &line.instr {
                self.instr(instr);
            }
        }
        if self.open && index + 1 < self.blocks.len() {
            let edge = self.edge(index + 1, self.blocks[index + 1].span);
            self.out.push(Out::Enter(edge));
        }
        self.blocks[index].out = std::mem::take(&mut self.out);
    }

    fn edge(&mut self, to: usize, span: Span) -> usize {
        if !std::mem::replace(&mut self.blocks[to].reached, true) {
            self.todo.push(to);
        }
        self.edges.push(Edge { to, cr: self.cr.clone(), span });
        self.edges.len() - 1
    }

    /// JMP.
    pub(super) fn jump(&mut self, when: When, name: &Name, span: Span) {
        let condition = self.condition(when, span);
        let Some(&(to, label)) = self.labels.get(&name.key()) else { return self.b.unknown_label(name, None) };
        if let Some(condition) = condition {
            let edge = self.open.then(|| self.edge(to, span));
            let unconditional = when == When::Always;
            self.out.push(Out::Jump { condition: (!unconditional).then_some(condition), edge, label, span });
        }
        self.stop(when);
    }

    /// Behind a JMP or RET without a condition nothing is left.
    pub(super) fn stop(&mut self, when: When) {
        if when == When::Always {
            self.open = false;
            self.cr = Cr::Undefined;
        }
    }

    /// The current result at the start of a block, of the type that the ways to it bring; `want` settles literals.
    pub(super) fn entry(&mut self, block: usize, want: Option<TypeId>) -> Option<Operand> {
        let place = match self.blocks[block].entry.clone() {
            Some(place) => place,
            None => {
                let ty = self.entry_type(block, want)?;
                let place = self.b.temporary(ty, self.blocks[block].span)?;
                self.blocks[block].entry = Some(place.clone());
                place
            }
        };
        Some(Operand::fixed(Expr { ty: place.ty, span: place.span, kind: ExprKind::Load(place) }))
    }

    fn entry_type(&mut self, block: usize, want: Option<TypeId>) -> Option<TypeId> {
        let (mut seen, mut todo, mut literal) = (vec![false; self.blocks.len()], vec![block], None);
        while let Some(at) = todo.pop() {
            if let Some(place) = &self.blocks[at].entry {
                return Some(place.ty);
            }
            if std::mem::replace(&mut seen[at], true) {
                continue;
            }
            for edge in self.edges.iter().filter(|e| e.to == at) {
                match &edge.cr {
                    Cr::Value(o) if o.flex == Flex::Fixed => return Some(o.expr.ty),
                    Cr::Value(o) => literal = literal.or(Some(o.clone())),
                    Cr::Entry(from) => todo.push(*from),
                    Cr::Undefined | Cr::Bad => {}
                }
            }
        }
        let literal = literal?;
        match want.filter(|ty| self.b.fits(&literal, *ty)) {
            Some(ty) => Some(ty),
            None => Some(self.b.settle(literal).ty),
        }
    }

    /// The statements of all blocks in order.
    pub(super) fn finish(mut self) -> Vec<Stmt> {
        self.pass_on();
        let mut list = Vec::new();
        for block in std::mem::take(&mut self.blocks) {
            self.entries.push(block.entry);
            list.push((block.label, block.span, block.out));
        }
        let mut all = Vec::new();
        for (label, span, out) in list {
            all.extend(label.map(|id| Stmt { kind: StmtKind::Label(id), span }));
            for out in out {
                self.emit(out, &mut all);
            }
        }
        all
    }

    /// A result that is read behind two labels is read at the first one too.
    fn pass_on(&mut self) {
        let mut changed = true;
        while changed {
            changed = false;
            for i in 0..self.edges.len() {
                let (to, Cr::Entry(from)) = (self.edges[i].to, self.edges[i].cr.clone()) else { continue };
                let wanted = self.blocks[to].entry.as_ref().map(|p| p.ty);
                if wanted.is_some() && self.blocks[from].entry.is_none() {
                    changed |= self.entry(from, wanted).is_some();
                }
            }
        }
    }

    fn emit(&mut self, out: Out, all: &mut Vec<Stmt>) {
        match out {
            Out::Stmt(stmt) => all.push(stmt),
            Out::Enter(edge) => all.extend(self.assign_entry(edge)),
            Out::Jump { condition, edge, label, span } => {
                let mut list: Vec<Stmt> = edge.and_then(|e| self.assign_entry(e)).into_iter().collect();
                list.push(Stmt { kind: StmtKind::Jump(label), span });
                match condition {
                    None => all.append(&mut list),
                    Some(condition) => {
                        let kind = StmtKind::If { branches: vec![(condition, list)], otherwise: Vec::new() };
                        all.push(Stmt { kind, span });
                    }
                }
            }
        }
    }

    /// The result of this way for the block that reads it.
    fn assign_entry(&mut self, edge: usize) -> Option<Stmt> {
        let Edge { to, cr, span } = self.edges.get(edge)?;
        let (to, cr, span) = (*to, cr.clone(), *span);
        let target = self.entries[to].clone()?;
        let value = match cr {
            Cr::Bad => return None,
            Cr::Value(o) => Some(o),
            Cr::Entry(from) => self.entries[from]
                .clone()
                .map(|place| Operand::fixed(Expr { ty: place.ty, span: place.span, kind: ExprKind::Load(place) })),
            Cr::Undefined => None,
        };
        let agrees = value.filter(|o| o.expr.ty == target.ty || o.flex != Flex::Fixed && self.b.fits(o, target.ty));
        let Some(value) = agrees else {
            let wanted = self.b.show(target.ty);
            let diag = Diag::new(Code::ResultDiffers, span, format!("brings no current result of type {wanted}"));
            self.b.report(
                diag.also(target.span, "the current result is read behind this label").help("load it anew behind the label"),
            );
            return None;
        };
        let value = self.b.fit(value, target.ty);
        Some(Stmt { kind: StmtKind::Assign { target, value }, span })
    }
}
