//! Typed statements, expressions and places.

use super::*;

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
