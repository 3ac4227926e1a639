//! One module a subcommand: `Args` for clap and `run`.

pub mod bench;
pub mod build;
pub mod check;
pub mod explain;
pub mod gcode;
mod gcode_plan;
pub mod new;
pub mod rs274;
pub mod run;
pub mod sim;
pub mod test;

use crate::Status;
use crate::project::Problem;

/// The language profile, on every command that compiles.
#[derive(clap::Args)]
pub struct Profile {
    /// Language profile of every source file [default: as takt.toml says, else std; codesys2 for .exp]
    #[arg(long = "profile", value_name = "NAME", value_parser = takt_base::Profile::ALL.map(takt_base::Profile::name))]
    name: Option<String>,
}

impl Profile {
    /// The profile that was named.
    pub fn get(&self) -> Option<takt_base::Profile> {
        self.name.as_deref().and_then(takt_base::Profile::from_name)
    }
}

/// The status of a command; a problem is shown first.
fn finish(result: Result<Status, Problem>) -> Status {
    result.unwrap_or_else(|problem| {
        problem.print();
        Status::Wrong
    })
}
