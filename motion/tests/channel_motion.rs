//! Motion that needs more than a path: probing, splines, feed a revolution, surface speed, threads, rigid tapping, adaptive feed.

mod common;
use common::rig::{Fb, Rig};
use common::shop::{V, running};
use takt_base::Code;
use takt_motion::channel::CncState;
use takt_motion::machine::ChannelConfig;

fn plain() -> ChannelConfig {
    ChannelConfig::default()
}

fn io(rig: &mut Rig) -> Fb {
    let io = rig.fb("CNC_Io");
    rig.set(&io, "Enable", true);
    rig.call(&io);
    io
}

/// Runs with a probe that touches at Z = -`depth`.
fn probing(text: &str, depth: f64) -> (Rig, Fb, bool) {
    let (mut rig, run) = running(plain(), text);
    let io = io(&mut rig);
    for _ in 0..20_000 {
        rig.call(&run);
        rig.set(&io, "Probe", rig.axis(2) <= -depth + 1e-9);
        rig.call(&io);
        if rig.get(&run, "Done") || rig.get(&run, "Error") {
            break;
        }
        rig.tick();
    }
    let done = rig.get(&run, "Done");
    (rig, run, done)
}

/// G38.2 and G38.4: the tripped position, with offsets and in inches; the path goes on from where it stands.
#[test]
fn probing_finds_the_edge() {
    let text = "G10 L2 P1 Z-1\nG21 F600\nG0 Z1\nG38.2 Z-20\n#<_plc_v0> = #5063\n#<_plc_v1> = #5070\n#<_plc_v2> = #<_z>\n\
        G38.4 Z5\n#<_plc_v3> = #5063\nG20\nG38.2 Z-1 F20\n#<_plc_v4> = #5063\nG1 Z0\nM2\n";
    let (rig, _, done) = probing(text, 6.0);
    assert!(done, "{:?}", rig.error());
    let v: Vec<f64> = (0..5).map(|i| rig.real(V + 8 * i)).collect();
    // 10 mm/s: the edge is seen within one period; the axis follows its set point by one more.
    assert!((v[0] + 5.0).abs() < 0.03, "{v:?}");
    assert_eq!(v[1], 1.0);
    // Braking from 10 mm/s with 50000 mm/s2 takes a thousandth of a millimetre.
    assert!(v[2] < v[0] && v[2] > v[0] - 0.05, "{v:?}");
    assert!((v[3] + 5.0).abs() < 0.03, "{v:?}");
    assert!((v[4] + 5.0 / 25.4).abs() < 0.03 / 25.4, "{v:?}");
    assert!(rig.machine.report().path_deviation_max_mm < 0.05);
    assert_eq!(rig.axis(2), -1.0);
}

/// N0075, N0076; G38.3 and G38.5 give #5070 = 0 instead.
#[test]
fn probing_that_finds_nothing() {
    let (rig, run, done) = probing("F6000\nG38.2 Z-5\nM2\n", 50.0);
    assert!(!done && rig.get_u16(&run, "ErrorID") == Code::ProgramError.error_id());
    assert_eq!(rig.error().map(|e| e.0), Some(Code::ProbeMissed));
    assert_eq!(rig.axis(2), -5.0);
    let (rig, _, done) = probing("F6000\nG38.3 Z-5\n#<_plc_v0> = [#5070 + 2]\n#<_plc_v1> = #5063\nG1 Z0\nM2\n", 50.0);
    assert!(done, "{:?}", rig.error());
    assert_eq!([rig.real(V), rig.real(V + 8), rig.axis(2)], [2.0, -5.0, 0.0]);
    for text in ["F6000\nG1 Z-5\nG38.2 Z-9\nM2\n", "F6000\nG38.4 Z5\nM2\n"] {
        let (rig, _, done) = probing(text, 3.0);
        assert_eq!((done, rig.error().map(|e| e.0)), (false, Some(Code::ProbeNotReady)), "{text}");
        assert!(rig.velocity() == 0.0 && [-5.0, 0.0].contains(&rig.axis(2)), "{}", rig.axis(2));
    }
}

