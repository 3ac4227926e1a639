//! Scenarios of the CNC channel: S39, S40, program errors, real time against virtual time, the plate on real drives.

mod common;
use common::rig::{Fb, Programs, Rig, ideal, programs, reader, two_axes};
use common::{Program, plate};
use std::time::Duration;
use takt_base::{Code, Nanos};
use takt_image::Cyclic;
use takt_motion::axis::AxisState;
use takt_motion::canon::{Canon, ProgramEnd, Step};
use takt_motion::channel::CncState;
use takt_motion::machine::{AxisConfig, ChannelConfig};
use takt_motion::{Background, Machine, MachineConfig};

/// The program of S39: X100 at F600, M8, M10, X200, M30. Lines 1 to 6.
fn s39() -> Vec<Step> {
    let mut p = Program::default();
    p.feed(600.0).line(100.0, 0.0);
    p.block(Canon::FloodOn);
    p.block(Canon::UserMCode { code: 10, p: None, q: None });
    p.line(200.0, 0.0);
    p.block(Canon::ProgramEnd(ProgramEnd::M30));
    p.steps
}

fn s39_machine() -> MachineConfig {
    let mut config = two_axes(true);
    config.axes.iter_mut().for_each(|a| a.a_max_mm_s2 = 100.0);
    config
}

fn s39_rig() -> (Rig, Vec<Fb>) {
    let mut rig = Rig::new(&s39_machine(), programs(&[("s39", s39())]), Background::Inline);
    let power = rig.power_on();
    (rig, power)
}

/// S39: note and handshake. Times in cycles of 1 ms.
#[test]
fn s39_handshake() {
    let (mut rig, _) = s39_rig();
    let (aux, run) = (rig.fb("CNC_AuxHandshake"), rig.start("s39"));
    rig.set(&aux, "Enable", true);
    let (mut mf_rise, mut mf_fall) = (Vec::new(), Vec::new());
    let (mut before, mut fin_at) = (false, None);
    for t in 0..40_000i64 {
        rig.call(&run);
        rig.call(&aux);
        let mf = rig.get(&aux, "Mf");
        let m = rig.get_u16(&aux, "MCode");
        if mf && !before {
            mf_rise.push((t, m));
            assert_eq!(rig.machine.core().axes[0].state(), AxisState::SynchronizedMotion);
        }
        if !mf && before {
            mf_fall.push(t);
        }
        before = mf;
        if mf && m == 10 && t == mf_rise[1].0 + 2000 {
            assert_eq!((rig.cnc(), rig.machine.core().channels[0].mark().line), (CncState::AuxWait, 4));
            assert!((rig.position() - 100.0).abs() < 1e-9);
            rig.set(&aux, "Fin", true);
            fin_at = Some(t + 1);
        }
        if mf && m == 30 {
            assert!(rig.get(&aux, "Dm30"));
            rig.set(&aux, "Fin", true);
        }
        if !mf {
            rig.set(&aux, "Fin", false);
        }
        if rig.get(&run, "Done") {
            break;
        }
        rig.tick();
    }
    assert!(rig.get(&run, "Done"));
    // At 10.1 s the note, one call long; then M10 one call after its code; M30 2 s + 10.1 s later.
    let near = |got: i64, want: i64| assert!((got - want).abs() <= 6, "{got} is not {want}");
    assert_eq!(mf_rise.iter().map(|r| r.1).collect::<Vec<_>>(), [8, 10, 30]);
    near(mf_rise[0].0, 10_100);
    assert_eq!(mf_fall[0], mf_rise[0].0 + 1);
    near(mf_rise[1].0, mf_fall[0] + 2);
    assert_eq!(mf_fall[1], fin_at.expect("Fin") + 1, "strobes fall one call after Fin is seen");
    near(mf_rise[2].0, mf_fall[1] + 10_100);
    assert_eq!((rig.cnc(), rig.position()), (CncState::Ready, 200.0));
    assert_eq!(rig.state(), AxisState::Standstill);
}

