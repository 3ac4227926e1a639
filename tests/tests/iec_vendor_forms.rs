//! Forms of CODESYS (language reference, sections 2.7, 4, 5, 12): what is computed, and what gets a clear error.

use takt_base::{Code, Profile, Severity};
use takt_tests::cases::{Row, reject, run};
use takt_tests::plc::{check_profile, compile_in};

const ASSIGNMENTS: &[Row] = &[
    (
        "12",
        "",
        "a, b, n : INT; t : BOOL; c : BOOL := TRUE;",
        "IF (t := c) THEN n := 1; END_IF; b := (a := 5) + a * 2; n := n + (b := b + 1);",
        "t=TRUE a=5 b=16 n=17",
    ),
    (
        "12",
        "",
        "i, n : INT; l : ARRAY[0..3] OF BYTE; k : BYTE;",
        "WHILE (i := i + 1) < 4 DO n := n + i; END_WHILE; l[(i := 2)] := (k := 7);",
        "n=6 i=2 l[2]=7 k=7",
    ),
    ("12", "", "a, b : INT := 3; x : INT;", "x := a + (a := 10) + a;", "x=23 a=10"),
    (
        "12",
        "",
        "f : BOOL; n : INT;",
        "IF f AND (n := n + 1) > 0 THEN ; END_IF; IF f AND_THEN (n := n + 10) > 0 THEN ; END_IF;",
        "n=1",
    ),
    ("12", "", "s : INT (1..5); b : BYTE; r : REAL;", "r := (s := 4) + (b := 300 - 299);", "s=4 b=1 r=5.0"),
];

const OBJECTS: &str = "INTERFACE A METHOD v : INT END_METHOD END_INTERFACE INTERFACE B METHOD w : INT END_METHOD END_INTERFACE
    FUNCTION_BLOCK both IMPLEMENTS A, B VAR n : INT := 7; END_VAR METHOD v : INT v := n; END_METHOD METHOD w : INT w := n + 1; END_METHOD END_FUNCTION_BLOCK
    FUNCTION_BLOCK one IMPLEMENTS A METHOD v : INT v := 1; END_METHOD END_FUNCTION_BLOCK";

const QUERIES: &[Row] = &[
    (
        "2.10",
        OBJECTS,
        "x : both; y : one; a : A; b : B; t, u, v : BOOL; n : INT;",
        "a := x; t := __QUERYINTERFACE(a, b); IF t THEN n := b.w(); END_IF; a := y; u := __QUERYINTERFACE(a, b); v := b = 0;",
        "t=TRUE n=8 u=FALSE v=TRUE",
    ),
    (
        "2.10",
        OBJECTS,
        "x : both; a : A; p : POINTER TO both; t, u : BOOL; n : INT;",
        "t := __QUERYPOINTER(a, p); a := x; u := __QUERYPOINTER(a, p); IF u THEN n := p^.v(); END_IF;",
        "t=FALSE u=TRUE n=7",
    ),
];

