//! The forms that scripts depend on (docs/guide/command-line.md): exit statuses, JSON, CSV, options.

mod common;

use common::{file, folder, takt, takt_in};
use serde_json::json;
use std::fs;

const VALUES: &str = "TYPE Mode : (idle, fast); Point : STRUCT x : INT := 3; y : REAL; END_STRUCT; END_TYPE
{warning disable P6003}
PROGRAM main
VAR
  b : BOOL := TRUE; i : INT := -5; big : LINT := 9007199254740993; w : LWORD := 16#FFFF_FFFF_FFFF_FFFF; u : UDINT := 7;
  r : REAL := 0.1; d : LREAL := 1.5; nan : LREAL; inf : LREAL; zero : LREAL;
  s : STRING[10] := 'a$'b'; t : TIME := T#1s500ms; day : DATE := D#2024-02-29; m : Mode := fast;
  p : Point; a : ARRAY[1..2, 0..1] OF INT := [1, 2, 3, 4]; q AT %QW1 : INT := 9; n : DINT;
END_VAR
  n := n + 1;
  nan := zero / zero;
  inf := -1.0 / zero;
END_PROGRAM
";

#[test]
fn sim_json_has_every_form_of_value() {
    let path = file("values", "values.st", VALUES);
    for engine in ["native", "interp"] {
        let ran = takt(&["sim", &path, "--scans", "3", "--interval", "5ms", "--engine", engine]);
        assert_eq!((ran.status, ran.stderr.as_str()), (0, ""));
        let found = ran.json();
        assert_eq!((&found["scans"], &found["time_ns"], &found["fault"]), (&json!(3), &json!(10_000_000), &json!(null)));
        let vars = &found["vars"];
        for (name, value) in [
            ("b", json!(true)),
            ("i", json!(-5)),
            ("big", json!("9007199254740993")),
            ("w", json!("18446744073709551615")),
            ("u", json!(7)),
            ("r", json!(0.1)),
            ("d", json!(1.5)),
            ("nan", json!("NaN")),
            ("inf", json!("-Infinity")),
            ("s", json!("a'b")),
            ("t", json!("T#1s500ms")),
            ("day", json!("D#2024-02-29")),
            ("m", json!("fast")),
            ("p", json!({"x": 3, "y": 0.0})),
            ("a", json!([[1, 2], [3, 4]])),
            ("q", json!(9)),
            ("n", json!(3)),
        ] {
            assert_eq!(vars[format!("main.{name}")], value, "{name}");
        }
    }
}

#[test]
fn sim_watches_paths_and_direct_addresses() {
    let path = file("watch", "watch.st", VALUES);
    let ran = takt(&["sim", &path, "--scans", "2", "--watch", "MAIN.N,main.a[2,1],%QW1,%QX2.0,main.p.x"]);
    assert_eq!(ran.json()["vars"], json!({"main.n": 2, "main.a[2,1]": 4, "%QW1": 9, "%QX2.0": true, "main.p.x": 3}));
    let ran = takt(&["sim", &path, "--scans", "2", "--watch", "main.n,main.m", "--format", "csv"]);
    assert_eq!(ran.stdout, "scan,time_ns,main.n,main.m\n1,0,1,fast\n2,20000000,2,fast\n");
    let ran = takt(&["sim", &path, "--watch", "main.dayy"]);
    assert_eq!(ran.status, 1);
    assert!(ran.stderr.contains("C0007") && ran.stderr.contains("did you mean `day`?"), "{}", ran.stderr);
}

