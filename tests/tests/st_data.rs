//! Variables of all kinds: arrays, structures, strings, parts, located variables, initial values. Run on both engines.
//! From: language reference §2, §3.

use takt_image::Trap;
use takt_tests::plc::{Plc, check, check_in, check_program, fault};

#[test]
fn arrays() {
    let vars = "a : ARRAY[-1..1, 2..4] OF INT; i, j, n : INT;";
    let body = "FOR i := -1 TO 1 DO FOR j := 2 TO 4 DO a[i, j] := 10 * i + j; END_FOR; END_FOR; n := a[-1, 4]; i := 1; j := 3; n := n + a[i, j] * 100;";
    check(vars, body, &[("a", "[[-8, -7, -6], [2, 3, 4], [12, 13, 14]]"), ("n", "1294")]);
    check(
        "a : ARRAY[1..2] OF ARRAY[1..2] OF INT; i : INT := 2;",
        "a[1][2] := 5; a[i][i - 1] := 6;",
        &[("a", "[[0, 5], [6, 0]]")],
    );
    check("a, b : ARRAY[1..3] OF DINT := [1, 2, 3];", "a[1] := 9; b := a; a[2] := 7;", &[("b", "[9, 2, 3]")]);
    check("a : ARRAY[0..255] OF BYTE; i : USINT := 200; n : BYTE;", "a[i] := 16#07; n := a[i];", &[("n", "7")]);
    check("a : ARRAY[5..7] OF LREAL; i : LINT := 6;", "a[i] := 1.5;", &[("a", "[0.0, 1.5, 0.0]")]);
}

#[test]
fn structures() {
    let t = "TYPE Point : STRUCT x : INT; y : LREAL; END_STRUCT; Line : STRUCT a, b : Point; c : ARRAY[1..2] OF Point; END_STRUCT; END_TYPE";
    let body = "l.a.x := 1; l.b.y := 2.5; l.c[i].x := 7; m := l; m.a := m.c[2]; p := l.b;";
    check_in(
        t,
        "l, m : Line; p : Point; i : INT := 2;",
        body,
        &[("m.a.x", "7"), ("m.c", "[(x := 0, y := 0.0), (x := 7, y := 0.0)]"), ("p", "(x := 0, y := 2.5)"), ("l.a.x", "1")],
    );
}

/// §3.6.
#[test]
fn initial_values() {
    let t = "TYPE Light : (Red, Amber, Green) := Amber; Pt : STRUCT x : INT := 3; y : INT; END_STRUCT; R : INT (5..9); END_TYPE
        FUNCTION_BLOCK F VAR_INPUT a : INT := 4; END_VAR VAR p : Pt := (y := 8); END_VAR END_FUNCTION_BLOCK";
    let vars = "b : BOOL := TRUE; i : INT := -2; r : REAL := 1.5; d : LREAL := -0.25; t : TIME := T#1s; s : STRING[10] := 'hi';
        w : WSTRING[4] := \"wide\"; l : Light; m : Light := Green; p, q : Pt := (y := 2); n : R; f : F; g : F := (a := 6);
        a : ARRAY[1..4] OF INT := [1, 2(7)]; z : ARRAY[0..1] OF Pt; day : DATE := D#2024-02-29; h : WORD := 16#BEEF;";
    check_in(
        t,
        vars,
        "",
        &[
            ("b", "TRUE"),
            ("i", "-2"),
            ("r", "1.5"),
            ("d", "-0.25"),
            ("t", "T#1s"),
            ("s", "'hi'"),
            ("w", "\"wide\""),
            ("l", "Amber"),
            ("m", "Green"),
            ("p", "(x := 3, y := 2)"),
            ("q", "(x := 3, y := 2)"),
            ("n", "5"),
            ("f.a", "4"),
            ("f.p", "(x := 3, y := 8)"),
            ("g.a", "6"),
            ("g.p", "(x := 3, y := 8)"),
            ("a", "[1, 7, 7, 0]"),
            ("z", "[(x := 3, y := 0), (x := 3, y := 0)]"),
            ("day", "D#2024-02-29"),
            ("h", "48879"),
        ],
    );
}

#[test]
fn temporaries_and_function_locals_start_anew() {
    let f = "FUNCTION next : INT VAR n : INT := 5; a : ARRAY[1..3] OF INT := [1, 2, 3]; s : STRING[5] := 'ab'; z : ARRAY[1..2] OF INT; END_VAR
        n := n + 1; a[2] := a[2] + n; z[1] := z[1] + 1; next := a[2] + z[1]; END_FUNCTION
        PROGRAM p VAR_TEMP t : INT := 3; END_VAR VAR x, y : INT; END_VAR t := t + 1; x := t; y := next(); y := next(); END_PROGRAM";
    check_program(f, 2, &[("p.x", "4"), ("p.y", "9")]);
}

