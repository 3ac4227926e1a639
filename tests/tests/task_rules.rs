//! Tasks, function blocks with a task of their own, and connections (IEC 61131-3 reference §10.1 to §10.3), in virtual time.

use takt_tests::plc::{Plc, compile_st, error_codes};
use takt_tests::timed::timed;

/// A configuration with one resource.
fn plant(units: &str, globals: &str, inner: &str) -> String {
    format!("{units} CONFIGURATION c VAR_GLOBAL {globals} END_VAR RESOURCE r ON PLC {inner} END_RESOURCE END_CONFIGURATION")
}

const P: &str = "PROGRAM P VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : INT; q : BOOL; END_VAR VAR n : INT; END_VAR
n := n + 1; o := i + 1; q := n MOD 2 = 0; END_PROGRAM";

#[test]
fn s10_2_single_runs_once_per_rising_edge() {
    let text = plant(P, "go : BOOL;", "TASK t (SINGLE := go, PRIORITY := 1); PROGRAM p WITH t : P;");
    let sets = [(1, "go", "TRUE"), (5, "go", "FALSE"), (6, "go", "TRUE"), (7, "go", "TRUE")];
    assert_eq!(timed(&text, &sets, &["p.n"], 10), ["t@1 1", "t@6 2"]);
    let text = plant(P, "g : INT;", "TASK t (SINGLE := %IX0.3); PROGRAM p WITH t : P;");
    assert_eq!(timed(&text, &[(2, "%IX0.3", "TRUE")], &["p.n"], 5), ["t@2 1"]);
}

#[test]
fn s10_1_single_is_an_output_of_a_program() {
    let inner = "TASK fast (INTERVAL := T#2ms, PRIORITY := 2); TASK ev (SINGLE := a.q, PRIORITY := 1);
        PROGRAM a WITH fast : P; PROGRAM b WITH ev : P;";
    let got = timed(&plant(P, "g : INT;", inner), &[], &["a.n", "b.n"], 8);
    assert_eq!(got, ["fast@0 1 0", "fast@2 2 0", "ev@2 2 1", "fast@4 3 1", "fast@6 4 1", "ev@6 4 2"]);
    let located = "PROGRAM L VAR y AT %QX0.1 : BOOL; END_VAR y := NOT y; END_PROGRAM";
    let inner =
        "TASK fast (INTERVAL := T#2ms, PRIORITY := 2); TASK ev (SINGLE := l.y); PROGRAM l WITH fast : L; PROGRAM b WITH ev : P;";
    let got = timed(&plant(&format!("{P} {located}"), "g : INT;", inner), &[], &["b.n"], 4);
    assert_eq!(got, ["fast@0 0", "ev@0 1", "fast@2 1"]);
    for (single, want) in
        [("a.n", "P4003"), ("a.zz", "P3081"), ("b.q", "P1003"), ("g", "P4003"), ("TRUE", "P4003"), ("FALSE", "P4003")]
    {
        let inner = format!("TASK t (SINGLE := {single}); PROGRAM a WITH t : P;");
        assert_eq!(error_codes(&plant(P, "g : INT;", &inner)), [want], "{single}");
    }
}

#[test]
fn s10_2_single_and_interval_together() {
    // Periodic while SINGLE is FALSE; a rising edge runs it once; TRUE stops the periods.
    let text = plant(P, "go : BOOL;", "TASK t (SINGLE := go, INTERVAL := T#3ms, PRIORITY := 1); PROGRAM p WITH t : P;");
    let got = timed(&text, &[(4, "go", "TRUE"), (10, "go", "FALSE")], &["p.n"], 16);
    assert_eq!(got, ["t@0 1", "t@3 2", "t@4 3", "t@12 4", "t@15 5"]);
}