const STATEMENTS: &[Row] = &[
    (
        "5.1",
        "FUNCTION f : INT VAR_INPUT a : INT; END_VAR IF a > 5 THEN RETURN a * 2; END_IF; RETURN 1; END_FUNCTION",
        "x, y : INT;",
        "x := f(6); y := f(2);",
        "x=12 y=1",
    ),
    ("5.1", "", "a, b, c : INT; p, q : BOOL;", "a := b := c := 4; p := TRUE; q S= p; p R= q;", "a=4 b=4 c=4 q=TRUE p=FALSE"),
    ("5.1", "", "i : INT;", "IF i THEN i := 5; ELSE i := 6; END_IF", "i=6"),
    ("5.1", "", "i : INT;", "again: i := i + 1; IF i < 3 THEN JMP again; END_IF;", "i=3"),
    ("2.5", "TYPE L : (a, b, c); END_TYPE", "x : L := L.b; t : BOOL;", "t := x < L.c; x := L.c;", "t=TRUE x=c"),
    ("2.5", "TYPE L : (a := 1, b, c := 10) USINT; END_TYPE", "x : L := b; i : USINT;", "i := x; x := c;", "i=2 x=c"),
    (
        "4.7",
        "FUNCTION_BLOCK f VAR_INPUT i : INT; END_VAR VAR_OUTPUT q : INT; r : BOOL; END_VAR q := i + 1; END_FUNCTION_BLOCK",
        "x : f; n : INT; t : BOOL;",
        "x(i := 4, q => n, r => ); x(5); x(i := 6, NOT r => t);",
        "n=5 x.q=7 t=TRUE",
    ),
    (
        "4.7",
        "FUNCTION f : INT VAR_INPUT i : INT; END_VAR VAR_OUTPUT q : INT; END_VAR q := i + 1; f := i; END_FUNCTION",
        "n, q : INT;",
        "n := f(4, q => q); f(i := 1); n := n + f(5, q => );",
        "n=9 q=5",
    ),
    ("2.4", "TYPE T : TON := (PT := T#2s); END_TYPE", "t : T; u : TON(PT := T#3s); n : TIME;", "n := t.PT + u.PT;", "n=T#5s"),
    (
        "4.2",
        "FUNCTION_BLOCK f VAR n : INT; END_VAR VAR_OUTPUT o : INT; END_VAR n := n + 1; o := n; END_FUNCTION_BLOCK",
        "a, b : f;",
        "a(); a(); b := a; b(); a();",
        "a.o=3 b.o=3",
    ),
    (
        "3.5",
        "VAR_GLOBAL CONSTANT n : INT := 3; END_VAR VAR_GLOBAL g : ARRAY[0..n] OF INT; END_VAR",
        "i : INT;",
        "g[n] := 4; .g[1] := 5; i := g[3] + .g[1];",
        "i=9",
    ),
    (
        "3.2",
        "FUNCTION_BLOCK f VAR_INPUT CONSTANT k : INT := 5; END_VAR VAR_OUTPUT o : INT; END_VAR o := k * 2; END_FUNCTION_BLOCK",
        "a : f; b : f := (k := 7);",
        "a(); b();",
        "a.o=10 b.o=14",
    ),
];

