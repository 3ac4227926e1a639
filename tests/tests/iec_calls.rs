//! Units, calls, EN and ENO (language reference, sections 3.9 and 4.1 to 4.8), in profile `std`.

use takt_base::Profile;
use takt_tests::cases::{Row, reject, run};

const ADD: &str =
    "FUNCTION add2 : INT VAR_INPUT a : INT := 1; b : INT := 2; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR_IN_OUT io : INT; END_VAR
    add2 := a + b; q := a > b; io := io + 1; END_FUNCTION";
const BLOCK: &str =
    "FUNCTION_BLOCK fb VAR_INPUT i : INT := 3; END_VAR VAR_OUTPUT q : INT; ok : BOOL; END_VAR VAR n : INT; END_VAR
    n := n + 1; q := i + n; ok := n > 1; END_FUNCTION_BLOCK";

const FUNCTIONS: &[Row] = &[
    (
        "4.7",
        ADD,
        "x, y, z, k : INT; t, u : BOOL;",
        "x := add2(5, 6, t, k); y := add2(b := 1, io := k); z := add2(io := k, a := 9, q => t, b := 4); add2(io := k, NOT q => u);",
        "x=11 y=2 z=13 k=4 t=TRUE u=TRUE",
    ),
    (
        "4.1",
        "FUNCTION u VAR_IN_OUT x : INT; END_VAR x := x + 1; END_FUNCTION FUNCTION v : VOID VAR_IN_OUT x : INT; END_VAR x := x * 2; END_FUNCTION",
        "a : INT := 3;",
        "u(a); u(x := a); v(a);",
        "a=10",
    ),
    (
        "4.1",
        "FUNCTION f : INT VAR_INPUT a : INT; END_VAR IF a > 1 THEN f := f + 2; f := f * 10 + a; END_IF; END_FUNCTION",
        "x : INT;",
        "x := f(f(2)) + f(0);",
        "x=42",
    ),
    (
        "4.1",
        "FUNCTION f : INT VAR_INPUT a : INT; END_VAR VAR n : INT := 4; END_VAR n := n + a; f := n; END_FUNCTION",
        "x : INT;",
        "x := f(1); x := x * 10 + f(2);",
        "x=56",
    ),
    (
        "4.1",
        "FUNCTION f VAR_OUTPUT a : INT; b : STRING[4]; c : ARRAY[1..2] OF INT; END_VAR a := 5; b := 'abcd'; c[2] := 6; END_FUNCTION",
        "x : DINT; s : STRING[2]; l : ARRAY[1..2] OF INT;",
        "f(a => x, b => s, c => l);",
        "x=5 s='ab' l[2]=6",
    ),
    (
        "4.7",
        "FUNCTION swap VAR_IN_OUT a, b : INT; END_VAR VAR t : INT; END_VAR t := a; a := b; b := t; END_FUNCTION TYPE S : STRUCT m : INT := 8; END_STRUCT END_TYPE",
        "x : INT := 1; l : ARRAY[1..2] OF INT := [5, 6]; s : S; i : INT := 2;",
        "swap(x, x); swap(l[1], l[i]); swap(a := s.m, b := x);",
        "x=8 l[1]=6 l[2]=5 s.m=1",
    ),
    (
        "3.10",
        "FUNCTION f : INT VAR_INPUT a : INT; END_VAR f := a; f := g(f) + f; END_FUNCTION FUNCTION g : INT VAR_INPUT a : INT; END_VAR g := a * 100; END_FUNCTION",
        "x : INT;",
        "x := f(3);",
        "x=303",
    ),
    (
        "4.1",
        "FUNCTION ATAN2 : INT VAR_INPUT y, x : INT; END_VAR ATAN2 := y * 10 + x; END_FUNCTION",
        "x : INT;",
        "x := ATAN2(1, 2);",
        "x=12",
    ),
    (
        "4.1",
        "FUNCTION f : STRING[10] VAR_INPUT s : STRING; END_VAR f := CONCAT(s, '!'); END_FUNCTION",
        "s : STRING; n : INT;",
        "s := f(f('a')); n := LEN(f('abc'));",
        "s='a!!' n=4",
    ),
    (
        "4.1",
        "FUNCTION f : ARRAY[1..2] OF INT VAR_INPUT a : INT; END_VAR f[1] := a; f[2] := a + 1; END_FUNCTION",
        "l : ARRAY[1..2] OF INT;",
        "l := f(7);",
        "l[1]=7 l[2]=8",
    ),
];