/// S40 a: hold at 5.0 s, resume at 7.0 s.
#[test]
fn s40_a_hold_and_resume() {
    let (mut rig, _) = s39_rig();
    rig.fb("CNC_AuxHandshake");
    let (run, hold, resume, status) = (rig.start("s39"), rig.fb("CNC_Hold"), rig.fb("CNC_Resume"), rig.fb("CNC_ReadStatus"));
    rig.set(&status, "Enable", true);
    let all = [&run, &hold, &resume, &status];
    rig.run(&all, 5000);
    rig.set(&hold, "Execute", true);
    let cycles = rig.until(&all, &hold, "Done", 1000) as i64;
    assert!((cycles - 100).abs() <= 2, "Hold Done after {cycles}");
    assert!((rig.position() - 50.0).abs() < 0.05, "{}", rig.position());
    let rest = rig.position();
    assert!(rig.get(&run, "Busy") && !rig.get(&run, "Active"));
    assert_eq!(rig.cnc(), CncState::Held);
    rig.run(&all, 2000 - cycles as usize);
    assert_eq!(rig.position(), rest);
    let to_go = rig.machine.core().channels[0].executor().distance_to_go();
    assert!((to_go - (100.0 - rest)).abs() < 1e-9);
    rig.set(&resume, "Execute", true);
    let mut cycles = 0;
    while rig.cnc() != CncState::AuxWait {
        rig.run(&all, 1);
        cycles += 1;
        assert!(cycles < 20_000);
    }
    assert!((cycles - 5100i64).abs() <= 6, "block ends {cycles} after the resume");
}

/// S40 c: feed override 0.5 from the start takes 20.05 s.
#[test]
fn s40_c_override() {
    let (mut rig, _) = s39_rig();
    rig.fb("CNC_AuxHandshake");
    let over = rig.fb("CNC_SetOverride");
    rig.set(&over, "Enable", true);
    rig.lreal(&over, "Feed", 0.5);
    rig.call(&over);
    let run = rig.start("s39");
    let mut cycles = 0i64;
    while rig.cnc() != CncState::AuxWait {
        rig.run(&[&run], 1);
        cycles += 1;
        assert!(cycles < 40_000);
    }
    assert!((cycles - 20_050).abs() <= 6, "{cycles}");
    rig.lreal(&over, "Feed", 1.5);
    rig.call(&over);
    assert_eq!(rig.get_u16(&over, "ErrorID"), Code::ParameterOutOfRange.error_id());
}

/// S40 d: abort at 5.0 s.
#[test]
fn s40_d_abort() {
    let (mut rig, _) = s39_rig();
    let (run, abort) = (rig.start("s39"), rig.fb("CNC_Abort"));
    rig.run(&[&run, &abort], 5000);
    rig.set(&abort, "Execute", true);
    rig.until(&[&run, &abort], &abort, "Done", 200);
    rig.run(&[&run, &abort], 2);
    assert!(rig.get(&run, "CommandAborted"));
    assert!((rig.position() - 50.0).abs() < 0.05, "{}", rig.position());
    assert_eq!((rig.cnc(), rig.state()), (CncState::Ready, AxisState::Standstill));
    // And it runs again, from where it is.
    let again = rig.fb("CNC_Run");
    rig.set(&again, "Execute", true);
    rig.run(&[&again], 100);
    assert_eq!(rig.cnc(), CncState::Running);
    assert!(rig.position() > 50.0);
}

/// Single-axis moves are refused while the channel has the axis; MC_Stop stops the channel on its path.
#[test]
fn stop_of_an_axis_aborts_the_channel() {
    let (mut rig, _) = s39_rig();
    let (run, go, stop) = (rig.start("s39"), rig.fb("MC_MoveAbsolute"), rig.fb("MC_Stop"));
    rig.motion(&go, 0.0, 10.0, 10.0);
    rig.run(&[&run], 1000);
    rig.set(&go, "Execute", true);
    rig.set(&stop, "Execute", true);
    rig.run(&[&run, &go], 1);
    assert_eq!(rig.get_u16(&go, "ErrorID"), Code::AxisGrouped.error_id());
    rig.until(&[&run, &stop], &stop, "Done", 300);
    assert!(rig.get(&run, "CommandAborted") && rig.velocity() == 0.0 && rig.state() == AxisState::Stopping);
}

