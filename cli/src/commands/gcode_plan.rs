//! `takt gcode --plan` and `--trace`: the same look-ahead and interpolation as in a run, without a machine.

use super::gcode::PartProgram;
use crate::Status;
use crate::project::{self, Problem};
use serde_json::{Map, Value as Json, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use takt_base::{Code, Diag};
use takt_motion::plan::{PlanConfig, PlanError, PlanReport, plan};

/// Letters of the planned axes, in the order of a point.
const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];

#[derive(clap::Args)]
pub struct PlanArgs {
    /// Velocity and acceleration limit of every axis in mm/s and mm/s²
    #[arg(long, value_name = "v=V,a=A", conflicts_with = "config", value_parser = limits)]
    limits: Option<(f64, f64)>,
    /// Project file whose axes give the limits
    #[arg(long, value_name = "takt.toml")]
    config: Option<PathBuf>,
    /// Kernel; this version has one: acceleration before interpolation
    #[arg(long, default_value = "adcbi", value_parser = ["adcbi"])]
    kernel: String,
    #[arg(long, default_value = "human", value_parser = ["human", "json"])]
    format: String,
}

fn limits(text: &str) -> Result<(f64, f64), String> {
    let (mut v, mut a) = (None, None);
    for part in text.split(',') {
        let number = |t: &str| t.parse().ok().filter(|n: &f64| n.is_finite() && *n > 0.0);
        match part.split_once('=') {
            Some(("v", t)) => v = number(t),
            Some(("a", t)) => a = number(t),
            Some(("j", _)) => return Err("this version plans without a jerk limit; leave j out".into()),
            _ => return Err(format!("`{part}` is not v=NUMBER or a=NUMBER")),
        }
    }
    v.zip(a).ok_or_else(|| "both v and a are needed, as positive numbers: v=500,a=5000".into())
}

pub fn execute(program: &PartProgram, args: &PlanArgs, report: bool, trace: Option<&Path>) -> Result<Status, Problem> {
    let mut config = config(args)?;
    config.set_points = trace.is_some();
    let planned = plan(program.steps()?, &config).map_err(|e| problem(program, e))?;
    if report {
        print_report(&planned, &args.format);
    }
    if let Some(path) = trace {
        project::write(path, csv(&planned, config.period_s).as_bytes())?;
    }
    Ok(Status::Success)
}

fn config(args: &PlanArgs) -> Result<PlanConfig, Problem> {
    let Some(path) = &args.config else {
        let (v, a) = args.limits.unwrap_or((500.0, 5000.0));
        return Ok(PlanConfig::uniform(v, a));
    };
    let text = String::from_utf8_lossy(&project::read(path)?).into_owned();
    let machine = project::machine(&project::parse_keys(&path.display().to_string(), &text)?)?;
    let Some(channel) = machine.channels.first() else {
        return Err(Problem::File(Code::BadProjectFile, format!("{} has no [[motion.channel]]", path.display())));
    };
    Ok(PlanConfig {
        axes: machine.limits(channel),
        work: machine.work(channel),
        period_s: machine.servo_period.as_secs(),
        ..PlanConfig::uniform(1.0, 1.0)
    })
}

fn problem(program: &PartProgram, e: PlanError) -> Problem {
    program.problem(Diag::new(e.error.code, program.line(e.mark.line), e.error.to_string()))
}

fn print_report(r: &PlanReport, format: &str) {
    if format == "json" {
        say!("{}", json_report(r));
        return;
    }
    say!("blocks          {}", r.blocks);
    say!("length          {:.3} mm", r.length_mm);
    say!("time            {:.4} s (without acceleration limits {:.4} s)", r.time_s, r.ideal_time_s);
    say!("path deviation  {:.6} mm", r.max_path_deviation_mm);
    say!("violations      {}", r.violations);
    for i in moving(r) {
        let (v, a, j) = (r.max_velocity[i], r.max_acceleration[i], r.max_jerk[i]);
        say!("{}               {v:.3} mm/s, {a:.1} mm/s², {j:.0} mm/s³", LETTERS[i]);
    }
}

fn moving(r: &PlanReport) -> impl Iterator<Item = usize> + '_ {
    (0..LETTERS.len()).filter(|&i| r.max_velocity[i] > 0.0)
}

fn json_report(r: &PlanReport) -> Json {
    let largest = |p: &[f64]| p.iter().copied().fold(0.0, f64::max);
    let axes: Map<String, Json> = moving(r)
        .map(|i| {
            let axis = json!({
                "max_velocity": r.max_velocity[i],
                "max_acceleration": r.max_acceleration[i],
                "max_jerk": r.max_jerk[i],
            });
            (LETTERS[i].to_string(), axis)
        })
        .collect();
    json!({
        "blocks": r.blocks,
        "length_mm": r.length_mm,
        "time_s": r.time_s,
        "ideal_time_s": r.ideal_time_s,
        "max_velocity": largest(&r.max_velocity),
        "max_acceleration": largest(&r.max_acceleration),
        "max_jerk": largest(&r.max_jerk),
        "max_path_deviation_mm": r.max_path_deviation_mm,
        "violations": r.violations,
        "axes": axes,
    })
}

/// One row a period: time in seconds, then the axes that move, in mm.
fn csv(r: &PlanReport, period_s: f64) -> String {
    let axes: Vec<usize> = moving(r).collect();
    let mut out = String::from("time_s");
    axes.iter().for_each(|&i| out.extend([',', LETTERS[i]]));
    for (k, point) in r.set_points.iter().enumerate() {
        let _ = write!(out, "\n{:.6}", k as f64 * period_s);
        for &i in &axes {
            let _ = write!(out, ",{:.9}", point[i]);
        }
    }
    out.push('\n');
    out
}
