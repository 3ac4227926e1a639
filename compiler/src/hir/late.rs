//! Initial values that are known only when the program starts: REF of a variable of the instance, and in the CODESYS profiles calls,
//! other variables, addresses (§3.1). Found
//! when the declaration is resolved, evaluated by [`super::startup`]; in functions and for VAR_TEMP at the start of each call.

use super::builder::Builder;
use super::convert::constant_expr;
use super::model::*;
use super::scope::{Local, ReadOnly};
use super::symbols::Unit;
use super::types::TypeUse;
use crate::syntax::ast::{self, ExprKind as E, Init};
use takt_base::Span;
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

/// A variable with a value that is computed at the start.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Owner {
    Var(PouId, VarId),
    Global(GlobalId),
}

/// A step to a part of a variable.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    Field(u32),
    /// Element of an array in memory order.
    Element(usize),
}

/// An expression for a variable or a part of it.
#[derive(Clone, Debug)]
pub(super) struct Late {
    pub path: Vec<Part>,
    pub ty: TypeId,
    pub value: ast::Expr,
}

/// A declaration being resolved whose parts may be late.
#[derive(Default)]
pub(super) struct Found {
    /// To the part at hand.
    path: Vec<Part>,
    /// Elements in front of the row at hand.
    row: usize,
    list: Vec<Late>,
    /// Nothing but REF() may be late (standard, §3.9).
    references_only: bool,
}

