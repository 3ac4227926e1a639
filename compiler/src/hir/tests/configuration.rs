//! Tasks and programs (language reference §10.1, §10.2).

use super::*;

const P: &str = "PROGRAM A VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : INT; END_VAR o := i; END_PROGRAM PROGRAM Bg END_PROGRAM";

fn config(inner: &str) -> Built {
    build(&format!(
        "{P}\nCONFIGURATION c VAR_GLOBAL go : BOOL; x : INT; d : DINT; END_VAR VAR_GLOBAL CONSTANT k : TIME := T#5ms; END_VAR\nRESOURCE r ON PLC\n{inner}\nEND_RESOURCE END_CONFIGURATION"
    ))
}

fn messages(inner: &str) -> String {
    config(inner).codes()
}

fn tasks(b: &Built) -> String {
    let one = |t: &Task| {
        let programs: Vec<_> = t.programs.iter().map(|p| format!("{}:{}", p.name, b.hir.pous[p.pou].name)).collect();
        let single = if t.single.is_some() { " single" } else { "" };
        format!("{} {} {:?}{single} [{}]", t.name, t.priority, t.interval.map(|i| i.0), programs.join(" "))
    };
    b.hir.tasks.iter().map(one).collect::<Vec<_>>().join("; ")
}

#[test]
fn without_a_configuration_every_program_runs() {
    let built = build(P);
    assert_eq!(built.codes(), "");
    assert_eq!(tasks(&built), "Main 0 Some(20000000) [A:A Bg:Bg]");
    assert_eq!(crate::hir::DEFAULT_INTERVAL, takt_base::Nanos::from_millis(20));
}

#[test]
fn tasks_with_their_programs() {
    let built = config(
        "TASK fast (INTERVAL := T#2ms, PRIORITY := 1); TASK ev (SINGLE := go, PRIORITY := 0); TASK k1 (INTERVAL := k);\n\
        PROGRAM a1 WITH fast : A (i := 5, o => x); PROGRAM a2 WITH fast : A (i := x, o => d); PROGRAM b1 WITH ev : Bg; PROGRAM b2 : Bg;",
    );
    assert_eq!(built.codes(), "");
    assert_eq!(
        tasks(&built),
        "fast 1 Some(2000000) [a1:A a2:A]; ev 0 None single [b1:Bg]; k1 0 Some(5000000) []; Background 4294967295 None [b2:Bg]"
    );
    let program = &built.hir.tasks[0].programs[1];
    assert!(matches!(program.inputs[0].1.kind, ExprKind::Load(_)) && program.outputs.len() == 1);
}

#[test]
fn a_direct_address_triggers_a_task() {
    assert_eq!(messages("TASK ev (SINGLE := %IX4.1, PRIORITY := 0); PROGRAM b WITH ev : Bg;"), "");
    let built = config("TASK ev (SINGLE := %IX4.1, PRIORITY := 0); PROGRAM b WITH ev : Bg;");
    assert_eq!(built.hir.image_bytes, [5, 0, 0]);
}

#[test]
fn access_paths_are_understood() {
    let path = "PROGRAM b : Bg; END_RESOURCE VAR_ACCESS a : r.%IX1.1 : BOOL READ_ONLY; END_VAR RESOURCE q ON PLC";
    let built = config(path);
    assert_eq!(built.codes(), "");
    assert_eq!((built.hir.accesses.len(), built.hir.image_bytes), (1, [2, 0, 0]));
}

#[test]
fn broken_entries_of_var_config_do_not_take_the_rest_along() {
    for text in
        ["r.b. AT %QX0.0 : BOOL;", "r.b.x[ : INT;", "r.b.x INT := 3;", ": INT;", "r.b.x : INT := ;", "x", "r.b.x AT : INT;"]
    {
        let built = build(&format!(
            "{P} CONFIGURATION c PROGRAM b : Bg; VAR_CONFIG {text} END_VAR END_CONFIGURATION FUNCTION f : INT f := TRUE; END_FUNCTION"
        ));
        let codes = built.codes();
        assert!(codes.contains("P0010") && codes.contains("P2001"), "{text}: {codes}");
    }
}

