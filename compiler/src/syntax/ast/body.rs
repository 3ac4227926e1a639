//! Statements and expressions (§5).

use super::*;

/// A statement.
#[derive(Clone, Debug)]
pub struct Stmt {
    /// What it does.
    pub kind: StmtKind,
    /// Where.
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum StmtKind {
    Assign {
        target: Expr,
        value: Expr,
    },
    /// `a S= b := value;` (vendor): the value goes to every target, the last one first.
    Chain {
        targets: Vec<(Expr, AssignOp)>,
        value: Expr,
    },
    /// `target ?= value`.
    Attempt {
        target: Expr,
        value: Expr,
    },
    /// `target REF= value` (vendor).
    Bind {
        target: Expr,
        value: Expr,
    },
    /// A call as a statement: the expression is always [`ExprKind::Call`].
    Call(Expr),
    /// IF and its ELSIFs, then ELSE.
    If {
        branches: Vec<(Expr, Vec<Stmt>)>,
        otherwise: Vec<Stmt>,
    },
    Case {
        selector: Expr,
        arms: Vec<CaseArm>,
        otherwise: Option<Vec<Stmt>>,
    },
    For {
        variable: Box<Expr>,
        from: Box<Expr>,
        to: Box<Expr>,
        by: Option<Box<Expr>>,
        body: Vec<Stmt>,
    },
    While {
        condition: Expr,
        body: Vec<Stmt>,
    },
    Repeat {
        body: Vec<Stmt>,
        until: Expr,
    },
    Exit,
    Continue,
    /// `RETURN`, `RETURN value` (vendor).
    Return(Option<Expr>),
    /// An expression that is no call (vendor): evaluated, and its value forgotten.
    Expression(Expr),
    /// `name:` (vendor).
    Label(Name),
    /// `JMP name;` (vendor).
    Jump(Name),
    /// A body in Instruction List: the only statement of its list.
    Instructions(Vec<crate::syntax::il::Line>),
    /// A lone `;`.
    Empty,
    /// Something was wrong here and has been reported.
    Error,
}

/// How an assignment of a chain writes its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssignOp {
    /// `:=`
    Assign,
    /// `S=`: becomes TRUE if the value is TRUE.
    Set,
    /// `R=`: becomes FALSE if the value is TRUE.
    Reset,
}

/// Labels and statements of a CASE branch.
#[derive(Clone, Debug)]
pub struct CaseArm {
    pub labels: Vec<CaseLabel>,
    pub body: Vec<Stmt>,
}

/// `low` or `low..high`.
#[derive(Clone, Debug)]
pub struct CaseLabel {
    pub low: Expr,
    pub high: Option<Expr>,
}

/// An expression.
#[derive(Clone, Debug)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where.
    pub span: Span,
}

impl Expr {
    /// True for `name(..)`.
    pub fn is_call_of(&self, name: &str) -> bool {
        matches!(&self.kind, ExprKind::Call { callee, .. } if matches!(&callee.kind, ExprKind::Name(n) if n.is(name)))
    }
}

#[derive(Clone, Debug)]
pub enum ExprKind {
    Literal(Literal),
    /// A variable, enumerator or function name; also THIS and SUPER.
    Name(Name),
    /// `Color#Red`.
    Enumerator {
        ty: Name,
        value: Name,
    },
    Direct(Address),
    Unary(UnaryOp, Box<Expr>),
    Binary(BinaryOp, Box<Expr>, Box<Expr>),
    Member(Box<Expr>, Name),
    /// `a[i, j]`.
    Index(Box<Expr>, Vec<Expr>),
    /// `w.3`, `w.%X3`, `d.%B1`.
    Part {
        base: Box<Expr>,
        size: AddressSize,
        index: u32,
    },
    Call {
        callee: Box<Expr>,
        args: Vec<Arg>,
    },
    /// `(target := value)` (vendor): assigns, and is the value.
    Assign {
        target: Box<Expr>,
        value: Box<Expr>,
    },
    /// `r^`.
    Deref(Box<Expr>),
    /// NULL.
    Null,
    /// Something was wrong here and has been reported.
    Error,
}

/// An argument of a call.
#[derive(Clone, Debug)]
pub enum Arg {
    Positional(Expr),
    /// `name := value`; the value may be left out (vendor).
    Input {
        name: Name,
        value: Option<Expr>,
    },
    /// `name => target`, `NOT name => target`; the target may be left out.
    Output {
        name: Name,
        negated: bool,
        target: Option<Expr>,
    },
}

/// A literal. Untyped numbers take their type from the context (§1.5 of the language reference).
#[derive(Clone, Debug, PartialEq)]
pub enum Literal {
    /// Decimal or based integer; `based` ones also fit bit strings.
    Int {
        value: i128,
        based: bool,
    },
    Real(f64),
    Bool(bool),
    /// Bytes without the zero.
    String(Vec<u8>),
    WString(Vec<u16>),
    /// Nanoseconds, since 1970 or since midnight for dates and times of day. The type is TIME, LTIME, DATE, LDATE, TOD, LTOD, DT or LDT.
    Time {
        ty: takt_image::Elementary,
        nanos: i64,
    },
    /// `INT#5`, `REAL#1.5`, `BOOL#TRUE`, `STRING#'x'`, `CHAR#'x'`: the type as written; the parser has not checked the range.
    Typed {
        ty: takt_image::Elementary,
        value: Box<Literal>,
    },
}
