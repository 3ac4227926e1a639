//! A program from ST text, run scan by scan on the interpreter and as native code side by side. Whatever is asked, both must agree.

use std::sync::Arc;
use takt_base::diag::render;
use takt_base::{Code, Nanos, Profile, Severity};
use takt_compiler::driver::{Compilation, File, Project, compile};
use takt_compiler::mir::Interpreter;
use takt_image::retain::{RetainMap, Start};
use takt_image::value::{read, write_text};
use takt_image::{Engine, Fault, Image, Trap, header, path};
use takt_runtime::NativeEngine;
use takt_stdlib::natives::Library;

/// Watchdog of a scan: enough for everything that ends.
const BUDGET: Nanos = Nanos(2_000_000_000);

/// A loaded program.
pub struct Plc {
    /// What runs.
    pub image: Image,
    sides: [Side; 2],
}

/// An engine with its memory.
struct Side {
    engine: Box<dyn Engine>,
    natives: Library,
    memory: Vec<u8>,
}

/// Compiles one file of profile `std`.
pub fn compile_st(text: &str) -> Compilation {
    compile_in(Profile::Std, text)
}

/// Checks one file of profile `std`, as `takt check` does: no machine code.
pub fn check_st(text: &str) -> Compilation {
    let profile = Profile::Std;
    compile_files(vec![File { name: "test.st".into(), bytes: text.into(), library: false, profile }], false)
}

/// Compiles one file of a profile.
pub fn compile_in(profile: Profile, text: &str) -> Compilation {
    compile_bytes(profile, text.into())
}

fn compile_bytes(profile: Profile, bytes: Vec<u8>) -> Compilation {
    compile_files(vec![File { name: "test.st".into(), bytes, library: false, profile }], true)
}

fn compile_files(files: Vec<File>, native: bool) -> Compilation {
    compile(Project { name: "test".into(), files, attachments: vec![], interval: None, native })
}

impl Plc {
    /// Compiles and loads; panics with the messages if the text has errors.
    pub fn new(text: &str) -> Self {
        Self::load(text).unwrap_or_else(|messages| panic!("{messages}\n{text}"))
    }

    /// The same for a file of another profile.
    pub fn new_in(profile: Profile, text: &str) -> Self {
        Self::load_in(profile, text).unwrap_or_else(|messages| panic!("{messages}\n{text}"))
    }

    /// Compiles and loads; the messages if the text has errors.
    pub fn load(text: &str) -> Result<Self, String> {
        Self::load_in(Profile::Std, text)
    }

    /// The same for a file of another profile.
    pub fn load_in(profile: Profile, text: &str) -> Result<Self, String> {
        Self::load_bytes(profile, text.into())
    }

    /// Compiles and loads a file of any encoding; panics with the messages if it has errors.
    pub fn from_bytes(profile: Profile, bytes: Vec<u8>) -> Self {
        Self::load_bytes(profile, bytes).unwrap_or_else(|messages| panic!("{messages}"))
    }

    /// Compiles and loads a project of several files; panics with the messages if it has errors.
    pub fn from_files(files: Vec<File>) -> Self {
        Self::load_compiled(compile_files(files, true)).unwrap_or_else(|messages| panic!("{messages}"))
    }

    fn load_bytes(profile: Profile, bytes: Vec<u8>) -> Result<Self, String> {
        Self::load_compiled(compile_bytes(profile, bytes))
    }

    fn load_compiled(c: Compilation) -> Result<Self, String> {
        let errors = c.diags.iter().filter(|d| d.severity == Severity::Error);
        let messages: Vec<_> = errors.map(|d| render(d, &c.sources)).collect();
        let (Some(image), Some(module)) = (c.image, c.module) else { return Err(messages.join("\n")) };
        let module = Arc::new(module);
        let mut natives = [Library::new(), Library::new()];
        let bindings = Interpreter::bind(&module, &mut natives[0], &image.types).expect("natives bind");
        let interpreter = Interpreter::new(module, bindings, image.memory.frames).expect("module is right");
        let native = NativeEngine::new(&image, &mut natives[1]).expect("image loads");
        let engines: [Box<dyn Engine>; 2] = [Box::new(interpreter), Box::new(native)];
        let mut pairs = engines.into_iter().zip(natives);
        let sides = std::array::from_fn(|_| {
            let (engine, natives) = pairs.next().expect("two sides");
            Side { engine, natives, memory: initial_memory(&image) }
        });
        Ok(Plc { image, sides })
    }

    /// Runs all programs of all tasks once at `now_ms`; panics if the engines differ.
    pub fn scan(&mut self, now_ms: i64) -> Result<(), Fault> {
        self.scan_within(now_ms, BUDGET)
    }

    /// [`Plc::scan`] with another watchdog for each program.
    pub fn scan_within(&mut self, now_ms: i64, budget: Nanos) -> Result<(), Fault> {
        let tasks = std::mem::take(&mut self.image.tasks);
        let results = self.sides.each_mut().map(|side| {
            let mut programs = tasks.iter().flat_map(|t| &t.programs);
            programs.try_for_each(|p| side.run(p.function, p.instance, now_ms, budget))
        });
        self.image.tasks = tasks;
        // Where a watchdog or the end of the stack strikes is not the same on both.
        let chance = |r: &Result<(), Fault>| matches!(r, Err(f) if matches!(f.trap, Trap::Watchdog | Trap::StackOverflow));
        let alike = results[0] == results[1] || results.iter().all(chance);
        assert!(alike, "interpreter and native code end differently: {:?}, {:?}", results[0], results[1]);
        if !chance(&results[0]) {
            self.compare();
        }
        results[0]
    }

