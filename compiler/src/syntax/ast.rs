//! The tree of a source file, as written: names are text, nothing has a type yet. Every node knows its span.
//! From: IEC 61131-3 edition 3, §6 and §7.3. Shared by all textual languages.
#![allow(missing_docs)] // the names of fields and variants say it; what they do not say stands beside them

mod config;
mod operator;

pub use config::{AccessDecl, ConfigDecl, Configuration, InstancePath, PathPart, ProgramDecl, Resource, TaskDecl};
pub use operator::{BinaryOp, UnaryOp};
use takt_base::Span;

/// An identifier as written; compare with [`Name::is`].
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// As written.
    pub text: String,
    /// Where.
    pub span: Span,
}

impl Name {
    /// Same name, without regard to case (§6.1.2).
    pub fn is(&self, other: &str) -> bool {
        self.text.eq_ignore_ascii_case(other)
    }
    /// The form that names are looked up by.
    pub fn key(&self) -> String {
        self.text.to_ascii_uppercase()
    }
}

/// One source file.
#[derive(Clone, Debug, Default)]
pub struct File {
    /// Declarations in order.
    pub items: Vec<Item>,
    /// Where warnings are not shown.
    pub silenced: Vec<super::silence::Silence>,
}

/// A declaration of a file.
#[derive(Clone, Debug)]
pub enum Item {
    Types(Vec<TypeDecl>),
    Pou(Pou),
    /// VAR_GLOBAL outside of a configuration (vendor form, and the form of generated declarations).
    Globals(VarSection),
    Configuration(Configuration),
    Namespace(Namespace),
    /// USING of a file or namespace.
    Using(Vec<Name>),
}

/// NAMESPACE ... END_NAMESPACE.
#[derive(Clone, Debug)]
pub struct Namespace {
    /// `a.b.c`.
    pub name: Name,
    /// INTERNAL.
    pub internal: bool,
    /// Behind the name.
    pub usings: Vec<Name>,
    pub items: Vec<Item>,
    pub span: Span,
}

