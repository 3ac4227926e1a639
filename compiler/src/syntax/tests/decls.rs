//! Declarations: types, sections, initial values, units, configurations (§2, §3.9, §4, §10.1).

use super::*;

fn same(cases: &[(&str, &str)]) {
    for (text, want) in cases {
        assert_eq!(tree(text), *want, "{text}");
    }
}

/// A type declaration or variable, without the wrapping.
fn types(cases: &[(&str, &str)]) {
    for (text, want) in cases {
        assert_eq!(tree(&format!("TYPE T1 : {text} END_TYPE")), format!("(type T1 {want})"), "{text}");
    }
}

fn vars(cases: &[(&str, &str)]) {
    for (text, want) in cases {
        assert_eq!(tree(&format!("PROGRAM p VAR {text} END_VAR END_PROGRAM")), format!("(program p (var {want}))"), "{text}");
    }
}

#[test]
fn type_declarations() {
    types(&[
        ("REAL := 50.0;", "REAL := 50.0"),
        ("(A, B, C);", "(enum A B C)"),
        ("(A := 1, B, C := 10) USINT;", "(enum USINT A=1 B C=10)"),
        ("DWORD (R := 16#FF0000, W := R OR 1) := R;", "(enum DWORD R=16711680b W=(OR R 1)) := R"),
        ("INT (0..100) := 50;", "INT(0..100) := 50"),
        ("INT (-N..N + 1);", "INT((- N)..(+ N 1))"),
        ("STRING;", "STRING"),
        ("STRING[80] := 'x';", "STRING[80] := 'x'"),
        ("STRING(LEN);", "STRING[LEN]"),
        ("WSTRING[5];", "WSTRING[5]"),
        ("ARRAY [0..9, -1..1] OF ARRAY [1..2] OF REAL;", "[0..9,-1..1][1..2]REAL"),
        (
            "STRUCT a, b : INT := 1; c : (X, Y) := Y; d : STRUCT e : BOOL; END_STRUCT; END_STRUCT",
            "(struct (a b : INT := 1) (c : (enum X Y) := Y) (d : (struct (e : BOOL))))",
        ),
        ("STRUCT END_STRUCT;", "(struct)"),
        ("Other := (a := 5, b := [1, 2], c := (d := 1));", "Other := {a=5 b=[1 2] c={d=1}}"),
    ]);
    same(&[("TYPE A : INT; B : A; END_TYPE TYPE END_TYPE", "(type A INT) (type B A) ")]);
}

#[test]
fn variables_and_initial_values() {
    vars(&[
        ("a, b : INT;", "(a b : INT)"),
        ("a AT %IX0.0 : BOOL; AT %QW3 : INT; b AT %Q* : BYTE;", "(a at %IX0.0 : BOOL) (at %QW3 : INT) (b at %QX* : BYTE)"),
        ("t : TON := (PT := T#1s);", "(t : TON := {PT=TIME#1000000000})"),
        ("a : ARRAY [1..9] OF INT := [1, 2, 3(0), 2(7, 8), 4()];", "(a : [1..9]INT := [1 2 3x(0) 2x(7 8) 4x()])"),
        ("a : ARRAY [1..2] OF P := [(x := 1), 2((x := 0))];", "(a : [1..2]P := [{x=1} 2x({x=0})])"),
        ("a : ARRAY [1..2] OF INT := [N(5)];", "(a : [1..2]INT := [(call N 5)])"),
        ("a : ARRAY [1..2] OF ARRAY [1..1] OF INT := [[1], [2]];", "(a : [1..2][1..1]INT := [[1] [2]])"),
        ("a : INT := (1 + 2) * 3;", "(a : INT := (* (+ 1 2) 3))"),
        ("s : (idle, run) := idle;", "(s : (enum idle run) := idle)"),
        ("c : Color := Color#Red;", "(c : Color := Color#Red)"),
    ]);
}

#[test]
fn sections_and_qualifiers() {
    let text = "FUNCTION_BLOCK b VAR_INPUT CONSTANT x : INT; END_VAR VAR_OUTPUT RETAIN y : INT; END_VAR; VAR_IN_OUT z : INT; END_VAR \
        VAR_TEMP t : INT; END_VAR VAR_EXTERNAL CONSTANT e : INT; END_VAR VAR NON_RETAIN n : INT; END_VAR VAR END_VAR \
        VAR_INPUT r : BOOL R_EDGE; f : BOOL F_EDGE; END_VAR END_FUNCTION_BLOCK VAR_GLOBAL CONSTANT g : INT := 1; END_VAR";
    let want = "(fb b (input constant (x : INT)) (output retain (y : INT)) (inout (z : INT)) (temp (t : INT)) \
        (external constant (e : INT)) (var non_retain (n : INT)) (var) (input (r : BOOL rising) (f : BOOL falling))) \
        (global constant (g : INT := 1))";
    assert_eq!(tree(text), want);
}

