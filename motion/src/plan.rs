//! Plans a part program without a machine and measures the result (`takt gcode --plan`, `--trace`).
//! Runs: background. The maxima are those of the interpolated output, not of the limits.

use crate::canon::Step;
use crate::execution::{Demand, PathExecutor, QUEUE, Reached};
use crate::geometry::{AXES, Point};
use crate::lookahead::{AxisLimits, Move, Planner};
use crate::run::{Item, RunError, RunReader, Work};
use crate::segment::{Action, Mark, Planned};
use takt_base::ring::ring;

/// What a plan needs to know.
#[derive(Clone, Debug)]
pub struct PlanConfig {
    /// Limits of the axes.
    pub axes: AxisLimits,
    /// Axes that exist and their travel.
    pub work: Work,
    /// Interpolation period in seconds.
    pub period_s: f64,
    /// Machine position at the start.
    pub start: Point,
    /// Keep the set points.
    pub set_points: bool,
    /// Most samples; a longer program is an error.
    pub samples_max: usize,
}

impl PlanConfig {
    /// The same speed (mm/s) and acceleration (mm/s2) on every axis, 1 ms.
    pub fn uniform(v: f64, a: f64) -> Self {
        Self {
            axes: AxisLimits::uniform(v, a),
            work: Work::default(),
            period_s: 0.001,
            start: [0.0; AXES],
            set_points: false,
            samples_max: 50_000_000,
        }
    }
}

/// A plan, measured.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PlanReport {
    /// Path elements.
    pub blocks: u32,
    /// Their length in mm, positioning included.
    pub length_mm: f64,
    /// Time in seconds, dwells included.
    pub time_s: f64,
    /// Time at programmed speed without acceleration.
    pub ideal_time_s: f64,
    /// Highest speed of each axis.
    pub max_velocity: Point,
    /// Highest acceleration of each axis.
    pub max_acceleration: Point,
    /// Highest jerk of each axis.
    pub max_jerk: Point,
    /// Largest distance of a set point from the programmed path.
    pub max_path_deviation_mm: f64,
    /// Samples beyond a limit by more than a millionth.
    pub violations: u32,
    /// Set points, one a period, if wanted.
    pub set_points: Vec<Point>,
    /// Machine position at the end.
    pub end: Point,
}

/// Why there is no plan, and at which block.
#[derive(Clone, PartialEq, Debug)]
pub struct PlanError {
    /// Place in the part program.
    pub mark: Mark,
    /// What is wrong.
    pub error: RunError,
}

/// Plans `steps` for the limits of `config`.
pub fn plan(steps: impl IntoIterator<Item = Step>, config: &PlanConfig) -> Result<PlanReport, PlanError> {
    let mut report = PlanReport { end: config.start, ..PlanReport::default() };
    let planned = released(steps, config, &mut report)?;
    sample(planned, config, &mut report)?;
    Ok(report)
}

/// Everything that the look-ahead releases.
fn released(
    steps: impl IntoIterator<Item = Step>,
    config: &PlanConfig,
    report: &mut PlanReport,
) -> Result<Vec<Planned>, PlanError> {
    let mut reader = RunReader::new(config.work, config.start);
    let mut planner = Planner::new(config.axes, config.period_s, 0);
    let mut mark = Mark::default();
    for step in steps {
        mark = Mark::from(&step);
        let mut emit = |mark, item| put(&mut planner, config, report, mark, item);
        reader.read(&step, &mut emit).map_err(|error| PlanError { mark, error })?;
    }
    reader.finish(&mut |mark, item| put(&mut planner, config, report, mark, item));
    planner.push(mark, Action::End { m: 0 });
    Ok(std::iter::from_fn(|| planner.pop()).collect())
}