#[test]
fn sim_sets_values_before_a_scan_and_from_a_file() {
    let dir = folder("sets");
    fs::write(
        dir.join("p.st"),
        "PROGRAM main VAR x, y : INT; key AT %IX0.1 : BOOL; n : INT; END_VAR y := x; IF key THEN n := n + 1; END_IF; END_PROGRAM",
    )
    .unwrap();
    fs::write(dir.join("keys.csv"), "scan,main.key\n2,TRUE\n4,FALSE\n").unwrap();
    let args = [
        "sim",
        "p.st",
        "--scans",
        "5",
        "--set",
        "main.x=42@3",
        "--stimulus",
        "keys.csv",
        "--watch",
        "main.y,main.n",
        "--format",
        "csv",
    ];
    let ran = takt_in(&dir, &args);
    let rows: Vec<_> = ran.stdout.lines().skip(1).map(|l| l.splitn(3, ',').nth(2).unwrap()).collect();
    assert_eq!(rows, ["0,0", "0,1", "42,2", "42,2", "42,2"], "{}", ran.stderr);
    for (set, code) in [("main.x=abc@1", "C0008"), ("main.z=1@1", "C0007"), ("main.x", "C0008"), ("main.x=99999@1", "C0008")] {
        let ran = takt_in(&dir, &["sim", "p.st", "--set", set]);
        assert_eq!(ran.status, 1, "{set}");
        assert!(ran.stderr.contains(code), "{set}: {}", ran.stderr);
    }
    fs::write(dir.join("bad.csv"), "time,main.key\nsoon,TRUE\n").unwrap();
    let ran = takt_in(&dir, &["sim", "p.st", "--stimulus", "bad.csv"]);
    assert!(ran.status == 1 && ran.stderr.contains("C0006") && ran.stderr.contains("line 2"), "{}", ran.stderr);
}

#[test]
fn check_json_has_place_and_help() {
    let path = file("check", "pump.st", "PROGRAM main\nVAR level : INT; raw : DINT; END_VAR\n  level := raw;\nEND_PROGRAM\n");
    let ran = takt(&["check", &path, "--format", "json"]);
    assert_eq!(ran.status, 1);
    let diag = &ran.json()[0];
    let places = ["line", "column", "endLine", "endColumn"].map(|k| diag[k].as_u64().unwrap());
    assert_eq!((diag["code"].as_str(), diag["severity"].as_str(), places), (Some("P2007"), Some("error"), [3, 12, 3, 15]));
    assert!(diag["file"].as_str().unwrap().ends_with("pump.st") && diag["message"].is_string());
    assert_eq!(diag["help"], json!("write DINT_TO_INT(raw)"));
    let fine = file("check-fine", "fine.st", "PROGRAM main END_PROGRAM");
    assert_eq!(takt(&["check", &fine, "--format", "json"]).stdout.trim(), "[]");
}

#[test]
fn several_files_are_one_project_and_a_library_alone_can_be_checked() {
    let dir = folder("several");
    fs::write(dir.join("f.st"), "FUNCTION twice : INT VAR_INPUT x : INT; END_VAR twice := 2 * x; END_FUNCTION").unwrap();
    fs::write(dir.join("main.st"), "PROGRAM main VAR y : INT; END_VAR y := twice(21); END_PROGRAM").unwrap();
    let ran = takt_in(&dir, &["sim", "f.st", "main.st", "--scans", "1"]);
    assert_eq!(ran.json()["vars"]["main.y"], json!(42), "{}", ran.stderr);
    assert_eq!(takt_in(&dir, &["check", "f.st"]).status, 0);
    let ran = takt_in(&dir, &["sim", "f.st"]);
    assert!(ran.status == 1 && ran.stderr.contains("P4002"), "{}", ran.stderr);
}

#[test]
fn an_image_runs_anywhere_without_its_sources() {
    let (dir, other) = (folder("image"), folder("image-elsewhere"));
    let plotter = common::root().join("examples/02-plotter").display().to_string();
    let image = dir.join("plotter.takt").display().to_string();
    assert_eq!(takt(&["build", &plotter, "-o", &image]).status, 0);
    let ran = takt_in(&other, &["run", &image]);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    assert!(ran.stdout.contains("path length 1358.726 mm, end point (20, 30)"), "{}", ran.stdout);
    let sources = file("not-image", "x.st", "PROGRAM main END_PROGRAM");
    assert_eq!(takt(&["build", &sources, "-o", "/nowhere/at/all.takt"]).status, 1);
}