/// FUNCTION, FUNCTION_BLOCK, PROGRAM, CLASS, INTERFACE, or a METHOD of one of the last four.
#[derive(Clone, Debug)]
pub struct Pou {
    /// Which.
    pub kind: PouKind,
    /// Its name.
    pub name: Name,
    /// Result type of a function; `None` for a procedure, and for the other kinds.
    pub result: Option<TypeRef>,
    /// Variable sections in order.
    pub sections: Vec<VarSection>,
    /// VAR_ACCESS of a program.
    pub paths: Vec<AccessDecl>,
    /// Statements.
    pub body: Vec<Stmt>,
    /// What belongs to object orientation: modifiers, heritage, methods.
    pub objects: Objects,
    /// `{external}` stands before it: the body is a native.
    pub external: bool,
    /// `{extern ..}` in its body: inline C of MATIEC.
    pub inline_c: Option<Span>,
    /// `{test}` stands before it.
    pub test: Option<super::test_pragma::TestPragma>,
    /// From the first to the last keyword.
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PouKind {
    Function,
    FunctionBlock,
    Program,
    Class,
    Interface,
    Method,
}

/// The object-oriented side of a unit (§6.6.5 to §6.6.7).
#[derive(Clone, Debug, Default)]
pub struct Objects {
    /// Of the unit or method itself.
    pub modifiers: Modifiers,
    /// EXTENDS: one type, or several interfaces.
    pub extends: Vec<Name>,
    /// IMPLEMENTS.
    pub implements: Vec<Name>,
    /// USING.
    pub usings: Vec<Name>,
    /// Methods, and the GET and SET of properties, in order.
    pub methods: Vec<Pou>,
    /// GET or SET of a property, of which a method is made.
    pub accessor: Option<Accessor>,
    /// An ACTION, of which a method is made.
    pub action: bool,
}

/// Words in front of the name of a type or method, each with its place.
#[derive(Clone, Debug, Default)]
pub struct Modifiers {
    pub access: Option<(AccessSpec, Span)>,
    pub is_abstract: Option<Span>,
    pub is_final: Option<Span>,
    pub is_override: Option<Span>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AccessSpec {
    Public,
    Protected,
    Private,
    Internal,
}

/// The two sides of a PROPERTY (vendor).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accessor {
    Get,
    Set,
}

/// VAR ... END_VAR.
#[derive(Clone, Debug)]
pub struct VarSection {
    /// VAR, VAR_INPUT, ...
    pub kind: SectionKind,
    /// CONSTANT.
    pub constant: bool,
    /// RETAIN (true), NON_RETAIN (false) or neither.
    pub retain: Option<bool>,
    /// PUBLIC, PROTECTED, PRIVATE, INTERNAL.
    pub access: Option<AccessSpec>,
    /// PERSISTENT (vendor): kept over a cold start too.
    pub persistent: bool,
    /// `{attribute 'qualified_only'}` stands before it (vendor).
    pub qualified_only: bool,
    /// Declarations in order.
    pub decls: Vec<VarDecl>,
    /// The opening keyword and its qualifiers.
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionKind {
    Var,
    Temp,
    /// VAR_STAT (vendor).
    Stat,
    /// VAR_INST (vendor): of a method, one for each instance.
    Inst,
    Input,
    Output,
    InOut,
    External,
    Global,
}

/// `a, b AT %QX0.0 : BOOL := TRUE;`
#[derive(Clone, Debug)]
pub struct VarDecl {
    /// Names; empty for an anonymous located variable.
    pub names: Vec<Name>,
    /// AT.
    pub at: Option<Address>,
    /// AT in a structure.
    pub relative: Option<RelativeAddress>,
    /// Type.
    pub ty: TypeRef,
    /// R_EDGE or F_EDGE.
    pub edge: Option<Edge>,
    /// `(a := 1)` behind the type (vendor): arguments of FB_init, or values of inputs.
    pub arguments: Option<Init>,
    /// Initial value.
    pub init: Option<Init>,
    /// All of it.
    pub span: Span,
}

/// `%B2`, `%X3.0`: a place in a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct RelativeAddress {
    /// X or B.
    pub size: AddressSize,
    pub byte: u32,
    /// 0 if left out.
    pub bit: u32,
    /// Where.
    pub span: Span,
}

/// STRUCT with addresses, STRUCT OVERLAP or UNION.
#[derive(Clone, Debug)]
pub struct LayoutDecl {
    pub members: Vec<VarDecl>,
    /// Members may share bytes.
    pub overlap: bool,
    /// All members begin at 0.
    pub union: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    Rising,
    Falling,
}

/// `%QX0.1`: a direct address.
#[derive(Clone, Debug, PartialEq)]
pub struct Address {
    /// I, Q or M.
    pub area: Area,
    /// X (also when left out), B, W, D, L.
    pub size: AddressSize,
    /// Numbers between the dots; empty for `%I*`.
    pub path: Vec<u32>,
    /// Where.
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Area {
    Input,
    Output,
    Marker,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AddressSize {
    Bit,
    Byte,
    Word,
    Dword,
    Lword,
}

/// `Name : body := init;` in TYPE ... END_TYPE.
#[derive(Clone, Debug)]
pub struct TypeDecl {
    /// New name.
    pub name: Name,
    /// The structure whose members come first (vendor).
    pub extends: Option<Name>,
    /// What it stands for.
    pub body: TypeBody,
    /// Default initial value.
    pub init: Option<Init>,
}

/// Right side of a type declaration.
#[derive(Clone, Debug)]
pub enum TypeBody {
    /// Alias, array, string, subrange.
    Ref(TypeRef),
    /// `(A, B := 5)`, `DWORD (A := 1)`, `(A, B) USINT`.
    Enum(EnumDecl),
    Struct(Vec<VarDecl>),
}

/// Values of an enumeration.
#[derive(Clone, Debug)]
pub struct EnumDecl {
    /// Base type, if named.
    pub base: Option<Name>,
    /// Names with their explicit values.
    pub values: Vec<(Name, Option<Expr>)>,
    /// All of it.
    pub span: Span,
}

/// A type where it is used.
#[derive(Clone, Debug)]
pub struct TypeRef {
    /// What is written.
    pub kind: TypeRefKind,
    /// Where.
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum TypeRefKind {
    /// Elementary, derived or POU name.
    Named(Name),
    /// `STRING`, `STRING[80]`, `STRING(80)`; `wide`: WSTRING; `open`: `STRING[*]` (vendor).
    String {
        wide: bool,
        open: bool,
        capacity: Option<Box<Expr>>,
    },
    /// `INT (0..9)`.
    Subrange {
        base: Name,
        low: Box<Expr>,
        high: Box<Expr>,
    },
    Array {
        dims: Vec<(Expr, Expr)>,
        element: Box<TypeRef>,
    },
    /// `REF_TO T`, `POINTER TO T`, `REFERENCE TO T`.
    Pointer {
        kind: takt_image::types::PointerKind,
        target: Box<TypeRef>,
    },
    /// `ARRAY [*, *] OF T`.
    OpenArray {
        dims: usize,
        element: Box<TypeRef>,
    },
    /// Anonymous enumeration.
    Enum(EnumDecl),
    /// STRUCT with addresses, STRUCT OVERLAP or UNION.
    Layout(LayoutDecl),
    /// Anonymous structure (vendor).
    Struct(Vec<VarDecl>),
    /// Something was wrong here and has been reported.
    Error,
}

/// An initial value.
#[derive(Clone, Debug)]
pub enum Init {
    Expr(Expr),
    /// `[1, 2(0), (a := 1)]`
    Array(Vec<ArrayInit>, Span),
    /// `(a := 1, b := [1, 2])`
    Struct(Vec<(Name, Init)>, Span),
    /// `(1, a)` behind the type of an instance (vendor).
    Positional(Vec<Expr>, Span),
}

/// An element of an array initial value.
#[derive(Clone, Debug)]
pub enum ArrayInit {
    One(Init),
    /// `3(0, 1)`; an empty list means default elements.
    Repeat(Expr, Vec<Init>),
}

impl Init {
    /// Where it stands.
    pub fn span(&self) -> Span {
        match self {
            Init::Expr(e) => e.span,
            Init::Array(_, s) | Init::Struct(_, s) | Init::Positional(_, s) => *s,
        }
    }
}

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
    Instructions(Vec<super::il::Line>),
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
