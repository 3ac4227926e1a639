//! Calls of standard functions: arguments in order, the common type T of those that share it, result type (library reference §1, §13).

use super::generic::pattern;
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::convert::{Flex, Operand, constant_expr};
use crate::hir::model::*;
use crate::hir::types::STRING_MAX;
use crate::syntax::ast::{self, BinaryOp};
use takt_base::{Code, Diag, Span};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId, natives::MAX_SLOTS};
use takt_stdlib::catalog::{Function, Intrinsic, Lowering, Pattern};
use takt_stdlib::{ConversionType, Found, vendor};

/// Most inputs of an extensible function.
const INPUTS_MAX: usize = 64;
/// Most strings of a native call: two slots each, and two for the result.
const STRINGS_MAX: usize = MAX_SLOTS / 2 - 1;

impl Builder<'_> {
    /// A call as it is written.
    pub(super) fn call_standard(
        &mut self,
        found: Found,
        name: &ast::Name,
        args: &[ast::Arg],
        span: Span,
        want: Option<TypeId>,
    ) -> Operand {
        let guards = std::mem::take(&mut self.guards_next);
        let Some(exprs) = self.standard_arguments(found, name, args, span) else { return self.bad(span) };
        let hints: Vec<_> = (0..exprs.len()).map(|i| self.hint(found, i, want)).collect();
        let args: Vec<_> = exprs.into_iter().zip(hints).map(|(e, hint)| self.operand(e, hint)).collect();
        self.unfolded = guards;
        let call = self.apply(found, args, span, want);
        self.unfolded = false;
        call
    }

    /// What the parameter at a position wants, as far as the name says it.
    fn hint(&mut self, found: Found, i: usize, want: Option<TypeId>) -> Option<TypeId> {
        match found {
            Found::Conversion { from: Some(ConversionType::Elementary(e)), .. } => Some(self.elem(e)),
            Found::Conversion { .. } => None,
            Found::Function { function, fixed } => match (pattern(function, i), fixed) {
                (Pattern::Is(e), _) | (Pattern::T(_), Some(e)) => Some(self.elem(e)),
                (Pattern::T(_), None) if matches!(function.result, Pattern::T(_)) => want,
                _ => None,
            },
        }
    }

    /// The arguments in the order of the parameters.
    fn standard_arguments<'t>(
        &mut self,
        found: Found,
        name: &ast::Name,
        args: &'t [ast::Arg],
        span: Span,
    ) -> Option<Vec<&'t ast::Expr>> {
        let mut slots: Vec<Option<&'t ast::Expr>> = Vec::new();
        for (position, arg) in args.iter().enumerate() {
            let (slot, value) = match arg {
                ast::Arg::Positional(e) => (position, e),
                ast::Arg::Input { name: formal, value: Some(e) } => (self.formal(found, formal)?, e),
                ast::Arg::Input { name: formal, value: None } => {
                    self.formal(found, formal)?;
                    self.error(Code::WrongArgumentCount, formal.span, "no value");
                    return None;
                }
                ast::Arg::Output { name: formal, .. } => {
                    self.formal(found, formal)?;
                    self.report(Diag::new(Code::UnknownParameter, formal.span, "an input").help("write `name := value`"));
                    return None;
                }
            };
            slots.resize(slots.len().max(slot + 1), None);
            if slots[slot].replace(value).is_some() {
                self.error(Code::WrongArgumentCount, value.span, "given twice");
                return None;
            }
        }
        let count = slots.len();
        let exprs: Vec<_> = slots.into_iter().flatten().collect();
        let (least, most) = arity(found);
        if exprs.len() != count || exprs.len() < least || exprs.len() > most {
            let wanted = if least == most { least.to_string() } else { format!("{least} to {most}") };
            let label = format!("{} given, `{}` takes {wanted}", exprs.len(), name.text);
            self.error(Code::WrongArgumentCount, span, label);
            return None;
        }
        Some(exprs)
    }

    /// Position of a formal name; those of an extensible function count up.
    fn formal(&mut self, found: Found, formal: &ast::Name) -> Option<usize> {
        let position = match found {
            Found::Conversion { .. } => formal.is("IN").then_some(0),
            Found::Function { function, .. } => {
                let fixed = function.params.iter().position(|p| formal.is(p.name));
                let fixed = fixed.or_else(|| vendor::input(function.name, &formal.key(), self.profile(formal.span)));
                fixed.or_else(|| function.extensible.then(|| counted(function, formal)).flatten())
            }
        };
        if position.is_none() {
            match found {
                Found::Function { function, .. } => {
                    let known = function.params.iter().map(|p| p.name.to_owned()).collect();
                    self.unknown(Code::UnknownParameter, formal, known);
                }
                Found::Conversion { .. } => self.unknown(Code::UnknownParameter, formal, vec!["IN".to_owned()]),
            }
        }
        position
    }

    /// The function applied to operands in order.
    pub fn apply(&mut self, found: Found, args: Vec<Operand>, span: Span, want: Option<TypeId>) -> Operand {
        if args.iter().any(|a| self.is_bad(a)) {
            return self.bad(span);
        }
        match found {
            Found::Conversion { from, to, truncate } => self.conversion(from, to, truncate, args, span),
            Found::Function { function, fixed } => {
                let fixed = fixed.map(|e| self.elem(e));
                self.apply_function(function, fixed, args, span, want)
            }
        }
    }

    fn apply_function(
        &mut self,
        f: &Function,
        fixed: Option<TypeId>,
        args: Vec<Operand>,
        span: Span,
        want: Option<TypeId>,
    ) -> Operand {
        let operator = match f.lowering {
            Lowering::Inline(i) if f.group().is_some() => operator_of(i, args.len()),
            _ => None,
        };
        let untyped = self.unfolded && args.iter().all(|a| a.flex != Flex::Fixed);
        if let (Some(op), None, false) = (operator, fixed, untyped) {
            return self.apply_operator(op, args, span, want);
        }
        if let Some(shifted) = self.shift_of_integer(f, &args, span) {
            return shifted;
        }
        // What the context wants of the result says something about the inputs only if they are of one type.
        let shared = want.filter(|_| matches!(f.result, Pattern::T(_)));
        let Some(args) = self.fit_parameters(f, fixed, args, span, shared) else { return self.bad(span) };
        if let Some(op) = operator {
            return self.apply_operator(op, args.into_iter().map(Operand::fixed).collect(), span, fixed);
        }
        let common = f.params.iter().zip(&args).find(|(p, _)| matches!(p.ty, Pattern::T(_))).map(|(_, a)| a.ty);
        let ty = self.result_type(f, common, &args, want);
        self.finish(f, args, ty, span)
    }

    /// SHL, SHR, ROL and ROR of an integer (vendor): of its bits, and an integer again. `None` if it is no such case.
    fn shift_of_integer(&mut self, f: &Function, args: &[Operand], span: Span) -> Option<Operand> {
        let shifts = [Intrinsic::Shl, Intrinsic::Shr, Intrinsic::Rol, Intrinsic::Ror].map(Lowering::Inline);
        let (first, rest) = args.split_first().filter(|_| shifts.contains(&f.lowering) && self.profile(span).is_codesys())?;
        let first = self.decay(first.clone());
        let value = self.settle(first);
        let integer = self.elementary(value.ty).filter(|e| e.is_int())?;
        let bits = match integer.bits() {
            8 => Elementary::Byte,
            16 => Elementary::Word,
            32 => Elementary::Dword,
            _ => Elementary::Lword,
        };
        let (to, back) = (self.elem(bits), value.ty);
        let value = Operand::fixed(self.wrap(Conversion::Integer, value, to));
        let args = std::iter::once(value).chain(rest.iter().cloned()).collect();
        let shifted = self.apply_function(f, None, args, span, None);
        Some(if self.is_bad(&shifted) { shifted } else { Operand::fixed(self.wrap(Conversion::Integer, shifted.expr, back)) })
    }

    /// ADD(a, b, c) is a + b + c.
    fn apply_operator(&mut self, op: BinaryOp, args: Vec<Operand>, span: Span, want: Option<TypeId>) -> Operand {
        let mut args = args.into_iter();
        let Some(first) = args.next() else { return self.bad(span) };
        args.fold(first, |a, b| self.combine(op, a, b, span, want))
    }

    fn result_type(&mut self, f: &Function, common: Option<TypeId>, args: &[Expr], want: Option<TypeId>) -> TypeId {
        match f.result {
            Pattern::Is(e) => self.elem(e),
            Pattern::Own(_) => {
                let wanted = want.and_then(|w| self.elementary(w)).filter(|e| e.is_int());
                self.elem(wanted.unwrap_or(Elementary::Dint))
            }
            Pattern::T(_) => match common {
                Some(ty) if self.is_string(ty) => self.text_result(f, args),
                Some(ty) => ty,
                None => self.error,
            },
        }
    }

    /// A string that holds the result: of a selection the longest input, of the others all inputs together.
    fn text_result(&mut self, f: &Function, args: &[Expr]) -> TypeId {
        let (mut sum, mut longest, mut wide) = (0u32, 1u32, false);
        for arg in args {
            let (capacity, is_wide) = match self.ty(arg.ty) {
                Type::String { capacity } => (*capacity, false),
                Type::WString { capacity } => (*capacity, true),
                _ => continue,
            };
            (sum, longest, wide) = (sum.saturating_add(capacity), longest.max(capacity), is_wide);
        }
        let capacity = if f.lowering == Lowering::Native { sum.clamp(1, STRING_MAX) } else { longest };
        self.hir.types.intern(if wide { Type::WString { capacity } } else { Type::String { capacity } })
    }

    fn finish(&mut self, f: &Function, args: Vec<Expr>, ty: TypeId, span: Span) -> Operand {
        if matches!(f.lowering, Lowering::Inline(Intrinsic::Shl | Intrinsic::Shr)) {
            self.check_shift(&args);
        }
        match f.lowering {
            Lowering::Inline(Intrinsic::Not) => match args.into_iter().next() {
                Some(a) => self.complement(Operand::fixed(a), span, Some(ty)),
                None => self.bad(span),
            },
            Lowering::Inline(i) => self.in_profile(i, args, ty, span),
            Lowering::Native => {
                let shared = f.params.iter().zip(&args).find(|(p, _)| matches!(p.ty, Pattern::T(_))).map(|(_, a)| a.ty);
                let suffix = shared.map(|t| self.type_name(t)).unwrap_or_default();
                match f.native(suffix) {
                    Some(name) => self.native(name, args, ty, span),
                    None => self.bad(span),
                }
            }
        }
    }

    /// A call of an inline function; of constants its value.
    pub fn intrinsic(&mut self, i: Intrinsic, args: Vec<Expr>, ty: TypeId, span: Span) -> Operand {
        let folded = if self.unfolded { None } else { self.fold_intrinsic(i, &args, ty) };
        match folded {
            Some(Ok(c)) => Operand::fixed(constant_expr(c, ty, span)),
            Some(Err(why)) => self.fold_error(why, span),
            None => Operand::fixed(Expr { kind: ExprKind::Intrinsic(i, args), ty, span }),
        }
    }

    /// A call of a native; of constant scalars its value. More strings than a call has slots are joined in steps.
    pub(super) fn native(&mut self, name: String, mut args: Vec<Expr>, ty: TypeId, span: Span) -> Operand {
        if let Some(Ok(c)) = self.fold_native(&name, &args, ty)
            && !self.unfolded
        {
            return Operand::fixed(constant_expr(c, ty, span));
        }
        while args.len() > STRINGS_MAX {
            let rest = args.split_off(STRINGS_MAX);
            let joined = Expr { kind: ExprKind::Native { name: name.clone(), args }, ty, span };
            args = std::iter::once(joined).chain(rest).collect();
        }
        Operand::fixed(Expr { kind: ExprKind::Native { name, args }, ty, span })
    }

    /// A constant count below zero (§11).
    fn check_shift(&mut self, args: &[Expr]) {
        let [value, Expr { kind: ExprKind::Const(count), span, .. }] = args else { return };
        if self.unfolded {
            return;
        }
        // Of two constants the folding reports it.
        if constant::int(count).is_some_and(|n| n < 0) && !matches!(value.kind, ExprKind::Const(_)) {
            let help = "shift the other way, or write ROL or ROR";
            self.report(Diag::new(Code::OutOfRange, *span, "a count below zero").help(help));
        }
    }

    /// `STRING` for a string of any capacity.
    fn type_name(&self, ty: TypeId) -> &'static str {
        match self.ty(ty) {
            Type::String { .. } => "STRING",
            Type::WString { .. } => "WSTRING",
            Type::Elementary(e) => e.name(),
            _ => "",
        }
    }
}

