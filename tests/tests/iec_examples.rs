//! The worked examples of the language reference, §18, 2 to 8: with literals and with values that the compiler can't know.

use takt_tests::plc::{Plc, check, check_in};

/// 2. FOR: passes and last value, with the ends in variables too.
#[test]
fn example_2() {
    for (ty, from, to, by, passes, last) in
        [("INT", "10", "1", "-3", "4", "-2"), ("USINT", "250", "255", "1", "6", "255"), ("INT", "1", "0", "1", "0", "1")]
    {
        check(
            &format!("i : {ty}; n : INT;"),
            &format!("FOR i := {from} TO {to} BY {by} DO n := n + 1; END_FOR"),
            &[("n", passes), ("i", last)],
        );
        let vars = format!("i : {ty}; a : {ty} := {from}; b : {ty} := {to}; s : {ty} := {by}; n : INT;");
        check(&vars, "FOR i := a TO b BY s DO n := n + 1; END_FOR", &[("n", passes), ("i", last)]);
    }
}

/// 3. CASE with a list, a range, ELSE; with an enumeration.
#[test]
fn example_3() {
    let mut plc = Plc::new(
        "TYPE Light : (Red, Amber, Green); END_TYPE
        PROGRAM p VAR i, n, m : INT; l : Light; END_VAR
        CASE i OF 1, 5: n := 1; 2..4: n := 2; ELSE n := 3; END_CASE;
        CASE l OF Red: m := 1; Light#Amber: m := 2; END_CASE END_PROGRAM",
    );
    for (i, n) in [("3", "2"), ("1", "1"), ("5", "1"), ("2", "2"), ("4", "2"), ("0", "3"), ("6", "3"), ("-32768", "3")] {
        plc.set("p.i", i);
        plc.scans(1);
        assert_eq!(plc.get("p.n"), n, "{i}");
    }
    for (l, m) in [("Red", "1"), ("Amber", "2"), ("Green", "2")] {
        plc.set("p.l", l);
        plc.scans(1);
        assert_eq!(plc.get("p.m"), m, "{l}");
    }
}

/// §5.5: bit strings, characters and wide types select too.
#[test]
fn case_of_other_types() {
    check("b : BYTE := 16#A0; n : INT;", "CASE b OF 16#00..16#7F: n := 1; 16#80..16#FF: n := 2; END_CASE", &[("n", "2")]);
    check(
        "l : LINT := -9000000000; n : INT;",
        "CASE l OF -9223372036854775808..-8999999999: n := 1; ELSE n := 2; END_CASE",
        &[("n", "1")],
    );
}

/// 4. EXIT and CONTINUE in nested loops.
#[test]
fn example_4() {
    for (word, flag, n) in
        [("EXIT", "FALSE", "15"), ("EXIT", "TRUE", "6"), ("CONTINUE", "TRUE", "9"), ("CONTINUE", "FALSE", "15")]
    {
        let body = format!(
            "n := 0; FOR i := 1 TO 3 DO FOR j := 1 TO 2 DO n := n + 1; IF flag THEN {word}; END_IF; n := n + 1; END_FOR; n := n + 1; END_FOR"
        );
        let mut plc = Plc::new(&format!("PROGRAM p VAR flag : BOOL; i, j, n : INT; END_VAR {body} END_PROGRAM"));
        plc.set("p.flag", flag);
        plc.scans(2);
        assert_eq!(plc.get("p.n"), n, "{word} {flag}");
    }
}

/// 5. Values of mixed operators; see `iec_precedence` for all.
#[test]
fn example_5() {
    check(
        "x : LREAL; b : BOOL; i, j, k : INT; w : WORD;",
        "x := 2 + 3 * 4.0 ** 2; b := NOT TRUE OR TRUE; i := 10 - 4 - 3; j := -7 / 2; k := -7 MOD 2; w := 16#F0 AND 16#3C OR 16#01;",
        &[("x", "50.0"), ("b", "TRUE"), ("i", "3"), ("j", "-3"), ("k", "-1"), ("w", "49")],
    );
}

/// 6. The common type of two operands.
#[test]
fn example_6() {
    check("d : DINT;", "d := INT#300 + UINT#5;", &[("d", "305")]);
    check("a : INT := 32767; b : UINT := 65535; d : DINT;", "d := a + b;", &[("d", "98302")]);
    check("s : SINT := 100; r : SINT; i : INT;", "r := s + s; i := s + s;", &[("r", "-56"), ("i", "-56")]);
    check("r : REAL;", "r := REAL#1.0 / 3;", &[("r", "0.33333334")]);
    check("w : WORD;", "w := WORD#16#FF00 OR BYTE#16#0F;", &[("w", "65295")]);
    check("a : UDINT := 4294967295; b : DINT := -1; l : LINT;", "l := a + b;", &[("l", "4294967294")]);
    check("a : DINT := 16777217; r : REAL := 1.0; x : LREAL;", "x := a + r;", &[("x", "16777218.0")]);
}

/// 7. An edge input is TRUE for the call that sees the edge.
#[test]
fn example_7() {
    let text = "FUNCTION_BLOCK e VAR_INPUT c : BOOL R_EDGE; d : BOOL F_EDGE; END_VAR VAR_OUTPUT up, down : BOOL; END_VAR up := c; down := d; END_FUNCTION_BLOCK
        PROGRAM p VAR x : BOOL; e1 : e; END_VAR e1(c := x, d := x); END_PROGRAM";
    let mut plc = Plc::new(text);
    for (scan, (x, up, down)) in [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 0, 1), (1, 1, 0)].into_iter().enumerate() {
        let shown = |b: i32| if b == 1 { "TRUE" } else { "FALSE" };
        plc.set("p.x", shown(x));
        assert_eq!(plc.scan(10 * scan as i64), Ok(()));
        assert_eq!([plc.get("p.e1.up"), plc.get("p.e1.down")], [shown(up), shown(down)], "scan {scan}");
    }
}

/// 8. One variable lent twice keeps its value when it is swapped with itself.
#[test]
fn example_8() {
    let fb = "FUNCTION_BLOCK swap VAR_IN_OUT a, b : INT; END_VAR VAR t : INT; END_VAR t := a; a := b; b := t; END_FUNCTION_BLOCK
        FUNCTION swapped : INT VAR_IN_OUT a, b : INT; END_VAR VAR t : INT; END_VAR t := a; a := b; b := t; swapped := a; END_FUNCTION";
    check_in(
        fb,
        "s : swap; x : INT := 5; y : INT := 6; r : INT; l : ARRAY[0..2] OF INT := [1, 2, 3]; i : INT := 1;",
        "s(a := x, b := x); s(a := x, b := y); r := swapped(a := x, b := x); s(a := l[i], b := l[i + 1]); r := r + swapped(a := l[0], b := l[i - 1]);",
        &[("x", "6"), ("y", "5"), ("r", "7"), ("l", "[1, 3, 2]")],
    );
}
