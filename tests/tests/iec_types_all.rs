//! Types, sentence by sentence (language reference, sections 2.4 to 2.11), in profile `std`.

use takt_base::Profile;
use takt_tests::cases::{Row, reject, run};

const ALIASES: &[Row] = &[
    ("2.4", "TYPE Freq : REAL := 50.0; END_TYPE", "a : Freq; b : REAL := 1.0;", "b := a + b;", "a=50.0 b=51.0"),
    (
        "2.4",
        "TYPE T1 : STRUCT a : INT := 1; b : INT := 2; END_STRUCT; T2 : T1 := (a := 5); END_TYPE",
        "x : T2; y : T1;",
        "y := x;",
        "x.a=5 x.b=2 y.a=5",
    ),
    (
        "2.4",
        "TYPE Timer : TON := (PT := T#2s); END_TYPE",
        "t : Timer; u : TON;",
        "t(IN := TRUE); u.PT := t.PT;",
        "t.PT=T#2s u.PT=T#2s",
    ),
    ("2.4", "TYPE A : INT := 3; B : A; C : B := 4; END_TYPE", "b : B; c : C; i : INT;", "i := b + c;", "b=3 c=4 i=7"),
    ("2.4", "TYPE Str : STRING[5] := 'abc'; END_TYPE", "s : Str; l : INT;", "l := LEN(s);", "s='abc' l=3"),
    ("2.4", "TYPE L : ARRAY[1..3] OF INT := [3, 2, 1]; END_TYPE", "l : L; m : ARRAY[1..3] OF INT;", "m := l;", "m[1]=3 m[3]=1"),
    ("2.4", "TYPE RefInt : REF_TO INT; END_TYPE", "i : INT := 4; r : RefInt; o : INT;", "r := REF(i); o := r^;", "o=4"),
    (
        "2.4",
        "FUNCTION_BLOCK F VAR_INPUT i : INT := 2; END_VAR VAR_OUTPUT o : INT; END_VAR o := i + 1; END_FUNCTION_BLOCK TYPE G : F := (i := 7); END_TYPE",
        "g : G; l : ARRAY[1..2] OF G; n : INT;",
        "g(); l[2](i := 1); n := g.o * 10 + l[2].o;",
        "n=82 l[1].i=7",
    ),
];

const ENUMERATIONS: &[Row] = &[
    (
        "2.5",
        "TYPE Light : (Red, Amber, Green) := Amber; END_TYPE",
        "a : Light; b : Light := Green; c : Light := Light#Red; n : INT;",
        "IF a = Amber AND b <> Light#Red THEN n := 1; END_IF; a := Light#Green;",
        "a=Green b=Green c=Red n=1",
    ),
    (
        "2.5",
        "TYPE Light : (Red, Amber, Green); END_TYPE",
        "a : Light; n : INT; l : ARRAY[1..2] OF Light := [Green, Light#Amber];",
        "CASE l[1] OF Red: n := 1; Light#Amber, Green: n := 2; END_CASE;",
        "a=Red n=2 l[2]=Amber",
    ),
    (
        "2.5",
        "TYPE A : (One, Two); B : (Two, One); END_TYPE",
        "a : A; b : B; n : BOOL;",
        "a := Two; b := Two; n := b = Two;",
        "a=Two b=Two n=TRUE",
    ),
    (
        "2.5",
        "TYPE Light : (Red, Amber, Green); END_TYPE FUNCTION f : Light VAR_INPUT l : Light := Light#Amber; END_VAR f := SEL(l = Light#Red, l, Green); END_FUNCTION",
        "a, b, c : Light;",
        "a := f(); b := f(Red); c := MUX(1, Red, Light#Green);",
        "a=Amber b=Green c=Green",
    ),
    (
        "2.5",
        "TYPE Col : DWORD (Red := 16#FF0000, Green := 16#00FF00, White := Red OR Green) := Green; END_TYPE",
        "c : Col; d : DWORD; w : Col := White;",
        "d := c OR Col#Red; c := 16#5;",
        "d=16776960",
    ),
    ("2.5", "TYPE E : INT (A := 10, B, C := 20, D); END_TYPE", "e : E := B; i, j : INT;", "i := e; j := E#D + 1;", "i=11 j=22"),
    ("2.5", "", "s : (idle, run) := run; b : BOOL;", "b := s = run; s := idle;", "b=TRUE s=idle"),
    (
        "2.5",
        "TYPE Light : (Red, Green); END_TYPE TYPE S : STRUCT l : Light := Green; END_STRUCT END_TYPE",
        "s : S; t : S := (l := Red); r : Light;",
        "r := s.l;",
        "r=Green t.l=Red",
    ),
    (
        "2.5",
        "TYPE Light : (Red, Green); END_TYPE FUNCTION_BLOCK F VAR_INPUT l : Light; END_VAR VAR_OUTPUT o : Light; END_VAR o := l; END_FUNCTION_BLOCK",
        "f : F; g : F := (l := Light#Green); o : Light;",
        "g(); o := g.o; f(l := Light#Green);",
        "o=Green f.o=Green",
    ),
    ("2.5", "TYPE Light : (Red, Green); END_TYPE", "Red : INT := 5; l : Light := Light#Red; i : INT;", "i := Red;", "i=5"),
];

