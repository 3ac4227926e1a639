//! Acceptance scenarios of the single-axis blocks: S01, S06, S07, S11 and the rules behind them.

mod common;
use common::rig::{Programs, Rig, one_axis};
use takt_base::Code;
use takt_motion::Background;
use takt_motion::axis::AxisState;

fn powered() -> Rig {
    let mut rig = Rig::new(&one_axis(), Programs::new(), Background::Inline);
    rig.power_on();
    rig
}

/// S01 a: a second move takes over; the first shows CommandAborted until its Execute falls.
#[test]
fn s01_a_abort() {
    let mut rig = powered();
    let (a, b) = (rig.fb("MC_MoveAbsolute"), rig.fb("MC_MoveAbsolute"));
    rig.motion(&a, 1000.0, 100.0, 100.0);
    rig.motion(&b, 0.0, 100.0, 100.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&a, &b], 5000);
    assert!(rig.get(&a, "Busy") && rig.get(&a, "Active") && rig.state() == AxisState::DiscreteMotion);
    rig.set(&b, "Execute", true);
    rig.run(&[&a, &b], 1);
    assert!(rig.get(&b, "Busy") && rig.get(&b, "Active"));
    rig.run(&[&a, &b], 1999);
    assert!(rig.get(&a, "CommandAborted") && !rig.get(&a, "Busy") && !rig.get(&a, "Active") && !rig.get(&a, "Done"));
    rig.set(&a, "Execute", false);
    rig.run(&[&a, &b], 1);
    assert!(!["Busy", "Active", "Done", "CommandAborted", "Error"].iter().any(|p| rig.get(&a, p)));
    rig.until(&[&a, &b], &b, "Done", 10_000);
    assert_eq!(rig.position(), 0.0);
}

/// S01 b: a drive fault instead.
#[test]
fn s01_b_drive_fault() {
    let mut rig = powered();
    let (a, error) = (rig.fb("MC_MoveAbsolute"), rig.fb("MC_ReadAxisError"));
    rig.set(&error, "Enable", true);
    rig.motion(&a, 1000.0, 100.0, 100.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&a, &error], 5000);
    rig.machine.core_mut().axes[0].set_drive_fault(true);
    rig.run(&[&a, &error], 2);
    assert!(rig.get(&a, "Error") && !rig.get(&a, "Busy") && !rig.get(&a, "Active") && !rig.get(&a, "CommandAborted"));
    assert_eq!((rig.get_u16(&a, "ErrorID"), rig.get_u16(&error, "AxisErrorID")), (0x0201, 0x0201));
    assert_eq!(rig.state(), AxisState::ErrorStop);
    // The fault is still there: MC_Reset fails; later it works.
    let reset = rig.fb("MC_Reset");
    rig.set(&reset, "Execute", true);
    rig.run(&[&reset], 1);
    assert!(rig.get(&reset, "Error"));
    rig.machine.core_mut().axes[0].set_drive_fault(false);
    rig.set(&reset, "Execute", false);
    rig.run(&[&reset], 100);
    rig.set(&reset, "Execute", true);
    rig.run(&[&reset], 2);
    assert!(rig.get(&reset, "Done"));
    assert_eq!(rig.state(), AxisState::Standstill);
    assert!(rig.get(&a, "Error"), "reset does not clear the outputs of others");
}

/// S06: R1, R6: re-triggered with another target; the earlier command gives no feedback.
#[test]
fn s06_retrigger() {
    let mut rig = powered();
    let a = rig.fb("MC_MoveAbsolute");
    rig.motion(&a, 1000.0, 100.0, 100.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&a], 2000);
    rig.set(&a, "Execute", false);
    for _ in 0..1000 {
        rig.run(&[&a], 1);
        assert!(rig.get(&a, "Busy"));
    }
    assert!((rig.position() - 250.0).abs() < 0.2);
    rig.motion(&a, 500.0, 100.0, 100.0);
    rig.set(&a, "Execute", true);
    let cycles = rig.until(&[&a], &a, "Done", 10_000);
    assert!((cycles as i64 - 3000).abs() <= 2, "{cycles}");
    assert_eq!(rig.position(), 500.0);
    rig.run(&[&a], 500);
    assert!(rig.get(&a, "Done") && rig.position() == 500.0, "nothing restarts");
}

