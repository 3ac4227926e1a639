//! A program from ST text with its tasks: in virtual time, on the interpreter and as native code. Both must do the same, scan by scan.

use crate::plc::compile_st;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use takt_base::Nanos;
use takt_base::diag::render;
use takt_compiler::driver::Compilation;
use takt_compiler::mir::Interpreter;
use takt_image::path::{Variable, resolve};
use takt_image::value::{Patch, read};
use takt_image::{BindError, Cyclic, Engine, Image, NativeCall, NativeImport, Natives, Trap, TypeTable};
use takt_runtime::{NativeEngine, Options, Resource, SimDriver, Stimulus, Virtual, When};
use takt_stdlib::natives::Library;

/// The library alone, without anything that moves.
struct Still(Library);

impl Natives for Still {
    fn bind(&mut self, import: &NativeImport, types: &TypeTable) -> Result<u32, BindError> {
        self.0.bind(import, types)
    }
    fn call(&mut self, native: u32, call: &mut NativeCall) -> Result<(), Trap> {
        self.0.call(native, call)
    }
}

impl Cyclic for Still {
    fn period(&self) -> Option<Nanos> {
        None
    }
    fn tick(&mut self, _: Nanos) {}
    fn safe_stop(&mut self) {}
}

/// Runs everything before `until_ms`, setting variables (time in ms, path, value), and returns a line for each scan:
/// `TASK@ms a b c` with the watched values after it.
pub fn timed(text: &str, sets: &[(i64, &str, &str)], watch: &[&str], until_ms: i64) -> Vec<String> {
    let c = compile_st(text);
    let messages: String = c.diags.iter().map(|d| render(d, &c.sources)).collect();
    let image = c.image.as_ref().unwrap_or_else(|| panic!("{messages}\n{text}"));
    let watch: Vec<Variable> = watch.iter().map(|p| resolve(image, p).unwrap_or_else(|e| panic!("{e}"))).collect();
    let [interpreted, native] = [false, true].map(|native| one(&c, image, native, sets, &watch, until_ms));
    assert_eq!(interpreted, native, "interpreter and native code differ\n{text}");
    native
}

fn one(
    c: &Compilation,
    image: &Image,
    native: bool,
    sets: &[(i64, &str, &str)],
    watch: &[Variable],
    until_ms: i64,
) -> Vec<String> {
    let mut host = Still(Library::new());
    let engine: Box<dyn Engine> = if native {
        Box::new(NativeEngine::new(image, &mut host).expect("image loads"))
    } else {
        let module = Arc::new(c.module.clone().expect("compiled"));
        let bindings = Interpreter::bind(&module, &mut host, &image.types).expect("natives bind");
        Box::new(Interpreter::new(module, bindings, image.memory.frames).expect("module is right"))
    };
    let mut stimulus = Stimulus::default();
    for (ms, path, value) in sets {
        stimulus
            .push(When::Time(Nanos::from_millis(*ms)), Patch::from_path(image, path, value).unwrap_or_else(|e| panic!("{e}")));
    }
    let options = Options { measure: false, ..Options::default() };
    let resource = Resource::new(image.clone(), engine, Box::new(host), options).expect("image runs");
    let mut resource = resource.with_driver(Box::new(SimDriver::new(stimulus)));
    let mut lines = Vec::new();
    let end = Some(Nanos::from_millis(until_ms));
    resource.run_until(&mut Virtual::new(), end, &AtomicBool::new(false), &mut |scan, memory| {
        let shown = |v: &Variable| read(&image.types, memory, v.place, v.ty).expect("in memory").to_string();
        let values: Vec<_> = watch.iter().map(shown).collect();
        assert!(scan.fault.is_none(), "{scan:?}");
        lines.push(
            format!("{}@{} {}", image.tasks[scan.task].name, scan.now.0 / 1_000_000, values.join(" ")).trim_end().to_owned(),
        );
        true
    });
    lines
}