const SUBRANGES: &[Row] = &[
    (
        "2.6",
        "TYPE Pct : INT (0..100) := 50; Low : INT (-10..-1); Off : INT (5..9); END_TYPE",
        "a : Pct; b : Low; c : Off; d : INT (7..8); e : USINT (3..4) := 4;",
        "",
        "a=50 b=-10 c=5 d=7 e=4",
    ),
    (
        "2.6",
        "TYPE Off : INT (5..9); S : STRUCT o : Off; END_STRUCT; END_TYPE",
        "l : ARRAY[1..2] OF Off; s : S; n : ARRAY[0..1] OF S;",
        "",
        "l[2]=5 s.o=5 n[1].o=5",
    ),
    (
        "2.6",
        "TYPE Off : INT (5..9); END_TYPE FUNCTION f : Off VAR_INPUT a : Off; END_VAR VAR b : Off; END_VAR f := a; IF a = 9 THEN f := b; END_IF; END_FUNCTION",
        "x, y, z : INT; o : Off;",
        "x := f(6); y := f(9); z := f(); o := f(8) + 1;",
        "x=6 y=5 z=5 o=9",
    ),
    ("2.6", "", "v : INT (1..3) := 2; w : DINT;", "w := v * 10; v := 3;", "w=20 v=3"),
];