/// A program may be started in the scan that sees Status and Done; and again in the scan that sees the end of the last run.
#[test]
fn starts_as_soon_as_the_program_can_see_it() {
    let mut p = Program::default();
    p.feed(6000.0).line(1.0, 0.0).line(0.0, 0.0);
    let mut rig = Rig::new(&two_axes(false), programs(&[("short", p.end())]), Background::Inline);
    let power: Vec<_> = (1..=2).map(|i| rig.axis_fb("MC_Power", i)).collect();
    let (load, run) = (rig.fb("CNC_LoadProgram"), rig.fb("CNC_Run"));
    rig.text(&load, "FileName", "short");
    rig.set(&load, "Execute", true);
    power.iter().for_each(|fb| rig.set(fb, "Enable", true));
    let mut runs = 0;
    for _ in 0..1000 {
        power.iter().for_each(|fb| rig.call(fb));
        rig.call(&load);
        let go = power.iter().all(|fb| rig.get(fb, "Status")) && rig.get(&load, "Done") && !rig.get(&run, "Done");
        rig.set(&run, "Execute", go);
        rig.call(&run);
        assert!(!rig.get(&run, "Error"), "16#{:04X}", rig.get_u16(&run, "ErrorID"));
        runs += usize::from(rig.get(&run, "Done"));
        rig.tick();
    }
    assert!(runs >= 3, "{runs}");
}

/// Power lost in the middle of a program: the channel aborts on the path, then the axes are Disabled.
#[test]
fn power_off_during_a_program() {
    let (mut rig, power) = s39_rig();
    let run = rig.start("s39");
    rig.run(&[&power[0], &power[1], &run], 3000);
    rig.set(&power[0], "Enable", false);
    rig.run(&[&power[0], &power[1], &run], 300);
    assert!(rig.get(&run, "CommandAborted"));
    assert_eq!((rig.cnc(), rig.state()), (CncState::NotReady, AxisState::Disabled));
}

/// Power taken from the axis that stands while the other one brakes: it holds its place until the path stands.
#[test]
fn an_axis_at_rest_keeps_its_power_while_the_path_brakes() {
    let (mut rig, power) = s39_rig();
    let run = rig.start("s39");
    rig.run(&[&power[0], &power[1], &run], 3000);
    rig.set(&power[1], "Enable", false);
    rig.run(&[&power[0], &power[1], &run], 50);
    assert!(rig.velocity() > 0.0 && rig.machine.core().axes[1].has_power());
    rig.run(&[&power[0], &power[1], &run], 200);
    assert!(rig.velocity() == 0.0 && !rig.machine.core().axes[1].has_power());
    assert_eq!((rig.cnc(), rig.state()), (CncState::NotReady, AxisState::Standstill));
}

fn wrong_program() -> Vec<Step> {
    let mut p = Program::default();
    p.feed(6000.0).line(50.0, 0.0);
    p.line(20_000.0, 0.0);
    p.line(0.0, 0.0);
    p.end()
}

/// A wrong block: the motion before it ends normally, then cncFault with line; the axes stay there.
#[test]
fn wrong_block_stops_before_its_motion() {
    let mut rig = Rig::new(&two_axes(false), programs(&[("bad", wrong_program())]), Background::Inline);
    rig.power_on();
    let (run, error, reset) = (rig.start("bad"), rig.fb("CNC_ReadError"), rig.fb("CNC_Reset"));
    rig.set(&error, "Enable", true);
    rig.until(&[&run, &error], &run, "Error", 5000);
    assert_eq!((rig.cnc(), rig.position()), (CncState::Fault, 50.0));
    assert_eq!(rig.get_u16(&run, "ErrorID"), Code::ProgramError.error_id());
    rig.run(&[&error], 1);
    assert_eq!((rig.get_u32(&error, "Line"), rig.get_u16(&error, "ErrorCode")), (3, 0x0601));
    let report = rig.machine.report();
    let note = report.channels[0].error.as_ref().expect("an error");
    assert_eq!((note.code, note.line), (Code::OutsideLimits, 3));
    assert!(note.text.contains("20000"), "{}", note.text);
    rig.set(&reset, "Execute", true);
    rig.until(&[&reset], &reset, "Done", 10);
    rig.run(&[], 2);
    assert_eq!((rig.cnc(), rig.state()), (CncState::Ready, AxisState::Standstill));
}

/// CNC_LoadProgram: a missing file is F0602, a wrong program F0601 with its line; nothing runs without a program.
#[test]
fn loading() {
    let mut p = Program::default();
    p.line(1.0, 0.0);
    let mut rig = Rig::new(&two_axes(false), programs(&[("nofeed", p.end())]), Background::Inline);
    rig.power_on();
    assert_eq!(rig.cnc(), CncState::Idle);
    let run = rig.fb("CNC_Run");
    rig.set(&run, "Execute", true);
    rig.call(&run);
    assert_eq!(rig.get_u16(&run, "ErrorID"), Code::ProgramNotLoaded.error_id());
    for (name, code, line) in [("no-such", Code::ProgramFile, 0), ("nofeed", Code::ProgramError, 1)] {
        let load = rig.fb("CNC_LoadProgram");
        rig.text(&load, "FileName", name);
        rig.set(&load, "Execute", true);
        rig.until(&[&load], &load, "Error", 10);
        assert_eq!(rig.get_u16(&load, "ErrorID"), code.error_id());
        assert_eq!(rig.machine.report().channels[0].error.as_ref().map(|e| e.line), Some(line));
    }
    assert_eq!(rig.cnc(), CncState::Idle);
}

