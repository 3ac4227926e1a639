//! Programs in space, and programs that nobody should write: limits hold, nothing panics or hangs.

mod common;
use common::Random;
use takt_motion::canon::{Arc, Canon, Plane, Position, Step, Units};
use takt_motion::plan::{PlanConfig, plan};

fn step(block: u32, command: Canon) -> Step {
    Step { block, line: block, n: None, command }
}

/// Lines, helices in all planes and rotary moves. Arcs start tangent or not, as it comes.
fn spatial(seed: u64) -> Vec<Step> {
    let mut r = Random(seed ^ 0x1234_5678);
    let mut at = Position::default();
    let mut steps = vec![step(1, Canon::SetFeedRate(r.between(500.0, 60_000.0)))];
    for block in 2..2 + 4 + r.below(10) as u32 {
        let plane = [Plane::Xy, Plane::Yz, Plane::Xz][r.below(3)];
        match r.below(4) {
            0 => {
                at.x += r.between(-30.0, 30.0);
                at.y += r.between(-30.0, 30.0);
                at.z += r.between(-30.0, 30.0);
                steps.push(step(block, Canon::StraightFeed(at)));
            }
            1 => {
                at.a += r.between(-90.0, 90.0);
                at.c += r.between(-90.0, 90.0);
                at.y += [0.0, r.between(-5.0, 5.0)][r.below(2)];
                let command = if r.below(2) == 0 { Canon::StraightTraverse(at) } else { Canon::StraightFeed(at) };
                steps.push(step(block, command));
            }
            _ => {
                steps.push(step(block, Canon::SelectPlane(plane)));
                steps.push(step(block, helix(&mut r, plane, &mut at)));
            }
        }
    }
    steps
}

fn helix(r: &mut Random, plane: Plane, at: &mut Position) -> Canon {
    let radius = r.between(0.5, 40.0);
    let (s0, c0) = libm::sincos(r.between(-3.0, 3.0));
    let (s1, c1) = libm::sincos(r.between(-3.0, 3.0));
    let rise = [0.0, r.between(-20.0, 20.0)][r.below(2)];
    at.b += [0.0, r.between(-20.0, 20.0)][r.below(2)];
    let (first, second, third) = match plane {
        Plane::Xy => (&mut at.x, &mut at.y, &mut at.z),
        Plane::Yz => (&mut at.y, &mut at.z, &mut at.x),
        Plane::Xz => (&mut at.z, &mut at.x, &mut at.y),
    };
    let (first_axis, second_axis) = (*first - radius * c0, *second - radius * s0);
    *first = first_axis + radius * c1;
    *second = second_axis + radius * s1;
    *third += rise;
    let (first_end, second_end, axis_end_point) = (*first, *second, *third);
    let rotation = [-2, -1, 1, 2][r.below(4)];
    Canon::ArcFeed(Arc { first_end, second_end, first_axis, second_axis, rotation, axis_end_point, a: at.a, b: at.b, c: at.c })
}

/// R1-164, CM-41, CM-48: 1,000 programs in space keep the limits of six axes and the path.
#[test]
fn programs_in_space() {
    for seed in 0..1000 {
        let mut r = Random(seed);
        let mut config = PlanConfig::uniform(0.0, 0.0);
        for i in 0..6 {
            config.axes.v[i] = r.between(50.0, 1500.0);
            config.axes.a[i] = r.between(500.0, 20_000.0);
        }
        let report = plan(spatial(seed), &config).unwrap_or_else(|e| panic!("seed {seed}: {e:?}"));
        assert_eq!(
            report.violations, 0,
            "seed {seed}: {:?} {:?} of {:?}",
            report.max_velocity, report.max_acceleration, config.axes
        );
        assert!(report.max_path_deviation_mm < 1e-9, "seed {seed}: {}", report.max_path_deviation_mm);
    }
}

