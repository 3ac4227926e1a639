//! Operators and inline functions at the bounds of their types, run on both engines. From: language reference §5.2 to §5.4;
//! library reference §2 to §6, §8.1.

use takt_tests::plc::{check, fault};

/// §18 example 5. The operands are variables, so that nothing is folded.
#[test]
fn precedence() {
    let vars = "a : INT := 2; b : INT := 3; c : LREAL := 4.0; t : BOOL := TRUE; x : LREAL; r : BOOL; i, j, k : INT; s : INT := -7; w, v : WORD;";
    let body = "x := 2.0 + 3.0 * c ** a; r := NOT t OR t; i := 10 - 4 - b; j := s / a; k := s MOD a;
        v := 16#3C; w := 16#F0 AND v OR 16#01;";
    check(vars, body, &[("x", "50.0"), ("r", "TRUE"), ("i", "3"), ("j", "-3"), ("k", "-1"), ("w", "49")]);
}

/// §18 example 6.
#[test]
fn arithmetic_is_done_in_the_common_type() {
    check("a : INT := 300; b : UINT := 5; d : DINT;", "d := a + b;", &[("d", "305")]);
    check("a : SINT := 100; d : SINT;", "d := a + a;", &[("d", "-56")]);
    check("a : WORD := 16#FF00; b : BYTE := 16#0F; d : WORD;", "d := a OR b;", &[("d", "65295")]);
    check("a : REAL := 1.0; d : REAL;", "d := a / 3;", &[("d", "0.33333334")]);
}

#[test]
fn integers_wrap_in_their_width() {
    for (ty, min, max) in [
        ("SINT", "-128", "127"),
        ("INT", "-32768", "32767"),
        ("DINT", "-2147483648", "2147483647"),
        ("LINT", "-9223372036854775808", "9223372036854775807"),
        ("USINT", "0", "255"),
        ("UINT", "0", "65535"),
        ("UDINT", "0", "4294967295"),
        ("ULINT", "0", "18446744073709551615"),
    ] {
        let vars = format!("lo : {ty} := {min}; hi : {ty} := {max}; one : {ty} := 1; a, b, c, d, m : {ty}; l, g, e : BOOL;");
        let body = "a := hi + one; b := lo - one; c := hi * hi; d := hi / one; m := hi MOD one;
            l := lo < hi; g := lo > hi; e := hi + one = lo;";
        let expected = [("a", min), ("b", max), ("c", "1"), ("d", max), ("m", "0"), ("l", "TRUE"), ("g", "FALSE"), ("e", "TRUE")];
        check(&vars, body, &expected);
    }
}

#[test]
fn division_of_the_minimum_wraps() {
    for (ty, min) in [("SINT", "-128"), ("INT", "-32768"), ("DINT", "-2147483648"), ("LINT", "-9223372036854775808")] {
        let vars = format!("lo : {ty} := {min}; m : {ty} := -1; d, r, n, a : {ty};");
        check(&vars, "d := lo / m; r := lo MOD m; n := -lo; a := ABS(lo);", &[("d", min), ("r", "0"), ("n", min), ("a", min)]);
    }
}

#[test]
fn division_by_zero() {
    check("a : INT := 7; z, r : INT := 5;", "z := 0; r := a MOD z;", &[("r", "0")]);
    check("a : ULINT := 7; z, r : ULINT := 5;", "z := 0; r := a MOD z;", &[("r", "0")]);
    check(
        "a : LREAL := 7.0; z : LREAL; b, c : BOOL;",
        "b := IS_VALID(a / z); c := a / z > 1.0E300;",
        &[("b", "FALSE"), ("c", "TRUE")],
    );
    for ty in ["SINT", "USINT", "INT", "DINT", "LINT", "ULINT"] {
        let text = format!("PROGRAM p\nVAR a, b, c : {ty};\nEND_VAR\na := 1;\nc := a / b;\nEND_PROGRAM");
        assert_eq!(fault(&text), (takt_image::Trap::DivisionByZero, 5), "{ty}");
    }
}

#[test]
fn reals() {
    check("x : REAL := 0.1; y : REAL := 0.2; z : REAL;", "z := x + y;", &[("z", "0.3")]);
    check("x : LREAL := 0.1; y : LREAL := 0.2; z : LREAL;", "z := x + y;", &[("z", "0.30000000000000004")]);
    check(
        "x : LREAL := -2.25; a, s, n : LREAL;",
        "a := ABS(x); s := SQRT(-x); n := -x;",
        &[("a", "2.25"), ("s", "1.5"), ("n", "2.25")],
    );
    let vars = "z : LREAL; n : LREAL; a, b, c, d, e : BOOL;";
    let body = "n := z / z; a := n = n; b := n <> n; c := n < 1.0; d := n >= 1.0; e := NOT IS_VALID(n);";
    check(vars, body, &[("a", "FALSE"), ("b", "TRUE"), ("c", "FALSE"), ("d", "FALSE"), ("e", "TRUE")]);
}

