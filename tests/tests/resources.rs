//! Several resources in one configuration (IEC 61131-3 reference §3.5, §10.1): globals, programs, tasks, addresses, retained values.

use takt_base::Profile;
use takt_tests::plc::{Plc, compile_in, error_codes};
use takt_tests::timed::timed;

fn check(plc: &Plc, wanted: &[(&str, &str)]) {
    for (path, want) in wanted {
        assert_eq!(plc.get(path), *want, "{path}");
    }
}

/// A configuration of two resources `A` and `B`, with these parts.
fn two(units: &str, outer: &str, a: &str, b: &str, rest: &str) -> String {
    format!(
        "{units} CONFIGURATION Plant {outer} RESOURCE A ON PLC {a} END_RESOURCE RESOURCE B ON X86.Soft {b} END_RESOURCE {rest} END_CONFIGURATION"
    )
}

/// A function, a block and a method that reach the global, each in its own way.
const COUNTER: &str = "
FUNCTION bump : INT VAR_INPUT d : INT; END_VAR VAR_EXTERNAL n : INT; END_VAR n := n + d; bump := n; END_FUNCTION
FUNCTION_BLOCK Twice VAR_EXTERNAL n : INT; END_VAR VAR last : INT; END_VAR
METHOD PUBLIC look : INT VAR_EXTERNAL n : INT; END_VAR look := n; END_METHOD
n := 2 * n; last := n; END_FUNCTION_BLOCK
PROGRAM Main VAR fb : Twice; x, y : INT; END_VAR VAR_EXTERNAL n : INT; common : INT; END_VAR
x := bump(1); fb(); y := fb.look(); n := n + 1; common := common + 1; END_PROGRAM";

#[test]
fn s3_5_each_resource_has_its_own_globals() {
    let text = two(
        COUNTER,
        "VAR_GLOBAL common : INT; END_VAR",
        "VAR_GLOBAL n : INT := 10; END_VAR PROGRAM p : Main;",
        "VAR_GLOBAL n : INT := 100; END_VAR PROGRAM p : Main; PROGRAM q : Main;",
        "",
    );
    let mut plc = Plc::new(&text);
    plc.scan(0).unwrap();
    check(
        &plc,
        &[
            ("A.p.x", "11"),
            ("A.p.y", "22"),
            ("A.p.fb.last", "22"),
            ("A.n", "23"),
            ("B.p.x", "101"),
            ("B.p.y", "202"),
            ("B.q.x", "204"),
            ("B.q.y", "408"),
            ("b.N", "409"),
            ("common", "3"),
        ],
    );
}

#[test]
fn s3_5_inner_globals_hide_outer_ones_in_their_resource_alone() {
    let text = two(
        COUNTER,
        "VAR_GLOBAL common : INT; n : INT := 1000; END_VAR",
        "PROGRAM p : Main;",
        "VAR_GLOBAL n : INT := 100; END_VAR PROGRAM p : Main;",
        "",
    );
    let mut plc = Plc::new(&text);
    plc.scan(0).unwrap();
    check(&plc, &[("n", "2003"), ("A.p.x", "1001"), ("B.n", "203"), ("B.p.x", "101"), ("common", "2")]);
}

#[test]
fn s3_5_one_name_may_have_two_types() {
    let units = "PROGRAM P VAR_EXTERNAL g : INT; END_VAR g := g + 1; END_PROGRAM
    PROGRAM Q VAR_EXTERNAL g : REAL; END_VAR VAR_INPUT i : REAL; END_VAR g := g + i; END_PROGRAM";
    let text = two(
        units,
        "",
        "VAR_GLOBAL g : INT; END_VAR PROGRAM p : P;",
        "VAR_GLOBAL CONSTANT k : REAL := 0.5; END_VAR VAR_GLOBAL g : REAL := k; h : REAL := 2.0; END_VAR PROGRAM p : Q (i := h);",
        "",
    );
    let mut plc = Plc::new(&text);
    plc.scan(0).unwrap();
    check(&plc, &[("A.g", "1"), ("B.g", "2.5")]);
}

#[test]
fn s3_5_constants_of_resources() {
    let units = "PROGRAM P VAR_EXTERNAL CONSTANT k : INT; END_VAR VAR x : INT; END_VAR x := x + k; END_PROGRAM";
    let text = two(
        units,
        "",
        "VAR_GLOBAL CONSTANT k : INT := 3; END_VAR PROGRAM p : P;",
        "VAR_GLOBAL CONSTANT k : INT := 4; END_VAR PROGRAM p : P;",
        "",
    );
    let mut plc = Plc::new(&text);
    plc.scan(0).unwrap();
    check(&plc, &[("A.p.x", "3"), ("B.p.x", "4")]);
    let bound = units.replace("x : INT;", "x : INT; a : ARRAY [0..k] OF INT;");
    let wrong = text.replace(units, &bound);
    assert_eq!(error_codes(&wrong), ["P2005"], "what a resource decides is no bound of an array");
}

