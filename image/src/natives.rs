//! Functions and function blocks that are not compiled from IEC text: their imports, and the two traits through which `cli` hands
//! the library and the motion kernel to the runtime.
//!
//! A call passes scalars in 64-bit slots, integers sign- or zero-extended by their IEC type, REAL as its 32 bits. A STRING or
//! WSTRING takes two slots: offset and capacity. A function block takes one: the offset of its instance. The generated code calls
//! the function whose address stands at `header::NATIVE_ENTRY` as
//! `extern "sysv64" fn(memory: *mut u8, import: u32, args: *const u64, result: *mut u64) -> u32`, which returns 0 or a trap number.

use crate::traps::Trap;
use crate::types::{TypeId, TypeTable};
use takt_base::Nanos;

/// A machine type: what a register holds.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
#[allow(missing_docs)]
pub enum Scalar {
    I8,
    I16,
    I32,
    I64,
    F32,
    F64,
}

impl Scalar {
    /// Size in bytes.
    pub const fn bytes(self) -> u32 {
        match self {
            Scalar::I8 => 1,
            Scalar::I16 => 2,
            Scalar::I32 | Scalar::F32 => 4,
            Scalar::I64 | Scalar::F64 => 8,
        }
    }
    /// F32 or F64.
    pub const fn is_float(self) -> bool {
        matches!(self, Scalar::F32 | Scalar::F64)
    }
}

/// Something that an image needs from its host.
#[derive(Clone, PartialEq, Debug)]
pub struct NativeImport {
    /// Name, such as `SIN_LREAL` or `MC_Power`.
    pub name: String,
    /// What it is.
    pub kind: NativeKind,
}

/// Signature of an import.
#[derive(Clone, PartialEq, Debug)]
pub enum NativeKind {
    /// Function of scalars.
    Function {
        /// One per slot.
        params: Vec<Scalar>,
        /// What it returns.
        result: Option<Scalar>,
    },
    /// Function block: slot 0 is the offset of the instance, whose type is a [`crate::types::Type::Instance`].
    Block {
        /// Layout of the instance.
        ty: TypeId,
    },
}

/// Most slots of a call.
pub const MAX_SLOTS: usize = 32;

/// One call of a native.
pub struct NativeCall<'a> {
    /// The resource memory.
    pub memory: &'a mut [u8],
    /// Arguments.
    pub args: &'a [u64],
    /// Where the result goes, if the function has one.
    pub result: u64,
    /// Time sample of the activation.
    pub now: Nanos,
}

impl NativeCall<'_> {
    /// Slot `i` as an offset or small integer; 0 if there is no such slot.
    pub fn u32(&self, i: usize) -> u32 {
        self.args.get(i).map_or(0, |&a| a as u32)
    }
    /// Slot `i` as a signed integer.
    pub fn i64(&self, i: usize) -> i64 {
        self.args.get(i).map_or(0, |&a| a as i64)
    }
    /// Slot `i` as LREAL.
    pub fn f64(&self, i: usize) -> f64 {
        f64::from_bits(self.args.get(i).copied().unwrap_or(0))
    }
    /// Slot `i` as REAL.
    pub fn f32(&self, i: usize) -> f32 {
        f32::from_bits(self.u32(i))
    }
    /// Notes an error of a library function: ENO of the call becomes FALSE.
    pub fn fail(&mut self) {
        if let Some(eno) = self.memory.get_mut(crate::memory::header::ENO as usize) {
            *eno = 0;
        }
    }
    /// `size` bytes of memory at `offset`.
    pub fn bytes(&self, offset: u32, size: u32) -> Result<&[u8], Trap> {
        self.memory.get(offset as usize..offset as usize + size as usize).ok_or(Trap::Memory)
    }
    /// `size` bytes of memory at `offset`, to write.
    pub fn bytes_mut(&mut self, offset: u32, size: u32) -> Result<&mut [u8], Trap> {
        self.memory.get_mut(offset as usize..offset as usize + size as usize).ok_or(Trap::Memory)
    }
}

/// Why an import can't be bound.
#[derive(Clone, PartialEq, Debug)]
pub enum BindError {
    /// Nobody has it.
    Unknown,
    /// It is there, but with another signature or other pins; the text says which.
    Mismatch(String),
}

/// A set of natives. Bound once at load, called in the scan.
pub trait Natives {
    /// Finds the import and prepares it (offsets of its pins). Returns the number to call it by.
    fn bind(&mut self, import: &NativeImport, types: &TypeTable) -> Result<u32, BindError>;
    /// Calls it. Runs: cyclic.
    fn call(&mut self, native: u32, call: &mut NativeCall) -> Result<(), Trap>;
}

/// Something that runs beside the program at a fixed period: the motion kernel.
pub trait Cyclic {
    /// Period of `tick`; `None` if there is nothing to run.
    fn period(&self) -> Option<Nanos>;
    /// One period. Runs: cyclic.
    fn tick(&mut self, now: Nanos);
    /// Right behind each tick: the variables of the program that the host reads and writes. Runs: cyclic, never during a scan.
    fn exchange(&mut self, _now: Nanos, _memory: &mut [u8]) {}
    /// Brings everything that moves to its safe state: after a fault or at the end of a run. Called once; ticks may go on.
    fn safe_stop(&mut self);
}

/// What the runtime is given: natives and a cyclic part that share their state.
pub trait Host: Natives + Cyclic {}
impl<T: Natives + Cyclic> Host for T {}