const BLOCKS: &[Row] = &[
    ("4.2", BLOCK, "a : fb; n : INT; t : BOOL; d : DINT;", "a(); a(i := 10, q => n, NOT ok => t); a.i := 20; a(); d := a.q;", "n=12 t=FALSE d=23 a.n=3"),
    ("4.2", BLOCK, "a, b : fb; l : ARRAY[1..2] OF fb; t : BOOL;", "a(i := 1); b := a; b(); l[1] := b; l[2](5); t := l[1].ok;", "a.n=1 b.n=2 l[1].q=3 l[2].q=6 t=TRUE"),
    ("4.2", "FUNCTION_BLOCK io VAR_IN_OUT x : INT; l : ARRAY[1..2] OF INT; END_VAR x := x + l[2]; l[1] := x; END_FUNCTION_BLOCK", "a : io; n : INT := 1; l : ARRAY[1..2] OF INT := [0, 5];", "a(x := n, l := l); a(n, l);", "n=11 l[1]=11"),
    ("4.2", "FUNCTION_BLOCK one VAR_OUTPUT n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK
        FUNCTION_BLOCK view VAR_INPUT f : one; END_VAR VAR_OUTPUT q : INT; END_VAR q := f.n * 10; END_FUNCTION_BLOCK
        FUNCTION_BLOCK run VAR_IN_OUT f : one; END_VAR f(); f(); END_FUNCTION_BLOCK FUNCTION go : INT VAR_IN_OUT f : one; END_VAR f(); go := f.n; END_FUNCTION",
        "f : one; v : view; r : run; n : INT;", "f(); v(f := f); r(f := f); n := go(f);", "v.q=10 f.n=4 n=4"),
    ("3.3", "FUNCTION_BLOCK e VAR_INPUT c : BOOL R_EDGE; d : BOOL F_EDGE; END_VAR VAR_OUTPUT n, m : INT; END_VAR IF c THEN n := n + 1; END_IF; IF d THEN m := m + 1; END_IF; END_FUNCTION_BLOCK",
        "x : e;", "x(c := TRUE, d := TRUE); x(); x(c := FALSE, d := FALSE); x(c := TRUE); x(d := TRUE); x(d := FALSE);", "x.n=2 x.m=2"),
    ("4.2", "FUNCTION_BLOCK outer VAR t : inner; END_VAR VAR_OUTPUT q : INT; END_VAR t(); q := t.n; END_FUNCTION_BLOCK FUNCTION_BLOCK inner VAR_OUTPUT n : INT := 5; END_VAR n := n + 1; END_FUNCTION_BLOCK", "o : outer;", "o(); o();", "o.q=7"),
];

const ENABLES: &[Row] = &[
    (
        "4.8",
        ADD,
        "x : INT := 7; k : INT; t : BOOL := TRUE;",
        "x := add2(EN := FALSE, a := 1, b := 2, io := k, ENO => t);",
        "x=7 k=0 t=FALSE",
    ),
    (
        "4.8",
        ADD,
        "x : INT := 7; k : INT; t, u : BOOL;",
        "x := add2(EN := TRUE, a := 1, io := k, ENO => t, q => u);",
        "x=3 k=1 t=TRUE",
    ),
    (
        "4.8",
        BLOCK,
        "a : fb; t, u : BOOL := TRUE;",
        "a(EN := FALSE, i := 9, ENO => t); a(EN := TRUE, ENO => u); ",
        "a.n=1 a.i=3 t=FALSE u=TRUE",
    ),
    (
        "4.8",
        "FUNCTION_BLOCK own VAR_INPUT EN : BOOL; x : INT; END_VAR VAR_OUTPUT ENO : BOOL; q : INT; END_VAR q := x; IF x > 5 THEN ENO := FALSE; END_IF; END_FUNCTION_BLOCK",
        "a : own; t, u, v : BOOL;",
        "a(EN := TRUE, x := 4, ENO => t); a(x := 6, ENO => u); a(EN := FALSE, x := 1, ENO => v);",
        "a.q=6 t=TRUE u=FALSE v=FALSE",
    ),
    (
        "4.8",
        "CLASS c VAR n : INT; END_VAR METHOD PUBLIC m : INT VAR_INPUT a : INT; END_VAR n := n + a; m := n; END_METHOD END_CLASS",
        "o : c; x : INT := 5; y : INT; t, u : BOOL := TRUE;",
        "x := o.m(EN := FALSE, a := 4, ENO => t); y := o.m(EN := TRUE, a := 4, ENO => u); o.m(EN := x = 0, a := 7, ENO => u); o.m(1, ENO => t);",
        "x=5 y=4 t=TRUE u=FALSE o.n=5",
    ),
    (
        "18.9",
        "",
        "r : INT := 9; s : INT := 9; ok, no : BOOL := TRUE;",
        "r := DIV(EN := FALSE, IN1 := 1, IN2 := 0, ENO => ok); s := DIV(EN := TRUE, IN1 := 1, IN2 := 0, ENO => no);",
        "r=9 ok=FALSE s=0 no=FALSE",
    ),
];

