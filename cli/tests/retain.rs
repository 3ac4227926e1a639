//! Retained variables over restarts (IEC 61131-3 reference §10.4, §18.10).

mod common;

use common::{Ran, file, folder, takt};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// One simulated run of a program with a file of retained values.
fn sim(program: &str, retained: &Path, more: &[&str]) -> Ran {
    let retained = retained.display().to_string();
    let args = [&["sim", program, "--retain", &retained][..], more].concat();
    let ran = takt(&args);
    assert_eq!(ran.status, 0, "{ran:?}");
    ran
}

fn vars(ran: &Ran) -> Value {
    ran.json()["vars"].clone()
}

fn ints(ran: &Ran, names: &[&str]) -> Vec<i64> {
    let vars = vars(ran);
    names.iter().map(|n| vars[n].as_i64().unwrap_or_else(|| panic!("{n}: {vars}"))).collect()
}

const SCAN: &[&str] = &["--scans", "1"];

#[test]
fn s18_10_three_counters() {
    let text =
        "PROGRAM Main VAR a : INT := 3; set : BOOL; END_VAR VAR RETAIN b : INT := 1; END_VAR VAR NON_RETAIN c : INT := 2; END_VAR
    IF set THEN a := 30; b := 10; c := 20; END_IF; END_PROGRAM";
    let program = file("s18_10", "main.st", text);
    let stored = folder("s18_10_file").join("deep/retain");
    let names = ["Main.a", "Main.b", "Main.c"];
    assert_eq!(ints(&sim(&program, &stored, SCAN), &names), [3, 1, 2]);
    assert_eq!(ints(&sim(&program, &stored, &["--scans", "1", "--set", "Main.set=TRUE@1"]), &names), [30, 10, 20]);
    assert_eq!(ints(&sim(&program, &stored, SCAN), &names), [3, 10, 2], "warm");
    assert_eq!(ints(&sim(&program, &stored, &["--scans", "1", "--engine", "interp"]), &names), [3, 10, 2], "warm");
    assert_eq!(ints(&sim(&program, &stored, &["--scans", "1", "--cold"]), &names), [3, 1, 2], "cold");
}

#[test]
fn s10_4_restart_matrix() {
    let text = "VAR_GLOBAL g0 : INT; END_VAR VAR_GLOBAL RETAIN g1 : INT; END_VAR VAR_GLOBAL PERSISTENT g2 : INT; END_VAR
    VAR_GLOBAL RETAIN m AT %MW3 : INT; bit AT %MX0.3 : BOOL; END_VAR
    PROGRAM Main VAR a : INT; END_VAR VAR NON_RETAIN b : INT; END_VAR VAR RETAIN c : INT; END_VAR VAR PERSISTENT d : INT; END_VAR
    VAR RETAIN PERSISTENT e : INT; END_VAR VAR_INPUT RETAIN i : INT; END_VAR VAR_OUTPUT RETAIN o : INT; END_VAR VAR RETAIN CONSTANT k : INT := 5; END_VAR
    a := a + 1; b := b + 1; c := c + 1; d := d + 1; e := e + 1; o := o + 1; g0 := g0 + 1; g1 := g1 + 1; g2 := g2 + 1; m := m + 1; bit := NOT bit; END_PROGRAM";
    let program = file("s10_4", "main.st", text);
    let stored = folder("s10_4_file").join("retain");
    let names = ["Main.a", "Main.b", "Main.c", "Main.d", "Main.e", "Main.o", "g0", "g1", "g2", "m"];
    let codesys = ["--scans", "1", "--profile", "codesys"];
    assert_eq!(ints(&sim(&program, &stored, &codesys), &names), [1; 10]);
    let warm = sim(&program, &stored, &codesys);
    assert_eq!(ints(&warm, &names), [1, 1, 2, 2, 2, 2, 1, 2, 2, 2], "warm");
    assert_eq!(vars(&warm)["bit"], Value::Bool(false));
    let cold = sim(&program, &stored, &[&codesys[..], &["--cold"]].concat());
    assert_eq!(ints(&cold, &names), [1, 1, 1, 3, 3, 1, 1, 1, 3, 1], "cold");
    std::fs::remove_file(&stored).unwrap();
    std::fs::remove_file(stored.with_file_name("retain.old")).unwrap();
    assert_eq!(ints(&sim(&program, &stored, &codesys), &names), [1; 10], "reset origin");
}

