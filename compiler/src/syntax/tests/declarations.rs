//! Units, sections, types, initial values and configurations (language reference §2, §3, §4, §10.1).

use super::*;

/// The sections of a program, without mistakes.
fn sections(text: &str) -> String {
    let printed = tree(&format!("PROGRAM p {text} END_PROGRAM"));
    printed.strip_prefix("(program p ").and_then(|s| s.strip_suffix(')')).unwrap_or(&printed).to_owned()
}

/// A declaration in a VAR section.
fn var(text: &str) -> String {
    let printed = sections(&format!("VAR {text} END_VAR"));
    printed.strip_prefix("(var ").and_then(|s| s.strip_suffix(')')).unwrap_or(&printed).to_owned()
}

/// The declarations of a TYPE section.
fn types(text: &str) -> String {
    tree(&format!("TYPE {text} END_TYPE"))
}

#[test]
fn units() {
    assert_eq!(tree("FUNCTION f : INT f := 1; END_FUNCTION"), "(function f : INT (:= f 1))");
    assert_eq!(tree("FUNCTION f : STRING[20] END_FUNCTION"), "(function f : STRING[20])");
    assert_eq!(tree("FUNCTION f : ARRAY [0..1] OF INT END_FUNCTION"), "(function f : [0..1]INT)");
    assert_eq!(tree("FUNCTION f END_FUNCTION FUNCTION g : VOID END_FUNCTION"), "(function f) (function g)");
    assert_eq!(tree("FUNCTION_BLOCK b END_FUNCTION_BLOCK PROGRAM p END_PROGRAM;"), "(fb b) (program p)");
    assert_eq!(tree(""), "");
    assert_eq!(
        tree("{external} FUNCTION f : INT END_FUNCTION FUNCTION g END_FUNCTION"),
        "(function external f : INT) (function g)"
    );
}

/// §3.1, §3.2.
#[test]
fn sections_and_qualifiers() {
    let kinds = "VAR END_VAR VAR_TEMP END_VAR VAR_INPUT END_VAR VAR_OUTPUT END_VAR VAR_IN_OUT END_VAR VAR_EXTERNAL END_VAR";
    assert_eq!(sections(kinds), "(var) (temp) (input) (output) (inout) (external)");
    assert_eq!(sections("VAR CONSTANT c : INT := 1; END_VAR"), "(var constant (c : INT := 1))");
    assert_eq!(sections("VAR RETAIN r : INT; END_VAR VAR NON_RETAIN END_VAR;"), "(var retain (r : INT)) (var non_retain)");
    assert_eq!(
        sections("VAR_INPUT CONSTANT c : INT; END_VAR VAR_OUTPUT RETAIN END_VAR"),
        "(input constant (c : INT)) (output retain)"
    );
    assert_eq!(
        tree("VAR_GLOBAL CONSTANT g : INT := 1; END_VAR VAR_GLOBAL RETAIN END_VAR"),
        "(global constant (g : INT := 1)) (global retain)"
    );
}

#[test]
fn variables() {
    assert_eq!(var("a, b, c : INT := 5;"), "(a b c : INT := 5)");
    assert_eq!(var("a AT %QX0.1 : BOOL := TRUE; AT %IW3 : INT;"), "(a at %QX0.1 : BOOL := true) (at %IW3 : INT)");
    assert_eq!(sections("VAR_INPUT c : BOOL R_EDGE; d : BOOL F_EDGE; END_VAR"), "(input (c : BOOL rising) (d : BOOL falling))");
    assert_eq!(var("t : TON := (PT := T#1s, IN := TRUE);"), "(t : TON := {PT=TIME#1000000000 IN=true})");
    assert_eq!(
        var("s : STRING; t : STRING[80]; u : STRING(N) := 'x'; w : WSTRING[2 * N];"),
        "(s : STRING) (t : STRING[80]) (u : STRING[N] := 'x') (w : WSTRING[(* 2 N)])"
    );
    assert_eq!(
        var("e : (idle, run) := idle; s : STRUCT x : INT; END_STRUCT;"),
        "(e : (enum idle run) := idle) (s : (struct (x : INT)))"
    );
    assert_eq!(var("p : INT (0..100) := 50; q : INT(-N..N);"), "(p : INT(0..100) := 50) (q : INT((- N)..N))");
}

