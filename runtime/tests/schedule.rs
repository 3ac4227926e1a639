//! The scheduler in virtual time, with an engine that only writes down what it is asked to run.

mod support;

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};
use support::{Asm, Bare, symbol, task};
use takt_base::Nanos;
use takt_image::image::{Place, Task};
use takt_image::natives::{BindError, NativeImport};
use takt_image::{Cyclic, Elementary, Engine, Fault, Image, NativeCall, Natives, Trap, TypeTable};
use takt_runtime::*;

type Log = Rc<RefCell<Vec<String>>>;
type Action = Box<dyn FnMut(u32, Nanos, &mut [u8]) -> Result<(), Fault>>;

/// Writes `f@ms` for each program, then does what the test says.
struct Script {
    log: Log,
    action: Action,
}

impl Engine for Script {
    fn run(&mut self, f: u32, _: u32, now: Nanos, _: Nanos, memory: &mut [u8], _: &mut dyn Natives) -> Result<(), Fault> {
        self.log.borrow_mut().push(format!("{f}@{}", now.0 / 1_000_000));
        (self.action)(f, now, memory)
    }
}

/// Writes `tick@ms` and `stop`.
struct Motion(Log, Nanos);

impl Natives for Motion {
    fn bind(&mut self, _: &NativeImport, _: &TypeTable) -> Result<u32, BindError> {
        Err(BindError::Unknown)
    }
    fn call(&mut self, _: u32, _: &mut NativeCall) -> Result<(), Trap> {
        Err(Trap::NativePanic)
    }
}

impl Cyclic for Motion {
    fn period(&self) -> Option<Nanos> {
        Some(self.1)
    }
    fn tick(&mut self, now: Nanos) {
        self.0.borrow_mut().push(format!("tick@{}", now.0 / 1_000_000));
    }
    fn safe_stop(&mut self) {
        self.0.borrow_mut().push("stop".into());
    }
}

/// Keeps what was written to the outputs.
struct Wires(Rc<RefCell<Vec<Vec<u8>>>>);

impl Driver for Wires {
    fn read_inputs(&mut self, _: Nanos, _: u64, _: &mut [u8]) {}
    fn write_outputs(&mut self, _: Nanos, outputs: &[u8]) {
        self.0.borrow_mut().push(outputs.to_vec());
    }
}

const fn ms(n: i64) -> Nanos {
    Nanos::from_millis(n)
}

/// An image with functions 0 to 9 that nobody really calls.
fn image(tasks: impl FnOnce(&Image) -> Vec<Task>) -> Image {
    let mut image = (0..10).fold(Asm::new(), |a, i| a.function(&format!("Pou{i}"), &[0xC3], &[], &[])).image;
    image.tasks = tasks(&image);
    image
}

fn script(log: &Log, action: impl FnMut(u32, Nanos, &mut [u8]) -> Result<(), Fault> + 'static) -> Box<dyn Engine> {
    Box::new(Script { log: log.clone(), action: Box::new(action) })
}

fn fault(line: u32) -> Result<(), Fault> {
    Err(Fault { trap: Trap::Index, function: 3, file: 1, line })
}

fn run(r: &mut Resource, clock: &mut Virtual, until: Nanos) -> End {
    r.run_until(clock, Some(until), &AtomicBool::new(false), &mut |_, _| true)
}

/// Runs with programs that take no time, and returns the log.
fn trace(tasks: impl FnOnce(&Image) -> Vec<Task>, until: Nanos) -> String {
    let log = Log::default();
    let mut r = Resource::new(image(tasks), script(&log, |_, _, _| Ok(())), Box::new(Bare), Options::default()).unwrap();
    let mut clock = Virtual::new();
    assert_eq!(run(&mut r, &mut clock, until), End::Deadline);
    assert_eq!(clock.now(), until);
    log.take().join(" ")
}

#[test]
fn phases_and_priorities() {
    let got = trace(|i| vec![task("slow", 2, Some(10), &[0], i), task("fast", 1, Some(4), &[1, 2], i)], ms(13));
    assert_eq!(got, "1@0 2@0 0@0 1@4 2@4 1@8 2@8 0@10 1@12 2@12");
    // Equal priorities: the one that waits longest, then the order of declaration.
    let got = trace(|i| vec![task("a", 1, Some(2), &[0], i), task("b", 1, Some(3), &[1], i)], ms(7));
    assert_eq!(got, "0@0 1@0 0@2 1@3 0@4 0@6 1@6");
}

