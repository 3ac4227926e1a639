//! `takt bench`: scan time and compile time of a project on this machine.

use crate::host::PlcHost;
use crate::project::{self, Problem};
use crate::session::{self, EngineKind, Session};
use crate::{Status, diagnostics};
use serde_json::json;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use takt_motion::machine::Background;
use takt_runtime::{Options, Resource, Virtual};
use takt_stdlib::asserts::Asserts;

/// Measure scan and compile time
#[derive(clap::Args)]
#[command(after_help = "Example: takt bench examples/01-blink --scans 100000")]
pub struct Args {
    /// Project folder or source files
    #[arg(required = true)]
    project: Vec<PathBuf>,
    /// Scans to measure
    #[arg(long, default_value_t = 10_000)]
    scans: u64,
    #[arg(long, default_value = "human", value_parser = ["human", "json"])]
    format: String,
    #[command(flatten)]
    profile: super::Profile,
}

/// Compilations of which the fastest counts.
const COMPILATIONS: u32 = 5;

pub fn run(args: Args) -> Status {
    super::finish(execute(&args))
}

fn execute(args: &Args) -> Result<Status, Problem> {
    let Some(session) = Session::open(&args.project, args.profile.get())? else { return Ok(Status::Wrong) };
    let compile_ms = compile_ms(args)?;
    takt_runtime::realtime::on_program_thread(|| measure(args, &session, compile_ms)).map_err(|e| Problem::thread(&e))?
}

fn compile_ms(args: &Args) -> Result<f64, Problem> {
    let project = project::load(&args.project, args.profile.get())?;
    let mut best = f64::INFINITY;
    for _ in 0..COMPILATIONS {
        let start = Instant::now();
        let compilation = session::compile(&project)?;
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
        debug_assert!(!diagnostics::any_error(&compilation.diags));
    }
    Ok(best)
}

fn measure(args: &Args, session: &Session, compile_ms: f64) -> Result<Status, Problem> {
    let options = Options { measure: true, ..session.options()? };
    let host = PlcHost::new(session.machine(Background::Inline), Asserts::default());
    let mut resource = session.resource(host, EngineKind::Native, options)?;
    let never = AtomicBool::new(false);
    let scans = args.scans.max(1);
    resource.run_until(&mut Virtual::new(), None, &never, &mut |scan, _| scan.scan < scans);
    crate::report::faults(&resource);
    print(args, session, &resource, compile_ms);
    Ok(if resource.faults().is_empty() { Status::Success } else { Status::Fault })
}

/// Scan times of the task that ran most.
fn print(args: &Args, session: &Session, resource: &Resource, compile_ms: f64) {
    let Some(stats) = resource.stats().max_by_key(|s| s.scans) else { return };
    let h = &stats.scan_time;
    let (min, median, p99, max) = (h.min().0, h.quantile(0.5).0, h.quantile(0.99).0, h.max().0);
    let (code, data) = (session.image.code.len(), session.image.memory.data.size);
    if args.format == "json" {
        let document = json!({
            "scans": stats.scans,
            "ns_per_scan": { "min": min, "median": median, "p99": p99, "max": max },
            "compile_ms": compile_ms,
            "code_bytes": code,
            "data_bytes": data,
        });
        say!("{}", serde_json::to_string_pretty(&document).unwrap_or_default());
        return;
    }
    say!("scans       {}", stats.scans);
    say!("scan time   min {min} ns, median {median} ns, p99 {p99} ns, max {max} ns");
    say!("compile     {compile_ms:.2} ms");
    say!("size        {code} bytes of code, {data} bytes of data");
}
