//! Unit tests in ST (docs/guide/testing.md): which programs are tests, what only they may do, what assertions take.

use super::*;
use crate::hir::build_tests;

/// Messages of statements in a test program.
fn in_test(body: &str) -> String {
    check(&format!("{TYPES} {{test}} PROGRAM p VAR\n{VARS}\nEND_VAR\n{body}\nEND_PROGRAM"))
}

/// The natives that the statements of a program call.
fn natives(body: &str) -> String {
    let built = build(&program(TYPES, VARS, body));
    assert!(built.diags.is_empty(), "{body}: {}", built.text());
    let name = |s: &Stmt| match &s.kind {
        StmtKind::Call(Expr { kind: ExprKind::Native { name, .. }, .. }) => name.clone(),
        other => format!("{other:?}"),
    };
    built.pou("p").body.iter().map(name).collect::<Vec<_>>().join(" ")
}

#[test]
fn arguments_are_unified_as_those_of_the_operator() {
    for (body, native) in [
        ("ASSERT(b1);", "ASSERT_EQ_BOOL"),
        ("ASSERT_FALSE(IN := b1, MSG := s);", "ASSERT_EQ_BOOL"),
        ("ASSERT_EQ(3, i);", "ASSERT_EQ_INT"),
        ("ASSERT_EQ(i, d, 'text');", "ASSERT_EQ_DINT"),
        ("ASSERT_EQ(ACTUAL := vUSINT, EXPECTED := 200);", "ASSERT_EQ_USINT"),
        ("ASSERT_EQ(1, 2);", "ASSERT_EQ_DINT"),
        ("ASSERT_NE(1, 2.5);", "ASSERT_NE_LREAL"),
        ("ASSERT_LT(1, r);", "ASSERT_LT_REAL"),
        ("ASSERT_GE(i, r);", "ASSERT_GE_REAL"),
        ("ASSERT_EQ(Red, light);", "ASSERT_EQ_INT"),
        ("ASSERT_EQ(light, Light#Green);", "ASSERT_EQ_INT"),
        ("ASSERT_EQ(White, col);", "ASSERT_EQ_DWORD"),
        ("ASSERT_EQ('abc', s8);", "ASSERT_EQ_STRING"),
        ("ASSERT_EQ(ws, \"x\");", "ASSERT_EQ_WSTRING"),
        ("ASSERT_EQ(T#1s, ton1.ET);", "ASSERT_EQ_TIME"),
        ("ASSERT_EQ(16#FF, vWORD);", "ASSERT_EQ_WORD"),
        ("ASSERT_EQ(50, pct);", "ASSERT_EQ_INT"),
        ("ASSERT_NEAR(1.0, r, 0.1);", "ASSERT_NEAR_REAL"),
        ("ASSERT_NEAR(T#1s, t, T#10ms, 'm');", "ASSERT_NEAR_TIME"),
        ("ASSERT_NEAR(10, i, 2);", "ASSERT_NEAR_INT"),
        ("assert_le(p1.x, a[1]);", "ASSERT_LE_REAL"),
    ] {
        assert_eq!(natives(body), native, "{body}");
    }
}

#[test]
fn wrong_arguments_are_reported() {
    for (body, codes) in [
        ("ASSERT();", "P2013 4:1"),
        ("ASSERT(b1, s, s);", "P2013 4:15"),
        ("ASSERT_EQ(1);", "P2013 4:1"),
        ("ASSERT_EQ(1, ACTUAL := 2, EXPECTED := 3);", "P2013 4:39"),
        ("ASSERT_EQ(EXPECTED := 1, ACTAUL := 2);", "P1006 4:26"),
        ("ASSERT(i);", "P2001 4:8"),
        ("ASSERT(b1, 3);", "P2001 4:12"),
        ("ASSERT_EQ(i, s);", "P2002 4:1"),
        ("ASSERT_EQ(p1, p2);", "P2003 4:1"),
        ("ASSERT_NEAR(s, s, 1);", "P2003 4:1"),
        ("ASSERT_NEAR(r, r, s);", "P2001 4:19"),
        ("ASSERT_EQ(nothing, 1);", "P1003 4:11"),
        ("ASSERT_EQUAL(1, 1);", "P1003 4:1"),
    ] {
        assert_eq!(stmt(body), codes, "{body}");
    }
}

#[test]
fn a_function_of_the_project_wins() {
    let text = "FUNCTION ASSERT_EQ : BOOL VAR_INPUT a : STRING; END_VAR ASSERT_EQ := a = ''; END_FUNCTION\n\
        PROGRAM p VAR b : BOOL; END_VAR b := ASSERT_EQ('x'); END_PROGRAM";
    assert_eq!(check(text), "");
}

#[test]
fn only_tests_write_inputs_and_have_programs() {
    assert_eq!(in_test("%IX0.0 := TRUE; %IW2 := WORD#5;"), "");
    assert_eq!(stmt("%IX0.0 := TRUE;"), "P3013 4:1");
    let programs = |pragma: &str| {
        check(&format!(
            "PROGRAM Main VAR_INPUT i : INT; END_VAR VAR n : INT; END_VAR n := n + i; END_PROGRAM\n\
             {pragma} PROGRAM t VAR m : Main; END_VAR m(i := 3); ASSERT_EQ(3, m.n); END_PROGRAM"
        ))
    };
    assert_eq!(programs("{test}"), "");
    assert_eq!(programs(""), "P1004 2:20");
    assert_eq!(check("{test}\nPROGRAM t VAR x : t; END_VAR END_PROGRAM"), "P2015 2:19");
}

#[test]
fn a_pragma_stands_before_a_program() {
    for text in [
        "{test}\nFUNCTION f : INT f := 1; END_FUNCTION",
        "PROGRAM p\n{test}\nEND_PROGRAM",
        "PROGRAM p END_PROGRAM\n{test}",
        "{test scans := 0}\nPROGRAM p END_PROGRAM",
        "{test 'a', cycles := 3} PROGRAM p END_PROGRAM",
    ] {
        assert!(check(text).starts_with("T0001"), "{text}: {}", check(text));
    }
    assert_eq!(check("{TEST 'with , comma', interval := T#1ms, scans := 3}\nPROGRAM p END_PROGRAM"), "");
    assert_eq!(check("{testing} PROGRAM p END_PROGRAM"), "");
}

#[test]
fn tests_have_tasks_of_their_own() {
    let text =
        "PROGRAM main END_PROGRAM {test 'first', scans := 7} PROGRAM a END_PROGRAM {test interval := T#1s} PROGRAM b END_PROGRAM";
    let tasks = |hir: &Hir| hir.tasks.iter().map(|t| format!("{} {:?}", t.name, t.interval)).collect::<Vec<_>>();
    let machine = build(text).hir;
    assert_eq!(machine.tasks.iter().flat_map(|t| &t.programs).map(|p| p.name.as_str()).collect::<Vec<_>>(), ["main"]);
    let mut sources = Sources::new();
    let id = sources.add("a.st", text);
    let mut sink = Sink::new();
    let file = syntax::parse(&sources, id, &mut sink);
    let (hir, tests) = build_tests(&[(id, file)], &sources, &mut sink);
    let found: Vec<_> = tests.iter().map(|t| (t.name.as_str(), t.pou.as_str(), t.scans)).collect();
    assert_eq!(found, [("first", "a", 7), ("b", "b", 1)]);
    assert_eq!(tasks(&hir), ["a Some(Nanos(10000000))", "b Some(Nanos(1000000000))"]);
    assert!(!hir.pous.iter().any(|p| p.name == "main" && p.reachable));
}
