//! Statements, run on both engines. From: language reference §5.5 to §5.8, §18.

use takt_tests::plc::{check, check_in, check_program};

/// §18 example 2.
#[test]
fn for_value_after_the_loop() {
    check("i, n : INT;", "FOR i := 10 TO 1 BY -3 DO n := n + 1; END_FOR", &[("n", "4"), ("i", "-2")]);
    check("u : USINT; n : INT;", "FOR u := 250 TO 255 DO n := n + 1; END_FOR", &[("n", "6"), ("u", "255")]);
    check("i, n : INT;", "FOR i := 1 TO 0 DO n := n + 1; END_FOR", &[("n", "0"), ("i", "1")]);
}

/// §5.6.
#[test]
fn for_at_the_ends_of_the_type() {
    check("i : SINT; n : INT;", "FOR i := 126 TO 127 DO n := n + 1; END_FOR", &[("n", "2"), ("i", "127")]);
    check("i : SINT; n : INT;", "FOR i := -127 TO -128 BY -1 DO n := n + 1; END_FOR", &[("n", "2"), ("i", "-128")]);
    check("i : SINT; n : INT;", "FOR i := -128 TO 127 DO n := n + 1; END_FOR", &[("n", "256"), ("i", "127")]);
    check("i : SINT; n : INT;", "FOR i := -128 TO 127 BY 100 DO n := n + 1; END_FOR", &[("n", "3"), ("i", "72")]);
    check("i : SINT; n : INT;", "FOR i := 127 TO -128 BY -128 DO n := n + 1; END_FOR", &[("n", "2"), ("i", "-1")]);
    check("u : USINT; n : INT;", "FOR u := 0 TO 255 BY 255 DO n := n + 1; END_FOR", &[("n", "2"), ("u", "255")]);
    check(
        "i : LINT; n : INT;",
        "FOR i := 9223372036854775806 TO 9223372036854775807 DO n := n + 1; END_FOR",
        &[("n", "2"), ("i", "9223372036854775807")],
    );
    check(
        "u : ULINT; n : INT;",
        "FOR u := 18446744073709551614 TO 18446744073709551615 DO n := n + 1; END_FOR",
        &[("n", "2"), ("u", "18446744073709551615")],
    );
}

#[test]
fn for_evaluates_its_ends_once() {
    check(
        "i, n, e : INT; s : INT;",
        "e := 3; s := 1; FOR i := 1 TO e BY s DO e := 10; s := 5; n := n + i; END_FOR",
        &[("n", "6"), ("i", "4")],
    );
}

#[test]
fn for_with_a_variable_step() {
    let body = "FOR i := a TO b BY s DO n := n + 1; END_FOR";
    check("i, n : INT; a : INT := 10; b : INT := 1; s : INT := -3;", body, &[("n", "4"), ("i", "-2")]);
    check("i, n : INT; a : INT := 1; b : INT := 10; s : INT := 4;", body, &[("n", "3"), ("i", "13")]);
    check("i, n : INT; a : INT := 32000; b : INT := 32767; s : INT := 500;", body, &[("n", "2"), ("i", "32500")]);
    check("i, n : INT; a : INT := -32000; b : INT := -32768; s : INT := -32768;", body, &[("n", "1"), ("i", "-32000")]);
    check("i, n : UINT; a : UINT := 65000; b : UINT := 65535; s : UINT := 535;", body, &[("n", "2"), ("i", "65535")]);
}

#[test]
fn exit_leaves_the_value_and_continue_steps() {
    check("i, n : INT;", "FOR i := 1 TO 10 DO IF i = 4 THEN EXIT; END_IF; n := n + 1; END_FOR", &[("n", "3"), ("i", "4")]);
    check(
        "i, n : INT;",
        "FOR i := 1 TO 10 DO IF i MOD 2 = 0 THEN CONTINUE; END_IF; n := n + i; END_FOR",
        &[("n", "25"), ("i", "11")],
    );
}

#[test]
fn the_body_reads_the_variable_in_calls_too() {
    let f = "FUNCTION twice : INT VAR_INPUT x : INT; END_VAR twice := 2 * x; END_FUNCTION";
    check_in(f, "i, n : INT;", "FOR i := 1 TO 3 DO n := n + twice(i); END_FOR", &[("n", "12"), ("i", "4")]);
}

#[test]
fn subrange_variable_keeps_its_range() {
    let t = "TYPE R : INT (0..10); END_TYPE";
    check_in(t, "i : R; n : INT;", "FOR i := 0 TO 10 DO n := n + i; END_FOR", &[("n", "55"), ("i", "10")]);
}

/// §18 example 3.
#[test]
fn case_with_ranges_and_enumerators() {
    let body = "FOR i := 0 TO 7 DO CASE i OF 1, 5: a := a + 1; 2..4: b := b + 1; ELSE c := c + 1; END_CASE; END_FOR";
    check("i, a, b, c : INT;", body, &[("a", "2"), ("b", "3"), ("c", "3")]);
    let t = "TYPE Light : (Red, Amber, Green); END_TYPE";
    let body = "l := Amber; CASE l OF Red: a := 1; Amber: a := 2; Green: a := 3; END_CASE;";
    check_in(t, "l : Light; a : INT;", body, &[("a", "2")]);
}

