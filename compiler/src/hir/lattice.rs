//! Which elementary types convert without a call, in each profile (§2.3). The standard's lattice is [`Elementary::widens_to`]; CODESYS
//! mixes bit strings with integers, computes in 32 bits at least, and lets a value be narrowed.

use super::builder::Builder;
use super::constant;
use super::model::*;
use crate::syntax::ast::BinaryOp;
use takt_base::{Profile, Span};
use takt_image::{Elementary as E, TypeId};
use takt_stdlib::catalog::Intrinsic;

/// How well a type stands where another is wanted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Fit {
    /// Every value is kept.
    Whole,
    /// Some values are cut: accepted with a warning.
    Narrowed,
    /// A duration and its number of milliseconds.
    Duration,
    No,
}

/// How `from` stands where `to` is wanted.
pub(super) fn fit(profile: Profile, from: E, to: E) -> Fit {
    if from.widens_to(to) {
        return Fit::Whole;
    }
    if !profile.mixes_bits_and_integers() {
        return Fit::No;
    }
    match (as_integer(from), as_integer(to)) {
        (Some(a), Some(b)) if a.widens_to(b) => Fit::Whole,
        (Some(_), Some(_)) => Fit::Narrowed,
        (Some(_), None) if to.is_real() => Fit::Whole,
        (None, None) if from == E::Lreal && to == E::Real => Fit::Narrowed,
        (Some(n), None) if to == E::Time && n.bits() == 32 => Fit::Duration,
        (None, Some(n)) if from == E::Time && n.bits() == 32 => Fit::Duration,
        _ => Fit::No,
    }
}

/// The type that operands of two types are brought to.
pub(super) fn common(profile: Profile, a: E, b: E) -> Option<E> {
    if !profile.mixes_bits_and_integers() || a == b {
        return a.common(b);
    }
    match (as_integer(a), as_integer(b)) {
        (Some(_), Some(_)) if a.is_bit() && b.is_bit() => a.common(b),
        (Some(x), Some(y)) => Some(x.common(y).unwrap_or(E::Lint)),
        (Some(_), None) if b.is_real() => Some(b),
        (None, Some(_)) if a.is_real() => Some(a),
        _ => a.common(b),
    }
}

/// An integer type as itself, a bit string as the unsigned integer of its width. BOOL is none.
fn as_integer(e: E) -> Option<E> {
    Some(match e {
        E::Byte => E::Usint,
        E::Word => E::Uint,
        E::Dword => E::Udint,
        E::Lword => E::Ulint,
        e if e.is_int() => e,
        _ => return None,
    })
}

/// True for operators whose result may need more bits than the operands have.
pub(super) fn grows(op: BinaryOp) -> bool {
    matches!(op, BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div | BinaryOp::Mod)
}

