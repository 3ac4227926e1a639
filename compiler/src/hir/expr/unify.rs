//! One type for two or more operands: the least upper bound of the conversion lattice (§2.3); literals follow the others.

use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::convert::{Flex, Operand};
use crate::hir::lattice;
use crate::hir::model::*;
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// Both operands in one type (strings may differ in capacity), or both still untyped. `None` if they have nothing in common.
    pub fn unify(&mut self, a: Operand, b: Operand, want: Option<TypeId>) -> Option<(Operand, Operand)> {
        match (a.flex, b.flex) {
            (Flex::Int { .. }, Flex::Int { .. }) | (Flex::Real, Flex::Real) => Some((a, b)),
            (Flex::Int { .. }, Flex::Real) => Some((self.as_real(a), b)),
            (Flex::Real, Flex::Int { .. }) => Some((a, self.as_real(b))),
            (Flex::Fixed, Flex::Fixed) => self.unify_fixed(a, b),
            (Flex::Fixed, _) => self.unify_literal(a, b, want),
            (_, Flex::Fixed) => self.unify_literal(b, a, want).map(|(b, a)| (a, b)),
            (Flex::Text, Flex::Text) => self.unify_fixed(a, b),
            _ => None,
        }
    }

    /// An untyped integer as an untyped real.
    fn as_real(&mut self, o: Operand) -> Operand {
        match &o.expr.kind {
            ExprKind::Const(c) => {
                let value = constant::int(c).unwrap_or(0) as f64;
                self.flex_real(value, o.expr.span)
            }
            _ => o,
        }
    }

    /// `literal` in the type that goes with the typed operand.
    fn unify_literal(&mut self, typed: Operand, literal: Operand, want: Option<TypeId>) -> Option<(Operand, Operand)> {
        let typed = self.decay(typed);
        let ty = typed.expr.ty;
        match (literal.flex, self.elementary(ty)) {
            (Flex::Int { .. }, Some(e)) if e.is_int() && self.outgrows(&literal, ty) => {
                let literal = Operand::fixed(self.settle(literal));
                self.unify_fixed(typed, literal)
            }
            (Flex::Int { .. }, Some(e)) if e.is_int() || e.is_real() || e.is_bit() => {
                Some((typed, Operand::fixed(self.fit(literal, ty))))
            }
            (Flex::Real, Some(e)) if e.is_int() || e.is_real() => {
                let real = self.real_for(e, want)?;
                let typed = self.fit(typed, real);
                Some((Operand::fixed(typed), Operand::fixed(self.fit(literal, real))))
            }
            (Flex::Text, Some(e)) if e.is_char() && self.fits(&literal, ty) => {
                Some((typed, Operand::fixed(self.fit(literal, ty))))
            }
            (Flex::Text, _) => self.unify_fixed(typed, Operand { flex: Flex::Fixed, ..literal }),
            _ => None,
        }
    }

    /// A number that the vendors compute in a wider type, because it does not fit the other operand's.
    fn outgrows(&mut self, literal: &Operand, ty: TypeId) -> bool {
        self.profile(literal.expr.span).is_vendor() && !self.fits(literal, ty)
    }

    /// The real type for a number of type `e` beside an untyped real: the wanted one if that will do.
    fn real_for(&mut self, e: Elementary, want: Option<TypeId>) -> Option<TypeId> {
        let wanted = want.and_then(|w| self.elementary(w)).filter(|w| w.is_real() && e.is_int() && e.widens_to(*w));
        let real = wanted.or_else(|| [Elementary::Real, Elementary::Lreal].into_iter().find(|r| e.widens_to(*r)))?;
        Some(self.elem(real))
    }

    fn unify_fixed(&mut self, a: Operand, b: Operand) -> Option<(Operand, Operand)> {
        if a.expr.ty == b.expr.ty {
            return Some((a, b));
        }
        if self.is_string(a.expr.ty) || self.is_string(b.expr.ty) {
            return self.unify_strings(a, b);
        }
        let (a, b) = (self.decay(a), self.decay(b));
        let (x, y) = (self.elementary(a.expr.ty)?, self.elementary(b.expr.ty)?);
        let common = lattice::common(self.profile(a.expr.span), x, y)?;
        let to = self.elem(common);
        Some((Operand::fixed(self.fit(a, to)), Operand::fixed(self.fit(b, to))))
    }

    fn unify_strings(&mut self, a: Operand, b: Operand) -> Option<(Operand, Operand)> {
        let wide = |b: &Self, ty| match b.ty(ty) {
            Type::String { .. } | Type::Elementary(Elementary::Char) => Some(false),
            Type::WString { .. } | Type::Elementary(Elementary::Wchar) => Some(true),
            _ => None,
        };
        let (wa, wb) = (wide(self, a.expr.ty)?, wide(self, b.expr.ty)?);
        (wa == wb).then(|| (self.as_string(a), self.as_string(b)))
    }

    /// A character as a string of one.
    pub fn as_string(&mut self, o: Operand) -> Operand {
        let ty = match self.ty(o.expr.ty) {
            Type::Elementary(Elementary::Char) => Type::String { capacity: 1 },
            Type::Elementary(Elementary::Wchar) => Type::WString { capacity: 1 },
            _ => return o,
        };
        let to = self.hir.types.intern(ty);
        Operand::fixed(self.wrap(Conversion::String, o.expr, to))
    }

    /// STRING or WSTRING.
    pub fn is_string(&self, ty: TypeId) -> bool {
        matches!(self.ty(ty), Type::String { .. } | Type::WString { .. })
    }
}
