//! LinuxCNC's stand-alone interpreter beside ours: the same moves, dwells and modes in the same order for 300 generated programs.
//! Not compared: G94, which forgets the feed there and keeps it here. Skips itself, with a note, where `rs274` (Debian: linuxcnc-uspace) is not installed.

mod common;

use common::programs::{Random, program};
use std::path::{Path, PathBuf};
use std::process::Command;
use takt_base::SourceId;
use takt_motion::ngc::{Interpreter, Options};
use takt_motion::print;

/// Half a digit of each of two roundings to 4 decimals.
const TOLERANCE: f64 = 1.01e-4;

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("takt-rs274-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).ok();
    }
}

/// Rows of `rs274 -g` between its prologue and its epilogue, and whether it ended well. Home, parameters and tools are this folder's.
fn oracle(text: &str, folder: &Path) -> (Vec<String>, bool) {
    std::fs::write(folder.join("p.ngc"), text).unwrap();
    std::fs::remove_file(folder.join("p.var")).ok();
    let mut command = Command::new("rs274");
    command.args(["-g", "-v", "p.var", "p.ngc", "p.txt"]).current_dir(folder).env("HOME", folder);
    let output = command.output().unwrap();
    let rows = std::fs::read_to_string(folder.join("p.txt")).unwrap();
    let calls = rows.lines().filter_map(call).skip_while(|row| row != "ON_RESET()").take_while(|row| !row.starts_with("SET_G5X"));
    (calls.filter(|row| compared(row)).collect(), output.status.success())
}

/// The call of a row such as `   12 N.....  STRAIGHT_FEED(...)`.
fn call(row: &str) -> Option<String> {
    let mut words = row.trim_start().splitn(3, char::is_whitespace);
    let (number, label) = (words.next()?, words.next()?);
    (number.parse::<u32>().is_ok() && label.starts_with('N')).then(|| words.next().unwrap_or("").trim().to_owned())
}

/// Commands that both write with the same arguments.
const COMPARED: [&str; 13] = [
    "STRAIGHT_TRAVERSE",
    "STRAIGHT_FEED",
    "ARC_FEED",
    "DWELL",
    "SET_FEED_RATE",
    "SELECT_PLANE",
    "USE_LENGTH_UNITS",
    "SET_MOTION_CONTROL_MODE",
    "FLOOD_ON",
    "FLOOD_OFF",
    "MIST_ON",
    "MIST_OFF",
    "MESSAGE",
];

const MOVES: [&str; 3] = ["STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"];

fn compared(row: &str) -> bool {
    row.split_once('(').is_some_and(|(name, _)| COMPARED.contains(&name))
}

/// Our rows behind the prologue and before what M2 brings back.
fn ours(text: &str) -> (Vec<String>, bool) {
    let (mut rows, mut right) = (Vec::new(), true);
    let last = text.lines().count() as u32;
    for step in Interpreter::new(SourceId(0), text, Options::default()) {
        match step {
            Ok(step) if step.block > 0 && step.line < last => rows.push(print::command(&step.command)),
            Ok(_) => {}
            Err(_) => right = false,
        }
    }
    rows.retain(|row| compared(row));
    (rows, right)
}

fn same(a: &str, b: &str) -> bool {
    let arguments = |row: &str| row.split(['(', ')', ',']).map(|v| v.trim().to_owned()).collect::<Vec<_>>();
    let (a, b) = (arguments(a), arguments(b));
    let near = |a: &f64, b: &f64| (a - b).abs() <= TOLERANCE;
    let equal = |(a, b): (&String, &String)| a == b || a.parse().is_ok_and(|a| b.parse().is_ok_and(|b| near(&a, &b)));
    a.len() == b.len() && a.iter().zip(&b).all(equal)
}

fn installed() -> bool {
    let found = Command::new("rs274").arg("--help").output().is_ok();
    if !found {
        println!("skipped: rs274 of LinuxCNC is not installed");
    }
    found
}

fn compare(text: &str, folder: &Folder) -> usize {
    let (theirs, their_end) = oracle(text, &folder.0);
    let (ours, our_end) = ours(text);
    for (i, (a, b)) in ours.iter().zip(&theirs).enumerate() {
        assert!(same(a, b), "row {i}: ours {a}, LinuxCNC's {b}\n{text}");
    }
    // LinuxCNC carries out a wrong block up to the error, we do nothing of it.
    let moves = |rows: &[String]| rows.iter().filter(|r| MOVES.iter().any(|m| r.starts_with(m))).count();
    assert_eq!((moves(&ours), our_end), (moves(&theirs), their_end), "{text}");
    assert!(ours.len() == theirs.len() || (!our_end && ours.len() < theirs.len()), "{text}");
    ours.len()
}

#[test]
fn commands_are_those_of_linuxcnc() {
    if !installed() {
        return;
    }
    let (folder, mut random) = (Folder::new("moves"), Random(274));
    let rows: usize = (0..300).map(|_| compare(&program(&mut random, 40), &folder)).sum();
    assert!(rows > 300 * 20, "{rows}");
    println!("{rows} rows of 300 programs agree");
}

/// What is wrong for LinuxCNC is wrong here, and the rows before the error are the same; so is the order within a block.
#[test]
fn both_agree_on_single_blocks() {
    if !installed() {
        return;
    }
    let folder = Folder::new("errors");
    let blocks = [
        "M0 G1 X1 Y2 G91 G64 P0.125 G20 G18 M49 M8 S800 F300 (MSG, message)",
        "M9 G4 P1 G19 G1 X1 F5",
        "G20 G91.1 G17 G91 G3 X2 I1 P2 Z1 F10 M7",
        "G1 X1",
        "X1",
        "G80 X1",
        "F100 G2 X10",
        "F100 G2 X20 I5",
        "F100 G2 X20 I10.01",
        "F100 G2 X20 I10.02",
        "F100 G2 X20 R9.9988",
        "F100 G2 X20 R9.998",
        "F100 G2 X0 R10",
        "F100 G2 I10",
        "F100 G2 X10 I5 K5",
        "F100 G2 X10 I5 R5",
        "F100 G90.1 G2 X10 I5",
        "F100 G2 X10 I5 P0",
        "F100 G2 X10 I5 P2",
        "F100 G2 X10 I5 P1.5",
        "F100 G18 G2 X10 I5",
        "F100 G18 G2 X10 J5",
        "G0 G1 X1 F1",
        "G0 X1 X2",
        "G17 G18",
        "M3 M4",
        "M7 M8",
        "M2 M30",
        "G4",
        "G4 P-1",
        "G4 P1 X5",
        "F-1",
        "S-1",
        "T1.5",
        "P5",
        "G0 X1 I5",
        "G0 X1e2",
        "G0 X1 E2",
        "G0 X.",
        "G0 X+1.",
        "G0 X1 (a",
        "G0 X1 (a (b))",
        "G0 X1 )",
        "G0 X1 $",
        "G0 X1 N3",
        "N-3 G0 X1",
        "G 0 x 1 . 5 y - 2",
        "G0",
        "G1",
        "F100 G1",
        "F0 G1 X1",
        "F100 G91 G2 X0 Y0 I5 J5",
        "F100 G2 X200 I100.2",
        "F100 G2 X200 I100.04",
        "G49.9",
        "M300",
        "/G0 X7",
        "G20 G0 X1\nG21 X2\nG91 X1",
        "F10 G20 G1 X1",
        "G0 X1 ; comment",
    ];
    for block in blocks {
        compare(&format!("G21 G17 G90 G91.1\n{block}\nG0 X3\nM2\n"), &folder);
    }
}
