//! Every kind of fault in generated code becomes a report, and the process goes on (R2: a program can't take the controller down).

mod support;

use support::{Asm, Bare};
use takt_base::Nanos;
use takt_image::natives::{BindError, NativeImport};
use takt_image::{Engine, Fault, NativeCall, Natives, Trap, TypeTable, header};
use takt_runtime::NativeEngine;
use takt_runtime::load::{LoadError, Memory};

const UD2: [u8; 2] = [0x0F, 0x0B];
const RET: u8 = 0xC3;
const BUDGET: Nanos = Nanos::from_millis(20);

fn run_on(asm: &Asm, function: u32, memory: &mut Memory, natives: &mut dyn Natives) -> Result<(), Fault> {
    let mut engine = NativeEngine::new(&asm.image, natives).unwrap();
    engine.run(function, asm.image.memory.data.start, Nanos(7), BUDGET, memory, natives)
}

fn run(asm: &Asm, function: u32) -> Result<(), Fault> {
    run_on(asm, function, &mut Memory::new(&asm.image).unwrap(), &mut Bare)
}

fn fault(trap: Trap, function: u32, file: u32, line: u32) -> Result<(), Fault> {
    Err(Fault { trap, function, file, line })
}

/// mov rax, [rdi]; mov edx, edx; mov [rdi + rdx], rax; mov [rdi + rdx + 8], esi; ret: stores NOW and the frame offset.
const STORE: [u8; 15] = [0x48, 0x8B, 0x07, 0x89, 0xD2, 0x48, 0x89, 0x04, 0x17, 0x89, 0x74, 0x17, 0x08, RET, 0x90];

#[test]
fn a_program_sees_time_frame_and_instance() {
    let asm = Asm::new().function("main", &STORE, &[], &[(0, 0, 1)]);
    let mut memory = Memory::new(&asm.image).unwrap();
    assert_eq!(run_on(&asm, 0, &mut memory, &mut Bare), Ok(()));
    let data = asm.image.memory.data.start as usize;
    assert_eq!(memory[data..data + 8], 7i64.to_le_bytes());
    assert_eq!(memory[data + 8..data + 12], asm.image.memory.frames.start.to_le_bytes());
    let limit = &memory[header::FRAME_LIMIT as usize..][..4];
    assert_eq!(limit, asm.image.memory.size().to_le_bytes());
}

#[test]
fn traps_map_to_trap_function_and_line() {
    let body = [&[0x90, 0x90][..], &UD2, &[0x90], &UD2].concat();
    let asm = Asm::new()
        .function("first", &body, &[(2, Trap::Index), (5, Trap::Range)], &[(0, 0, 10), (5, 1, 20)])
        .function("second", &[0xEB, 0x00, 0x0F, 0x0B], &[(2, Trap::ForStep)], &[(3, 0, 30)])
        .function("bare", &UD2, &[], &[]);
    assert_eq!(run(&asm, 0), fault(Trap::Index, 0, 0, 10));
    // The head of a function has no line of its own: not the last line of the function before it.
    assert_eq!(run(&asm, 1), fault(Trap::ForStep, 1, 0, 30));
    assert_eq!(run(&asm, 2), fault(Trap::Memory, 2, u32::MAX, 0));
    let tail = Asm::new().function("tail", &body[4..], &[(1, Trap::Range)], &[(1, 1, 20)]);
    assert_eq!(run(&tail, 0), fault(Trap::Range, 0, 1, 20));
}

#[test]
fn hardware_division_fault() {
    // xor ecx, ecx; mov eax, 1; cdq; idiv ecx
    let code = [0x31, 0xC9, 0xB8, 1, 0, 0, 0, 0x99, 0xF7, 0xF9, RET];
    let plain = Asm::new().function("main", &code, &[], &[(0, 0, 1), (8, 0, 2)]);
    assert_eq!(run(&plain, 0), fault(Trap::DivisionByZero, 0, 0, 2));
    let listed = Asm::new().function("main", &code, &[(8, Trap::Range)], &[(0, 0, 1)]);
    assert_eq!(run(&listed, 0), fault(Trap::Range, 0, 0, 1));
}

#[test]
fn endless_recursion_hits_the_guard_page() {
    // push rax; jmp -3
    let asm = Asm::new().function("main", &[0x50, 0xEB, 0xFD], &[], &[(0, 0, 5)]);
    assert_eq!(run(&asm, 0), fault(Trap::StackOverflow, 0, 0, 5));
    // call self
    let asm = Asm::new().function("main", &[0xE8, 0xFB, 0xFF, 0xFF, 0xFF], &[], &[(0, 0, 6)]);
    assert_eq!(run(&asm, 0), fault(Trap::StackOverflow, 0, 0, 6));
}

