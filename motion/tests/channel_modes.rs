//! Modes in which a program is tried out: single block, dry run, machine lock, optional stop, block skip, block search; blocks typed in,
//! subroutines called, programs checked.

mod common;
use common::rig::{Fb, Rig};
use common::shop::{FLAG, LEVEL, V, disk, running, shop, three_axes};
use takt_base::Code;
use takt_motion::axis::AxisState;
use takt_motion::channel::CncState;
use takt_motion::machine::ChannelConfig;

fn plain() -> ChannelConfig {
    ChannelConfig::default()
}

/// A machine with a program loaded, and a panel.
fn panel(channel: ChannelConfig, text: &str) -> (Rig, Fb) {
    let mut rig = shop(&three_axes(channel), &disk(&[("a.ngc", text)]));
    let load = rig.fb("CNC_LoadProgram");
    rig.text(&load, "FileName", "a.ngc");
    rig.set(&load, "Execute", true);
    rig.until(&[&load], &load, "Done", 200);
    let panel = rig.fb("CNC_Panel");
    rig.set(&panel, "Enable", true);
    rig.run(&[&panel], 2);
    (rig, panel)
}

/// Presses cycle start, and waits for a state.
fn start(rig: &mut Rig, panel: &Fb, until: CncState) {
    rig.set(panel, "CycleStart", true);
    rig.run(&[panel], 2);
    rig.set(panel, "CycleStart", false);
    for _ in 0..60_000 {
        if rig.cnc() == until {
            return;
        }
        rig.run(&[panel], 1);
    }
    panic!("{:?} instead of {until:?}, {:?}", rig.cnc(), rig.error());
}

fn line(rig: &Rig) -> u32 {
    rig.machine.core().channels[0].mark().line
}

/// R1-86, R2-117: one block per cycle start. The plan would pass these joints at full speed.
#[test]
fn single_block_stops_behind_every_block() {
    let text = "G21 G90 F6000\nG1 X10\nG1 X20\n#1 = 5\nG1 X30 Y0.1\nG4 P0.01\nM2\n";
    let (mut rig, panel) = panel(plain(), text);
    rig.set(&panel, "SingleBlock", true);
    for want in [10.0, 20.0, 30.0] {
        start(&mut rig, &panel, CncState::StepStop);
        rig.run(&[&panel], 100);
        assert_eq!((rig.axis(0), rig.velocity(), rig.cnc()), (want, 0.0, CncState::StepStop));
    }
    start(&mut rig, &panel, CncState::StepStop);
    assert_eq!(line(&rig), 6);
    start(&mut rig, &panel, CncState::Ready);
}

/// R2-117: switched on in the middle, the block in execution ends first; a block too short to stop in is followed by the next; switched
/// off, the rest runs through. The axes keep their acceleration.
#[test]
fn single_block_in_the_middle() {
    let mut text = "F6000\n".to_owned();
    (1..=200).for_each(|k| text += &format!("G1 X{}\n", f64::from(k) * 0.5));
    let mut config = three_axes(plain());
    config.axes.iter_mut().for_each(|a| a.a_max_mm_s2 = 1000.0);
    let mut rig = shop(&config, &disk(&[("a.ngc", &text)]));
    let run = rig.start("a.ngc");
    let panel = rig.fb("CNC_Panel");
    rig.set(&panel, "Enable", true);
    rig.run(&[&run, &panel], 500);
    let at = rig.axis(0);
    assert!(rig.velocity() > 99.9 && at > 30.0);
    rig.set(&panel, "SingleBlock", true);
    let mut speeds = vec![rig.velocity()];
    while rig.cnc() == CncState::Running {
        rig.run(&[&run, &panel], 1);
        speeds.push(rig.velocity());
    }
    let most = speeds.windows(2).map(|w| (w[1] - w[0]).abs() / 0.001).fold(0.0, f64::max);
    assert!(most <= 1000.0 * (1.0 + 1e-6), "{most}");
    // 100 mm/s and 1000 mm/s2 need 5 mm: ten blocks of 0.5 mm.
    let stop = rig.axis(0);
    assert_eq!((rig.cnc(), (2.0 * stop).fract()), (CncState::StepStop, 0.0));
    assert!(stop >= at + 4.9 && stop <= at + 5.7, "{at} {stop}");
    rig.set(&panel, "SingleBlock", false);
    start(&mut rig, &panel, CncState::Ready);
    assert_eq!(rig.axis(0), 100.0);
}

