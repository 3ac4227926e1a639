//! The standard functions: name, signature, how they are compiled, one line of documentation. One home: checker, code generator
//! and manual read this table. From: IEC 61131-3 edition 3, §6.6.2.5; library reference §13.

use takt_image::{Elementary, Generic};

/// A standard function. Typed names (`SIN_LREAL`, `ADD_INT`) and conversions (`INT_TO_REAL`) are found by [`crate::lookup`].
#[derive(Clone, Copy, Debug)]
pub struct Function {
    /// Overloaded name.
    pub name: &'static str,
    /// Inputs.
    pub params: &'static [Param],
    /// The last parameter may be repeated: IN1, IN2, ... INn.
    pub extensible: bool,
    /// Result.
    pub result: Pattern,
    /// How it is compiled.
    pub lowering: Lowering,
    /// One line.
    pub doc: &'static str,
}

/// An input.
#[derive(Clone, Copy, Debug)]
pub struct Param {
    /// Formal name.
    pub name: &'static str,
    /// Accepted types.
    pub ty: Pattern,
}

/// A type in a signature.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Pattern {
    /// This type.
    Is(Elementary),
    /// The common type of all parameters with this pattern; must be in the group. STRING and WSTRING are matched by
    /// `AnyString`, `AnyElementary` and `Any`; enumerations, arrays and structures by `Any` alone.
    T(Generic),
    /// Any type of the group, on its own: N of SHL, L and P of string functions, K of MUX. Passed as LINT.
    Own(Generic),
}

/// How a function is compiled.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Lowering {
    /// A few instructions that the compiler knows.
    Inline(Intrinsic),
    /// A call of the native whose name is the function's name, `_`, and the name of T (`SIN_LREAL`); without T the plain name.
    /// Scalars take one slot each, strings offset and capacity; a string result is written to a place that follows as the last
    /// two slots (offset and capacity).
    Native,
}

/// Functions that are instructions.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
#[allow(missing_docs)]
pub enum Intrinsic {
    Abs,
    Sqrt,
    Add,
    Sub,
    Mul,
    Div,
    Mod,
    Expt,
    Move,
    Shl,
    Shr,
    Rol,
    Ror,
    And,
    Or,
    Xor,
    Not,
    Sel,
    Max,
    Min,
    Limit,
    Mux,
    Gt,
    Ge,
    Eq,
    Le,
    Lt,
    Ne,
    /// REAL to integer toward zero.
    Trunc,
    /// Time sample of the activation, `TIME()`.
    Now,
    IsValid,
}