fn put(planner: &mut Planner, config: &PlanConfig, report: &mut PlanReport, mark: Mark, item: Item) {
    match item {
        Item::Move(m) => {
            let fastest = crate::lookahead::path_limits(&m.path, &config.axes, f64::INFINITY, 1.0).v;
            report.blocks += 1;
            report.length_mm += m.path.length;
            report.ideal_time_s += m.path.length / if m.rapid { m.feed.min(fastest) } else { m.feed };
            planner.push_move(mark, m);
        }
        Item::Special(m, _) => {
            report.blocks += 1;
            report.length_mm += m.path.length;
            report.ideal_time_s += m.path.length / m.feed;
            // Nobody answers, and nothing turns: it is planned as if it were a move.
            planner.push_move(mark, Move { exact_stop: true, ..m });
        }
        Item::Action(action) => planner.push(mark, action),
    }
}

fn sample(planned: Vec<Planned>, config: &PlanConfig, report: &mut PlanReport) -> Result<(), PlanError> {
    let (mut tx, mut rx) = ring(QUEUE);
    let mut source = planned.into_iter().peekable();
    let mut executor = PathExecutor::new(config.start);
    let mut meter = Meter::new(config);
    for _ in 0..config.samples_max {
        while let Some(step) = source.next_if(|_| !tx.is_full()) {
            let _ = tx.push(step);
        }
        executor.fill(&mut rx, 0);
        let mut left = config.period_s;
        let mut ended = false;
        while let Reached::Action(step, rest) = executor.advance(left, &Demand::default()) {
            ended |= matches!(step.action, Action::End { .. });
            left = rest;
            if ended {
                break;
            }
        }
        report.time_s += config.period_s - if ended { left } else { 0.0 };
        meter.sample(executor.position(), report);
        let off = executor.deviation(&executor.position());
        if off.is_finite() {
            report.max_path_deviation_mm = report.max_path_deviation_mm.max(off);
        }
        if ended {
            // Two more samples at rest complete the second and third differences.
            (0..3).for_each(|_| meter.sample(executor.position(), report));
            report.end = executor.position();
            return Ok(());
        }
    }
    let mark = executor.mark();
    let text = format!("the program takes more than {} samples", config.samples_max);
    Err(PlanError { mark, error: RunError { code: takt_base::Code::ParameterOutOfRange, text } })
}

/// Differences of the sampled positions.
pub struct Meter {
    axes: AxisLimits,
    period_s: f64,
    keep: bool,
    last: [Point; 4],
    count: usize,
}

impl Meter {
    /// Starts at rest at the start position.
    pub fn new(config: &PlanConfig) -> Self {
        Self { axes: config.axes, period_s: config.period_s, keep: config.set_points, last: [config.start; 4], count: 0 }
    }

    /// Takes one sample.
    pub fn sample(&mut self, p: Point, report: &mut PlanReport) {
        self.count += 1;
        self.last.rotate_left(1);
        self.last[3] = p;
        if self.keep {
            report.set_points.push(p);
        }
        let t = self.period_s;
        let mut beyond = false;
        for i in 0..AXES {
            let [p0, p1, p2, p3] = self.last.map(|p| p[i]);
            let v = ((p3 - p2) / t).abs();
            let a = ((p3 - 2.0 * p2 + p1) / (t * t)).abs();
            let j = ((p3 - 3.0 * p2 + 3.0 * p1 - p0) / (t * t * t)).abs();
            report.max_velocity[i] = report.max_velocity[i].max(v);
            report.max_acceleration[i] = report.max_acceleration[i].max(a);
            report.max_jerk[i] = report.max_jerk[i].max(j);
            // Positions have an absolute rounding error, which the differences divide by the period.
            let noise = 8.0 * f64::EPSILON * p3.abs().max(p1.abs());
            beyond |= v > self.axes.v[i] * (1.0 + 1e-6) + noise / t || a > self.axes.a[i] * (1.0 + 1e-6) + noise / (t * t);
        }
        report.violations += u32::from(beyond);
    }
}
