//! The typed program: names have become ids, every expression has a type, every implicit conversion is written out, calls have all
//! their arguments in order. ST, IL and the graphical languages meet here.
#![allow(missing_docs)] // the names of fields and variants say it; what they do not say stands beside them

mod body;
mod config;

use crate::syntax::ast::{BinaryOp, Edge};
pub use body::*;
pub use config::*;
use takt_base::index::IndexVec;
use takt_base::{SourceId, Span};
use takt_image::image::Place as ImagePlace;
use takt_image::{Elementary, TypeId, TypeTable};
use takt_stdlib::catalog::Intrinsic;

takt_base::index_type! {
    /// A FUNCTION, FUNCTION_BLOCK or PROGRAM in [`Hir::pous`].
    PouId
}
takt_base::index_type! {
    /// A variable of a unit, in [`Pou::vars`].
    VarId
}
takt_base::index_type! {
    /// A global variable in [`Hir::globals`].
    GlobalId
}

/// A whole program.
#[derive(Debug, Default)]
pub struct Hir {
    /// All types; goes into the image as it is.
    pub types: TypeTable,
    /// Units that a task reaches, directly or through calls, come before lowering; others are checked but not lowered.
    pub pous: IndexVec<PouId, Pou>,
    /// VAR_GLOBAL variables.
    pub globals: IndexVec<GlobalId, Global>,
    /// Tasks of all resources with their program instances.
    pub tasks: Vec<Task>,
    /// Names of the resources if there are several: paths begin with them (§10.1). Empty for one.
    pub resources: Vec<String>,
    /// Of each resource, if there are several: what its units mean by the names of globals.
    pub views: Vec<View>,
    /// VAR_ACCESS.
    pub accesses: Vec<AccessPath>,
    /// Variables of single instances that stand for an address, which VAR_CONFIG gives.
    pub mirrors: Vec<Mirror>,
    /// What runs before the first scan.
    pub start: Option<Start>,
    /// A program may be a variable too (vendor): its instance may be a global.
    pub programs_are_instances: bool,
    /// Bytes used in %I, %Q, %M: one past the highest address.
    pub image_bytes: [u32; 3],
}

/// Code that runs once before the first scan, see `hir::startup`.
#[derive(Debug, Default)]
pub struct Start {
    /// Sets up the global variables.
    pub globals: Option<PouId>,
    /// Programs, each with the unit that sets up an instance of it.
    pub programs: Vec<(PouId, PouId)>,
    /// A retained BOOL that becomes TRUE behind all that.
    pub kept: Option<GlobalId>,
    /// The tasks are unit tests: each sets up its own programs only.
    pub alone: bool,
}

/// A unit.
#[derive(Debug)]
pub struct Pou {
    /// Name as declared.
    pub name: String,
    /// Which.
    pub kind: PouKind,
    /// Of a method: the type that it is declared in.
    pub owner: Option<PouId>,
    /// The function block or class that this one extends. Its variables come first, under the same ids and fields.
    pub base: Option<PouId>,
    /// Contents of the hidden first field of instances, if the type takes part in dynamic binding.
    pub class: Option<u32>,
    /// File of the declaration.
    pub source: SourceId,
    /// For function blocks and programs: the [`takt_image::Type::Instance`] whose fields are `vars` with storage `Field`.
    pub instance: Option<TypeId>,
    /// All variables, in declaration order.
    pub vars: IndexVec<VarId, Var>,
    /// Variables that make up the signature, in declaration order: inputs, in-outs and outputs.
    pub params: Vec<VarId>,
    /// Result variable of a function.
    pub result: Option<VarId>,
    /// The body is the native of this name.
    pub external: bool,
    /// Statements.
    pub body: Vec<Stmt>,
    /// The END_ keyword: place of what happens at the end.
    pub end: Span,
    /// Reached from a task.
    pub reachable: bool,
    /// Actions use its VAR_IN_OUT variables: after a call these are bound to nothing.
    pub unbinds: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PouKind {
    Function,
    FunctionBlock,
    Program,
    Class,
    /// Has no body and no variables; its methods are signatures.
    Interface,
    /// Of a function block, class, program or interface; see [`Pou::owner`].
    Method,
}

impl PouKind {
    /// Variables start anew at each call; arguments are handed over as parameters.
    pub fn is_called_by_value(self) -> bool {
        matches!(self, PouKind::Function | PouKind::Method)
    }
}

/// A variable of a unit.
#[derive(Clone, Debug)]
pub struct Var {
    /// Name as declared.
    pub name: String,
    /// Type; for VAR_IN_OUT the type of what it refers to.
    pub ty: TypeId,
    /// VAR_INPUT, ...
    pub role: Role,
    /// Where it lives.
    pub storage: Storage,
    /// Value at the start of a call (functions, VAR_TEMP) or in a new instance; always complete.
    pub init: Const,
    /// RETAIN and its kin.
    pub keep: Keep,
    /// A VAR_IN_OUT that is an input, copied back to the argument after the call (openplc).
    pub copied_back: bool,
    /// R_EDGE or F_EDGE, with the hidden BOOL field that holds the previous value of the actual input.
    pub edge: Option<(Edge, VarId)>,
    /// Declaration.
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    Input,
    Output,
    InOut,
    Local,
    Temp,
    /// Result of a function.
    Result,
    /// Made by the compiler.
    Hidden,
}

/// Whether a variable keeps its value over a restart (§10.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Keep {
    /// Like what it is in.
    #[default]
    Unsaid,
    NonRetain,
    Retain,
    /// Over a cold start too (vendor).
    Persistent,
}

