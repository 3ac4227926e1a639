//! Error conditions: what a constant is refused for, and what happens to the same value at run time.
//! From: language reference §11; docs/adr/0005.

use takt_base::{Nanos, Severity};
use takt_image::Trap;
use takt_tests::plc::{Plc, check, check_in, compile_st, fault};

const TYPES: &str = "TYPE Pct : INT (0..100); S : STRUCT n : Pct; END_STRUCT; END_TYPE
FUNCTION half : Pct VAR_INPUT x : Pct; END_VAR half := x / 2; END_FUNCTION
FUNCTION bad : Pct VAR_INPUT x : INT; END_VAR bad := x; END_FUNCTION
FUNCTION_BLOCK keep VAR_INPUT x : Pct; END_VAR VAR_OUTPUT y : INT; END_VAR y := x; END_FUNCTION_BLOCK";
const VARS: &str =
    "i, j, k : INT; n : Pct; s : S; a : ARRAY[1..3] OF Pct; f : keep; m : ARRAY[0..1, 5..6] OF INT; t : STRING[5] := 'abc';
    w : WSTRING[5]; c : CHAR; d : DINT; l : LINT; u : USINT; x : REAL; y : LREAL; b : BYTE; p : TIME; v : UINT;";

fn text(body: &str) -> String {
    format!("{TYPES}\nPROGRAM p VAR {VARS} END_VAR\n{body}\nEND_PROGRAM").replace('\n', " ")
}

/// The trap of statements whose values are not known before run time.
fn traps(body: &str, trap: Trap) {
    assert_eq!(fault(&text(body)).0, trap, "{body}");
}

/// The codes of the errors of a statement.
fn refused(body: &str, code: &str) {
    let diags = compile_st(&text(body)).diags;
    let errors: Vec<_> = diags.iter().filter(|d| d.severity == Severity::Error).map(|d| d.code.text()).collect();
    assert_eq!(errors, [code], "{body}");
}

fn gives(body: &str, expected: &[(&str, &str)]) {
    check_in(TYPES, VARS, body, expected);
}

/// "subrange exceeded": F0703, whatever the value is stored into.
#[test]
fn subranges() {
    for store in [
        "n := i;",
        "s.n := i;",
        "a[2] := i;",
        "a[j + 1] := i;",
        "f(x := i);",
        "f.x := i;",
        "k := half(i);",
        "k := half(x := i);",
        "k := bad(i);",
        "n := bad(i);",
        "n := SEL(TRUE, 5, i);",
        "n := MAX(i, 5);",
    ] {
        traps(&format!("i := 101; {store}"), Trap::Range);
        if !store.contains("MAX") {
            traps(&format!("i := -1; {store}"), Trap::Range);
        }
        gives(&format!("i := 100; {store} i := 0; {store}"), &[]);
    }
    refused("n := 101;", "P2004");
    refused("n := -1;", "P2004");
    refused("f(x := 200);", "P2004");
}

/// A range is checked before anything is stored.
#[test]
fn a_refused_value_is_not_stored() {
    let mut plc = Plc::new(&text("n := 7; i := 300; n := i;"));
    assert!(plc.scan(0).is_err());
    assert_eq!(plc.get("p.n"), "7");
}

/// "array index out of range": F0702.
#[test]
fn indices() {
    for (index, body) in
        [("0", "k := a[i];"), ("4", "a[i] := 5;"), ("4", "k := m[0, i];"), ("2", "m[i, 5] := 1;"), ("-1", "m[i, 5] := 1;")]
    {
        traps(&format!("i := {index}; {body}"), Trap::Index);
    }
    refused("k := a[0];", "P2009");
    refused("k := a[4];", "P2009");
    refused("m[0, 7] := 1;", "P2009");
}

/// "string index error": F0707 beyond the current length; "result longer than capacity": truncated.
#[test]
fn strings() {
    for index in ["0", "4", "6", "-1"] {
        traps(&format!("i := {index}; c := t[i];"), Trap::StringIndex);
        traps(&format!("i := {index}; t[i] := 'x';"), Trap::StringIndex);
    }
    gives("t := CONCAT(t, 'defgh'); k := LEN(t);", &[("t", "'abcde'"), ("k", "5")]);
    gives("w := STRING_TO_WSTRING(CONCAT(t, t));", &[("w", "\"abcab\"")]);
    refused("t := 'abcdef';", "P2004");
}

/// "integer overflow": wraps; constant: refused.
#[test]
fn overflow() {
    gives(
        "i := 32767; i := i + 1; u := u - 1; l := l - 1; d := 2147483647; d := d * 2;",
        &[("i", "-32768"), ("u", "255"), ("d", "-2")],
    );
    refused("i := 32767 + 1;", "P2004");
    refused("u := USINT#200 + USINT#100;", "P2004");
}