#[test]
fn a_background_task_runs_when_nothing_else_is_ready() {
    let got = trace(|i| vec![task("back", 0, None, &[0], i), task("fast", 9, Some(2), &[1], i)], ms(4));
    assert_eq!(got, "1@0 0@0 0@1 1@2 0@2 0@3");
}

#[test]
fn nothing_to_run_ends_at_once() {
    let log = Log::default();
    let mut r = Resource::new(image(|_| vec![]), script(&log, |_, _, _| Ok(())), Box::new(Bare), Options::default()).unwrap();
    assert_eq!(run(&mut r, &mut Virtual::new(), ms(5)), End::NothingToRun);
}

#[test]
fn overruns_skip_and_keep_the_phase() {
    let (log, clock) = (Log::default(), Virtual::new());
    let passing = clock.clone();
    // The second activation takes 25 ms, all others 1 ms.
    let mut calls = 0;
    let engine = script(&log, move |_, _, _| {
        calls += 1;
        passing.advance(ms(if calls == 2 { 25 } else { 1 }));
        Ok(())
    });
    let mut r =
        Resource::new(image(|i| vec![task("t", 0, Some(10), &[0], i)]), engine, Box::new(Bare), Options::default()).unwrap();
    assert_eq!(run(&mut r, &mut clock.clone(), ms(55)), End::Deadline);
    assert_eq!(log.take().join(" "), "0@0 0@10 0@40 0@50");
    let stats = r.stats().next().unwrap();
    assert_eq!((stats.scans, stats.overruns, stats.lateness.max()), (4, 2, Nanos(0)));
}

#[test]
fn a_late_task_takes_the_newest_release_and_time_never_goes_back() {
    let (log, clock) = (Log::default(), Virtual::new());
    let passing = clock.clone();
    let engine = script(&log, move |f, now, _| {
        passing.advance(if f == 0 && now == ms(0) { ms(35) } else { Nanos(0) });
        Ok(())
    });
    let tasks = |i: &Image| vec![task("long", 0, Some(100), &[0], i), task("fast", 1, Some(10), &[1], i)];
    let mut r = Resource::new(image(tasks), engine, Box::new(Bare), Options::default()).unwrap();
    assert_eq!(run(&mut r, &mut clock.clone(), ms(51)), End::Deadline);
    assert_eq!(log.take().join(" "), "0@0 1@30 1@40 1@50");
    let fast = r.stats().nth(1).unwrap();
    assert_eq!((fast.overruns, fast.lateness.max()), (3, ms(5)));
    assert_eq!(r.counts().overruns, 3);
}

#[test]
fn ticks_run_before_tasks_of_the_same_instant_and_are_never_made_up_for() {
    let (log, clock) = (Log::default(), Virtual::new());
    let passing = clock.clone();
    let engine = script(&log, move |_, now, _| {
        passing.advance(if now == ms(4) { ms(5) } else { Nanos(0) });
        Ok(())
    });
    let host = Box::new(Motion(log.clone(), ms(2)));
    let mut r = Resource::new(image(|i| vec![task("t", 0, Some(4), &[0], i)]), engine, host, Options::default()).unwrap();
    assert_eq!(run(&mut r, &mut clock.clone(), ms(13)), End::Deadline);
    assert_eq!(log.take().join(" "), "tick@0 0@0 tick@2 tick@4 0@4 tick@8 tick@10 tick@12 0@12");
    assert_eq!((r.ticks_skipped(), r.counts().ticks), (1, 6));
}

#[test]
fn a_rising_edge_runs_a_single_task_once() {
    let log = Log::default();
    let mut image = image(|i| {
        let event = Task { trigger: Some(Place::Bit(i.memory.inputs.start, 3)), ..task("event", 0, None, &[0], i) };
        let both = Task { trigger: Some(Place::Byte(i.memory.data.start)), ..task("both", 1, Some(10), &[1], i) };
        vec![event, both]
    });
    let at = image.memory.data.start;
    symbol(&mut image, "go", Elementary::Bool, Place::Byte(at));
    let csv = "time,%IX0.3,go\n0.005,TRUE,\n0.007,FALSE,\n0.008,TRUE,\n0.012,,TRUE\n0.035,,FALSE";
    let driver = SimDriver::new(Stimulus::from_csv(&image, csv).unwrap());
    let r = Resource::new(image, script(&log, |_, _, _| Ok(())), Box::new(Bare), Options::default()).unwrap();
    let mut r = r.with_driver(Box::new(driver));
    assert_eq!(run(&mut r, &mut Virtual::new(), ms(45)), End::Deadline);
    // `both` runs at its edge (12) and by its interval while the trigger is FALSE (0, 10, 40), not at 20 and 30.
    assert_eq!(log.take().join(" "), "1@0 0@5 0@8 1@10 1@12 1@40");
    assert!(r.stats().all(|s| s.overruns == 0));
}