const DECLARATIONS: &[Row] = &[
    (
        "3.9",
        "TYPE A : ARRAY [1..2, 0..1] OF ARRAY [1..2] OF BYTE; B : STRING[4]; C : WSTRING[4]; D : REF_TO ARRAY [1..2] OF INT; END_TYPE",
        "a : A; b : B := 'x'; c : C := \"y\"; d : D;",
        "a[2, 1][2] := 5;",
        "a[2,1][2]=5 b='x' c=\"y\"",
    ),
    (
        "3.9",
        "VAR_GLOBAL g : INT := 3; END_VAR VAR_GLOBAL CONSTANT k : INT := 4; END_VAR",
        "x : ARRAY[0..2] OF INT := [3(2)]; END_VAR VAR_EXTERNAL g : INT; END_VAR VAR_EXTERNAL CONSTANT k : INT; END_VAR VAR y : INT;",
        "g := g + k; y := g;",
        "y=7",
    ),
    (
        "3.9",
        "",
        "END_VAR VAR CONSTANT n : INT := 2; m : INT := n * 3; END_VAR VAR RETAIN r : INT := m; END_VAR VAR NON_RETAIN s : INT := 1; END_VAR VAR a : ARRAY[n..m] OF INT; b : STRING[m];",
        "a[m] := 1; b := '123456';",
        "a[6]=1 b='123456' r=6",
    ),
    (
        "3.4",
        "",
        "q AT %QX1.3 : BOOL := TRUE; w AT %MW2 : WORD := 16#12; AT %MB8 : BYTE := 7; l AT %MW10 : ARRAY[0..1] OF INT := [1, 2]; b : BYTE; x : INT;",
        "b := %MB8; x := l[1]; %QX2.0 := q;",
        "q=TRUE b=7 x=2",
    ),
    (
        "3.2",
        "",
        "a, b, c : INT := 4; d : BOOL; END_VAR VAR_TEMP t : INT := 5; END_VAR VAR PUBLIC e : INT;",
        "a := b + t; e := a;",
        "a=9 e=9",
    ),
    (
        "2.1",
        "",
        "a : LDATE := LDATE#2024-02-29; b : LTOD := LTOD#12:30:00.5; c : LDT := LDT#2024-02-29-12:00:00; d : LTIME := LTIME#1us; e : LTIME; f : LDATE; g : BOOL;",
        "e := c - LDT#2024-02-29-11:00:00; f := a; c := c + d; b := b + LTIME#1s; g := a > LDATE#2023-01-01; d := LDATE#2024-03-01 - f; ",
        "e=LT#1h g=TRUE d=LT#1d b=LTOD#12:30:01.5",
    ),
    (
        "2.1",
        "",
        "a : DATE := D#2024-01-31; b : TOD := TOD#23:00:00; c : DT := DT#2024-01-31-23:00:00; t : TIME; u : TIME; v : DT; w : TOD;",
        "t := c - DT#2024-01-31-00:00:00; u := b - TOD#22:59:00; v := CONCAT_DATE_TOD(a, b); w := b - T#1h;",
        "t=T#23h u=T#1m w=TOD#22:00:00",
    ),
];

#[test]
fn s4_1_functions() {
    run(Profile::Std, FUNCTIONS);
}
#[test]
fn s4_2_function_blocks() {
    run(Profile::Std, BLOCKS);
}
#[test]
fn s4_8_en_and_eno() {
    run(Profile::Std, ENABLES);
}
#[test]
fn s3_9_declarations() {
    run(Profile::Std, DECLARATIONS);
}

