//! CONFIGURATION with its resources, tasks, programs, VAR_CONFIG and VAR_ACCESS.
//! From: IEC 61131-3 §6.8.2 (language reference §3.7, §3.8, §10.1).

use super::{Address, Arg, Expr, Init, Name, TypeRef, VarSection};
use takt_base::Span;

/// CONFIGURATION ... END_CONFIGURATION.
#[derive(Clone, Debug)]
pub struct Configuration {
    /// Its name.
    pub name: Name,
    /// Configuration globals.
    pub globals: Vec<VarSection>,
    /// Resources; one without a name if tasks and programs stand directly in the configuration.
    pub resources: Vec<Resource>,
    /// VAR_CONFIG.
    pub config: Vec<ConfigDecl>,
    /// VAR_ACCESS.
    pub access: Vec<AccessDecl>,
}

/// RESOURCE name ON type.
#[derive(Clone, Debug)]
pub struct Resource {
    pub name: Option<Name>,
    pub globals: Vec<VarSection>,
    pub tasks: Vec<TaskDecl>,
    pub programs: Vec<ProgramDecl>,
}

/// `TASK name (SINGLE := s, INTERVAL := T#10ms, PRIORITY := 1);`
#[derive(Clone, Debug)]
pub struct TaskDecl {
    pub name: Name,
    pub single: Option<Expr>,
    pub interval: Option<Expr>,
    pub priority: Option<Expr>,
}

/// `PROGRAM name WITH task : Type (in := global, out => global, fb WITH task);`
#[derive(Clone, Debug)]
pub struct ProgramDecl {
    pub name: Name,
    pub retain: Option<bool>,
    pub task: Option<Name>,
    pub ty: Name,
    pub connections: Vec<Arg>,
    /// Function blocks with a task of their own: `fb WITH task`.
    pub blocks: Vec<(Name, Name)>,
}

/// `Res.Prog.block[2].x`, `Res.%IX1.1`.
#[derive(Clone, Debug)]
pub struct InstancePath {
    pub parts: Vec<PathPart>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum PathPart {
    Name(Name),
    Index(Vec<Expr>, Span),
    Direct(Address),
}

/// `Res.Prog.block.x AT %QX1.0 : BOOL := 1;` in VAR_CONFIG.
#[derive(Clone, Debug)]
pub struct ConfigDecl {
    pub path: InstancePath,
    pub at: Option<Address>,
    pub ty: TypeRef,
    pub init: Option<Init>,
}

/// `ABLE : Res.Prog.x : INT READ_WRITE;` in VAR_ACCESS of a configuration; in that of a program the path begins there.
#[derive(Clone, Debug)]
pub struct AccessDecl {
    pub name: Name,
    pub path: InstancePath,
    pub ty: TypeRef,
    /// READ_WRITE.
    pub writable: bool,
}