const ARRAYS: &[Row] = &[
    (
        "2.7",
        "",
        "a : ARRAY[1..5] OF INT := [1, 2(3), 4, 5]; b : ARRAY[1..6] OF INT := [2(7, 8), 2()]; c : ARRAY[0..3] OF INT := [1, 2];",
        "",
        "a[2]=3 a[3]=3 a[5]=5 b[1]=7 b[4]=8 b[5]=0 c[1]=2 c[3]=0",
    ),
    (
        "2.7",
        "",
        "a : ARRAY[1..2, 1..3] OF INT := [1, 2, 3, 4, 5, 6]; b : ARRAY[1..2, 1..3] OF INT := [[1, 2, 3], [4, 5, 6]]; n, m : INT;",
        "n := a[2, 1] * 10 + a[1][3]; m := b[2, 1] * 10 + b[1][3];",
        "n=43 m=43",
    ),
    (
        "2.7",
        "",
        "a : ARRAY[1..2] OF ARRAY[1..2] OF INT := [[1, 2], [3, 4]]; n : INT;",
        "n := a[2, 1] * 10 + a[1][2]; a[1] := a[2];",
        "n=32 a[1][2]=4",
    ),
    (
        "2.7",
        "TYPE S : STRUCT x : INT := 9; y : INT; END_STRUCT END_TYPE",
        "a : ARRAY[1..4] OF S := [(x := 1), 2((x := 0, y := 3)), ()];",
        "",
        "a[1].x=1 a[3].y=3 a[4].x=9",
    ),
    (
        "2.7",
        "",
        "a : ARRAY[-2..2] OF BOOL; i : INT := -2; s : STRING[3];",
        "a[i] := TRUE; a[i + 4] := TRUE;",
        "a[-2]=TRUE a[2]=TRUE a[0]=FALSE",
    ),
    (
        "2.7",
        "FUNCTION_BLOCK F VAR_INPUT k : INT := 1; END_VAR VAR_OUTPUT o : INT; END_VAR o := o + k; END_FUNCTION_BLOCK",
        "a : ARRAY[1..3] OF F := [(k := 5), 2((k := 7))]; i : INT; b : ARRAY[1..2] OF TON := [2((PT := T#1s))];",
        "FOR i := 1 TO 3 DO a[i](); END_FOR; a[2](k := 1);",
        "a[1].o=5 a[2].o=8 a[3].o=7 b[2].PT=T#1s",
    ),
    (
        "2.7",
        "FUNCTION sum : INT VAR_INPUT a : ARRAY[*] OF INT; END_VAR VAR i : DINT; END_VAR FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO sum := sum + a[i]; END_FOR; END_FUNCTION",
        "a : ARRAY[3..5] OF INT := [1, 2, 3]; b : ARRAY[0..0] OF INT := [9]; x, y : INT;",
        "x := sum(a); y := sum(b);",
        "x=6 y=9",
    ),
    (
        "2.7",
        "",
        "a : ARRAY[1..2] OF STRING[4] := ['ab', 2('c')]; b : ARRAY[1..2] OF TIME := [T#1s, T#2s]; l : LREAL; r : ARRAY[1..2] OF LREAL := [1, 2.5];",
        "l := r[1] + r[2];",
        "a[2]='c' b[2]=T#2s l=3.5",
    ),
    (
        "2.7",
        "TYPE L : ARRAY[1..2] OF INT := [4, 5]; S : STRUCT l : L; m : ARRAY[1..2] OF INT := [6, 7]; END_STRUCT; END_TYPE",
        "s : S; t : S := (m := [8, 9]); u : ARRAY[1..2] OF L := [[1, 2]];",
        "",
        "s.l[2]=5 t.m[1]=8 t.l[1]=4 u[1][2]=2 u[2][1]=4",
    ),
];

const STRUCTURES: &[Row] = &[
    (
        "2.8",
        "TYPE In : STRUCT x : INT := 1; y : INT := 2; END_STRUCT; Out : STRUCT i : In := (x := 5); l : ARRAY[1..2] OF In; r : REAL; END_STRUCT; END_TYPE",
        "a : Out; b : Out := (i := (y := 7), l := [(x := 3), (y := 4)], r := 1.5);",
        "",
        "a.i.x=5 a.i.y=2 b.i.x=5 b.i.y=7 b.l[1].x=3 b.l[2].y=4 b.l[2].x=1 b.r=1.5",
    ),
    (
        "2.8",
        "FUNCTION_BLOCK F VAR_OUTPUT n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK TYPE S : STRUCT f : F; t : TON; END_STRUCT END_TYPE",
        "s : S;",
        "s.f(); s.f(); s.t(IN := TRUE);",
        "s.f.n=2 s.t.IN=TRUE",
    ),
    (
        "2.8",
        "TYPE N : STRUCT v : INT; next : REF_TO N; END_STRUCT END_TYPE",
        "a : N := (v := 1); b : N := (v := 2); n : INT;",
        "a.next := REF(b); n := a.next^.v;",
        "n=2",
    ),
    (
        "2.8",
        "TYPE S : STRUCT a, b : INT := 3; c : BOOL; END_STRUCT; END_TYPE",
        "s, t : S;",
        "s.a := 4; t := s; t.b := 5;",
        "t.a=4 s.b=3 t.b=5",
    ),
];

