//! One module a subcommand: `Args` for clap and `run`.

pub mod bench;
pub mod build;
pub mod check;
pub mod explain;
pub mod gcode;
mod gcode_plan;
pub mod new;
pub mod run;
pub mod sim;

use crate::Status;
use crate::project::Problem;

/// The language profile, on every command that compiles.
#[derive(clap::Args)]
pub struct Profile {
    /// Language profile; this version has the standard's alone
    #[arg(long = "profile", default_value = "std", value_parser = ["std"])]
    _profile: String,
}

/// The status of a command; a problem is shown first.
fn finish(result: Result<Status, Problem>) -> Status {
    result.unwrap_or_else(|problem| {
        problem.print();
        Status::Wrong
    })
}