#[test]
fn a_scan_number_can_release_a_triggered_task() {
    let log = Log::default();
    let image = image(|i| vec![Task { trigger: Some(Place::Bit(i.memory.inputs.start, 0)), ..task("event", 0, None, &[0], i) }]);
    let driver = SimDriver::new(Stimulus::from_csv(&image, "scan,%IX0.0\n1,TRUE").unwrap());
    let r = Resource::new(image, script(&log, |_, _, _| Ok(())), Box::new(Bare), Options::default()).unwrap();
    let mut r = r.with_driver(Box::new(driver));
    run(&mut r, &mut Virtual::new(), ms(5));
    assert_eq!(log.take().join(" "), "0@0");
}

/// Function 0 sets output bits 0 and 1, function 1 sets bits 1 and 2; function 0 fails at 20 ms after it has set bit 3.
fn outputs_after_fault(on_fault: OnFault) -> (Vec<Vec<u8>>, Vec<String>, End, State) {
    let (log, wires) = (Log::default(), Rc::default());
    let image = image(|i| vec![task("a", 0, Some(10), &[0, 0], i), task("b", 1, Some(10), &[1], i)]);
    let out = image.memory.outputs.start as usize;
    let engine = script(&log, move |f, now, memory| {
        memory[out] |= [0b0011, 0b0110][f.min(1) as usize];
        memory[out + 1] = now.0 as u8 | 1;
        if f == 0 && now == ms(20) {
            memory[out] |= 0b1000;
            return fault(12);
        }
        Ok(())
    });
    let options = Options { on_fault, safe_outputs: vec![0b1001_0000], ..Options::default() };
    let host = Box::new(Motion(log.clone(), ms(100)));
    let r = Resource::new(image, engine, host, options).unwrap();
    let mut r = r.with_driver(Box::new(Wires(Rc::clone(&wires))));
    let end = run(&mut r, &mut Virtual::new(), ms(40));
    let report = r.fault_reports().remove(0);
    assert_eq!(report.to_string(), "F0702: array index out of bounds, b.st:12 in Pou3 (task a, program a_0, at 20ms)");
    (wires.take(), log.take(), end, r.state())
}

#[test]
fn a_fault_stops_the_resource_with_safe_outputs() {
    let (wires, log, end, state) = outputs_after_fault(OnFault::StopResource);
    assert_eq!((end, state), (End::Faulted, State::Faulted));
    assert_eq!(log[log.len() - 2..], ["0@20", "stop"]);
    assert_eq!(wires.last().unwrap()[..2], [0b1001_0000, 0]);
    assert_eq!(wires.len(), 5, "four good scans, then the safe state once");
}

#[test]
fn a_fault_stops_one_task_and_its_outputs() {
    let (wires, log, end, state) = outputs_after_fault(OnFault::StopTask);
    assert_eq!((end, state), (End::Deadline, State::Running));
    assert_eq!(log[log.len() - 3..], ["0@20", "1@20", "1@30"]);
    // Bits 0 and 3 were changed by task `a` last, and bit 1: they are safe. `b` sets bits 1 and 2 in its next scan.
    assert_eq!(wires.iter().map(|w| w[0]).collect::<Vec<_>>(), [0b0011, 0b0111, 0b0111, 0b0111, 0b0100, 0b0110, 0b0110]);
}

#[test]
fn the_last_task_takes_the_resource_with_it() {
    let log = Log::default();
    let options = Options { on_fault: OnFault::StopTask, run_down: ms(5), ..Options::default() };
    let host = Box::new(Motion(log.clone(), ms(2)));
    let mut r = Resource::new(
        image(|i| vec![task("t", 0, Some(3), &[0], i)]),
        script(&log, |_, n, _| if n == ms(3) { fault(1) } else { Ok(()) }),
        host,
        options,
    )
    .unwrap();
    let mut clock = Virtual::new();
    assert_eq!(run(&mut r, &mut clock, ms(40)), End::Faulted);
    assert_eq!(log.take().join(" "), "tick@0 0@0 tick@2 0@3 stop tick@4 tick@6");
    assert_eq!(run(&mut r, &mut clock, ms(40)), End::Faulted);
    assert_eq!((log.take().join(" "), r.advance(&clock)), (String::new(), Step::Ended));
}