fn wild(r: &mut Random) -> f64 {
    let magnitude = [0.0, 1e-300, 1e-12, 1e-6, 1.0, 1e3, 1e6, 1e9, 1e12, 1e300, f64::INFINITY, f64::NAN][r.below(12)];
    magnitude * [1.0, -1.0, 0.3][r.below(3)]
}

/// Any numbers in any command: a plan or an error, in bounded time.
#[test]
fn wild_numbers() {
    for seed in 0..20_000 {
        let mut r = Random(seed);
        let mut config = PlanConfig::uniform(500.0, 5000.0);
        config.samples_max = 50;
        let mut steps = Vec::new();
        for block in 1..6 {
            let p = Position { x: wild(&mut r), y: wild(&mut r), z: wild(&mut r), a: wild(&mut r), b: 0.0, c: wild(&mut r) };
            let arc = Arc {
                first_end: wild(&mut r),
                second_end: wild(&mut r),
                first_axis: wild(&mut r),
                second_axis: wild(&mut r),
                rotation: [0, 1, -1, i32::MAX, i32::MIN][r.below(5)],
                axis_end_point: wild(&mut r),
                a: 0.0,
                b: 0.0,
                c: 0.0,
            };
            steps.push(step(
                block,
                match r.below(9) {
                    0 => Canon::SetFeedRate(wild(&mut r)),
                    1 => Canon::StraightTraverse(p),
                    2 | 3 => Canon::StraightFeed(p),
                    4 | 5 => Canon::ArcFeed(arc),
                    6 => Canon::Dwell(wild(&mut r)),
                    7 => Canon::SetOriginOffsets(p),
                    _ => Canon::UseLengthUnits([Units::Inches, Units::Mm, Units::Cm][r.below(3)]),
                },
            ));
        }
        if let Ok(report) = plan(steps, &config) {
            assert!(report.length_mm.is_finite() && report.end.iter().all(|c| c.is_finite()), "seed {seed}: {report:?}");
        }
    }
}

/// Any path as reference pulses: refused, or made step by step without overflow.
#[test]
fn wild_pulses() {
    use takt_motion::geometry::Path;
    use takt_motion::pulse::dda::{Dda, Preload};
    use takt_motion::pulse::pulse_move;
    let mut made = 0;
    for seed in 0..20_000 {
        let mut r = Random(seed);
        let whole = r.below(2) == 0;
        let number = |r: &mut Random| if whole { r.between(-50.0, 50.0).round() } else { wild(r) };
        let start = [number(&mut r), number(&mut r), 0.0, 0.0, 0.0, 0.0];
        let end = [number(&mut r), number(&mut r), number(&mut r), 0.0, 0.0, 0.0];
        let centre = [number(&mut r), number(&mut r)];
        let turns = [0, 1, -1, 3, i32::MAX][r.below(5)];
        let path = if r.below(2) == 0 { Path::line(start, end) } else { Path::arc(start, end, 0, 1, centre, turns) };
        if let Ok(m) = pulse_move(&path, r.below(4) == 0, 10.0, 1.0) {
            let mut dda = Dda::new(&m, [Preload::Zero, Preload::Half][r.below(2)]);
            made += (0..2000).map_while(|_| dda.step()).count();
        }
    }
    assert!(made > 10_000);
}

/// The look-ahead keeps up: a hundred thousand blocks are planned and sampled in seconds, also without optimisation.
#[test]
fn many_blocks() {
    let mut steps = vec![step(1, Canon::SetFeedRate(6000.0))];
    for k in 1..100_000u32 {
        let (sin, cos) = libm::sincos(f64::from(k) * 1e-3);
        let r = 50.0 + f64::from(k) * 1e-4;
        steps.push(step(k + 1, Canon::StraightFeed(Position { x: r * cos, y: r * sin, ..Position::default() })));
    }
    let report = plan(steps, &PlanConfig::uniform(500.0, 5000.0)).expect("a plan");
    assert_eq!(report.blocks, 99_999);
    assert_eq!(report.violations, 0);
}
