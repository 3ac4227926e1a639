//! Variables, addresses, types and initial values as they are declared (§2, §3).

use super::*;

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
