//! Look-ahead and interpolation together: limits at every sample, end exact, path kept, also under hold and override.

mod common;
use common::{Program, Random, plate, random_program};
use takt_base::ring::ring;
use takt_motion::canon::Step;
use takt_motion::execution::{Demand, PathExecutor, QUEUE, Reached};
use takt_motion::lookahead::{AxisLimits, Planner};
use takt_motion::plan::{Meter, PlanConfig, PlanReport, plan};
use takt_motion::run::{Item, RunReader, Work};
use takt_motion::segment::{Action, Mark};

fn limits(r: &mut Random) -> PlanConfig {
    let mut config = PlanConfig::uniform(0.0, 0.0);
    for i in 0..6 {
        config.axes.v[i] = r.between(50.0, 1500.0);
        config.axes.a[i] = r.between(500.0, 20_000.0);
    }
    config
}

/// R1-160..R1-164, R1-145: 2,000 random programs; limits of each axis, end and path.
#[test]
fn limits_path_and_end_of_random_programs() {
    for seed in 0..2000 {
        let config = limits(&mut Random(seed));
        let steps = random_program(seed);
        let want = plan_end(&steps);
        let report = plan(steps, &config).unwrap_or_else(|e| panic!("seed {seed}: {e:?}"));
        assert_eq!(
            report.violations, 0,
            "seed {seed}: {:?} {:?} of {:?}",
            report.max_velocity, report.max_acceleration, config.axes
        );
        assert!(report.max_path_deviation_mm < 1e-9, "seed {seed}: {}", report.max_path_deviation_mm);
        assert_eq!(report.end, want, "seed {seed}");
        assert!(report.time_s >= report.ideal_time_s - 1e-6);
    }
}

fn plan_end(steps: &[Step]) -> [f64; 6] {
    let mut reader = RunReader::new(Work::default(), [0.0; 6]);
    for step in steps {
        reader.read(step, &mut |_, _| {}).expect("a good program");
    }
    reader.position()
}

/// CM-23, scenario S40: hold, resume and override at random times keep the limits and the path.
#[test]
fn hold_and_override_keep_limits_and_path() {
    for seed in 0..1000 {
        let mut r = Random(seed ^ 0x55);
        let config = limits(&mut r);
        let steps = random_program(seed);
        let want = plan_end(&steps);
        let report = run(steps, &config, &mut r);
        assert_eq!(
            report.violations, 0,
            "seed {seed}: {:?} {:?} of {:?}",
            report.max_velocity, report.max_acceleration, config.axes
        );
        assert!(report.max_path_deviation_mm < 1e-9, "seed {seed}: {}", report.max_path_deviation_mm);
        assert_eq!(report.end, want, "seed {seed}");
    }
}

fn run(steps: Vec<Step>, config: &PlanConfig, r: &mut Random) -> PlanReport {
    let (mut tx, mut rx) = ring(QUEUE);
    let mut planner = Planner::new(config.axes, config.period_s, 0);
    let mut reader = RunReader::new(config.work, config.start);
    for step in &steps {
        let mut emit = |mark, item| match item {
            Item::Move(m) => planner.push_move(mark, m),
            Item::Special(m, special) => planner.push_special(mark, m, special),
            Item::Action(a) => planner.push(mark, a),
        };
        reader.read(step, &mut emit).expect("a good program");
    }
    planner.push(Mark::default(), Action::End { m: 0 });
    while let Some(step) = planner.pop() {
        tx.push(step).expect("room");
    }
    let mut executor = PathExecutor::new(config.start);
    let (mut meter, mut report) = (Meter::new(config), PlanReport::default());
    let mut demand = Demand::default();
    for tick in 0.. {
        executor.fill(&mut rx, 0);
        assert!(tick < 10_000_000, "does not end");
        if r.below(40) == 0 {
            demand.hold = r.below(2) == 0;
            demand.feed = [0.0, 0.1, 0.5, 0.9, 1.0][r.below(5)];
            demand.rapid = [0.25, 0.5, 1.0][r.below(3)];
        }
        let mut left = config.period_s;
        while let Reached::Action(step, rest) = executor.advance(left, &demand) {
            left = rest;
            if matches!(step.action, Action::End { .. }) {
                (0..4).for_each(|_| meter.sample(executor.position(), &mut report));
                report.end = executor.position();
                return report;
            }
        }
        meter.sample(executor.position(), &mut report);
        let off = executor.deviation(&executor.position());
        report.max_path_deviation_mm = report.max_path_deviation_mm.max(if off.is_finite() { off } else { 0.0 });
    }
    unreachable!()
}

/// PC-T8, planned: longer than the ideal time, within the limits, on the contour, closed.
#[test]
fn pc_t8_plate_is_planned_within_limits() {
    let report = plan(plate(0.0, 0.0), &PlanConfig::uniform(1200.0, 20_000.0)).expect("a plan");
    assert_eq!(report.blocks, 27);
    assert!((report.length_mm - 1394.782).abs() < 1e-3);
    assert!(report.time_s > 1.3587, "{}", report.time_s);
    assert!(report.time_s < 4.0, "{}", report.time_s);
    assert_eq!((report.end[0], report.end[1]), (20.0, 30.0));
    assert_eq!(report.violations, 0);
    assert!(report.max_velocity[0] <= 1200.0 * (1.0 + 1e-9) && report.max_velocity[0] > 999.0);
    println!("plate: {:.4} s", report.time_s);
}

/// A polyline of short chords runs without stops: bends within the budget are passed.
#[test]
fn fine_polyline_does_not_stop() {
    let mut p = Program::from(50.0, 0.0);
    p.feed(6000.0);
    let n = 720;
    for k in 1..=n {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / f64::from(n));
        p.line(50.0 * cos, 50.0 * sin);
    }
    let mut config = PlanConfig::uniform(500.0, 5000.0);
    config.start = [50.0, 0., 0., 0., 0., 0.];
    let report = plan(p.end(), &config).expect("a plan");
    assert_eq!(report.violations, 0);
    assert!(report.time_s < 1.25 * report.ideal_time_s, "{} s, ideal {} s", report.time_s, report.ideal_time_s);
}

/// CM-50: exact stop stops at every joint; CM-51: exact path does not at tangent ones.
#[test]
fn exact_stop_mode() {
    use takt_motion::canon::{Canon, MotionMode};
    let program = |mode| {
        let mut p = Program::default();
        p.block(Canon::SetMotionControlMode(mode));
        p.feed(6000.0).line(10.0, 0.0).line(20.0, 0.0);
        plan(p.end(), &PlanConfig::uniform(500.0, 1000.0)).expect("a plan").time_s
    };
    assert!((program(MotionMode::ExactPath) - 0.3).abs() < 1.1e-3);
    assert!((program(MotionMode::ExactStop) - 0.4).abs() < 1.1e-3);
}

/// Same program, same numbers: bit for bit.
#[test]
fn plans_are_repeatable() {
    let mut config = PlanConfig::uniform(1200.0, 20_000.0);
    config.set_points = true;
    let bits = |r: PlanReport| r.set_points.iter().flatten().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(plan(plate(0.0, 0.0), &config).unwrap()), bits(plan(plate(0.0, 0.0), &config).unwrap()));
    assert!(AxisLimits::uniform(1.0, 1.0).v == [1.0; 6]);
}