/// S40 b: with CNC_StepBlock; M10 stops after Fin.
#[test]
fn s40_b_step_block() {
    let text = "G21 G90 G94\nG1 X100 F6000\nM8\nM10\nG1 X200\nM30\n";
    let (mut rig, panel) = panel(ChannelConfig { handshake: true, ..plain() }, text);
    let (aux, step) = (rig.fb("CNC_AuxHandshake"), rig.fb("CNC_StepBlock"));
    rig.set(&aux, "Enable", true);
    rig.set(&panel, "SingleBlock", true);
    start(&mut rig, &panel, CncState::StepStop);
    assert_eq!((rig.axis(0), line(&rig)), (100.0, 2));
    let mut lines = Vec::new();
    for _ in 0..4 {
        rig.set(&step, "Execute", true);
        let mut waited = 0;
        for _ in 0..5000 {
            rig.call(&step);
            rig.call(&aux);
            let mf = rig.get(&aux, "Mf");
            // The PLC program takes its time for M10.
            waited += i32::from(mf);
            rig.set(&aux, "Fin", mf && (waited > 300 || rig.get_u16(&aux, "MCode") != 10));
            if rig.get(&step, "Done") {
                break;
            }
            rig.tick();
        }
        assert!(rig.get(&step, "Done"), "{:?}", rig.cnc());
        lines.push((line(&rig), rig.cnc(), waited > 300));
        rig.set(&step, "Execute", false);
        rig.call(&step);
    }
    let stop = CncState::StepStop;
    assert_eq!(lines, [(3, stop, false), (4, stop, true), (5, stop, false), (6, CncState::Ready, false)]);
    assert_eq!(rig.axis(0), 200.0);
}

/// R1-85: the feed of the dry run replaces the programmed one; switched on in the middle it waits for the next start.
#[test]
fn dry_run() {
    let channel = ChannelConfig { dry_run_mm_min: 12_000.0, ..plain() };
    let (mut rig, panel) = panel(channel, "F600\nG1 X10\nS100 M3\nG95 F0.1\nG1 X20\nG33 Z-5 K1\nM2\n");
    let top = |rig: &mut Rig, panel: &Fb| {
        let mut top: f64 = 0.0;
        rig.set(panel, "CycleStart", true);
        for _ in 0..20_000 {
            rig.run(&[panel], 1);
            top = top.max(rig.velocity().abs());
            if rig.cnc() == CncState::Ready {
                break;
            }
        }
        rig.set(panel, "CycleStart", false);
        rig.run(&[panel], 1);
        top
    };
    rig.set(&panel, "DryRun", true);
    assert!((top(&mut rig, &panel) - 200.0).abs() < 1e-6);
    assert_eq!([rig.axis(0), rig.axis(2)], [20.0, -5.0]);
    rig.set(&panel, "DryRun", false);
    rig.set(&panel, "CycleStart", true);
    rig.run(&[&panel], 50);
    rig.set(&panel, "DryRun", true);
    rig.run(&[&panel], 50);
    assert!(rig.velocity().abs() < 10.1, "{}", rig.velocity());
}

/// R1-87: the path runs and shows, the axes stand; outputs and codes come.
#[test]
fn machine_lock() {
    let (mut rig, panel) = panel(plain(), "F6000\nG1 X10\nM64 P1\n#<_plc_flag> = 1\nG1 X30\nM2\n");
    let status = rig.fb("CNC_ReadStatus");
    rig.set(&status, "Enable", true);
    rig.set(&panel, "MachineLock", true);
    rig.set(&panel, "CycleStart", true);
    let mut farthest: f64 = 0.0;
    for _ in 0..2000 {
        rig.run(&[&panel, &status], 1);
        farthest = farthest.max(rig.machine.core().channels[0].position()[0]);
        assert_eq!(rig.axis(0), 0.0);
        if rig.cnc() == CncState::Ready {
            break;
        }
    }
    assert_eq!((farthest, rig.memory[FLAG], rig.state()), (30.0, 1, AxisState::Standstill));
    assert!(rig.machine.core().channels[0].io.outputs[1]);
    assert_eq!(rig.machine.report().path_deviation_max_mm, 0.0);
    // Unlocked the next run starts where the axes are.
    rig.set(&panel, "MachineLock", false);
    rig.set(&panel, "CycleStart", false);
    rig.run(&[&panel], 2);
    start(&mut rig, &panel, CncState::Ready);
    assert_eq!(rig.axis(0), 30.0);
}

