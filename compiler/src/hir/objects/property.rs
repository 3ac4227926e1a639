//! Properties: read and assigned like variables, which calls their GET and SET.

use super::call::Object;
use crate::hir::builder::Builder;
use crate::hir::convert::Operand;
use crate::hir::model::*;
use crate::hir::scope::Local;
use crate::syntax::ast::{self, Accessor, ExprKind as E, Name};
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;
use takt_image::types::{Section, Type};

impl Builder<'_> {
    /// Cheap test before anything is looked up.
    pub(in crate::hir) fn may_be_property(&self, e: &ast::Expr) -> bool {
        match &e.kind {
            _ if self.objects.properties.is_empty() => false,
            E::Name(n) | E::Member(_, n) => self.objects.properties.contains(&n.key()),
            _ => false,
        }
    }

    /// True if the name is a property of the running instance.
    pub(super) fn is_own_property(&self, name: &Name) -> bool {
        let Some(own) = self.own_type().filter(|_| self.local(&name.key()).is_none()) else { return false };
        self.has_property(own, name)
    }

    fn has_property(&self, ty: PouId, name: &Name) -> bool {
        [Accessor::Get, Accessor::Set].into_iter().any(|a| self.find_accessor(ty, name, a).is_some())
    }

    /// The type that has the property which the expression names, if that can be told without typing it.
    pub(super) fn property_of(&self, e: &ast::Expr) -> Option<PouId> {
        match &e.kind {
            E::Name(n) => self.own_type().filter(|_| self.is_own_property(n)),
            E::Member(base, n) => self.static_unit(base).filter(|ty| self.has_property(*ty, n)),
            _ => None,
        }
    }

    /// The unit of the expression's type, without reports.
    fn static_unit(&self, e: &ast::Expr) -> Option<PouId> {
        let ty = self.static_type(e)?;
        self.type_unit(ty)
    }

    /// The type of what stands there; of a REFERENCE TO, that of what it is bound to.
    fn static_type(&self, e: &ast::Expr) -> Option<TypeId> {
        let mut ty = self.raw_type(e)?;
        while let Some(target) = self.bound_type(ty) {
            ty = target;
        }
        Some(ty)
    }

    fn raw_type(&self, e: &ast::Expr) -> Option<TypeId> {
        match &e.kind {
            E::Name(n) => match self.local(&n.key()) {
                Some(Local::Var(v)) => Some(self.hir.pous[self.scope.pou?].vars[v].ty),
                Some(Local::Member(v)) => Some(self.hir.pous[self.own_type()?].vars[v].ty),
                Some(Local::External(g)) => Some(self.hir.globals[g].ty),
                None if n.is("THIS") => self.hir.pous[self.own_type()?].instance,
                None if n.is("SUPER") => self.hir.pous[self.hir.pous[self.own_type()?].base?].instance,
                None if self.is_own_property(n) => self.getter_type(self.own_type()?, n),
                None => self.global_id(n).map(|g| self.hir.globals[g].ty),
            },
            E::Member(base, n) => {
                let ty = self.static_type(base)?;
                if let Type::Struct(r) | Type::Instance(r) = self.ty(ty)
                    && let Some(f) = r.fields.iter().rfind(|f| n.is(&f.name) && f.section != Section::Hidden)
                {
                    return Some(f.ty);
                }
                self.getter_type(self.type_unit(ty)?, n)
            }
            E::Deref(base) => {
                let ty = self.static_type(base)?;
                Some(self.pointee(ty).map_or(ty, |(target, _)| target))
            }
            E::Index(base, _) => match self.ty(self.static_type(base)?) {
                Type::Array { element, .. } => Some(*element),
                _ => None,
            },
            _ => None,
        }
    }

    fn getter_type(&self, ty: PouId, n: &Name) -> Option<TypeId> {
        let pou = &self.hir.pous[self.find_accessor(ty, n, Accessor::Get)?];
        Some(pou.vars[pou.result?].ty)
    }

    /// True for `x.p`, a property whose value is a REFERENCE TO.
    pub(in crate::hir) fn gives_reference(&self, e: &ast::Expr) -> bool {
        let E::Member(_, name) = &e.kind else { return false };
        let unit = if self.may_be_property(e) { self.property_of(e) } else { None };
        unit.and_then(|unit| self.getter_type(unit, name)).is_some_and(|ty| self.bound_type(ty).is_some())
    }

    /// The property as a value; `None` if the expression is something else.
    pub(in crate::hir) fn property_read(&mut self, e: &ast::Expr) -> Option<Operand> {
        let (object, name) = self.property_object(e)?;
        let Some(object) = object else { return Some(self.bad(e.span)) };
        match self.find_accessor(object.ty, name, Accessor::Get) {
            Some(get) => Some(self.call_on(object, get, name, &[], e.span)),
            None => {
                self.no_side(name, "GET", "it can only be assigned");
                Some(self.bad(e.span))
            }
        }
    }

    /// An assignment to a property; `None` if the target is something else.
    pub(in crate::hir) fn property_write(&mut self, target: &ast::Expr, value: &ast::Expr) -> Option<Option<StmtKind>> {
        if !self.may_be_property(target) {
            return None;
        }
        let (object, name) = self.property_object(target)?;
        let span = target.span.to(value.span);
        let set = object.and_then(|o| match self.find_accessor(o.ty, name, Accessor::Set) {
            Some(set) => Some((o, set)),
            None => {
                self.no_side(name, "SET", "it can only be read");
                None
            }
        });
        let Some((object, set)) = set else {
            self.operand(value, None);
            return Some(None);
        };
        let o = self.call_on(object, set, name, &[ast::Arg::Positional(value.clone())], span);
        Some((!self.is_bad(&o)).then_some(StmtKind::Call(o.expr)))
    }

    /// Whose property the expression names; the inner `None`: something was wrong and is reported.
    fn property_object<'e>(&mut self, e: &'e ast::Expr) -> Option<(Option<Object>, &'e Name)> {
        self.property_of(e)?;
        match &e.kind {
            E::Name(n) => Some((self.this_object(n.span), n)),
            E::Member(base, n) => Some((self.object(base, n)?, n)),
            _ => None,
        }
    }

    fn no_side(&mut self, name: &Name, side: &str, help: &str) {
        let label = format!("`{}` has no {side}", name.text);
        self.report(Diag::new(Code::PropertySide, name.span, label).help(help));
    }

    /// A method or property where a variable is wanted; true if that was reported.
    pub(in crate::hir) fn method_without_call(&mut self, ty: TypeId, name: &Name) -> bool {
        let Some(unit) = self.type_unit(ty) else { return false };
        if self.find_method(unit, &name.key()).is_some() {
            let help = format!("call it: {}()", name.text);
            self.report(Diag::new(Code::NotAVariable, name.span, "a method").help(help));
            return true;
        }
        if self.has_property(unit, name) {
            self.property_place(name.span);
            return true;
        }
        false
    }

    fn property_place(&mut self, span: Span) {
        let help = "assign it to a variable first: a property has no place of its own";
        self.report(Diag::new(Code::NotAVariable, span, "a property").help(help));
    }
}
