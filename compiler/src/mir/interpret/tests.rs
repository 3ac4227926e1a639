use super::{Context, Interpreter};
use crate::mir::model::FuncId;
use crate::mir::text::parse;
use std::sync::Arc;
use takt_base::Nanos;
use takt_image::memory::Area;
use takt_image::{BindError, Engine, Fault, NativeCall, NativeImport, Natives, Trap, TypeTable, header};

struct NoNatives;

impl Natives for NoNatives {
    fn bind(&mut self, _: &NativeImport, _: &TypeTable) -> Result<u32, BindError> {
        Err(BindError::Unknown)
    }
    fn call(&mut self, _: u32, _: &mut NativeCall) -> Result<(), Trap> {
        Err(Trap::NativePanic)
    }
}

/// Calls the first function on a memory of this size, whose last 64 bytes are the frames.
fn call(source: &str, args: &[u64], size: usize) -> Result<u64, Fault> {
    let module = parse(source).unwrap_or_else(|e| panic!("{e}"));
    let frames = Area { start: (size as u32).saturating_sub(64), size: 64 };
    let mut engine = Interpreter::new(Arc::new(module), Vec::new(), frames).unwrap();
    let mut memory = vec![0; size];
    let budget = Nanos(1_000_000);
    engine.call(FuncId(0), args, &mut Context { now: Nanos(5), budget, memory: &mut memory, natives: &mut NoNatives })
}

fn traps(source: &str, size: usize, trap: Trap) {
    assert_eq!(call(source, &[], size).map_err(|f| f.trap), Err(trap), "{source}");
}

#[test]
fn endless_loops_meet_the_watchdog() {
    traps("func f () {\nb0:\n jump b0\n}", 256, Trap::Watchdog);
    traps("func f () {\nb0:\n fill_bytes [64], 100, 0\n jump b0\n}", 256, Trap::Watchdog);
}

#[test]
fn depth_registers_and_frames_are_limited() {
    traps("func f () {\nb0:\n call f()\n return\n}", 256, Trap::StackOverflow);
    traps("func f frame 72 () {\nb0:\n return\n}", 256, Trap::StackOverflow);
    traps("func f frame 40 () {\nb0:\n call g()\n return\n}\nfunc g frame 32 () {\nb0:\n return\n}", 256, Trap::StackOverflow);
    assert_eq!(call("func f frame 64 () {\nb0:\n return\n}", &[], 256), Ok(0));
}

#[test]
fn nothing_outside_of_the_memory_is_touched() {
    traps("func f () {\n i64: v0\nb0:\n v0 = load [249]\n return\n}", 256, Trap::Memory);
    traps("func f () {\n i64: v0\nb0:\n store [1000], v0\n return\n}", 256, Trap::Memory);
    traps("func f () {\n i32: v0\n i8: v1\nb0:\n v0 = int -1\n v1 = load [v0 + 1000]\n return\n}", 256, Trap::Memory);
    traps("func f () {\nb0:\n copy_bytes [0], [200], 60\n return\n}", 256, Trap::Memory);
    traps("func f () {\nb0:\n fill_bytes [0], 257, 1\n copy_string [0], 300, [1], 300, 1\n return\n}", 256, Trap::Memory);
    traps("func f () {\nb0:\n fill_bytes [0], 256, 1\n copy_string [0], 300, [1], 300, 1\n return\n}", 256, Trap::Memory);
    traps("func f () {\n i8: v0\nb0:\n v0 = load [0]\n return\n}", 0, Trap::Memory);
}

#[test]
fn arguments_are_cut_to_their_type_and_may_be_missing() {
    let source = "func f (v0: i8, v1: i32) -> i32 {\n i32: v2\nb0:\n v2 = zero_extend v0\n v2 = add v2, v1\n return v2\n}";
    assert_eq!(call(source, &[0x1ff], 256), Ok(255));
    assert_eq!(call(source, &[1, 2, 3], 256), Ok(3));
}

#[test]
fn the_header_has_the_time_sample() {
    let source = "func f () -> i64 {\n i64: v0\nb0:\n v0 = load [0]\n return v0\n}";
    assert_eq!(call(source, &[], 256), Ok(5));
}

#[test]
fn a_frame_limit_in_the_header_counts() {
    let source = "func f frame 8 (v0: i32) {\nb0:\n store [frame + 0], v0\n return\n}";
    let frames = Area { start: 128, size: 64 };
    let mut engine = Interpreter::new(Arc::new(parse(source).unwrap()), Vec::new(), frames).unwrap();
    let mut memory = vec![0; 256];
    let mut run = |limit: u32, memory: &mut Vec<u8>| {
        memory[header::FRAME_LIMIT as usize..][..4].copy_from_slice(&limit.to_le_bytes());
        engine.run(0, 77, Nanos(0), Nanos(1_000_000), memory, &mut NoNatives).map_err(|f| f.trap)
    };
    assert_eq!(run(136, &mut memory), Ok(()));
    assert_eq!(memory[128], 77);
    assert_eq!(run(135, &mut memory), Err(Trap::StackOverflow));
    assert_eq!(engine.run(9, 0, Nanos(0), Nanos(0), &mut memory, &mut NoNatives).map_err(|f| f.function), Err(u32::MAX));
}

#[test]
fn a_module_that_breaks_rules_is_refused() {
    let module = parse("func f () {\nb0:\n jump b1\n}").unwrap();
    assert!(Interpreter::new(Arc::new(module), Vec::new(), Area::default()).is_err());
    let module = parse("native n ()").unwrap();
    assert_eq!(Interpreter::bind(&module, &mut NoNatives, &TypeTable::default()), Err(("n".into(), BindError::Unknown)));
}