#[test]
fn s3_5_references_and_blocks_in_globals() {
    let units = "FUNCTION_BLOCK F VAR_EXTERNAL n : INT; END_VAR VAR r : REF_TO INT := REF(n); v : INT; END_VAR v := r^; r^ := r^ + 1; END_FUNCTION_BLOCK
    PROGRAM P VAR f : F; END_VAR VAR_EXTERNAL g : F; END_VAR f(); g(); END_PROGRAM";
    let text = two(
        units,
        "",
        "VAR_GLOBAL n : INT := 5; g : F; END_VAR PROGRAM p : P;",
        "VAR_GLOBAL n : INT := 7; g : F; END_VAR PROGRAM p : P;",
        "",
    );
    let mut plc = Plc::new(&text);
    plc.scan(0).unwrap();
    check(&plc, &[("A.p.f.v", "5"), ("A.g.v", "6"), ("A.n", "7"), ("B.p.f.v", "7"), ("B.g.v", "8"), ("B.n", "9")]);
}

#[test]
fn s10_1_tasks_and_paths_have_the_name_of_their_resource() {
    let units = "PROGRAM P VAR n : INT; m AT %QW0 : INT; END_VAR n := n + 1; END_PROGRAM";
    let tasks = "TASK t (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM p WITH t : P; PROGRAM bg : P;";
    let plc = Plc::new(&two(units, "", tasks, tasks, ""));
    let shown: Vec<_> = plc.image.tasks.iter().map(|t| format!("{}:{}", t.name, t.programs[0].name)).collect();
    assert_eq!(shown, ["A.t:A.p", "A.Background:A.bg", "B.t:B.p", "B.Background:B.bg"]);
    check(&plc, &[("A.p.n", "0"), ("B.bg.m", "0")]);
    let one = Plc::new(&format!("{units} CONFIGURATION c RESOURCE A ON PLC {tasks} END_RESOURCE END_CONFIGURATION"));
    assert_eq!((one.image.tasks[0].name.as_str(), one.get("p.n")), ("t", "0".into()));
}

#[test]
fn s3_7_addresses_and_values_of_each_resource() {
    let units = "PROGRAM P VAR y AT %Q* : INT; n : INT := 1; END_VAR VAR_EXTERNAL g : INT; END_VAR y := n + g; END_PROGRAM";
    let part = "VAR_GLOBAL g : INT; END_VAR PROGRAM p : P;";
    let config = |more: &str| {
        two(
            units,
            "",
            part,
            part,
            &format!("VAR_CONFIG A.p.y AT %QW0 : INT; B.p.y AT %QW1 : INT; A.p.n : INT := 5; B.g : INT := 40; {more} END_VAR"),
        )
    };
    let mut plc = Plc::new(&config(""));
    plc.scan(0).unwrap();
    check(&plc, &[("A.p.y", "5"), ("B.p.y", "41"), ("A.p.n", "5"), ("B.p.n", "1"), ("A.g", "0")]);
    assert_eq!(error_codes(&config("p.n : INT := 1;")), ["P3081"], "several resources have it");
    assert_eq!(error_codes(&config("g : INT := 1;")), ["P3081"], "several resources have it");
    assert_eq!(error_codes(&config("C.g : INT := 1;")), ["P3081"]);
}

#[test]
fn s10_4_retained_paths_begin_with_the_resource() {
    let units = "PROGRAM P VAR RETAIN n : INT; END_VAR END_PROGRAM";
    let part = "VAR_GLOBAL RETAIN g : INT; END_VAR PROGRAM p : P;";
    let plc = Plc::new(&two(units, "VAR_GLOBAL RETAIN o : INT; END_VAR", part, part, ""));
    let mut paths: Vec<_> = plc.image.retained.iter().map(|r| r.path.as_str()).collect();
    paths.sort_unstable();
    assert_eq!(paths, ["A.g", "A.p.n", "B.g", "B.p.n", "o"]);
}

#[test]
fn s10_1_vendor_globals_without_var_external() {
    let units = "PROGRAM P VAR x : INT; END_VAR x := g; g := g + 1; END_PROGRAM";
    let text =
        two(units, "", "VAR_GLOBAL g : INT := 3; END_VAR PROGRAM p : P;", "VAR_GLOBAL g : INT := 6; END_VAR PROGRAM p : P;", "");
    let mut plc = Plc::new_in(Profile::Codesys, &text);
    plc.scan(0).unwrap();
    check(&plc, &[("A.p.x", "3"), ("A.g", "4"), ("B.p.x", "6"), ("B.g", "7")]);
    assert!(compile_in(Profile::Codesys, &text.replace("VAR_GLOBAL g : INT := 6; END_VAR", "")).image.is_none());
}