/// R5: Execute shorter than the motion: Done for exactly one call.
#[test]
fn r5_done_for_one_call() {
    let mut rig = powered();
    let a = rig.fb("MC_MoveRelative");
    rig.motion(&a, 10.0, 100.0, 1000.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&a], 1);
    rig.set(&a, "Execute", false);
    let mut shown = 0;
    for _ in 0..400 {
        rig.run(&[&a], 1);
        shown += usize::from(rig.get(&a, "Done"));
    }
    assert_eq!((shown, rig.position()), (1, 10.0));
}

/// S07 a: power comes after 50 ms; a command before it is refused.
#[test]
fn s07_a_power_on() {
    let mut rig = Rig::new(&one_axis(), Programs::new(), Background::Inline);
    let (power, a) = (rig.fb("MC_Power"), rig.fb("MC_MoveAbsolute"));
    rig.motion(&a, 10.0, 100.0, 1000.0);
    rig.set(&power, "Enable", true);
    rig.run(&[&power, &a], 20);
    rig.set(&a, "Execute", true);
    rig.run(&[&power, &a], 1);
    assert!(rig.get(&a, "Error") && rig.get_u16(&a, "ErrorID") == Code::NotPowered.error_id());
    assert_eq!(rig.state(), AxisState::Disabled);
    rig.set(&a, "Execute", false);
    let cycles = 21 + rig.until(&[&power, &a], &power, "Status", 100);
    assert!((cycles as i64 - 50).abs() <= 2, "{cycles}");
    assert_eq!(rig.state(), AxisState::Standstill);
    rig.set(&a, "Execute", true);
    rig.until(&[&power, &a], &a, "Done", 1000);
}

/// S07 b: Enable falls while the axis moves: aborted, braked, Disabled, no error anywhere.
#[test]
fn s07_b_power_off() {
    let mut config = one_axis();
    config.axes[0].a_max_mm_s2 = 1000.0;
    let mut rig = Rig::new(&config, Programs::new(), Background::Inline);
    let power = rig.power_on().remove(0);
    let a = rig.fb("MC_MoveAbsolute");
    rig.motion(&a, 1000.0, 100.0, 100.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&power, &a], 3000);
    assert!((rig.velocity() - 100.0).abs() < 1e-9);
    rig.set(&power, "Enable", false);
    rig.run(&[&power, &a], 1);
    assert!(rig.get(&a, "CommandAborted"));
    let from = rig.position();
    rig.run(&[&power, &a], 200);
    assert_eq!((rig.state(), rig.velocity()), (AxisState::Disabled, 0.0));
    assert!((rig.position() - from - 5.0).abs() < 0.2, "braked with 1000 mm/s2: {}", rig.position() - from);
    assert!(!rig.get(&power, "Status") && !rig.get(&power, "Error") && !rig.get(&a, "Error"));
}

/// S11: MC_Stop; Stopping lasts as long as Execute or the motion.
#[test]
fn s11_stop() {
    for (held, stopping_until) in [(3000, 3000), (1000, 2000)] {
        let mut rig = powered();
        let (a, stop, late) = (rig.fb("MC_MoveAbsolute"), rig.fb("MC_Stop"), rig.fb("MC_MoveAbsolute"));
        rig.motion(&a, 5000.0, 100.0, 1000.0);
        rig.motion(&late, 0.0, 100.0, 1000.0);
        rig.set(&a, "Execute", true);
        rig.run(&[&a], 500);
        rig.lreal(&stop, "Deceleration", 50.0);
        rig.set(&stop, "Execute", true);
        let (mut done_from, mut done_calls, mut standstill) = (None, 0, None);
        for t in 0..4000 {
            if t == held {
                rig.set(&stop, "Execute", false);
            }
            rig.call(&a);
            rig.call(&stop);
            if rig.get(&stop, "Done") {
                done_from = done_from.or(Some(t));
                done_calls += 1;
            }
            if t == 500 {
                rig.set(&late, "Execute", true);
                rig.call(&late);
                assert_eq!(rig.get_u16(&late, "ErrorID"), Code::WrongState.error_id());
                assert!(rig.get(&a, "CommandAborted"));
            }
            if rig.state() == AxisState::Standstill {
                standstill = standstill.or(Some(t));
            }
            rig.tick();
        }
        assert!((done_from.expect("Done") as i64 - 2000).abs() <= 2);
        assert!((standstill.expect("Standstill") as i64 - i64::from(stopping_until)).abs() <= 2, "{held}: {standstill:?}");
        if held > 2000 {
            assert!((done_calls as i64 - 1000).abs() <= 2, "{done_calls}");
        } else {
            assert_eq!(done_calls, 1);
        }
    }
}

