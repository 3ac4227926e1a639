//! The standard functions: name, signature, how they are compiled, one line of documentation. One home: checker, code generator
//! and manual read this table. From: IEC 61131-3 edition 3, §6.6.2.5; library reference §13.

mod exchange;
mod numeric;
mod strings;
mod time;

use takt_image::{Elementary, Generic};

/// All functions, by topic. Names are unique.
pub const GROUPS: &[&[Function]] = &[numeric::FUNCTIONS, strings::FUNCTIONS, time::FUNCTIONS, exchange::FUNCTIONS];

/// All functions in the order of the manual.
pub fn functions() -> impl Iterator<Item = &'static Function> {
    GROUPS.iter().flat_map(|group| group.iter())
}

/// A standard function. Typed names (`SIN_LREAL`, `ADD_INT`) and conversions (`INT_TO_REAL`) are found by [`crate::lookup()`].
#[derive(Clone, Copy, Debug)]
pub struct Function {
    /// Overloaded name.
    pub name: &'static str,
    /// Inputs.
    pub params: &'static [Param],
    /// The last parameter may be repeated; the number in its name counts up: IN1, IN2, ... INn. All are of its pattern.
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
    /// Any type of the group, on its own: N of SHL, L and P of string functions, K of MUX. An integer is passed as LINT; of the
    /// two numbers that may be real, the exponent of EXPT is passed as T, and the factor of MUL_TIME and DIV_TIME as LREAL if it
    /// is real. As a result (TRUNC): the type that the context wants; DINT if it wants none.
    Own(Generic),
}

impl Function {
    /// The group of T; `None` if no parameter has the common type.
    pub fn group(&self) -> Option<Generic> {
        self.params.iter().find_map(|p| if let Pattern::T(group) = p.ty { Some(group) } else { None })
    }
    /// Name of the native for T = `ty` (`SIN_LREAL`, `LEN_STRING`); without T the plain name. `None` if the function is inline.
    pub fn native(&self, ty: &str) -> Option<String> {
        match (self.lowering, self.group()) {
            (Lowering::Inline(_), _) => None,
            (Lowering::Native, None) => Some(self.name.to_owned()),
            (Lowering::Native, Some(_)) => Some(format!("{}_{ty}", self.name)),
        }
    }
}

/// How a function is compiled.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Lowering {
    /// A few instructions that the compiler knows, or the helper natives named in `natives`.
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
    /// MUX of CODESYS: the last input if there is no number K. Not in the table.
    MuxLast,
    /// LIMIT of MATIEC: MN if IN <= MN, whatever MX is. Not in the table.
    LimitLow,
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

/// A parameter.
const fn p(name: &'static str, ty: Pattern) -> Param {
    Param { name, ty }
}

/// A function with a fixed number of inputs.
const fn f(name: &'static str, params: &'static [Param], result: Pattern, lowering: Lowering, doc: &'static str) -> Function {
    Function { name, params, extensible: false, result, lowering, doc }
}

/// A function whose last input may be repeated.
const fn ext(name: &'static str, params: &'static [Param], result: Pattern, lowering: Lowering, doc: &'static str) -> Function {
    Function { name, params, extensible: true, result, lowering, doc }
}