#[test]
fn s10_1_parameters_in_any_order_and_constant_intervals() {
    let text = plant(
        P,
        "g : INT; END_VAR VAR_GLOBAL CONSTANT k : TIME := T#2ms; prio : INT := 7;",
        "TASK t (PRIORITY := prio, INTERVAL := k * 2); PROGRAM p WITH t : P;",
    );
    assert_eq!(timed(&text, &[], &["p.n"], 9), ["t@0 1", "t@4 2", "t@8 3"]);
    let never = plant(P, "g : INT;", "TASK t (SINGLE := FALSE, INTERVAL := T#4ms); PROGRAM p WITH t : P;");
    assert_eq!(timed(&never, &[], &["p.n"], 5), ["t@0 1", "t@4 2"], "FALSE is as good as none");
    let variable = plant(P, "k : TIME := T#2ms;", "TASK t (INTERVAL := k); PROGRAM p WITH t : P;");
    assert_eq!(error_codes(&variable), ["P2005"], "a period is a constant");
    let multi = plant(P, "a : BOOL; b : BOOL;", "TASK t (MULTI := [a, b], PRIORITY := 1); PROGRAM p WITH t : P;");
    assert_eq!(error_codes(&multi), ["P0012"]);
}

#[test]
fn s10_2_priorities_and_background() {
    let inner = "TASK low (INTERVAL := T#2ms, PRIORITY := 9); TASK high (INTERVAL := T#2ms, PRIORITY := 0);
        PROGRAM l WITH low : P; PROGRAM h WITH high : P; PROGRAM b : P;";
    let got = timed(&plant(P, "g : INT;", inner), &[], &[], 3);
    assert_eq!(got, ["high@0", "low@0", "Background@0", "Background@1", "high@2", "low@2", "Background@2"]);
}

/// `fb` counts its runs and shows what it was given.
const BOUND: &str = "FUNCTION_BLOCK Count VAR_INPUT x : INT; END_VAR VAR_OUTPUT runs, seen : INT; END_VAR runs := runs + 1; seen := x; END_FUNCTION_BLOCK
FUNCTION_BLOCK Outer VAR_IN_OUT c : Count; END_VAR VAR in : Count; END_VAR c(x := 50); in(x := 1); END_FUNCTION_BLOCK
PROGRAM Main VAR n : INT; fb, other : Count; o : Outer; q : INT; r : REF_TO Count; END_VAR
n := n + 1; fb(x := n, runs => q); other(x := n); END_PROGRAM
PROGRAM Sly VAR fb : Count; o : Outer; END_VAR o(c := fb); END_PROGRAM";

#[test]
fn s10_2_the_body_of_a_bound_block_runs_in_its_task_alone() {
    let inner = "TASK fast (INTERVAL := T#2ms, PRIORITY := 1); TASK slow (INTERVAL := T#4ms, PRIORITY := 2);
        PROGRAM p WITH fast : Main (fb WITH slow); PROGRAM free WITH slow : Main;";
    let got =
        timed(&plant(BOUND, "g : INT;", inner), &[], &["p.n", "p.fb.x", "p.fb.runs", "p.fb.seen", "p.q", "p.other.runs"], 7);
    assert_eq!(
        got,
        [
            "fast@0 1 1 0 0 0 1",
            "slow@0 1 1 1 1 0 1",
            "fast@2 2 2 1 1 1 2",
            "fast@4 3 3 1 1 1 3",
            "slow@4 3 3 2 3 1 3",
            "fast@6 4 4 2 3 2 4"
        ]
    );
    let plc = Plc::new(&plant(BOUND, "g : INT;", inner));
    let slow: Vec<_> = plc.image.tasks[1].programs.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(slow, ["free", "p.fb"], "blocks run behind the programs of their task");
    // The other instance is not bound: its block runs in the program.
    let got = timed(&plant(BOUND, "g : INT;", inner), &[], &["free.n", "free.fb.runs"], 5);
    assert_eq!(got.last().unwrap(), "slow@4 2 2");
}

#[test]
fn s10_2_a_bound_block_is_not_run_by_who_gets_it_by_reference() {
    let inner = "TASK fast (INTERVAL := T#2ms, PRIORITY := 1); TASK slow (INTERVAL := T#6ms, PRIORITY := 2);
        PROGRAM p WITH fast : Sly (fb WITH slow);";
    let got = timed(&plant(BOUND, "g : INT;", inner), &[], &["p.fb.runs", "p.fb.seen", "p.o.in.runs"], 3);
    assert_eq!(got, ["fast@0 0 0 1", "slow@0 1 50 1", "fast@2 1 50 2"]);
}