/// MC_Halt goes through DiscreteMotion; MC_Home renumbers; MC_ReadStatus shows exactly one state.
#[test]
fn halt_home_and_status() {
    let mut rig = powered();
    let (a, halt, home) = (rig.fb("MC_MoveAbsolute"), rig.fb("MC_Halt"), rig.fb("MC_Home"));
    let (status, actual) = (rig.fb("MC_ReadStatus"), rig.fb("MC_ReadActualPosition"));
    rig.set(&status, "Enable", true);
    rig.set(&actual, "Enable", true);
    rig.motion(&a, 1000.0, 100.0, 1000.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&a, &status], 500);
    rig.set(&halt, "Execute", true);
    rig.lreal(&halt, "Deceleration", 100.0);
    rig.run(&[&a, &halt, &status], 500);
    assert!(rig.get(&status, "DiscreteMotion") && rig.get(&a, "CommandAborted"));
    rig.until(&[&a, &halt], &halt, "Done", 1000);
    rig.lreal(&home, "Position", -7.5);
    rig.set(&home, "Execute", true);
    rig.until(&[&home], &home, "Done", 10);
    rig.run(&[&status, &actual], 10);
    assert!((rig.get_lreal(&actual, "Position") + 7.5).abs() < 1e-6);
    let states = ["ErrorStop", "Disabled", "Stopping", "Homing", "Standstill", "DiscreteMotion", "ContinuousMotion"];
    assert_eq!(states.iter().filter(|p| rig.get(&status, p)).collect::<Vec<_>>(), [&"Standstill"]);
    assert!(rig.machine.core().axes[0].is_homed());
}

/// §2.4: wrong parameters are errors of the block; the axis stays where it is.
#[test]
fn parameters_are_checked() {
    let mut rig = powered();
    let id = |rig: &mut Rig, target, v, a: f64| {
        let fb = rig.fb("MC_MoveAbsolute");
        rig.motion(&fb, target, v, a);
        rig.set(&fb, "Execute", true);
        rig.run(&[&fb], 3);
        (rig.get_u16(&fb, "ErrorID"), rig.state())
    };
    let refused = |code: Code| (code.error_id(), AxisState::Standstill);
    assert_eq!(id(&mut rig, 20_000.0, 10.0, 10.0), refused(Code::LimitExceeded));
    assert_eq!(id(&mut rig, f64::NAN, 10.0, 10.0), refused(Code::ParameterOutOfRange));
    assert_eq!(id(&mut rig, 1.0, 0.0, 10.0), refused(Code::ParameterOutOfRange));
    assert_eq!(id(&mut rig, 1.0, 10.0, -1.0), refused(Code::ParameterOutOfRange));
    let buffered = rig.fb("MC_MoveAbsolute");
    rig.motion(&buffered, 1.0, 1.0, 1.0);
    rig.int(&buffered, "BufferMode", 2);
    rig.set(&buffered, "Execute", true);
    rig.run(&[&buffered], 1);
    assert_eq!(rig.get_u16(&buffered, "ErrorID"), Code::UnsupportedOption.error_id());
    let nowhere = rig.fb("MC_MoveAbsolute");
    rig.refer(&nowhere, 0);
    rig.set(&nowhere, "Execute", true);
    rig.run(&[&nowhere], 1);
    assert_eq!(rig.get_u16(&nowhere, "ErrorID"), Code::UnknownReference.error_id());
}

/// MC_Power.EnablePositive: the direction is taken away while the axis moves that way: error of the block, no ErrorStop.
#[test]
fn direction_is_blocked() {
    let mut rig = Rig::new(&one_axis(), Programs::new(), Background::Inline);
    let power = rig.power_on().remove(0);
    let a = rig.fb("MC_MoveAbsolute");
    rig.motion(&a, 1000.0, 100.0, 100.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&power, &a], 1000);
    rig.set(&power, "EnablePositive", false);
    rig.run(&[&power, &a], 10);
    assert_eq!(rig.get_u16(&a, "ErrorID"), Code::DirectionBlocked.error_id());
    rig.run(&[&power, &a], 100);
    assert_eq!((rig.state(), rig.velocity()), (AxisState::Standstill, 0.0));
}