impl Builder<'_> {
    /// The operands of arithmetic as the vendors compute it: integers of less than 32 bits become DINT (§5.4).
    pub(super) fn promoted(&mut self, op: BinaryOp, a: Expr, b: Expr) -> (Expr, Expr) {
        let small = self.elementary(a.ty).is_some_and(|e| e.is_int() && e.bits() < 32);
        if !small || !grows(op) || !self.profile(a.span).is_vendor() || self.in_library(a.span) {
            return (a, b);
        }
        let dint = self.elem(E::Dint);
        (self.wrap(Conversion::Integer, a, dint), self.wrap(Conversion::Integer, b, dint))
    }

    /// True if an expression of the vendors' 32-bit arithmetic is made of values that all fit `to`: storing it there is no narrowing
    /// that the user could see.
    pub(super) fn is_made_of(&self, e: &Expr, to: E) -> bool {
        match &e.kind {
            _ if self
                .elementary(e.ty)
                .is_some_and(|t| as_integer(t).zip(as_integer(to)).is_some_and(|(a, b)| a.widens_to(b))) =>
            {
                true
            }
            ExprKind::Const(c) => constant::int(c).is_some_and(|v| constant::checked(to, v).is_ok()),
            ExprKind::Convert(Conversion::Integer | Conversion::Subrange, a) | ExprKind::Neg(a) => self.is_made_of(a, to),
            ExprKind::Binary(op, a, b) if grows(*op) => self.is_made_of(a, to) && self.is_made_of(b, to),
            ExprKind::Intrinsic(Intrinsic::Min | Intrinsic::Max | Intrinsic::Limit | Intrinsic::LimitLow, args) => {
                args.iter().all(|a| self.is_made_of(a, to))
            }
            ExprKind::Intrinsic(Intrinsic::Sel | Intrinsic::Mux | Intrinsic::MuxLast, args) => {
                args.iter().skip(1).all(|a| self.is_made_of(a, to))
            }
            _ => false,
        }
    }

    /// True for what counts: an integer, or a bit string where it is one (vendors).
    pub(super) fn counts(&self, e: E, span: Span) -> bool {
        e.is_int() || self.profile(span).mixes_bits_and_integers() && as_integer(e).is_some()
    }

    /// The operand of a sign as the vendors compute it: small integers and bit strings in a signed type that holds them.
    pub(super) fn signed(&mut self, e: Expr) -> Expr {
        let profile = self.profile(e.span);
        let wide =
            match self.elementary(e.ty) {
                Some(t) if profile.is_vendor() && t.is_int() && t.bits() < 32 => E::Dint,
                Some(t) if profile.mixes_bits_and_integers() && as_integer(t).is_some_and(E::is_unsigned_int) => {
                    if t.bits() < 32 { E::Dint } else { E::Lint }
                }
                _ => return e,
            };
        let to = self.elem(wide);
        self.wrap(Conversion::Integer, e, to)
    }

    /// A number or a bit string as BOOL (vendors): TRUE unless it is zero.
    pub(super) fn truth_of(&mut self, e: Expr) -> Option<Expr> {
        let number = self.elementary(e.ty).is_some_and(|t| as_integer(t).is_some());
        let bool: TypeId = self.bool();
        (number && self.profile(e.span).is_codesys()).then(|| self.wrap(Conversion::NonZero, e, bool))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codesys_mixes_what_the_standard_keeps_apart() {
        for (from, to, std, codesys) in [
            (E::Byte, E::Usint, Fit::No, Fit::Whole),
            (E::Byte, E::Int, Fit::No, Fit::Whole),
            (E::Int, E::Word, Fit::No, Fit::Narrowed),
            (E::Dint, E::Int, Fit::No, Fit::Narrowed),
            (E::Dint, E::Real, Fit::No, Fit::Whole),
            (E::Lreal, E::Real, Fit::No, Fit::Narrowed),
            (E::Real, E::Int, Fit::No, Fit::No),
            (E::Bool, E::Int, Fit::No, Fit::No),
            (E::Time, E::Dword, Fit::No, Fit::Duration),
            (E::Udint, E::Time, Fit::No, Fit::Duration),
            (E::Sint, E::Int, Fit::Whole, Fit::Whole),
        ] {
            assert_eq!(fit(Profile::Std, from, to), std, "{from:?} {to:?}");
            assert_eq!(fit(Profile::Codesys, from, to), codesys, "{from:?} {to:?}");
        }
    }

    #[test]
    fn common_types_of_mixed_operands() {
        for (a, b, std, codesys) in [
            (E::Byte, E::Word, Some(E::Word), Some(E::Word)),
            (E::Byte, E::Int, None, Some(E::Int)),
            (E::Dword, E::Int, None, Some(E::Lint)),
            (E::Lint, E::Ulint, None, Some(E::Lint)),
            (E::Dint, E::Real, Some(E::Lreal), Some(E::Real)),
            (E::Dword, E::Real, None, Some(E::Real)),
            (E::Bool, E::Int, None, None),
        ] {
            assert_eq!((common(Profile::Std, a, b), common(Profile::Std, b, a)), (std, std), "{a:?} {b:?}");
            assert_eq!((common(Profile::Codesys2, a, b), common(Profile::Codesys2, b, a)), (codesys, codesys), "{a:?} {b:?}");
        }
    }
}
