//! What a program does wrong at run time: exit status 3, the right code, file and line on both engines, the process alive to say it.

mod common;

use common::{file, folder, takt, takt_in};
use serde_json::json;
use std::fs;

/// Program text, code and line of its fault.
const PROGRAMS: &[(&str, &str, u64)] = &[
    ("PROGRAM main\nVAR a : INT := 10; b : INT; END_VAR\n  a :=\n    a / b;\nEND_PROGRAM", "F0701", 4),
    ("PROGRAM main\nVAR a : ARRAY[1..5] OF INT; i : INT; END_VAR\n  i := i + 1;\n  a[i] := i;\nEND_PROGRAM", "F0702", 4),
    ("PROGRAM main\nVAR p : INT (0..9); n : INT; END_VAR\n  n := n + 4;\n  p := n;\nEND_PROGRAM", "F0703", 4),
    (
        "FUNCTION f : INT\nVAR_INPUT n : INT; END_VAR\n  f := f(n + 1) + 1;\nEND_FUNCTION\nPROGRAM main\nVAR a : INT; END_VAR\n  a := f(1);\nEND_PROGRAM",
        "F0704",
        3,
    ),
    ("PROGRAM main\nVAR n : DINT; END_VAR\n  WHILE TRUE DO n := n + 1; END_WHILE;\nEND_PROGRAM", "F0705", 3),
    ("PROGRAM main\nVAR s : STRING; END_VAR\n  REPEAT s := CONCAT('a', 'b'); UNTIL s = 'c' END_REPEAT;\nEND_PROGRAM", "F0705", 3),
    ("PROGRAM main\nVAR s : STRING := 'abc'; i : INT := 5; c : CHAR; END_VAR\n  c := s[i];\nEND_PROGRAM", "F0707", 3),
    ("PROGRAM main\nVAR i, n : INT; END_VAR\n  FOR i := 1 TO 5 BY n DO ; END_FOR;\nEND_PROGRAM", "F0710", 3),
];

#[test]
fn faults_have_code_file_and_line() {
    for (i, (text, code, line)) in PROGRAMS.iter().enumerate() {
        let path = file(&format!("fault-{i}"), "wrong.st", text);
        for engine in ["native", "interp"] {
            let ran = takt(&["sim", &path, "--scans", "10", "--engine", engine]);
            assert_eq!(ran.status, 3, "{text}\n{}", ran.stderr);
            let fault = &ran.json()["fault"];
            assert_eq!((&fault["code"], &fault["line"]), (&json!(code), &json!(line)), "{engine}: {text}");
            assert!(fault["file"].as_str().unwrap().ends_with("wrong.st") && fault["message"].is_string());
            assert!(ran.stderr.contains(code) && ran.stderr.contains("takt explain"), "{}", ran.stderr);
        }
    }
}

#[test]
fn the_innermost_unit_is_named() {
    let text = "FUNCTION quotient : INT
VAR_INPUT n : INT; END_VAR
  quotient := 100 / n;
END_FUNCTION
FUNCTION_BLOCK Pump
VAR_INPUT speed : INT; END_VAR
VAR n : INT; END_VAR
  n := quotient(speed);
END_FUNCTION_BLOCK
PROGRAM main
VAR p : Pump; END_VAR
  p(speed := 0);
END_PROGRAM
";
    let path = file("innermost", "pump.st", text);
    for engine in ["native", "interp"] {
        let fault = takt(&["sim", &path, "--engine", engine]).json()["fault"].clone();
        assert_eq!((&fault["pou"], &fault["line"], &fault["code"]), (&json!("quotient"), &json!(3), &json!("F0701")), "{engine}");
    }
}

const TWO_TASKS: &str = "PROGRAM Bad
VAR n : INT := 3; lamp AT %QX0.0 : BOOL; END_VAR
  lamp := TRUE;
  n := n - 1;
  n := n + 0 / n;
END_PROGRAM
PROGRAM Good
VAR count : INT; lamp AT %QX0.1 : BOOL; END_VAR
  count := count + 1;
  lamp := TRUE;
