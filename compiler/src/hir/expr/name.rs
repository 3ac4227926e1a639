//! Names in expressions: variables and enumerators (§2.5, §3.10).

use crate::hir::builder::Builder;
use crate::hir::convert::{Operand, constant_expr};
use crate::hir::model::*;
use crate::hir::symbols::Unit;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;
use takt_image::types::Type;

impl Builder<'_> {
    /// A variable, or an enumerator; the variable wins.
    pub(super) fn name(&mut self, n: &ast::Name, want: Option<TypeId>) -> Operand {
        if let Some((_, ty, value)) = self.scope.values.iter().find(|v| n.is(&v.0)) {
            return Operand::fixed(constant_expr(Const::Int(*value), *ty, n.span));
        }
        if self.local(&n.key()).is_none()
            && let Some(o) = self.bare_enumerator(n, want)
        {
            return o;
        }
        let place = ast::Expr { kind: ast::ExprKind::Name(n.clone()), span: n.span };
        let o = self.read(&place);
        match want.and_then(|ty| self.this_pointer(n, &o, ty)) {
            Some(pointer) => pointer,
            None => o,
        }
    }

    /// THIS where a pointer is wanted (vendor): its address.
    fn this_pointer(&mut self, n: &ast::Name, o: &Operand, want: TypeId) -> Option<Operand> {
        self.pointee(want)?;
        let ExprKind::Load(place) = &o.expr.kind else { return None };
        if !self.is_this(n) || !self.profile(n.span).is_codesys() {
            return None;
        }
        let ty = self.pointer_to(takt_image::types::PointerKind::RefTo, place.ty);
        Some(Operand::fixed(Expr { kind: ExprKind::Address(place.clone()), ty, span: n.span }))
    }

    /// True if the name can only be an enumerator, which needs the context to be understood.
    pub fn is_enumerator(&self, e: &ast::Expr) -> bool {
        match &e.kind {
            ast::ExprKind::Name(n) => self.local(&n.key()).is_none() && self.symbols.enumerators.contains_key(&n.key()),
            _ => false,
        }
    }

    fn bare_enumerator(&mut self, n: &ast::Name, want: Option<TypeId>) -> Option<Operand> {
        if let Some(o) = want.and_then(|ty| self.value_of(ty, n, n.span)) {
            return Some(o);
        }
        let declared = self.visible_enums(n);
        let mut types: Vec<TypeId> = declared.into_iter().map(|index| self.declared_type(index, n.span).ty).collect();
        types.extend(self.scope.enums.iter().chain(&self.global_enums));
        let mut found: Vec<Operand> = types.into_iter().filter_map(|ty| self.value_of(ty, n, n.span)).collect();
        match found.len() {
            0 => None,
            1 => found.pop(),
            _ => Some(self.ambiguous(n, &found)),
        }
    }

    /// The declared enumerations of which `n` may be a value here.
    fn visible_enums(&self, n: &ast::Name) -> Vec<usize> {
        let all = self.symbols.enumerators.get(&n.key()).into_iter().flatten();
        all.copied().filter(|index| self.is_visible(*index, n.span)).collect()
    }

    fn ambiguous(&mut self, n: &ast::Name, found: &[Operand]) -> Operand {
        let names: Vec<_> = found.iter().map(|o| self.show(o.expr.ty)).collect();
        let help = format!("write {}#{}", names[0], n.text);
        let label = format!("a value of {}", names.join(" and of "));
        self.report(Diag::new(Code::AmbiguousEnumerator, n.span, label).help(help));
        self.bad(n.span)
    }

    /// The value `n` of the enumeration `ty`, if it has it.
    fn value_of(&self, ty: TypeId, n: &ast::Name, span: Span) -> Option<Operand> {
        let Type::Enum { values, .. } = self.ty(ty) else { return None };
        let (_, value) = values.iter().find(|(v, _)| n.is(v))?;
        Some(Operand::fixed(constant_expr(Const::Int(*value), ty, span)))
    }

    /// `Light#Red`.
    pub(super) fn enumerator(&mut self, ty: &ast::Name, value: &ast::Name, span: Span) -> Operand {
        let found = self.named_type(ty).ty;
        if found == self.error {
            return self.bad(span);
        }
        if let Some(o) = self.value_of(found, value, span) {
            return o;
        }
        let known = match self.ty(found) {
            Type::Enum { values, .. } => values.iter().map(|v| v.0.clone()).collect(),
            _ => Vec::new(),
        };
        self.unknown(Code::UnknownMember, value, known);
        self.bad(span)
    }

    /// `Light.Red` (vendor form), if `Light` is a type and no variable.
    pub(super) fn enum_member(&mut self, base: &ast::Expr, value: &ast::Name, span: Span) -> Option<Operand> {
        let full = self.qualified(base);
        let n = match &base.kind {
            ast::ExprKind::Name(n) => n,
            _ => full.as_ref()?,
        };
        let variable = self.local(&n.key()).is_some() || self.global_id(n).is_some();
        let is_type = matches!(self.unit(n), Some((Unit::Type(_), _)));
        (is_type && !variable).then(|| self.enumerator(n, value, span))
    }
}