#[test]
fn power() {
    check(
        "x : LREAL := 2.0; n : INT := 10; m : INT := -1; a, b, c : LREAL;",
        "a := x ** n; b := x ** m; c := EXPT(x, 0.5);",
        &[("a", "1024.0"), ("b", "0.5"), ("c", "1.4142135623730951")],
    );
    check("x : REAL := 3.0; a : REAL;", "a := x ** 2;", &[("a", "9.0")]);
}

#[test]
fn bit_strings() {
    check(
        "a : BYTE := 16#45; n : INT := 2; x, y : BYTE; w : WORD := 16#45; v : WORD;",
        "x := SHL(a, n); y := SHR(a, n); v := SHL(w, n);",
        &[("x", "20"), ("y", "17"), ("v", "276")],
    );
    for (n, shl, shr, rol, ror) in [
        ("0", "129", "129", "129", "129"),
        ("7", "128", "1", "192", "3"),
        ("8", "0", "0", "129", "129"),
        ("9", "0", "0", "3", "192"),
        ("100", "0", "0", "24", "24"),
        ("-1", "129", "129", "192", "3"),
        ("-9", "129", "129", "192", "3"),
    ] {
        let vars = format!("b : BYTE := 16#81; n : INT := {n}; a, c, d, e : BYTE;");
        let body = "a := SHL(b, n); c := SHR(b, n); d := ROL(b, n); e := ROR(b, n);";
        check(&vars, body, &[("a", shl), ("c", shr), ("d", rol), ("e", ror)]);
    }
    check(
        "l : LWORD := 16#8000000000000001; n : DINT := 64; a, b, c : LWORD;",
        "a := SHL(l, n); b := SHR(l, 63); c := ROL(l, 1);",
        &[("a", "0"), ("b", "1"), ("c", "3")],
    );
    check(
        "a, b : BOOL := TRUE; w : WORD := 16#00FF; x, y : WORD; c, d : BOOL;",
        "x := NOT w; y := w XOR 16#0F0F; c := a XOR b; d := NOT a;",
        &[("x", "65280"), ("y", "4080"), ("c", "FALSE"), ("d", "FALSE")],
    );
}

#[test]
fn comparisons_follow_the_sign() {
    check(
        "a : UDINT := 4294967295; b : UDINT := 1; c : DINT := -1; d : DINT := 1; x, y : BOOL;",
        "x := a > b; y := c > d;",
        &[("x", "TRUE"), ("y", "FALSE")],
    );
    check("a : WORD := 16#FFFF; b : WORD := 16#1; x : BOOL;", "x := a > b;", &[("x", "TRUE")]);
    check("a : TIME := T#-1s; b : TIME := T#1s; x : BOOL;", "x := a < b;", &[("x", "TRUE")]);
    check("a, b : BOOL; x, y : BOOL;", "b := TRUE; x := a < b; y := GT(b, a);", &[("x", "TRUE"), ("y", "TRUE")]);
    check(
        "a : INT := 3; b : INT := 2; c : INT := 2; x, y, z : BOOL;",
        "x := GT(a, b, c); y := GE(a, b, c); z := EQ(b, c, b);",
        &[("x", "FALSE"), ("y", "TRUE"), ("z", "TRUE")],
    );
}

#[test]
fn selection() {
    let vars = "g : BOOL := TRUE; a : INT := 1; b : INT := 2; c : INT := 3; k : INT; r, s, t, u, v, w, x : INT;";
    let body = "r := SEL(g, a, b); s := MAX(a, c, b); t := MIN(c, a, b); u := LIMIT(b, c, b); v := LIMIT(b, a, c);
        k := 2; w := MUX(k, a, b, c); k := 7; x := MUX(k, a, b, c);";
    check(vars, body, &[("r", "2"), ("s", "3"), ("t", "1"), ("u", "2"), ("v", "2"), ("w", "3"), ("x", "1")]);
    check("a : INT := 5; m : INT := 9; n : INT := 1; r : INT;", "r := LIMIT(m, a, n);", &[("r", "1")]);
    let vars = "z, n : LREAL; a : LREAL := 1.0; r, s, t, u : LREAL; x : BOOL;";
    let body = "n := z / z; r := MAX(n, a); s := MAX(a, n); t := MIN(n, a); u := MIN(a, n); x := IS_VALID(MAX(n, n));";
    check(vars, body, &[("r", "1.0"), ("s", "1.0"), ("t", "1.0"), ("u", "1.0"), ("x", "FALSE")]);
    let vars = "g : BOOL; a : STRING[5] := 'abc'; b : STRING[20] := 'longer text'; r, s, t : STRING[30];";
    let body = "r := SEL(g, a, b); g := TRUE; s := SEL(g, a, b); t := MAX(a, b);";
    check(vars, body, &[("r", "'abc'"), ("s", "'longer text'"), ("t", "'longer text'")]);
}

