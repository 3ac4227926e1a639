//! Inline functions that are others in the dialects of vendors: MUX, LIMIT, durations times and by numbers (library reference §6, §8).

use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::convert::Operand;
use crate::hir::model::*;
use takt_base::{Profile, Span};
use takt_image::{Elementary, TypeId};
use takt_stdlib::catalog::Intrinsic;

impl Builder<'_> {
    /// A call of an inline function as the profile of its file means it.
    pub(super) fn in_profile(&mut self, i: Intrinsic, args: Vec<Expr>, ty: TypeId, span: Span) -> Operand {
        let profile = self.profile(span);
        if let Some(name) = self.whole_milliseconds(i, &args, profile) {
            return self.native(name.to_owned(), args, ty, span);
        }
        let i = match i {
            Intrinsic::Mux if profile.is_codesys() => Intrinsic::MuxLast,
            Intrinsic::Limit if profile == Profile::OpenPlc => Intrinsic::LimitLow,
            i => i,
        };
        self.intrinsic(i, args, ty, span)
    }

    /// The native of MUL_TIME or DIV_TIME where TIME counts milliseconds; a constant divisor of zero is none of its cases.
    fn whole_milliseconds(&self, i: Intrinsic, args: &[Expr], profile: Profile) -> Option<&'static str> {
        let [time, factor] = args else { return None };
        if !profile.has_millisecond_time() || self.elementary(time.ty) != Some(Elementary::Time) {
            return None;
        }
        let zero = matches!(&factor.kind, ExprKind::Const(c) if constant::is_zero(c));
        match (i, self.elementary(factor.ty)?.is_real()) {
            (Intrinsic::Mul, true) => Some("MUL_TIME_LREAL_CODESYS"),
            (Intrinsic::Div, true) if !zero => Some("DIV_TIME_LREAL_CODESYS"),
            (Intrinsic::Div, false) if !zero => Some("DIV_TIME_LINT_CODESYS"),
            _ => None,
        }
    }
}