const STRINGS: &[Row] = &[
    (
        "2.9",
        "",
        "s : STRING[3]; t : STRING[10] := 'abcdef'; c : CHAR; w : WSTRING[4] := \"wxyz\"; wc : WCHAR; n : INT;",
        "s := t; c := t[2]; t[1] := 'X'; wc := w[4]; w[1] := \"Q\"; n := LEN(w);",
        "s='abc' c='b' t='Xbcdef' wc=\"z\" w=\"Qxyz\" n=4",
    ),
    (
        "2.9",
        "",
        "a, b, c, d : BOOL; s : STRING := 'ab'; w : WSTRING := \"b\";",
        "a := s < 'abc'; b := s = 'ab'; c := 'B' < 'a'; d := w > \"a\";",
        "a=TRUE b=TRUE c=TRUE d=TRUE",
    ),
    (
        "2.9",
        "",
        "s : STRING[8]; c : CHAR := 'x'; w : WSTRING[8]; wc : WCHAR := \"y\"; e : CHAR := CHAR#16#41;",
        "s := c; w := wc; s := CONCAT(s, 'b');",
        "s='xb' w=\"y\" e='A'",
    ),
    (
        "2.9",
        "",
        "w, v : WSTRING[20] := \"hello\"; n : INT; a : ARRAY[1..2] OF WSTRING[4] := [\"a\", \"b\"];",
        "n := FIND(w, \"l\"); v := CONCAT(LEFT(w, 2), a[2]); w := REPLACE(w, \"XX\", 1, 2);",
        "n=3 v=\"heb\" w=\"hXXllo\"",
    ),
    (
        "2.9",
        "FUNCTION f : WSTRING[5] VAR_INPUT a : WSTRING[5]; c : WCHAR; END_VAR f := CONCAT(a, c); END_FUNCTION",
        "w : WSTRING[9]; b : BOOL;",
        "w := f(\"ab\", \"c\"); b := w = \"abc\";",
        "w=\"abc\" b=TRUE",
    ),
    (
        "2.9",
        "",
        "c : CHAR := 'b'; n : INT; b : BOOL;",
        "CASE c OF 'a': n := 1; 'b'..'d': n := 2; END_CASE; b := c > 'a';",
        "n=2 b=TRUE",
    ),
];

const REFERENCES: &[Row] = &[
    (
        "2.10",
        "",
        "i : INT := 1; j : INT := 2; r, s : REF_TO INT; a, b : BOOL;",
        "a := r = NULL; r := REF(i); s := r; s^ := 7; b := r = s; r := REF(j); r^ := r^ + 1;",
        "a=TRUE b=TRUE i=7 j=3",
    ),
    (
        "2.10",
        "",
        "a : ARRAY[1..2] OF INT; r : REF_TO ARRAY[1..2] OF INT; p : ARRAY[1..2] OF REF_TO INT;",
        "r := REF(a); r^[2] := 5; p[1] := REF(a[1]); p[1]^ := 4;",
        "a[1]=4 a[2]=5",
    ),
    (
        "2.10",
        "FUNCTION_BLOCK F VAR_OUTPUT n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK",
        "f : F; r : REF_TO F;",
        "r := REF(f); r^(); r^();",
        "f.n=2",
    ),
];

const PARTS: &[Row] = &[
    (
        "2.11",
        "",
        "w : WORD := 16#1234; d : DWORD; l : LWORD; b : BYTE; x, y : BOOL; v : WORD;",
        "b := w.%B1; x := w.%X2; y := w.4; d.%W1 := w; d.%X0 := TRUE; l.%D1 := d; v := l.%W3;",
        "b=18 x=TRUE y=TRUE d=305397761 l=1311673395766624256 v=4660",
    ),
    (
        "2.11",
        "TYPE S : STRUCT w : WORD; END_STRUCT END_TYPE",
        "s : S; a : ARRAY[0..1] OF BYTE; i : INT := 1;",
        "s.w.%X15 := TRUE; a[i].7 := TRUE; a[i].%X0 := s.w.15;",
        "s.w=32768 a[1]=129",
    ),
];

