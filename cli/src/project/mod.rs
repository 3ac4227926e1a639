//! What the user names on the command line: a folder with `takt.toml`, or source files. Read into one [`Project`].

mod file;
mod load;
mod machine;

pub use file::ProjectFile;
pub use load::{Problem, Project, load, parse_keys, read, unreadable, write};
pub use machine::{machine, time};

/// All keys of the project file, for `takt explain takt.toml`.
pub const REFERENCE: &str = include_str!("reference.md");