#[test]
fn templates_run() {
    for template in ["blink", "plotter"] {
        let dir = folder(&format!("new-{template}"));
        assert_eq!(takt_in(&dir, &["new", "machine", "--template", template]).status, 0);
        assert_eq!(takt_in(&dir, &["check", "machine"]).stderr, "");
        assert_eq!(takt_in(&dir, &["sim", "machine", "--duration", "500ms"]).status, 0);
        let again = takt_in(&dir, &["new", "machine"]);
        assert!(again.status == 1 && again.stderr.contains("not empty"), "{}", again.stderr);
    }
}

#[test]
fn bench_has_its_fields() {
    let ran = takt(&["bench", "examples/01-blink", "--scans", "100", "--format", "json"]);
    let found = ran.json();
    assert_eq!(found["scans"], json!(100));
    for key in ["min", "median", "p99", "max"] {
        assert!(found["ns_per_scan"][key].is_u64() || found["ns_per_scan"][key].is_i64(), "{key}");
    }
    assert!(["compile_ms", "code_bytes", "data_bytes"].iter().all(|k| found[k].as_f64().unwrap() > 0.0));
}

#[test]
fn explain_knows_codes_and_the_project_file() {
    assert!(takt(&["explain", "p2007"]).stdout.starts_with("# P2007"));
    assert!(takt(&["explain", "takt.toml"]).stdout.contains("servo_period"));
    assert!(takt(&["explain"]).stdout.lines().count() > 90);
    assert_eq!(takt(&["explain", "Z9999"]).status, 2);
}

#[test]
fn usage_errors_are_status_2_and_help_has_an_example() {
    for args in
        [&["check"][..], &["sim", "x.st", "--scans", "many"], &["fly"], &["sim", "x.st", "--engine", "steam"], &["gcode", "x.nc"]]
    {
        assert_eq!(takt(args).status, 2, "{args:?}");
    }
    for command in ["new", "check", "build", "run", "sim", "bench", "explain", "gcode"] {
        assert!(takt(&[command, "--help"]).stdout.contains("Example:"), "{command}");
    }
}

#[test]
fn gcode_prints_checks_plans_and_draws() {
    let dir = folder("gcode");
    let plate = common::root().join("examples/02-plotter/plate.nc").display().to_string();
    let canon = takt(&["gcode", &plate, "--modes", "G91", "--canon", "--number-lines"]).stdout;
    assert!(
        canon.contains("N00004 ARC_FEED(88.0000, 106.0000, 72.0000, 106.0000, 1, 0.0000, 0.0000, 0.0000, 0.0000)\n"),
        "{canon}"
    );
    let checked = takt(&["gcode", &plate, "--check"]);
    assert_eq!((checked.status, checked.stderr.matches("error[N0007]").count()), (1, 6), "as G90 every second arc is wrong");
    let args = ["gcode", &plate, "--modes", "G91", "--plan", "--limits", "v=1200,a=20000", "--format", "json"];
    let plan = takt(&args).json();
    assert_eq!((&plan["blocks"], &plan["violations"]), (&json!(27), &json!(0)));
    let number = |key: &str| plan[key].as_f64().unwrap();
    assert!((number("length_mm") - 1394.781).abs() < 1e-3 && number("time_s") > number("ideal_time_s"));
    assert!(number("max_acceleration") <= 20_000.0 * 1.000001 && number("max_velocity") <= 1_200.0 * 1.000001);
    assert!(number("max_path_deviation_mm") < 1e-9 && number("max_jerk") > 0.0);
    let ran = takt_in(&dir, &["gcode", &plate, "--modes", "G91", "--plot", "plate.svg", "--trace", "plate.csv"]);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    assert!(fs::read_to_string(dir.join("plate.svg")).unwrap().contains("</svg>"));
    let trace = fs::read_to_string(dir.join("plate.csv")).unwrap();
    assert!(trace.starts_with("time_s,X,Y\n") && trace.trim_end().ends_with(",20.000000000,30.000000000"));
}