/// R1-183: an axis that can't follow stops with F0200.
#[test]
fn following_error_stops_the_axis() {
    let mut config = one_axis();
    config.axes[0].following_error_max_mm = 1.0;
    let mut rig = Rig::new(&config, Programs::new(), Background::Inline);
    rig.power_on();
    rig.machine.core_mut().axes[0].disturb(3.0);
    rig.run(&[], 2);
    assert_eq!(rig.machine.core().axes[0].error(), Some(Code::FollowingError));
    assert_eq!(rig.state(), AxisState::ErrorStop);
}

/// A second MC_Power of the same axis is an error.
#[test]
fn one_power_block_per_axis() {
    let mut rig = powered();
    let second = rig.fb("MC_Power");
    rig.run(&[&second], 1);
    assert!(rig.get(&second, "Error") && rig.state() == AxisState::Standstill);
}

/// safe_stop brings a moving axis to rest and takes the power away, whatever the program still asks for.
#[test]
fn safe_stop() {
    use takt_image::Cyclic;
    let mut rig = Rig::new(&one_axis(), Programs::new(), Background::Inline);
    let power = rig.power_on().remove(0);
    let a = rig.fb("MC_MoveAbsolute");
    rig.motion(&a, 1000.0, 100.0, 100.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&power, &a], 1000);
    rig.machine.safe_stop();
    rig.run(&[&power, &a], 300);
    assert_eq!((rig.state(), rig.velocity()), (AxisState::Disabled, 0.0));
    assert!(!rig.machine.core().axes[0].has_power());
}

/// S03, R10: endless motion; another one takes over; a short Execute changes nothing.
#[test]
fn s03_move_velocity() {
    let mut rig = powered();
    let (a, b) = (rig.fb("MC_MoveVelocity"), rig.fb("MC_MoveVelocity"));
    for (fb, v) in [(&a, 50.0), (&b, 20.0)] {
        rig.lreal(fb, "Velocity", v);
        rig.lreal(fb, "Acceleration", 10.0);
        rig.lreal(fb, "Deceleration", 10.0);
        rig.int(fb, "Direction", 1);
    }
    rig.set(&a, "Execute", true);
    let cycles = rig.until(&[&a, &b], &a, "InVelocity", 6000) as i64;
    assert!((cycles - 5000).abs() <= 2, "{cycles}");
    rig.set(&a, "Execute", false);
    rig.run(&[&a, &b], 3000);
    assert!(rig.get(&a, "Busy") && rig.get(&a, "Active") && rig.get(&a, "InVelocity") && rig.velocity() == 50.0);
    assert_eq!(rig.state(), AxisState::ContinuousMotion);
    rig.set(&a, "Execute", true);
    rig.lreal(&a, "Velocity", -50.0);
    rig.run(&[&a, &b], 9998);
    assert!(!rig.get(&a, "InVelocity"));
    rig.until(&[&a, &b], &a, "InVelocity", 10);
    assert_eq!(rig.velocity(), -50.0);
    rig.set(&b, "Execute", true);
    rig.run(&[&b, &a], 1);
    assert!(rig.get(&a, "CommandAborted") && !["Busy", "Active", "InVelocity"].iter().any(|p| rig.get(&a, p)));
    rig.until(&[&a, &b], &b, "InVelocity", 8000);
    assert_eq!((rig.velocity(), rig.state()), (20.0, AxisState::ContinuousMotion));
}

/// S13: MC_Halt ends an endless motion through DiscreteMotion.
#[test]
fn s13_halt() {
    let mut rig = powered();
    let (a, halt) = (rig.fb("MC_MoveVelocity"), rig.fb("MC_Halt"));
    rig.int(&a, "Direction", 1);
    rig.lreal(&a, "Velocity", 50.0);
    rig.lreal(&a, "Acceleration", 10.0);
    rig.lreal(&halt, "Deceleration", 5.0);
    rig.set(&a, "Execute", true);
    rig.run(&[&a, &halt], 7000);
    rig.set(&halt, "Execute", true);
    rig.run(&[&a, &halt], 2);
    assert!(rig.get(&a, "CommandAborted") && rig.state() == AxisState::DiscreteMotion);
    let cycles = rig.until(&[&a, &halt], &halt, "Done", 11_000) as i64 + 2;
    assert!((cycles - 10_000).abs() <= 2, "{cycles}");
    assert_eq!(rig.state(), AxisState::Standstill);
}

