//! References (§2.10): REF_TO, REF, `^`, NULL, `?=`; and the vendor's REFERENCE TO with `REF=`.
//!
//! A value is the offset of a variable in the resource memory, 0 for NULL. What a reference refers to need not be resolved when the
//! reference is declared, so that structures and function blocks may refer to each other.

use super::builder::Builder;
use super::convert::{Operand, constant_expr};
use super::model::*;
use super::place::{Access, Target};
use super::symbols::{State, Unit};
use super::types::TypeUse;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::types::{PointerKind, Record, Type};
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// `REF_TO T` and its relatives.
    pub fn pointer_type(&mut self, kind: PointerKind, target: &ast::TypeRef) -> TypeUse {
        let target = self.referred_type(target);
        if target == self.error {
            return self.bad_type();
        }
        TypeUse { ty: self.pointer_to(kind, target), default: Const::Zero }
    }

    /// The type of references to `target`.
    pub fn pointer_to(&mut self, kind: PointerKind, target: TypeId) -> TypeId {
        self.hir.types.intern(Type::Pointer { target, kind })
    }

    /// What a value of this type points to, and how.
    pub fn pointee(&self, ty: TypeId) -> Option<(TypeId, PointerKind)> {
        if let Type::Pointer { target, kind } = *self.ty(ty) { Some((target, kind)) } else { None }
    }

    /// The type of what a REFERENCE TO of this type is bound to.
    pub fn bound_type(&self, ty: TypeId) -> Option<TypeId> {
        if let Type::Pointer { target, kind: PointerKind::Reference } = *self.ty(ty) { Some(target) } else { None }
    }

    /// A type that is only referred to: structures and function blocks are not looked into.
    fn referred_type(&mut self, t: &ast::TypeRef) -> TypeId {
        if let ast::TypeRefKind::Named(name) = &t.kind
            && Elementary::from_name(&name.text).is_none()
        {
            self.check_unit_use(name);
            match self.named_unit(name) {
                Some(Unit::Type(index)) if matches!(self.symbols.types[index].decl.body, ast::TypeBody::Struct(_)) => {
                    return self.reserved_type(index);
                }
                Some(Unit::Pou(id)) if matches!(self.hir.pous[id].kind, PouKind::FunctionBlock | PouKind::Class) => {
                    return self.reserved_instance(id);
                }
                _ => {}
            }
        }
        self.type_ref(t).ty
    }

    /// The id that a declared structure has or will have.
    pub fn reserved_type(&mut self, index: usize) -> TypeId {
        let entry = &self.symbols.types[index];
        if entry.state == State::Done {
            return entry.result.as_ref().map_or(self.error, |r| r.ty);
        }
        let known = entry.reserved;
        let name = self.full_name(&entry.decl.name).text;
        let id = known.unwrap_or_else(|| self.hir.types.add(Type::Struct(unfinished(&name))));
        self.symbols.types[index].reserved = Some(id);
        id
    }

    /// The id that the instances of a function block have or will have.
    pub fn reserved_instance(&mut self, id: PouId) -> TypeId {
        let known = self.hir.pous[id].instance.or(self.symbols.pous[id].reserved);
        let ty = known.unwrap_or_else(|| self.hir.types.add(Type::Instance(unfinished(&self.hir.pous[id].name))));
        self.symbols.pous[id].reserved = Some(ty);
        ty
    }

    /// NULL, as a value of the wanted reference type.
    pub(super) fn null(&mut self, span: Span, want: Option<TypeId>) -> Operand {
        match want.filter(|ty| self.pointee(*ty).is_some()) {
            Some(ty) => Operand::fixed(constant_expr(Const::Int(0), ty, span)),
            None if want.is_some_and(|w| matches!(self.ty(w), Type::Reference { .. })) => {
                let ty = self.null_type();
                Operand::fixed(constant_expr(Const::Int(0), ty, span))
            }
            None if want == Some(self.error) => self.bad(span),
            None => {
                let help = "NULL is a value of references: compare it with one, or assign it to one";
                self.report(Diag::new(Code::TypeMismatch, span, "no reference is wanted here").help(help));
                self.bad(span)
            }
        }
    }

    /// `r^`.
    pub(super) fn deref(&mut self, base: &ast::Expr, span: Span) -> Option<Target> {
        let place_only = std::mem::take(&mut self.place_only);
        let o = self.operand(base, None);
        self.place_only = place_only;
        if self.is_bad(&o) {
            return None;
        }
        if self.pointee(o.expr.ty).is_none() {
            let label = format!("{} is not a reference", self.show(o.expr.ty));
            self.report(Diag::new(Code::NotAReference, base.span, label).help("leave ^ out"));
            return None;
        }
        self.follow(o.expr, span)
    }

    /// What the value of a reference refers to.
    pub(super) fn follow(&mut self, pointer: Expr, span: Span) -> Option<Target> {
        let (ty, _) = self.pointee(pointer.ty)?;
        let mut place = match pointer.kind {
            ExprKind::Load(place) => place,
            _ => Place { ty: pointer.ty, span, base: Base::Value(Box::new(pointer)), path: Vec::new() },
        };
        place.path.push(Step::Deref);
        Some(Target { place: Place { ty, span, ..place }, access: Access::Write })
    }

    /// A REFERENCE TO stands for what it is bound to.
    pub(super) fn through_references(&mut self, mut target: Target) -> Target {
        while let Some(ty) = self.bound_type(target.place.ty) {
            target.place.path.push(Step::Deref);
            target.place.ty = ty;
            target.access = Access::Write;
        }
        target
    }

    /// The result of a call that is a REFERENCE TO stands for what it is bound to.
    pub(super) fn through_reference(&mut self, o: Operand) -> Operand {
        if self.bound_type(o.expr.ty).is_none() {
            return o;
        }
        let span = o.expr.span;
        let Some(target) = self.follow(o.expr, span) else { return self.bad(span) };
        let ty = target.place.ty;
        Operand::fixed(Expr { kind: ExprKind::Load(target.place), ty, span })
    }

    /// A call, or a property, that gives a REFERENCE TO, as the place that holds it.
    pub(super) fn computed_place(&mut self, span: Span, value: impl FnOnce(&mut Self) -> Operand) -> Option<Target> {
        let place_only = std::mem::take(&mut self.place_only);
        let o = value(self);
        self.place_only = place_only;
        if self.is_bad(&o) {
            return None;
        }
        if self.bound_type(o.expr.ty).is_none() {
            self.no_place(span);
            return None;
        }
        let place = Place { ty: o.expr.ty, span, base: Base::Value(Box::new(o.expr)), path: Vec::new() };
        Some(Target { place, access: Access::Write })
    }

    pub(super) fn no_place(&mut self, span: Span) {
        let help = "assign the value to a variable first";
        self.report(Diag::new(Code::NotAVariable, span, "a value without a place").help(help));
    }

    /// `REF(v)`.
    pub(super) fn ref_of(&mut self, e: &ast::Expr, span: Span) -> Operand {
        let Some(place) = self.referable(e) else { return self.bad(span) };
        if self.open_parts(place.ty).is_some() {
            return self.whole_open(span);
        }
        let ty = self.pointer_to(PointerKind::RefTo, place.ty);
        Operand::fixed(Expr { kind: ExprKind::Address(place), ty, span })
    }

    /// A variable whose place may be kept; reports what has none.
    pub(super) fn referable(&mut self, e: &ast::Expr) -> Option<Place> {
        let outer = std::mem::replace(&mut self.place_only, true);
        let target = self.place(e);
        self.place_only = outer;
        let target = target?;
        if target.place.ty == self.error {
            return None;
        }
        if let Some(why) = self.not_referable(&target, e.span) {
            let help = "refer to a variable of a function block or program, or to a global variable";
            self.report(Diag::new(Code::NotReferable, e.span, why).help(help));
            return None;
        }
        if let Some(id) = target.place.variable()
            && self.scope.pou.is_some_and(|p| self.hir.pous[p].result == Some(id))
        {
            self.scope.result_written = true;
        }
        Some(target.place)
    }

    fn not_referable(&self, target: &Target, span: Span) -> Option<&'static str> {
        let vendor = self.profile(span).is_codesys();
        match target.place.path.last() {
            Some(Step::Part { .. }) => return Some("a part of a variable"),
            Some(Step::Character(_)) if !vendor => return Some("a character of a string"),
            _ => {}
        }
        if self.is_one_bit(&target.place) {
            return Some("one bit of a byte");
        }
        match target.access {
            Access::Constant(_) if !vendor => return Some("a constant"),
            Access::InputImage if !vendor => return Some("part of %I, which can't be written"),
            _ => {}
        }
        let id = target.place.variable()?;
        let var = &self.hir.pous[self.scope.pou?].vars[id];
        let instance = self.scope.pou.is_some_and(|p| matches!(self.hir.pous[p].kind, PouKind::FunctionBlock | PouKind::Program));
        let lasting = var.role == Role::InOut || instance && var.role != Role::Temp;
        (!lasting && !vendor).then_some("a variable that is gone when the unit returns")
    }

    /// Located at a bit of the process image.
    fn is_one_bit(&self, place: &Place) -> bool {
        use takt_image::image::Place as At;
        if !place.path.is_empty() {
            return false;
        }
        let at = match &place.base {
            Base::Image(at) => Some(*at),
            Base::Global(id) => self.hir.globals[*id].place,
            Base::Var(id) => match self.scope.pou.map(|p| self.hir.pous[p].vars[*id].storage) {
                Some(Storage::Image(at)) => Some(at),
                _ => None,
            },
            Base::This | Base::Value(_) => None,
        };
        matches!(at, Some(At::Bit(..)))
    }

    /// `target ?= value`: the types are known here, so the value either fits or the program is wrong.
    pub(super) fn attempt(&mut self, target: &ast::Expr, value: &ast::Expr) -> Option<StmtKind> {
        let Some(target) = self.writable(target) else {
            self.operand(value, None);
            return None;
        };
        let ty = target.ty;
        if let Some(done) = self.attempt_object(&target, target.span, value) {
            return done;
        }
        if ty != self.error && !matches!(self.pointee(ty), Some((_, PointerKind::RefTo))) {
            let label = format!("{}, a reference wanted", self.show(ty));
            self.report(Diag::new(Code::TypeMismatch, target.span, label).help("write := to assign values"));
            self.operand(value, None);
            return None;
        }
        let value = self.value(value, ty);
        Some(StmtKind::Assign { target, value })
    }

    /// `r REF= v`.
    pub(super) fn bind(&mut self, target: &ast::Expr, value: &ast::Expr, span: Span) -> Option<StmtKind> {
        let target = self.raw_place(target)?;
        let ty = target.place.ty;
        if ty == self.error || !self.check_write(&target, span) {
            return None;
        }
        if !matches!(self.pointee(ty), Some((_, PointerKind::Reference | PointerKind::RefTo))) {
            let label = format!("{}, a REFERENCE TO wanted", self.show(ty));
            self.error(Code::NotAReference, target.place.span, label);
            return None;
        }
        let value = self.bound_value(value, ty);
        Some(StmtKind::Assign { target: target.place, value })
    }

    /// The value of a REFERENCE TO of type `ty` that is bound to what stands there.
    pub(super) fn bound_value(&mut self, e: &ast::Expr, ty: TypeId) -> Expr {
        if matches!(e.kind, ast::ExprKind::Null) || e.is_call_of("REF") || e.is_call_of("ADR") {
            return self.value(e, ty);
        }
        let o = match self.referable(e) {
            Some(place) if self.open_parts(place.ty).is_some() => self.whole_open(e.span),
            Some(place) => {
                let from = self.pointer_to(PointerKind::RefTo, place.ty);
                Operand::fixed(Expr { kind: ExprKind::Address(place), ty: from, span: e.span })
            }
            None => self.bad(e.span),
        };
        self.fit(o, ty)
    }

    /// True if a value of type `from` may become one of the reference type `to` as it is.
    pub(super) fn reference_fits(&self, from: TypeId, to: TypeId) -> bool {
        use PointerKind::*;
        match (self.pointee(from), self.pointee(to)) {
            (Some((a, RefTo | Reference)), Some((b, RefTo | Reference))) => a == b || self.derives(a, b),
            (Some(_), Some((_, Pointer))) => true,
            (Some((a, Pointer)), Some((b, Reference))) => a == b,
            _ => false,
        }
    }

    /// A reference as a constant: the place of a global variable, or of a part of one.
    pub(super) fn constant_address(&self, e: &Expr) -> Option<Const> {
        let place = match &e.kind {
            ExprKind::Address(place) => place,
            ExprKind::Convert(Conversion::Integer, inner) => return self.constant_address(inner),
            ExprKind::Const(c @ Const::Address(..)) => return Some(c.clone()),
            _ => return None,
        };
        let Base::Global(id) = place.base else { return None };
        let mut ty = self.hir.globals[id].ty;
        let mut offset = 0u32;
        for step in &place.path {
            let (index, next) = self.step_into(ty, step)?;
            offset = offset.checked_add(match self.ty(ty) {
                Type::Struct(r) | Type::Instance(r) => r.fields.get(index)?.offset,
                _ => self.hir.types.layout(next).size.checked_mul(u32::try_from(index).ok()?)?,
            })?;
            ty = next;
        }
        Some(Const::Address(id, offset))
    }

    /// References can't be retained or located: the number would mean something else (§2.10).
    pub(super) fn check_kept_reference(&mut self, ty: TypeId, retain: bool, located: bool, span: Span) {
        let refused = located || retain && !self.profile(span).is_codesys();
        if refused && self.hir.types.holds(ty, |t| matches!(t, Type::Pointer { .. })) {
            let help = "set the reference when the program starts";
            self.report(Diag::new(Code::ReferenceKept, span, self.show(ty)).help(help));
        }
    }
}

/// A type whose members are not known yet.
fn unfinished(name: &str) -> Record {
    Record { name: name.to_owned(), fields: Vec::new(), size: 0, align: 1 }
}

impl Place {
    /// The variable of the running unit that this is, or is a part of; nothing that a reference leads to.
    pub fn variable(&self) -> Option<VarId> {
        match self.base {
            Base::Var(id) if !self.derefs() => Some(id),
            _ => None,
        }
    }
    /// True if a reference leads here.
    pub fn derefs(&self) -> bool {
        self.path.iter().any(|s| matches!(s, Step::Deref))
    }
}