impl Keep {
    /// That of a part that says `own`.
    pub fn or(self, own: Keep) -> Keep {
        if own == Keep::Unsaid { self } else { own }
    }
    /// The value is kept.
    pub fn is_kept(self) -> bool {
        matches!(self, Keep::Retain | Keep::Persistent)
    }
    /// As the qualifiers of a section say.
    pub fn of(section: &crate::syntax::ast::VarSection) -> Keep {
        match (section.constant, section.persistent, section.retain) {
            (true, ..) | (_, false, Some(false)) => Keep::NonRetain,
            (_, true, _) => Keep::Persistent,
            (_, _, Some(true)) => Keep::Retain,
            (_, _, None) => Keep::Unsaid,
        }
    }
}

/// Where a variable lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Field of the instance, by index into the record's fields. A VAR_IN_OUT field holds an offset.
    Field(u32),
    /// On the frame or in a register, one per call. A VAR_IN_OUT local holds an offset.
    Local,
    /// Located: in the process image.
    Image(ImagePlace),
}

/// A global variable.
#[derive(Debug)]
pub struct Global {
    /// Name as declared.
    pub name: String,
    /// Type.
    pub ty: TypeId,
    /// Located, or given a place in the data area by the lowering.
    pub place: Option<ImagePlace>,
    /// Initial value.
    pub init: Const,
    /// CONSTANT.
    pub constant: bool,
    /// RETAIN and its kin.
    pub keep: Keep,
    /// Number of the resource that it belongs to, if it is not for all.
    pub resource: Option<u32>,
    /// Declaration.
    pub span: Span,
}

/// A constant of any type. Complete: every element and member is there.
#[derive(Clone, PartialEq, Debug)]
pub enum Const {
    /// Everything that is stored as an integer, BOOL, times and enumerators included.
    Int(i128),
    /// REAL (already rounded to f32) and LREAL.
    Real(f64),
    /// Not longer than the type's capacity.
    String(Vec<u8>),
    /// Not longer than the type's capacity.
    WString(Vec<u16>),
    /// Elements of an array in memory order, or fields of a record in order.
    Aggregate(Vec<Const>),
    /// The place of a global variable, and bytes behind its start: value of a reference.
    Address(GlobalId, u32),
    /// All bytes zero, whatever the type, alone or as a part: cheap form of a large default.
    Zero,
}

impl Hir {
    /// Name of something of a resource: with one resource its name is left out.
    pub fn path(&self, resource: Option<u32>, name: &str) -> String {
        match resource.and_then(|r| self.resources.get(r as usize)) {
            Some(resource) => format!("{resource}.{name}"),
            None => name.to_owned(),
        }
    }
    /// Path of a global.
    pub fn global_path(&self, g: &Global) -> String {
        self.path(g.resource, &g.name)
    }
    /// True if `sub` is `base` or extends it.
    pub fn extends(&self, sub: PouId, base: PouId) -> bool {
        let mut line = std::iter::successors(Some(sub), |id| self.pous[*id].base);
        line.any(|id| id == base)
    }
    /// True if the VAR_IN_OUT variables of the unit are bound to nothing after a call.
    pub fn unbinds(&self, id: PouId) -> bool {
        let mut line = std::iter::successors(Some(id), |id| self.pous[*id].base);
        line.any(|id| self.pous[id].unbinds)
    }
    /// Storage type of a scalar.
    pub fn elementary(&self, ty: TypeId) -> Option<Elementary> {
        self.types.storage(ty)
    }
}