/// An endless motion stops in front of the software limit.
#[test]
fn endless_motion_keeps_the_travel() {
    let mut config = one_axis();
    (config.axes[0].travel_max_mm, config.axes[0].a_max_mm_s2) = (100.0, 1000.0);
    let mut rig = Rig::new(&config, Programs::new(), Background::Inline);
    rig.power_on();
    let a = rig.fb("MC_MoveVelocity");
    rig.int(&a, "Direction", 1);
    rig.lreal(&a, "Velocity", 200.0);
    rig.set(&a, "Execute", true);
    rig.until(&[&a], &a, "Error", 2000);
    rig.run(&[&a], 500);
    assert_eq!((rig.get_u16(&a, "ErrorID"), rig.state()), (Code::LimitExceeded.error_id(), AxisState::ErrorStop));
    assert!(rig.position() <= 100.0 && rig.position() > 99.0, "{}", rig.position());
}

/// S02, S24: a buffered move waits for Done of the one before; both show Done for one call.
#[test]
fn s02_buffered() {
    let mut rig = powered();
    let (a, b) = (rig.fb("MC_MoveAbsolute"), rig.fb("MC_MoveAbsolute"));
    rig.motion(&a, 1000.0, 100.0, 100.0);
    rig.motion(&b, 1200.0, 50.0, 100.0);
    rig.int(&b, "BufferMode", 1);
    rig.set(&a, "Execute", true);
    let (mut done_a, mut done_b, mut active_b) = (Vec::new(), Vec::new(), None);
    for t in 0..16_000i64 {
        match t {
            1 => rig.set(&a, "Execute", false),
            2000 => rig.set(&b, "Execute", true),
            3000 => rig.set(&b, "Execute", false),
            _ => {}
        }
        rig.call(&a);
        rig.call(&b);
        assert!(!rig.get(&a, "CommandAborted") && !rig.get(&b, "CommandAborted"));
        if rig.get(&a, "Done") {
            done_a.push(t);
        }
        if rig.get(&b, "Done") {
            done_b.push(t);
        }
        if rig.get(&b, "Active") {
            active_b = active_b.or(Some(t));
        }
        assert!(!(2000..=15_400).contains(&t) || rig.get(&b, "Busy"));
        rig.tick();
    }
    let near = |got: i64, want: i64| assert!((got - want).abs() <= 2, "{got} is not {want}");
    assert_eq!((done_a.len(), done_b.len()), (1, 1));
    near(done_a[0], 11_000);
    assert_eq!(active_b, Some(done_a[0]));
    near(done_b[0], 15_500);
    assert_eq!((rig.position(), rig.state()), (1200.0, AxisState::Standstill));
}

/// §2.5, S09: an aborting command clears the queue; an axis error shows on the running and on the waiting blocks.
#[test]
fn queue_is_cleared() {
    for fault in [false, true] {
        let mut rig = powered();
        let fbs: Vec<_> = (0..3).map(|_| rig.fb("MC_MoveAbsolute")).collect();
        for (fb, target) in fbs.iter().zip([1000.0, 2000.0, 0.0]) {
            rig.motion(fb, target, 100.0, 100.0);
        }
        rig.int(&fbs[1], "BufferMode", 1);
        rig.set(&fbs[0], "Execute", true);
        rig.set(&fbs[1], "Execute", true);
        let all: Vec<_> = fbs.iter().collect();
        rig.run(&all, 4000);
        assert!(rig.get(&fbs[1], "Busy") && !rig.get(&fbs[1], "Active"));
        if fault {
            rig.machine.core_mut().axes[0].set_drive_fault(true);
        } else {
            rig.set(&fbs[2], "Execute", true);
        }
        rig.run(&all, 2);
        let pin = if fault { "Error" } else { "CommandAborted" };
        assert!(rig.get(&fbs[0], pin) && rig.get(&fbs[1], pin), "{pin}");
        assert_eq!(rig.get(&fbs[2], "Active"), !fault);
    }
}

/// §2.5: 32 commands may wait; one more is refused and disturbs nothing. Each starts where the one before ended.
#[test]
fn queue_depth() {
    let mut rig = powered();
    let fbs: Vec<_> = (0..34).map(|_| rig.fb("MC_MoveRelative")).collect();
    for fb in &fbs {
        rig.motion(fb, 1.0, 100.0, 1000.0);
        rig.int(fb, "BufferMode", 1);
        rig.set(fb, "Execute", true);
        rig.call(fb);
    }
    assert_eq!(rig.get_u16(&fbs[33], "ErrorID"), Code::QueueFull.error_id());
    let all: Vec<_> = fbs[..33].iter().collect();
    rig.run(&all, 5000);
    assert!(fbs[..33].iter().all(|fb| rig.get(fb, "Done")));
    assert_eq!(rig.position(), 33.0);
}