/// CNC_ReadProbe shows the machine position; a hold waits for the end of the probing (N4), an abort does not.
#[test]
fn probe_block_and_hold() {
    let (mut rig, run) = running(plain(), "F600\nG38.2 Z-10\nG1 Z0\nM2\n");
    let (io, hold, read) = (io(&mut rig), rig.fb("CNC_Hold"), rig.fb("CNC_ReadProbe"));
    rig.set(&read, "Enable", true);
    rig.run(&[&run, &io], 300);
    rig.set(&hold, "Execute", true);
    rig.run(&[&run, &io, &hold], 300);
    assert!(rig.axis(2) < -5.0 && rig.cnc() == CncState::Holding);
    rig.set(&io, "Probe", true);
    rig.run(&[&run, &io, &hold, &read], 10);
    assert!(rig.get(&hold, "Done") && rig.cnc() == CncState::Held);
    assert!(rig.get(&read, "Tripped") && rig.get_u32(&read, "Seq") == 1);
    assert!((rig.get_lreal_at(&read, "Result", 2) - rig.axis(2)).abs() < 0.05);
    let (mut rig, run) = running(plain(), "F600\nG38.2 Z-10\nM2\n");
    let abort = rig.fb("CNC_Abort");
    rig.run(&[&run], 300);
    rig.set(&abort, "Execute", true);
    rig.until(&[&run, &abort], &abort, "Done", 10);
    assert!(rig.axis(2) > -5.0);
}

/// Runs to the end and records the set points.
fn track(rig: &mut Rig, run: &Fb, also: &[&Fb]) -> Vec<[f64; 3]> {
    let mut points = Vec::new();
    for _ in 0..60_000 {
        rig.call(run);
        also.iter().for_each(|fb| rig.call(fb));
        points.push([rig.axis(0), rig.axis(1), rig.axis(2)]);
        if rig.get(run, "Done") || rig.get(run, "Error") {
            break;
        }
        rig.tick();
    }
    assert!(rig.get(run, "Done"), "{:?} {:?} {:?}", rig.error(), points.last(), rig.machine.report().channels);
    points
}

/// A quarter circle as a NURBS with weights: every set point is on the circle to within the tolerance; the feed is kept.
#[test]
fn nurbs_is_a_circle() {
    let text = "G17 F6000\nG1 X10\nG5.2 X10 Y10 P0.7071067811865476 L3\nX0 Y10 P1\nG5.3\nM2\n";
    let (mut rig, run) = running(plain(), text);
    let points = track(&mut rig, &run, &[]);
    let round: Vec<_> = points.iter().filter(|p| p[1] > 0.0 && p[1] < 10.0).collect();
    assert!(round.len() > 100, "{}", round.len());
    for p in &round {
        assert!((libm::hypot(p[0], p[1]) - 10.0).abs() < 0.0011, "{p:?}");
    }
    let fastest = round.windows(2).map(|w| libm::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1])).fold(0.0, f64::max);
    assert!(fastest > 0.09 && fastest < 0.1 + 1e-6, "{fastest}");
    assert_eq!([rig.axis(0), rig.axis(1)], [0.0, 10.0]);
}

/// G5 of LinuxCNC's manual: a cubic from (0, 0) to (1, 1) and back; the curve passes where Bezier's formula says.
#[test]
fn cubic_spline() {
    let (mut rig, run) = running(plain(), "F600\nG90 G17\nG0 X0 Y0\nG5 I0 J3 P0 Q-3 X1 Y1\nM2\n");
    let points = track(&mut rig, &run, &[]);
    // Control points (0,0), (0,3), (1,-2), (1,1).
    let curve = |t: f64| {
        let u = 1.0 - t;
        [3.0 * u * t * t + t * t * t, 9.0 * u * u * t - 6.0 * u * t * t + t * t * t]
    };
    for p in points {
        let near = (0..=2000).map(|k| curve(f64::from(k) / 2000.0)).map(|c| libm::hypot(c[0] - p[0], c[1] - p[1]));
        assert!(near.fold(f64::INFINITY, f64::min) < 0.003, "{p:?}");
    }
}