#[test]
fn units() {
    same(&[
        ("FUNCTION f : REAL f := 1.0; END_FUNCTION", "(function f : REAL (:= f 1.0))"),
        ("FUNCTION f : STRING(30) END_FUNCTION", "(function f : STRING[30])"),
        ("FUNCTION f VAR_OUTPUT o : INT; END_VAR o := 1; END_FUNCTION", "(function f (output (o : INT)) (:= o 1))"),
        ("FUNCTION f : VOID END_FUNCTION;", "(function f)"),
        ("PROGRAM p; VAR a : INT; END_VAR END_PROGRAM", "(program p (var (a : INT)))"),
        (
            "{external} FUNCTION f : INT END_FUNCTION FUNCTION g : INT END_FUNCTION",
            "(function external f : INT) (function g : INT)",
        ),
        ("{external} {other} (* c *) FUNCTION_BLOCK f END_FUNCTION_BLOCK", "(fb external f)"),
        ("", ""),
    ]);
}

#[test]
fn configurations() {
    same(&[
        (
            "CONFIGURATION c VAR_GLOBAL a : INT; END_VAR TASK t (PRIORITY := 0, SINGLE := a); PROGRAM p WITH t : P1; END_CONFIGURATION",
            "(configuration c (global (a : INT)) (resource (task t single=a priority=0) (instance p with t : P1)))",
        ),
        (
            "CONFIGURATION c RESOURCE r ON PLC VAR_GLOBAL a : INT; END_VAR PROGRAM RETAIN p : P1 (x := a, y := 5, z => %QW1); END_RESOURCE \
             RESOURCE s ON PLC END_RESOURCE END_CONFIGURATION",
            "(configuration c (resource r (global (a : INT)) (instance retain p : P1 x:=a y:=5 z=>%QW1)) (resource s))",
        ),
        (
            "CONFIGURATION c RESOURCE r ON PLC TASK t (INTERVAL := T#10ms, PRIORITY := 1); TASK u (SINGLE := %IX0.0, PRIORITY := 2); \
             PROGRAM a WITH t : A; PROGRAM b WITH u : B; PROGRAM d : D; END_RESOURCE END_CONFIGURATION",
            "(configuration c (resource r (task t interval=TIME#10000000 priority=1) (task u single=%IX0.0 priority=2) \
             (instance a with t : A) (instance b with u : B) (instance d : D)))",
        ),
    ]);
}

#[test]
fn unsupported_constructs_say_so_once_and_later_units_are_parsed() {
    let cases = [
        "CLASS c VAR a : INT; END_VAR METHOD m : INT m := 1; END_METHOD END_CLASS",
        "INTERFACE i METHOD m : INT END_METHOD END_INTERFACE",
        "NAMESPACE a.b NAMESPACE c PROGRAM q END_PROGRAM END_NAMESPACE END_NAMESPACE",
        "FUNCTION_BLOCK b METHOD PUBLIC m : INT VAR x : INT; END_VAR m := x; END_METHOD END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b VAR x : INT; END_VAR x := 1; METHOD m x := 2; END_METHOD END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b PROPERTY q : INT GET q := 1; END_GET END_PROPERTY END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b EXTENDS c VAR x : INT; END_VAR x := 1; END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b IMPLEMENTS c, d x := 1; END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK FINAL b END_FUNCTION_BLOCK",
        "PROGRAM q INITIAL_STEP a: x(N); END_STEP TRANSITION FROM a TO b := y; END_TRANSITION STEP b: END_STEP END_PROGRAM",
        "PROGRAM q VAR x : INT; END_VAR LD a\nAND b\nST q\nEND_PROGRAM",
        "PROGRAM q END_PROGRAM ACTION a: x := 1; END_ACTION",
        "PROGRAM q VAR_ACCESS a : b.c : INT READ_ONLY; END_VAR END_PROGRAM",
        "CONFIGURATION c VAR_CONFIG a.b AT %IX0.0 : BOOL; END_VAR END_CONFIGURATION",
        "CONFIGURATION c PROGRAM q : Q (f WITH t); END_CONFIGURATION",
        "FUNCTION_BLOCK b VAR_STAT x : INT; END_VAR END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b VAR PRIVATE x : INT; END_VAR END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b VAR PERSISTENT x : INT; END_VAR END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b VAR p1 : REF_TO INT; END_VAR END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b VAR p1 : POINTER TO ARRAY [0..1] OF INT; x : INT; END_VAR END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b VAR a : ARRAY [*] OF INT; END_VAR END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b VAR a : TON(PT := T#1s); END_VAR END_FUNCTION_BLOCK",
        "TYPE S : STRUCT OVERLAP a : INT; END_STRUCT; END_TYPE",
        "TYPE S : STRUCT a AT %X4.2 : BOOL; END_STRUCT; END_TYPE",
        "TYPE U : UNION a : REAL; b : DWORD; END_UNION; END_TYPE",
        "TYPE S : a.b.c; END_TYPE",
        "USING a.b;",
    ];
    for text in cases {
        let (file, diags, sources) = parse(&format!("{text}\nPROGRAM last x := 1; END_PROGRAM"));
        let messages: String = diags.iter().map(|d| render(d, &sources)).collect();
        let codes: Vec<_> = diags.iter().map(|d| d.code.text()).collect();
        assert_eq!(codes, ["P0012"], "{text}\n{messages}");
        assert!(print::file(&file).ends_with("(program last (:= x 1))"), "{text}\n{}", print::file(&file));
    }
}