/// M0 stops until CNC_Resume; M1 only if the configuration says so; dwell keeps the axes still.
#[test]
fn program_stop_and_dwell() {
    let mut p = Program::default();
    p.feed(6000.0).line(10.0, 0.0);
    p.block(Canon::OptionalProgramStop);
    p.block(Canon::Dwell(0.5));
    p.block(Canon::ProgramStop);
    p.line(20.0, 0.0);
    let mut rig = Rig::new(&two_axes(false), programs(&[("stop", p.end())]), Background::Inline);
    rig.power_on();
    let (run, resume) = (rig.start("stop"), rig.fb("CNC_Resume"));
    let mut cycles = 0i64;
    while rig.cnc() != CncState::ProgStop {
        rig.run(&[&run], 1);
        cycles += 1;
        assert!(cycles < 2000);
    }
    assert_eq!(rig.position(), 10.0);
    assert!((cycles - (100 + 2 + 500)).abs() <= 5, "{cycles}");
    rig.set(&resume, "Execute", true);
    rig.until(&[&resume, &run], &run, "Done", 1000);
    assert_eq!(rig.position(), 20.0);
    assert_eq!(rig.machine.report().channels[0].blocks, 5 + 1);
}

/// CNC_AuxHandshake.Fault stops the channel at once; CNC_ReadError shows FaultID.
#[test]
fn aux_fault() {
    let (mut rig, _) = s39_rig();
    let (aux, run, error) = (rig.fb("CNC_AuxHandshake"), rig.start("s39"), rig.fb("CNC_ReadError"));
    rig.set(&aux, "Enable", true);
    rig.set(&error, "Enable", true);
    while rig.cnc() != CncState::AuxWait {
        rig.run(&[&aux, &run], 1);
    }
    rig.set(&aux, "Fault", true);
    rig.int(&aux, "FaultID", 0x1234);
    rig.until(&[&aux, &run], &run, "Error", 10);
    rig.run(&[&error, &aux], 1);
    assert_eq!((rig.get_u16(&run, "ErrorID"), rig.get_u16(&error, "ErrorCode")), (Code::AuxFault.error_id(), 0x1234));
    assert!(!rig.get(&aux, "Mf") && rig.cnc() == CncState::Fault);
}

/// A program without CNC_AuxHandshake has nobody to wait for: codes are noted.
#[test]
fn nobody_listens() {
    let (mut rig, _) = s39_rig();
    let run = rig.start("s39");
    let cycles = rig.until(&[&run], &run, "Done", 30_000) as i64;
    assert!((cycles - 20_200).abs() <= 8, "{cycles}");
    assert_eq!(rig.position(), 200.0);
}

/// A code that is not finished in time stops the channel.
#[test]
fn aux_timeout() {
    let mut config = s39_machine();
    config.channels[0].aux_timeout_s = 0.1;
    let mut rig = Rig::new(&config, programs(&[("s39", s39())]), Background::Inline);
    rig.power_on();
    let (aux, run) = (rig.fb("CNC_AuxHandshake"), rig.start("s39"));
    rig.set(&aux, "Enable", true);
    rig.until(&[&aux, &run], &run, "Error", 12_000);
    assert_eq!(rig.get_u16(&run, "ErrorID"), Code::AuxTimeout.error_id());
    assert_eq!((rig.cnc(), rig.position()), (CncState::Fault, 100.0));
}

fn plate_machine() -> MachineConfig {
    let axis = |name: &str| AxisConfig { v_max_mm_s: 1200.0, a_max_mm_s2: 20_000.0, ..AxisConfig::named(name) };
    let channel = ChannelConfig { axes: vec!["X".into(), "Y".into()], ..ChannelConfig::default() };
    MachineConfig { axes: vec![axis("X"), axis("Y")], channels: vec![channel], ..MachineConfig::default() }
}