/// Largest speed along X in mm/s.
fn top_speed(points: &[[f64; 3]]) -> f64 {
    points.windows(2).map(|w| (w[1][0] - w[0][0]).abs() / 0.001).fold(0.0, f64::max)
}

/// G95: 0.5 mm a revolution at 600 rpm are 5 mm/s; the path waits for the spindle, and follows it when it is slower.
#[test]
fn feed_a_revolution() {
    let channel = ChannelConfig { spindle_accel_rpm_s: 600.0, ..plain() };
    let (mut rig, run) = running(channel.clone(), "S600 M3\nG95 F0.5\nG1 X10\nM2\n");
    let mut at_half = None;
    for _ in 0..500 {
        rig.run(&[&run], 1);
        let rpm = rig.machine.core().channels[0].spindle.speed() * 60.0;
        if rpm >= 150.0 && at_half.is_none() {
            at_half = Some(rig.velocity());
        }
    }
    // 150 rpm of 600 after a quarter of a second: 1.25 mm/s.
    let speed = at_half.expect("the spindle turns");
    assert!((speed - 1.25).abs() < 0.02, "{speed}");
    let points = track(&mut rig, &run, &[]);
    assert!((top_speed(&points) - 5.0).abs() < 1e-6, "{}", top_speed(&points));
    // A slower spindle slows the path down.
    let (mut rig, run) = running(channel, "S600 M3\nG95 F0.5\nG1 X10\nM2\n");
    let over = rig.fb("CNC_SetOverride");
    rig.set(&over, "Enable", true);
    rig.lreal(&over, "Spindle", 0.5);
    rig.lreal(&over, "Feed", 1.0);
    rig.lreal(&over, "Rapid", 1.0);
    rig.call(&over);
    let points = track(&mut rig, &run, &[]);
    assert!((top_speed(&points) - 2.5).abs() < 0.01, "{}", top_speed(&points));
}

/// N0026: nothing turns.
#[test]
fn feed_a_revolution_without_a_spindle() {
    let (mut rig, run) = running(ChannelConfig { check_on_load: false, ..plain() }, "G95 F0.5\nG1 X10\nM2\n");
    rig.until(&[&run], &run, "Error", 100);
    assert_eq!(rig.error().map(|e| e.0), Some(Code::SpindleStopped));
}

/// G96: the speed at the work piece is constant: rpm = 1000 V / (pi d), and with G95 the feed follows.
#[test]
fn surface_speed() {
    let channel = ChannelConfig { spindle_accel_rpm_s: 0.0, ..plain() };
    let text = "G10 L2 P1 X5\nG0 X40\nG96 S120 D2500 M3\nG95 F0.5\nG1 X5\nG97 S500\nG1 X10\nM2\n";
    let (mut rig, run) = running(channel, text);
    let (mut checked, mut highest) = (0, 0.0f64);
    for _ in 0..60_000 {
        rig.run(&[&run], 1);
        let (rps, radius) = (rig.machine.core().channels[0].spindle.speed(), rig.axis(0) - 5.0);
        if rig.machine.core().channels[0].mark().line == 5 && radius > 8.0 && radius < 39.0 {
            let want = 120_000.0 / 60.0 / (std::f64::consts::TAU * radius);
            assert!((rps / want - 1.0).abs() < 0.01, "{rps} {want}");
            assert!((rig.velocity().abs() - 0.5 * rps).abs() < 0.02 * rps, "{} {rps}", rig.velocity());
            checked += 1;
        }
        highest = highest.max(60.0 * rps);
        if rig.get(&run, "Done") {
            break;
        }
    }
    assert!(checked > 1000, "{checked}");
    assert!((highest - 2500.0).abs() < 1e-6, "{highest}");
    assert!(rig.get(&run, "Done"));
}

