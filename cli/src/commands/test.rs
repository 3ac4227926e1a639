//! `takt test`: runs the unit tests of a project, each in a fresh memory and in virtual time.

use crate::host::PlcHost;
use crate::project::Problem;
use crate::session::{EngineKind, Session};
use crate::test_report::{Failed, Outcome, Report};
use crate::{Status, asserts};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use takt_base::Nanos;
use takt_compiler::hir::Test;
use takt_motion::machine::Background;
use takt_runtime::{Options, Resource, Virtual};
use takt_stdlib::asserts::{AssertLog, Asserts};

/// Run the unit tests of a project
#[derive(clap::Args)]
#[command(after_help = "Example: takt test examples/04-tested --format tap")]
pub struct Args {
    /// Project folder or source files
    #[arg(required = true)]
    project: Vec<PathBuf>,
    /// Run the tests whose name or program contains this text, in any case
    #[arg(long, value_name = "TEXT")]
    filter: Option<String>,
    #[arg(long, default_value = "human", value_parser = ["human", "tap", "junit", "json"])]
    format: String,
    #[arg(long, default_value = "native", value_parser = ["native", "interp"])]
    engine: String,
    #[command(flatten)]
    profile: super::Profile,
}

pub fn run(args: Args) -> Status {
    super::finish(execute(&args))
}

fn execute(args: &Args) -> Result<Status, Problem> {
    let opened = Session::open_tests(&args.project, args.profile.get());
    if !matches!(opened, Ok(Some(_))) && args.format == "tap" {
        say!("TAP version 14\nBail out! the project is wrong");
    }
    let Some((session, tests)) = opened? else { return Ok(Status::Wrong) };
    let ran = takt_runtime::realtime::on_program_thread(|| run_all(args, &session, tests));
    let report = ran.map_err(|e| Problem::thread(&e))??;
    say!("{}", report.text(&args.format).trim_end());
    Ok(if report.failed() == 0 { Status::Success } else { Status::Wrong })
}

fn run_all(args: &Args, session: &Session, tests: Vec<Test>) -> Result<Report, Problem> {
    let filter = args.filter.as_ref().map(|f| f.to_lowercase());
    let wanted = |t: &Test| filter.as_ref().is_none_or(|f| [&t.name, &t.pou].iter().any(|n| n.to_lowercase().contains(f)));
    let chosen = tests.into_iter().enumerate().filter(|(_, t)| wanted(t));
    let outcomes = chosen.map(|(task, test)| run_one(args, session, task, test)).collect::<Result<_, _>>()?;
    Ok(Report { project: session.name.clone(), outcomes })
}

/// A test, from a memory with initial values, until its scans are over or it faults.
fn run_one(args: &Args, session: &Session, task: usize, test: Test) -> Result<Outcome, Problem> {
    let start = Instant::now();
    let log = Asserts::default();
    let mut image = session.image.clone();
    image.tasks = image.tasks.into_iter().skip(task).take(1).collect();
    let interval = image.tasks.first().and_then(|t| t.interval).unwrap_or(Nanos(1));
    let engine = if args.engine == "interp" { EngineKind::Interpreter } else { EngineKind::Native };
    let options = Options { measure: false, run_down: Nanos::ZERO, ..session.options()? };
    let host = PlcHost::new(session.machine(Background::Inline), log.clone());
    let mut resource = session.resource_of(image, host, engine, options)?;
    let never = AtomicBool::new(false);
    resource.run_until(&mut Virtual::new(), None, &never, &mut |scan, _| scan.scan < test.scans);
    let failures = failures(&log.borrow(), &resource, interval);
    let (passed, failed) = (log.borrow().passed, log.borrow().failed);
    Ok(Outcome { scans: resource.counts().scans, time: start.elapsed(), passed, failed, failures, test })
}

/// Assertions in order, then the fault.
fn failures(log: &AssertLog, resource: &Resource, interval: Nanos) -> Vec<Failed> {
    let scan = |now: Nanos| (now.0 / interval.0.max(1)) as u64 + 1;
    let assertions = log.failures().iter().map(|f| {
        let shown = asserts::show(f, &resource.image().types);
        let text = shown.to_string();
        Failed { kind: "assertion", file: shown.file, line: shown.line, scan: scan(f.now), text }
    });
    let faults = resource.fault_reports().into_iter().map(|f| Failed {
        kind: f.code.text(),
        text: format!("fault {}: {} in {}", f.code.text(), f.message, f.pou),
        scan: scan(f.time),
        file: f.file,
        line: f.line,
    });
    assertions.chain(faults).collect()
}
