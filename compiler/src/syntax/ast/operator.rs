//! Operators of expressions.
#![allow(missing_docs)] // the names say it

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOp {
    Neg,
    Plus,
    Not,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BinaryOp {
    Or,
    Xor,
    And,
    Eq,
    Ne,
    Lt,
    Gt,
    Le,
    Ge,
    Add,
    Sub,
    Mul,
    Div,
    Mod,
    Power,
    /// AND_THEN, OR_ELSE (vendor): always short-circuit.
    AndThen,
    OrElse,
}

impl BinaryOp {
    /// As the user writes it.
    pub const fn text(self) -> &'static str {
        use BinaryOp::*;
        match self {
            Or => "OR",
            Xor => "XOR",
            And => "AND",
            Eq => "=",
            Ne => "<>",
            Lt => "<",
            Gt => ">",
            Le => "<=",
            Ge => ">=",
            Add => "+",
            Sub => "-",
            Mul => "*",
            Div => "/",
            Mod => "MOD",
            Power => "**",
            AndThen => "AND_THEN",
            OrElse => "OR_ELSE",
        }
    }
}