#[test]
fn large_equal_constants_stay_small() {
    let plc =
        Plc::new("PROGRAM p VAR a : ARRAY[1..10000] OF INT := [10000(5)]; z : ARRAY[1..1000000] OF INT; END_VAR END_PROGRAM");
    assert!(plc.image.init.len() <= 2, "{} chunks", plc.image.init.len());
    assert_eq!(plc.get("p.a[10000]"), "5");
}

#[test]
fn strings() {
    let vars = "a : STRING[5]; b : STRING[20] := 'abcdefgh'; c : STRING[20]; n : INT; x, y, z : BOOL;";
    let body = "a := b; c := CONCAT(a, '-', b); n := LEN(c); x := a < b; y := a = 'abcde'; z := a <> b;";
    check(vars, body, &[("a", "'abcde'"), ("c", "'abcde-abcdefgh'"), ("n", "14"), ("x", "TRUE"), ("y", "TRUE"), ("z", "TRUE")]);
    check(
        "s : STRING[8] := 'ASTR'; l, r, m, i, d, p : STRING[20]; f : INT;",
        "l := LEFT(s, 3); r := RIGHT(s, 3); m := MID(s, 2, 2);
        i := INSERT('ABC', 'XY', 2); d := DELETE('ABXYC', 2, 3); p := REPLACE('ABCDE', 'X', 2, 3); f := FIND('ABCBC', 'BC');",
        &[("l", "'AST'"), ("r", "'STR'"), ("m", "'ST'"), ("i", "'ABXYC'"), ("d", "'ABC'"), ("p", "'ABXE'"), ("f", "2")],
    );
    check("s : STRING[10] := 'ab';", "s := CONCAT(s, s); s := CONCAT(s, s); s := CONCAT(s, s);", &[("s", "'ababababab'")]);
    check(
        "a, b : WSTRING[6] := \"abc\"; n : INT; x : BOOL;",
        "b := CONCAT(a, \"defgh\"); n := LEN(b); x := a < b;",
        &[("b", "\"abcdef\""), ("n", "6"), ("x", "TRUE")],
    );
    check(
        "s : STRING[20]; n : INT := -12; r : REAL := 1.5; k : INT;",
        "s := CONCAT(INT_TO_STRING(n), ' ', REAL_TO_STRING(r)); k := STRING_TO_INT('42');",
        &[("s", "'-12 1.5'"), ("k", "42")],
    );
}

/// §2.9.
#[test]
fn characters() {
    let body = "c := s[2]; s[1] := CHAR#'X'; i := 3; s[i] := s[2]; t := c;";
    check("s : STRING[5] := 'abc'; c : CHAR; i : INT; t : STRING[3];", body, &[("s", "'Xbb'"), ("c", "'b'"), ("t", "'b'")]);
    for index in ["0", "4", "5", "6", "-1"] {
        let text =
            format!("PROGRAM p VAR s : STRING[5] := 'abc'; c : CHAR; i : INT; END_VAR\ni := {index};\nc := s[i];\nEND_PROGRAM");
        assert_eq!(fault(&text), (Trap::StringIndex, 3), "{index}");
    }
}

/// §2.11.
#[test]
fn parts_of_words() {
    let body =
        "w.3 := TRUE; w.15 := TRUE; b := w.15; d.%B1 := 16#AB; d.%W1 := 16#1234; y := d.%B3; l.%X63 := TRUE; l.%D0 := 16#5;";
    check(
        "w : WORD; d : DWORD; l : LWORD; b : BOOL; y : BYTE;",
        body,
        &[("w", "32776"), ("b", "TRUE"), ("d", "305441536"), ("y", "18"), ("l", "9223372036854775813")],
    );
    let f = "FUNCTION f : WORD VAR_INPUT x : WORD; END_VAR VAR w : WORD; d : DWORD; END_VAR
        w := 16#FFFF; w.0 := FALSE; w.8 := x.1; d.%B3 := 16#80; d.%B0 := 16#1; IF d.31 AND d.%B0 = 16#1 THEN w.1 := FALSE; END_IF; f := w; END_FUNCTION";
    check_in(f, "a : WORD;", "a := f(16#FFFD);", &[("a", "65276")]);
}