/// PC-T8: the plate with plant, encoder and PID: close to the path, end exact, longer than the ideal time.
#[test]
fn pc_t8_plate_on_drives() {
    let mut rig = Rig::new(&plate_machine(), programs(&[("plate", plate(0.0, 0.0))]), Background::Inline);
    rig.power_on();
    let run = rig.start("plate");
    let cycles = rig.until(&[&run], &run, "Done", 10_000);
    rig.run(&[&run], 50);
    let report = rig.machine.report();
    println!("plate: {cycles} ms, deviation {:.4} mm", report.path_deviation_max_mm);
    assert!(cycles > 1359, "{cycles}");
    assert!(report.path_deviation_max_mm < 0.1, "{}", report.path_deviation_max_mm);
    assert!(report.path_deviation_max_mm > 1e-4, "a real plant deviates");
    assert_eq!((report.axes[0].set_mm, report.axes[1].set_mm), (20.0, 30.0));
    assert!((report.axes[0].actual_mm - 20.0).abs() < 0.002 && (report.axes[1].actual_mm - 30.0).abs() < 0.002);
    assert_eq!(report.channels[0].blocks, 28, "the feed is a block of its own in this test");
    assert!((report.channels[0].feed_mm - 1358.726).abs() < 1e-3);
}

/// Pause after a tick in which a background thread can work.
type Pause = Option<Duration>;

/// Set points of a run, and the ticks in which it was late. With a pause the background is a thread of its own.
fn set_points(pause: Pause, program: Vec<Step>) -> (Vec<[u64; 2]>, u32) {
    let config = plate_machine();
    let files = Box::new(|name: &str| Ok(name.to_owned()));
    let list = programs(&[("p", program)]);
    let mut rig = Rig::new(&config, Programs::new(), Background::Manual);
    let background = if pause.is_some() { Background::Thread } else { Background::Inline };
    rig.machine = Machine::with_reader(&config, files, reader(list), background);
    rig.power_on();
    let load = rig.fb("CNC_LoadProgram");
    rig.text(&load, "FileName", "p");
    rig.set(&load, "Execute", true);
    wait(&mut rig, &load, pause);
    let run = rig.fb("CNC_Run");
    rig.set(&run, "Execute", true);
    wait(&mut rig, &run, pause);
    let mut points: Vec<_> = rig.machine.trace().rows().map(|r| [r.values[0].to_bits(), r.values[2].to_bits()]).collect();
    // How long the first and the last position stay depends on who waited for whom.
    points.dedup();
    (points, rig.machine.report().channels[0].late_ticks)
}

fn wait(rig: &mut Rig, fb: &Fb, pause: Pause) {
    for _ in 0..1_000_000 {
        rig.call(fb);
        if rig.get(fb, "Done") {
            return;
        }
        rig.tick();
        pause.into_iter().for_each(std::thread::sleep);
    }
    panic!("not done: {:?}", rig.machine.report());
}

/// Set points of a run whose thread kept up. Ticks come far faster than once a millisecond, so on a busy computer it may need longer
/// pauses: a path whose background falls behind brakes, as it must.
fn threaded(program: &[Step]) -> Vec<[u64; 2]> {
    for k in 0..10 {
        let (points, late) = set_points(Some(Duration::from_micros(20 << k)), program.to_vec());
        if late == 0 {
            return points;
        }
    }
    panic!("the background never kept up");
}

/// Real time and virtual time give the same set points, bit for bit; so do two runs.
#[test]
fn thread_and_inline_give_the_same_set_points() {
    let mut p = Program::default();
    p.feed(30_000.0);
    for k in 0..3000 {
        p.line(f64::from(k) * 0.05, 10.0 * libm::sin(f64::from(k) * 0.002));
    }
    for program in [plate(0.0, 0.0), p.end()] {
        let (inline, late) = set_points(None, program.clone());
        assert_eq!(late, 0);
        assert!(inline.len() > 300);
        assert_eq!(inline, set_points(None, program.clone()).0);
        assert_eq!(inline, threaded(&program));
    }
}

/// The period is that of the configuration; without axes there is nothing to tick.
#[test]
fn period() {
    let rig = Rig::new(&two_axes(false), Programs::new(), Background::Inline);
    assert_eq!(rig.machine.period(), Some(Nanos::from_millis(1)));
    let none = Rig::new(&MachineConfig::default(), Programs::new(), Background::Inline);
    assert_eq!(none.machine.period(), None);
    assert_eq!(ideal("Y").letter, 'Y');
}
