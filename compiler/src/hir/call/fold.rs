//! Standard functions of constants, computed by the compiler: the natives by the very code that a controller runs, so that both give
//! the same bits (library reference §1).

use crate::hir::builder::Builder;
use crate::hir::constant::{self, FoldError};
use crate::hir::model::*;
use crate::syntax::ast::BinaryOp;
use std::cmp::Ordering;
use takt_base::Nanos;
use takt_image::{Elementary, NativeCall, NativeImport, NativeKind, Natives, TypeId, TypeTable};
use takt_stdlib::catalog::Intrinsic;
use takt_stdlib::{Library, native_signature};

type Folded = Option<Result<Const, FoldError>>;

/// The constants that the expressions are; `None` if one is none.
fn constants(args: &[Expr]) -> Option<Vec<&Const>> {
    args.iter().map(|e| if let ExprKind::Const(c) = &e.kind { Some(c) } else { None }).collect()
}

impl Builder<'_> {
    /// The value of an inline function; `None` if it stays for the run time.
    pub(super) fn fold_intrinsic(&self, i: Intrinsic, args: &[Expr], ty: TypeId) -> Folded {
        let values = constants(args)?;
        let (first, rest) = values.split_first()?;
        let of = self.hir.types.storage(args[0].ty);
        let to = self.hir.types.storage(ty);
        match i {
            Intrinsic::Move => Some(Ok((*first).clone())),
            Intrinsic::Sel => rest.get(usize::from(!constant::is_zero(first))).map(|c| Ok((*c).clone())),
            Intrinsic::Mux => {
                let k = constant::int(first).and_then(|k| usize::try_from(k).ok());
                rest.get(k.unwrap_or(0)).or(rest.first()).map(|c| Ok((*c).clone()))
            }
            Intrinsic::MuxLast => {
                let k = constant::int(first).and_then(|k| usize::try_from(k).ok());
                k.and_then(|k| rest.get(k)).or(rest.last()).map(|c| Ok((*c).clone()))
            }
            Intrinsic::Max | Intrinsic::Min => {
                let keep = if i == Intrinsic::Max { Ordering::Greater } else { Ordering::Less };
                rest.iter().try_fold(*first, |a, b| pick(a, b, keep)).map(|c| Ok(c.clone()))
            }
            Intrinsic::Limit => {
                let low = pick(first, rest.first()?, Ordering::Greater)?;
                pick(low, rest.get(1)?, Ordering::Less).map(|c| Ok(c.clone()))
            }
            Intrinsic::LimitLow => {
                let high = pick(rest.first()?, rest.get(1)?, Ordering::Less)?;
                let low = pick(first, rest.first()?, Ordering::Greater)?;
                Some(Ok(if std::ptr::eq(low, *first) { low.clone() } else { high.clone() }))
            }
            Intrinsic::Abs if of?.is_real() => Some(Ok(Const::Real(constant::real(first)?.abs()))),
            Intrinsic::Abs => Some(constant::checked(of?, constant::int(first)?.abs())),
            Intrinsic::Sqrt => finite(constant::round(of?, constant::real(first)?.sqrt())),
            Intrinsic::IsValid => Some(Ok(Const::Int(i128::from(constant::real(first)?.is_finite())))),
            Intrinsic::Trunc => Some(real_to_int(constant::real(first)?.trunc(), to?)),
            Intrinsic::Shl | Intrinsic::Shr | Intrinsic::Rol | Intrinsic::Ror => {
                shift(i, of?, constant::int(first)?, constant::int(rest.first()?)?)
            }
            Intrinsic::Add | Intrinsic::Sub => {
                let op = if i == Intrinsic::Add { BinaryOp::Add } else { BinaryOp::Sub };
                constant::binary(op, first, rest.first()?, to?)
            }
            Intrinsic::Mul | Intrinsic::Div => {
                let name = if i == Intrinsic::Mul { "MUL_TIME" } else { "DIV_TIME" };
                let real = self.hir.types.storage(args[1].ty)?.is_real();
                if i == Intrinsic::Div && constant::is_zero(rest.first()?) {
                    return Some(Err(FoldError::DivisionByZero));
                }
                self.fold_native(&format!("{name}_{}", if real { "LREAL" } else { "LINT" }), args, ty)
            }
            Intrinsic::Expt => self.fold_power(args, ty),
            _ => None,
        }
    }

    /// The base to a power of its own type.
    fn fold_power(&self, args: &[Expr], ty: TypeId) -> Folded {
        let [base, exponent] = args else { return None };
        let ExprKind::Const(c) = &exponent.kind else { return None };
        let e = self.hir.types.storage(ty)?;
        let value = constant::int(c).map(|n| n as f64).or(constant::real(c))?;
        let kind = ExprKind::Const(Const::Real(constant::round(e, value)));
        let exponent = Expr { kind, ty, span: exponent.span };
        self.fold_native(&format!("EXPT_{}", e.name()), &[base.clone(), exponent], ty)
    }

    /// The value of a native of scalars; `None` if it takes or gives anything else, or a result that is not finite.
    pub(super) fn fold_native(&self, name: &str, args: &[Expr], ty: TypeId) -> Folded {
        let kind = native_signature(name)?;
        let NativeKind::Function { params, result: Some(_) } = &kind else { return None };
        let types: Option<Vec<Elementary>> = args.iter().map(|a| self.hir.types.storage(a.ty)).collect();
        let slots: Option<Vec<u64>> = constants(args)?.into_iter().zip(types?).map(|(c, e)| slot(c, e)).collect();
        let (slots, to) = (slots?, self.hir.types.storage(ty)?);
        if slots.len() != params.len() {
            return None;
        }
        let mut library = Library::new();
        let import = NativeImport { name: name.to_owned(), kind };
        let native = library.bind(&import, &TypeTable::new()).ok()?;
        let mut call = NativeCall { memory: &mut [], args: &slots, result: 0, now: Nanos::ZERO };
        library.call(native, &mut call).ok()?;
        match to {
            Elementary::Real => finite(f64::from(f32::from_bits(call.result as u32))),
            Elementary::Lreal => finite(f64::from_bits(call.result)),
            e => Some(Ok(Const::Int(constant::low_bits(i128::from(call.result), e)))),
        }
    }
}

