//! Parameters of standard functions: the types that ANY, ANY_NUM and the like stand for in a call, and the conversions to them (§1.5).

use crate::hir::builder::Builder;
use crate::hir::convert::{Flex, Operand};
use crate::hir::model::*;
use takt_base::{Code, Diag, Span};
use takt_image::types::Type;
use takt_image::{Elementary, Generic, TypeId};
use takt_stdlib::catalog::{Function, Intrinsic, Lowering, Pattern};

impl Builder<'_> {
    /// Every argument in the type of its parameter.
    pub(super) fn fit_parameters(
        &mut self,
        f: &Function,
        fixed: Option<TypeId>,
        args: Vec<Operand>,
        span: Span,
        want: Option<TypeId>,
    ) -> Option<Vec<Expr>> {
        let shared: Vec<_> =
            args.iter().enumerate().filter(|(i, _)| matches!(pattern(f, *i), Pattern::T(_))).map(|(_, a)| a.clone()).collect();
        let common = match (fixed, f.group()) {
            (Some(ty), _) => Some(ty),
            (None, Some(group)) => Some(self.common_type(f, group, &shared, span, want)?),
            (None, None) => None,
        };
        let mut out = Vec::with_capacity(args.len());
        for (i, arg) in args.into_iter().enumerate() {
            let e = match pattern(f, i) {
                Pattern::Is(e) => {
                    let to = self.elem(e);
                    self.fit(arg, to)
                }
                Pattern::T(_) => self.fit_common(arg, common?),
                Pattern::Own(group) => self.fit_own(f, group, arg, common)?,
            };
            if e.ty == self.error {
                return None;
            }
            out.push(e);
        }
        Some(out)
    }

    /// Strings keep their own capacity.
    fn fit_common(&mut self, arg: Operand, common: TypeId) -> Expr {
        if self.is_string(common) {
            let text = self.as_string(arg.clone());
            if self.is_string(text.expr.ty) {
                return text.expr;
            }
        }
        self.fit(arg, common)
    }

    /// A number of its own type: LINT, or LREAL beside a duration, or the type of the base of EXPT.
    fn fit_own(&mut self, f: &Function, group: Generic, arg: Operand, common: Option<TypeId>) -> Option<Expr> {
        let arg = self.decay(arg);
        if let (Lowering::Inline(Intrinsic::Expt), Some(base)) = (f.lowering, common) {
            return self.exponent(arg, base);
        }
        let (lint, lreal) = (self.elem(Elementary::Lint), self.elem(Elementary::Lreal));
        match (arg.flex, self.elementary(arg.expr.ty)) {
            (Flex::Int { .. }, _) => Some(self.fit(arg, lint)),
            (Flex::Real, _) if group != Generic::AnyInt => Some(self.fit(arg, lreal)),
            (Flex::Fixed, Some(e)) if self.counts(e, arg.expr.span) => Some(self.as_lint(arg.expr)),
            (Flex::Fixed, Some(Elementary::Lreal)) if group != Generic::AnyInt => Some(arg.expr),
            (Flex::Fixed, Some(Elementary::Real)) if group != Generic::AnyInt => {
                Some(self.wrap(Conversion::Real, arg.expr, lreal))
            }
            _ => {
                let wanted = if group == Generic::AnyInt { "an integer" } else { "a number" };
                let label = format!("{}, {wanted} wanted", self.show(arg.expr.ty));
                self.error(Code::TypeMismatch, arg.expr.span, label);
                None
            }
        }
    }

    /// The common type of the arguments that share one; a report if there is none or it is not in the group.
    fn common_type(
        &mut self,
        f: &Function,
        group: Generic,
        args: &[Operand],
        span: Span,
        want: Option<TypeId>,
    ) -> Option<TypeId> {
        let mut args = args.iter().cloned();
        let mut all = args.next()?;
        for next in args {
            let (a, b) = (all.expr.ty, next.expr.ty);
            let Some((x, y)) = self.unify(all, next, want) else {
                let label = format!("{} and {}", self.show(a), self.show(b));
                let help = "convert one of them: write for example DINT_TO_REAL(x)";
                self.report(Diag::new(Code::NoCommonType, span, label).help(help));
                return None;
            };
            all = if x.flex == Flex::Fixed || x.flex == y.flex { larger(self, x, y) } else { y };
        }
        let ty = self.group_type(group, &all, want);
        let fine = self.in_group(f, group, ty) || self.shifts_integer(f, ty, span);
        if !fine {
            let label = format!("`{}` of {}", f.name, self.show(ty));
            self.report(Diag::new(Code::BadOperand, span, label).help(group_help(group)));
        }
        fine.then_some(ty)
    }

    /// The type that the operands settle for: literals follow the wish of the context.
    fn group_type(&mut self, group: Generic, o: &Operand, want: Option<TypeId>) -> TypeId {
        let wanted = want.and_then(|w| self.elementary(w)).filter(|w| w.is_in(group));
        let whole = |e: &Elementary| e.is_int() || e.is_real() || e.is_bit();
        let e = match o.flex {
            Flex::Int { .. } => wanted.filter(whole).or((group == Generic::AnyReal).then_some(Elementary::Lreal)),
            Flex::Real => Some(wanted.filter(|w| w.is_real()).unwrap_or(Elementary::Lreal)),
            Flex::Text | Flex::Fixed => return self.raised(group, o),
        };
        match e {
            Some(e) => self.elem(e),
            None => self.settle(o.clone()).ty,
        }
    }

    /// A typed operand; an integer where a real is needed takes the smallest real that holds it.
    fn raised(&mut self, group: Generic, o: &Operand) -> TypeId {
        let o = if group == Generic::Any { o.clone() } else { self.decay(o.clone()) };
        let o = if group == Generic::AnyString { self.as_string(o) } else { o };
        let Some(e) = self.elementary(o.expr.ty).filter(|e| group == Generic::AnyReal && e.is_int()) else { return o.expr.ty };
        match [Elementary::Real, Elementary::Lreal].into_iter().find(|r| e.widens_to(*r)) {
            Some(real) => self.elem(real),
            None => o.expr.ty,
        }
    }

    /// The vendors shift integers as the bits that they are (library reference §5).
    fn shifts_integer(&self, f: &Function, ty: TypeId, span: Span) -> bool {
        use Intrinsic::{Rol, Ror, Shl, Shr};
        let shift = matches!(f.lowering, Lowering::Inline(Shl | Shr | Rol | Ror));
        shift && self.profile(span).is_vendor() && self.elementary(ty).is_some_and(Elementary::is_int)
    }

    fn in_group(&self, f: &Function, group: Generic, ty: TypeId) -> bool {
        let equality = matches!(f.lowering, Lowering::Inline(Intrinsic::Eq | Intrinsic::Ne));
        match self.ty(ty) {
            Type::Elementary(e) => e.is_in(group),
            Type::String { .. } | Type::WString { .. } => {
                matches!(group, Generic::AnyString | Generic::AnyElementary | Generic::Any)
            }
            Type::Enum { .. } => group == Generic::Any || equality,
            _ => group == Generic::Any,
        }
    }
}

/// The operand of the larger type, of strings the longer.
fn larger(b: &Builder, x: Operand, y: Operand) -> Operand {
    let size = |o: &Operand| b.hir.types.layout(o.expr.ty).size;
    if b.is_string(x.expr.ty) && size(&y) > size(&x) { y } else { x }
}

fn group_help(group: Generic) -> &'static str {
    match group {
        Generic::AnyReal => "it takes REAL or LREAL",
        Generic::AnyBit => "it takes BOOL or bit strings; a number needs its type, such as WORD#16#FF",
        Generic::AnyInt => "it takes integers",
        Generic::AnyNum => "it takes numbers",
        Generic::AnyMagnitude => "it takes numbers and durations",
        Generic::AnyString => "it takes strings",
        _ => "it takes elementary types",
    }
}

/// Pattern of the argument at a position.
pub(super) fn pattern(f: &Function, i: usize) -> Pattern {
    f.params.get(i).or(f.params.last()).map_or(Pattern::T(Generic::Any), |p| p.ty)
}
