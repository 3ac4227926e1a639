//! Arrays of variable length (language reference §2.7, §4.7), on both engines.

use takt_base::{Code, Profile, Severity};
use takt_image::Trap;
use takt_tests::plc::{Plc, check_program, compile_in, compile_st};

const UNITS: &str = "FUNCTION Sum : DINT VAR_INPUT a : ARRAY [*] OF INT; END_VAR VAR i : DINT; END_VAR
        FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO Sum := Sum + a[i]; END_FOR;
    END_FUNCTION
    FUNCTION Fill : DINT VAR_IN_OUT a : ARRAY [*, *] OF INT; END_VAR VAR_INPUT start : INT; END_VAR VAR i, j : DINT; n : INT; END_VAR
        n := start;
        FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO
            FOR j := LOWER_BOUND(a, 2) TO UPPER_BOUND(a, 2) DO a[i, j] := n; n := n + 1; END_FOR;
        END_FOR;
        Fill := (UPPER_BOUND(a, 1) - LOWER_BOUND(a, 1) + 1) * (UPPER_BOUND(a, 2) - LOWER_BOUND(a, 2) + 1);
    END_FUNCTION
    FUNCTION Both : DINT VAR_IN_OUT a : ARRAY [*] OF INT; END_VAR a[LOWER_BOUND(a, 1)] := 100; Both := Sum(a) * 2; END_FUNCTION
    FUNCTION Copy : BOOL VAR_INPUT a : ARRAY [*] OF INT; END_VAR VAR_OUTPUT b : ARRAY [*] OF INT; END_VAR VAR i : DINT; END_VAR
        FOR i := 0 TO UPPER_BOUND(a, 1) - LOWER_BOUND(a, 1) DO b[LOWER_BOUND(b, 1) + i] := a[LOWER_BOUND(a, 1) + i]; END_FOR; Copy := TRUE;
    END_FUNCTION
    TYPE P : STRUCT x : INT; t : ARRAY [1..2] OF INT; END_STRUCT; END_TYPE
    FUNCTION_BLOCK Scale VAR_IN_OUT a : ARRAY [*] OF P; END_VAR VAR_INPUT f : INT; END_VAR VAR_OUTPUT n : DINT; END_VAR VAR i : DINT; END_VAR
        FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO a[i].x := a[i].x * f; a[i].t[2] := a[i].x + 1; n := n + 1; END_FOR;
    END_FUNCTION_BLOCK ";

