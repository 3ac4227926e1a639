//! `ngc/NAME.ngc` beside `ngc/NAME.canon`: the interpreter, printed with source lines.
//! `TAKT_BLESS=1 cargo test -p takt-motion --test canon_golden` writes the listings anew; read the difference.

use std::fs;
use std::path::{Path, PathBuf};
use takt_base::SourceId;
use takt_motion::canon::Position;
use takt_motion::ngc::{Interpreter, Options};
use takt_motion::print;

/// Defaults, with work offsets in the other tables than G54; the plate is incremental.
fn options(name: &str) -> Options {
    let offset = |n: f64| Position { x: 10.0 * n, y: -n, z: 0.5 * n, a: 0.0, b: 0.0, c: n };
    let options = Options { work_offsets: [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(offset), ..Options::default() };
    if name == "plate" { options.with_modes(SourceId(0), "G91").unwrap() } else { options }
}

fn programs() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/ngc");
    let files = fs::read_dir(folder).unwrap().map(|f| f.unwrap().path());
    let mut programs: Vec<PathBuf> = files.filter(|p| p.extension().is_some_and(|e| e == "ngc")).collect();
    programs.sort();
    programs
}

fn listing(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let name = path.file_stem().unwrap().to_str().unwrap();
    let steps = Interpreter::new(SourceId(0), text, options(name));
    steps.map(|s| print::line(&s.unwrap_or_else(|d| panic!("{name}: {d:?}")), true) + "\n").collect()
}

#[test]
fn listings_are_as_recorded() {
    let programs = programs();
    assert!(programs.len() >= 18);
    for path in programs {
        let (got, golden) = (listing(&path), path.with_extension("canon"));
        if std::env::var_os("TAKT_BLESS").is_some() {
            fs::write(&golden, &got).unwrap();
        }
        assert_eq!(got, fs::read_to_string(&golden).unwrap_or_default(), "{}", path.display());
    }
}

/// CM-T16: every line of every listing reads back, and prints the same again.
#[test]
fn listings_read_back() {
    for path in programs() {
        for line in listing(&path).lines() {
            let back = print::parse(line).unwrap_or_else(|e| panic!("{line}: {e:?}"));
            let number = back.number.map(|n| format!("N{n:05} ")).unwrap_or_default();
            assert_eq!(number + &print::command(&back.command), line);
        }
    }
}
