//! The cyclic path with real machine code: allocates nothing, in virtual time and in real time.

mod support;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::AtomicBool;
use support::{Asm, Bare, task};
use takt_base::Nanos;
use takt_image::{Image, Trap};
use takt_runtime::*;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// Counts what this thread asks for.
struct Counting;

// SAFETY: passes everything on.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, p: *mut u8, layout: Layout) {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(p, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// `inc byte [rdi + rdx]; inc byte [rdi + 72]; ret` and `ud2`.
fn image(intervals: &[i64]) -> Image {
    let count = [0x89, 0xD2, 0xFE, 0x04, 0x17, 0xFE, 0x47, 0x48, 0xC3];
    let asm =
        Asm::new().function("Count", &count, &[], &[(0, 0, 1)]).function("Bad", &[0x0F, 0x0B], &[(0, Trap::Range)], &[(0, 1, 7)]);
    let mut image = asm.image;
    image.tasks = intervals.iter().enumerate().map(|(i, &ms)| task(&format!("t{i}"), i as u32, Some(ms), &[0], &image)).collect();
    image
}

fn resource(image: Image, on_fault: OnFault) -> Resource {
    let mut host = Box::new(Bare);
    let engine = NativeEngine::new(&image, &mut *host).unwrap();
    let csv = (0..50).fold(String::from("scan,%IB0\n"), |csv, i| format!("{csv}{},{i}\n", 10 * i + 1));
    let driver = SimDriver::new(Stimulus::from_csv(&image, &csv).unwrap());
    Resource::new(image, Box::new(engine), host, Options { on_fault, ..Options::default() })
        .unwrap()
        .with_driver(Box::new(driver))
}

/// Allocations of a run.
fn allocations(r: &mut Resource, clock: &mut dyn Clock, until: Nanos) -> (End, u64) {
    let (stop, before) = (AtomicBool::new(false), ALLOCATIONS.get());
    let end = r.run_until(clock, Some(until), &stop, &mut |_, _| true);
    (end, ALLOCATIONS.get() - before)
}

#[test]
fn a_thousand_scans_allocate_nothing() {
    let mut r = resource(image(&[1, 10]), OnFault::StopResource);
    assert_eq!(allocations(&mut r, &mut Virtual::new(), Nanos::from_secs(1)), (End::Deadline, 0));
    assert_eq!((r.counts().scans, r.memory()[88], r.memory()[64]), (1100, (1100 % 256) as u8, 49));
    assert_eq!(r.stats().map(|s| s.scan_time.count()).collect::<Vec<_>>(), [1000, 100]);
}

#[test]
fn faults_allocate_nothing() {
    for on_fault in [OnFault::StopResource, OnFault::StopTask] {
        let mut image = image(&[1, 10]);
        image.tasks[1].programs[0].function = 1;
        let mut r = resource(image, on_fault);
        let (end, count) = allocations(&mut r, &mut Virtual::new(), Nanos::from_millis(100));
        assert_eq!((count, r.faults().len()), (0, 1));
        assert_eq!(end, if on_fault == OnFault::StopTask { End::Deadline } else { End::Faulted });
        assert_eq!(
            (r.fault_reports()[0].file.as_str(), r.fault_reports()[0].line, r.fault_reports()[0].pou.as_str()),
            ("b.st", 7, "Bad")
        );
    }
}

#[test]
fn fifty_milliseconds_of_real_time() {
    let (end, count, scans, text) = realtime::on_program_thread(|| {
        let report = realtime::enter(&realtime::Request { lock_memory: false, ..Default::default() });
        let mut r = resource(image(&[5]), OnFault::StopResource);
        let mut clock = Monotonic::start();
        let (end, count) = allocations(&mut r, &mut clock, Nanos::from_millis(50));
        r.stop(&mut clock);
        (end, count, r.progress().read().scans, report.to_string())
    })
    .unwrap();
    assert_eq!((end, count), (End::Deadline, 0));
    assert!(scans >= 1 && text.starts_with("real time: SCHED_FIFO"), "{scans} {text}");
}

#[test]
fn another_thread_sees_the_run_and_stops_it() {
    static STOP: AtomicBool = AtomicBool::new(false);
    let (sender, receiver) = std::sync::mpsc::channel();
    let thread = std::thread::spawn(move || {
        let mut r = resource(image(&[1]), OnFault::StopResource);
        sender.send(r.progress()).unwrap();
        let mut clock = Monotonic::start();
        let end = r.run_until(&mut clock, None, &STOP, &mut |_, _| true);
        r.stop(&mut clock);
        (end, r.state(), r.memory()[72])
    });
    let progress = receiver.recv().unwrap();
    while progress.read().scans < 3 {
        std::thread::yield_now();
    }
    STOP.store(true, std::sync::atomic::Ordering::Relaxed);
    assert_eq!(thread.join().unwrap(), (End::Stopped, State::Stopped, 0));
}
