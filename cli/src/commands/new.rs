//! `takt new DIR`: writes a small project that runs.

use crate::Status;
use std::path::{Path, PathBuf};

/// Write a small project that runs
#[derive(clap::Args)]
#[command(after_help = "Example: takt new my-machine && takt run my-machine --duration 5s")]
pub struct Args {
    /// Folder to make; must not exist or be empty
    dir: PathBuf,
    /// What to start from
    #[arg(long, default_value = "blink", value_parser = ["blink", "plotter"])]
    template: String,
}

const BLINK: &[(&str, &str)] = &[
    ("takt.toml", include_str!("../../../examples/01-blink/takt.toml")),
    ("blink.st", include_str!("../../../examples/01-blink/blink.st")),
    ("blink_test.st", include_str!("../../../examples/01-blink/blink_test.st")),
    ("stimulus.csv", include_str!("../../../examples/01-blink/stimulus.csv")),
    ("README.md", include_str!("../../../examples/01-blink/README.md")),
];

const PLOTTER: &[(&str, &str)] = &[
    ("takt.toml", include_str!("../../../examples/02-plotter/takt.toml")),
    ("plotter.st", include_str!("../../../examples/02-plotter/plotter.st")),
    ("plate.nc", include_str!("../../../examples/02-plotter/plate.nc")),
    ("stimulus.csv", include_str!("../../../examples/02-plotter/stimulus.csv")),
    ("README.md", include_str!("../../../examples/02-plotter/README.md")),
];

pub fn run(args: Args) -> Status {
    let files = if args.template == "plotter" { PLOTTER } else { BLINK };
    match write(&args.dir, files) {
        Ok(()) => {
            say!("wrote {}; try: takt run {}", args.dir.display(), args.dir.display());
            Status::Success
        }
        Err(message) => {
            eprintln!("error[C0005]: {message}");
            Status::Wrong
        }
    }
}

fn write(dir: &Path, files: &[(&str, &str)]) -> Result<(), String> {
    if dir.read_dir().is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(format!("{} is not empty; name a new folder", dir.display()));
    }
    std::fs::create_dir_all(dir).map_err(|e| format!("can't make {}: {e}", dir.display()))?;
    for (name, text) in files {
        let path = dir.join(name);
        std::fs::write(&path, text).map_err(|e| format!("can't write {}: {e}", path.display()))?;
    }
    Ok(())
}