#[test]
fn s11_what_is_wrong_with_resources() {
    let other = "PROGRAM Q END_PROGRAM";
    let unit = "PROGRAM P VAR_EXTERNAL g : INT; END_VAR g := 1; END_PROGRAM PROGRAM Q END_PROGRAM";
    let own = "VAR_GLOBAL g : INT; END_VAR PROGRAM p : P;";
    for (a, b, rest, want) in [
        (own, "PROGRAM p : P;", "", "P1009"),
        (own, "VAR_GLOBAL g : DINT; END_VAR PROGRAM p : P;", "", "P1009"),
        (own, "VAR_GLOBAL CONSTANT g : INT := 1; END_VAR PROGRAM p : P;", "", "P1009"),
        (own, "VAR_GLOBAL g, G : INT; END_VAR PROGRAM p : P;", "", "P1001"),
        (own, "TASK t (SINGLE := g); PROGRAM p WITH t : Q;", "", "P1003"),
        ("TASK t (INTERVAL := T#1s); PROGRAM p WITH t : Q;", "PROGRAM p WITH t : Q;", "", "P4001"),
        ("PROGRAM p : Q;", "PROGRAM p : Q; PROGRAM P : Q;", "", "P1001"),
        ("PROGRAM p : Q;", "PROGRAM p : Q;", "RESOURCE a ON PLC PROGRAM q : Q; END_RESOURCE", "P1001"),
        ("PROGRAM p : Q;", "PROGRAM p : Q;", "PROGRAM q : Q;", "P0010"),
        ("PROGRAM p : Q;", "PROGRAM p : Q;", "END_CONFIGURATION CONFIGURATION d RESOURCE z ON PLC END_RESOURCE", "P0012"),
    ] {
        let units = if a == own { unit } else { other };
        assert_eq!(error_codes(&two(units, "", a, b, rest)), [want], "{a} | {b} | {rest}");
    }
    assert_eq!(
        error_codes(&two(unit, "VAR_GLOBAL a : INT; END_VAR", own, own, "")),
        ["P1001"],
        "a global has the name of the resource"
    );
    // VAR_EXTERNAL names a global that is there, used or not.
    let idle = "PROGRAM P VAR_EXTERNAL g : INT; END_VAR END_PROGRAM";
    assert_eq!(error_codes(&two(idle, "", own, "PROGRAM p : P;", "")), ["P1009"]);
    let tasks: String = (0..64).map(|i| format!("TASK t{i} (INTERVAL := T#1s); ")).collect();
    let many: String = (0..15).map(|i| format!("RESOURCE r{i} ON x {tasks} END_RESOURCE ")).collect();
    assert_eq!(error_codes(&two(other, "", &tasks, "TASK t (INTERVAL := T#1s);", &many)), ["P4003"], "more than 1024 tasks");
    // A unit that no program of the resource reaches does not need its globals.
    assert_eq!(error_codes(&two(unit, "", own, "PROGRAM p : Q;", "")), [""; 0]);
}

#[test]
fn s10_2_one_scheduler_runs_the_tasks_of_all_resources() {
    let units = "PROGRAM P VAR n : INT; END_VAR n := n + 1; END_PROGRAM";
    let text = two(
        units,
        "VAR_GLOBAL go : BOOL; END_VAR",
        "TASK slow (INTERVAL := T#4ms, PRIORITY := 5); PROGRAM p WITH slow : P;",
        "TASK t (PRIORITY := 1, INTERVAL := T#2ms); TASK key (PRIORITY := 0, SINGLE := go); PROGRAM p WITH t : P; PROGRAM k WITH key : P;",
        "",
    );
    let got = timed(&text, &[(3, "go", "TRUE")], &["A.p.n", "B.p.n", "B.k.n"], 5);
    assert_eq!(got, ["B.t@0 0 1 0", "A.slow@0 1 1 0", "B.t@2 1 2 0", "B.key@3 1 2 1", "B.t@4 1 3 1", "A.slow@4 2 3 1"]);
}

/// What is computed before the first scan is computed for each resource, with its globals, also if a block with a task runs first.
#[test]
fn s3_1_values_computed_at_the_start_are_those_of_the_resource() {
    let units = "FUNCTION scaled : INT VAR_INPUT f : INT; END_VAR VAR_EXTERNAL n : INT; END_VAR scaled := f * n; END_FUNCTION
        FUNCTION_BLOCK Sensor VAR_EXTERNAL n : INT; END_VAR VAR base : INT := n + 1; seen : INT; END_VAR
          METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR base := base + scaled(100); END_METHOD
          seen := seen + base; END_FUNCTION_BLOCK
        PROGRAM Main VAR_EXTERNAL n : INT; END_VAR VAR s : Sensor; x : INT := scaled(10); y : INT := n; END_VAR s(); END_PROGRAM";
    let text = two(
        units,
        "",
        "VAR_GLOBAL n : INT := 1; END_VAR TASK t (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM p WITH t : Main;",
        "VAR_GLOBAL n : INT := 2; END_VAR TASK t (INTERVAL := T#10ms, PRIORITY := 0); TASK u (INTERVAL := T#10ms, PRIORITY := 0);
         PROGRAM p WITH t : Main (s WITH u);",
        "",
    );
    let mut plc = Plc::new_in(Profile::Codesys, &text);
    plc.scan(0).unwrap();
    check(&plc, &[("A.p.x", "10"), ("A.p.y", "1"), ("A.p.s.base", "102"), ("A.p.s.seen", "102")]);
    check(&plc, &[("B.p.x", "20"), ("B.p.y", "2"), ("B.p.s.base", "203"), ("B.p.s.seen", "203")]);
}