#[test]
fn stack_limit_leaves_room_for_natives() {
    // again: push rax; cmp rsp, [rdi + 8]; ja again; ud2
    let code = [0x50, 0x48, 0x3B, 0x67, 0x08, 0x77, 0xF9, 0x0F, 0x0B];
    let asm = Asm::new().function("main", &code, &[(7, Trap::StackOverflow)], &[(0, 0, 5)]);
    assert_eq!(run(&asm, 0), fault(Trap::StackOverflow, 0, 0, 5));
}

#[test]
fn no_offset_leaves_the_memory() {
    // mov eax, imm32; mov [rdi + rax], rax; ret
    let store = |offset: u32| {
        let code = [&[0xB8][..], &offset.to_le_bytes(), &[0x48, 0x89, 0x04, 0x07, RET]].concat();
        run(&Asm::new().function("main", &code, &[], &[(0, 0, 3)]), 0)
    };
    assert_eq!(store(64), Ok(()));
    for offset in [1 << 16, 1 << 30, 1 << 31, u32::MAX] {
        assert_eq!(store(offset), fault(Trap::Memory, 0, 0, 3), "{offset:#x}");
    }
}

#[test]
fn endless_loop_is_stopped_by_the_watchdog() {
    let asm = Asm::new().function("main", &[0x90, 0xEB, 0xFE], &[], &[(0, 0, 1), (1, 0, 2)]);
    assert_eq!(run(&asm, 0), fault(Trap::Watchdog, 0, 0, 2));
    // Again, and on another thread.
    assert_eq!(std::thread::spawn(move || run(&asm, 0)).join().unwrap(), fault(Trap::Watchdog, 0, 0, 2));
}

/// Natives 0: adds its arguments; 1: panics; 2: a string index trap; 3: computes for 60 ms.
struct Four;

impl Natives for Four {
    fn bind(&mut self, import: &NativeImport, _: &TypeTable) -> Result<u32, BindError> {
        ["ADD", "PANIC", "TRAP", "SLOW"].iter().position(|&n| n == import.name).map(|i| i as u32).ok_or(BindError::Unknown)
    }
    fn call(&mut self, native: u32, call: &mut NativeCall) -> Result<(), Trap> {
        match native {
            0 => call.result = call.args.iter().sum(),
            1 => panic!("a bug in a native"),
            2 => return Err(Trap::StringIndex),
            _ => {
                let start = std::time::Instant::now();
                while start.elapsed().as_millis() < 60 {}
            }
        }
        Ok(())
    }
}

/// push rbx; mov rbx, rdi; sub rsp, 32; mov qword [rsp], 2; mov qword [rsp + 8], 40; mov esi, IMPORT; mov rdx, rsp;
/// lea rcx, [rsp + 16]; call [rdi + 16]; mov rcx, [rsp + 16]; mov [rbx + 88], rcx; test eax, eax; jnz +LEN; ...
fn native_call(import: u32, tail: &[u8]) -> Vec<u8> {
    let mut code = vec![0x53, 0x48, 0x89, 0xFB, 0x48, 0x83, 0xEC, 0x20];
    code.extend([0x48, 0xC7, 0x04, 0x24, 2, 0, 0, 0, 0x48, 0xC7, 0x44, 0x24, 0x08, 40, 0, 0, 0, 0xBE]);
    code.extend(import.to_le_bytes());
    code.extend([0x48, 0x89, 0xE2, 0x48, 0x8D, 0x4C, 0x24, 0x10, 0xFF, 0x57, 0x10]);
    code.extend([0x48, 0x8B, 0x4C, 0x24, 0x10, 0x48, 0x89, 0x4B, 0x58, 0x85, 0xC0]);
    code.extend(tail);
    code
}

#[test]
fn natives_return_results_and_traps() {
    // jnz +6; add rsp, 32; pop rbx; ret; ud2
    let tail = [0x75, 0x06, 0x48, 0x83, 0xC4, 0x20, 0x5B, RET, 0x0F, 0x0B];
    let build = |import| {
        let code = native_call(import, &tail);
        let trap = [(code.len() as u32 - 2, Trap::NativePanic)];
        Asm::new().native("ADD", 2).native("PANIC", 2).native("TRAP", 2).function("main", &code, &trap, &[(0, 0, 8)])
    };
    let add = build(0);
    let mut memory = Memory::new(&add.image).unwrap();
    assert_eq!(run_on(&add, 0, &mut memory, &mut Four), Ok(()));
    assert_eq!(memory[88..96], 42u64.to_le_bytes());
    assert_eq!(run_on(&build(1), 0, &mut memory, &mut Four), fault(Trap::NativePanic, 0, 0, 8));
    assert_eq!(run_on(&build(2), 0, &mut memory, &mut Four), fault(Trap::StringIndex, 0, 0, 8));
    assert_eq!(run_on(&build(99), 0, &mut memory, &mut Four), fault(Trap::NativePanic, 0, 0, 8));
}

