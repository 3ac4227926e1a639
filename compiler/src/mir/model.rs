//! Functions as basic blocks over typed locals: explicit conversions, checks and calls, no names to resolve.
//!
//! Locals are assigned any number of times; the code generator turns them into SSA values. Memory is reached through 32-bit
//! offsets from the start of the resource memory ([`takt_image::memory`]), so an address is an `i32` local and the interpreter and
//! native code see the same bytes. BOOL is an `i8` that is always 0 or 1.
#![allow(missing_docs)] // the names of fields and variants say it; what they do not say stands beside them

use takt_base::index::IndexVec;
use takt_image::{NativeImport, Scalar, Trap};

takt_base::index_type! {
    /// A function of a [`Module`].
    FuncId
}
takt_base::index_type! {
    /// A local of a [`Function`].
    Local
}
takt_base::index_type! {
    /// A basic block of a [`Function`]; 0 is the entry.
    BlockId
}
takt_base::index_type! {
    /// An import of a [`Module`].
    NativeId
}
takt_base::index_type! {
    /// A source line in [`Module::lines`].
    LineId
}

/// All functions of a program.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Module {
    /// Functions.
    pub functions: IndexVec<FuncId, Function>,
    /// Natives that are called.
    pub natives: IndexVec<NativeId, NativeImport>,
    /// File names.
    pub files: Vec<String>,
    /// Source lines that instructions refer to.
    pub lines: IndexVec<LineId, Line>,
}

/// A line of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Line {
    /// Into [`Module::files`].
    pub file: u32,
    /// From 1.
    pub line: u32,
}

/// A function. Besides `params` it has two hidden parameters: the memory and the offset of its frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Unique name.
    pub name: String,
    /// Unit shown in faults.
    pub pou: String,
    /// Locals that hold the arguments at entry.
    pub params: Vec<Local>,
    /// Type of the result.
    pub result: Option<Scalar>,
    /// Types of all locals. A local that is read before it is written holds 0.
    pub locals: IndexVec<Local, Scalar>,
    /// Bytes of the frame: locals that have an address. Multiple of 8. Not cleared at entry.
    pub frame: u32,
    /// Blocks.
    pub blocks: IndexVec<BlockId, Block>,
}

impl Function {
    /// Line of the first instruction: where a fault at entry is reported.
    pub fn first_line(&self) -> Option<LineId> {
        let entry = self.blocks.get(BlockId(0))?;
        Some(entry.insts.first().map_or(entry.end_line, |i| i.line))
    }
}

/// Instructions without a branch, then one.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// In order.
    pub insts: Vec<Inst>,
    /// How it ends.
    pub end: End,
    /// Line of the end.
    pub end_line: LineId,
}

/// An instruction and its line.
#[derive(Clone, Debug, PartialEq)]
pub struct Inst {
    /// What it does.
    pub op: Op,
    /// Line for faults and traces.
    pub line: LineId,
}

/// Where in memory: `base + offset`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Addr {
    /// Start.
    pub base: AddrBase,
    /// Bytes behind it. For `Static` the whole offset.
    pub offset: u32,
}

/// Start of an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AddrBase {
    /// The memory itself: a fixed place.
    Static,
    /// This function's frame.
    Frame,
    /// An `i32` local that holds an offset.
    Local(Local),
}

