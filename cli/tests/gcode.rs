//! `takt gcode` with tables and subroutines, and `takt rs274`.

mod common;

use common::{folder, takt};
use std::fs;

const PROGRAM: &str = "N10 G21 F100\n(print, hello #5221)\nG10 L2 P2 X25.4\no<helper> call [3]\n#31=4\nT1 M6 G43\nM30\n";
const HELPER: &str = "o<helper> sub\nG1 X#1\no<helper> endsub [#1]\n";

/// A folder with the program, its subroutine, a tool table and parameters.
fn project(name: &str) -> std::path::PathBuf {
    let folder = folder(name);
    for (file, text) in [("p.ngc", PROGRAM), ("helper.ngc", HELPER), ("t.tbl", "T1 P1 Z0.5 D0.25 ;a\n"), ("v.var", "31\t1.0\n")] {
        fs::write(folder.join(file), text).unwrap();
    }
    folder
}

#[test]
fn rs274_lists_calls_and_writes_parameters() {
    let folder = project("rs274");
    let path = |name: &str| folder.join(name).display().to_string();
    let ran = takt(&["rs274", "-g", "-t", &path("t.tbl"), "-v", &path("v.var"), &path("p.ngc"), &path("out.txt")]);
    assert_eq!((ran.status, ran.stdout.as_str()), (0, " hello 0.000000\n"), "{}", ran.stderr);
    let listing = fs::read_to_string(folder.join("out.txt")).unwrap();
    let rows: Vec<&str> = listing.lines().collect();
    assert_eq!(rows[0], "    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)");
    assert_eq!(rows[6], "    7 N10    SET_FEED_RATE(100.0000)");
    assert_eq!(rows[9], "   10 N..... STRAIGHT_FEED(3.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)");
    assert!(listing.contains("USE_TOOL_LENGTH_OFFSET(0.0000 0.0000 12.7000, "), "{listing}");
    assert!(listing.ends_with("PROGRAM_END()\n   24 N..... ON_RESET()\n   25 N..... ON_RESET()\n"), "{listing}");
    let parameters = fs::read_to_string(folder.join("v.var")).unwrap();
    assert!(parameters.contains("31\t4.000000\n") && parameters.contains("5241\t1.000000\n"), "{parameters}");
}

#[test]
fn rs274_stops_at_errors_or_goes_on() {
    let folder = folder("rs274-errors");
    let path = folder.join("e.ngc").display().to_string();
    fs::write(&path, "G0 X1\nG1 X2\nG0 X3\nM2\n").unwrap();
    let ran = takt(&["rs274", "-g", &path]);
    assert_eq!(ran.status, 1);
    assert!(ran.stderr.contains("N0008") && ran.stderr.contains("\nG1 X2\n"), "{}", ran.stderr);
    assert!(
        ran.stdout.contains("STRAIGHT_TRAVERSE(1.0000") && !ran.stdout.contains("STRAIGHT_TRAVERSE(3.0000"),
        "{}",
        ran.stdout
    );
    let ran = takt(&["rs274", "-g", "-n", "0", &path]);
    assert_eq!(ran.status, 0);
    assert!(ran.stdout.contains("STRAIGHT_TRAVERSE(3.0000") && ran.stdout.contains("PROGRAM_END()"), "{}", ran.stdout);
}

/// Behind an error in a subroutine the main program goes on; an INI file turns M19 and leaves out the rows of the exit.
#[test]
fn rs274_goes_on_behind_the_call_and_reads_the_ini_file() {
    let folder = folder("rs274-unwind");
    let text = "o1 sub\nG0 X[1/0]\nG0 X5\no1 endsub\nM98 P1 L1000000\nG91 G0 X2\nM19 R45\nM2\n";
    fs::write(folder.join("u.ngc"), text).unwrap();
    fs::write(folder.join("u.ini"), "[RS274NGC]\nORIENT_OFFSET = 42\n").unwrap();
    let path = |name: &str| folder.join(name).display().to_string();
    let ran = takt(&["rs274", "-n", "0", "-i", &path("u.ini"), "-g", &path("u.ngc")]);
    let rows: Vec<&str> = ran.stdout.lines().filter_map(|row| row.split_once(" N..... ")).map(|r| r.1).collect();
    assert_eq!(
        rows[6..9],
        [
            "COMMENT(\"interpreter: distance mode changed to incremental\")",
            "STRAIGHT_TRAVERSE(2.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)",
            "ORIENT_SPINDLE(0, 87.0000, 0)"
        ],
        "{}",
        ran.stdout
    );
    assert_eq!(rows[rows.len() - 2..], ["PROGRAM_END()", "ON_RESET()"]);
}

