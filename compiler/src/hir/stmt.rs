//! Statements (§5.5 to §5.8).

use super::builder::Builder;
use super::constant;
use super::convert::Operand;
use super::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag, Severity, Span};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// A list of statements; what was wrong is left out.
    pub fn statements(&mut self, list: &[ast::Stmt]) -> Vec<Stmt> {
        let labels = self.open_labels(list);
        let mut out = Vec::with_capacity(list.len());
        for s in list {
            match &s.kind {
                ast::StmtKind::Instructions(lines) => out.append(&mut self.instructions(lines, s.span)),
                ast::StmtKind::Chain { targets, value } => out.append(&mut self.chain(targets, value, s.span)),
                ast::StmtKind::Return(Some(value)) => {
                    out.extend(self.returned(value, s.span));
                    out.push(Stmt { kind: StmtKind::Return, span: s.span });
                }
                _ => out.extend(self.deeper(s.span, |b| b.statement(s)).flatten()),
            }
        }
        if labels {
            self.close_labels();
        }
        out
    }

    fn statement(&mut self, s: &ast::Stmt) -> Option<Stmt> {
        let kind = match &s.kind {
            ast::StmtKind::Assign { target, value } => self.assign(target, value)?,
            ast::StmtKind::Attempt { target, value } => self.attempt(target, value)?,
            ast::StmtKind::Bind { target, value } => self.bind(target, value, s.span)?,
            ast::StmtKind::Call(e) => self.call_statement(e)?,
            ast::StmtKind::If { branches, otherwise } => {
                let branches = branches.iter().map(|(c, body)| (self.condition(c), self.statements(body))).collect();
                StmtKind::If { branches, otherwise: self.statements(otherwise) }
            }
            ast::StmtKind::Case { selector, arms, otherwise } => self.case(selector, arms, otherwise.as_deref())?,
            ast::StmtKind::For { variable, from, to, by, body } => {
                self.for_loop(variable, from, to, by.as_deref(), body, s.span)?
            }
            ast::StmtKind::While { condition, body } => {
                let condition = self.condition(condition);
                StmtKind::While { condition, body: self.loop_body(body) }
            }
            ast::StmtKind::Repeat { body, until } => {
                let body = self.loop_body(body);
                StmtKind::Repeat { body, until: self.condition(until) }
            }
            ast::StmtKind::Exit => self.inside_loop(StmtKind::Exit, "EXIT", s.span)?,
            ast::StmtKind::Continue => self.inside_loop(StmtKind::Continue, "CONTINUE", s.span)?,
            ast::StmtKind::Return(_) => StmtKind::Return,
            ast::StmtKind::Expression(e) => {
                self.no_effect(e);
                return None;
            }
            ast::StmtKind::Label(name) => self.label_statement(name)?,
            ast::StmtKind::Jump(name) => self.jump_statement(name)?,
            ast::StmtKind::Instructions(_) | ast::StmtKind::Chain { .. } | ast::StmtKind::Empty | ast::StmtKind::Error => {
                return None;
            }
        };
        Some(Stmt { kind: self.hoist_enable(kind, s.span), span: s.span })
    }

    /// `RETURN value;` (an extension): the value becomes the result of the function.
    fn returned(&mut self, value: &ast::Expr, span: Span) -> Option<Stmt> {
        let Some(result) = self.scope.pou.and_then(|p| self.hir.pous[p].result) else {
            let help = "only a function with a result returns a value";
            self.report(Diag::new(Code::NotAVariable, value.span, "there is no result here").help(help));
            return None;
        };
        let ty = self.hir.pous[self.scope.pou?].vars[result].ty;
        self.scope.result_written = true;
        let value = self.value(value, ty);
        let target = Place { base: Base::Var(result), path: Vec::new(), ty, span };
        Some(Stmt { kind: StmtKind::Assign { target, value }, span })
    }

    /// An expression that stands alone (vendor).
    fn no_effect(&mut self, e: &ast::Expr) {
        self.operand(e, None);
        let diag = Diag::new(Code::VendorForm, e.span, "its value is forgotten").severity(Severity::Warning);
        self.report(diag.message("this statement has no effect").help("assign the value, or leave the statement out"));
    }

    fn loop_body(&mut self, body: &[ast::Stmt]) -> Vec<Stmt> {
        self.scope.loops += 1;
        let body = self.statements(body);
        self.scope.loops -= 1;
        body
    }

    fn inside_loop(&mut self, kind: StmtKind, word: &str, span: Span) -> Option<StmtKind> {
        if self.scope.loops == 0 {
            let help = "RETURN leaves the unit";
            self.report(Diag::new(Code::ExitOutsideLoop, span, format!("{word} without a loop around it")).help(help));
            return None;
        }
        Some(kind)
    }

    fn for_loop(
        &mut self,
        variable: &ast::Expr,
        from: &ast::Expr,
        to: &ast::Expr,
        by: Option<&ast::Expr>,
        body: &[ast::Stmt],
        span: Span,
    ) -> Option<StmtKind> {
        let Some((place, ty)) = self.control(variable) else {
            self.loop_body(body);
            return None;
        };
        let from = self.value(from, ty);
        let to = self.value(to, ty);
        let by = match by {
            Some(e) => self.step(e, ty),
            None => super::convert::constant_expr(Const::Int(1), ty, span),
        };
        let own = match place.base {
            Base::Var(id) if place.path.is_empty() => Some(id),
            _ => None,
        };
        self.scope.controls.extend(own);
        let body = self.loop_body(body);
        self.scope.controls.truncate(self.scope.controls.len() - own.iter().count());
        Some(StmtKind::For { variable: place, values: Box::new([from, to, by]), body })
    }

    /// The control variable and the type to count in.
    fn control(&mut self, e: &ast::Expr) -> Option<(Place, TypeId)> {
        let place = self.writable(e)?;
        if place.ty == self.error {
            return None;
        }
        let base = match self.ty(place.ty) {
            Type::Elementary(e) | Type::Subrange { base: e, .. } if e.is_int() => *e,
            _ => {
                let label = format!("{}, an integer wanted", self.show(place.ty));
                self.error(Code::ForVariable, e.span, label);
                return None;
            }
        };
        let own = match place.base {
            Base::Var(_) => place.path.is_empty(),
            Base::This => matches!(place.path[..], [Step::Field(_)]), // a variable of the unit, in its methods and actions
            _ => false,
        };
        if !own && !self.profile(e.span).is_codesys() {
            let help = "count in a variable of this unit and copy it";
            self.report(Diag::new(Code::ForVariable, e.span, "not a variable of this unit").help(help));
            return None;
        }
        Some((place, self.elem(base)))
    }

    fn step(&mut self, e: &ast::Expr, ty: TypeId) -> Expr {
        let by = self.value(e, ty);
        if by.ty != self.error && matches!(&by.kind, ExprKind::Const(c) if constant::is_zero(c)) {
            self.error(Code::ForStepZero, e.span, "0");
        }
        by
    }

    fn case(&mut self, selector: &ast::Expr, arms: &[ast::CaseArm], otherwise: Option<&[ast::Stmt]>) -> Option<StmtKind> {
        let o = self.operand(selector, None);
        if self.is_string(o.expr.ty) {
            return self.case_of_text(o, arms, otherwise);
        }
        let selector = self.selector(selector, o);
        let ty = selector.as_ref().map(|s| s.ty);
        let mut taken: Vec<(i128, i128, Span)> = Vec::new();
        let mut out = Vec::new();
        for arm in arms {
            let labels = arm.labels.iter().filter_map(|l| self.label(l, ty?)).collect();
            let labels = self.distinct(labels, &mut taken);
            out.push((labels, self.statements(&arm.body)));
        }
        let otherwise = otherwise.map(|o| self.statements(o)).unwrap_or_default();
        Some(StmtKind::Case { selector: selector?, arms: out, otherwise })
    }

    fn selector(&mut self, e: &ast::Expr, o: Operand) -> Option<Expr> {
        if self.is_bad(&o) {
            return None;
        }
        let plain_enum = matches!(self.ty(o.expr.ty), Type::Enum { .. }) && !self.named_values.contains(&o.expr.ty);
        let o = self.decay(o);
        let selector = self.settle(o);
        let counts = |k: Elementary| k.is_int() || k.is_bit() || k.is_char();
        if plain_enum || self.elementary(selector.ty).is_some_and(counts) {
            return Some(selector);
        }
        let label = self.show(selector.ty);
        let help = "CASE selects by integers, bit strings, characters and enumerations; use IF and ELSIF for others";
        self.report(Diag::new(Code::BadOperand, e.span, label).message("CASE can't select by this type").help(help));
        None
    }

    fn label(&mut self, l: &ast::CaseLabel, ty: TypeId) -> Option<(i128, i128, Span)> {
        let low = self.const_of(&l.low, ty);
        let Some(high) = &l.high else { return low.map(|v| (v, v, l.low.span)) };
        let (low, high, span) = (low, self.const_of(high, ty), l.low.span.to(high.span));
        let (low, high) = (low?, high?);
        if low > high {
            let help = "write the smaller bound first";
            self.report(Diag::new(Code::OutOfRange, span, format!("{low} is above {high}")).help(help));
            return None;
        }
        Some((low, high, span))
    }

    /// Labels that no earlier one covers; reports the others.
    fn distinct(&mut self, labels: Vec<(i128, i128, Span)>, taken: &mut Vec<(i128, i128, Span)>) -> Vec<(i128, i128)> {
        let mut out = Vec::new();
        for label in labels {
            // `taken` is sorted and free of overlaps, so only the neighbours can overlap.
            let at = taken.partition_point(|t| t.0 <= label.0);
            let before = at.checked_sub(1).and_then(|i| taken.get(i)).filter(|t| t.1 >= label.0);
            let clash = before.or_else(|| taken.get(at).filter(|t| t.0 <= label.1));
            if let Some(&(_, _, first)) = clash {
                if self.profile(label.2).is_codesys() {
                    out.extend(self.not_covered(label, first, taken));
                    continue;
                }
                self.report(Diag::new(Code::DuplicateCaseLabel, label.2, "covered again").also(first, "covered first"));
                continue;
            }
            taken.insert(at, label);
            out.push((label.0, label.1));
        }
        out
    }

    /// The values of a label that no earlier one has (vendor: the first that fits runs).
    fn not_covered(&mut self, label: (i128, i128, Span), first: Span, taken: &mut Vec<(i128, i128, Span)>) -> Vec<(i128, i128)> {
        let diag = Diag::new(Code::DuplicateCaseLabel, label.2, "covered again").also(first, "covered first");
        self.report(diag.severity(takt_base::Severity::Warning).help("the first one runs"));
        let (mut low, mut free) = (label.0, Vec::new());
        for t in taken.iter().filter(|t| t.1 >= label.0 && t.0 <= label.1) {
            if t.0 > low {
                free.push((low, t.0 - 1));
            }
            low = low.max(t.1 + 1);
        }
        if low <= label.1 {
            free.push((low, label.1));
        }
        taken.extend(free.iter().map(|f| (f.0, f.1, label.2)));
        taken.sort_by_key(|t| t.0);
        free
    }

    /// A call as a statement.
    fn call_statement(&mut self, e: &ast::Expr) -> Option<StmtKind> {
        let ast::ExprKind::Call { callee, args } = &e.kind else {
            self.error(Code::NotCallable, e.span, "not a call");
            return None;
        };
        let full = self.qualified_callee(callee);
        let callee = full.as_ref().unwrap_or(callee);
        if let Some(call) = self.body_call(callee, args, e.span) {
            return call;
        }
        if let Some(o) = self.method_call(callee, args, e.span) {
            return (!self.is_bad(&o)).then_some(StmtKind::Call(o.expr));
        }
        if let Some(call) = self.block_call(callee, args, e.span) {
            return call;
        }
        let o: Operand = self.call_any(callee, args, e.span, None);
        (!self.is_bad(&o)).then(|| StmtKind::Call(self.settle(o)))
    }
}
