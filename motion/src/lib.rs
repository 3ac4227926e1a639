//! Motion: part program -> interpreter -> canonical commands -> look-ahead -> interpolation -> position control -> drive.
//! Everything before the ring runs in the background, everything behind it is cyclic. See ARCHITECTURE.md.

pub mod axis;
pub mod canon;
pub mod channel;
pub mod cnc;
pub mod draw;
pub mod drive;
pub mod execution;
pub mod feeder;
pub mod geometry;
pub mod lookahead;
pub mod machine;
pub mod natives;
pub mod ngc;
pub mod plan;
pub mod plant;
pub mod plc;
pub mod plcopen;
pub mod print;
pub mod profile;
pub mod pulse;
pub mod run;
pub mod segment;
pub mod servo;
pub mod spindle;
pub mod stats;
pub mod svg;
pub mod sync;
pub mod toolpath;

pub use machine::{Background, Machine, MachineConfig};

/// Compares with `tests/snapshots/NAME.txt`; with `BLESS=1` in the environment the file is written instead.
#[cfg(test)]
fn snapshot(name: &str, text: &str) {
    let path = format!("{}/tests/snapshots/{name}.txt", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, text).expect("a writable snapshot");
    }
    let want = std::fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(text, want, "{path} is out of date");
}