/// IEC 61131-3 reference §3.8: access paths are paths like any other; one that is READ_ONLY takes no values.
#[test]
fn access_paths_are_watched_set_and_dumped() {
    let text = "PROGRAM Main VAR n, m : INT; END_VAR n := n + 1; END_PROGRAM
    CONFIGURATION c RESOURCE r ON PLC TASK t (INTERVAL := T#10ms); PROGRAM p WITH t : Main; END_RESOURCE
    VAR_ACCESS Count : r.p.n : INT READ_WRITE; Shown : p.n : INT READ_ONLY; Door : r.%IX0.3 : BOOL; END_VAR END_CONFIGURATION";
    let path = file("access", "plant.st", text);
    let ran = takt(&["sim", &path, "--scans", "3", "--set", "COUNT=40@2", "--watch", "count,Shown,Door,p.n"]);
    assert_eq!(ran.json()["vars"], json!({"Count": 42, "Shown": 42, "Door": false, "p.n": 42}));
    let dump = takt(&["sim", &path, "--scans", "1", "--dump"]).json();
    assert_eq!(dump["vars"], json!({"p.n": 1, "p.m": 0, "Count": 1, "Shown": 1, "Door": false}));
    let ran = takt(&["sim", &path, "--set", "Shown=5@1"]);
    let told = ["error[C0009]", "`Shown` can't be written: VAR_ACCESS declares it READ_ONLY", "declare it READ_WRITE"];
    assert!(ran.status == 1 && told.iter().all(|t| ran.stderr.contains(t)), "{}", ran.stderr);
    let ran = takt(&["check", &file("access_wrong", "plant.st", text.replace("p.n : INT READ_ONLY", "p.zz : INT"))]);
    assert!(ran.status == 1 && ran.stderr.contains("P3081"), "{}", ran.stderr);
}

/// §10.1: with several resources paths begin with their names, in the state, in the report of faults and in the tests of a project.
#[test]
fn several_resources() {
    let text = "PROGRAM Main VAR n, d : INT; END_VAR VAR_EXTERNAL g : INT; END_VAR n := n + g; d := 6 / (3 - n); END_PROGRAM
    CONFIGURATION c RESOURCE A ON PLC VAR_GLOBAL g : INT := 1; END_VAR TASK t (INTERVAL := T#10ms); PROGRAM p WITH t : Main; END_RESOURCE
    RESOURCE B ON PLC VAR_GLOBAL g : INT := 10; END_VAR TASK t (INTERVAL := T#20ms); PROGRAM p WITH t : Main; END_RESOURCE END_CONFIGURATION";
    let path = file("resources", "plant.st", text);
    for engine in ["native", "interp"] {
        let ran = takt(&["sim", &path, "--scans", "3", "--engine", engine]);
        let vars = json!({"A.g": 1, "B.g": 10, "A.p.n": 2, "A.p.d": 6, "B.p.n": 10, "B.p.d": 0});
        assert_eq!(ran.json()["vars"], vars, "{}", ran.stderr);
    }
    let ran = takt(&["sim", &path, "--scans", "9", "--watch", "A.p.n"]);
    assert_eq!((ran.status, &ran.json()["fault"]["task"], &ran.json()["vars"]["A.p.n"]), (3, &json!("A.t"), &json!(3)));
    let tested = format!("{text} {{test}} PROGRAM Works VAR_EXTERNAL g : INT; END_VAR ASSERT_EQ(g, 1); END_PROGRAM");
    let ran = takt(&["test", &file("resources_tested", "plant.st", tested)]);
    assert_eq!(ran.status, 0, "{ran:?}");
}
