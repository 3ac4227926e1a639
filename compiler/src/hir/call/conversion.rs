//! Conversion functions: `INT_TO_REAL`, `TO_REAL`, `TRUNC_INT` (library reference §2).

use crate::hir::builder::Builder;
use crate::hir::constant::{self, FoldError};
use crate::hir::convert::Operand;
use crate::hir::model::*;
use takt_base::{Code, Diag, Profile, Span};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};
use takt_stdlib::catalog::Intrinsic;
use takt_stdlib::lookup::{converts, transfers_bits, truncates};
use takt_stdlib::{ConversionType, natives::native_conversion_in};

/// Capacity of the text of a scalar.
const TEXT_CAPACITY: u32 = 64;

impl Builder<'_> {
    /// `from`: what the name says; `None`: the type of the argument.
    pub(super) fn conversion(
        &mut self,
        from: Option<ConversionType>,
        to: ConversionType,
        truncate: bool,
        args: Vec<Operand>,
        span: Span,
    ) -> Operand {
        let Some(arg) = args.into_iter().next() else { return self.bad(span) };
        let arg = match from {
            Some(from) => self.as_source(arg, from),
            None => {
                let arg = self.decay(arg);
                self.settle(arg)
            }
        };
        if arg.ty == self.error {
            return self.bad(span);
        }
        let Some(source) = self.conversion_type(&arg) else { return self.no_conversion(&arg, to, span) };
        let known = if truncate { truncates(source, to) } else { converts(source, to) };
        let other_width = self.is_transfer_of_other_width(source, to, span);
        if other_width || from.is_none() && !known && source != to {
            return self.no_conversion(&arg, to, span);
        }
        let expr = self.convert_to(arg, source, to, truncate);
        Operand::fixed(Expr { span, ..expr })
    }

    /// Real and bit string of another width: the standard has no such conversion.
    fn is_transfer_of_other_width(&self, from: ConversionType, to: ConversionType, span: Span) -> bool {
        match (from, to) {
            (ConversionType::Elementary(a), ConversionType::Elementary(b)) => {
                transfers_bits(a, b) && a.bytes() != b.bytes() && !self.profile(span).converts_bits_as_numbers()
            }
            _ => false,
        }
    }

    /// The argument in the type that the name says; a string of any capacity.
    fn as_source(&mut self, arg: Operand, from: ConversionType) -> Expr {
        match from {
            ConversionType::Elementary(e) => {
                let to = self.elem(e);
                self.fit(arg, to)
            }
            ConversionType::String | ConversionType::WString => {
                let arg = self.as_string(arg);
                if self.conversion_type(&arg.expr) == Some(from) {
                    return arg.expr;
                }
                let label = format!("{}, {} wanted", self.show(arg.expr.ty), from.name());
                self.error(Code::TypeMismatch, arg.expr.span, label);
                self.bad(arg.expr.span).expr
            }
        }
    }

    fn conversion_type(&self, e: &Expr) -> Option<ConversionType> {
        match self.ty(e.ty) {
            Type::Elementary(e) | Type::Enum { base: e, .. } => Some(ConversionType::Elementary(*e)),
            Type::String { .. } => Some(ConversionType::String),
            Type::WString { .. } => Some(ConversionType::WString),
            _ => None,
        }
    }

    fn no_conversion(&mut self, arg: &Expr, to: ConversionType, span: Span) -> Operand {
        let label = format!("{} to {}", self.show(arg.ty), to.name());
        self.report(Diag::new(Code::TypeMismatch, span, label).message("there is no conversion between these types"));
        self.bad(span)
    }

    pub(in crate::hir) fn convert_to(&mut self, arg: Expr, from: ConversionType, to: ConversionType, truncate: bool) -> Expr {
        let (span, source) = (arg.span, arg.ty);
        let ty = self.target_type(source, to);
        if from == to && source == ty {
            return arg;
        }
        if let Some(name) = native_conversion_in(self.profile(span), from, to).filter(|_| !truncate) {
            return self.native(name, vec![arg], ty, span).expr;
        }
        match (from, to) {
            (ConversionType::Elementary(a), ConversionType::Elementary(b)) if truncate && a.is_real() && b.is_int() => {
                self.intrinsic(Intrinsic::Trunc, vec![arg], ty, span).expr
            }
            (ConversionType::Elementary(a), ConversionType::Elementary(b))
                if !self.unfolded && loses(&arg, a, b, self.profile(span)) =>
            {
                self.fold_error(FoldError::Overflow, span).expr
            }
            (ConversionType::Elementary(a), ConversionType::Elementary(b)) => {
                let how = inline(self.profile(span), a, b);
                self.wrap(how, arg, ty)
            }
            _ => self.wrap(Conversion::String, arg, ty),
        }
    }

    fn target_type(&mut self, source: TypeId, to: ConversionType) -> TypeId {
        let capacity = match self.ty(source) {
            Type::String { capacity } | Type::WString { capacity } => *capacity,
            _ => TEXT_CAPACITY,
        };
        let ty = match to {
            ConversionType::Elementary(e) => Type::Elementary(e),
            ConversionType::String => Type::String { capacity },
            ConversionType::WString => Type::WString { capacity },
        };
        self.hir.types.intern(ty)
    }
}

/// True for a constant number that the target can't hold; bits may be cut.
fn loses(arg: &Expr, from: Elementary, to: Elementary, profile: Profile) -> bool {
    let ExprKind::Const(c) = &arg.kind else { return false };
    match (constant::int(c), constant::real(c)) {
        (Some(value), _) if from.is_int() && to.is_int() => constant::checked(to, value).is_err(),
        (_, Some(value)) if to.is_int() => super::fold::real_to_int(rounded(value, profile), to).is_err(),
        (_, Some(value)) if to == Elementary::Real => value.is_finite() && (value as f32).is_infinite(),
        _ => false,
    }
}

/// To the nearest integer.
fn rounded(value: f64, profile: Profile) -> f64 {
    if profile.rounds_half_away() { value.round() } else { value.round_ties_even() }
}

/// How the compiler converts between scalars by itself (library reference §2.1, §2.6).
fn inline(profile: Profile, from: Elementary, to: Elementary) -> Conversion {
    let transfers = !profile.converts_bits_as_numbers();
    match (from, to) {
        (_, Elementary::Bool) if from.is_bit() && !profile.bits_to_bool_is_nonzero() => Conversion::LowBit,
        (_, Elementary::Bool) => Conversion::NonZero,
        _ if from.is_real() && to.is_real() => Conversion::Real,
        _ if from.is_real() && to.is_bit() && transfers => Conversion::Bits,
        _ if from.is_bit() && to.is_real() && from != Elementary::Bool && transfers => Conversion::Bits,
        _ if from.is_real() && profile.rounds_half_away() => Conversion::RealToIntAway,
        _ if from.is_real() => Conversion::RealToInt,
        _ if to.is_real() => Conversion::IntToReal,
        _ if from.is_signed_int() && to.is_bit() && to.bits() > from.bits() && transfers => Conversion::ZeroExtend,
        _ => Conversion::Integer,
    }
}