/// G33: from the first mark of the encoder on the tool is where the spindle says, and two passes cut the same groove.
#[test]
fn thread_follows_the_encoder() {
    let text = "G0 X2\nS300 M3\nG4 P0.2\nG33 Z-10 K2\nG0 X5\nG0 Z0\nG0 X2\nG33 Z-10 K2\nM2\n";
    let (mut rig, run) = running(plain(), text);
    let over = rig.fb("CNC_SetOverride");
    let mut phases = [Vec::new(), Vec::new()];
    let mut worst: f64 = 0.0;
    let mut before = [0.0; 2];
    for _ in 0..20_000 {
        rig.run(&[&run, &over], 1);
        let channel = &rig.machine.core().channels[0];
        let (z, line) = (rig.axis(2), channel.mark().line);
        if let Some(pass) = [4, 8].iter().position(|l| *l == line)
            && z < -1.0
            && z > -9.9
        {
            // 2 mm a revolution: the turn that belongs to this depth.
            phases[pass].push((channel.spindle.revolutions() + z / 2.0).rem_euclid(1.0));
        }
        let v = (z - before[0]) / 0.001;
        worst = worst.max((v - before[1]).abs() / 0.001);
        before = [z, v];
        if rig.get(&run, "Done") {
            break;
        }
    }
    assert!(rig.get(&run, "Done"), "{:?}", rig.error());
    let off = |p: &f64| p.min(1.0 - p);
    for (pass, phase) in phases.iter().enumerate() {
        assert!(phase.len() > 800, "{}", phase.len());
        let most = phase.iter().map(off).fold(0.0, f64::max);
        assert!(most < 1e-6, "pass {pass}: {most} of a revolution off");
    }
    assert!(worst <= 50_000.0 * (1.0 + 1e-6), "{worst}");
    assert_eq!(rig.axis(2), -10.0);
}

/// A thread with M4, from a spindle that has just been switched on.
#[test]
fn thread_with_the_spindle_the_other_way() {
    let (mut rig, run) = running(plain(), "S300 M4\nG33 Z-6 K2\nM2\n");
    let mut off = 0.0f64;
    for _ in 0..20_000 {
        rig.run(&[&run], 1);
        let turn = rig.machine.core().channels[0].spindle.revolutions();
        if rig.axis(2) < -2.0 && rig.axis(2) > -5.9 {
            // Minus one revolution, two millimetres down; it starts at a whole turn.
            let phase = (turn - rig.axis(2) / 2.0).rem_euclid(1.0);
            off = off.max(phase.min(1.0 - phase));
        }
        if rig.get(&run, "Done") {
            break;
        }
    }
    assert!(rig.get(&run, "Done"), "{:?}", rig.error());
    assert!(off < 1e-6, "{off}");
}

/// Two G33 in a row are one thread: the second goes on where the first ended, in phase.
#[test]
fn chained_threads() {
    let (mut rig, run) = running(plain(), "S300 M3\nG4 P0.2\nG33 Z-6 K2\nG33 Z-9 K1\nM2\n");
    let (mut at_joint, mut off) = (f64::INFINITY, 0.0f64);
    let mut last = (0.0, 0.0);
    for _ in 0..20_000 {
        rig.run(&[&run], 1);
        let channel = &rig.machine.core().channels[0];
        let z = rig.axis(2);
        if z < -5.5 && z > -6.5 {
            at_joint = at_joint.min(rig.machine.core().axes[2].set_velocity().abs());
        }
        let turn = channel.spindle.revolutions();
        if z < -7.0 && z > -8.9 {
            if last != (0.0, 0.0) {
                off = off.max(((last.1 - z) - 1.0 * (turn - last.0)).abs());
            }
            last = (turn, z);
        }
        if rig.get(&run, "Done") {
            break;
        }
    }
    assert!(rig.get(&run, "Done"), "{:?}", rig.error());
    assert!(at_joint > 4.9, "{at_joint}");
    assert!(off < 1e-6, "{off}");
}

