//! MIR to x86-64 machine code. Cranelift is named in this folder alone.
//!
//! The code is position independent and has no relocations: calls between functions are patched here, constants lie behind their
//! function. A function is called as `extern "sysv64" fn(memory: *mut u8, frame: u32, args...)` and knows nothing but what it is
//! given: the header of the memory holds stack limit, frame limit and native entry.
//! Invariant: same module, same bytes, on every machine; nothing is taken from the host. The module is verified.

mod address;
mod arith;
mod bytes;
mod calls;
mod function;
mod isa;
mod link;
mod ops;
mod strings;

pub use isa::Effort;

use crate::mir::model::{FuncId, Module};
use cranelift_codegen::Context;
use cranelift_codegen::control::ControlPlane;
use cranelift_frontend::FunctionBuilderContext;
use isa::Target;
use link::{Compiled, Linker};
use std::num::NonZero;
use std::thread;
use takt_base::index::Index;
use takt_image::image::{Function, LineSite, TrapSite};

/// Machine code and its tables, as an image holds them.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Code {
    /// By `FuncId`.
    pub functions: Vec<Function>,
    /// Machine code; functions begin at multiples of 16.
    pub code: Vec<u8>,
    /// Instructions that trap, ascending.
    pub traps: Vec<TrapSite>,
    /// Where lines begin, ascending. Each function begins with one, if the module knows its line.
    pub lines: Vec<LineSite>,
}

/// Functions for which another thread is worth its start.
const FUNCTIONS_PER_THREAD: usize = 64;

/// Compiles a verified module with full effort. An error is a fault of the compiler, not of the user.
pub fn emit(module: &Module) -> Result<Code, String> {
    emit_with(module, Effort::Full)
}

/// Compiles a verified module.
pub fn emit_with(module: &Module, effort: Effort) -> Result<Code, String> {
    let target = Target::new()?;
    let mut linker = Linker::new(module);
    for compiled in compile_all(module, &target, effort) {
        linker.add(compiled?);
    }
    linker.finish()
}

/// All functions in order, on as many threads as are worth it.
fn compile_all(module: &Module, target: &Target, effort: Effort) -> Vec<Result<Compiled, String>> {
    let count = module.functions.len();
    let threads = thread::available_parallelism().map_or(1, NonZero::get).min(count / FUNCTIONS_PER_THREAD + 1);
    let ids: Vec<FuncId> = module.functions.indices().collect();
    let compile = |ids: &[FuncId]| {
        let mut compiler = Compiler::new(module, target);
        ids.iter().map(|&id| compiler.compile(id, effort)).collect::<Vec<_>>()
    };
    if threads == 1 {
        return compile(&ids);
    }
    thread::scope(|scope| {
        let parts: Vec<_> = ids.chunks(count.div_ceil(threads)).map(|ids| scope.spawn(move || compile(ids))).collect();
        let failed = || vec![Err("a thread of the code generator panicked".to_string())];
        parts.into_iter().flat_map(|part| part.join().unwrap_or_else(|_| failed())).collect()
    })
}

/// The Cranelift form of a function, before optimisation.
pub fn clif(module: &Module, id: FuncId) -> Result<String, String> {
    let target = Target::new()?;
    let mut compiler = Compiler::new(module, &target);
    compiler.build(id);
    Ok(compiler.context.func.display().to_string())
}

/// The machine code of a function as assembly text.
pub fn disassemble(module: &Module, id: FuncId) -> Result<String, String> {
    let target = Target::new()?;
    let mut compiler = Compiler::new(module, &target);
    compiler.build(id);
    compiler.context.set_disasm(true);
    let isa = target.isa(&module.functions[id], Effort::Full);
    let code = compiler.context.compile(isa, &mut ControlPlane::default()).map_err(|e| format!("{:?}", e.inner))?;
    Ok(code.vcode.clone().unwrap_or_default())
}

/// Compiles functions one after the other, with the memory of the one before.
struct Compiler<'m> {
    module: &'m Module,
    target: &'m Target,
    context: Context,
    builder: FunctionBuilderContext,
}

impl<'m> Compiler<'m> {
    fn new(module: &'m Module, target: &'m Target) -> Self {
        Self { module, target, context: Context::new(), builder: FunctionBuilderContext::new() }
    }

    fn build(&mut self, id: FuncId) {
        self.context.clear();
        function::build(self.module, id, &mut self.context.func, &mut self.builder, self.target.frontend());
    }

    fn compile(&mut self, id: FuncId, effort: Effort) -> Result<Compiled, String> {
        self.build(id);
        let name = &self.module.functions[id].name;
        let isa = self.target.isa(&self.module.functions[id], effort);
        let result = self.context.compile(isa, &mut ControlPlane::default());
        let code = result.map_err(|e| format!("function `{name}` ({}): {:?}", id.index(), e.inner))?;
        let buffer = code.buffer.clone();
        Compiled::new(id, &buffer, &self.context.func).map_err(|e| format!("function `{name}`: {e}"))
    }
}

#[cfg(test)]
mod tests;
