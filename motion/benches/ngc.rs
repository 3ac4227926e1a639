//! Rows of part programs per second, beside LinuxCNC's `rs274` where it is installed. `cargo bench -p takt-motion --bench ngc`
//!
//! Each program is written to a temporary file, read from it and listed to `/dev/null` as `takt rs274` and `rs274 -g` do; another
//! column has the interpreter alone. Times are of the processor, the best of some runs; those of `rs274` are without its start. `-- NAME` runs one program.

mod programs;

use programs::Program;
use std::io::Write;
use std::path::{Path, PathBuf};
use takt_base::SourceId;
use takt_motion::canon::{MotionMode, Units};
use takt_motion::ngc::{Interpreter, Options, Style, Text, tool};
use takt_motion::print::rs274::Listing;

const TOOLS: &str = "T1 P1 Z0 D0.1 ;a tool of 0.1 inch\n";
const RUNS: usize = 3;
/// Where both write what they list: the disk is not what is measured.
const LISTING: &str = "/dev/null";

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let folder = std::env::temp_dir().join(format!("takt-ngc-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    std::fs::write(folder.join("tool.tbl"), TOOLS).expect("a tool table");
    let start = peer(&folder, &write(&folder, "empty", "M2\n"), 5);
    let chosen = |name: &str| wanted.is_empty() || wanted.iter().any(|w| name.contains(w.as_str()));
    if chosen("large") {
        large(&folder);
    }
    println!(
        "{:<14} {:>10} {:>9} {:>13} {:>13} {:>13} {:>7}",
        "program", "rows", "MB", "interpreted/s", "listed/s", "rs274/s", "ratio"
    );
    for (name, rows, program) in programs::ALL {
        if chosen(name) {
            row(name, &program(rows), &folder, start);
        }
    }
    let _ = std::fs::remove_dir_all(&folder);
}

/// Ten million lines: the most memory that this process has had while it listed them, and a start in their middle.
fn large(folder: &Path) {
    let path = folder.join("large.ngc");
    let rows = programs::write_large(&path, 10_000_000).expect("room for a large program");
    let seconds = best(1, || list(&path));
    let bytes = std::fs::metadata(&path).map_or(0, |about| about.len());
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")).unwrap_or("").trim();
    println!("large: {rows} lines, {:.0} MB, listed in {seconds:.2} s; peak resident {peak}", bytes as f64 / 1e6);
    let mut interpreter = open(&path);
    for what in ["first", "second"] {
        let seconds = best(1, || interpreter.seek(rows as u32 / 2).expect("a line of the program"));
        println!("large: {what} start at line {}: {:.1} ms", rows / 2, seconds * 1e3);
    }
    let _ = std::fs::remove_file(path);
}

fn row(name: &str, program: &Program, folder: &Path, start: Option<f64>) {
    let path = write(folder, name, &program.text);
    let rate = |seconds: f64| program.rows as f64 / seconds;
    let interpreted = rate(best(RUNS, || interpret(&path)));
    let listed = rate(best(RUNS, || list(&path)));
    let theirs = peer(folder, &path, 1).zip(start).map(|(all, start)| rate((all - start).max(1e-9)));
    let (their_rate, ratio) = theirs.map_or(("-".into(), "-".into()), |t| (format!("{t:.0}"), format!("{:.1}", listed / t)));
    let megabytes = program.text.len() as f64 / 1e6;
    println!("{:<14} {:>10} {megabytes:>9.1} {interpreted:>13.0} {listed:>13.0} {their_rate:>13} {ratio:>7}", name, program.rows);
}

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(format!("{name}.ngc"));
    std::fs::write(&path, text).expect("a temporary file");
    path
}

/// Seconds of the quickest run.
fn best(runs: usize, mut work: impl FnMut()) -> f64 {
    let mut time = || {
        let start = processor_time();
        work();
        processor_time() - start
    };
    (0..runs).map(|_| time()).fold(f64::INFINITY, f64::min)
}

/// Seconds that this process and those that it waited for had a processor, so that others on the machine do not count.
fn processor_time() -> f64 {
    let read = |name: &str| std::fs::read_to_string(format!("/proc/self/{name}")).unwrap_or_default();
    let own: Option<f64> = read("schedstat").split(' ').next().and_then(|ns| ns.parse().ok());
    // Fields 16 and 17 of the line, counted behind the name in parentheses: hundredths of a second.
    let children: Vec<f64> =
        read("stat").rsplit(") ").next().unwrap_or("").split(' ').skip(13).take(2).flat_map(str::parse).collect();
    own.expect("Linux tells the time of a process") / 1e9 + children.iter().sum::<f64>() / 100.0
}

fn open(path: &Path) -> Interpreter {
    let tools = tool::read(SourceId(0), TOOLS, 25.4).expect("a tool table");
    let options = Options {
        drop_in: true,
        style: Style::Ngc,
        control: MotionMode::Continuous(0.0),
        table_units: Units::Inches,
        tools: Some(tools.into()),
        ..Options::default()
    };
    Interpreter::new(SourceId(0), Text::open(path).expect("the program"), options)
}

fn interpret(path: &Path) {
    let mut interpreter = open(path);
    while let Some(step) = interpreter.next_ref() {
        step.expect("a right program");
    }
}

/// What `takt rs274 -g FILE OUT` does.
fn list(path: &Path) {
    let mut out = std::fs::File::create(LISTING).expect("a place for the listing");
    let (mut listing, mut rows) = (Listing::new(25.4), Vec::new());
    let mut interpreter = open(path);
    while let Some(step) = interpreter.next_ref() {
        listing.step(step.expect("a right program"), &mut rows);
        if rows.len() > 1 << 15 {
            out.write_all(&rows).expect("room for the listing");
            rows.clear();
        }
    }
    listing.finish(true, &mut rows);
    out.write_all(&rows).expect("room for the listing");
}

/// Seconds of `rs274`; `None` where it is not installed.
fn peer(folder: &Path, program: &Path, runs: usize) -> Option<f64> {
    let run = || {
        let status = std::process::Command::new("rs274")
            .args(["-g", "-t", "tool.tbl"])
            .arg(program)
            .arg(LISTING)
            .current_dir(folder)
            .env("HOME", folder)
            .stdout(std::process::Stdio::null())
            .stderr(std::process::Stdio::null())
            .status();
        status.ok().inspect(|s| assert!(s.success(), "rs274 refuses {}", program.display()))
    };
    run()?;
    Some(best(runs, || {
        run();
    }))
}
