//! `takt run`: runs in real time until the project says so, a fault, or Ctrl-C.

use crate::host::PlcHost;
use crate::progress::{self, Display, Reporter};
use crate::project::{self, Problem};
use crate::session::{EngineKind, Session, with_stimulus};
use crate::{Status, asserts, duration, report, retain};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::time::Duration;
use takt_base::{Code, Nanos};
use takt_image::retain::Start;
use takt_motion::machine::Background;
use takt_runtime::realtime::{Request, enter, on_program_thread};
use takt_runtime::{Monotonic, Progress};
use takt_stdlib::asserts::Asserts;

/// Run in real time
#[derive(clap::Args)]
#[command(after_help = "Example: takt run examples/02-plotter\nCtrl-C stops with outputs in their safe state.")]
pub struct Args {
    /// Project folder, source files, or an image written by `takt build`
    #[arg(required = true)]
    project: Vec<PathBuf>,
    /// End after this time
    #[arg(long, value_parser = duration::argument)]
    duration: Option<Nanos>,
    /// Write the set points and actual positions of the axes
    #[arg(long, value_name = "FILE.csv")]
    trace: Option<PathBuf>,
    /// Write the commanded and actual path
    #[arg(long, value_name = "FILE.svg")]
    picture: Option<PathBuf>,
    /// Start RETAIN variables from their initial values; PERSISTENT ones keep theirs
    #[arg(long)]
    cold: bool,
    #[command(flatten)]
    profile: super::Profile,
}

/// How often the display is renewed.
const REFRESH: Duration = Duration::from_millis(50);

pub fn run(args: Args) -> Status {
    super::finish(execute(&args))
}

fn execute(args: &Args) -> Result<Status, Problem> {
    let Some(session) = Session::open(&args.project, args.profile.get())? else { return Ok(Status::Wrong) };
    let stop = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&stop);
    let handler = ctrlc::set_handler(move || seen.store(true, Ordering::Relaxed));
    handler.map_err(|e| Problem::File(Code::FileError, format!("can't watch for Ctrl-C: {e}")))?;
    let (reporter, sights) = progress::channel();
    let (started, counters) = mpsc::channel();
    std::thread::scope(|scope| {
        let runner = scope.spawn({
            let (session, stop) = (&session, &stop);
            // The sender goes with the run: an early end drops it, and nobody waits for counters that never come.
            move || on_program_thread(move || real_time(args, session, stop, reporter, started))
        });
        let mut display = Display::new(sights);
        if let Ok(counters) = counters.recv() {
            watch(&mut display, &counters, || runner.is_finished());
        }
        let result = runner.join().unwrap_or_else(|_| Err(std::io::Error::other("the run ended in a panic")));
        display.close();
        let outcome = result.map_err(|e| Problem::thread(&e))??;
        say!("{}", outcome.summary.trim_end());
        Ok(outcome.status)
    })
}

fn watch(display: &mut Display, counters: &Progress, finished: impl Fn() -> bool) {
    while !finished() {
        display.show(counters.read().last_scan);
        std::thread::sleep(REFRESH);
    }
}

struct Outcome {
    status: Status,
    summary: String,
}

/// Everything that happens on the program thread.
fn real_time(
    args: &Args,
    session: &Session,
    stop: &AtomicBool,
    mut reporter: Reporter,
    started: mpsc::Sender<Arc<Progress>>,
) -> Result<Outcome, Problem> {
    let machine = session.machine(Background::Thread);
    let asserts = Asserts::default();
    let host = PlcHost::new(machine.clone(), asserts.clone());
    let resource = session.resource(host, EngineKind::Native, session.options()?)?;
    let start = if args.cold { Start::Cold } else { Start::Warm };
    let resource = retain::restore(&session.image, resource, &session.retain_file(), start);
    let mut resource = with_stimulus(resource, session.stimulus(None)?);
    let (mut sampler, keeper) = retain::keep(&session.image, session.retain_file()).unzip();
    let epoch = resource.program_time();
    let stop_when = session.stop_when()?;
    let deadline = args.duration.or(session.duration()?);
    let real_time = enter(&Request::default());
    let _ = started.send(resource.progress());
    let mut clock = Monotonic::start();
    let image = &session.image;
    resource.run_until(&mut clock, deadline, stop, &mut |scan, memory| {
        reporter.send(scan, &machine.borrow());
        if let Some(sampler) = &mut sampler {
            sampler.sample(scan.now, epoch + scan.now, memory);
        }
        !report::is_true(image, stop_when.as_ref(), memory)
    });
    if let Some(keeper) = keeper {
        keeper.finish(image, &resource);
    }
    let end = machine.borrow().report();
    resource.stop(&mut clock);
    asserts::report(&asserts.borrow(), &image.types);
    report::faults(&resource);
    let machine = machine.borrow();
    let mut summary = format!("{}: {:.2} s, {real_time}\n", session.name, resource.counts().now.as_secs());
    summary += &report::tasks(&resource);
    summary += &asserts::summary(&asserts.borrow());
    summary += &report::machine(&end, &session.machine);
    if let Some(path) = picture_path(args, session) {
        summary += &write_picture(&path, session, machine.trace())?;
    }
    if let Some(path) = &args.trace {
        report::write_trace(path, machine.trace(), &session.machine)?;
    }
    let status = if resource.faults().is_empty() { Status::Success } else { Status::Fault };
    Ok(Outcome { status, summary })
}

fn write_picture(path: &Path, session: &Session, trace: &takt_motion::machine::Trace) -> Result<String, Problem> {
    let Some(svg) = report::picture(&session.name, trace, &session.machine) else { return Ok(String::new()) };
    project::write(path, svg.as_bytes())?;
    Ok(format!("picture: {}\n", path.display()))
}

/// Where the picture goes: the argument, the project file, or a name made of the project's if there is a channel to draw.
fn picture_path(args: &Args, session: &Session) -> Option<PathBuf> {
    let named = args.picture.clone().or_else(|| session.keys.run.picture.as_ref().map(PathBuf::from));
    named.or_else(|| (!session.machine.channels.is_empty()).then(|| PathBuf::from(format!("{}-path.svg", session.name))))
}
