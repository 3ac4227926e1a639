//! EN and ENO (language reference §4.8, §18.9; library reference §1, "E:"), on both engines.

use takt_base::Code;
use takt_image::Trap;
use takt_tests::plc::{check, check_in, compile_st, fault};

/// `ENO` and the value of a call as an assignment, with EN TRUE, and what is left of 99 with EN FALSE.
fn rows(ty: &str, vars: &str, rows: &[(&str, &str, &str)]) {
    for (call, value, ok) in rows {
        let (name, args) = call.split_once('(').expect("a call");
        let vars = format!("{vars} v, w, kept : {ty}; a, b, off : BOOL := TRUE; ok : BOOL; nok : BOOL;");
        let body = format!(
            "v := {name}(ENO => ok, {args}; w := {name}(EN := a, NOT ENO => nok, {args};
            kept := {name}(EN := FALSE, ENO => off, {args};"
        );
        let nok = if *ok == "TRUE" { "FALSE" } else { "TRUE" };
        check(&vars, &body, &[("v", value), ("w", value), ("ok", ok), ("nok", nok), ("off", "FALSE")]);
    }
}

#[test]
fn s18_9_div_with_en_and_eno() {
    let body = "r := DIV(EN := e, IN1 := 1, IN2 := 0, ENO => ok);";
    check("r : INT := 7; e : BOOL; ok : BOOL := TRUE;", body, &[("r", "7"), ("ok", "FALSE")]);
    check("r : INT := 7; e : BOOL := TRUE; ok : BOOL := TRUE;", body, &[("r", "0"), ("ok", "FALSE")]);
}

#[test]
fn s4_8_library_errors_clear_eno_and_give_the_stated_value() {
    rows(
        "INT",
        "z : INT; x : INT := -7; m : INT := -32768; one : INT := -1;",
        &[
            ("DIV(IN1 := x, IN2 := z)", "0", "FALSE"),
            ("DIV(IN1 := x, IN2 := 2)", "-3", "TRUE"),
            ("DIV(IN1 := m, IN2 := one)", "-32768", "TRUE"),
            ("DIV_INT(IN1 := x, IN2 := z)", "0", "FALSE"),
            ("MOD(IN1 := x, IN2 := z)", "0", "FALSE"),
            ("MOD(IN1 := x, IN2 := 3)", "-1", "TRUE"),
            ("ADD(IN1 := x, IN2 := 3, IN3 := 1)", "-3", "TRUE"),
            ("MUX(K := x, IN0 := 4, IN1 := 5)", "4", "FALSE"),
            ("MUX(K := 1, IN0 := 4, IN1 := 5)", "5", "TRUE"),
            ("MUX(K := 2, IN0 := 4, IN1 := 5)", "4", "FALSE"),
            ("ABS(IN := x)", "7", "TRUE"),
        ],
    );
}

#[test]
fn s2_conversions_tell_what_does_not_fit() {
    rows(
        "INT",
        "",
        &[
            ("DINT_TO_INT(IN := 70000)", "4464", "FALSE"),
            ("DINT_TO_INT(IN := -70)", "-70", "TRUE"),
            ("REAL_TO_INT(IN := 2.5)", "2", "TRUE"),
            ("REAL_TO_INT(IN := 32767.4)", "32767", "TRUE"),
            ("REAL_TO_INT(IN := 40000.0)", "32767", "FALSE"),
            ("REAL_TO_INT(IN := -40000.0)", "-32768", "FALSE"),
            ("TRUNC_INT(IN := REAL#-1.6)", "-1", "TRUE"),
            ("REAL_TRUNC_INT(IN := 1.0E9)", "32767", "FALSE"),
            ("ULINT_TO_INT(IN := 18446744073709551615)", "-1", "FALSE"),
            ("STRING_TO_INT(IN := '12x')", "0", "FALSE"),
            ("STRING_TO_INT(IN := ' 12')", "12", "TRUE"),
            ("STRING_TO_INT(IN := '70000')", "32767", "FALSE"),
            ("WORD_BCD_TO_INT(IN := 16#12)", "12", "TRUE"),
            ("WORD_BCD_TO_INT(IN := 16#1F)", "0", "FALSE"),
        ],
    );
    rows("UDINT", "", &[("INT_TO_UDINT(IN := -1)", "4294967295", "FALSE"), ("INT_TO_UDINT(IN := 1)", "1", "TRUE")]);
    rows("SINT", "", &[("UINT_TO_SINT(IN := 200)", "-56", "FALSE"), ("UINT_TO_SINT(IN := 100)", "100", "TRUE")]);
    rows("LINT", "", &[("ULINT_TO_LINT(IN := 9223372036854775808)", "-9223372036854775808", "FALSE")]);
    rows("ULINT", "", &[("LINT_TO_ULINT(IN := -1)", "18446744073709551615", "FALSE")]);
    rows("BYTE", "", &[("USINT_TO_BCD_BYTE(IN := 142)", "66", "FALSE"), ("USINT_TO_BCD_BYTE(IN := 42)", "66", "TRUE")]);
}

#[test]
fn s3_numeric_functions_tell_what_is_no_number() {
    for (call, ok) in [
        ("SQRT(IN := x)", "FALSE"),
        ("SQRT(IN := -x)", "TRUE"),
        ("LN(IN := z)", "FALSE"),
        ("LOG(IN := x)", "FALSE"),
        ("ASIN(IN := x)", "FALSE"),
        ("COS(IN := x)", "TRUE"),
        ("EXP(IN := 1.0E6)", "FALSE"),
        ("EXPT(IN1 := z, IN2 := -1)", "FALSE"),
        ("EXPT(IN1 := x, IN2 := 2)", "TRUE"),
        ("EXPT(IN1 := x, IN2 := 0.5)", "FALSE"),
        ("DIV(IN1 := x, IN2 := z)", "FALSE"),
        ("LREAL_TO_REAL(IN := 1.0E300)", "FALSE"),
        ("LREAL_TO_REAL(IN := 1.0E30)", "TRUE"),
    ] {
        let body = format!("r := {};", call.replace(")", ", ENO => ok)"));
        check("x : LREAL := -4.0; z, r : LREAL; ok : BOOL;", &body, &[("ok", ok)]);
    }
}

#[test]
fn s7_string_functions_tell_wrong_positions() {
    rows(
        "STRING",
        "n : INT := -1;",
        &[
            ("LEFT(IN := 'ABC', L := n)", "''", "FALSE"),
            ("LEFT(IN := 'ABC', L := 9)", "'ABC'", "TRUE"),
            ("MID(IN := 'ABC', L := 5, P := 2)", "'BC'", "TRUE"),
            ("MID(IN := 'ABC', L := 5, P := 0)", "''", "FALSE"),
            ("INSERT(IN1 := 'ABC', IN2 := 'X', P := 0)", "'XABC'", "TRUE"),
            ("INSERT(IN1 := 'ABC', IN2 := 'X', P := n)", "'ABC'", "FALSE"),
            ("DELETE(IN := 'ABC', L := 9, P := 2)", "'A'", "TRUE"),
            ("DELETE(IN := 'ABC', L := 9, P := 0)", "'ABC'", "FALSE"),
            ("REPLACE(IN1 := 'ABC', IN2 := 'WXYZ', L := 1, P := 5)", "'ABC'", "FALSE"),
            ("CONCAT(IN1 := 'A', IN2 := 'B', IN3 := 'C')", "'ABC'", "TRUE"),
        ],
    );
}

#[test]
fn s8_times_and_dates_tell_what_is_none() {
    rows(
        "TOD",
        "",
        &[
            ("ADD(IN1 := TOD#23:59:59, IN2 := T#2s)", "TOD#00:00:01", "FALSE"),
            ("ADD_TOD_TIME(IN1 := TOD#23:59:57, IN2 := T#2s)", "TOD#23:59:59", "TRUE"),
            ("SUB_TOD_TIME(IN1 := TOD#00:00:01, IN2 := T#2s)", "TOD#23:59:59", "FALSE"),
            ("CONCAT_TOD(HOUR := 24, MINUTE := 0, SECOND := 0, MILLISECOND := 0)", "TOD#00:00:00", "FALSE"),
        ],
    );
    rows(
        "DATE",
        "",
        &[
            ("CONCAT_DATE(YEAR := 2023, MONTH := 2, DAY := 29)", "D#1970-01-01", "FALSE"),
            ("CONCAT_DATE(YEAR := 2024, MONTH := 2, DAY := 29)", "D#2024-02-29", "TRUE"),
        ],
    );
    rows(
        "TIME",
        "z : INT;",
        &[("DIV_TIME(IN1 := T#1s, IN2 := z)", "T#0s", "FALSE"), ("DIV(IN1 := T#1s, IN2 := 2)", "T#500ms", "TRUE")],
    );
}

#[test]
fn s5_a_negative_count_leaves_the_input() {
    rows(
        "BYTE",
        "n : INT := -1; x : BYTE := 16#45;",
        &[
            ("SHL(IN := x, N := n)", "69", "FALSE"),
            ("SHL(IN := x, N := 2)", "20", "TRUE"),
            ("ROL(IN := x, N := n)", "162", "TRUE"),
        ],
    );
}

const SCALE: &str =
    "FUNCTION Scale : INT VAR_INPUT EN : BOOL := TRUE; a : INT; END_VAR VAR_OUTPUT ENO : BOOL; twice : INT; END_VAR
    Scale := a + 1; twice := 2 * a; IF a < 0 THEN ENO := FALSE; END_IF END_FUNCTION
    FUNCTION Plain : INT VAR_INPUT a : INT; END_VAR VAR_OUTPUT twice : INT; END_VAR Plain := a + 1; twice := 2 * a; END_FUNCTION";

#[test]
fn s4_8_functions_with_and_without_declared_eno() {
    let vars = "r, s, t, q : INT := 9; u, v : INT; ok, ok2, ok3, ok4, no : BOOL;";
    let body = "r := Scale(3, u); s := Scale(EN := TRUE, a := 4, ENO => ok, twice => v); t := Scale(a := -4, ENO => ok2);
        q := Scale(EN := FALSE, a := 4, ENO => ok3, twice => v); t := Plain(EN := r = 4, a := t, ENO => ok4);
        Plain(EN := FALSE, a := 1, twice => u, NOT ENO => no);";
    let expected = [
        ("r", "4"),
        ("u", "6"),
        ("s", "5"),
        ("ok", "TRUE"),
        ("v", "8"),
        ("ok2", "FALSE"),
        ("q", "9"),
        ("ok3", "FALSE"),
        ("t", "-2"),
        ("ok4", "TRUE"),
        ("no", "TRUE"),
    ];
    check_in(SCALE, vars, body, &expected);
}

#[test]
fn s4_8_calls_within_expressions() {
    let vars = "x : INT; z, n : INT := 3; ok, ok2 : BOOL; s : STRING := 'old'; t : STRING; p : BOOL;";
    let body = "x := 10 + DIV(IN1 := 6, IN2 := n, ENO => ok) * 2 + Plain(EN := FALSE, a := 5, ENO => ok2);
        t := CONCAT(LEFT(EN := FALSE, IN := 'abc', L := 2), 'x'); z := DIV(EN := n <> 3, IN1 := 1, IN2 := n - 3);
        s := MID(EN := ok2, IN := s, L := 1, P := 1); p := NOT (DIV(IN1 := n, IN2 := 0, ENO => ok2) > 0) AND NOT ok2;";
    check_in(
        SCALE,
        vars,
        body,
        &[("x", "14"), ("ok", "TRUE"), ("ok2", "FALSE"), ("t", "'x'"), ("z", "3"), ("s", "'old'"), ("p", "TRUE")],
    );
}

#[test]
fn s4_8_the_value_is_not_the_variable_that_eno_goes_to() {
    check("b, r : BOOL;", "r := MOVE(IN := b, ENO => b);", &[("r", "FALSE"), ("b", "TRUE")]);
}

#[test]
fn s4_8_conversions_around_the_call_do_not_assign_either() {
    check("r : LREAL := 1.5; i : INT := 3;", "r := DIV(EN := i = 4, IN1 := i, IN2 := 1);", &[("r", "1.5")]);
}

const BLOCKS: &str = "FUNCTION_BLOCK Plain VAR_INPUT a : INT; END_VAR VAR_OUTPUT q : INT; END_VAR q := q + a; END_FUNCTION_BLOCK
    FUNCTION_BLOCK Own VAR_INPUT EN : BOOL := TRUE; a : INT; END_VAR VAR_OUTPUT ENO : BOOL; q : INT; END_VAR
    q := q + a; IF a = 0 THEN ENO := FALSE; END_IF END_FUNCTION_BLOCK";

#[test]
fn s4_8_blocks() {
    let vars = "f : Plain; g : Own; h : Own; i, j : INT := 5; ok, ok2, ok3, ok4, ok5 : BOOL := TRUE;";
    let body = "f(EN := FALSE, a := 3, ENO => ok, q => i); f(EN := TRUE, a := 4, ENO => ok2); f(a := 1);
        g(1); g(EN := FALSE, a := 7, ENO => ok3, q => j); ok4 := g.ENO; g(EN := TRUE, a := 2); g(a := 0, ENO => ok5);
        h.EN := FALSE; h(a := 3);";
    check_in(
        BLOCKS,
        vars,
        body,
        &[
            ("f.q", "5"),
            ("i", "5"),
            ("ok", "FALSE"),
            ("ok2", "TRUE"),
            ("g.q", "3"),
            ("j", "5"),
            ("ok3", "FALSE"),
            ("ok4", "FALSE"),
            ("ok5", "FALSE"),
            ("h.q", "0"),
            ("h.a", "0"),
        ],
    );
}

#[test]
fn standard_blocks_take_en() {
    let body = "c(EN := FALSE, CU := TRUE, PV := 1, ENO => ok); c(EN := TRUE, CU := TRUE, PV := 1, ENO => run);";
    check("c : CTU; ok, run : BOOL;", body, &[("c.CV", "1"), ("ok", "FALSE"), ("run", "TRUE")]);
}

#[test]
fn operators_and_plain_calls_still_fault() {
    for body in ["x := 1 / x;", "x := DIV(1, x);"] {
        assert_eq!(fault(&format!("PROGRAM p VAR x : INT; END_VAR\n{body}\nEND_PROGRAM")), (Trap::DivisionByZero, 2));
    }
}

#[test]
fn mistakes() {
    for (body, code) in [
        ("x := ADD(ENO => x, IN1 := 1, IN2 := 2);", Code::TypeMismatch),
        ("x := ADD(EN := 5, IN1 := 1, IN2 := 2);", Code::NotBool),
        ("x := ADD(EN := TRUE, EN := TRUE, IN1 := 1, IN2 := 2);", Code::WrongArgumentCount),
        ("x := ADD(ENO := TRUE, IN1 := 1, IN2 := 2);", Code::UnknownParameter),
        ("x := ADD(EN := TRUE, IN1 := 1);", Code::WrongArgumentCount),
    ] {
        let result = compile_st(&format!("PROGRAM p VAR x : INT; END_VAR {body} END_PROGRAM"));
        let codes: Vec<_> = result.diags.iter().map(|d| d.code).collect();
        assert_eq!(codes, [code], "{body}");
    }
}
