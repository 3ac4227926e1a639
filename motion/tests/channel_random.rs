//! Random operators: holds, aborts, single blocks, overrides, probe and inputs at random times. Whatever they do, axes keep their
//! acceleration, nothing gets stuck, and the same operator sees the same machine.

mod common;
use common::Random;
use common::shop::{disk, shop, three_axes};
use takt_motion::channel::CncState;
use takt_motion::machine::ChannelConfig;

const PROGRAM: &str = "\
G21 G90 F6000 S1200 M3
G1 X20 Y5
M1
X21 Y5.2
X22 Y5.5
G2 X30 Y5 R12
#1 = #<_plc_level>
G38.3 Z-8
G1 Z0
M66 P1 L3 Q0.1
/G1 X35
M62 P1
G33 Z-6 K1
G0 Z2
G33.1 Z-4 K1
G5.2 X30 Y20 P0.5 L3
X10 Y20 P1
G5.3
G95 F0.2
G1 X5
G94 F3000
o1 repeat [20]
  G91
  G1 X0.3 Y0.1
  G90
o1 endrepeat
M1
#<_plc_v0> = [#<_plc_v0> + 1]
M2
";

/// A life of `ticks`; positions and states at every tick.
fn life(seed: u64, ticks: usize) -> Vec<(CncState, [f64; 3])> {
    let accel = 8000.0;
    let mut config = three_axes(ChannelConfig::default());
    config.axes.iter_mut().for_each(|a| (a.a_max_mm_s2, a.v_max_mm_s) = (accel, 300.0));
    let mut rig = shop(&config, &disk(&[("a.ngc", PROGRAM)]));
    let mut random = Random(seed);
    let names = ["CNC_LoadProgram", "CNC_Panel", "CNC_Io", "CNC_SetOverride", "CNC_Abort"];
    let fbs = names.map(|n| rig.fb(n));
    let [load, panel, io, over, _] = &fbs;
    [panel, io, over].iter().for_each(|fb| rig.set(fb, "Enable", true));
    rig.text(load, "FileName", "a.ngc");
    rig.set(load, "Execute", true);
    let all: Vec<_> = fbs.iter().collect();
    let mut seen = Vec::new();
    let (mut last, mut speed) = ([0.0; 3], [0.0; 3]);
    for t in 0..ticks {
        let mut on = |one_in: usize| random.below(one_in) == 0;
        let toggles: [(usize, &str, usize); 9] = [
            (1, "CycleStart", 40),
            (1, "FeedHold", 150),
            (1, "SingleBlock", 300),
            (1, "OptionalStop", 300),
            (1, "BlockSkip", 300),
            (1, "ReadInDisable", 400),
            (1, "FeedDisable", 400),
            (2, "Probe", 120),
            (4, "Execute", 3000),
        ];
        for (fb, pin, one_in) in toggles {
            if on(one_in) {
                let level = rig.get(&fbs[fb], pin);
                rig.set(&fbs[fb], pin, !level);
            }
        }
        if t % 7 == 0 && on(30) {
            let share = if on(2) { 1.0 } else { 0.37 };
            rig.lreal(over, "Feed", share);
            rig.set_at(io, "In", 1, share < 1.0);
        }
        rig.set(panel, "ResetBtn", rig.cnc() == CncState::Fault && t % 2 == 0);
        rig.run(&all, 1);
        let p = [0, 1, 2].map(|i| rig.axis(i));
        for i in 0..3 {
            let v = (p[i] - last[i]) / 0.001;
            let a = (v - speed[i]).abs() / 0.001;
            assert!(a <= accel * (1.0 + 1e-5) + 0.1, "seed {seed}, tick {t}, axis {i}: {a} {:?}", rig.machine.report().channels);
            speed[i] = v;
        }
        last = p;
        seen.push((rig.cnc(), p));
    }
    // Everything released: the machine comes to an end.
    for pin in ["FeedHold", "SingleBlock", "OptionalStop", "ReadInDisable", "FeedDisable", "CycleStart"] {
        rig.set(panel, pin, false);
    }
    rig.set(io, "Probe", false);
    let mut left = 30_000;
    while !matches!(rig.cnc(), CncState::Ready | CncState::Fault) {
        rig.set(panel, "CycleStart", left % 2 == 0 && rig.get(panel, "CanStart"));
        rig.run(&all, 1);
        left -= 1;
        assert!(left > 0, "seed {seed}: stuck in {:?}", rig.machine.report().channels);
    }
    seen
}

#[test]
fn random_operators() {
    let mut states = [false; CncState::ALL.len()];
    for seed in 1..=40 {
        life(seed, 6000).iter().for_each(|(state, _)| states[*state as usize] = true);
    }
    use CncState as S;
    for state in [S::Ready, S::Running, S::Holding, S::Held, S::AuxWait, S::StepStop, S::ProgStop, S::Aborting, S::Fault] {
        assert!(states[state as usize], "{state:?} never came");
    }
}

#[test]
fn the_same_operator_sees_the_same_machine() {
    assert!(life(7, 3000) == life(7, 3000));
}
