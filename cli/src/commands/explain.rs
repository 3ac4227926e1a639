//! `takt explain CODE`: the page of a diagnostic, fault or of the project file.

use crate::Status;
use takt_base::Code;

/// Explain a code such as P2007, or `takt.toml`
#[derive(clap::Args)]
#[command(after_help = "Example: takt explain P2007")]
pub struct Args {
    /// Code of a message, or `takt.toml` for the keys of the project file
    code: Option<String>,
}

pub fn run(args: Args) -> Status {
    match args.code.as_deref() {
        None => list(),
        Some("takt.toml") => say!("{}", crate::project::REFERENCE.trim_end()),
        Some(text) => match Code::from_text(text) {
            Some(code) => say!("{}", code.page().trim_end()),
            None => return unknown(text),
        },
    }
    Status::Success
}

fn list() {
    for code in Code::ALL {
        say!("{}  {}", code.text(), code.title());
    }
}

fn unknown(text: &str) -> Status {
    eprintln!("error: no code `{text}`; `takt explain` lists all");
    Status::Usage
}