/// R1-87: one axis alone is locked.
#[test]
fn one_axis_is_locked() {
    let (mut rig, panel) = panel(plain(), "F6000\nG1 X10 Y10 Z-5\nM2\n");
    rig.word(&panel, "AxisLock", 0b100);
    start(&mut rig, &panel, CncState::Ready);
    assert_eq!([rig.axis(0), rig.axis(1), rig.axis(2)], [10.0, 10.0, 0.0]);
}

/// M1 with and without the switch; `/` with and without the switch, as it was at the start; codes with and without the lock.
#[test]
fn optional_stop_block_skip_and_lock_of_codes() {
    let text = "F6000\nG1 X10\nM1\n/G1 Y5\n/M101\nM8\nG1 X20\nM2\n";
    let (mut rig, panel) = panel(plain(), text);
    for switch in ["OptionalStop", "BlockSkip"] {
        rig.set(&panel, switch, true);
    }
    start(&mut rig, &panel, CncState::ProgStop);
    assert_eq!(rig.axis(0), 10.0);
    rig.set(&panel, "AuxLock", true);
    start(&mut rig, &panel, CncState::Ready);
    assert_eq!([rig.axis(0), rig.axis(1)], [20.0, 0.0]);
    let aux = rig.fb("CNC_AuxHandshake");
    rig.set(&aux, "Enable", true);
    rig.run(&[&panel, &aux], 30);
    assert_eq!(rig.get_u32(&aux, "Seq"), 0, "no code was shown");
    rig.set(&panel, "OptionalStop", false);
    rig.set(&panel, "BlockSkip", false);
    rig.set(&panel, "AuxLock", false);
    start(&mut rig, &panel, CncState::Ready);
    assert_eq!([rig.axis(0), rig.axis(1)], [20.0, 5.0]);
    rig.run(&[&panel, &aux], 30);
    assert!(rig.get_u32(&aux, "Seq") > 2, "M101, M8, M9");
}

/// FeedHold beats CycleStart and needs it to go on; ReadInDisable lets the block end; FeedDisable stops on the path.
#[test]
fn levels_of_the_panel() {
    let (mut rig, panel) = panel(plain(), "F6000\nG1 X50\nG1 X100\nM2\n");
    rig.set(&panel, "CycleStart", true);
    rig.run(&[&panel], 100);
    rig.set(&panel, "CycleStart", false);
    rig.set(&panel, "FeedDisable", true);
    rig.run(&[&panel], 50);
    let at = rig.axis(0);
    rig.run(&[&panel], 50);
    assert_eq!((rig.axis(0), rig.cnc()), (at, CncState::Running));
    rig.set(&panel, "FeedDisable", false);
    rig.set(&panel, "FeedHold", true);
    rig.set(&panel, "CycleStart", true);
    rig.run(&[&panel], 50);
    assert!(rig.cnc() == CncState::Held && rig.get(&panel, "HoldLamp"));
    rig.set(&panel, "FeedHold", false);
    rig.set(&panel, "ReadInDisable", true);
    rig.run(&[&panel], 20);
    assert_eq!(rig.cnc(), CncState::Held, "the button was pressed too early");
    rig.set(&panel, "CycleStart", false);
    rig.run(&[&panel], 1);
    rig.set(&panel, "CycleStart", true);
    rig.run(&[&panel], 1000);
    assert_eq!((rig.axis(0), rig.cnc()), (50.0, CncState::Running));
    rig.set(&panel, "ReadInDisable", false);
    rig.run(&[&panel], 1000);
    assert_eq!((rig.axis(0), rig.cnc()), (100.0, CncState::Ready));
    assert!(rig.get(&panel, "CanStart") && !rig.get(&panel, "StartLamp"));
    rig.set(&panel, "ResetBtn", true);
    rig.run(&[&panel], 1);
    assert!(!rig.get(&panel, "Error"));
}

