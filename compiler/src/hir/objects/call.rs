//! Calls of methods: `inst.m()`, `m()`, `THIS.m()`, `SUPER.m()`, through references and interfaces, with all forms of arguments.

use super::key;
use crate::hir::builder::Builder;
use crate::hir::convert::Operand;
use crate::hir::model::*;
use crate::hir::scope::Local;
use crate::syntax::ast::{self, ExprKind as E};
use takt_base::{Code, Diag, Span};
use takt_image::types::{Section, Type};

/// The value in front of the point.
pub(super) struct Object {
    pub receiver: Receiver,
    pub ty: PouId,
    /// The instance decides which method runs.
    pub dynamic: bool,
    /// SUPER.
    pub is_super: bool,
}

impl Builder<'_> {
    /// The call of a method as an expression; `None` if the callee is something else.
    pub(in crate::hir) fn method_call(&mut self, callee: &ast::Expr, args: &[ast::Arg], span: Span) -> Option<Operand> {
        match &callee.kind {
            E::Name(name) => {
                let own = self.own_type().filter(|_| !self.is_local_variable(name))?;
                let method = self.find_method(own, &name.key())?;
                let object = self.this_object(name.span)?;
                Some(self.call_on(object, method, name, args, span))
            }
            E::Member(base, name) => match self.object(base, name)? {
                Some(object) => Some(self.named_method(object, name, args, span)),
                None => Some(self.bad_call(args, span)),
            },
            _ => None,
        }
    }

    /// A variable of the unit, but not the result of the running method, which shares its name.
    fn is_local_variable(&self, name: &ast::Name) -> bool {
        match (self.local(&name.key()), self.scope.pou) {
            (Some(Local::Var(v)), Some(p)) => self.hir.pous[p].result != Some(v),
            (found, _) => found.is_some(),
        }
    }

    /// The object in front of `.name`. `None`: this is no matter of objects; `Some(None)`: reported.
    pub(super) fn object(&mut self, base: &ast::Expr, name: &ast::Name) -> Option<Option<Object>> {
        if let E::Name(n) = &base.kind {
            if n.is("SUPER") && self.local("SUPER").is_none() {
                return Some(self.super_object(n.span));
            }
            if !self.names_variable(n) && !self.is_own_property(n) {
                return None;
            }
        }
        if self.is_value(base) {
            let o = self.operand(base, None);
            if self.is_bad(&o) {
                return Some(None);
            }
            let ty = self.type_unit(o.expr.ty)?;
            let receiver = match (self.ty(o.expr.ty), o.expr.kind) {
                (Type::Reference { .. }, kind) => Receiver::Reference(Expr { kind, ..o.expr }),
                (_, ExprKind::Load(place)) => Receiver::Place(place),
                _ => return None,
            };
            return Some(Some(Object { receiver, ty, dynamic: true, is_super: false }));
        }
        let Some(target) = self.place(base) else { return Some(None) };
        let place = target.place;
        if let Type::Instance(r) = self.ty(place.ty)
            && r.fields.iter().any(|f| name.is(&f.name) && f.section != Section::Hidden)
        {
            return None; // a variable of the instance
        }
        let ty = self.type_unit(place.ty)?;
        if let Type::Reference { .. } = self.ty(place.ty) {
            if let (Base::Var(v), [], Some(pou)) = (&place.base, &place.path[..], self.scope.pou) {
                self.objects.called.push((pou, *v, base.span));
            }
            let (ty_id, span) = (place.ty, base.span);
            let value = Expr { kind: ExprKind::Load(place), ty: ty_id, span };
            return Some(Some(Object { receiver: Receiver::Reference(value), ty, dynamic: true, is_super: false }));
        }
        let dynamic = self.is_dynamic(&place);
        Some(Some(Object { receiver: Receiver::Place(place), ty, dynamic, is_super: false }))
    }

    /// True for an expression that is computed, so that it has no place.
    fn is_value(&self, e: &ast::Expr) -> bool {
        matches!(e.kind, E::Call { .. }) || self.may_be_property(e) && self.property_of(e).is_some()
    }

    /// True if another type than the static one can be found at the place: it was handed over, or is the running instance.
    pub(in crate::hir) fn is_dynamic(&self, place: &Place) -> bool {
        match (place.path.last(), &place.base) {
            (Some(Step::Field(_) | Step::Index(_)), _) => false,
            (None, Base::Global(_) | Base::Image(_)) => false,
            (None, Base::Var(v)) => self.scope.pou.is_some_and(|p| self.hir.pous[p].vars[*v].role == Role::InOut),
            _ => true,
        }
    }

    /// The running instance.
    pub(super) fn this_object(&mut self, span: Span) -> Option<Object> {
        let ty = self.own_type()?;
        let place = Place { base: Base::This, path: Vec::new(), ty: self.hir.pous[ty].instance?, span };
        Some(Object { receiver: Receiver::Place(place), ty, dynamic: true, is_super: false })
    }

    fn super_object(&mut self, span: Span) -> Option<Object> {
        let this = self.base_object(span)?;
        Some(Object { dynamic: false, is_super: true, ..this })
    }

    /// The running instance as one of its base type; reports if there is none.
    pub(super) fn base_object(&mut self, span: Span) -> Option<Object> {
        let Some(own) = self.own_type() else {
            self.no_this(span, "SUPER");
            return None;
        };
        let Some(base) = self.hir.pous[own].base else {
            let label = format!("`{}` extends nothing", self.hir.pous[own].name);
            if self.symbols.pous[own].decl.objects.extends.is_empty() {
                self.report(Diag::new(Code::NoBase, span, label).help("THIS is the running instance itself"));
            }
            return None;
        };
        let place = Place { base: Base::This, path: Vec::new(), ty: self.hir.pous[base].instance?, span };
        Some(Object { receiver: Receiver::Place(place), ty: base, dynamic: false, is_super: true })
    }

    pub(super) fn no_this(&mut self, span: Span, word: &str) {
        let label = format!("{word} in a function");
        self.report(Diag::new(Code::NoThis, span, label).help("it names the running instance of a function block or class"));
    }

    fn named_method(&mut self, object: Object, name: &ast::Name, args: &[ast::Arg], span: Span) -> Operand {
        match self.find_method(object.ty, &name.key()) {
            Some(method) => self.call_on(object, method, name, args, span),
            None => {
                self.no_method(object.ty, name);
                self.bad_call(args, span)
            }
        }
    }

    fn no_method(&mut self, ty: PouId, name: &ast::Name) {
        let known = self.method_names(ty);
        let label = format!("`{}` has no such method", self.hir.pous[ty].name);
        let mut diag = Diag::new(Code::UnknownMethod, name.span, label);
        if let Some(near) = takt_base::nearest(&name.text, known.iter().map(String::as_str)) {
            diag = diag.help(format!("did you mean `{near}`?"));
        }
        self.report(diag);
    }

    /// The call itself.
    pub(super) fn call_on(&mut self, object: Object, method: PouId, name: &ast::Name, args: &[ast::Arg], span: Span) -> Operand {
        self.ensure_pou(method, span);
        if !self.check_method_access(method, name) {
            return self.bad_call(args, span);
        }
        let declared = self.declared_enable(method);
        match self.enable(args, declared) {
            None => self.bound_call(object, method, name, args, span),
            Some(enable) => {
                let call = self.bound_call(object, method, name, &enable.rest, span);
                self.guarded(call, enable.en, enable.eno, declared)
            }
        }
    }

    fn bound_call(&mut self, object: Object, method: PouId, name: &ast::Name, args: &[ast::Arg], span: Span) -> Operand {
        let Some(args) = self.user_arguments(method, args, span) else { return self.bad(span) };
        let ty = self.type_of_result(method);
        if ty == self.error {
            return self.bad(span);
        }
        let accessor = self.symbols.pous[method].decl.objects.accessor;
        let dynamic = if object.dynamic { self.dispatch(object.ty, &key(name, accessor)) } else { Vec::new() };
        if object.is_super && self.is_signature(method) {
            let at = self.symbols.pous[method].decl.name.span;
            self.report(Diag::new(Code::AbstractMethod, span, "has no body").also(at, "declared"));
            return self.bad(span);
        }
        let reference = matches!(object.receiver, Receiver::Reference(_));
        let dynamic = if dynamic.is_empty() && (reference || self.is_signature(method)) { vec![(0, method)] } else { dynamic };
        let call = MethodCall { receiver: object.receiver, method, dynamic, args };
        self.note_targets(&call, span);
        Operand::fixed(Expr { kind: ExprKind::CallMethod(Box::new(call)), ty, span })
    }

    fn note_targets(&mut self, call: &MethodCall, span: Span) {
        match call.targets()[..] {
            [one] if matches!(call.receiver, Receiver::Place(_)) => self.note_call(one, span),
            _ => {
                let from = self.scope.pou;
                let targets = call.targets();
                self.objects.dynamic_calls.extend(targets.into_iter().map(|to| (from, to, span)));
            }
        }
    }
}
