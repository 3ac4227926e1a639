//! Enumerations and named values (§2.5). A plain enumeration is stored as INT and only compares; with a declared base its values are
//! numbers of that base.

use super::TypeUse;
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::convert::Flex;
use crate::hir::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// `(A, B := 5)`, `DWORD (A := 1)`.
    pub(super) fn enumeration(&mut self, name: String, decl: &ast::EnumDecl) -> TypeUse {
        let Some(base) = self.enum_base(decl) else { return self.bad_type() };
        let saved = std::mem::take(&mut self.scope.values);
        let values = self.enum_values(decl, base);
        self.scope.values = saved;
        if values.is_empty() {
            self.report(
                Diag::new(Code::BadInitializer, decl.span, "no values").message("an enumeration needs at least one value"),
            );
            return self.bad_type();
        }
        let first = values[0].1;
        let ty = self.hir.types.add(Type::Enum { name, base, values });
        self.defaults.insert(ty, constant::normal(Const::Int(first)));
        if decl.base.is_some() {
            self.named_values.insert(ty);
        }
        self.plain(ty)
    }

    /// An enumeration in a variable declaration; its values are known in the unit.
    pub(super) fn anonymous_enum(&mut self, decl: &ast::EnumDecl) -> TypeUse {
        let names: Vec<_> = decl.values.iter().map(|(n, _)| n.text.as_str()).collect();
        let result = self.enumeration(format!("({})", names.join(", ")), decl);
        if result.ty != self.error {
            let list = if self.scope.pou.is_some() { &mut self.scope.enums } else { &mut self.global_enums };
            list.push(result.ty);
        }
        result
    }

    fn enum_base(&mut self, decl: &ast::EnumDecl) -> Option<Elementary> {
        let Some(name) = &decl.base else { return Some(Elementary::Int) };
        let ty = self.named_type(name).ty;
        if ty == self.error {
            return None;
        }
        let base = self.elementary(ty).filter(|e| e.is_int() || e.is_bit());
        if base.is_none() {
            let label = self.show(ty);
            let message = "the base of an enumeration is an integer or a bit string";
            self.report(Diag::new(Code::BadOperand, name.span, label).message(message));
        }
        base
    }

    fn enum_values(&mut self, decl: &ast::EnumDecl, base: Elementary) -> Vec<(String, i128)> {
        let want = self.elem(base);
        let mut next = 0;
        for (name, explicit) in &decl.values {
            if let Some((first, ..)) = self.scope.values.iter().find(|v| name.is(&v.0)) {
                let label = format!("`{first}` stands before");
                self.error(Code::DuplicateName, name.span, label);
                continue;
            }
            let value = explicit.as_ref().map_or(Some(next), |e| self.enum_value(e, want)).unwrap_or(next);
            if !base.int_range().is_some_and(|(low, high)| (low..=high).contains(&value)) {
                let at = explicit.as_ref().map_or(name.span, |e| e.span);
                self.error(Code::OutOfRange, at, format!("{value} is no {}", base.name()));
            }
            self.scope.values.push((name.text.clone(), want, value));
            next = value.saturating_add(1);
        }
        std::mem::take(&mut self.scope.values).into_iter().map(|(name, _, value)| (name, value)).collect()
    }

    /// An untyped integer is a number here even if the base is a bit string.
    fn enum_value(&mut self, e: &ast::Expr, base: TypeId) -> Option<i128> {
        let o = self.operand(e, Some(base));
        match (o.flex, &o.expr.kind) {
            (Flex::Int { .. }, ExprKind::Const(c)) => constant::int(c),
            _ => {
                let value = self.fit(o, base);
                self.int_value(&value)
            }
        }
    }
}
