//! Expressions of RS274/NGC as postfix code: compiled once by [`compile`], executed as often as a loop wants by [`run`].
//! Runs: background. Invariant: executing code allocates nothing once the stack has grown to its depth.
//! From: RS274/NGC §3.3.2.3 (expressions), LinuxCNC "G-code overview": binary operators, functions, named parameters.

pub mod compile;
pub mod run;

/// A range of [`Op`]s in a [`super::code::Code`].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Slice {
    /// First index.
    pub start: u32,
    /// One past the last.
    pub end: u32,
}

impl Slice {
    /// As a range of `usize`.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
    /// No elements.
    pub fn is_empty(self) -> bool {
        self.start >= self.end
    }
}

/// A number, or the code that computes it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Value {
    /// Known when the row is read.
    Number(f64),
    /// Computed each time.
    Code(Slice),
}

/// Operators with two operands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Binary {
    Power,
    Times,
    Divide,
    Modulo,
    Plus,
    Minus,
    Equal,
    NotEqual,
    Greater,
    GreaterEqual,
    Less,
    LessEqual,
    And,
    Or,
    Xor,
}

impl Binary {
    /// Operators of a higher level bind first; all of them group from the left.
    pub const fn level(self) -> u8 {
        match self {
            Binary::And | Binary::Or | Binary::Xor => 1,
            Binary::Equal | Binary::NotEqual | Binary::Greater | Binary::GreaterEqual | Binary::Less | Binary::LessEqual => 2,
            Binary::Plus | Binary::Minus => 3,
            Binary::Times | Binary::Divide | Binary::Modulo => 4,
            Binary::Power => 5,
        }
    }
}

/// Functions of one argument; angles in degrees.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Function {
    Abs,
    Acos,
    Asin,
    Cos,
    Exp,
    Fix,
    Fup,
    Ln,
    Round,
    Sin,
    Sqrt,
    Tan,
    Negate,
}

/// One step of postfix code.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Op {
    /// Push a number.
    Number(f64),
    /// Push a parameter whose number is known and in range.
    Parameter(u16),
    /// Replace the top by the parameter of this number.
    ParameterAt,
    /// Push a named parameter.
    Named(super::param::Name),
    /// Push 1 if the named parameter exists, else 0.
    Exists(super::param::Name),
    /// Replace the top by 1 if it is the number of a parameter, else by 0.
    ExistsAt,
    /// Two operands to one result.
    Binary(Binary),
    /// One operand to one result.
    Function(Function),
    /// `ATAN[y]/[x]`: the two topmost to an angle in degrees.
    Atan,
}

/// Deepest nesting of brackets, functions and signs in a row.
pub const NESTING_MAX: u32 = 64;
