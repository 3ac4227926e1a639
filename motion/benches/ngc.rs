//! Rows of part programs per second, beside LinuxCNC's `rs274` where it is installed. `cargo bench -p takt-motion --bench ngc`
//!
//! Each program is written to a temporary file, read from it as `takt rs274` does, and listed into another file; a second column has the
//! interpreter alone. Times are the best of some runs; those of `rs274` are without its start. `-- NAME` runs one program.

mod programs;

use programs::Program;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;
use takt_base::SourceId;
use takt_motion::canon::{MotionMode, Units};
use takt_motion::ngc::{Interpreter, Options, Style, Text, tool};
use takt_motion::print::rs274::Listing;

const TOOLS: &str = "T1 P1 Z0 D0.1 ;a tool of 0.1 inch\n";
const RUNS: usize = 3;

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let folder = std::env::temp_dir().join(format!("takt-ngc-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    std::fs::write(folder.join("tool.tbl"), TOOLS).expect("a tool table");
    let start = peer(&folder, &write(&folder, "empty", "M2\n"), 5);
    println!("{:<14} {:>10} {:>9} {:>13} {:>13} {:>13} {:>7}", "program", "rows", "MB", "interpreted/s", "listed/s", "rs274/s", "ratio");
    for program in programs::all().iter().filter(|p| wanted.is_empty() || wanted.iter().any(|w| p.name.contains(w.as_str()))) {
        row(program, &folder, start);
    }
    let _ = std::fs::remove_dir_all(&folder);
}

fn row(program: &Program, folder: &Path, start: Option<f64>) {
    let path = write(folder, program.name, &program.text);
    let rate = |seconds: f64| program.rows as f64 / seconds;
    let interpreted = rate(best(RUNS, || interpret(&path)));
    let listed = rate(best(RUNS, || list(&path, &folder.join("ours.txt"))));
    let theirs = peer(folder, &path, 1).zip(start).map(|(all, start)| rate((all - start).max(1e-9)));
    let (their_rate, ratio) = theirs.map_or(("-".into(), "-".into()), |t| (format!("{t:.0}"), format!("{:.1}", listed / t)));
    let megabytes = program.text.len() as f64 / 1e6;
    println!(
        "{:<14} {:>10} {megabytes:>9.1} {interpreted:>13.0} {listed:>13.0} {their_rate:>13} {ratio:>7}",
        program.name, program.rows
    );
}

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(format!("{name}.ngc"));
    std::fs::write(&path, text).expect("a temporary file");
    path
}

fn best(runs: usize, mut work: impl FnMut()) -> f64 {
    let mut time = || {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..runs).map(|_| time()).fold(f64::INFINITY, f64::min)
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
    for step in open(path) {
        if let Err(diag) = step {
            panic!("{}: {diag:?}", path.display());
        }
    }
}

/// What `takt rs274 -g FILE OUT` does.
fn list(path: &Path, out: &Path) {
    let mut out = std::io::BufWriter::with_capacity(1 << 16, std::fs::File::create(out).expect("a file for the listing"));
    let (mut listing, mut rows) = (Listing::new(25.4), String::new());
    for step in open(path) {
        rows.clear();
        listing.step(&step.expect("a right program"), &mut rows);
        out.write_all(rows.as_bytes()).expect("room for the listing");
    }
    rows.clear();
    listing.finish(&mut rows);
    out.write_all(rows.as_bytes()).and_then(|()| out.flush()).expect("room for the listing");
}

/// Seconds of `rs274`; `None` where it is not installed.
fn peer(folder: &Path, program: &Path, runs: usize) -> Option<f64> {
    let run = || {
        let status = std::process::Command::new("rs274")
            .args(["-g", "-t", "tool.tbl"])
            .arg(program)
            .arg("theirs.txt")
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