/// What an instruction does. `dst` comes first.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// `dst = integer` of dst's type; only the low bits count.
    Int(Local, i64),
    /// `dst = number` of type F32 or F64. Given as bits of the F64 (F32 values are widened exactly), so that NaN compares equal.
    Float(Local, u64),
    /// `dst = src`, same type.
    Copy(Local, Local),
    /// `dst = op a`, all of one type.
    Unary(UnaryOp, Local, Local),
    /// `dst = a op b`, all of one type; shifts and rotations take the amount in the same type, already below the width.
    Binary(BinaryOp, Local, Local, Local),
    /// `dst = a cmp b` as 0 or 1 in an I8; a and b of one type.
    Compare(Compare, Local, Local, Local),
    /// `dst = convert src`; types of both locals say from where to where.
    Convert(Convert, Local, Local),
    /// `dst = if condition <> 0 then a else b`.
    Select { dst: Local, condition: Local, then: Local, otherwise: Local },
    /// `dst = memory[addr]`, type of dst.
    Load(Local, Addr),
    /// `memory[addr] = src`, type of src.
    Store(Addr, Local),
    /// `dst = offset of addr` (dst is I32).
    Address(Local, Addr),
    /// Copies bytes; the ranges may overlap.
    CopyBytes { to: Addr, from: Addr, size: u32 },
    /// Fills bytes.
    FillBytes { to: Addr, size: u32, value: u8 },
    /// Copies a zero-ended string, cut to the capacity of the target (units of 1 or 2 bytes), and ends it with a zero unit. The two
    /// are the same or do not overlap.
    CopyString { to: Addr, to_capacity: u32, from: Addr, from_capacity: u32, unit: u32 },
    /// `dst` (I8) = -1, 0 or 1: order of two zero-ended strings by code unit.
    CompareString { dst: Local, a: Addr, a_capacity: u32, b: Addr, b_capacity: u32, unit: u32 },
    /// Calls a function.
    Call { dst: Option<Local>, function: FuncId, args: Vec<Local> },
    /// Calls a native. Slots are made from the locals: integers sign-extended (`signed`) or zero-extended, F32 as its bits.
    CallNative { dst: Option<Local>, native: NativeId, args: Vec<NativeArg> },
    /// Traps if the condition (any integer type) is not 0.
    TrapIf(Trap, Local),
}

/// An argument slot of a native.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NativeArg {
    /// Value.
    pub local: Local,
    /// Sign-extend to 64 bits.
    pub signed: bool,
}

/// One operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UnaryOp {
    /// Integer negation, wraps.
    Neg,
    /// Bitwise complement.
    Not,
    FNeg,
    FAbs,
    FSqrt,
    /// To the nearest integer, ties to even.
    FNearest,
    FTrunc,
    FFloor,
    FCeil,
    /// Byte order.
    SwapBytes,
}

/// Two operands of one type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BinaryOp {
    Add,
    Sub,
    Mul,
    /// Signed division toward zero. The divisor is not 0 (checked before); min / -1 wraps to min.
    SDiv,
    UDiv,
    /// Remainder with the sign of the dividend. The divisor is not 0; min rem -1 = 0.
    SRem,
    URem,
    And,
    Or,
    Xor,
    Shl,
    /// Logical shift right.
    LShr,
    /// Arithmetic shift right.
    AShr,
    Rotl,
    Rotr,
    FAdd,
    FSub,
    FMul,
    FDiv,
}

/// Comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Compare {
    Eq,
    Ne,
    SLt,
    SLe,
    SGt,
    SGe,
    ULt,
    ULe,
    UGt,
    UGe,
    /// Ordered comparisons: false with NaN, except `FNe`, which is true.
    FEq,
    FNe,
    FLt,
    FLe,
    FGt,
    FGe,
}

/// Conversion between machine types.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Convert {
    /// To a wider integer.
    SignExtend,
    ZeroExtend,
    /// To a narrower integer: low bits.
    Truncate,
    /// Integer to float, nearest even.
    SignedToFloat,
    UnsignedToFloat,
    /// Float to integer toward zero, saturating, NaN to 0. Narrow results saturate at their own bounds.
    FloatToSigned,
    FloatToUnsigned,
    /// F32 to F64 or back, nearest even.
    Float,
    /// Same bits: I32 and F32, I64 and F64.
    Bits,
}

/// How a block ends.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// Goes on there.
    Jump(BlockId),
    /// `condition <> 0` decides.
    Branch { condition: Local, then: BlockId, otherwise: BlockId },
    /// Jumps by value; values are of the local's type, distinct.
    Switch { value: Local, cases: Vec<(i64, BlockId)>, otherwise: BlockId },
    /// Leaves the function.
    Return(Option<Local>),
    /// Always traps. If the block does nothing else, native code may report the line of the branch that led to it.
    Trap(Trap),
}