impl Builder<'_> {
    /// The constant part of an initial value, and what is computed later where `allowed`.
    pub fn initial_or_late(&mut self, init: &Init, used: &TypeUse, allowed: bool) -> (Const, Vec<Late>) {
        let references_only = !self.profile(init.span()).is_codesys();
        let found = Found { references_only, ..Found::default() };
        let allowed = allowed && !self.in_library(init.span());
        let outer = std::mem::replace(&mut self.late_now, allowed.then_some(found));
        let value = self.initial(init, used);
        let found = std::mem::replace(&mut self.late_now, outer);
        (value, found.map(|f| f.list).unwrap_or_default())
    }

    /// The constant initial value of a declaration; what is computed, and arguments of FB_init, are kept for the start.
    pub fn declared_value(&mut self, d: &ast::VarDecl, used: &TypeUse, late: bool, owners: &[Owner]) -> Const {
        let mut used = used.clone();
        let mut list = Vec::new();
        match &d.arguments {
            Some(args) if self.initialised_unit(used.ty).is_some() => {
                owners.iter().for_each(|o| _ = self.startup.arguments.insert(*o, args.clone()));
            }
            Some(args) => (used.default, list) = self.initial_or_late(args, &used, late),
            None => {}
        }
        let Some(init) = &d.init else {
            self.keep_late(owners, list);
            return used.default;
        };
        let (value, more) = self.initial_or_late(init, &used, late);
        list.extend(more);
        self.keep_late(owners, list);
        value
    }

    fn keep_late(&mut self, owners: &[Owner], list: Vec<Late>) {
        for owner in owners.iter().filter(|_| !list.is_empty()) {
            self.startup.late.insert(*owner, list.clone());
        }
    }

    /// Notes an expression for later; false if it must be constant.
    pub fn put_off(&mut self, e: &ast::Expr, ty: TypeId) -> bool {
        let Some(found) = self.late_now.as_mut().filter(|f| !f.references_only || e.is_call_of("REF")) else { return false };
        found.list.push(Late { path: found.path.clone(), ty, value: e.clone() });
        true
    }

    /// Runs `f` for a part of the value at hand.
    pub fn in_part<T>(&mut self, part: Part, f: impl FnOnce(&mut Self) -> T) -> T {
        let mut row = 0;
        if let Some(found) = &mut self.late_now {
            let part = match part {
                Part::Element(i) => Part::Element(i + found.row),
                field => field,
            };
            row = std::mem::take(&mut found.row);
            found.path.push(part);
        }
        let value = f(self);
        if let Some(found) = &mut self.late_now {
            found.path.pop();
            found.row = row;
        }
        value
    }

    /// Runs `f` for the elements from `start` on.
    pub fn in_row<T>(&mut self, start: usize, f: impl FnOnce(&mut Self) -> T) -> T {
        let shift = |b: &mut Self, by: &dyn Fn(usize) -> usize| {
            if let Some(found) = &mut b.late_now {
                found.row = by(found.row);
            }
        };
        shift(self, &|row| row + start);
        let value = f(self);
        shift(self, &|row| row - start);
        value
    }

    /// True for an expression that only the running program can evaluate.
    pub fn is_late(&self, e: &ast::Expr) -> bool {
        if self.late_now.as_ref().is_none_or(|f| f.references_only && !e.is_call_of("REF")) {
            return false;
        }
        match &e.kind {
            E::Literal(_) | E::Enumerator { .. } | E::Null | E::Error => false,
            E::Direct(_) | E::Deref(_) | E::Assign { .. } => true,
            E::Name(n) => self.is_late_name(n),
            E::Unary(_, a) | E::Part { base: a, .. } => self.is_late(a),
            E::Binary(_, a, b) => self.is_late(a) || self.is_late(b),
            E::Index(a, list) => self.is_late(a) || list.iter().any(|i| self.is_late(i)),
            E::Member(base, _) => match self.qualified(e).and_then(|n| self.global_id(&n)) {
                Some(global) => !self.hir.globals[global].constant,
                None => self.is_late(base),
            },
            E::Call { callee, args } => self.is_late_call(callee, args),
        }
    }

    fn is_late_name(&self, name: &ast::Name) -> bool {
        match self.local(&name.key()) {
            Some(Local::Var(v)) => self.scope.read_only.get(&v) != Some(&ReadOnly::Constant),
            Some(Local::Member(v)) => self.scope.fixed_members.get(&v) != Some(&ReadOnly::Constant),
            Some(Local::External(g)) => !self.hir.globals[g].constant,
            None if self.is_this(name) || self.named_program(name).is_some() || self.is_declared_below(name) => true,
            None => self.global_id(name).is_some_and(|g| !self.hir.globals[g].constant),
        }
    }

    /// A variable of the unit whose declaration comes later: it has its constant value by then.
    fn is_declared_below(&self, name: &ast::Name) -> bool {
        let sections = self.scope.pou.iter().flat_map(|id| &self.symbols.pous[*id].decl.sections);
        sections.flat_map(|s| &s.decls).flat_map(|d| &d.names).any(|n| n.is(&name.text))
    }

    fn is_late_call(&self, callee: &ast::Expr, args: &[ast::Arg]) -> bool {
        let E::Name(name) = &callee.kind else { return true };
        let key = name.key();
        if self.own_type().is_some_and(|own| self.find_method(own, &key).is_some()) {
            return true;
        }
        if self.local(&key).is_none() && self.unit(name).is_none() {
            let mut list = args.iter().filter_map(super::body::arg_expr);
            match &*key {
                "SIZEOF" | "UPPER_BOUND" | "LOWER_BOUND" => return false,
                "REF" | "ADR" => return list.any(|e| self.is_moving(e)),
                "TIME" => return true,
                _ => return list.any(|e| self.is_late(e)),
            }
        }
        matches!(self.unit(name), Some((Unit::Pou(id), _)) if self.hir.pous[id].kind == PouKind::Function)
            || self.scope.pou.is_some() && self.local(&key).is_none()
    }

    /// True for a place that differs from instance to instance, or that is known only when the program runs.
    fn is_moving(&self, e: &ast::Expr) -> bool {
        match &e.kind {
            E::Name(n) => match self.local(&n.key()) {
                Some(Local::External(_)) => false,
                Some(_) => true,
                None => self.is_this(n),
            },
            E::Member(base, _) | E::Part { base, .. } => self.is_moving(base),
            E::Index(base, list) => self.is_moving(base) || list.iter().any(|i| self.is_late(i)),
            E::Deref(_) | E::Call { .. } => true,
            _ => false,
        }
    }

    /// A variable beside one that is computed at the start: TRUE if it has its value, which may have been restored.
    pub fn add_mark(&mut self, id: PouId, name: &ast::Name, keep: Keep) -> VarId {
        let bool = self.elem(Elementary::Bool);
        let name = ast::Name { text: format!("{}.set", name.text), span: name.span };
        let mark = self.push_var(id, &name, bool, Role::Hidden, Storage::Local, Const::Zero);
        self.hir.pous[id].vars[mark].keep = keep;
        mark
    }

    /// `variable.part := value` for all parts that are computed.
    pub fn late_assignments(&mut self, base: &Place, list: &[Late]) -> Vec<Stmt> {
        list.iter().filter_map(|late| self.late_assignment(base, late)).collect()
    }

    fn late_assignment(&mut self, base: &Place, late: &Late) -> Option<Stmt> {
        let span = late.value.span;
        let mut target = Place { span, ..base.clone() };
        for part in &late.path {
            self.step_to(&mut target, *part, span)?;
        }
        let kept = std::mem::take(&mut self.place_only);
        let reference = self.bound_type(late.ty).is_some();
        let value = if reference { self.bound_value(&late.value, late.ty) } else { self.value(&late.value, late.ty) };
        self.place_only = kept;
        (value.ty != self.error).then_some(Stmt { kind: StmtKind::Assign { target, value }, span })
    }

    /// One step further into a place.
    pub fn step_to(&mut self, place: &mut Place, part: Part, span: Span) -> Option<()> {
        match (part, self.ty(place.ty)) {
            (Part::Field(i), Type::Struct(r) | Type::Instance(r)) => {
                let ty = r.fields.get(i as usize)?.ty;
                let bit = self.bit_members.get(&(place.ty, i)).copied();
                place.path.push(Step::Field(i));
                place.ty = ty;
                if let Some(bit) = bit {
                    place.path.push(Step::Part { bit, width: 1 });
                    place.ty = self.bool();
                }
            }
            (Part::Element(flat), Type::Array { element, dims }) => {
                let (element, dims) = (*element, dims.clone());
                let dint = self.elem(Elementary::Dint);
                let mut rest = flat;
                let mut list = Vec::new();
                for dim in dims.iter().rev() {
                    let length = dim.len().max(1) as usize;
                    let index = i128::from(dim.low) + (rest % length) as i128;
                    rest /= length;
                    list.insert(0, constant_expr(Const::Int(index), dint, span));
                }
                place.path.push(Step::Index(list));
                place.ty = element;
            }
            _ => return None,
        }
        Some(())
    }

    /// The variables of the running unit that start anew at each call: their values, if these are computed.
    pub fn late_locals(&mut self, id: PouId) -> Vec<Stmt> {
        let mut out = Vec::new();
        for v in self.hir.pous[id].vars.indices() {
            let var = &self.hir.pous[id].vars[v];
            let at_call = self.hir.pous[id].kind.is_called_by_value() || var.role == Role::Temp;
            let place = Place { base: Base::Var(v), path: Vec::new(), ty: var.ty, span: var.span };
            if at_call && let Some(list) = self.startup.late.remove(&Owner::Var(id, v)) {
                out.extend(self.late_assignments(&place, &list));
            }
        }
        out
    }
}