#[test]
fn s10_4_recursively_without_non_retain() {
    let text = "TYPE S : STRUCT x : INT; t : ARRAY [1..2] OF INT; END_STRUCT END_TYPE
    FUNCTION_BLOCK Inner VAR n : INT; END_VAR VAR NON_RETAIN skip : INT; END_VAR n := n + 1; skip := skip + 1; END_FUNCTION_BLOCK
    FUNCTION_BLOCK Own VAR n : INT; END_VAR VAR RETAIN kept : INT; END_VAR n := n + 1; kept := kept + 1; END_FUNCTION_BLOCK
    FUNCTION_BLOCK Outer VAR a : ARRAY [4..5] OF Inner; s : S; o : Own; END_VAR a[4](); a[5](); s.x := s.x + 1; s.t[2] := s.t[2] + 1; o(); END_FUNCTION_BLOCK
    PROGRAM Main VAR RETAIN r : Outer; END_VAR VAR p : Outer; END_VAR VAR NON_RETAIN q : Outer; END_VAR r(); p(); q(); END_PROGRAM
    PROGRAM Whole VAR n : INT; t : Inner; END_VAR VAR NON_RETAIN z : INT; END_VAR n := n + 1; z := z + 1; t(); END_PROGRAM
    CONFIGURATION c RESOURCE res ON PLC TASK t (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM main WITH t : Main; PROGRAM RETAIN w WITH t : Whole;
    PROGRAM NON_RETAIN v WITH t : Whole; END_RESOURCE END_CONFIGURATION";
    let program = file("s10_4_nested", "main.st", text);
    let stored = folder("s10_4_nested_file").join("retain");
    let watch = "main.r.a[4].n,main.r.a[5].skip,main.r.s.x,main.r.s.t[2],main.r.o.n,main.r.o.kept,main.p.s.x,main.p.o.n,main.p.o.kept,main.q.s.x,main.q.o.kept,w.n,w.z,w.t.n,w.t.skip,v.n";
    let names: Vec<_> = watch.split(',').collect();
    let args = ["--scans", "2", "--watch", watch];
    assert_eq!(ints(&sim(&program, &stored, &args), &names), [2; 16]);
    let want = [4, 2, 4, 4, 4, 4, 2, 2, 4, 2, 4, 4, 2, 4, 2, 2];
    assert_eq!(ints(&sim(&program, &stored, &args), &names), want);
}

#[test]
fn s10_4_edges_and_timers_go_on() {
    let text = "FUNCTION_BLOCK E VAR_INPUT c : BOOL R_EDGE; END_VAR VAR n : INT; END_VAR IF c THEN n := n + 1; END_IF; END_FUNCTION_BLOCK
    PROGRAM Main VAR RETAIN e : E; t : TON; r : R_TRIG; n : INT; END_VAR VAR off : BOOL; u : TON; END_VAR
    e(c := NOT off); t(IN := NOT off, PT := T#1s); u(IN := NOT off, PT := T#1s); r(CLK := TRUE); IF r.Q THEN n := n + 1; END_IF; END_PROGRAM";
    let program = file("s10_4_edges", "main.st", text);
    let stored = folder("s10_4_edges_file").join("retain");
    let args = ["--scans", "31", "--watch", "Main.e.n,Main.n,Main.t.ET,Main.t.Q,Main.u.ET"];
    let first = vars(&sim(&program, &stored, &args));
    assert_eq!(first["Main.t.ET"], Value::from("T#600ms"), "{first}");
    let second = vars(&sim(&program, &stored, &["--scans", "11", args[2], args[3]]));
    assert_eq!(
        (&second["Main.t.ET"], &second["Main.u.ET"], &second["Main.e.n"], &second["Main.n"]),
        (&Value::from("T#800ms"), &Value::from("T#200ms"), &Value::from(1), &Value::from(1))
    );
    let third = vars(&sim(&program, &stored, &args));
    assert_eq!((&third["Main.t.Q"], &third["Main.t.ET"]), (&Value::Bool(true), &Value::from("T#1s")), "{third}");
}

#[test]
fn f0006_damaged_and_truncated_files_restore_nothing_of_them() {
    let text = "PROGRAM Main VAR RETAIN a, b : INT := 1; END_VAR a := a + 1; b := b + 1; END_PROGRAM";
    let program = file("f0006", "main.st", text);
    let stored = folder("f0006_file").join("retain");
    let names = ["Main.a", "Main.b"];
    for want in [2, 3, 4] {
        assert_eq!(ints(&sim(&program, &stored, SCAN), &names), [want; 2]);
    }
    let (whole, old) = (std::fs::read(&stored).unwrap(), stored.with_file_name("retain.old"));
    let before = std::fs::read(&old).unwrap();
    for size in 0..whole.len() {
        if size % 7 != 0 && size + 9 < whole.len() {
            continue;
        }
        std::fs::write(&stored, &whole[..size]).unwrap();
        std::fs::remove_file(&old).unwrap();
        let ran = sim(&program, &stored, SCAN);
        assert_eq!(ints(&ran, &names), [2; 2], "{size} bytes");
        assert!(ran.stderr.contains("warning[F0006]"), "{ran:?}");
    }
    let mut damaged = whole.clone();
    damaged[20] ^= 1;
    std::fs::write(&stored, damaged).unwrap();
    std::fs::write(&old, before).unwrap();
    let ran = sim(&program, &stored, SCAN);
    assert_eq!(ints(&ran, &names), [4; 2], "the generation before");
    assert!(ran.stderr.contains("warning[F0006]"), "{ran:?}");
}

#[test]
fn f0007_changed_variables_start_anew_and_the_others_stay() {
    let stored = folder("f0007_file").join("retain");
    let program = |name: &str, s: &str, vars: &str, body: &str| {
        let text =
            format!("TYPE S : STRUCT {s} END_STRUCT END_TYPE PROGRAM Main VAR RETAIN s : S; {vars} END_VAR {body} END_PROGRAM");
        file(name, "main.st", text)
    };
    let first = program(
        "f0007_a",
        "x : INT; y : INT;",
        "gone, stays : INT; other : INT; list : ARRAY [0..3] OF INT;",
        "gone := 1; stays := 2; other := 3; s.x := 4; s.y := 5; list[1] := 6;",
    );
    sim(&first, &stored, SCAN);
    let second = program(
        "f0007_b",
        "y : INT; x : INT;",
        "new : INT := 9; stays : INT; other : DINT := 8; list : ARRAY [0..4] OF INT;",
        "",
    );
    let watch = ["--scans", "1", "--watch", "Main.new,Main.stays,Main.other,Main.s.x,Main.s.y,Main.list[1]"];
    let ran = sim(&second, &stored, &watch);
    assert_eq!(ints(&ran, &watch[3].split(',').collect::<Vec<_>>()), [9, 2, 8, 0, 0, 0]);
    for name in ["Main.other", "Main.s", "Main.list"] {
        assert!(ran.stderr.contains(&format!("warning[F0007]: a retained variable has changed its type: `{name}`")), "{ran:?}");
    }
}

/// A changed program numbers its classes anew: the number of an instance is not retained.
#[test]
fn s10_4_objects_keep_values_but_not_what_they_are() {
    let stored = folder("objects_file").join("retain");
    let program = |name: &str, more: &str| {
        let text = format!("{more} FUNCTION_BLOCK Base VAR n : INT; END_VAR METHOD PUBLIC add : INT n := n + 1; add := n; END_METHOD END_FUNCTION_BLOCK
        FUNCTION_BLOCK Ten EXTENDS Base VAR k : INT; END_VAR METHOD PUBLIC OVERRIDE add : INT n := n + 10; k := k + 1; add := n; END_METHOD END_FUNCTION_BLOCK
        FUNCTION use : INT VAR_IN_OUT b : Base; END_VAR use := b.add(); END_FUNCTION
        PROGRAM Main VAR RETAIN t : Ten; list : ARRAY [0..1] OF Ten; END_VAR VAR x, y : INT; END_VAR x := use(b := t); y := use(b := list[1]); END_PROGRAM");
        file(name, "main.st", text)
    };
    let args = ["--scans", "1", "--watch", "Main.x,Main.y,Main.t.k"];
    let names = ["Main.x", "Main.y", "Main.t.k"];
    assert_eq!(ints(&sim(&program("objects_a", ""), &stored, &args), &names), [10, 10, 1]);
    let more = "FUNCTION_BLOCK New VAR z : INT; END_VAR METHOD PUBLIC add : INT z := 1; END_METHOD END_FUNCTION_BLOCK FUNCTION_BLOCK Newer EXTENDS New END_FUNCTION_BLOCK";
    assert_eq!(ints(&sim(&program("objects_b", more), &stored, &args), &names), [20, 20, 2]);
}

/// Starts `takt run`, and waits until the retain file is there.
fn run_until_written(project: &Path, stored: &Path) -> std::process::Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_takt"));
    let mut child = command.arg("run").arg(project).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let start = Instant::now();
    while !stored.exists() {
        assert!(start.elapsed() < Duration::from_secs(30), "no file: {:?}", child.try_wait());
        std::thread::sleep(Duration::from_millis(20));
    }
    child
}

#[test]
fn s10_4_a_killed_run_keeps_the_last_write() {
    let project = folder("killed");
    std::fs::write(project.join("takt.toml"), "[project]\nname = \"k\"\n[run]\nretain = \"state/kept\"\n").unwrap();
    let text = "PROGRAM Main VAR RETAIN n : DINT; t : TON; END_VAR VAR fresh : DINT; END_VAR n := n + 1; fresh := fresh + 1; t(IN := TRUE, PT := T#1h); END_PROGRAM";
    std::fs::write(project.join("main.st"), text).unwrap();
    let stored = project.join("state/kept");
    let mut last = 0;
    for _ in 0..2 {
        let _ = std::fs::remove_file(&stored); // the generation before stays
        let mut child = run_until_written(&project, &stored);
        std::thread::sleep(Duration::from_millis(1500));
        child.kill().unwrap();
        child.wait().unwrap();
        let copy = project.join("copy");
        std::fs::copy(&stored, &copy).unwrap();
        let ran = sim(&project.display().to_string(), &copy, &["--scans", "1", "--watch", "Main.n,Main.fresh"]);
        let kept = ints(&ran, &["Main.n", "Main.fresh"]);
        assert!(kept[0] > last + 10 && kept[1] == 1 && ran.stderr.is_empty(), "{kept:?} {ran:?}");
        last = 10;
    }
}

#[test]
fn s10_4_run_restores_and_stores() {
    let project = folder("run_stores");
    std::fs::write(project.join("takt.toml"), "[project]\nname = \"r\"\n").unwrap();
    std::fs::write(project.join("main.st"), "PROGRAM Main VAR RETAIN starts : INT; END_VAR VAR done : BOOL; END_VAR IF NOT done THEN done := TRUE; starts := starts + 1; END_IF; END_PROGRAM").unwrap();
    let path = project.display().to_string();
    let starts = || {
        let copy = project.join("copy");
        std::fs::copy(project.join(".takt/retain"), &copy).unwrap();
        ints(&sim(&path, &copy, &["--scans", "1"]), &["Main.starts"])[0] - 1
    };
    for (more, want) in [(&[][..], 1), (&[], 2), (&["--cold"], 1)] {
        let args = [&["run", &path, "--duration", "100ms"], more].concat();
        let ran = takt(&args);
        assert_eq!(ran.status, 0, "{ran:?}");
        assert_eq!(starts(), want);
    }
}

#[test]
fn f0008_a_file_that_cant_be_written_is_a_message() {
    let project = folder("f0008");
    std::fs::write(project.join("takt.toml"), "[project]\nname = \"r\"\n[run]\nretain = \"main.st/retain\"\n").unwrap();
    std::fs::write(project.join("main.st"), "PROGRAM Main VAR RETAIN n : INT; END_VAR n := 1; END_PROGRAM").unwrap();
    let ran = takt(&["run", &project.display().to_string(), "--duration", "50ms"]);
    assert!(ran.status == 0 && ran.stderr.contains("warning[F0008]"), "{ran:?}");
}

/// §10.4: PROGRAM RETAIN keeps everything in the instance, PROGRAM NON_RETAIN nothing that does not say so itself; with several
/// resources each path is kept for itself.
#[test]
fn s10_4_program_retain_and_resources() {
    let text = "FUNCTION_BLOCK F VAR n : INT; END_VAR VAR NON_RETAIN z : INT; END_VAR n := n + 1; z := z + 1; END_FUNCTION_BLOCK
    PROGRAM Main VAR a : INT; f : F; END_VAR VAR RETAIN r : INT; END_VAR a := a + 1; r := r + 1; f(); END_PROGRAM
    CONFIGURATION c RESOURCE A ON PLC TASK t (INTERVAL := T#10ms); PROGRAM RETAIN p WITH t : Main; END_RESOURCE
    RESOURCE B ON PLC TASK t (INTERVAL := T#10ms); PROGRAM NON_RETAIN p WITH t : Main; PROGRAM q WITH t : Main; END_RESOURCE END_CONFIGURATION";
    let program = file("s10_4_program", "main.st", text);
    let stored = folder("s10_4_program_file").join("retain");
    let names = ["A.p.a", "A.p.r", "B.p.a", "B.p.r", "B.q.a", "B.q.r"];
    let members = ["A.p.f", "B.p.f", "B.q.f"];
    let both = |ran: &Ran| {
        let vars = vars(ran);
        let part = |m: &str, n: &str| vars[m][n].as_i64().unwrap();
        (ints(ran, &names), members.map(|m| (part(m, "n"), part(m, "z"))))
    };
    let two = ["--scans", "2"];
    assert_eq!(both(&sim(&program, &stored, &two)), (vec![1; 6], [(1, 1); 3]));
    let warm = both(&sim(&program, &stored, &two));
    assert_eq!(warm, (vec![2, 2, 1, 2, 1, 2], [(2, 1), (1, 1), (1, 1)]), "warm");
    let cold = both(&sim(&program, &stored, &["--scans", "2", "--cold"]));
    assert_eq!(cold, (vec![1; 6], [(1, 1); 3]), "cold");
}

/// A vendor's program that is a variable by its name, with a value and an address from VAR_CONFIG, in PROGRAM RETAIN: one instance.
#[test]
fn s4_3_a_shared_program_is_configured_and_retained() {
    let text = "PROGRAM Sub VAR_INPUT add : INT; END_VAR VAR n : INT := 1; lamp AT %Q* : INT := 5; seen : INT; END_VAR VAR NON_RETAIN z : INT := 2; END_VAR
    n := n + 1 + add; z := z + 1; seen := lamp; lamp := n; END_PROGRAM
    PROGRAM Main VAR a, b, c : INT; END_VAR a := Sub.n; Sub.add := 10; b := Sub.z; c := Sub.lamp; END_PROGRAM
    CONFIGURATION c RESOURCE r ON PLC TASK t (INTERVAL := T#10ms); PROGRAM RETAIN s WITH t : Sub; PROGRAM m WITH t : Main; END_RESOURCE
    VAR_ACCESS Lamp : r.s.lamp : INT READ_WRITE; N : s.n : INT; END_VAR
    VAR_CONFIG s.n : INT := 20; r.s.lamp AT %QW3 : INT := 7; s.z : INT := 3; END_VAR END_CONFIGURATION";
    let program = file("s4_3_shared", "main.st", text);
    let stored = folder("s4_3_shared_file").join("retain");
    let names = ["s.n", "s.z", "s.seen", "s.lamp", "m.a", "m.b", "m.c", "Lamp", "N"];
    let watched = names.join(",") + ",%QW3";
    let run = |more: &[&str]| {
        let args = [&["--scans", "1", "--profile", "codesys", "--watch", &watched][..], more].concat();
        let ran = sim(&program, &stored, &args);
        (ints(&ran, &names), vars(&ran)["%QW3"].as_i64().unwrap())
    };
    assert_eq!(run(&[]), (vec![21, 4, 7, 21, 21, 4, 21, 21, 21], 21), "first");
    assert_eq!(run(&["--engine", "interp"]), (vec![32, 4, 21, 32, 32, 4, 32, 32, 32], 32), "warm: all but z is kept");
    assert_eq!(run(&["--cold"]), (vec![21, 4, 7, 21, 21, 4, 21, 21, 21], 21), "cold");
    // A write through the access path is one of the address.
    assert_eq!(run(&["--cold", "--set", "Lamp=99@1"]), (vec![21, 4, 99, 21, 21, 4, 21, 21, 21], 21));
}