/// A constant as an argument slot.
fn slot(c: &Const, e: Elementary) -> Option<u64> {
    Some(match e {
        Elementary::Real => u64::from((constant::real(c)? as f32).to_bits()),
        Elementary::Lreal => constant::real(c)?.to_bits(),
        _ => constant::int(c)? as u64,
    })
}

fn finite(value: f64) -> Folded {
    value.is_finite().then_some(Ok(Const::Real(value)))
}

/// The one of two values that compares as `keep` with the other; the first if they are equal.
fn pick<'c>(a: &'c Const, b: &'c Const, keep: Ordering) -> Option<&'c Const> {
    let order = match (a, b) {
        (Const::String(a), Const::String(b)) => a.cmp(b),
        (Const::WString(a), Const::WString(b)) => a.cmp(b),
        _ => match (constant::int(a), constant::int(b)) {
            (Some(a), Some(b)) => a.cmp(&b),
            _ => constant::real(a)?.partial_cmp(&constant::real(b)?)?,
        },
    };
    Some(if order == keep.reverse() { b } else { a })
}

/// A whole number as an integer of the type.
pub(super) fn real_to_int(value: f64, to: Elementary) -> Result<Const, FoldError> {
    if value.is_nan() { Err(FoldError::Overflow) } else { constant::checked(to, value as i128) }
}

fn shift(i: Intrinsic, e: Elementary, value: i128, n: i128) -> Folded {
    let width = i128::from(e.bits());
    let value = value & ((1 << width) - 1); // the bits, of negative numbers too
    let by = |n: i128| u32::try_from(n.clamp(0, 127)).unwrap_or(127);
    let turned = n.rem_euclid(width);
    let rotate = |left: i128| (value << by(left)) | (value >> by(width - left));
    let bits = match i {
        Intrinsic::Shl | Intrinsic::Shr if n < 0 => return Some(Err(FoldError::Overflow)),
        Intrinsic::Shl | Intrinsic::Shr if n >= width => 0,
        Intrinsic::Shl => value << by(n),
        Intrinsic::Shr => value >> by(n),
        Intrinsic::Rol => rotate(turned),
        _ => rotate((width - turned) % width),
    };
    Some(Ok(Const::Int(constant::low_bits(bits, e))))
}