/// §2.7.
#[test]
fn arrays() {
    assert_eq!(var("a : ARRAY [0..9] OF INT;"), "(a : [0..9]INT)");
    assert_eq!(var("a : ARRAY[-1..1, 0..N - 1] OF ARRAY [1..2] OF STRING[5];"), "(a : [-1..1,0..(- N 1)][1..2]STRING[5])");
    assert_eq!(var("a : ARRAY [0..9] OF INT := [1, 2, 3(0), 2(7, 8), 4()];"), "(a : [0..9]INT := [1 2 3x(0) 2x(7 8) 4x()])");
    assert_eq!(
        var("a : ARRAY [0..1] OF P := [(x := 1), 2((x := 0, y := [1, 2]))];"),
        "(a : [0..1]P := [{x=1} 2x({x=0 y=[1 2]})])"
    );
    assert_eq!(var("a : ARRAY [0..1] OF INT := [f(1), (2 + 3) * 4, [5]];"), "(a : [0..1]INT := [(call f 1) (* (+ 2 3) 4) [5]])");
}

/// §2.4 to §2.8.
#[test]
fn type_declarations() {
    assert_eq!(types("Freq : REAL := 50.0;"), "(type Freq REAL := 50.0)");
    assert_eq!(types("Light : (Red, Amber, Green) := Amber;"), "(type Light (enum Red Amber Green) := Amber)");
    assert_eq!(types("L : (A := 1, B, C := 10) USINT := B;"), "(type L (enum USINT A=1 B C=10) := B)");
    assert_eq!(
        types("Col : DWORD (Red := 16#FF, W := Red OR 1) := Red;"),
        "(type Col (enum DWORD Red=255b W=(OR Red 1)) := Red)"
    );
    assert_eq!(types("Pct : INT (0..100) := 50; T : ARRAY [0..1] OF Pct;"), "(type Pct INT(0..100) := 50) (type T [0..1]Pct)");
    assert_eq!(
        types("S : STRUCT a, b : INT := 1; c : T := [1]; END_STRUCT; U : S := (a := 2);"),
        "(type S (struct (a b : INT := 1) (c : T := [1]))) (type U S := {a=2})"
    );
    assert_eq!(types("S : STRUCT a : INT; END_STRUCT E : (X);"), "(type S (struct (a : INT))) (type E (enum X))");
    assert_eq!(types("S : STRING[20] := 'abc';"), "(type S STRING[20] := 'abc')");
}

/// §10.1.
#[test]
fn configurations() {
    let text = "CONFIGURATION c VAR_GLOBAL g : INT; END_VAR TASK t(PRIORITY := 1, INTERVAL := T#20ms); PROGRAM p WITH t : Main; END_CONFIGURATION";
    assert_eq!(
        tree(text),
        "(configuration c (global (g : INT)) (resource (task t interval=TIME#20000000 priority=1) (instance p with t : Main)))"
    );
    let text = "CONFIGURATION c RESOURCE r ON PLC VAR_GLOBAL END_VAR TASK t(SINGLE := g, PRIORITY := 0); PROGRAM RETAIN p : Main(a := g, b := 5, q => %QX0.0); PROGRAM q : M; END_RESOURCE RESOURCE s ON PLC END_RESOURCE END_CONFIGURATION";
    let want = "(configuration c (resource r (global) (task t single=g priority=0) (instance retain p : Main a:=g b:=5 q=>%QX0.0) (instance q : M)) (resource s))";
    assert_eq!(tree(text), want);
}

/// A keyword as a name is reported once, at its declaration, and then is a name.
#[test]
fn keywords_as_names() {
    assert_eq!(codes("PROGRAM p VAR step : INT; END_VAR step := step + 1; END_PROGRAM"), ["P1002 1:15"]);
    assert_eq!(codes("PROGRAM p VAR a, to, b : INT; END_VAR a := b; END_PROGRAM"), ["P1002 1:18"]);
    assert_eq!(codes("PROGRAM p VAR int : BOOL; END_VAR END_PROGRAM"), ["P1002 1:15"]);
    assert_eq!(codes("PROGRAM program END_PROGRAM"), ["P1002 1:9"]);
    assert_eq!(codes("TYPE real : INT; END_TYPE"), ["P1002 1:6"]);
    assert_eq!(codes("TYPE e : (on, off); END_TYPE"), ["P1002 1:11"]);
    assert_eq!(codes("PROGRAM p\nexit := TRUE;\ny := 1;\nEND_PROGRAM"), ["P1002 2:1"]);
}
