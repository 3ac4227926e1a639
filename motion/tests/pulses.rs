//! The plate as reference pulses through a channel: PC-T2, PC-T6, PC-T7.

mod common;
use common::plate;
use common::rig::{Rig, programs, two_axes};
use takt_motion::channel::CncState;
use takt_motion::drive::StepPort;
use takt_motion::drive::parport::SimulatedPort;
use takt_motion::machine::{ChannelMode, PulseReport};
use takt_motion::pulse::dda::Preload;
use takt_motion::{Background, MachineConfig};

fn config(blu_mm: f64, preload: Preload) -> MachineConfig {
    let mut config = two_axes(false);
    config.channels[0].mode = ChannelMode::ReferencePulse { blu_mm, preload, batch_max: 200, record_max: 1_000_000 };
    config.trace_ticks = 0;
    config
}

fn run(blu_mm: f64, preload: Preload) -> (PulseReport, Vec<u8>, Rig) {
    let mut rig = Rig::new(&config(blu_mm, preload), programs(&[("plate", plate(0.0, 0.0))]), Background::Inline);
    rig.power_on();
    let run = rig.start("plate");
    rig.until(&[&run], &run, "Done", 20_000);
    let pulses = rig.machine.report().channels[0].pulses.clone().expect("pulse mode");
    let record = rig.machine.core().channels[0].pulse_output().expect("pulse mode").driver.record().to_vec();
    (pulses, record, rig)
}

/// PC-T2: pulse counts of all five BLU rows, both preloads; ticks; end counters.
#[test]
fn pc_t2_pulse_counts() {
    for (blu, x_up, x_down, y_up, y_down, end, ticks) in [
        (2.0, 186, 176, 201, 186, [10, 15], [516 + 173 + 15, 516 + 163 + 15]),
        (1.0, 372, 352, 402, 372, [20, 30], [1032 + 331 + 30, 1032 + 329 + 30]),
        (0.5, 744, 704, 804, 744, [40, 60], [2064 + 657 + 60, 2064 + 655 + 60]),
        (0.1, 3720, 3520, 4020, 3720, [200, 300], [10_320 + 3269 + 300, 10_320 + 3269 + 300]),
        (0.01, 37_200, 35_200, 40_200, 37_200, [2000, 3000], [103_200 + 32_675 + 3000; 2]),
    ] {
        for (preload, ticks) in [(Preload::Zero, ticks[0]), (Preload::Half, ticks[1])] {
            let (p, _, rig) = run(blu, preload);
            assert_eq!((p.up, p.down), ([x_up, y_up, 0], [x_down, y_down, 0]), "BLU {blu}");
            assert!((p.iterations as i64 - ticks).abs() <= 20, "BLU {blu} {preload:?}: {} ticks, not {ticks}", p.iterations);
            assert_eq!([u64::from(p.counters[0]), u64::from(p.counters[1])], end.map(|c: u64| c % 256));
            let report = rig.machine.report();
            assert_eq!((report.axes[0].set_mm, report.axes[1].set_mm), (20.0, 30.0), "BLU {blu}");
            assert!((report.channels[0].feed_mm - 1358.726).abs() < 1e-3);
        }
    }
}

/// PC-T6: 8 bits are enough for BLU 2 and 1; at 0.5 a wrap is flagged.
#[test]
fn pc_t6_wrap() {
    for (blu, wraps, max) in [(2.0, false, [118, 117]), (1.0, false, [236, 234]), (0.5, true, [255, 255])] {
        let (p, _, rig) = run(blu, Preload::Half);
        assert_eq!(p.wrapped, [wraps, wraps, false], "BLU {blu}");
        let port = &rig.machine.core().channels[0].pulse_output().expect("pulse mode").driver.port;
        assert_eq!(port.max_counters()[..2], max);
        assert_eq!(port.setup_errors(), 0);
    }
}

/// PC-T7: decoding the record of bytes K gives the counters; the bytes of straight blocks are those of the table.
#[test]
fn pc_t7_record() {
    let (p, record, _) = run(1.0, Preload::Half);
    let mut port = SimulatedPort::default();
    port.reset();
    for k in &record {
        port.write(k & !7);
        port.write(*k);
        port.write(k & !7);
    }
    assert_eq!(port.counters(), [20, 30, 0]);
    assert_eq!(port.pulses(), (p.up, p.down));
    let runs: Vec<(u8, usize)> = record.chunk_by(|a, b| a == b).map(|c| (c[0], c.len())).collect();
    assert_eq!(runs[..4], [(27, 20), (26, 10), (18, 60), (9, 52)]);
    assert_eq!(runs[runs.len() - 1], (1, 92));
    let before = runs[runs.len() - 2];
    assert!(before.0 == 2 && before.1 >= 68, "N26 behind the Y pulses at the end of N25");
    // N4: direction bits 24 throughout.
    let n4 = 30 + 60 + 52;
    assert!(record[n4..n4 + 25].iter().all(|k| k & 0x38 == 24));
}

/// PC-13: several iterations a tick are reported; what does not fit is refused before it moves.
#[test]
fn pc_13_batch() {
    assert_eq!(run(1.0, Preload::Half).0.batch_max, 5, "G0 at 5000 mm/s");
    assert_eq!(run(0.1, Preload::Half).0.batch_max, 50, "G0 at 5000 mm/s");
    let mut config = config(0.001, Preload::Half);
    config.axes.iter_mut().for_each(|a| a.v_max_mm_s = 100.0);
    let mut rig = Rig::new(&config, programs(&[("plate", plate(0.0, 0.0))]), Background::Inline);
    rig.power_on();
    let run = rig.start("plate");
    rig.until(&[&run], &run, "Error", 10_000);
    assert_eq!((rig.cnc(), rig.position()), (CncState::Fault, 20.0));
    let report = rig.machine.report();
    assert_eq!(report.channels[0].error.as_ref().map(|e| e.line), Some(3), "the second motion");
}

/// A hold stops between two pulses and goes on there.
#[test]
fn hold_between_pulses() {
    let mut rig = Rig::new(&config(1.0, Preload::Half), programs(&[("plate", plate(0.0, 0.0))]), Background::Inline);
    rig.power_on();
    let (run, hold, resume) = (rig.start("plate"), rig.fb("CNC_Hold"), rig.fb("CNC_Resume"));
    rig.run(&[&run], 500);
    rig.set(&hold, "Execute", true);
    rig.until(&[&hold, &run], &hold, "Done", 5);
    let at = rig.machine.core().channels[0].position();
    rig.run(&[&run, &hold], 100);
    assert_eq!(rig.machine.core().channels[0].position(), at);
    rig.set(&resume, "Execute", true);
    rig.until(&[&run, &resume], &run, "Done", 5000);
    let p = rig.machine.report().channels[0].pulses.clone().expect("pulse mode");
    assert_eq!((p.up[0], p.down[0]), (372, 352));
}