/// Block search with modes: what stands before the line counts and does not move; the axes go straight to where the path goes on.
#[test]
fn block_search() {
    let text = "G21 G90 F6000\nS500 M3\nT3 M6\nM8\n#1 = 7\nG1 X10 Y10\nG91\nG1 X5\nG1 Y5\nG90\n#<_plc_level> = #1\nG1 X0\nM2\n";
    let mut rig = shop(&three_axes(plain()), &disk(&[("a.ngc", text)]));
    let (load, run) = (rig.fb("CNC_LoadProgram"), rig.fb("CNC_Run"));
    rig.text(&load, "FileName", "a.ngc");
    rig.set(&load, "Execute", true);
    rig.until(&[&load], &load, "Done", 100);
    rig.word(&run, "StartLine", 9);
    rig.int(&run, "StartMode", 1);
    rig.set(&run, "Execute", true);
    let mut corner = false;
    for _ in 0..5000 {
        rig.run(&[&run], 1);
        corner |= (rig.axis(0) - 15.0).abs() < 0.2 && (rig.axis(1) - 10.0).abs() < 0.2;
        assert!(rig.axis(1) <= rig.axis(0).max(15.0) && (line(&rig) >= 9 || line(&rig) == 0), "{}", line(&rig));
        if rig.get(&run, "Done") {
            break;
        }
    }
    assert!(corner, "over the start of line 9");
    assert_eq!([rig.axis(0), rig.axis(1), rig.real(LEVEL)], [0.0, 15.0, 7.0]);
    // Raw: nothing that stands before the line is known. G90 is the default, no F: N0008.
    rig.set(&run, "Execute", false);
    rig.run(&[&run], 3);
    rig.int(&run, "StartMode", 2);
    rig.word(&run, "StartLine", 12);
    rig.set(&run, "Execute", true);
    rig.until(&[&run], &run, "Error", 100);
    assert_eq!(rig.error().map(|e| e.0), Some(Code::NoFeed));
}

/// Collected codes come before the first move, once.
#[test]
fn block_search_collects_codes() {
    let text = "F6000\nS500 M3\nT3 M6\nM8\nM9\nM7\nS800 M4\nG1 X10\nG1 X20\nM2\n";
    let (mut rig, _) = panel(ChannelConfig { handshake: true, ..plain() }, text);
    let (aux, run) = (rig.fb("CNC_AuxHandshake"), rig.fb("CNC_Run"));
    rig.set(&aux, "Enable", true);
    rig.word(&run, "StartLine", 9);
    rig.int(&run, "StartMode", 1);
    rig.set(&run, "Execute", true);
    let (mut codes, mut before) = (Vec::new(), false);
    for _ in 0..5000 {
        rig.call(&run);
        rig.call(&aux);
        let strobes = rig.get(&aux, "Mf") || rig.get(&aux, "Tf") || rig.get(&aux, "Sf");
        if strobes && !before {
            codes.push((
                rig.get_u16(&aux, "MCode"),
                rig.get_lreal(&aux, "SCode"),
                rig.get_u32(&aux, "TCode"),
                rig.axis(0).floor(),
            ));
        }
        before = strobes;
        rig.set(&aux, "Fin", strobes);
        if rig.get(&run, "Done") {
            break;
        }
        rig.tick();
    }
    // T is a note of its own; M6, S and M4 wait together; M7 is a note. Then the path goes to X10 and on.
    let expected = [(0, 0.0, 3, 0.0), (6, 800.0, 0, 0.0), (7, 0.0, 0, 0.0), (2, 0.0, 0, 20.0)];
    let seen: Vec<_> = codes.iter().copied().filter(|c| !matches!(c.0, 5 | 9)).collect();
    assert_eq!(seen, expected, "{codes:?}");
    assert_eq!(rig.axis(0), 20.0);
}

/// N0078: the line does not come.
#[test]
fn block_search_for_a_line_that_does_not_come() {
    let (mut rig, _) = panel(plain(), "F6000\nG1 X10\nM2\n");
    let run = rig.fb("CNC_Run");
    rig.word(&run, "StartLine", 500);
    rig.int(&run, "StartMode", 1);
    rig.set(&run, "Execute", true);
    rig.until(&[&run], &run, "Error", 100);
    assert_eq!((rig.error().map(|e| e.0), rig.axis(0)), (Some(Code::NoStartLine), 0.0));
}

/// CNC_MDI: modes stay from block to block; no program is needed.
#[test]
fn blocks_typed_in() {
    let mut rig = shop(&three_axes(plain()), &disk(&[]));
    let mdi = rig.fb("CNC_MDI");
    for (block, want) in
        [("G91 F6000", 0.0), ("G1 X5", 5.0), ("X5", 10.0), ("G90 G20", 10.0), ("X1", 25.4), ("#<_plc_v0> = #<_x>", 25.4)]
    {
        rig.text(&mdi, "Block", block);
        rig.set(&mdi, "Execute", true);
        rig.until(&[&mdi], &mdi, "Done", 1000);
        assert!((rig.axis(0) - want).abs() < 1e-9, "{block}: {}", rig.axis(0));
        rig.set(&mdi, "Execute", false);
        rig.run(&[&mdi], 2);
    }
    assert!((rig.real(V) - 1.0).abs() < 1e-12);
    assert_eq!(rig.cnc(), CncState::Idle);
    rig.text(&mdi, "Block", "G1 X");
    rig.set(&mdi, "Execute", true);
    rig.until(&[&mdi], &mdi, "Error", 100);
    assert_eq!((rig.get_u16(&mdi, "ErrorID"), rig.error().map(|e| e.0)), (Code::ProgramError.error_id(), Some(Code::BadWord)));
}

