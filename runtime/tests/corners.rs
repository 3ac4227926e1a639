//! Resources at the edge: a fault in the very first scan, no tasks, no outputs, long runs in virtual time, one engine through all faults.

mod support;

use std::cell::Cell;
use std::rc::Rc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};
use support::{Asm, Bare, task};
use takt_base::Nanos;
use takt_image::natives::{BindError, NativeImport};
use takt_image::{Cyclic, Engine, Host, Image, MemoryMap, NativeCall, Natives, Trap, TypeTable};
use takt_runtime::*;

const RET: u8 = 0xC3;
const BUDGET: Nanos = Nanos::from_millis(20);

/// Ticks at 1 ms, and counts its stops.
#[derive(Default)]
struct Ticking(Rc<Cell<u32>>);

impl Natives for Ticking {
    fn bind(&mut self, _: &NativeImport, _: &TypeTable) -> Result<u32, BindError> {
        Ok(0)
    }
    fn call(&mut self, _: u32, _: &mut NativeCall) -> Result<(), Trap> {
        panic!("a bug in a native")
    }
}

impl Cyclic for Ticking {
    fn period(&self) -> Option<Nanos> {
        Some(Nanos::from_millis(1))
    }
    fn tick(&mut self, _: Nanos) {}
    fn safe_stop(&mut self) {
        self.0.set(self.0.get() + 1);
    }
}

/// A driver that counts how often outputs are written.
struct Count(Rc<Cell<u32>>);

impl Driver for Count {
    fn read_inputs(&mut self, _: Nanos, _: u64, _: &mut [u8]) {}
    fn write_outputs(&mut self, _: Nanos, _: &[u8]) {
        self.0.set(self.0.get() + 1);
    }
}

fn resource(image: Image, mut host: Box<dyn Host>, on_fault: OnFault) -> Resource {
    let engine = NativeEngine::new(&image, &mut *host).unwrap();
    Resource::new(image, Box::new(engine), host, Options { on_fault, ..Options::default() }).unwrap()
}

fn run(r: &mut Resource, until: Nanos) -> (End, Nanos) {
    let mut clock = Virtual::new();
    let end = r.run_until(&mut clock, Some(until), &AtomicBool::new(false), &mut |_, _| true);
    (end, clock.now())
}

/// An image without a process image whose function 0 fails at once and whose function 1 counts at the end of the header.
fn failing() -> Image {
    let asm = Asm::new().function("Bad", &[0x0F, 0x0B], &[(0, Trap::Range)], &[(0, 0, 4)]);
    let mut image = asm.function("Good", &[0xFE, 0x47, 0x40, RET], &[], &[]).image;
    image.memory = MemoryMap::new(0, 0, 0, 64, 4096).unwrap();
    image
}

#[test]
fn a_fault_in_the_first_scan_of_a_program_without_outputs() {
    let mut image = failing();
    image.tasks = vec![task("t", 0, Some(10), &[0], &image)];
    for on_fault in [OnFault::StopResource, OnFault::StopTask] {
        let (stops, writes) = (Rc::default(), Rc::default());
        let host = Box::new(Ticking(Rc::clone(&stops)));
        let mut r = resource(image.clone(), host, on_fault).with_driver(Box::new(Count(Rc::clone(&writes))));
        assert_eq!(run(&mut r, Nanos::from_secs(1)), (End::Faulted, Nanos(0)));
        r.stop(&mut Virtual::new());
        assert_eq!((r.state(), stops.get(), writes.get()), (State::Faulted, 1, 1));
        assert_eq!((r.counts().scans, r.counts().faults, r.progress().read()), (1, 1, r.counts()));
        let report = r.fault_reports().remove(0);
        assert_eq!(report.to_string(), "F0703: value outside of the subrange, a.st:4 in Bad (task t, program t_0, at 0s)");
    }
}

#[test]
fn a_fault_in_the_first_scan_leaves_the_other_tasks_alone() {
    let mut image = failing();
    image.tasks = vec![task("bad", 0, Some(10), &[0], &image), task("good", 1, Some(10), &[1], &image)];
    let mut r = resource(image, Box::new(Bare), OnFault::StopTask);
    assert_eq!(run(&mut r, Nanos::from_millis(95)).0, End::Deadline);
    assert_eq!((r.state(), r.memory()[64], r.faults().len()), (State::Running, 10, 1));
    assert_eq!(r.stats().map(|s| (s.scans, s.faults)).collect::<Vec<_>>(), [(1, 1), (10, 0)]);
}

