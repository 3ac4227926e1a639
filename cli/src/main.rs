//! The `takt` command. One file a subcommand; the forms are a contract, see docs/guide/command-line.md.

/// `println!`, but a reader that has gone (`takt explain | head`) is no error.
macro_rules! say {
    ($($arg:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stdout(), $($arg)*);
    }};
}

mod asserts;
mod commands;
mod diagnostics;
mod duration;
mod host;
mod json;
mod progress;
mod project;
mod report;
mod retain;
mod session;
mod subroutines;
mod surroundings;
mod test_report;
mod watch;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(
    name = "takt",
    version,
    about = "Soft-PLC with integrated motion",
    after_help = "Example: takt run examples/02-plotter"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    New(commands::new::Args),
    Check(commands::check::Args),
    Build(commands::build::Args),
    Run(commands::run::Args),
    Sim(commands::sim::Args),
    Test(commands::test::Args),
    Bench(commands::bench::Args),
    Explain(commands::explain::Args),
    Gcode(commands::gcode::Args),
    Rs274(commands::rs274::Args),
}

/// Exit status of the process.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Status {
    /// Done.
    Success = 0,
    /// The user's program or project is wrong.
    Wrong = 1,
    /// The command line is wrong.
    Usage = 2,
    /// A run ended in a fault.
    Fault = 3,
}

fn main() -> std::process::ExitCode {
    let status = match Cli::parse().command {
        Command::New(a) => commands::new::run(a),
        Command::Check(a) => commands::check::run(a),
        Command::Build(a) => commands::build::run(a),
        Command::Run(a) => commands::run::run(a),
        Command::Sim(a) => commands::sim::run(a),
        Command::Test(a) => commands::test::run(a),
        Command::Bench(a) => commands::bench::run(a),
        Command::Explain(a) => commands::explain::run(a),
        Command::Gcode(a) => commands::gcode::run(a),
        Command::Rs274(a) => commands::rs274::run(a),
    };
    std::process::ExitCode::from(status as u8)
}