/// §3.4.
#[test]
fn located_variables() {
    let text = "VAR_GLOBAL g AT %MW2 : INT := 7; m AT %MX0.1 : BOOL := TRUE; END_VAR
        PROGRAM p VAR i AT %IX0.1 : BOOL; q AT %QX1.7 : BOOL; w AT %QW2 : WORD := 16#1234; a AT %ID1 : DINT; n : DINT; r : BOOL; END_VAR
        VAR_EXTERNAL g : INT; m : BOOL; END_VAR
        q := NOT i; n := a + g; r := m; m := FALSE; %QX0.0 := %IX0.1; %QB0.3 := TRUE; END_PROGRAM";
    let text = text.replace("%QB0.3", "%QX0.3");
    let mut plc = Plc::new(&text);
    assert_eq!(plc.get("%QW2"), "4660");
    plc.set("%ID1", "16#FFFFFFFE");
    plc.scans(1);
    assert_eq!(
        ["p.q", "p.n", "p.r", "m", "%QB0", "%QB1", "p.w"].map(|v| plc.get(v)),
        ["TRUE", "5", "TRUE", "FALSE", "8", "128", "4660"]
    );
    plc.set("p.i", "TRUE");
    plc.scans(1);
    assert_eq!(["p.q", "%QB0", "%QB1", "p.r"].map(|v| plc.get(v)), ["FALSE", "9", "0", "FALSE"]);
}

#[test]
fn globals_and_enumerations() {
    let text = "TYPE Light : (Red, Amber, Green); Col : DWORD (Black := 16#0, Blue := 16#FF); END_TYPE
        VAR_GLOBAL n : INT := 5; l : Light := Green; END_VAR VAR_GLOBAL CONSTANT max : INT := 9; END_VAR
        PROGRAM p VAR_EXTERNAL n : INT; l : Light; END_VAR VAR_EXTERNAL CONSTANT max : INT; END_VAR VAR c : Col; x : Light; b : BOOL; END_VAR
        n := n + max; b := l = Green; l := Red; x := SEL(b, Red, Amber); c := Blue; END_PROGRAM";
    check_program(text, 1, &[("n", "14"), ("l", "Red"), ("p.b", "TRUE"), ("p.x", "Amber"), ("p.c", "Blue")]);
}

#[test]
fn bounds() {
    for (index, inside) in [("1", true), ("3", true), ("0", false), ("4", false), ("-32768", false), ("32767", false)] {
        let text = format!("PROGRAM p\nVAR a : ARRAY[1..3] OF INT; i : INT; END_VAR\ni := {index};\na[i] :=\n  1;\nEND_PROGRAM");
        if inside { check_program(&text, 1, &[]) } else { assert_eq!(fault(&text), (Trap::Index, 4)) }
    }
    for index in ["-9223372036854775808", "9223372036854775807", "4294967297"] {
        let text = format!("PROGRAM p\nVAR a : ARRAY[-1..3] OF INT; i : LINT; END_VAR\ni := {index};\na[i] := 1;\nEND_PROGRAM");
        assert_eq!(fault(&text), (Trap::Index, 4), "{index}");
    }
    let text = "PROGRAM p\nVAR a : ARRAY[-1..3] OF INT; i : ULINT := 18446744073709551615; END_VAR\na[i] := 1;\nEND_PROGRAM";
    assert_eq!(fault(text), (Trap::Index, 3));
    let text = "PROGRAM p\nVAR a : ARRAY[1..2, 1..3] OF INT; i : INT := 4; END_VAR\na[1, i] := 1;\nEND_PROGRAM";
    assert_eq!(fault(text), (Trap::Index, 3));
}

#[test]
fn a_fault_names_the_line_of_the_subscript() {
    let text = "PROGRAM p\nVAR a : ARRAY[1..3] OF INT; i : INT; n : INT; END_VAR\nn := a[1] +\n  a[2] +\n  a[i];\nEND_PROGRAM";
    assert_eq!(fault(text), (Trap::Index, 5));
}

#[test]
fn subranges() {
    let t = "TYPE R : INT (10..20); END_TYPE";
    check_in(t, "r : R; i : INT := 20;", "r := i;", &[("r", "20")]);
    for value in ["9", "21", "-32768"] {
        let text = format!("{t}\nPROGRAM p\nVAR r : R; i : INT; END_VAR\ni := {value};\nr := i;\nEND_PROGRAM");
        assert_eq!(fault(&text), (Trap::Range, 5));
    }
}

#[test]
fn a_step_of_zero_is_a_fault() {
    let text = "PROGRAM p\nVAR i, n, s : INT; END_VAR\nFOR i := 1 TO 3 BY s DO\nn := 1;\nEND_FOR\nEND_PROGRAM";
    assert_eq!(fault(text), (Trap::ForStep, 3));
}