#[test]
fn arrays_of_any_bounds() {
    let text = format!("{UNITS} PROGRAM Main VAR a : ARRAY [-1..2] OF INT := [1, 2, 3, 4]; b : ARRAY [5..5] OF INT := [7]; c : ARRAY [1..2, 0..2] OF INT;
        d : ARRAY [3..6] OF INT; p : ARRAY [0..1] OF P := [(x := 3), (x := 4)]; s : Scale; s1, s2, n, m : DINT; l : DINT; ok : BOOL; END_VAR
        s1 := Sum(a) * 10 + Sum(a := b); n := Fill(a := c, start := 5); m := Both(a); s2 := Sum(a);
        ok := Copy(a := a, b => d); s(a := p, f := 2); s(a := p, f := 10);
        l := LOWER_BOUND(c, 2) * 100 + UPPER_BOUND(c, 2) * 10 + UPPER_BOUND(c, 1);
        END_PROGRAM");
    check_program(
        &text,
        1,
        &[
            ("Main.s1", "107"),
            ("Main.n", "6"),
            ("Main.c", "[[5, 6, 7], [8, 9, 10]]"),
            ("Main.m", "218"),
            ("Main.s2", "109"),
            ("Main.d", "[100, 2, 3, 4]"),
            ("Main.p", "[(x := 60, t := [0, 61]), (x := 80, t := [0, 81])]"),
            ("Main.s.n", "4"),
            ("Main.l", "22"),
        ],
    );
}

#[test]
fn every_element_is_checked() {
    let at = |index: &str, ty: &str| {
        let text = format!("FUNCTION F : INT VAR_IN_OUT a : ARRAY [*] OF INT; END_VAR VAR_INPUT i : {ty}; END_VAR a[i] := 1; F := a[i]; END_FUNCTION
            PROGRAM Main VAR before : ARRAY [0..9] OF INT; a : ARRAY [-2..3] OF INT; i : {ty} := {index}; END_VAR F(a := a, i := i); END_PROGRAM");
        Plc::new(&text).scan(0).err().map(|f| f.trap)
    };
    for (index, ty, inside) in [
        ("-2", "INT", true),
        ("3", "INT", true),
        ("-3", "INT", false),
        ("4", "INT", false),
        ("4294967296", "LINT", false),
        ("0", "ULINT", true),
        ("18446744073709551615", "ULINT", false),
        ("-9223372036854775808", "LINT", false),
        ("4294967295", "UDINT", false),
    ] {
        assert_eq!(at(index, ty), (!inside).then_some(Trap::Index), "{index} {ty}");
    }
}

#[test]
fn a_chain_of_calls_keeps_the_bounds() {
    let text = "FUNCTION Last : INT VAR_INPUT a : ARRAY [*] OF INT; END_VAR Last := a[UPPER_BOUND(a, 1)]; END_FUNCTION
        FUNCTION_BLOCK B VAR_IN_OUT a : ARRAY [*] OF INT; END_VAR VAR_OUTPUT q : INT; END_VAR VAR i : Inner; END_VAR i(a := a); q := i.q; END_FUNCTION_BLOCK
        FUNCTION_BLOCK Inner VAR_IN_OUT a : ARRAY [*] OF INT; END_VAR VAR_OUTPUT q : INT; END_VAR q := Last(a) + a[LOWER_BOUND(ARR := a, DIM := 1)]; a[0] := q; END_FUNCTION_BLOCK
        FUNCTION Local : INT VAR a : ARRAY [-3..3] OF INT := [7(6)]; b : B; END_VAR Local := Last(a); END_FUNCTION
        PROGRAM Main VAR a : ARRAY [-1..1] OF INT := [4, 5, 6]; b : B; n : INT; END_VAR b(a := a); n := Local() + b.q; END_PROGRAM";
    check_program(&text.replace(" b : B; END_VAR Local", " END_VAR Local"), 1, &[("Main.a", "[4, 10, 6]"), ("Main.n", "16")]);
}

#[test]
fn where_it_may_stand_and_what_it_takes() {
    let codes = |text: &str| {
        let c = compile_st(text);
        c.diags.iter().filter(|d| d.severity == Severity::Error).map(|d| d.code).collect::<Vec<_>>()
    };
    for text in [
        "VAR_GLOBAL a : ARRAY [*] OF INT; END_VAR",
        "TYPE t : ARRAY [*] OF INT; END_TYPE",
        "TYPE t : STRUCT a : ARRAY [*] OF INT; END_STRUCT; END_TYPE",
        "FUNCTION f : ARRAY [*] OF INT END_FUNCTION",
        "FUNCTION_BLOCK b VAR_INPUT a : ARRAY [*] OF INT; END_VAR END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK b VAR a : ARRAY [*] OF INT; END_VAR END_FUNCTION_BLOCK",
        "FUNCTION f : INT VAR a : ARRAY [*] OF INT; END_VAR f := 1; END_FUNCTION",
        "FUNCTION f : INT VAR_IN_OUT a : ARRAY [0..1] OF ARRAY [*] OF INT; END_VAR f := 1; END_FUNCTION",
        "FUNCTION f : INT VAR_IN_OUT a, b : ARRAY [*] OF INT; END_VAR a := b; f := 1; END_FUNCTION",
    ] {
        assert_eq!(codes(text), [Code::MisplacedOpenArray], "{text}");
    }
    let call = |arg: &str| {
        codes(&format!("FUNCTION f : INT VAR_IN_OUT a : ARRAY [*] OF INT; END_VAR f := 1; END_FUNCTION
        FUNCTION g : INT VAR_INPUT a : ARRAY [*] OF INT; END_VAR g := 1; END_FUNCTION
        PROGRAM Main VAR two : ARRAY [0..1, 0..1] OF INT; r : ARRAY [0..1] OF REAL; i : INT; ok : ARRAY [0..1] OF INT; n : DINT; END_VAR
        VAR CONSTANT k : ARRAY [0..1] OF INT := [1, 2]; END_VAR {arg} END_PROGRAM"))
    };
    for (body, code) in [
        ("f(a := two);", Code::TypeMismatch),
        ("f(a := r);", Code::TypeMismatch),
        ("f(a := i);", Code::TypeMismatch),
        ("f(a := k);", Code::AssignToConstant),
        ("g(two);", Code::TypeMismatch),
        ("g(3);", Code::NotAVariable),
        ("f();", Code::MissingInOut),
        ("n := UPPER_BOUND(ok, 2);", Code::IndexOutOfRange),
        ("n := UPPER_BOUND(i, 1);", Code::NotAnArray),
        ("n := UPPER_BOUND(ok);", Code::WrongArgumentCount),
        ("n := UPPER_BOUND(ok, i);", Code::NotConstant),
    ] {
        assert_eq!(call(body).first(), Some(&code), "{body}");
    }
    assert_eq!(call("f(a := ok); i := g(k); n := UPPER_BOUND(ok, 1);"), []);
}

/// Vendor: the address of the first element; a descriptor that a pointer changed is found out.
#[test]
fn pointers_and_open_arrays() {
    let text = |value: &str| {
        format!("FUNCTION_BLOCK B VAR_IN_OUT a : ARRAY [*] OF INT; END_VAR VAR_INPUT n : DINT; END_VAR VAR p : POINTER TO INT; END_VAR p := ADR(a); p[1] := 9; a[LOWER_BOUND(a, 1)] := 1; END_FUNCTION_BLOCK
        FUNCTION Poke : DINT VAR_INPUT p : POINTER TO DWORD; END_VAR p := p + 4; IF {value} <> 0 THEN p^ := {value}; END_IF; Poke := 1; END_FUNCTION
        PROGRAM Main VAR b : B; a : ARRAY [1..3] OF INT; END_VAR b(a := a, n := Poke(ADR(b))); END_PROGRAM")
    };
    let mut plc = Plc::new_in(Profile::Codesys, &text("0"));
    plc.scans(1);
    assert_eq!(plc.get("Main.a"), "[1, 9, 0]");
    for value in ["16#FFFFFFFF", "64", "16", "p", "p + 4", "p + 100", "16#100000"] {
        let trap = Plc::new_in(Profile::Codesys, &text(value)).scan(0).err().map(|f| f.trap);
        assert!(matches!(trap, None | Some(Trap::WildPointer | Trap::Index)), "{value}: {trap:?}");
    }
    assert!(compile_in(Profile::Codesys, &text("0")).image.is_some());
}