#[test]
fn watchdog_inside_a_native_waits_for_the_code() {
    // jmp self
    let code = native_call(0, &[0xEB, 0xFE]);
    let loop_at = code.len() as u32 - 2;
    let asm = Asm::new().native("SLOW", 2).function("main", &code, &[], &[(0, 0, 1), (loop_at, 0, 2)]);
    assert_eq!(run_on(&asm, 0, &mut Memory::new(&asm.image).unwrap(), &mut Four), fault(Trap::Watchdog, 0, 0, 2));
}

#[test]
fn an_engine_runs_on_after_faults_of_its_own_and_of_others() {
    let good = Asm::new().function("main", &STORE, &[], &[]);
    let bad =
        Asm::new().function("main", &[0x0F, 0x0B], &[(0, Trap::Reference)], &[(0, 0, 1)]).function("fine", &[RET], &[], &[]);
    let (mut one, mut two) =
        (NativeEngine::new(&good.image, &mut Bare).unwrap(), NativeEngine::new(&bad.image, &mut Bare).unwrap());
    let (mut m1, mut m2) = (Memory::new(&good.image).unwrap(), Memory::new(&bad.image).unwrap());
    for _ in 0..1000 {
        assert_eq!(two.run(0, 88, Nanos(1), BUDGET, &mut m2, &mut Bare), fault(Trap::Reference, 0, 0, 1));
        assert_eq!(two.run(1, 88, Nanos(1), BUDGET, &mut m2, &mut Bare), Ok(()));
        assert_eq!(one.run(0, 88, Nanos(1), BUDGET, &mut m1, &mut Bare), Ok(()));
    }
}

#[test]
fn four_threads_fault_at_once() {
    let threads: Vec<_> = (0..4)
        .map(|i| {
            std::thread::spawn(move || {
                let asm = Asm::new().function("main", &UD2, &[(0, Trap::Index)], &[(0, 0, i)]);
                (0..500).all(|_| run(&asm, 0) == fault(Trap::Index, 0, 0, i))
            })
        })
        .collect();
    assert!(threads.into_iter().all(|t| t.join().unwrap()));
}

#[test]
fn what_does_not_fit_is_refused() {
    let none = takt_image::Image::default();
    let reason = |image: &takt_image::Image| NativeEngine::new(image, &mut Bare).err().unwrap();
    assert!(matches!(reason(&none), LoadError::Image(_)), "an empty memory map has no header");
    let mut no_code = Asm::new().image;
    no_code.target = takt_image::image::Target::None;
    assert!(matches!(reason(&no_code), LoadError::Target(_)));
    let native = reason(&Asm::new().native("MISSING", 0).image);
    assert_eq!((native.code().text(), native.to_string()), ("C0004", "this controller has no `MISSING`".into()));
    let asm = Asm::new().function("main", &[RET], &[], &[]);
    let mut engine = NativeEngine::new(&asm.image, &mut Bare).unwrap();
    assert_eq!(engine.run(0, 88, Nanos(1), BUDGET, &mut [0; 64], &mut Bare), fault(Trap::Memory, u32::MAX, u32::MAX, 0));
    assert_eq!(engine.run(5, 88, Nanos(1), BUDGET, &mut [0; 64], &mut Bare), fault(Trap::Memory, u32::MAX, u32::MAX, 0));
}

#[inline(never)]
fn recurse(n: u64) -> u64 {
    let room = std::hint::black_box([n; 64]);
    if n == u64::MAX { 0 } else { recurse(n + 1) + room[(n % 64) as usize] }
}

/// Faults outside of generated code are not ours: the process ends as it would without us.
#[test]
fn other_crashes_stay_crashes() {
    use std::os::unix::process::ExitStatusExt;
    const NAME: &str = "TAKT_TEST_CRASH";
    if let Ok(kind) = std::env::var(NAME) {
        takt_runtime::prepare_thread().unwrap();
        if kind == "overflow" {
            std::process::exit(recurse(0) as i32);
        }
        // SAFETY: none: the null pointer is the point.
        #[allow(unsafe_code)]
        unsafe {
            std::ptr::null_mut::<u8>().write_volatile(1);
        }
    }
    let child = |kind| {
        let me = std::env::current_exe().unwrap();
        let args = ["--exact", "other_crashes_stay_crashes", "--nocapture"];
        std::process::Command::new(me).args(args).env(NAME, kind).output().unwrap()
    };
    assert_eq!(child("null").status.signal(), Some(11));
    let overflow = child("overflow");
    assert_eq!(overflow.status.signal(), Some(6));
    assert!(String::from_utf8_lossy(&overflow.stderr).contains("overflowed its stack"));
}
