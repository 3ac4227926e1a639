//! `takt sim`: runs in virtual time, as fast as it can. The same inputs give the same outputs, bit for bit.

use crate::host::PlcHost;
use crate::project::Problem;
use crate::session::{EngineKind, Session, with_stimulus};
use crate::watch::Watch;
use crate::{Status, asserts, duration, report, retain};
use serde_json::json;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use takt_base::Nanos;
use takt_image::retain::Start;
use takt_image::value::Patch;
use takt_motion::machine::Background;
use takt_runtime::{FaultReport, Options, Resource, Stimulus, Virtual, When};
use takt_stdlib::asserts::Asserts;

/// Run in virtual time
#[derive(clap::Args)]
#[command(after_help = "Example: takt sim examples/01-blink --duration 1s --watch main.Lamp --format csv")]
pub struct Args {
    /// Project folder or source files
    #[arg(required = true)]
    project: Vec<PathBuf>,
    /// End after this many scans of all tasks together
    #[arg(long)]
    scans: Option<u64>,
    /// End at this time
    #[arg(long, value_parser = duration::argument, conflicts_with = "scans")]
    duration: Option<Nanos>,
    /// Period of all periodic tasks, instead of what the project says
    #[arg(long, value_parser = duration::argument)]
    interval: Option<Nanos>,
    /// Write a value before a scan: 'main.level=42@3'; the first scan is 1
    #[arg(long = "set", value_name = "PATH=VALUE@SCAN")]
    sets: Vec<String>,
    /// Values from a CSV file
    #[arg(long, value_name = "FILE.csv")]
    stimulus: Option<PathBuf>,
    /// Variables to show, separated by commas
    #[arg(long, value_name = "PATH,...", conflicts_with = "dump")]
    watch: Option<String>,
    /// Show all variables (the default)
    #[arg(long)]
    dump: bool,
    /// json: the state after the last scan; csv: a row a scan
    #[arg(long, default_value = "json", value_parser = ["json", "csv"])]
    format: String,
    #[arg(long, default_value = "native", value_parser = ["native", "interp"])]
    engine: String,
    /// Write the set points and actual positions of the axes
    #[arg(long, value_name = "FILE.csv")]
    trace: Option<PathBuf>,
    /// Start with the retained values of this file, and write them there at the end
    #[arg(long, value_name = "FILE")]
    retain: Option<PathBuf>,
    /// With --retain: a cold start, which keeps PERSISTENT values alone
    #[arg(long, requires = "retain")]
    cold: bool,
    #[command(flatten)]
    profile: super::Profile,
}

/// How long a simulation without an end of its own runs.
const DEFAULT_DURATION: Nanos = Nanos::from_secs(1);

pub fn run(args: Args) -> Status {
    super::finish(execute(&args))
}

fn execute(args: &Args) -> Result<Status, Problem> {
    let Some(mut session) = Session::open(&args.project, args.profile.get())? else { return Ok(Status::Wrong) };
    if let Some(interval) = args.interval {
        if interval <= Nanos::ZERO {
            eprintln!("error: --interval 0s is no period; write for example --interval 10ms");
            return Ok(Status::Usage);
        }
        let tasks = session.image.tasks.iter_mut();
        tasks.filter_map(|t| t.interval.as_mut()).for_each(|i| *i = interval);
    }
    let session = session;
    takt_runtime::realtime::on_program_thread(|| simulate(args, &session)).map_err(|e| Problem::thread(&e))?
}

