//! The typed program: names have become ids, every expression has a type, every implicit conversion is written out, calls have all
//! their arguments in order. ST, IL and the graphical languages meet here.
#![allow(missing_docs)] // the names of fields and variants say it; what they do not say stands beside them

mod config;

use crate::syntax::ast::{BinaryOp, Edge};
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

/// A statement.
#[derive(Debug)]
pub struct Stmt {
    /// What it does.
    pub kind: StmtKind,
    /// Where: faults and traces point here.
    pub span: Span,
}

#[derive(Debug)]
pub enum StmtKind {
    /// The value has the target's type; strings may have another capacity and are cut.
    Assign {
        target: Place,
        value: Expr,
    },
    /// Run a function block: `inputs` are assigned in order, then the body runs, then `outputs` are copied.
    CallBlock {
        instance: Place,
        pou: PouId,
        inputs: Vec<(VarId, Arg)>,
        outputs: Vec<Output>,
    },
    /// A function as a statement; its result, if any, is dropped.
    Call(Expr),
    If {
        branches: Vec<(Expr, Vec<Stmt>)>,
        otherwise: Vec<Stmt>,
    },
    /// Labels are inclusive ranges of the selector's integer value and don't overlap.
    Case {
        selector: Expr,
        arms: Vec<(Vec<(i128, i128)>, Vec<Stmt>)>,
        otherwise: Vec<Stmt>,
    },
    /// All of the variable's elementary type (of a subrange its base). A step of zero traps (ForStep) when it is not constant. Trip count as in language reference §5.6.
    For {
        variable: Place,
        /// From, to, by.
        values: Box<[Expr; 3]>,
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
    Return,
    /// A place that the list's own statements, and those nested in them, can jump to. Unique in the unit.
    Label(LabelId),
    /// To a label of this list or of one around it.
    Jump(LabelId),
}

/// A label of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LabelId(pub u32);

/// An output that a call hands back.
#[derive(Debug)]
pub struct Output {
    pub var: VarId,
    pub target: Place,
    pub negated: bool,
    /// Conversion on the way, if the target is wider.
    pub convert: Option<(TypeId, TypeId)>,
}

/// An expression with its type.
#[derive(Clone, Debug)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Type of the value.
    pub ty: TypeId,
    /// Where.
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum ExprKind {
    Const(Const),
    Load(Place),
    /// The place of a variable, as the value of a reference or pointer.
    Address(Place),
    Neg(Box<Expr>),
    Not(Box<Expr>),
    /// Operands have one type (`shift` amounts and TIME * number excepted, which are intrinsics or conversions). Comparisons give
    /// BOOL. Strings compare by code unit. Short-circuit is decided here: `And`/`Or` of BOOL evaluate both sides,
    /// `AndThen`/`OrElse` skip; the checker turns `And`/`Or` of BOOL into those when the right side is pure and may trap.
    Binary(BinaryOp, Box<Expr>, Box<Expr>),
    /// Value conversion to `ty`: `how` says which.
    Convert(Conversion, Box<Expr>),
    /// A user function with all its parameters in order of [`Pou::params`]. Without a result the type is BOOL and means nothing.
    Call {
        pou: PouId,
        args: Vec<Arg>,
    },
    /// A method; without a result the type is BOOL and means nothing.
    CallMethod(Box<MethodCall>),
    /// The offset of an instance, as a value of an interface type.
    AddressOf(Place),
    /// The reference itself if its instance is of one of these classes, else NULL.
    OfClass(Box<Expr>, Vec<u32>),
    /// Stores a scalar, and is the value that the place then has.
    Stored(Box<(Place, Expr)>),
    Intrinsic(Intrinsic, Vec<Expr>),
    /// A call with EN or ENO: library errors give their stated value instead of a fault. Not run, it is zero.
    Guarded(Box<Guarded>),
    /// A library native by its full name; argument order as in the catalogue, scalars already converted. A string result has type
    /// `ty`, a STRING large enough.
    Native {
        name: String,
        args: Vec<Expr>,
    },
}

/// A call with EN or ENO (language reference §4.8).
#[derive(Clone, Debug)]
pub struct Guarded {
    pub call: Expr,
    /// Nothing of the call is evaluated if it is FALSE.
    pub en: Option<Expr>,
    pub eno: Option<Eno>,
}

/// Where ENO goes.
#[derive(Clone, Debug)]
pub struct Eno {
    pub target: Place,
    pub negated: bool,
    /// The unit declares ENO: the call itself writes the target when it runs.
    pub written: bool,
}

/// A call of a method.
#[derive(Clone, Debug)]
pub struct MethodCall {
    pub receiver: Receiver,
    /// The method of the receiver's static type: it has the signature.
    pub method: PouId,
    /// Methods by class number if the instance decides which one runs; empty: `method` runs.
    pub dynamic: Vec<(u32, PouId)>,
    /// In order of [`Pou::params`] of `method`.
    pub args: Vec<Arg>,
}

impl MethodCall {
    /// The methods that may run.
    pub fn targets(&self) -> Vec<PouId> {
        let mut list: Vec<_> = self.dynamic.iter().map(|d| d.1).collect();
        if self.dynamic.is_empty() {
            list.push(self.method);
        }
        list.sort();
        list.dedup();
        list
    }
}

/// Whose method is called.
#[derive(Clone, Debug)]
pub enum Receiver {
    /// An instance.
    Place(Place),
    /// A reference to one; NULL traps.
    Reference(Expr),
}

/// Conversions between scalar types; source and target storage are in the types.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Conversion {
    /// Integer, bit string, enumeration, time (as its number): sign- or zero-extend by the source type, or keep the low bits.
    Integer,
    /// Like `Integer`, but a signed source is zero-extended (profile std: INT_TO_DWORD).
    ZeroExtend,
    /// Value <> 0 to BOOL.
    NonZero,
    /// Bit 0 to BOOL.
    LowBit,
    /// Integer to real, nearest even.
    IntToReal,
    /// Real to integer, nearest even, saturating, NaN to 0.
    RealToInt,
    /// Like `RealToInt`, halves away from zero (profile codesys).
    RealToIntAway,
    /// REAL to LREAL or back.
    Real,
    /// DWORD to REAL and the like: same bits.
    Bits,
    /// To a subrange or back; to a subrange it traps (Range) when outside.
    Subrange,
    /// STRING to STRING of another capacity, CHAR to STRING.
    String,
}

