//! Numeric, arithmetic, bit string, selection and comparison functions. From: library reference §3 to §6, §9.

use super::Intrinsic as I;
use super::Lowering::{Inline, Native};
use super::Pattern::{Is, Own, T};
use super::{Function, Param, Pattern, ext, f, p};
use takt_image::{Elementary as E, Generic as G};

const NUM: Pattern = T(G::AnyNum);
const REAL: Pattern = T(G::AnyReal);
const BITS: Pattern = T(G::AnyBit);
const MAGNITUDE: Pattern = T(G::AnyMagnitude);
const ELEMENTARY: Pattern = T(G::AnyElementary);
const ANY: Pattern = T(G::Any);
const INT: Pattern = Own(G::AnyInt);
const BOOL: Pattern = Is(E::Bool);

const NUM_1: &[Param] = &[p("IN", NUM)];
const REAL_1: &[Param] = &[p("IN", REAL)];
const NUM_2: &[Param] = &[p("IN1", NUM), p("IN2", NUM)];
const MAGNITUDE_2: &[Param] = &[p("IN1", MAGNITUDE), p("IN2", MAGNITUDE)];
const BITS_2: &[Param] = &[p("IN1", BITS), p("IN2", BITS)];
const SHIFT: &[Param] = &[p("IN", BITS), p("N", INT)];
const ELEMENTARY_2: &[Param] = &[p("IN1", ELEMENTARY), p("IN2", ELEMENTARY)];

