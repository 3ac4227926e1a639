//! The configuration: tasks, program instances, and what is said about single instances (language reference §3.7, §3.8, §10).
#![allow(missing_docs)] // the names of fields and variants say it; what they do not say stands beside them

use super::{Const, Expr, GlobalId, Keep, Place, PouId, VarId};
use std::collections::{BTreeMap, BTreeSet};
use takt_base::Nanos;
use takt_image::TypeId;
use takt_image::image::Place as ImagePlace;

/// How a resource sees the globals: units are resolved once, with one of the variables of a name; in this resource they may mean
/// another one (§3.5).
#[derive(Clone, Debug, Default)]
pub struct View {
    /// Variable that a unit was resolved with, and the one of this resource.
    pub renamed: BTreeMap<GlobalId, GlobalId>,
    /// Units for which that makes a difference: they are lowered for this resource by themselves.
    pub own: BTreeSet<PouId>,
}

/// A place that is known before anything runs.
#[derive(Clone, Debug)]
pub enum Spot {
    /// In the process image.
    Image(ImagePlace),
    /// Bytes behind the start of a global or a program instance.
    Part(Root, u32),
}

/// A path of VAR_ACCESS (§3.8).
#[derive(Clone, Debug)]
pub struct AccessPath {
    pub name: String,
    pub spot: Spot,
    pub ty: TypeId,
    /// READ_WRITE.
    pub writable: bool,
}

/// A function block with a task of its own (§10.2).
#[derive(Clone, Debug)]
pub struct BoundBlock {
    /// `program.variable`.
    pub name: String,
    /// Its type.
    pub pou: PouId,
    /// The program instance, and bytes behind its start.
    pub program: Root,
    pub offset: u32,
}

/// A task of a resource.
#[derive(Debug)]
pub struct Task {
    /// Name.
    pub name: String,
    /// 0 is the highest.
    pub priority: u32,
    /// Period.
    pub interval: Option<Nanos>,
    /// SINGLE: a global BOOL, a bit of the process image or a variable of a program.
    pub single: Option<Spot>,
    /// Number of its resource.
    pub resource: u32,
    /// Instances in declaration order.
    pub programs: Vec<ProgramInstance>,
    /// Function blocks with this task; they run behind the programs.
    pub blocks: Vec<BoundBlock>,
}

/// What an instance path begins with.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Root {
    Global(GlobalId),
    /// A program instance: number of its resource, and its name in capitals.
    Program(u32, String),
}

/// A field of one instance that stands for an address: copied in before each program that may use it runs, and back afterwards.
#[derive(Clone, Debug)]
pub struct Mirror {
    pub root: Root,
    /// Bytes behind the start of the root.
    pub offset: u32,
    pub ty: TypeId,
    /// The address.
    pub place: ImagePlace,
    /// In %I: not copied back.
    pub input: bool,
    /// Initial value.
    pub init: Const,
}

impl Mirror {
    /// True if a program instance may use it when it runs.
    pub fn is_seen_by(&self, program: &Root) -> bool {
        matches!(self.root, Root::Global(_)) || self.root == *program
    }
}

/// A program instance.
#[derive(Debug)]
pub struct ProgramInstance {
    /// Instance name.
    pub name: String,
    /// Its type.
    pub pou: PouId,
    /// Number of its resource.
    pub resource: u32,
    /// PROGRAM RETAIN.
    pub keep: Keep,
    /// Initial value of the whole instance, if VAR_CONFIG gives one to a part of it.
    pub init: Option<Const>,
    /// The variable that this instance is, if it is one (vendor).
    pub global: Option<GlobalId>,
    /// Copied before each run: input (or output) variable of the program, value.
    pub inputs: Vec<(VarId, Expr)>,
    /// Copied after each run.
    pub outputs: Vec<(VarId, Place)>,
}

impl ProgramInstance {
    /// What paths to it begin with.
    pub fn root(&self) -> Root {
        Root::Program(self.resource, self.name.to_ascii_uppercase())
    }
}
