//! Facts about operations that printer, parser, verifier and generator share: mnemonics and the kind of operands.

use super::model::{BinaryOp, Compare, Convert, UnaryOp};
use takt_image::Scalar;

/// Machine types by name.
pub const SCALARS: &[(&str, Scalar)] = &[
    ("i8", Scalar::I8),
    ("i16", Scalar::I16),
    ("i32", Scalar::I32),
    ("i64", Scalar::I64),
    ("f32", Scalar::F32),
    ("f64", Scalar::F64),
];

/// Operations of one operand by mnemonic.
pub const UNARY: &[(&str, UnaryOp)] = &[
    ("neg", UnaryOp::Neg),
    ("not", UnaryOp::Not),
    ("fneg", UnaryOp::FNeg),
    ("fabs", UnaryOp::FAbs),
    ("fsqrt", UnaryOp::FSqrt),
    ("fnearest", UnaryOp::FNearest),
    ("ftrunc", UnaryOp::FTrunc),
    ("ffloor", UnaryOp::FFloor),
    ("fceil", UnaryOp::FCeil),
    ("swap_bytes", UnaryOp::SwapBytes),
];

/// Operations of two operands by mnemonic.
pub const BINARY: &[(&str, BinaryOp)] = &[
    ("add", BinaryOp::Add),
    ("sub", BinaryOp::Sub),
    ("mul", BinaryOp::Mul),
    ("sdiv", BinaryOp::SDiv),
    ("udiv", BinaryOp::UDiv),
    ("srem", BinaryOp::SRem),
    ("urem", BinaryOp::URem),
    ("and", BinaryOp::And),
    ("or", BinaryOp::Or),
    ("xor", BinaryOp::Xor),
    ("shl", BinaryOp::Shl),
    ("lshr", BinaryOp::LShr),
    ("ashr", BinaryOp::AShr),
    ("rotl", BinaryOp::Rotl),
    ("rotr", BinaryOp::Rotr),
    ("fadd", BinaryOp::FAdd),
    ("fsub", BinaryOp::FSub),
    ("fmul", BinaryOp::FMul),
    ("fdiv", BinaryOp::FDiv),
];

/// Comparisons by mnemonic.
pub const COMPARE: &[(&str, Compare)] = &[
    ("eq", Compare::Eq),
    ("ne", Compare::Ne),
    ("slt", Compare::SLt),
    ("sle", Compare::SLe),
    ("sgt", Compare::SGt),
    ("sge", Compare::SGe),
    ("ult", Compare::ULt),
    ("ule", Compare::ULe),
    ("ugt", Compare::UGt),
    ("uge", Compare::UGe),
    ("feq", Compare::FEq),
    ("fne", Compare::FNe),
    ("flt", Compare::FLt),
    ("fle", Compare::FLe),
    ("fgt", Compare::FGt),
    ("fge", Compare::FGe),
];

/// Conversions by mnemonic.
pub const CONVERT: &[(&str, Convert)] = &[
    ("sign_extend", Convert::SignExtend),
    ("zero_extend", Convert::ZeroExtend),
    ("truncate", Convert::Truncate),
    ("signed_to_float", Convert::SignedToFloat),
    ("unsigned_to_float", Convert::UnsignedToFloat),
    ("float_to_signed", Convert::FloatToSigned),
    ("float_to_unsigned", Convert::FloatToUnsigned),
    ("float_to_float", Convert::Float),
    ("bits", Convert::Bits),
];

/// The mnemonic of an entry of one of the tables above.
pub fn mnemonic<T: PartialEq>(table: &'static [(&'static str, T)], value: &T) -> &'static str {
    table.iter().find(|(_, v)| v == value).map_or("?", |(name, _)| name)
}

/// The entry of one of the tables above with this mnemonic.
pub fn by_mnemonic<T: Copy>(table: &[(&str, T)], name: &str) -> Option<T> {
    table.iter().find(|(n, _)| *n == name).map(|&(_, v)| v)
}

impl UnaryOp {
    /// Operand and result are F32 or F64; otherwise integers.
    pub const fn is_float(self) -> bool {
        !matches!(self, UnaryOp::Neg | UnaryOp::Not | UnaryOp::SwapBytes)
    }
}

impl BinaryOp {
    /// Operands and result are F32 or F64; otherwise integers.
    pub const fn is_float(self) -> bool {
        matches!(self, BinaryOp::FAdd | BinaryOp::FSub | BinaryOp::FMul | BinaryOp::FDiv)
    }
}

impl Compare {
    /// Operands are F32 or F64; otherwise integers.
    pub const fn is_float(self) -> bool {
        matches!(self, Compare::FEq | Compare::FNe | Compare::FLt | Compare::FLe | Compare::FGt | Compare::FGe)
    }
}

impl Convert {
    /// Whether it converts `from` to `to`.
    pub fn accepts(self, from: Scalar, to: Scalar) -> bool {
        let (from_float, to_float) = (from.is_float(), to.is_float());
        match self {
            Convert::SignExtend | Convert::ZeroExtend => !from_float && !to_float && from.bytes() < to.bytes(),
            Convert::Truncate => !from_float && !to_float && from.bytes() > to.bytes(),
            Convert::SignedToFloat | Convert::UnsignedToFloat => !from_float && to_float,
            Convert::FloatToSigned | Convert::FloatToUnsigned => from_float && !to_float,
            Convert::Float => from_float && to_float && from != to,
            Convert::Bits => from_float != to_float && from.bytes() == to.bytes(),
        }
    }
}

/// The F32 that a [`super::model::Op::Float`] stands for. Any NaN is the quiet one.
pub fn float32(bits: u64) -> f32 {
    let wide = f64::from_bits(bits);
    if wide.is_nan() { f32::from_bits(0x7fc0_0000) } else { wide as f32 }
}

/// Width in bits.
pub const fn width(ty: Scalar) -> u32 {
    ty.bytes() * 8
}

/// The low bits of `value` that a register of this type holds.
pub const fn mask(ty: Scalar, value: u64) -> u64 {
    value & (u64::MAX >> (64 - width(ty)))
}

/// The register of this type as a signed number.
pub const fn signed(ty: Scalar, value: u64) -> i64 {
    let unused = 64 - width(ty);
    ((value << unused) as i64) >> unused
}