#[test]
fn case_with_wide_ranges_and_type_bounds() {
    let body = "FOR i := -128 TO 127 DO CASE i OF -128..-100: a := a + 1; 100..127: b := b + 1; 0: c := c + 1; ELSE d := d + 1; END_CASE; END_FOR";
    check("i : SINT; a, b, c, d : INT;", body, &[("a", "29"), ("b", "28"), ("c", "1"), ("d", "198")]);
    let body = "FOR i := 0 TO 255 DO CASE i OF 200..255: a := a + 1; 127, 128: b := b + 1; END_CASE; END_FOR";
    check("i : USINT; a, b : INT;", body, &[("a", "56"), ("b", "2")]);
    let body = "l := 18446744073709551615; CASE l OF 18446744073709551615: a := 1; ELSE a := 2; END_CASE";
    check("l : ULINT; a : INT;", body, &[("a", "1")]);
}

/// §18 example 4.
#[test]
fn exit_and_continue_nest() {
    let run = |flag: &str, word: &str, n: &str| {
        let body = format!(
            "f := {flag}; FOR i := 1 TO 3 DO FOR j := 1 TO 2 DO n := n + 1; IF f THEN {word}; END_IF; n := n + 1; END_FOR; n := n + 1; END_FOR"
        );
        check("f : BOOL; i, j, n : INT;", &body, &[("n", n)]);
    };
    run("FALSE", "EXIT", "15");
    run("TRUE", "EXIT", "6");
    run("TRUE", "CONTINUE", "9");
}

#[test]
fn while_and_repeat() {
    check("n, i : INT;", "WHILE i < 5 DO i := i + 1; IF i = 2 THEN CONTINUE; END_IF; n := n + i; END_WHILE", &[("n", "13")]);
    check("n : INT;", "REPEAT n := n + 1; UNTIL TRUE END_REPEAT", &[("n", "1")]);
    check(
        "n, i : INT;",
        "REPEAT i := i + 1; IF i = 3 THEN CONTINUE; END_IF; n := n + i; UNTIL i >= 5 END_REPEAT",
        &[("n", "12")],
    );
    check("n : INT;", "WHILE TRUE DO n := n + 1; IF n = 7 THEN EXIT; END_IF; END_WHILE", &[("n", "7")]);
}

#[test]
fn if_takes_the_first_true_branch() {
    let body = "FOR i := 0 TO 3 DO IF i = 0 THEN a := a + 1; ELSIF i < 2 THEN b := b + 1; ELSE c := c + 1; END_IF; END_FOR";
    check("i, a, b, c : INT;", body, &[("a", "1"), ("b", "1"), ("c", "2")]);
}

#[test]
fn return_leaves_the_unit() {
    let text = "PROGRAM p VAR n : INT; END_VAR n := n + 1; IF n > 2 THEN RETURN; END_IF; n := n + 10; END_PROGRAM";
    check_program(text, 3, &[("p.n", "13")]);
    check("n : INT;", "n := 1; RETURN; n := 2;", &[("n", "1")]);
    check("n : INT;", "IF n = 0 THEN n := 1; RETURN; ELSE RETURN; END_IF; n := 2;", &[("n", "1")]);
}

/// Values that live in registers during a loop are in memory behind it, whatever way it is left.
#[test]
fn loops_leave_their_values_in_memory() {
    let vars = "i, j : DINT; s, t : LREAL; a : ARRAY[0..9] OF LREAL; k : INT; b : BOOL;";
    let body = "FOR i := 0 TO 9 DO a[i] := i; s := s + a[i]; IF s > 20.0 THEN b := TRUE; EXIT; END_IF; END_FOR;
        t := s; FOR i := 0 TO 9 DO FOR j := 0 TO 9 DO t := t + 1.0; k := k + 1; END_FOR; END_FOR;";
    check(vars, body, &[("s", "21.0"), ("b", "TRUE"), ("t", "121.0"), ("k", "100"), ("i", "10"), ("j", "10")]);
}

#[test]
fn loops_see_elements_that_alias_variables() {
    let vars = "a : ARRAY[0..3] OF INT; i, n : INT;";
    let body = "FOR i := 0 TO 3 DO a[2] := a[2] + 1; a[i] := a[i] + 10; n := n + a[2]; END_FOR";
    check(vars, body, &[("a", "[10, 10, 14, 10]"), ("n", "30")]);
    let fb = "FUNCTION_BLOCK add VAR_IN_OUT x, y : INT; END_VAR VAR i : INT; END_VAR
        FOR i := 1 TO 3 DO x := x + 1; y := y * 2; END_FOR; END_FUNCTION_BLOCK";
    check_in(fb, "f : add; n, m : INT := 1;", "f(x := n, y := n); f(x := m, y := m);", &[("n", "22"), ("m", "22")]);
    let g = "VAR_GLOBAL total : DINT; END_VAR
        FUNCTION_BLOCK add VAR_IN_OUT x : DINT; END_VAR VAR_EXTERNAL total : DINT; END_VAR VAR i : INT; END_VAR
        FOR i := 1 TO 3 DO total := total + 1; x := x * 2; END_FOR; END_FUNCTION_BLOCK";
    check_in(g, "f : add; n : DINT; END_VAR VAR_EXTERNAL total : DINT;", "f(x := total); n := total;", &[("n", "14")]);
}