const STRINGS: &[Row] = &[
    ("2.7", "FUNCTION add : INT VAR_IN_OUT s : STRING[*]; END_VAR s := CONCAT(s, '12345'); add := LEN(s); END_FUNCTION",
        "a : STRING[4] := 'ab'; b : STRING[300] := 'xy'; c : STRING := ''; n, m : INT;", "n := add(a); m := add(s := b); add(c); add(c);",
        "a='ab12' n=7 b='xy12345' m=7 c='1234512345'"),
    ("2.7", "FUNCTION_BLOCK f VAR_IN_OUT s : STRING; END_VAR VAR n : INT; END_VAR n := LEN(s); s := CONCAT('<', s); END_FUNCTION_BLOCK
        FUNCTION_BLOCK g EXTENDS f SUPER^(); END_FUNCTION_BLOCK", "x : f; y : g; a : STRING(3) := 'abc'; b : STRING[9] := 'q';", "x(s := a); y(s := b);", "a='<ab' b='<q' x.n=3 y.n=1"),
    ("2.7", "FUNCTION outer VAR_IN_OUT s : STRING[*]; END_VAR inner(s); s[0] := 65; END_FUNCTION FUNCTION inner VAR_IN_OUT s : STRING[*]; END_VAR s := CONCAT(s, '!'); END_FUNCTION
        FUNCTION wide VAR_IN_OUT w : WSTRING[*]; END_VAR w := CONCAT(w, \"z\"); END_FUNCTION", "a : STRING[5] := 'ab'; w : WSTRING[2] := \"xy\";", "outer(a); wide(w);", "a='Ab!' w=\"xy\""),
];

const STARTS: &[Row] = &[
    (
        "3.1",
        "FUNCTION_BLOCK f VAR me : POINTER TO f := THIS; n : INT := get() + 1; m : INT := THIS^.get() + later; later : INT := 5; END_VAR
        METHOD get : INT get := 7; END_METHOD END_FUNCTION_BLOCK",
        "x : f; y : INT := x.n; b : INT := c + 1; c : INT := 4; q : POINTER TO f; t : BOOL;",
        "q := ADR(x); t := q = x.me;",
        "x.n=8 x.m=12 y=8 b=5 t=TRUE",
    ),
    (
        "3.1",
        "FUNCTION_BLOCK f VAR r : REFERENCE TO INT; n : INT; END_VAR
        METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; x : REFERENCE TO INT; END_VAR THIS^.r REF= x; END_METHOD
        n := r; r := 9; END_FUNCTION_BLOCK",
        "i : INT := 6; x : f(x := i);",
        "x();",
        "x.n=6 i=9",
    ),
    (
        "5.5",
        "",
        "n, m : INT; k : INT := 5;",
        "CASE k OF 1..4: n := 1; 3..5: n := 2; 4..9: n := 3; END_CASE; CASE n OF 2: m := 1; 2: m := 2; END_CASE;",
        "n=2 m=1",
    ),
    (
        "4.5",
        "FUNCTION_BLOCK f VAR_OUTPUT q : INT; END_VAR ; END_FUNCTION_BLOCK ACTION up: q := q + 1; END_ACTION",
        "x : f; n : INT;",
        "\nCAL add()\nCAL add\nCAL x.up()\nLD n\nEQ 20\nCALC x.up\nACTION add: n := n + 10; END_ACTION\n",
        "n=20 x.q=2",
    ),
];

#[test]
fn s3_1_more_initial_values_and_calls() {
    run(Profile::Codesys, STARTS);
}

#[test]
fn s2_7_strings_of_any_length() {
    run(Profile::Codesys, STRINGS);
    reject(Profile::Std, &[("2.7", "FUNCTION f VAR_IN_OUT s : STRING[*]; END_VAR ; END_FUNCTION", "P0014")]);
    reject(
        Profile::Codesys,
        &[
            ("2.7", "PROGRAM p VAR s : STRING[*]; END_VAR ; END_PROGRAM", "P2019"),
            (
                "2.7",
                "FUNCTION f VAR_IN_OUT s : STRING; END_VAR ; END_FUNCTION PROGRAM p VAR s : STRING[200]; w : WSTRING; END_VAR f(s); f(w); END_PROGRAM",
                "P2001 P2001",
            ),
        ],
    );
}

#[test]
fn s12_assignments_in_expressions() {
    run(Profile::Codesys, ASSIGNMENTS);
}
#[test]
fn s2_10_queries() {
    run(Profile::Codesys, QUERIES);
}
#[test]
fn s5_statements_and_calls() {
    run(Profile::Codesys, STATEMENTS);
}

/// Each gets one P0012 with advice, and the parser goes on behind it.
#[test]
fn s12_what_waits() {
    let program = |body: &str| format!("PROGRAM p VAR i : INT; b : BOOL; q : POINTER TO INT; END_VAR {body} END_PROGRAM");
    let cases = [
        program("__TRY i := 1; __CATCH(e) i := 2; __ENDTRY; i := 3;"),
        program("q := __NEW(INT);"),
        program("__DELETE(q);"),
        program("b := INI(q, TRUE);"),
        program("i := BITADR(b);"),
        program("i := INDEXOF(p);"),
        "FUNCTION f : INT VAR_INPUT a : ANY; END_VAR f := 1; END_FUNCTION".to_owned(),
        "FUNCTION f : INT VAR_INPUT a : ANY_NUM; END_VAR f := 1; END_FUNCTION".to_owned(),
    ];
    for text in cases {
        let c = compile_in(Profile::Codesys, &text);
        let errors: Vec<_> = c.diags.iter().filter(|d| d.severity == Severity::Error).collect();
        assert!(errors.len() == 1 && errors[0].code == Code::NotSupportedYet, "{text}: {errors:?}");
        assert!(errors[0].help.is_some(), "{text}: no advice");
    }
}

#[test]
fn s12_forms_that_std_refuses() {
    reject(
        Profile::Std,
        &[
            ("12", "PROGRAM p VAR a, b : BOOL; END_VAR IF (a := b) THEN ; END_IF; END_PROGRAM", "P0014"),
            ("12", "PROGRAM p VAR s, t : STRING; b : BOOL; END_VAR b := TRUE; END_PROGRAM", ""),
        ],
    );
    reject(
        Profile::Codesys,
        &[
            ("12", "PROGRAM p VAR s, t : STRING; b : BOOL; END_VAR b := (s := t) = 'a'; END_PROGRAM", "P0012"),
            ("12", "PROGRAM p VAR CONSTANT c : INT := 1; END_VAR VAR i : INT; END_VAR i := (c := 2); END_PROGRAM", "P3001"),
            ("12", "PROGRAM p VAR i : INT; END_VAR i := (1 := 2); END_PROGRAM", "P2014"),
        ],
    );
}

/// A call or a property that gives a REFERENCE TO stands for what that is bound to; properties are found through references.
#[test]
fn references_as_results() {
    let text = "TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
        FUNCTION_BLOCK Lamp VAR lit : INT := 3; END_VAR
          PROPERTY Level : INT GET Level := lit; END_GET SET lit := Level; END_SET END_PROPERTY
          METHOD dim : INT VAR_INPUT less : INT; END_VAR lit := lit - less; dim := lit; END_METHOD
        END_FUNCTION_BLOCK
        FUNCTION_BLOCK Shelf VAR pair : Pair := (a := 1, b := 2); lamp : Lamp; list : ARRAY[0..2] OF INT := [10, 20, 30]; END_VAR
          METHOD pairs : REFERENCE TO Pair VAR_INPUT add : INT; END_VAR pair.a := pair.a + add; pairs REF= pair; END_METHOD
          METHOD item : REFERENCE TO INT VAR_INPUT i : INT; END_VAR item REF= list[i]; END_METHOD
          METHOD light : REFERENCE TO Lamp light REF= lamp; END_METHOD
          PROPERTY Whole : REFERENCE TO Pair GET Whole REF= pair; END_GET END_PROPERTY
        END_FUNCTION_BLOCK
        FUNCTION_BLOCK Holder VAR bulb : REFERENCE TO Lamp; ptr : POINTER TO Lamp; END_VAR
          METHOD give VAR_INPUT l : REFERENCE TO Lamp; END_VAR bulb REF= l; ptr := ADR(l); END_METHOD
          METHOD swap : INT swap := THIS^.bulb.Level; THIS^.bulb.Level := 7; ptr^.Level := ptr^.Level + 1; END_METHOD
        END_FUNCTION_BLOCK
        PROGRAM main VAR s : Shelf; h : Holder; other : Lamp; r : REFERENCE TO Pair; n : REFERENCE TO INT; p : Pair;
          old, x, y, z, d, w, lit : INT; END_VAR
        r REF= s.pairs(4); r.b := 9; p := s.pairs(1); x := s.pairs(0).a;
        n REF= s.item(1); n := n + 1; y := s.item(1) + s.item(2);
        s.item(0) := 5; z := s.item(0);
        h.give(other); old := h.swap(); lit := other.Level;
        d := s.light().dim(1); w := s.Whole.b; s.Whole.b := w + 1;
        END_PROGRAM";
    let expected = [
        ("main.p.a", "6"),
        ("main.p.b", "9"),
        ("main.x", "6"),
        ("main.y", "51"),
        ("main.z", "5"),
        ("main.old", "3"),
        ("main.lit", "8"),
        ("main.d", "2"),
        ("main.w", "9"),
        ("main.s.pair.b", "10"),
        ("main.s.list[1]", "21"),
    ];
    check_profile(Profile::Codesys, text, 1, &expected);
}