/// An argument of a user function or a block input.
#[derive(Clone, Debug)]
pub enum Arg {
    /// VAR_INPUT by value.
    Value(Expr),
    /// VAR_IN_OUT.
    Reference(Place),
    /// VAR_OUTPUT of a function: where it goes, complemented or not; widened if the target's type is wider than the parameter's.
    Output { target: Place, negated: bool },
    /// VAR_OUTPUT of a function that nobody wants.
    Unused,
}

/// Something that can be read or written.
#[derive(Clone, Debug)]
pub struct Place {
    /// Where it begins.
    pub base: Base,
    /// Steps from there.
    pub path: Vec<Step>,
    /// Type of what is found there.
    pub ty: TypeId,
    /// Where it is written.
    pub span: Span,
}

/// Start of a place.
#[derive(Clone, Debug)]
pub enum Base {
    /// Variable of the running unit; a VAR_IN_OUT means what it refers to.
    Var(VarId),
    /// The running instance of the type that the unit is or belongs to.
    This,
    Global(GlobalId),
    /// Direct address.
    Image(ImagePlace),
    /// The value of a reference that is no variable; the first step is `Deref`.
    Value(Box<Expr>),
}

/// A step along a place.
#[derive(Clone, Debug)]
pub enum Step {
    /// What the reference or pointer there refers to; NULL and what is no variable trap.
    Deref,
    /// Field of a structure or instance, by index.
    Field(u32),
    /// Element of an array: one expression per dimension, DINT or LINT; out of bounds traps (Index).
    Index(Vec<Expr>),
    /// Bits `bit .. bit + width` of an integer-like value: w.3, d.%B1. Last step only.
    Part { bit: u32, width: u32 },
    /// Character of a string, from 1; traps (StringIndex) outside of the current length.
    Character(Box<Expr>),
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