    /// Scans every 10 ms from 0 on; panics at a fault.
    pub fn scans(&mut self, count: i64) {
        for i in 0..count {
            let result = self.scan(10 * i);
            assert!(result.is_ok(), "scan {i}: {result:?}");
        }
    }

    fn compare(&self) {
        let range = header::SIZE as usize..self.image.memory.data.end() as usize;
        let [a, b] = self.sides.each_ref().map(|side| &side.memory[range.clone()]);
        for (i, (x, y)) in a.chunks(8).zip(b.chunks(8)).enumerate() {
            assert!(alike(x, y), "memories differ at {}: interpreter {x:02X?}, native {y:02X?}", range.start + 8 * i);
        }
    }

    /// A variable as an IEC literal.
    pub fn get(&self, name: &str) -> String {
        let v = path::resolve(&self.image, name).unwrap_or_else(|e| panic!("{e}"));
        read(&self.image.types, &self.sides[0].memory, v.place, v.ty).expect("in memory").to_string()
    }

    /// The stored form of the retained variables.
    pub fn kept(&self) -> Vec<u8> {
        let map = RetainMap::new(&self.image);
        let mut copy = vec![0; map.bytes()];
        map.capture(&self.sides[0].memory, &mut copy);
        map.encode(&copy, 0)
    }

    /// Puts retained variables back, as a warm start does before the first scan.
    pub fn restore(&mut self, kept: &[u8]) {
        let map = RetainMap::new(&self.image);
        for side in &mut self.sides {
            map.restore(kept, &mut side.memory, Start::Warm).expect("not damaged");
        }
    }

    /// Sets a variable from a literal, on both sides.
    pub fn set(&mut self, name: &str, text: &str) {
        let v = path::resolve(&self.image, name).unwrap_or_else(|e| panic!("{e}"));
        for side in &mut self.sides {
            write_text(&self.image.types, &mut side.memory, v.place, v.ty, text).unwrap_or_else(|e| panic!("{e}"));
        }
    }
}

/// Equal, but for the sign and payload of what is not a number: which NaN comes out of two is left to the processor.
fn alike(a: &[u8], b: &[u8]) -> bool {
    let nan64 = |x: &[u8]| x.try_into().is_ok_and(|x| f64::from_le_bytes(x).is_nan());
    let nan32 = |x: &[u8]| x.try_into().is_ok_and(|x| f32::from_le_bytes(x).is_nan());
    let halves = || a.chunks(4).zip(b.chunks(4)).all(|(x, y)| x == y || (nan32(x) && nan32(y)));
    a == b || (nan64(a) && nan64(b)) || halves()
}

impl Side {
    fn run(&mut self, function: u32, instance: u32, now_ms: i64, budget: Nanos) -> Result<(), Fault> {
        self.engine.run(function, instance, Nanos::from_millis(now_ms), budget, &mut self.memory, &mut self.natives)
    }
}

/// Memory of an image before the first scan.
pub fn initial_memory(image: &Image) -> Vec<u8> {
    let mut memory = vec![0; image.memory.size() as usize];
    for chunk in &image.init {
        memory[chunk.offset as usize..][..chunk.bytes.len()].copy_from_slice(&chunk.bytes);
    }
    memory[header::FRAME_LIMIT as usize..][..4].copy_from_slice(&image.memory.frames.end().to_le_bytes());
    memory
}

/// Codes of the errors in a file of a profile, in order; warnings left out.
pub fn errors(profile: Profile, text: &str) -> Vec<Code> {
    compile_in(profile, text).diags.iter().filter(|d| d.severity == Severity::Error).map(|d| d.code).collect()
}

/// The same in profile `std`, as the user reads them.
pub fn error_codes(text: &str) -> Vec<&'static str> {
    errors(Profile::Std, text).into_iter().map(Code::text).collect()
}

/// Runs `text` for `scans` scans and compares variables (paths and literals as shown).
pub fn check_program(text: &str, scans: i64, expected: &[(&str, &str)]) {
    check_profile(Profile::Std, text, scans, expected);
}

/// The same for a text of a profile.
pub fn check_profile(profile: Profile, text: &str, scans: i64, expected: &[(&str, &str)]) {
    let mut plc = Plc::new_in(profile, text);
    plc.scans(scans);
    let found: Vec<_> = expected.iter().map(|(name, _)| (*name, plc.get(name))).collect();
    let found: Vec<_> = found.iter().map(|(name, value)| (*name, value.as_str())).collect();
    assert_eq!(found, expected, "\n{text}");
}

/// Runs the statements of `body` once in a program with these variables. `declarations` are types and units in front of it.
pub fn check_in(declarations: &str, vars: &str, body: &str, expected: &[(&str, &str)]) {
    let text = format!("{declarations}\nPROGRAM p\nVAR\n{vars}\nEND_VAR\n{body}\nEND_PROGRAM\n");
    let paths: Vec<_> = expected.iter().map(|(name, _)| format!("p.{name}")).collect();
    let expected: Vec<_> = paths.iter().zip(expected).map(|(path, (_, value))| (path.as_str(), *value)).collect();
    check_program(&text, 1, &expected);
}

/// [`check_in`] without declarations.
pub fn check(vars: &str, body: &str, expected: &[(&str, &str)]) {
    check_in("", vars, body, expected);
}

/// The fault of the first scan, by the number of its trap and its line in the text.
pub fn fault(text: &str) -> (Trap, u32) {
    let mut plc = Plc::new(text);
    let fault = plc.scan(0).expect_err("a fault");
    assert_eq!(plc.image.files.get(fault.file as usize).map(String::as_str), Some("test.st"));
    (fault.trap, fault.line)
}