/// The table.
pub const FUNCTIONS: &[Function] = &[
    // Numeric, one input.
    f("ABS", NUM_1, NUM, Inline(I::Abs), "Magnitude; of the smallest integer that integer itself"),
    f("SQRT", REAL_1, REAL, Inline(I::Sqrt), "Square root; NaN below zero"),
    f("LN", REAL_1, REAL, Native, "Natural logarithm; -Inf at zero, NaN below"),
    f("LOG", REAL_1, REAL, Native, "Logarithm to base 10; -Inf at zero, NaN below"),
    f("EXP", REAL_1, REAL, Native, "e to the power IN; +Inf on overflow"),
    f("SIN", REAL_1, REAL, Native, "Sine of an angle in radians"),
    f("COS", REAL_1, REAL, Native, "Cosine of an angle in radians"),
    f("TAN", REAL_1, REAL, Native, "Tangent of an angle in radians"),
    f("ASIN", REAL_1, REAL, Native, "Arc sine in radians, -pi/2 to pi/2; NaN outside of -1 to 1"),
    f("ACOS", REAL_1, REAL, Native, "Arc cosine in radians, 0 to pi; NaN outside of -1 to 1"),
    f("ATAN", REAL_1, REAL, Native, "Arc tangent in radians, -pi/2 to pi/2"),
    f("ATAN2", &[p("Y", REAL), p("X", REAL)], REAL, Native, "Angle of the point (X, Y) in radians, -pi to pi"),
    f("IS_VALID", REAL_1, BOOL, Inline(I::IsValid), "FALSE for NaN and the infinities"),
    f("TRUNC", REAL_1, Own(G::AnyInt), Inline(I::Trunc), "Real to integer toward zero, saturating; NaN gives 0"),
    // Arithmetic.
    ext("ADD", MAGNITUDE_2, MAGNITUDE, Inline(I::Add), "Sum; integers wrap"),
    f("SUB", MAGNITUDE_2, MAGNITUDE, Inline(I::Sub), "Difference; integers wrap"),
    ext("MUL", NUM_2, NUM, Inline(I::Mul), "Product; integers wrap"),
    f("DIV", NUM_2, NUM, Inline(I::Div), "Quotient; of integers toward zero"),
    f("MOD", &[p("IN1", T(G::AnyInt)), p("IN2", T(G::AnyInt))], T(G::AnyInt), Inline(I::Mod), "Remainder with the sign of IN1"),
    f("EXPT", &[p("IN1", REAL), p("IN2", Own(G::AnyNum))], REAL, Inline(I::Expt), "IN1 to the power IN2; EXPT(0, 0) = 1"),
    f("MOVE", &[p("IN", ANY)], ANY, Inline(I::Move), "IN as it is"),
    // Bit strings.
    f("SHL", SHIFT, BITS, Inline(I::Shl), "Shift left by N, zeros come in; 0 if N is the width or more"),
    f("SHR", SHIFT, BITS, Inline(I::Shr), "Shift right by N, zeros come in; 0 if N is the width or more"),
    f("ROL", SHIFT, BITS, Inline(I::Rol), "Rotate left by N modulo the width"),
    f("ROR", SHIFT, BITS, Inline(I::Ror), "Rotate right by N modulo the width"),
    ext("AND", BITS_2, BITS, Inline(I::And), "Bitwise and"),
    ext("OR", BITS_2, BITS, Inline(I::Or), "Bitwise or"),
    ext("XOR", BITS_2, BITS, Inline(I::Xor), "Bitwise exclusive or"),
    f("NOT", &[p("IN", BITS)], BITS, Inline(I::Not), "Complement within the width"),
    f("IS_VALID_BCD", &[p("IN", BITS)], BOOL, Native, "TRUE if every four bits are a decimal digit"),
    // Selection.
    f("SEL", &[p("G", BOOL), p("IN0", ANY), p("IN1", ANY)], ANY, Inline(I::Sel), "IN1 if G, else IN0"),
    ext("MAX", ELEMENTARY_2, ELEMENTARY, Inline(I::Max), "Largest input; NaN is ignored"),
    ext("MIN", ELEMENTARY_2, ELEMENTARY, Inline(I::Min), "Smallest input; NaN is ignored"),
    f(
        "LIMIT",
        &[p("MN", ELEMENTARY), p("IN", ELEMENTARY), p("MX", ELEMENTARY)],
        ELEMENTARY,
        Inline(I::Limit),
        "IN, not below MN and not above MX: MIN(MAX(IN, MN), MX)",
    ),
    ext("MUX", &[p("K", INT), p("IN0", ANY), p("IN1", ANY)], ANY, Inline(I::Mux), "Input number K, from 0; IN0 if there is none"),
    // Comparison.
    ext("GT", ELEMENTARY_2, BOOL, Inline(I::Gt), "TRUE if each input is greater than the next"),
    ext("GE", ELEMENTARY_2, BOOL, Inline(I::Ge), "TRUE if each input is greater than the next or equal to it"),
    ext("EQ", ELEMENTARY_2, BOOL, Inline(I::Eq), "TRUE if all inputs are equal"),
    ext("LE", ELEMENTARY_2, BOOL, Inline(I::Le), "TRUE if each input is less than the next or equal to it"),
    ext("LT", ELEMENTARY_2, BOOL, Inline(I::Lt), "TRUE if each input is less than the next"),
    f("NE", ELEMENTARY_2, BOOL, Inline(I::Ne), "TRUE if the inputs differ"),
    // Binary-coded decimal: a digit in each four bits.
    f("BYTE_BCD_TO_USINT", &[p("IN", Is(E::Byte))], Is(E::Usint), Native, "Two decimal digits to a number; 0 if one is none"),
    f("WORD_BCD_TO_UINT", &[p("IN", Is(E::Word))], Is(E::Uint), Native, "Four decimal digits to a number; 0 if one is none"),
    f("DWORD_BCD_TO_UDINT", &[p("IN", Is(E::Dword))], Is(E::Udint), Native, "Eight decimal digits to a number; 0 if one is none"),
    f("LWORD_BCD_TO_ULINT", &[p("IN", Is(E::Lword))], Is(E::Ulint), Native, "16 decimal digits to a number; 0 if one is none"),
    f("BCD_TO_USINT", &[p("IN", Is(E::Byte))], Is(E::Usint), Native, "Like BYTE_BCD_TO_USINT"),
    f("BCD_TO_UINT", &[p("IN", Is(E::Word))], Is(E::Uint), Native, "Like WORD_BCD_TO_UINT"),
    f("BCD_TO_UDINT", &[p("IN", Is(E::Dword))], Is(E::Udint), Native, "Like DWORD_BCD_TO_UDINT"),
    f("BCD_TO_ULINT", &[p("IN", Is(E::Lword))], Is(E::Ulint), Native, "Like LWORD_BCD_TO_ULINT"),
    f("WORD_BCD_TO_INT", &[p("IN", Is(E::Word))], Is(E::Int), Native, "Four decimal digits to a number (edition 2)"),
    f("BCD_TO_INT", &[p("IN", Is(E::Byte))], Is(E::Int), Native, "Two decimal digits to a number (CODESYS)"),
    f("INT_TO_BCD", &[p("IN", Is(E::Int))], Is(E::Byte), Native, "Number modulo 100 to two decimal digits (CODESYS)"),
    f("USINT_TO_BCD_BYTE", &[p("IN", Is(E::Usint))], Is(E::Byte), Native, "Number modulo 100 to two decimal digits"),
    f("UINT_TO_BCD_WORD", &[p("IN", Is(E::Uint))], Is(E::Word), Native, "Number modulo 10000 to four decimal digits"),
    f("UDINT_TO_BCD_DWORD", &[p("IN", Is(E::Udint))], Is(E::Dword), Native, "Number modulo 10^8 to eight decimal digits"),
    f("ULINT_TO_BCD_LWORD", &[p("IN", Is(E::Ulint))], Is(E::Lword), Native, "Number modulo 10^16 to 16 decimal digits"),
    f("TO_BCD_BYTE", &[p("IN", Is(E::Usint))], Is(E::Byte), Native, "Like USINT_TO_BCD_BYTE"),
    f("TO_BCD_WORD", &[p("IN", Is(E::Uint))], Is(E::Word), Native, "Like UINT_TO_BCD_WORD"),
    f("TO_BCD_DWORD", &[p("IN", Is(E::Udint))], Is(E::Dword), Native, "Like UDINT_TO_BCD_DWORD"),
    f("TO_BCD_LWORD", &[p("IN", Is(E::Ulint))], Is(E::Lword), Native, "Like ULINT_TO_BCD_LWORD"),
];
