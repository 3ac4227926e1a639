//! Statements, operators and Instruction List (language reference, sections 5.1 to 5.8 and 6.1 to 6.6), in profile `std`.

use takt_base::Profile;
use takt_tests::cases::{Row, reject, run};

const STATEMENTS: &[Row] = &[
    (
        "5.1",
        "",
        "a, b, c : INT;",
        ";; a := 1;; IF a = 1 THEN b := 2; ELSIF a = 2 THEN b := 3; ELSE b := 4; END_IF; IF a > b THEN ; ELSE c := 5; END_IF;",
        "b=2 c=5",
    ),
    (
        "5.5",
        "",
        "n, m, k : INT; s : SINT := -3;",
        "CASE s OF -5..-2: n := 1; -1, 0: n := 2; ELSE n := 3; END_CASE; CASE n + 1 OF 1: m := 1; 2, 5..9: m := 2; END_CASE; CASE k OF 7: k := 1; END_CASE;",
        "n=1 m=2 k=0",
    ),
    (
        "5.5",
        "FUNCTION pick : STRING[4] VAR_IN_OUT n : INT; END_VAR n := n + 1; pick := 'bc'; END_FUNCTION",
        "s : STRING := 'x'; w : WSTRING[3] := \"ab\"; n, a, b, c : INT;",
        "CASE s OF 'a': a := 1; 'y', 'x': a := 2; s := 'a'; 'z': a := 3; ELSE a := 4; END_CASE;
        CASE pick(n) OF 'b': b := 1; 'bc': b := 2; END_CASE; CASE w OF \"b\": c := 1; ELSE c := 2; END_CASE;",
        "a=2 b=2 c=2 n=1",
    ),
    (
        "5.6",
        "",
        "i, n, e : INT; u : USINT; b : INT;",
        "FOR i := 10 TO 1 BY -3 DO n := n + 1; END_FOR; FOR u := 250 TO 255 DO e := e + 1; END_FOR; FOR b := 1 TO 0 DO n := 99; END_FOR;",
        "n=4 i=-2 e=6 u=255 b=1",
    ),
    (
        "5.6",
        "",
        "i, n, t, b : INT := 3; j : INT;",
        "FOR i := 1 TO t BY b - 2 DO t := 100; b := 50; n := n + 1; END_FOR; FOR j := 1 TO 10 DO IF j = 4 THEN EXIT; END_IF; END_FOR;",
        "n=6 i=4 j=4",
    ),
    (
        "5.7",
        "",
        "i, n, m : INT;",
        "WHILE i < 5 DO i := i + 1; IF i = 2 THEN CONTINUE; END_IF; n := n + i; END_WHILE; REPEAT m := m + 1; IF m = 3 THEN CONTINUE; END_IF; UNTIL m >= 3 END_REPEAT;",
        "n=13 m=3",
    ),
    (
        "5.7",
        "",
        "i, j, n : INT;",
        "FOR i := 1 TO 3 DO FOR j := 1 TO 3 DO CASE j OF 2: EXIT; END_CASE; n := n + 1; END_FOR; END_FOR; IF n = 3 THEN RETURN; END_IF; n := 100;",
        "n=3",
    ),
    (
        "5.8",
        "TYPE S : STRUCT a : INT; b : ARRAY[0..2] OF INT; END_STRUCT END_TYPE",
        "s, t : S := (a := 1, b := [1, 2, 3]); l : ARRAY[1..2] OF S;",
        "l[1] := s; s.b := t.b; l[2].b[0] := l[1].b[2]; t := l[2];",
        "t.b[0]=3 t.a=0",
    ),
];