#[test]
fn without_tasks_the_host_ticks_on() {
    let mut image = Image { tasks: vec![], ..failing() };
    let mut r = resource(image.clone(), Box::new(Ticking::default()), OnFault::StopResource);
    assert_eq!(run(&mut r, Nanos::from_millis(50)), (End::Deadline, Nanos::from_millis(50)));
    assert_eq!((r.counts().ticks, r.progress().read().ticks, r.counts().scans), (50, 50, 0));
    // Without host and tasks there is nothing to wait for; nor has a task without programs anything to fail.
    let mut r = resource(image.clone(), Box::new(Bare), OnFault::StopResource);
    assert_eq!(run(&mut r, Nanos::from_millis(50)).0, End::NothingToRun);
    image.tasks = vec![task("empty", 0, Some(10), &[], &image)];
    let mut r = resource(image, Box::new(Bare), OnFault::StopResource);
    assert_eq!((run(&mut r, Nanos::from_millis(50)).0, r.counts().scans), (End::Deadline, 5));
}

/// A million ticks and a hundred thousand scans of machine code: a quarter of an hour that does not take a minute.
#[test]
fn virtual_time_does_not_wait() {
    let mut image = failing();
    image.tasks = vec![task("t", 0, Some(10), &[1], &image)];
    let mut r = resource(image, Box::new(Ticking::default()), OnFault::StopResource);
    let start = Instant::now();
    assert_eq!(run(&mut r, Nanos::from_secs(1000)).0, End::Deadline);
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
    assert_eq!((r.counts().ticks, r.counts().scans, r.ticks_skipped(), r.counts().overruns), (1_000_000, 100_000, 0, 0));
}

/// Machine code for every fault, with the trap that it must become.
fn every_fault() -> Vec<(Trap, Vec<u8>, Vec<(u32, Trap)>)> {
    let ud2 = |trap| (trap, vec![0x0F, 0x0B], vec![(0, trap)]);
    let divide = vec![0x31, 0xC9, 0xB8, 1, 0, 0, 0, 0x99, 0xF7, 0xF9, RET];
    let limit = vec![0x50, 0x48, 0x3B, 0x67, 0x08, 0x77, 0xF9, 0x0F, 0x0B];
    // mov eax, 0xFFFFFFFF; mov [rdi + rax], rax; ret
    let wild = vec![0xB8, 0xFF, 0xFF, 0xFF, 0xFF, 0x48, 0x89, 0x04, 0x07, RET];
    // mov rax, 0x10; mov [rax], rax
    let null = vec![0xB8, 0x10, 0, 0, 0, 0x48, 0x89, 0x00, RET];
    // push rbx; xor esi, esi; xor edx, edx; xor ecx, ecx; call [rdi + 16]; test eax, eax; pop rbx; jnz +1; ret; ud2
    let native = vec![0x53, 0x31, 0xF6, 0x31, 0xD2, 0x31, 0xC9, 0xFF, 0x57, 0x10, 0x85, 0xC0, 0x5B, 0x75, 1, RET, 0x0F, 0x0B];
    let mut all: Vec<_> = Trap::ALL.iter().copied().filter(|&t| t != Trap::NativePanic).map(ud2).collect();
    all.extend([
        (Trap::DivisionByZero, divide, vec![]),
        (Trap::StackOverflow, limit, vec![(7, Trap::StackOverflow)]),
        (Trap::StackOverflow, vec![0x50, 0xEB, 0xFD], vec![]),
        (Trap::Watchdog, vec![0xEB, 0xFE], vec![]),
        (Trap::Memory, wild, vec![]),
        (Trap::Memory, null, vec![]),
        (Trap::NativePanic, native, vec![(16, Trap::NativePanic)]),
    ]);
    all
}

#[test]
fn one_engine_goes_on_after_every_fault() {
    let faults = every_fault();
    let asm = faults
        .iter()
        .fold(Asm::new().native("PANIC", 0), |asm, (trap, code, sites)| asm.function(trap.name(), code, sites, &[(0, 0, 1)]));
    let good = faults.len() as u32;
    let asm = asm.function("Good", &[0xFE, 0x47, 0x40, RET], &[], &[]);
    let mut host = Ticking::default();
    let mut engine = NativeEngine::new(&asm.image, &mut host).unwrap();
    let mut memory = load::Memory::new(&asm.image).unwrap();
    let instance = asm.image.memory.data.start;
    for round in 1..=3u8 {
        for (f, (trap, _, _)) in (0..).zip(&faults) {
            let fault = engine.run(f, instance, Nanos(0), BUDGET, &mut memory, &mut host).unwrap_err();
            assert_eq!((fault.trap, fault.function, fault.line), (*trap, f, 1));
        }
        assert_eq!(engine.run(good, instance, Nanos(0), BUDGET, &mut memory, &mut host), Ok(()));
        assert_eq!(memory[64], round);
    }
}
