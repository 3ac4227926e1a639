//! The tree of a source file, as written: names are text, nothing has a type yet. Every node knows its span.
//! From: IEC 61131-3 edition 3, §6 and §7.3. Shared by all textual languages.
#![allow(missing_docs)] // the names of fields and variants say it; what they do not say stands beside them

mod body;
mod config;
mod decl;
mod operator;

pub use body::{Arg, AssignOp, CaseArm, CaseLabel, Expr, ExprKind, Literal, Stmt, StmtKind};
pub use config::{AccessDecl, ConfigDecl, Configuration, InstancePath, PathPart, ProgramDecl, Resource, TaskDecl};
pub use decl::{
    Address, AddressSize, Area, ArrayInit, Edge, EnumDecl, Init, LayoutDecl, RelativeAddress, SectionKind, TypeBody, TypeDecl,
    TypeRef, TypeRefKind, VarDecl, VarSection,
};
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