/// Library reference §2.2.
#[test]
fn conversions() {
    for (x, i, t) in [
        ("0.4", "0", "0"),
        ("0.5", "0", "0"),
        ("1.5", "2", "1"),
        ("2.5", "2", "2"),
        ("3.5", "4", "3"),
        ("-0.5", "0", "0"),
        ("-1.5", "-2", "-1"),
        ("-2.5", "-2", "-2"),
        ("32767.4", "32767", "32767"),
        ("40000.0", "32767", "32767"),
        ("-1.0E30", "-32768", "-32768"),
    ] {
        check(&format!("x : REAL := {x}; i, t : INT;"), "i := REAL_TO_INT(x); t := REAL_TRUNC_INT(x);", &[("i", i), ("t", t)]);
    }
    check(
        "z : LREAL; i : DINT := 5; u : ULINT;",
        "i := LREAL_TO_DINT(z / z); u := LREAL_TO_ULINT(1.0E30 + z);",
        &[("i", "0"), ("u", "18446744073709551615")],
    );
    let vars = "d : DINT := 70000; i : INT; u : UINT := 200; s : SINT; n : INT := -1; w : DWORD; v : UDINT; b : BYTE := 16#FF; c : SINT;";
    let body = "i := DINT_TO_INT(d); s := UINT_TO_SINT(u); w := INT_TO_DWORD(n); v := INT_TO_UDINT(n); c := BYTE_TO_SINT(b);";
    check(vars, body, &[("i", "4464"), ("s", "-56"), ("w", "65535"), ("v", "4294967295"), ("c", "-1")]);
    check(
        "d : DWORD := 16#3F800000; r : REAL; b : BYTE := 16#03; x : BOOL; w : DWORD;",
        "r := DWORD_TO_REAL(d); x := BYTE_TO_BOOL(b); w := REAL_TO_DWORD(r);",
        &[("r", "1.0"), ("x", "TRUE"), ("w", "1065353216")],
    );
    check(
        "u : ULINT := 18446744073709551615; r : LREAL; l : LINT := 16777217; f : REAL;",
        "r := ULINT_TO_LREAL(u); f := LINT_TO_REAL(l);",
        &[("r", "1.8446744073709552e19"), ("f", "16777216.0")],
    );
}

/// A number of 64 bits becomes a REAL in one rounding: by way of LREAL this one would end a unit lower.
#[test]
fn int_to_real_rounds_once() {
    check(
        "l : LINT := 1152921573326323713; f : REAL; d : LREAL;",
        "f := LINT_TO_REAL(l); d := f;",
        &[("d", "1.1529216420458004e18")],
    );
    check(
        "l : ULINT := 1152921573326323713; f : REAL; d : LREAL;",
        "f := ULINT_TO_REAL(l); d := f;",
        &[("d", "1.1529216420458004e18")],
    );
}

/// Library reference §8.1.
#[test]
fn time_arithmetic() {
    let vars = "a : TIME := T#1s500ms; n : INT := 2; r : REAL; l : LREAL := 0.3333; x, y, z, q : TIME; z0 : INT;";
    let body = "x := a * n; y := T#1s * l; z := a / n; q := a / z0;";
    check(vars, body, &[("x", "T#3s"), ("y", "T#333ms300us"), ("z", "T#750ms"), ("q", "T#0s")]);
    for (t, n, q) in [
        ("T#10ms", "4", "T#2ms500us"),
        ("T#-7ns", "2", "T#-4ns"),
        ("T#5ns", "2", "T#2ns"),
        ("T#7ns", "2", "T#4ns"),
        ("T#7ns", "-2", "T#-4ns"),
        ("T#11ns", "4", "T#3ns"),
        ("T#9ns", "4", "T#2ns"),
    ] {
        check(&format!("t, q : TIME; n : INT := {n};"), &format!("t := {t}; q := t / n;"), &[("q", q)]);
    }
    let vars = "t : TOD := TOD#23:59:59; d : DT := DT#2023-12-31-23:59:59; s : TIME := T#2s; x, y : TOD; e : DT; u : TIME;";
    let body = "x := t + s; y := TOD#00:00:01 - s; e := d + T#1s; u := TOD#08:00:00 - TOD#09:30:00;";
    check(vars, body, &[("x", "TOD#00:00:01"), ("y", "TOD#23:59:59"), ("e", "DT#2024-01-01-00:00:00"), ("u", "T#-1h30m")]);
}

/// §5.4.
#[test]
fn short_circuit() {
    let vars = "a : ARRAY[1..3] OF INT := [1, 2, 3]; i : INT := 9; r, s : BOOL;";
    check(vars, "r := i <= 3 AND_THEN a[i] = 1; s := i > 3 OR_ELSE a[i] = 1;", &[("r", "FALSE"), ("s", "TRUE")]);
    check(vars, "r := i <= 3 AND a[i] = 1; s := i > 3 OR a[i] = 1;", &[("r", "FALSE"), ("s", "TRUE")]);
    check(vars, "IF i <= 3 AND a[i] = 1 THEN r := TRUE; ELSE s := TRUE; END_IF", &[("r", "FALSE"), ("s", "TRUE")]);
}
