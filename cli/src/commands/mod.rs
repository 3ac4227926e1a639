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
