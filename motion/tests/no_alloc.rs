//! Cyclic code does not allocate: a whole program under an allocator that counts.
#![allow(unsafe_code)] // A global allocator can't be written without.

mod common;
use common::plate;
use common::rig::{Rig, programs};
use common::shop::{disk, environment, three_axes};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use takt_motion::feeder::ngc_reader;
use takt_motion::machine::{AxisConfig, ChannelConfig};
use takt_motion::{Background, Machine, MachineConfig};

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

/// Counts what this thread asks for and gives back: the harness has threads of its own.
struct Counting;

// SAFETY: everything goes to the system allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, p: *mut u8, layout: Layout) {
        COUNT.set(COUNT.get() + 1);
        unsafe { System.dealloc(p, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Ticks and calls of all blocks, from power-on over a hold to the end of the program: no allocation, no release.
#[test]
fn ticks_and_calls_do_not_allocate() {
    let axis = |name: &str| AxisConfig { v_max_mm_s: 1200.0, a_max_mm_s2: 20_000.0, ..AxisConfig::named(name) };
    let channel = ChannelConfig { axes: vec!["X".into(), "Y".into()], ..ChannelConfig::default() };
    let config = MachineConfig {
        axes: vec![axis("X"), axis("Y")],
        channels: vec![channel],
        trace_ticks: 1000,
        ..MachineConfig::default()
    };
    let mut rig = Rig::new(&config, programs(&[("plate", plate(0.0, 0.0))]), Background::Manual);
    rig.power_on();
    let names = ["CNC_LoadProgram", "CNC_Run", "CNC_Hold", "CNC_Resume", "CNC_ReadStatus", "CNC_ReadError", "CNC_AuxHandshake"];
    let fbs: Vec<_> = names.iter().map(|n| rig.fb(n)).collect();
    let axis_fbs: Vec<_> =
        ["MC_MoveAbsolute", "MC_Stop", "MC_ReadStatus", "MC_ReadActualPosition"].iter().map(|n| rig.fb(n)).collect();
    let all: Vec<_> = fbs.iter().chain(&axis_fbs).collect();
    fbs[4..].iter().chain(&axis_fbs[2..]).for_each(|fb| rig.set(fb, "Enable", true));
    rig.text(&fbs[0], "FileName", "plate");
    rig.set(&fbs[0], "Execute", true);
    let (mut done, mut count) = (false, 0);
    for t in 0..6000 {
        match t {
            100 => rig.set(&fbs[1], "Execute", true),
            800 => rig.set(&fbs[2], "Execute", true),
            1500 => rig.set(&fbs[3], "Execute", true),
            900 => rig.set(&axis_fbs[0], "Execute", true),
            _ => {}
        }
        rig.machine.pump();
        let before = COUNT.get();
        rig.run(&all, 1);
        count += COUNT.get() - before;
        done |= rig.get(&fbs[1], "Done");
    }
    assert!(done, "{:?}", rig.machine.report());
    assert!(rig.get(&axis_fbs[0], "Error"), "refused: the axis belongs to the channel");
    assert_eq!(count, 0);
}

/// The same for what a program asks the machine while it runs: PLC variables, inputs, outputs, the probe, threads, tapping, single blocks.
#[test]
fn questions_and_threads_do_not_allocate() {
    let text = "F6000\nG1 X10\n#<_plc_v0> = [#<_plc_level> + 1]\nM66 P1 L3 Q0.05\nM62 P3\nG1 X20\nM67 E1 Q2\nG38.3 Z-5\n\
        S1200 M3\nG4 P0.3\nG33 Z-9 K1\nG33.1 Z-12 K1\nG95 F0.1\nG1 X22\nG94 F6000\nM52\nG1 X30\nM1\nM2\n";
    let config = three_axes(ChannelConfig::default());
    let machine = Machine::with_environment(&config, environment(&disk(&[("a.ngc", text)])), ngc_reader(), Background::Manual);
    let mut rig = Rig::on(&config, machine);
    rig.power_on();
    let names = [
        "CNC_LoadProgram",
        "CNC_Io",
        "CNC_Panel",
        "CNC_ReadProbe",
        "CNC_ReadStatus",
        "CNC_MDI",
        "CNC_CallSub",
        "CNC_CheckProgram",
    ];
    let fbs: Vec<_> = names.iter().map(|n| rig.fb(n)).collect();
    let all: Vec<_> = fbs.iter().collect();
    fbs[1..5].iter().for_each(|fb| rig.set(fb, "Enable", true));
    rig.text(&fbs[0], "FileName", "a.ngc");
    rig.set(&fbs[0], "Execute", true);
    let mut count = 0;
    for t in 0..9000 {
        match t {
            50 => rig.set(&fbs[7], "Execute", true),
            100 => rig.set(&fbs[2], "SingleBlock", true),
            2000 => rig.set(&fbs[2], "SingleBlock", false),
            _ => {}
        }
        rig.set(&fbs[2], "CycleStart", t >= 100 && t % 50 < 25 && rig.cnc() != takt_motion::channel::CncState::Ready || t == 110);
        rig.machine.pump();
        let before = COUNT.get();
        rig.run(&all, 1);
        count += COUNT.get() - before;
    }
    let report = &rig.machine.report().channels[0];
    assert_eq!((report.part_count, report.error.clone(), rig.axis(0)), (1, None, 30.0));
    assert_eq!(count, 0);
}