/// CNC_CallSub: arguments in, value out.
#[test]
fn subroutine_called_by_the_plc() {
    let files = disk(&[("subs/bore.ngc", "o<bore> sub\nG1 X#1 F6000\nG1 Y#2\no<bore> endsub [#1 + #2 / 4]\n")]);
    let mut rig = shop(&three_axes(ChannelConfig { subs: vec!["subs".into()], ..plain() }), &files);
    let call = rig.fb("CNC_CallSub");
    rig.text(&call, "Name", "bore");
    rig.lreal_at(&call, "Args", 0, 3.5);
    rig.lreal_at(&call, "Args", 1, -2.0);
    rig.word(&call, "ArgCount", 2);
    rig.set(&call, "Execute", true);
    rig.until(&[&call], &call, "Done", 1000);
    assert_eq!([rig.axis(0), rig.axis(1), rig.get_lreal(&call, "Result")], [3.5, -2.0, 3.0]);
    for (name, code) in [("no such", Code::ParameterOutOfRange), ("none", Code::ProgramError)] {
        rig.set(&call, "Execute", false);
        rig.run(&[&call], 2);
        rig.text(&call, "Name", name);
        rig.set(&call, "Execute", true);
        rig.until(&[&call], &call, "Error", 100);
        assert_eq!(rig.get_u16(&call, "ErrorID"), code.error_id(), "{name}");
        rig.run(&[&call], 3);
    }
}

/// CNC_CheckProgram: time and extent of a good program, place and text of an error; nothing moves.
#[test]
fn checking_a_program() {
    let (mut rig, _) = panel(plain(), "F6000\nG1 X100\nG2 X100 Y20 J10\nG4 P0.5\nM66 P1 L3 Q10\nG1 X0\nM2\n");
    let check = rig.fb("CNC_CheckProgram");
    rig.set(&check, "Execute", true);
    rig.until(&[&check], &check, "Done", 100);
    let time = rig.get_i64(&check, "EstimatedTime");
    // 100 + 10 pi + 100 mm at 100 mm/s, half a second, and a little for the corners.
    let ideal = 0.5 + (200.0 + 10.0 * std::f64::consts::PI) / 100.0;
    assert!((time as f64 * 1e-9 - ideal).abs() < 0.02, "{time}");
    let bounds = [0, 1].map(|i| [rig.get_lreal_at(&check, "BoundMin", i), rig.get_lreal_at(&check, "BoundMax", i)]);
    // G2 from (100, 0) round (100, 10): over X 90.
    assert!((bounds[0][1] - 100.0).abs() < 1e-9 && bounds[1] == [0.0, 20.0], "{bounds:?}");
    assert_eq!(rig.axis(0), 0.0);
    let (mut rig, _) = panel(plain(), "F6000\nG1 X100\nG1 X20000\nM2\n");
    let check = rig.fb("CNC_CheckProgram");
    rig.set(&check, "Execute", true);
    rig.until(&[&check], &check, "Error", 100);
    assert_eq!((rig.get_u32(&check, "ErrorLine"), rig.get_u16(&check, "ErrorID")), (3, Code::ProgramError.error_id()));
    assert!(rig.get_text(&check, "Message").contains('X'));
}

/// The error of a program behind an answer that is only assumed does not keep it from being loaded.
#[test]
fn loading_does_not_invent_errors() {
    let (mut rig, run) = running(plain(), "#1 = #<_plc_level>\nF[6000 / #1]\nG1 X10\nM2\n");
    rig.set_real(LEVEL, 1.0);
    rig.until(&[&run], &run, "Done", 1000);
    let files = disk(&[("a.ngc", "#1 = #<_plc_level>\nG1 G2 X1\nM2\n")]);
    let mut rig = shop(&three_axes(plain()), &files);
    let load = rig.fb("CNC_LoadProgram");
    rig.text(&load, "FileName", "a.ngc");
    rig.set(&load, "Execute", true);
    rig.until(&[&load], &load, "Error", 100);
    assert_eq!(rig.error().map(|e| e.0), Some(Code::ModalConflict));
}