const OPERATORS: &[Row] = &[
    (
        "5.2",
        "",
        "a, b, c, d : INT := 3; p, q, r : BOOL;",
        "p := a < b = c < d; q := NOT p = TRUE; a := 2 + 3 * 4; r := a <> 14 OR 1 < 2 AND TRUE;",
        "p=TRUE q=FALSE a=14 r=TRUE",
    ),
    ("5.2", "", "x, y : LREAL; i : INT;", "x := 2.0 ** 3.0 ** 2.0; y := -2.0 ** 2; i := - - 3 - -1;", "x=64.0 y=4.0 i=4"),
    (
        "5.3",
        "",
        "w : WORD := 16#F0F0; b : BYTE := 16#0F; x, y, z : WORD; p : BOOL;",
        "x := w AND b; y := w XOR 16#FFFF; z := NOT w OR b; p := w > b;",
        "x=0 y=3855 z=3855 p=TRUE",
    ),
    (
        "5.3",
        "",
        "i : INT := 7; d : DINT := -7; u : UINT := 3; r : REAL; x, y : DINT; l : LREAL;",
        "x := i + u; y := d / 2 * 10 + d MOD 2; r := i * 0.5; l := d + r;",
        "x=10 y=-31 r=3.5 l=-3.5",
    ),
    (
        "5.3",
        "",
        "t, u : TIME := T#2s; v : TIME; p : BOOL; d : DATE := D#2024-02-28;",
        "t := u * 3; v := t / 4; u := t - T#1m; p := t > v AND d > D#2024-02-27;",
        "t=T#6s v=T#1s500ms u=T#-54s",
    ),
    (
        "5.3",
        "",
        "a, b, c, d, e : BOOL;",
        "a := 'abc' < 'abd'; b := \"x\" <> \"y\"; c := T#1s = T#1000ms; d := D#2024-01-01 < D#2024-01-02; e := TRUE > FALSE;",
        "a=TRUE b=TRUE c=TRUE d=TRUE e=TRUE",
    ),
    (
        "5.4",
        "",
        "i : INT := 32767; s : SINT := 100; d : DINT := 2147483647;",
        "i := i + 1; s := s + s; d := d + 1;",
        "i=-32768 s=-56 d=-2147483648",
    ),
    (
        "5.4",
        "FUNCTION hit : BOOL VAR_IN_OUT n : INT; END_VAR n := n + 1; hit := TRUE; END_FUNCTION",
        "n, z : INT; a, b : BOOL;",
        "a := FALSE AND hit(n); b := FALSE AND_THEN hit(n); a := TRUE OR_ELSE hit(n); b := z <> 0 AND 1 / z > 0;",
        "n=1 a=TRUE b=FALSE",
    ),
    (
        "18.5",
        "",
        "a, b, c, d : INT; p : BOOL; w : BYTE; n7 : INT := -7;",
        "a := 10 - 4 - 3; b := -7 / 2; c := -7 MOD 2; d := n7 / 2 * 10 + n7 MOD 2; p := NOT TRUE OR TRUE; w := 16#F0 AND 16#3C OR 16#01;",
        "a=3 b=-3 c=-1 d=-31 p=TRUE w=49",
    ),
    (
        "18.6",
        "",
        "x : DINT; r : REAL; w : WORD; i : INT := 300; u : UINT := 5;",
        "x := i + u; r := REAL#1 / 3; w := WORD#16#FF00 OR BYTE#16#0F;",
        "x=305 w=65295",
    ),
];

const LISTS: &[Row] = &[
    (
        "18.1",
        "",
        "a, b, c, q, r : BOOL := TRUE; i : INT; END_VAR VAR x : INT := 11; y : INT;",
        "\nLD a\nANDN( b\nOR c\n)\nST q\nLD 5\nSUB( 2\nMUL 3\n)\nST i\nLD x\nGT 10\nJMPCN end\nLD 1\nST y\nend:\nLDN q\nST r\n",
        "q=FALSE i=-1 y=1 r=TRUE",
    ),
    (
        "6.2",
        "",
        "b, s, r : BOOL; n : INT := 7; m : INT;",
        "\nLD TRUE\nS s\nR r\nSTN b\nLD n\nMOD 4\nADD 10\nST m\nLD m\nEQ 13\nAND N( FALSE\n)\n& TRUE\nST b\n",
        "s=TRUE r=FALSE m=13 b=TRUE",
    ),
    (
        "6.5",
        "FUNCTION f : INT VAR_INPUT a, b : INT; END_VAR f := a * 10 + b; END_FUNCTION",
        "c : CTU; t : TON; x, y, z : INT;",
        "\nLD 1\nf 2\nST x\nf(\na := 3,\nb := 4\n)\nST y\nLD TRUE\nCU c\nCAL t(IN := TRUE, PT := T#0s)\nLD c.CV\nST z\nRET\nLD 99\nST z\n",
        "x=12 y=34 z=1 t.Q=TRUE",
    ),
    ("6.2", "", "n : INT;", "\nLD 3\nST n\nagain:\nLD n\nSUB 1\nST n\nGT 0\nJMPC again\nLD n\nEQ 0\nRETC\nLD 50\nST n\n", "n=0"),
    ("6.2", "", "w : BYTE := 4;", "\nLD w\nNOT\nST w\n", "w=251"),
];

