//! LinuxCNC's `rs274` beside ours.

use std::path::{Path, PathBuf};
use std::process::Command;
use takt_base::SourceId;
use takt_motion::canon::{MotionMode, Step, Units};
use takt_motion::ngc::{Interpreter, Options, Style, tool};
use takt_motion::print::rs274::Listing;

/// Tools of all programs; lengths in inches, as `rs274` without a configuration has them.
pub const TOOLS: &str =
    "T1 P1 Z0.5 D0.25 ;a\nT2 P2 Z1.0 D0.5 ;b\nT3 P5 X0.1 Z0.3 D0.1 I10 J-20 Q3 ;lathe\nT20 P20 D2\nT99 P99 Z0.7 D0.125\n";

/// A folder that goes away.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("takt-oracle-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        std::fs::write(path.join("tool.tbl"), TOOLS).unwrap();
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).ok();
    }
}

/// True if the oracle is there; says so if not.
pub fn installed() -> bool {
    let found = Command::new("rs274").arg("-h").output().is_ok();
    if !found {
        println!("skipped: rs274 of LinuxCNC is not installed");
    }
    found
}

/// Programs of a corpus file; see its first row.
pub fn programs(text: &str) -> Vec<String> {
    let rows = text.lines().filter(|r| !r.starts_with(";;") && !r.is_empty());
    rows.map(|r| r.replace("\\n", "\n") + "\nM2\n").collect()
}

/// All programs of the corpus, or of those of its files whose name contains TAKT_CORPUS.
pub fn corpus() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    let filter = std::env::var("TAKT_CORPUS").unwrap_or_default();
    let chosen = files.iter().filter(|f| f.display().to_string().contains(&filter));
    chosen.flat_map(|f| programs(&std::fs::read_to_string(f).unwrap())).collect()
}

/// Calls of `rs274 -g`, and whether it ended well.
pub fn theirs(text: &str, folder: &Path) -> (Vec<String>, bool) {
    std::fs::write(folder.join("p.ngc"), text).unwrap();
    std::fs::write(folder.join("p.var"), "").unwrap();
    let mut command = Command::new("timeout");
    command.args(["10", "rs274", "-g", "-t", "tool.tbl", "-v", "p.var", "p.ngc", "p.txt"]);
    let output = command.current_dir(folder).env("HOME", folder).output().unwrap();
    let rows = std::fs::read_to_string(folder.join("p.txt")).unwrap_or_default();
    (calls(&rows), output.status.success())
}

/// Our commands in the drop-in form; an error ends them.
pub fn interpret(text: &str) -> impl Iterator<Item = Result<Step, Box<takt_base::Diag>>> {
    let tools = Some(tool::read(SourceId(0), TOOLS, 25.4).unwrap().into());
    let control = MotionMode::Continuous(0.0);
    let options = Options {
        drop_in: true,
        style: Style::Ngc,
        control,
        table_units: Units::Inches,
        tools,
        calls_max: 9,
        ..Options::default()
    };
    Interpreter::new(SourceId(0), text, options).take(100_000)
}

/// Our calls in the drop-in form, and whether the program ended well.
pub fn ours(text: &str) -> (Vec<String>, bool) {
    let (mut listing, mut out, mut right) = (Listing::new(25.4), Vec::new(), true);
    for step in interpret(text) {
        match step {
            Ok(step) => listing.step(&step, &mut out),
            Err(_) => right = false,
        }
    }
    listing.finish(true, &mut out);
    (calls(&String::from_utf8_lossy(&out)), right)
}

/// Rows of the form `   12 N.....  NAME(...)` without number, and without what LinuxCNC says in its own words.
fn calls(rows: &str) -> Vec<String> {
    let is_call =
        |row: &&str| row.trim_start().split_once(' ').is_some_and(|(n, rest)| n.parse::<u32>().is_ok() && rest.starts_with('N'));
    let rows = rows.lines().filter(is_call).filter_map(|row| row.trim_start().split_once(' ')).map(|(_, rest)| rest.to_owned());
    rows.filter(|row| !row.contains("COMMENT(") && !row.contains("RELOAD_TOOLDATA")).collect()
}

/// The same but for rounding in the last of the decimals.
pub fn same_rows(a: &str, b: &str) -> bool {
    let arguments =
        |row: &str| row.split(['(', ')', ',', ' ']).map(|v| v.trim().to_owned()).filter(|v| !v.is_empty()).collect::<Vec<_>>();
    let (a, b) = (arguments(a), arguments(b));
    let near = |a: f64, b: f64| (a - b).abs() <= 1.01e-4 || (a - b).abs() <= 1e-9 * a.abs();
    let equal = |(a, b): (&String, &String)| a == b || a.parse().is_ok_and(|a| b.parse().is_ok_and(|b| near(a, b)));
    a.len() == b.len() && a.iter().zip(&b).all(equal)
}
