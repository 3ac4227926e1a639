//! `takt check`: parse and analyse.

use crate::diagnostics;
use crate::project::{self, Problem};
use crate::{Status, session};
use std::path::PathBuf;

/// Parse and analyse a project
#[derive(clap::Args)]
#[command(after_help = "Example: takt check examples/01-blink --format json")]
pub struct Args {
    /// Project folder or source files
    #[arg(required = true)]
    project: Vec<PathBuf>,
    #[arg(long, default_value = "human", value_parser = ["human", "json"])]
    format: String,
    #[command(flatten)]
    profile: super::Profile,
}

pub fn run(args: Args) -> Status {
    let result = project::load(&args.project, args.profile.get()).and_then(|p| session::check(&p));
    let (diags, sources) = match result {
        Ok(compilation) => {
            // The process ends soon: freeing a large program piece by piece would be a tenth of the whole time.
            std::mem::forget((compilation.image, compilation.module));
            (compilation.diags, compilation.sources)
        }
        Err(Problem::Diags(diags, sources)) => (diags, sources),
        Err(problem) => {
            problem.print();
            return Status::Wrong;
        }
    };
    if args.format == "json" {
        let all: Vec<_> = diags.iter().map(|d| diagnostics::json(d, &sources)).collect();
        say!("{}", serde_json::to_string_pretty(&all).unwrap_or_default());
    } else {
        diagnostics::print(&diags, &sources);
    }
    if diagnostics::any_error(&diags) { Status::Wrong } else { Status::Success }
}