#[test]
fn what_is_wrong_with_tasks() {
    for (inner, want) in [
        ("TASK t (PRIORITY := 1); PROGRAM b WITH t : Bg;", "P4003 4:6"),
        ("TASK t (INTERVAL := T#0s, PRIORITY := 1); PROGRAM b WITH t : Bg;", "P4003 4:6"),
        ("TASK t (INTERVAL := T#-1s, PRIORITY := 1); PROGRAM b WITH t : Bg;", "P4003 4:21"),
        ("TASK t (INTERVAL := 5, PRIORITY := 1); PROGRAM b WITH t : Bg;", "P2001 4:21"),
        ("TASK t (INTERVAL := T#1s, PRIORITY := -1); PROGRAM b WITH t : Bg;", "P4003 4:39"),
        ("TASK t (INTERVAL := T#1s, PRIORITY := 65536); PROGRAM b WITH t : Bg;", "P4003 4:39"),
        ("TASK t (SINGLE := x, PRIORITY := 1); PROGRAM b WITH t : Bg;", "P4003 4:19"),
        ("TASK t (SINGLE := nope, PRIORITY := 1); PROGRAM b WITH t : Bg;", "P1003 4:19"),
        ("TASK t (INTERVAL := T#1s); TASK T (INTERVAL := T#2s); PROGRAM b WITH t : Bg;", "P1001 4:33"),
        ("TASK t (INTERVAL := T#1s); PROGRAM b WITH u : Bg;", "P4001 4:43"),
        ("PROGRAM b : Bg; PROGRAM B : Bg;", "P1001 4:25"),
        ("PROGRAM b : Nope;", "P1004 4:13"),
        ("PROGRAM b : TON;", "P1004 4:13"),
        ("PROGRAM a : A (q := 5);", "P1006 4:16"),
        ("PROGRAM a : A (i := TRUE);", "P2001 4:21"),
        ("PROGRAM a : A (o => go);", "P2001 4:21"),
        ("PROGRAM a : A (i => x);", "P1006 4:16"),
    ] {
        assert_eq!(messages(inner), want, "{inner}");
    }
    let many: String = (0..65).map(|i| format!("TASK t{i} (INTERVAL := T#1s); ")).collect();
    assert!(messages(&format!("{many} PROGRAM b WITH t1 : Bg;")).starts_with("P4003 4:"));
}

/// A library can be checked by itself; that there is nothing to run is said by who wants to run it.
#[test]
fn nothing_to_run() {
    for text in ["FUNCTION f : INT f := 1; END_FUNCTION", "", "CONFIGURATION c RESOURCE r ON x END_RESOURCE END_CONFIGURATION"] {
        let built = build(text);
        assert!(built.hir.tasks.is_empty() && built.codes().is_empty(), "{text}: {}", built.codes());
    }
    let mut sink = Sink::new();
    assert!(crate::hir::build(&[], &Sources::new(), &mut sink).tasks.is_empty() && sink.diags.is_empty());
}

#[test]
fn in_outs_of_programs_are_never_bound() {
    assert_eq!(build("PROGRAM p VAR_IN_OUT x : INT; END_VAR END_PROGRAM").codes(), "P3007 1:9");
    let text = "PROGRAM p VAR_IN_OUT x : INT; END_VAR END_PROGRAM\nCONFIGURATION c PROGRAM q : p; END_CONFIGURATION";
    assert_eq!(build(text).codes(), "P3007 2:25");
}

#[test]
fn only_what_a_task_reaches_is_marked() {
    let text = "FUNCTION used : INT used := deep(); END_FUNCTION FUNCTION deep : INT deep := 1; END_FUNCTION FUNCTION idle : INT idle := 1; END_FUNCTION \
        FUNCTION_BLOCK fb VAR x : INT; END_VAR x := used(); END_FUNCTION_BLOCK PROGRAM p VAR f : fb; t : TON; END_VAR f(); END_PROGRAM";
    let built = build(text);
    let reached: Vec<_> = built.hir.pous.iter().filter(|p| p.reachable).map(|p| p.name.as_str()).collect();
    assert_eq!(reached, ["used", "deep", "fb", "p"]);
}

/// §3.5: a global of the resource hides one of the configuration.
#[test]
fn inner_globals_hide_outer_ones() {
    let text = "PROGRAM p VAR_EXTERNAL g : REAL; END_VAR g := 1.5; END_PROGRAM CONFIGURATION c VAR_GLOBAL g : INT; END_VAR RESOURCE r ON x VAR_GLOBAL g : REAL; END_VAR PROGRAM q : p; END_RESOURCE END_CONFIGURATION";
    assert_eq!(build(text).codes(), "");
}

#[test]
fn several_resources() {
    let text = "PROGRAM p END_PROGRAM CONFIGURATION c RESOURCE r ON x PROGRAM q : p; END_RESOURCE RESOURCE s ON x PROGRAM q : p; END_RESOURCE END_CONFIGURATION";
    assert_eq!(build(text).codes(), "");
}
