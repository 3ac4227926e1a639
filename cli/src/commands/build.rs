//! `takt build`: writes a compiled image.

use crate::Status;
use crate::project::{self, Problem};
use crate::session::Session;
use std::path::PathBuf;

/// Write a compiled image that `takt run FILE` starts without the compiler
#[derive(clap::Args)]
#[command(after_help = "Example: takt build examples/01-blink -o blink.takt && takt run blink.takt")]
pub struct Args {
    /// Project folder or source files
    #[arg(required = true)]
    project: Vec<PathBuf>,
    /// Image file
    #[arg(short, long)]
    output: PathBuf,
    #[command(flatten)]
    profile: super::Profile,
}

pub fn run(args: Args) -> Status {
    super::finish(execute(&args))
}

fn execute(args: &Args) -> Result<Status, Problem> {
    let Some(session) = Session::open(&args.project, args.profile.get())? else { return Ok(Status::Wrong) };
    let bytes = takt_image::encode::encode(&session.image);
    project::write(&args.output, &bytes)?;
    eprintln!("wrote {}: {} bytes, {} of them code", args.output.display(), bytes.len(), session.image.code.len());
    Ok(Status::Success)
}
