//! Reference interpreter: what a module means, instruction by instruction. The code generator must agree with it bit for bit.
//!
//! Runs: cyclic, though slowly; memory for registers and calls is taken once. It never panics: a module is verified before it is
//! accepted, every memory access is checked, and instructions, calls, registers and frames are limited.
//! A shift amount counts modulo the width. The payload of a NaN that an operation makes is not defined.

mod arith;
mod memory;
mod step;

use super::model::*;
use super::verify::{Problem, verify};
use std::sync::Arc;
use takt_base::Nanos;
use takt_base::index::Index;
use takt_image::memory::Area;
use takt_image::{BindError, Engine, Fault, Natives, Trap, TypeTable, header};

/// Instructions that a microsecond of budget allows.
pub const INSTRUCTIONS_PER_US: u64 = 100;
/// Calls within calls.
pub const MAX_DEPTH: usize = 4096;
/// Registers of all functions that are being called.
pub const MAX_REGISTERS: usize = 1 << 18;

/// Executes a [`Module`]. `FuncId`, `LineId::file` and `NativeId` are the indices of the image's functions, files and natives.
#[derive(Debug)]
pub struct Interpreter {
    module: Arc<Module>,
    bindings: Vec<u32>,
    frames: Area,
    registers: Vec<u64>,
    calls: Vec<Activation>,
}

/// A function that is being executed.
#[derive(Clone, Copy, Debug)]
struct Activation {
    function: FuncId,
    block: BlockId,
    /// Next instruction in the block.
    next: usize,
    /// First register.
    registers: usize,
    /// Offset of its frame in memory.
    frame: u32,
}

/// What a call is given beside its arguments.
pub struct Context<'a> {
    /// Time sample of the activation.
    pub now: Nanos,
    /// Time after which the watchdog stops it.
    pub budget: Nanos,
    /// The resource memory.
    pub memory: &'a mut [u8],
    /// What natives are called.
    pub natives: &'a mut dyn Natives,
}

impl Interpreter {
    /// Prepares a module. `bindings[i]` is the number by which `natives` calls `module.natives[i]`, `frames` the frame area of the
    /// memory. Fails if the module breaks a rule.
    pub fn new(module: Arc<Module>, bindings: Vec<u32>, frames: Area) -> Result<Self, Vec<Problem>> {
        let problems = verify(&module);
        if !problems.is_empty() {
            return Err(problems);
        }
        let registers = Vec::with_capacity(MAX_REGISTERS.min(1 << 12));
        Ok(Self { module, bindings, frames, registers, calls: Vec::with_capacity(64) })
    }

    /// Binds all natives of a module, in order: the `bindings` of [`Interpreter::new`]. Fails with the name of an import.
    pub fn bind(module: &Module, natives: &mut dyn Natives, types: &TypeTable) -> Result<Vec<u32>, (String, BindError)> {
        module.natives.iter().map(|n| natives.bind(n, types).map_err(|e| (n.name.clone(), e))).collect()
    }

    /// The module.
    pub fn module(&self) -> &Arc<Module> {
        &self.module
    }

    /// Calls a function with registers as arguments (missing ones are 0) and returns its result register (0 if it has none).
    pub fn call(&mut self, function: FuncId, args: &[u64], context: &mut Context) -> Result<u64, Fault> {
        write_now(context.memory, context.now);
        self.registers.clear();
        self.calls.clear();
        let module = Arc::clone(&self.module);
        step::Machine::new(&module, self, context).call(function, args)
    }
}

impl Engine for Interpreter {
    fn run(
        &mut self,
        function: u32,
        instance: u32,
        now: Nanos,
        budget: Nanos,
        memory: &mut [u8],
        natives: &mut dyn Natives,
    ) -> Result<(), Fault> {
        let mut context = Context { now, budget, memory, natives };
        self.call(FuncId(function), &[u64::from(instance)], &mut context).map(drop)
    }
}

fn write_now(memory: &mut [u8], now: Nanos) {
    let start = header::NOW as usize;
    if let Some(place) = memory.get_mut(start..start + 8) {
        place.copy_from_slice(&now.0.to_le_bytes());
    }
}

/// The fault of a trap at a line of a function.
fn fault(module: &Module, trap: Trap, function: FuncId, line: Option<LineId>) -> Fault {
    let line = line.and_then(|l| module.lines.get(l));
    let function = if function.index() < module.functions.len() { function.0 } else { u32::MAX };
    Fault { trap, function, file: line.map_or(u32::MAX, |l| l.file), line: line.map_or(0, |l| l.line) }
}

#[cfg(test)]
mod tests;