#[test]
fn stop_makes_outputs_safe_once() {
    let (log, wires) = (Log::default(), Rc::default());
    let image = image(|i| vec![task("t", 0, Some(10), &[0], i)]);
    let out = image.memory.outputs.start as usize;
    let engine = script(&log, move |_, _, m| {
        m[out] = 0xFF;
        Ok(())
    });
    let r = Resource::new(image, engine, Box::new(Motion(log.clone(), ms(50))), Options::default()).unwrap();
    let mut r = r.with_driver(Box::new(Wires(Rc::clone(&wires))));
    let mut clock = Virtual::new();
    run(&mut r, &mut clock, ms(5));
    assert_eq!(r.memory()[out], 0xFF, "the deadline alone leaves the outputs as they are");
    r.stop(&mut clock);
    r.stop(&mut clock);
    assert_eq!(
        (wires.take().len(), log.take().join(" "), r.state(), r.memory()[out]),
        (2, "tick@0 0@0 stop".into(), State::Stopped, 0)
    );
}

#[test]
fn observer_and_flag_stop_the_run() {
    let log = Log::default();
    let mut r = Resource::new(
        image(|i| vec![task("t", 0, Some(10), &[0], i)]),
        script(&log, |_, _, _| Ok(())),
        Box::new(Bare),
        Options::default(),
    )
    .unwrap();
    let (mut clock, stop) = (Virtual::new(), AtomicBool::new(false));
    let mut seen = Vec::new();
    let end = r.run_until(&mut clock, None, &stop, &mut |info, memory| {
        assert_eq!(memory.len(), 4248);
        seen.push((info.scan, info.task, info.now));
        info.scan < 3
    });
    assert_eq!((end, seen), (End::Stopped, vec![(1, 0, ms(0)), (2, 0, ms(10)), (3, 0, ms(20))]));
    stop.store(true, Ordering::Relaxed);
    assert_eq!(r.run_until(&mut clock, None, &stop, &mut |_, _| true), End::Stopped);
    assert_eq!((r.counts().scans, r.progress().read().scans, r.counts().now), (3, 3, ms(20)));
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let make = |options| {
        let image = image(|i| vec![task("t", 0, Some(10), &[0], i)]);
        Resource::new(image, script(&Log::default(), |_, _, _| Ok(())), Box::new(Bare), options).err().map(|e| e.to_string())
    };
    let named = |name: &str| Options { watchdogs: vec![(name.into(), ms(5))], ..Options::default() };
    assert_eq!(make(named("T")), None);
    assert_eq!(make(named("x")).unwrap(), "a watchdog for `x`, but there is no such task");
    assert_eq!(make(Options { base_tick: Nanos(0), ..Options::default() }).unwrap(), "the base tick must be positive");
    assert!(make(Options { safe_outputs: vec![0; 9], ..Options::default() }).unwrap().contains("9 bytes of safe outputs"));
}

/// The same program and stimulus: the same memory, bit for bit, after each scan.
#[test]
fn two_runs_are_the_same() {
    let once = || {
        let log = Log::default();
        let image = image(|i| vec![task("a", 1, Some(3), &[0], i), task("b", 0, Some(7), &[1], i), task("c", 0, None, &[2], i)]);
        let data = image.memory.data.start as usize;
        let engine = script(&log, move |f, now, m| {
            for i in 0..16 {
                m[data + i] = m[data + i].wrapping_mul(31).wrapping_add(now.0 as u8 ^ f as u8 ^ i as u8 ^ m[64]);
            }
            Ok(())
        });
        let driver = SimDriver::new(Stimulus::from_csv(&image, "time,%IB0\n0.004,9\n0.050,77\n").unwrap());
        let mut r = Resource::new(image, engine, Box::new(Motion(log.clone(), ms(2))), Options::default())
            .unwrap()
            .with_driver(Box::new(driver));
        let mut memories = Vec::new();
        r.run_until(&mut Virtual::new(), Some(ms(200)), &AtomicBool::new(false), &mut |_, m| {
            memories.push(m[64..].to_vec());
            true
        });
        (memories, log.take())
    };
    assert_eq!(once(), once());
}