#[test]
fn s4_what_is_refused() {
    let io = "FUNCTION inc VAR_IN_OUT x : INT; END_VAR x := x + 1; END_FUNCTION";
    let with = |vars: &str, body: &str| format!("{io} PROGRAM p VAR {vars} END_VAR {body} END_PROGRAM");
    let texts = [
        ("4.7", with("CONSTANT_ : INT;", ";").replace("CONSTANT_", "c"), ""),
        ("4.7", with("i : INT;", "inc(i + 1);"), "P2014"),
        ("4.7", with("i : INT;", "inc(3);"), "P2014"),
        ("4.7", with("i : DINT;", "inc(i);"), "P2001"),
        ("4.7", with("i : INT;", "inc();"), "P3007"),
        ("4.7", with("i : INT;", "inc(y := i);"), "P1006"),
        ("4.1", with("i : INT;", "i := inc(i);"), "P2012"),
        ("4.1", with("i : INT;", "i := 1 + ABS(inc(i));"), "P2012"),
        ("4.1", "FUNCTION f : INT VAR t : TON; END_VAR f := 1; END_FUNCTION".to_owned(), "P3008"),
        ("4.7", "FUNCTION f : INT VAR_INPUT a : INT; END_VAR f := a; END_FUNCTION PROGRAM p VAR i : INT; END_VAR i := f(); i := f(1, 2); END_PROGRAM".to_owned(), "P2013"),
        ("4.2", "FUNCTION_BLOCK f VAR_OUTPUT q : INT; END_VAR ; END_FUNCTION_BLOCK PROGRAM p VAR a, b : f; t : BOOL; END_VAR a.q := 1; t := a = b; END_PROGRAM".to_owned(), "P3010 P2003"),
        ("4.2", "FUNCTION_BLOCK f ; END_FUNCTION_BLOCK FUNCTION_BLOCK g VAR_INPUT i : f; END_VAR i(); END_FUNCTION_BLOCK".to_owned(), "P2012"),
        ("4.2", "FUNCTION_BLOCK f VAR_IN_OUT x : INT; END_VAR ; END_FUNCTION_BLOCK PROGRAM p VAR a : f; i : INT; END_VAR i := a.x; END_PROGRAM".to_owned(), "P1005"),
        ("3.5", "VAR_GLOBAL CONSTANT k : INT := 4; END_VAR PROGRAM p VAR_EXTERNAL k : INT; END_VAR ; END_PROGRAM".to_owned(), "P1009"),
        ("3.5", "VAR_GLOBAL k : INT := 4; END_VAR PROGRAM p VAR_EXTERNAL k : DINT; END_VAR ; END_PROGRAM".to_owned(), "P1009"),
        ("3.5", "VAR_GLOBAL k : INT := 4; END_VAR PROGRAM p VAR_EXTERNAL k : INT := 5; END_VAR ; END_PROGRAM".to_owned(), "P1009"),
        ("3.5", "VAR_GLOBAL CONSTANT k : INT := 4; END_VAR PROGRAM p VAR_EXTERNAL CONSTANT k : INT; END_VAR k := 5; END_PROGRAM".to_owned(), "P3001"),
        ("3.2", "FUNCTION f : INT VAR RETAIN a : INT; END_VAR f := 1; END_FUNCTION".to_owned(), "P3008"),
        ("3.2", "PROGRAM p VAR CONSTANT t : TON; END_VAR ; END_PROGRAM".to_owned(), "P3008"),
        ("3.3", "FUNCTION f : INT VAR_INPUT a : BOOL R_EDGE; END_VAR f := 1; END_FUNCTION".to_owned(), "P3008"),
        ("4.7", "FUNCTION_BLOCK f VAR_IN_OUT x : BOOL; END_VAR ; END_FUNCTION_BLOCK PROGRAM p VAR a : f; w : WORD; s : STRING; END_VAR a(x := w.%X1); END_PROGRAM".to_owned(), "P2014"),
        ("4.7", "FUNCTION f VAR_IN_OUT x : CHAR; END_VAR ; END_FUNCTION PROGRAM p VAR s : STRING; END_VAR f(s[1]); END_PROGRAM".to_owned(), "P2014"),
    ];
    let rows: Vec<_> = texts.iter().map(|(s, t, c)| (*s, t.as_str(), *c)).collect();
    reject(Profile::Std, &rows);
}