/// G33.1: in, the spindle is reversed, out in step with it, and it turns as before.
#[test]
fn rigid_tapping() {
    let channel = ChannelConfig { spindle_accel_rpm_s: 3000.0, ..plain() };
    let (mut rig, run) = running(channel, "G0 Z2\nS600 M3\nG4 P0.5\nG33.1 Z-8 K1\nG1 X5 F600\nM2\n");
    let (mut deepest, mut fastest_back, mut off) = (0.0f64, 0.0f64, 0.0f64);
    let mut origin = None;
    for _ in 0..20_000 {
        rig.run(&[&run], 1);
        let channel = &rig.machine.core().channels[0];
        let (z, turn) = (rig.axis(2), channel.spindle.revolutions());
        if channel.mark().line == 4 && z < 0.0 {
            let first = *origin.get_or_insert(turn + z);
            off = off.max((turn + z - first).abs());
        }
        deepest = deepest.min(z);
        fastest_back = fastest_back.min(channel.spindle.speed());
        if rig.get(&run, "Done") {
            break;
        }
    }
    assert!(rig.get(&run, "Done"), "{:?}", rig.error());
    assert!(off < 1e-6, "{off} mm out of step inside of the hole");
    // 10 rev/s, braked with 50 rev/s2: one revolution, 1 mm, too deep.
    assert!(deepest < -8.9 && deepest > -9.1, "{deepest}");
    assert!((fastest_back + 10.0).abs() < 1e-6);
    assert_eq!((rig.axis(2), rig.axis(0)), (2.0, 5.0));
}

/// N0077: the thread needs more than the axis can.
#[test]
fn thread_too_fast() {
    let (mut rig, run) = running(ChannelConfig { check_on_load: false, ..plain() }, "S60000 M3\nG33 Z-10 K6\nM2\n");
    rig.until(&[&run], &run, "Error", 100);
    assert_eq!(rig.error().map(|e| e.0), Some(Code::ThreadTooFast));
}

/// M52: the share of CNC_Io.Feed counts while it is on; M53 lets its FeedHold through.
#[test]
fn adaptive_feed_and_feed_hold() {
    let (mut rig, run) = running(plain(), "F6000\nG1 X10\nM52\nG1 X20\nM52 P0\nG1 X30\nM53 P0\nG1 X40\nM2\n");
    let io = io(&mut rig);
    rig.lreal(&io, "Feed", 0.5);
    let points = track(&mut rig, &run, &[&io]);
    let at = |low: f64, high: f64| {
        let inside: Vec<_> = points.iter().copied().filter(|p| p[0] > low && p[0] < high).collect();
        top_speed(&inside)
    };
    assert!((at(2.0, 9.0) - 100.0).abs() < 1e-6 && (at(12.0, 19.0) - 50.0).abs() < 1e-6, "{} {}", at(2., 9.), at(12., 19.));
    assert!((at(22.0, 29.0) - 100.0).abs() < 1e-6);
    let (mut rig, run) = running(plain(), "F6000\nG1 X10\nM53 P0\nG1 X20\nM2\n");
    let io = rig.fb("CNC_Io");
    rig.set(&io, "Enable", true);
    rig.set(&io, "FeedHold", true);
    rig.run(&[&run, &io], 500);
    assert_eq!((rig.cnc(), rig.axis(0)), (CncState::Running, 0.0));
    rig.set(&io, "FeedHold", false);
    rig.run(&[&run, &io], 130);
    rig.set(&io, "FeedHold", true);
    rig.until(&[&run, &io], &run, "Done", 500);
}
