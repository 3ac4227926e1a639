//! Runs a module on the interpreter and on native code.

use std::sync::Arc;
use takt_base::Nanos;
use takt_compiler::codegen::{Code, Effort, emit_with};
use takt_compiler::mir::Interpreter;
use takt_compiler::mir::model::{FuncId, Module};
use takt_image::image::Target;
use takt_image::{BindError, Engine, Fault, Image, MemoryMap, NativeCall, NativeImport, Natives, Trap, TypeTable, header};
use takt_runtime::NativeEngine;

/// Time sample of all runs.
pub const NOW: Nanos = Nanos(1_234_567_890);
/// Budget of all runs: enough for everything that ends.
pub const BUDGET: Nanos = Nanos(20_000_000_000);

/// What a run left behind.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// How it ended.
    pub result: Result<(), Fault>,
    /// The memory behind its header.
    pub memory: Vec<u8>,
}

/// Natives for tests. All are functions of any scalars:
/// `mix...` hashes its slots (as a float: a number from 0 to 65535), `now` is the time sample, `poke(at, value)` writes 8 bytes,
/// `fail(n)` raises trap `n` if there is one.
#[derive(Default)]
pub struct TestNatives {
    names: Vec<String>,
}

impl Natives for TestNatives {
    fn bind(&mut self, import: &NativeImport, _: &TypeTable) -> Result<u32, BindError> {
        self.names.push(import.name.clone());
        Ok(self.names.len() as u32 - 1)
    }
    fn call(&mut self, native: u32, call: &mut NativeCall) -> Result<(), Trap> {
        match self.names[native as usize].as_str() {
            "mix_f32" => call.result = u64::from(((hash(call.args) & 0xffff) as f32).to_bits()),
            "mix_f64" => call.result = ((hash(call.args) & 0xffff) as f64).to_bits(),
            "now" => call.result = call.now.0 as u64,
            "poke" => {
                let value = call.i64(1).to_le_bytes();
                call.bytes_mut(call.u32(0), 8)?.copy_from_slice(&value);
            }
            "fail" => return u8::try_from(call.u32(0)).ok().and_then(Trap::from_number).map_or(Ok(()), Err),
            _ => call.result = hash(call.args),
        }
        Ok(())
    }
}

fn hash(args: &[u64]) -> u64 {
    args.iter().fold(7, |h: u64, &a| (h ^ a).wrapping_mul(0x0100_0000_01b3).rotate_left(17))
}

/// The image of a module without symbols or tasks.
pub fn image(module: &Module, memory: MemoryMap, effort: Effort) -> Result<Image, String> {
    let Code { functions, code, traps, lines } = emit_with(module, effort)?;
    let natives = module.natives.as_slice().to_vec();
    let files = module.files.clone();
    Ok(Image { target: Target::X86_64V2, memory, natives, functions, code, traps, lines, files, ..Image::default() })
}

/// Runs a function of one I32 parameter on the interpreter.
pub fn interpret(module: &Arc<Module>, map: MemoryMap, contents: &[u8], function: FuncId, argument: u32) -> Outcome {
    let mut natives = TestNatives::default();
    let bindings = Interpreter::bind(module, &mut natives, &TypeTable::default()).expect("natives bind");
    let mut engine = Interpreter::new(Arc::clone(module), bindings, map.frames).expect("module is right");
    run(&mut engine, &mut natives, map, contents, function, argument)
}

/// Runs a function of one I32 parameter as native code.
pub fn native(module: &Module, map: MemoryMap, contents: &[u8], function: FuncId, argument: u32) -> Outcome {
    native_with(module, Effort::Full, map, contents, function, argument)
}

/// Runs a function of one I32 parameter as native code that was made with this effort.
pub fn native_with(module: &Module, effort: Effort, map: MemoryMap, contents: &[u8], function: FuncId, argument: u32) -> Outcome {
    let mut natives = TestNatives::default();
    let image = image(module, map, effort).expect("module compiles");
    let mut engine = NativeEngine::new(&image, &mut natives).expect("image loads");
    run(&mut engine, &mut natives, map, contents, function, argument)
}

fn run(
    engine: &mut dyn Engine,
    natives: &mut TestNatives,
    map: MemoryMap,
    contents: &[u8],
    function: FuncId,
    argument: u32,
) -> Outcome {
    let mut memory = vec![0; map.size() as usize];
    memory[header::SIZE as usize..].copy_from_slice(contents);
    memory[header::FRAME_LIMIT as usize..][..4].copy_from_slice(&map.frames.end().to_le_bytes());
    let result = engine.run(function.0, argument, NOW, BUDGET, &mut memory, natives);
    Outcome { result, memory: memory.split_off(header::SIZE as usize) }
}