/// Section 6.2: the assignment attempt of edition 3.
#[test]
fn s6_2_st_with_a_question_mark() {
    let objects = "INTERFACE A END_INTERFACE INTERFACE B END_INTERFACE FUNCTION_BLOCK both IMPLEMENTS A, B END_FUNCTION_BLOCK
        FUNCTION_BLOCK one IMPLEMENTS A END_FUNCTION_BLOCK
        FUNCTION take VAR_IN_OUT a : A; f : both; END_VAR a := f; END_FUNCTION FUNCTION drop VAR_IN_OUT a : A; f : one; END_VAR a := f; END_FUNCTION";
    let vars = "x : both; y : one; a : A; b : B; t, u : BOOL; END_VAR VAR first : BOOL := TRUE;";
    let body = "\ntake(\na := a,\nf := x\n)\nLD a\nST? b\nLD b\nNE NULL\nST t\ndrop(\na := a,\nf := y\n)\nLD a\nST? b\nLD b\nEQ NULL\nST u\n";
    run(Profile::Std, &[("6.2", objects, vars, body, "t=TRUE u=TRUE")]);
}

#[test]
fn s5_statements() {
    run(Profile::Std, STATEMENTS);
}
#[test]
fn s5_2_to_5_4_operators() {
    run(Profile::Std, OPERATORS);
}
#[test]
fn s6_instruction_list() {
    run(Profile::Std, LISTS);
}

#[test]
fn s5_and_s6_what_is_refused() {
    let with = |vars: &str, body: &str| format!("PROGRAM p VAR {vars} END_VAR {body} END_PROGRAM");
    let texts = [
        ("5.5", with("i : INT;", "IF i THEN ; END_IF;"), "P2006"),
        ("5.5", with("r : REAL;", "CASE r OF 1: ; END_CASE;"), "P2003"),
        ("5.5", with("i : INT;", "CASE i OF 1..3: ; 3: ; END_CASE;"), "P3004"),
        ("5.5", with("i, j : INT;", "CASE i OF j: ; END_CASE;"), "P2005"),
        ("5.5", with("s : STRING;", "CASE s OF 'a', 'b': ; 'a': ; 'c'..'d': ; s: ; END_CASE;"), "P3004 P2003 P2005"),
        ("5.6", with("i : INT;", "FOR i := 1 TO 3 DO i := 2; END_FOR;"), "P3005"),
        ("5.6", with("i : INT;", "FOR i := 1 TO 3 BY 0 DO ; END_FOR;"), "P3006"),
        ("5.6", with("r : REAL;", "FOR r := 1 TO 3 DO ; END_FOR;"), "P3005"),
        ("5.6", with("a : ARRAY[1..2] OF INT;", "FOR a[1] := 1 TO 3 DO ; END_FOR;"), "P3005"),
        ("5.7", with("i : INT;", "EXIT; CASE i OF 1: CONTINUE; END_CASE;"), "P3003 P3003"),
        ("5.3", with("i : INT; w : WORD; b : BOOL;", "w := w + 1; i := i AND 1; b := NOT i;"), "P2003 P2003 P2003"),
        ("5.3", with("i : INT; u : ULINT; r : REAL;", "i := i + u; i := r MOD 2; "), "P2002 P2003"),
        ("5.3", with("a, b : ARRAY[1..2] OF INT; t : BOOL;", "t := a = b;"), "P2003"),
        ("5.3", with("i : INT;", "i := i / 0; i := 5 MOD 0;"), "P2011 P2011"),
        ("5.4", with("i : INT;", "i := 40000; i := 30000 + 30000;"), "P2004 P2004"),
        ("5.8", "FUNCTION_BLOCK f VAR_INPUT i : INT; END_VAR i := 1; END_FUNCTION_BLOCK".to_owned(), "P3002"),
        ("6.3", with("i : INT; b : BOOL;", "\nLD i\nAND b\nST b\n"), "P2002"),
        ("6.3", with("i : INT;", "\nADD 1\nST i\n"), "P5003"),
        ("6.4", with("i : INT; t : TON;", "\nLD i\nADD( 1\nCAL t\n)\nST i\n"), "P5007"),
    ];
    let rows: Vec<_> = texts.iter().map(|(s, t, c)| (*s, t.as_str(), *c)).collect();
    reject(Profile::Std, &rows);
}