#[test]
fn gcode_takes_tables_and_subroutines() {
    let folder = project("gcode-tables");
    let path = |name: &str| folder.join(name).display().to_string();
    let ran = takt(&["gcode", &path("p.ngc"), "--canon", "--tool-table", &path("t.tbl"), "--params", &path("v.var")]);
    assert_eq!((ran.status, ran.stderr.as_str()), (0, ""));
    assert!(ran.stdout.contains("USE_TOOL_LENGTH_OFFSET(0.5000)\n"), "{}", ran.stdout);
    fs::write(folder.join("helper.ngc"), "o<helper> sub\nG1 X#<nothing>\no<helper> endsub\n").unwrap();
    let ran = takt(&["gcode", &path("p.ngc"), "--check"]);
    assert_eq!(ran.status, 1);
    assert!(ran.stderr.contains("N0017") && ran.stderr.contains("helper.ngc:2:5"), "{}", ran.stderr);
    fs::write(folder.join("t.tbl"), "T1 X\n").unwrap();
    let ran = takt(&["gcode", &path("p.ngc"), "--check", "--tool-table", &path("t.tbl")]);
    assert!(ran.status == 1 && ran.stderr.contains("N0024"), "{}", ran.stderr);
}

/// Dialects, settings, files of called programs, the lenient switch.
#[test]
fn gcode_speaks_dialects() {
    let folder = folder("gcode-dialects");
    let path = |name: &str| folder.join(name).display().to_string();
    fs::write(folder.join("O0002.ngc"), "G0 X#1 Z-5\nM99\n").unwrap();
    fs::write(folder.join("t.nc"), "%\nO0001 (SHAFT)\nG98 G65 P2 A40\nG100 X30\nM30\nO9010\nG1 X#24 F100\nM99\n%\n").unwrap();
    let ran = takt(&["gcode", &path("t.nc"), "--dialect", "fanuc-turn", "--set", "G100=9010", "--canon"]);
    assert_eq!((ran.status, ran.stderr.as_str()), (0, ""), "{}", ran.stdout);
    assert!(ran.stdout.contains("STRAIGHT_TRAVERSE(20.0000, 0.0000, -5.0000"), "{}", ran.stdout);
    assert!(ran.stdout.contains("STRAIGHT_FEED(15.0000, 0.0000, -5.0000"), "{}", ran.stdout);
    let ran = takt(&[
        "gcode",
        &path("t.nc"),
        "--dialect",
        "fanuc-turn",
        "--set",
        "G100=9010",
        "--plan",
        "--limits",
        "v=100,a=1000",
        "--format",
        "json",
    ]);
    assert!(ran.status == 0 && ran.stdout.contains("length_mm"), "{}{}", ran.stdout, ran.stderr);
    let ran = takt(&["gcode", &path("t.nc"), "--dialect", "fanuc-mill", "--check"]);
    assert!(ran.status == 1 && ran.stderr.contains("N0003") && ran.stderr.contains("t.nc:4:1"), "{}", ran.stderr);
    assert_eq!(takt(&["gcode", &path("t.nc"), "--dialect", "fanuc-turn", "--set", "steam", "--check"]).status, 2);
    assert_eq!(takt(&["gcode", &path("t.nc"), "--dialect", "klartext", "--check"]).status, 2);
    fs::write(folder.join("p.gcode"), "m104 s200 ; hot\ng21\ng0 x1\ng1 x2 e0.5 f100\ng92 e0\n").unwrap();
    let strict = takt(&["gcode", &path("p.gcode"), "--check"]);
    assert_eq!(strict.status, 1, "{}", strict.stderr);
    let ran = takt(&["gcode", &path("p.gcode"), "--lenient", "--check", "--canon"]);
    assert!(ran.status == 0 && ran.stderr.matches("N0057").count() == 3, "{}", ran.stderr);
    assert!(ran.stdout.contains("STRAIGHT_FEED(2.0000") && !ran.stdout.contains("SPINDLE"), "{}", ran.stdout);
}