END_PROGRAM
CONFIGURATION c
  RESOURCE r ON PC
    TASK A (INTERVAL := T#10ms, PRIORITY := 1);
    TASK B (INTERVAL := T#10ms, PRIORITY := 2);
    PROGRAM bad WITH A : Bad;
    PROGRAM good WITH B : Good;
  END_RESOURCE
END_CONFIGURATION
";

#[test]
fn another_task_goes_on_where_the_project_says_so() {
    let dir = folder("two-tasks");
    fs::write(dir.join("two.st"), TWO_TASKS).unwrap();
    let args = ["sim", ".", "--duration", "200ms", "--watch", "good.count,%QX0.0,%QX0.1"];
    fs::write(dir.join("takt.toml"), "[run]\non_fault = \"stop-task\"\n").unwrap();
    let ran = takt_in(&dir, &args);
    assert_eq!(ran.status, 3, "{}", ran.stderr);
    assert_eq!(ran.json()["vars"], json!({"good.count": 20, "%QX0.0": false, "%QX0.1": true}));
    fs::write(dir.join("takt.toml"), "[run]\non_fault = \"stop-resource\"\n").unwrap();
    let ran = takt_in(&dir, &args);
    assert_eq!((ran.status, &ran.json()["vars"]), (3, &json!({"good.count": 2, "%QX0.0": false, "%QX0.1": false})));
    fs::write(dir.join("takt.toml"), "[run]\non_fault = \"stop-tsak\"\n").unwrap();
    let ran = takt_in(&dir, &args);
    assert!(ran.status == 1 && ran.stderr.contains("C0001"), "{}", ran.stderr);
}

/// A wrong block stops before its motion: what stands before it was done, the axes stay there, line and column are told.
#[test]
fn a_wrong_block_stops_before_its_motion() {
    let dir = folder("wrong-block");
    let project = "[run]\nstop_when = \"main.Over\"\nduration = \"10s\"\n[[motion.axis]]\nname = \"AxisX\"\ntravel_max_mm = 100.0\n[[motion.channel]]\nname = \"Cnc1\"\naxes = [\"AxisX\"]\nhandshake = false\n";
    let program = "PROGRAM main
VAR_EXTERNAL AxisX : AXIS_REF; Cnc1 : CNC_REF; END_VAR
VAR power : MC_Power; load : CNC_LoadProgram; job : CNC_Run; pos : MC_ReadActualPosition; Over : BOOL; wait : TON; END_VAR
  power(Axis := AxisX, Enable := TRUE);
  load(Cnc := Cnc1, Execute := power.Status, FileName := 'part.nc');
  job(Cnc := Cnc1, Execute := load.Done, ProgramID := load.ProgramID);
  pos(Axis := AxisX, Enable := TRUE);
  wait(IN := job.Error OR load.Error, PT := T#500ms);
  Over := wait.Q;
END_PROGRAM
";
    fs::write(dir.join("takt.toml"), project).unwrap();
    fs::write(dir.join("main.st"), program).unwrap();
    let watch = "main.load.Error,main.load.ErrorID,main.job.Error,main.job.ErrorID,main.pos.Position";
    let run = |part: &str| {
        fs::write(dir.join("part.nc"), part).unwrap();
        let ran = takt_in(&dir, &["run", ".", "--trace", "t.csv"]);
        let sim = takt_in(&dir, &["sim", ".", "--watch", watch]);
        assert_eq!(sim.status, 0, "{}", sim.stderr);
        (ran.stdout, sim.json()["vars"].clone())
    };
    // Travel is found while the program runs: the first move is made, the second is not begun.
    let (report, vars) = run("G21 G90 G94 F6000\nG1 X20\nG1 X120\nM2\n");
    assert_eq!((&vars["main.job.Error"], &vars["main.load.Error"]), (&json!(true), &json!(false)), "{report}");
    assert!((vars["main.pos.Position"].as_f64().unwrap() - 20.0).abs() < 0.01, "{vars}");
    assert!(report.contains("line 3"), "{report}");
    // What is wrong without moving is found when the file is loaded.
    let (report, vars) = run("G21 G90 G94 F6000\nG1 X20\nG1 X3o\nM2\n");
    assert_eq!((&vars["main.load.Error"], &vars["main.load.ErrorID"]), (&json!(true), &json!(0x0601)), "{report}");
    assert_eq!(vars["main.pos.Position"], json!(0.0));
    assert!(report.contains("line 3, column 6"), "{report}");
}