#[test]
fn s10_2_derived_blocks_library_blocks_and_methods() {
    let units = "FUNCTION_BLOCK Base VAR_OUTPUT n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK
    FUNCTION_BLOCK Sub EXTENDS Base VAR_OUTPUT m : INT; END_VAR METHOD PUBLIC add m := m + 10; END_METHOD SUPER(); m := m + 1; END_FUNCTION_BLOCK
    FUNCTION_BLOCK User VAR_IN_OUT b : Base; END_VAR b(); END_FUNCTION_BLOCK
    PROGRAM Main VAR b : Base; s : Sub; u : User; t : TON; c : CTU; END_VAR b(); s(); s.add(); u(b := s); t(IN := TRUE, PT := T#3ms); c(CU := t.Q, PV := 1); END_PROGRAM";
    let inner = "TASK fast (INTERVAL := T#2ms, PRIORITY := 1); TASK slow (INTERVAL := T#4ms, PRIORITY := 2);
        PROGRAM p WITH fast : Main (s WITH slow, b WITH slow, t WITH slow);";
    let got = timed(&plant(units, "g : INT;", inner), &[], &["p.b.n", "p.s.n", "p.s.m", "p.t.ET", "p.t.Q"], 5);
    assert_eq!(
        got,
        [
            "fast@0 0 0 10 T#0s FALSE",
            "slow@0 1 1 11 T#0s FALSE",
            "fast@2 1 1 21 T#0s FALSE",
            "fast@4 1 1 31 T#0s FALSE",
            "slow@4 2 2 32 T#3ms TRUE",
        ]
    );
}

#[test]
fn s10_2_a_bound_block_with_addresses_and_in_another_resource() {
    let units = "FUNCTION_BLOCK F VAR lamp AT %Q* : INT; n : INT; END_VAR VAR_EXTERNAL g : INT; END_VAR n := n + g; lamp := n; END_FUNCTION_BLOCK
    PROGRAM Main VAR f : F; n : INT; END_VAR n := n + 1; f(); END_PROGRAM";
    let part = "TASK t (INTERVAL := T#2ms, PRIORITY := 1); TASK s (INTERVAL := T#4ms, PRIORITY := 2); PROGRAM p WITH t : Main (f WITH s);";
    let text = format!(
        "{units} CONFIGURATION c RESOURCE A ON PLC VAR_GLOBAL g : INT := 1; END_VAR {part} END_RESOURCE
        RESOURCE B ON PLC VAR_GLOBAL g : INT := 10; END_VAR TASK t (INTERVAL := T#4ms, PRIORITY := 3); PROGRAM p WITH t : Main; END_RESOURCE
        VAR_CONFIG A.p.f.lamp AT %QW0 : INT; B.p.f.lamp AT %QW1 : INT; END_VAR END_CONFIGURATION"
    );
    let got = timed(&text, &[], &["A.p.n", "A.p.f.n", "%QW0", "B.p.f.n", "%QW1"], 5);
    assert_eq!(
        got,
        [
            "A.t@0 1 0 0 0 0",
            "A.s@0 1 1 1 0 0",
            "B.t@0 1 1 1 10 10",
            "A.t@2 2 1 1 10 10",
            "A.t@4 3 1 1 10 10",
            "A.s@4 3 2 2 10 10",
            "B.t@4 3 2 2 20 20"
        ]
    );
}

#[test]
fn s10_2_a_native_block_with_a_task_is_called_there_alone() {
    let units = "{external} FUNCTION_BLOCK Native VAR_INPUT x : INT; END_VAR VAR_OUTPUT y : INT; END_VAR END_FUNCTION_BLOCK
    PROGRAM Main VAR f, g : Native; y : INT; END_VAR f(x := 3, y => y); g(x := 4); END_PROGRAM";
    let inner = "TASK t (INTERVAL := T#2ms); TASK s (INTERVAL := T#4ms); PROGRAM p WITH t : Main (f WITH s);";
    let c = compile_st(&plant(units, "x : INT;", inner));
    let (module, image) = (c.module.expect("compiles"), c.image.expect("compiles"));
    let calls = |f: &takt_compiler::mir::model::Function| {
        let ops = f.blocks.iter().flat_map(|b| &b.insts);
        ops.filter(|i| matches!(i.op, takt_compiler::mir::model::Op::CallNative { .. })).count()
    };
    let calling: Vec<_> = module.functions.iter().filter(|f| calls(f) > 0).map(|f| f.name.as_str()).collect();
    assert_eq!(calling, ["Native@call0", "p.f@s"], "the program calls the guard");
    assert_eq!(image.tasks[1].programs[0].name, "p.f");
}

#[test]
fn s10_2_what_can_not_be_bound() {
    let units = "FUNCTION_BLOCK F VAR_INPUT x : INT; END_VAR END_FUNCTION_BLOCK FUNCTION_BLOCK G VAR_IN_OUT x : INT; END_VAR END_FUNCTION_BLOCK
    PROGRAM Main VAR_INPUT i : INT; END_VAR VAR f : F; g : G; n : INT; a : ARRAY [0..1] OF F; END_VAR END_PROGRAM";
    for (connections, want) in [
        ("n WITH t", "P4004"),
        ("i WITH t", "P4004"),
        ("a WITH t", "P4004"),
        ("zz WITH t", "P1006"),
        ("f WITH zz", "P4001"),
        ("f WITH t, F WITH t", "P1001"),
        ("g WITH t", "P3007"),
        ("f WITH", "P0010"),
    ] {
        let text = plant(units, "x : INT;", &format!("TASK t (INTERVAL := T#1s); PROGRAM p : Main ({connections});"));
        assert_eq!(error_codes(&text), [want], "{connections}");
    }
}

#[test]
fn s10_1_connections() {
    let units = "TYPE Colour : (Red, Green); Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
    PROGRAM Main VAR_INPUT i, lit, dir : INT; b : BOOL; c : Colour; p : Pair; t : TIME; END_VAR VAR_OUTPUT o, od : INT; ob : BOOL; op : Pair; l : DINT; END_VAR
    o := i + lit + dir; od := o; ob := NOT b; op.a := p.b; op.b := p.a; l := o; END_PROGRAM";
    let globals = "gi : INT := 5; go : INT; gl : DINT; gp : Pair := (a := 1, b := 2); gq : Pair; END_VAR VAR_GLOBAL CONSTANT k : TIME := T#7s;";
    let inner = "TASK t (INTERVAL := T#2ms, PRIORITY := 1); PROGRAM m WITH t : Main
        (i := gi, lit := 100, dir := %IW1, b := %IX0.0, c := Green, p := gp, t := k, o => go, od => %QW1, ob => %QX0.3, op => gq, l => gl);";
    let text = plant(units, globals, inner);
    let got = timed(
        &text,
        &[(2, "%IW1", "1000"), (2, "%IX0.0", "TRUE"), (2, "gi", "6")],
        &["go", "gl", "%QW1", "%QX0.3", "gq.a", "m.c", "m.t"],
        3,
    );
    assert_eq!(got, ["t@0 105 105 105 TRUE 2 Green T#7s", "t@2 1106 1106 1106 FALSE 2 Green T#7s"]);
}

#[test]
fn s10_1_wrong_connections() {
    for (connections, want) in [
        ("i := TRUE", "P2001"),
        ("i := gd", "P2007"),
        ("i := nope", "P1003"),
        ("i :=", "P0012"),
        ("o => k", "P3001"),
        ("o => %IW0", "P3013"),
        ("o => 5", "P2014"),
        ("NOT o => gi", "P0012"),
        ("o := 1", "P1006"),
        ("n := 1", "P1006"),
        ("gi", "P1006"),
    ] {
        let text = plant(
            P,
            "gi : INT; gd : LREAL; END_VAR VAR_GLOBAL CONSTANT k : INT := 1;",
            &format!("PROGRAM p : P ({connections});"),
        );
        assert_eq!(error_codes(&text), [want], "{connections}");
    }
}

#[test]
fn s10_3_programs_in_order_with_one_time_and_one_input_image() {
    let units =
        "PROGRAM P VAR_EXTERNAL order : STRING; END_VAR VAR_INPUT name : STRING[1]; END_VAR VAR when : TIME; seen : BOOL; END_VAR
    order := CONCAT(order, name); when := TIME(); seen := %IX0.0; END_PROGRAM";
    let inner =
        "TASK t (INTERVAL := T#5ms, PRIORITY := 1); PROGRAM z WITH t : P (name := 'z'); PROGRAM a WITH t : P (name := 'a');";
    let got = timed(
        &plant(units, "order : STRING;", inner),
        &[(5, "%IX0.0", "TRUE")],
        &["order", "z.when", "a.when", "z.seen", "a.seen"],
        6,
    );
    assert_eq!(got, ["t@0 'za' T#0s T#0s FALSE FALSE", "t@5 'zaza' T#5ms T#5ms TRUE TRUE"]);
}