#[test]
fn s2_4_aliases() {
    run(Profile::Std, ALIASES);
}
#[test]
fn s2_5_enumerations() {
    run(Profile::Std, ENUMERATIONS);
}
#[test]
fn s2_6_subranges() {
    run(Profile::Std, SUBRANGES);
}
#[test]
fn s2_7_arrays() {
    run(Profile::Std, ARRAYS);
}
#[test]
fn s2_8_structures() {
    run(Profile::Std, STRUCTURES);
}
#[test]
fn s2_9_strings() {
    run(Profile::Std, STRINGS);
}
#[test]
fn s2_10_references() {
    run(Profile::Std, REFERENCES);
}
#[test]
fn s2_11_parts() {
    run(Profile::Std, PARTS);
}

#[test]
fn s2_what_is_refused() {
    reject(
        Profile::Std,
        &[
            (
                "2.4",
                "FUNCTION_BLOCK F END_FUNCTION_BLOCK TYPE G : F; END_TYPE PROGRAM p VAR g : G; h : F; END_VAR g := h; END_PROGRAM",
                "",
            ),
            (
                "2.5",
                "TYPE A : (x, y); B : (x, z); END_TYPE PROGRAM p VAR b : BOOL; END_VAR b := x = x; END_PROGRAM",
                "P1007 P1007",
            ),
            ("2.5", "TYPE A : (x, y); END_TYPE PROGRAM p VAR a : A; b : BOOL; END_VAR b := a < y; END_PROGRAM", "P0014"),
            ("2.5", "TYPE A : (x, y); END_TYPE PROGRAM p VAR a : A; END_VAR a := 1; END_PROGRAM", "P2001"),
            ("2.5", "TYPE A : (x, x); END_TYPE", "P1001"),
            ("2.6", "TYPE A : INT (9..1); END_TYPE", "P2004"),
            ("2.6", "TYPE A : REAL (1..9); END_TYPE", "P2003"),
            ("2.6", "PROGRAM p VAR v : INT (1..3) := 4; END_VAR v := 0; END_PROGRAM", "P2004 P2004"),
            ("2.7", "PROGRAM p VAR a : ARRAY[1..3] OF INT; i : INT; END_VAR i := a[4]; END_PROGRAM", "P2009"),
            ("2.7", "PROGRAM p VAR a : ARRAY[1..3] OF INT; b : ARRAY[0..2] OF INT; END_VAR a := b; END_PROGRAM", "P2001"),
            ("2.7", "PROGRAM p VAR a : ARRAY[*] OF INT; END_VAR ; END_PROGRAM", "P2019"),
            ("2.8", "TYPE S : STRUCT s : S; END_STRUCT END_TYPE", "P2015"),
            ("2.8", "TYPE A : STRUCT b : B; END_STRUCT; B : STRUCT a : ARRAY[1..2] OF A; END_STRUCT; END_TYPE", "P2015"),
            ("2.9", "PROGRAM p VAR s : STRING[0]; t : STRING[40000]; END_VAR ; END_PROGRAM", "P2004 P2004"),
            ("2.9", "PROGRAM p VAR s : STRING; w : WSTRING; END_VAR s := w; END_PROGRAM", "P2001"),
            ("2.9", "PROGRAM p VAR s : STRING := 'a'; END_VAR s := s + 'b'; END_PROGRAM", "P2003"),
            ("2.10", "FUNCTION f : INT VAR i : INT; r : REF_TO INT; END_VAR r := REF(i); f := 1; END_FUNCTION", "P2017"),
            ("2.11", "PROGRAM p VAR w : WORD; b : BOOL; i : INT; END_VAR b := w.%X16; b := i.0; END_PROGRAM", "P2009 P2003"),
            (
                "2.11",
                "FUNCTION f : INT VAR_IN_OUT b : BOOL; END_VAR f := 1; END_FUNCTION PROGRAM p VAR w : WORD; i : INT; END_VAR i := f(w.1); END_PROGRAM",
                "P2014",
            ),
        ],
    );
}