fn simulate(args: &Args, session: &Session) -> Result<Status, Problem> {
    let watch = match &args.watch {
        Some(list) => Watch::paths(&session.image, list).map_err(|e| Problem::access(&e))?,
        None => Watch::all(&session.image),
    };
    let machine = session.machine(Background::Inline);
    let engine = if args.engine == "interp" { EngineKind::Interpreter } else { EngineKind::Native };
    let options = Options { measure: false, ..session.options()? };
    let asserts = Asserts::default();
    let host = PlcHost::new(machine.clone(), asserts.clone());
    let resource = session.resource(host, engine, options)?;
    let start = if args.cold { Start::Cold } else { Start::Warm };
    let resource = match &args.retain {
        Some(file) => retain::restore(&session.image, resource, file, start),
        None => resource,
    };
    let mut resource = with_stimulus(resource, stimulus(args, session)?);
    drive(args, session, &watch, &mut resource)?;
    if let Some(file) = &args.retain {
        let failed = |e| Problem::File(takt_base::Code::FileError, format!("can't write {}: {e}", file.display()));
        retain::save(&session.image, &resource, file).map_err(failed)?;
    }
    if let Some(path) = &args.trace {
        report::write_trace(path, machine.borrow().trace(), &session.machine)?;
    }
    let fault = resource.fault_reports().into_iter().next();
    if args.format == "json" {
        print_json(session, &watch, &resource, fault.as_ref());
    }
    asserts::report(&asserts.borrow(), &session.image.types);
    report::faults(&resource);
    Ok(if fault.is_some() { Status::Fault } else { Status::Success })
}

/// Runs to the end that the arguments or the project ask for; prints the rows of CSV on the way.
fn drive(args: &Args, session: &Session, watch: &Watch, resource: &mut Resource) -> Result<(), Problem> {
    let image = session.image.clone();
    let stop_when = session.stop_when()?;
    let deadline = match (args.scans, args.duration) {
        (Some(_), _) => None,
        (None, Some(d)) => Some(d),
        (None, None) => Some(session.duration()?.unwrap_or(DEFAULT_DURATION)),
    };
    let csv = args.format == "csv";
    if csv {
        say!("scan,time_ns,{}", watch.names().map(cell).collect::<Vec<_>>().join(","));
    }
    if args.scans == Some(0) {
        return Ok(());
    }
    let mut clock = Virtual::new();
    let never = AtomicBool::new(false);
    resource.run_until(&mut clock, deadline, &never, &mut |scan, memory| {
        if csv {
            let cells = watch.values(&image, memory).map(|v| v.map_or_else(String::new, |v| cell(&v.to_string())));
            say!("{},{},{}", scan.scan, scan.now.0, cells.collect::<Vec<_>>().join(","));
        }
        args.scans.is_none_or(|n| scan.scan < n) && !report::is_true(&image, stop_when.as_ref(), memory)
    });
    Ok(())
}

/// A cell of CSV, quoted where it must be.
fn cell(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

fn print_json(session: &Session, watch: &Watch, resource: &Resource, fault: Option<&FaultReport>) {
    let counts = resource.counts();
    let fault = fault.map(|f| {
        json!({ "code": f.code.text(), "message": f.message, "file": f.file, "line": f.line, "pou": f.pou, "task": f.task, "time_ns": f.time.0 })
    });
    let document = json!({
        "scans": counts.scans,
        "time_ns": counts.now.0,
        "fault": fault,
        "vars": watch.json(&session.image, resource.memory()),
    });
    say!("{}", serde_json::to_string_pretty(&document).unwrap_or_default());
}

/// The stimulus file, then the `--set` values.
fn stimulus(args: &Args, session: &Session) -> Result<Stimulus, Problem> {
    let mut stimulus = session.stimulus(args.stimulus.as_deref())?;
    for set in &args.sets {
        let (path, value, scan) = parse_set(set).ok_or_else(|| {
            Problem::File(
                takt_base::Code::BadValueText,
                format!("--set '{set}': write PATH=VALUE@SCAN, for example 'main.level=42@3'"),
            )
        })?;
        let patch = Patch::from_path(&session.image, path, value).map_err(|e| Problem::access(&e))?;
        stimulus.push(When::Scan(scan), patch);
    }
    Ok(stimulus)
}

/// Path, value and scan; without `@SCAN` the first scan is meant.
fn parse_set(text: &str) -> Option<(&str, &str, u64)> {
    let (path, rest) = text.split_once('=')?;
    match rest.rsplit_once('@') {
        Some((value, scan)) => Some((path, value, scan.trim().parse().ok().filter(|s| *s > 0)?)),
        None => Some((path, rest, 1)),
    }
}