/// "division by zero": F0701 for integers, IEEE for reals; MOD 0 is 0.
#[test]
fn division() {
    for ty in ["SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT"] {
        let text = format!("PROGRAM p VAR a : {ty} := 7; z, q : {ty}; END_VAR q := DIV(a, z); END_PROGRAM");
        assert_eq!(fault(&text).0, Trap::DivisionByZero, "{ty}");
        check(&format!("a : {ty} := 7; z, q : {ty} := 3;"), "z := 0; q := a MOD z;", &[("q", "0")]);
    }
    check(
        "a : REAL := 1.0; z, q, r : REAL; n : BOOL;",
        "q := a / z; r := -a / z; n := NOT IS_VALID(z / z);",
        &[("q", "Infinity"), ("r", "-Infinity"), ("n", "TRUE")],
    );
    refused("i := j / 0;", "P2011");
    refused("i := j MOD 0;", "P2011");
}

/// "SQRT(-), LN(<=0), ASIN(>1)": NaN, or an infinity.
#[test]
fn domains() {
    for call in ["SQRT(-one)", "LN(-one)", "LOG(-one)", "ASIN(two)", "ACOS(-two)", "SIN(one / zero)", "-one ** 0.5"] {
        for ty in ["REAL", "LREAL"] {
            let vars = format!("zero : {ty}; one : {ty} := 1.0; two : {ty} := 2.0; r : {ty}; nan : BOOL;");
            check(&vars, &format!("r := {call}; nan := r <> r;"), &[("nan", "TRUE")]);
        }
    }
    check("z, r : REAL;", "r := LN(z);", &[("r", "-Infinity")]);
}

/// "shift count negative": the input; "MUX selector out of range": the first input.
#[test]
fn shifts_and_selectors() {
    gives("b := 16#81; i := -3; b := SHL(b, i); b := SHR(b, i);", &[("b", "129")]);
    gives("i := 3; k := MUX(i, 10, 11, 12); i := -1; j := MUX(i, 10, 11, 12);", &[("k", "10"), ("j", "10")]);
    refused("b := SHL(b, -1);", "P2004");
}

/// "time/date result out of range": wraps in 64 bits.
#[test]
fn durations() {
    check("t : TIME := T#-9223372036854775807ns; u : TIME;", "u := t - T#10ns;", &[("u", "T#106751d23h47m16s854ms775us799ns")]);
    gives("p := T#1s; i := 0; p := p / i;", &[("p", "T#0s")]);
}

/// "function without result assigned on some path": its default value.
#[test]
fn results() {
    let f = "FUNCTION f : INT VAR_INPUT x : BOOL; END_VAR IF x THEN f := 5; END_IF; END_FUNCTION
        FUNCTION g : STRING[5] VAR_INPUT x : BOOL; END_VAR IF x THEN g := 'abc'; END_IF; END_FUNCTION";
    check_in(
        f,
        "x : BOOL := TRUE; a, b : INT := 9; s, t : STRING[5] := 'old';",
        "a := f(x); b := f(NOT x); s := g(x); t := g(NOT x);",
        &[("a", "5"), ("b", "0"), ("s", "'abc'"), ("t", "''")],
    );
}

/// "loop fails to terminate": F0705.
#[test]
fn endless_loops() {
    for body in
        ["WHILE i = 0 DO j := j + 1; END_WHILE", "REPEAT j := j + 1; UNTIL i <> 0 END_REPEAT", "WHILE TRUE DO ; END_WHILE"]
    {
        let mut plc = Plc::new(&text(body));
        let fault = plc.scan_within(0, Nanos::from_millis(50)).expect_err("it does not end");
        assert_eq!(fault.trap, Trap::Watchdog, "{body}");
    }
}

/// "FOR with BY = 0": F0710; "stack overflow": F0704.
#[test]
fn steps_and_depth() {
    traps("FOR i := 1 TO 5 BY j DO k := k + 1; END_FOR", Trap::ForStep);
    traps("FOR i := 5 TO 1 BY j DO k := k + 1; END_FOR", Trap::ForStep);
    refused("FOR i := 1 TO 5 BY 0 DO k := k + 1; END_FOR", "P3006");
    let deep = "FUNCTION deep : DINT VAR_INPUT n : DINT; END_VAR deep := deep(n + 1) + n; END_FUNCTION
        PROGRAM p VAR r : DINT; END_VAR r := deep(1); END_PROGRAM";
    assert_eq!(fault(deep).0, Trap::StackOverflow);
}

/// After a fault the same instance can run again, as a task does that is started anew.
#[test]
fn a_fault_leaves_the_engines_usable() {
    let mut plc = Plc::new(&text("k := k + 1; j := 100 / i; i := i + 1;"));
    assert!(plc.scan(0).is_err());
    plc.set("p.i", "5");
    assert_eq!(plc.scan(10), Ok(()));
    assert_eq!([plc.get("p.k"), plc.get("p.j")], ["2", "20"]);
}