/// Fewest and most arguments.
fn arity(found: Found) -> (usize, usize) {
    match found {
        Found::Conversion { .. } => (1, 1),
        Found::Function { function: f, .. } => (f.params.len(), if f.extensible { INPUTS_MAX } else { f.params.len() }),
    }
}

/// Position of IN3, IN4, ... behind the parameters that are listed.
fn counted(f: &Function, formal: &ast::Name) -> Option<usize> {
    let last = f.params.last()?;
    let stem = last.name.trim_end_matches(|c: char| c.is_ascii_digit());
    let first: usize = last.name[stem.len()..].parse().ok()?;
    let (head, digits) = formal.text.split_at_checked(stem.len())?;
    let number: usize = digits.parse().ok().filter(|n| (first..first + 64).contains(n))?;
    head.eq_ignore_ascii_case(stem).then(|| f.params.len() - 1 + number - first)
}

/// The operator that a function of `count` arguments is.
fn operator_of(i: Intrinsic, count: usize) -> Option<BinaryOp> {
    let pair = |op| (count == 2).then_some(op);
    match i {
        Intrinsic::Add => Some(BinaryOp::Add),
        Intrinsic::Sub => Some(BinaryOp::Sub),
        Intrinsic::Mul => Some(BinaryOp::Mul),
        Intrinsic::Div => Some(BinaryOp::Div),
        Intrinsic::Mod => Some(BinaryOp::Mod),
        Intrinsic::And => Some(BinaryOp::And),
        Intrinsic::Or => Some(BinaryOp::Or),
        Intrinsic::Xor => Some(BinaryOp::Xor),
        Intrinsic::Expt => Some(BinaryOp::Power),
        Intrinsic::Gt => pair(BinaryOp::Gt),
        Intrinsic::Ge => pair(BinaryOp::Ge),
        Intrinsic::Eq => pair(BinaryOp::Eq),
        Intrinsic::Le => pair(BinaryOp::Le),
        Intrinsic::Lt => pair(BinaryOp::Lt),
        Intrinsic::Ne => pair(BinaryOp::Ne),
        _ => None,
    }
}
