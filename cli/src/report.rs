//! What a run did: the summary on stdout, faults on stderr, the picture of the path, the trace.

use crate::duration::show;
use crate::project::{self, Problem};
use std::fmt::Write;
use std::path::Path;
use takt_image::Image;
use takt_image::path::Variable;
use takt_image::value::{Value, read};
use takt_motion::machine::{AxisReport, ChannelReport, MachineConfig, MachineReport, PulseReport, Trace};
use takt_motion::svg::{Picture, Stroke};
use takt_runtime::{Histogram, Resource};

/// True if the variable is a BOOL that is TRUE.
pub fn is_true(image: &Image, variable: Option<&Variable>, memory: &[u8]) -> bool {
    variable.is_some_and(|v| read(&image.types, memory, v.place, v.ty) == Some(Value::Bool(true)))
}

/// Faults on stderr, with what to do about them.
pub fn faults(resource: &Resource) {
    for fault in resource.fault_reports() {
        eprintln!("fault {fault}");
        eprintln!("  = help: `takt explain {}` says what to look for", fault.code.text());
    }
}

/// The summary of tasks: scans, overruns, scan time and jitter.
pub fn tasks(resource: &Resource) -> String {
    let mut out = String::new();
    for (task, stats) in resource.image().tasks.iter().zip(resource.stats()) {
        let _ = writeln!(out, "task {}: {} scans, {} overruns, {} faults", task.name, stats.scans, stats.overruns, stats.faults);
        let _ = writeln!(out, "  scan time  {}", percentiles(&stats.scan_time));
        let _ = writeln!(out, "  jitter     {}", percentiles(&stats.lateness));
    }
    out
}

fn percentiles(h: &Histogram) -> String {
    let q = |q| show(h.quantile(q));
    format!("p50 {}, p90 {}, p99 {}, p99.9 {}, max {}", q(0.5), q(0.9), q(0.99), q(0.999), show(h.max()))
}

/// The summary of channels and axes.
pub fn machine(report: &MachineReport, config: &MachineConfig) -> String {
    let mut out = String::new();
    for (channel, keys) in report.channels.iter().zip(&config.channels) {
        let axes = keys.axes.iter().filter_map(|name| report.axes.iter().find(|a| a.name == *name));
        out += &self::channel(channel, &axes.collect::<Vec<_>>(), report.path_deviation_max_mm);
    }
    for axis in &report.axes {
        let error = axis.error.map(|c| format!(", error {}: {}", c.text(), c.title())).unwrap_or_default();
        let (name, actual, state) = (&axis.name, axis.actual_mm, axis.state);
        let _ = writeln!(out, "axis {name}: at {actual:.3} mm, {state:?}{error}");
    }
    out
}

fn channel(c: &ChannelReport, axes: &[&AxisReport], deviation_mm: f64) -> String {
    let mut out = format!("channel {}: {} blocks run, path length {:.3} mm", c.name, c.blocks, c.feed_mm);
    let end: Vec<_> = axes.iter().map(|a| format!("{:.1$}", a.set_mm, decimals(a.set_mm))).collect();
    let _ = write!(out, ", end point ({})", end.join(", "));
    match &c.pulses {
        None => {
            let _ = writeln!(out, ", maximum path deviation {deviation_mm:.4} mm");
        }
        Some(p) => out += &pulses(p),
    }
    if c.late_ticks > 0 {
        let _ = writeln!(out, "  the plan came late: the path braked or stood in {} ticks", c.late_ticks);
    }
    if let Some(e) = &c.error {
        let _ = writeln!(out, "  {}: {} (line {}, column {})", e.code.text(), e.text, e.line, e.column);
    }
    out
}

/// Pulses of the axes that moved.
fn pulses(p: &PulseReport) -> String {
    let moved = (0..3).filter(|&i| p.up[i] + p.down[i] > 0);
    let counts: Vec<_> = moved.map(|i| format!("{} +{} -{}", ['X', 'Y', 'Z'][i], p.up[i], p.down[i])).collect();
    let (counts, iterations, most) = (counts.join(", "), p.iterations, p.batch_max);
    let wrapped = if p.wrapped.contains(&true) { "\n  an 8-bit counter of the interface wrapped" } else { "" };
    format!("\n  pulses {counts}; {iterations} iterations, at most {most} a tick{wrapped}\n")
}

/// Whole numbers without decimals: an end point reads as the part program says it.
fn decimals(mm: f64) -> usize {
    if (mm - mm.round()).abs() < 5e-10 { 0 } else { 3 }
}

/// The commanded and the actual path of the first channel's first two axes; `None` if nothing moved.
pub fn picture(title: &str, trace: &Trace, config: &MachineConfig) -> Option<String> {
    let channel = config.channels.first()?;
    let (x, y) = (config.axis_index(channel.axes.first()?)?, config.axis_index(channel.axes.get(1)?)?);
    let path = |actual: usize| trace.rows().map(move |r| [r.values[2 * x + actual], r.values[2 * y + actual]]);
    let end = path(1).last()?;
    let picture = Picture::new(title)
        .axes(&channel.axes[0], &channel.axes[1])
        .curve("commanded", path(0), Stroke::feed())
        .curve("actual", path(1), Stroke::actual())
        .marker("end", end, "#c00");
    Some(picture.to_svg())
}

/// Set and actual positions, a row a tick, as the shortest numbers that read back the same.
pub fn write_trace(path: &Path, trace: &Trace, config: &MachineConfig) -> Result<(), Problem> {
    let mut out = String::from("time_ns");
    for axis in &config.axes {
        let _ = write!(out, ",{0}.set,{0}.actual", axis.name);
    }
    for row in trace.rows() {
        let _ = write!(out, "\n{}", row.time.0);
        for v in row.values {
            let _ = write!(out, ",{v}");
        }
    }
    out.push('\n');
    if trace.is_full() {
        eprintln!("warning: the trace is full; {} ends before the run", path.display());
    }
    project::write(path, out.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use takt_motion::channel::CncState;

    #[test]
    fn late_ticks_are_told_when_there_are_some() {
        let mut report = ChannelReport {
            name: "mill".into(),
            state: CncState::Ready,
            blocks: 3,
            feed_mm: 12.5,
            late_ticks: 0,
            line: 0,
            part_count: 1,
            error: None,
            pulses: None,
        };
        let on_time = channel(&report, &[], 0.0);
        assert_eq!(on_time.lines().count(), 1, "{on_time}");
        report.late_ticks = 7;
        let late = channel(&report, &[], 0.0);
        assert_eq!(late, format!("{on_time}  the plan came late: the path braked or stood in 7 ticks\n"));
    }
}
