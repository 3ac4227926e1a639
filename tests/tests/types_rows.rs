//! Rows of the tables of types that `iec_types` leaves: every form of enumeration, alias, anonymous type and initial value, on both
//! engines. From: language reference §2.4 to §2.8, §3.6.

use takt_base::{Code, Profile, Severity};
use takt_tests::plc::{Plc, compile_in};

/// Types, variables of the program, its body, and values after one scan.
fn row(profile: Profile, types: &str, vars: &str, body: &str, expected: &[(&str, &str)]) {
    let mut plc = Plc::new_in(profile, &format!("{types} PROGRAM Main VAR {vars} END_VAR {body}; END_PROGRAM"));
    plc.scans(1);
    for (name, value) in expected {
        assert_eq!(plc.get(&format!("Main.{name}")), *value, "{name} of {types} {vars}");
    }
}

fn std(types: &str, vars: &str, body: &str, expected: &[(&str, &str)]) {
    row(Profile::Std, types, vars, body, expected);
}

fn codes(profile: Profile, text: &str, severity: Severity) -> Vec<Code> {
    let c = compile_in(profile, text);
    c.diags
        .iter()
        .filter(|d| d.severity == severity && !d.code.is_advice() && d.code != Code::GlobalWithoutExternal)
        .map(|d| d.code)
        .collect()
}

#[test]
fn aliases_have_their_own_defaults() {
    std(
        "TYPE Freq : REAL := 50.0; Freq2 : Freq; Freq3 : Freq := 60.0; END_TYPE",
        "a : Freq; b : Freq2; c : Freq3; d : REAL;",
        "d := a",
        &[("a", "50.0"), ("b", "50.0"), ("c", "60.0"), ("d", "50.0")],
    );
    std(
        "TYPE T1 : STRUCT a : INT := 1; b : INT := 2; END_STRUCT; T2 : T1 := (a := 5); T3 : T2 := (b := 6); END_TYPE",
        "x : T1; y : T2; z : T3; w : T3 := (a := 9); l : ARRAY[0..1] OF T2;",
        "x := y",
        &[
            ("x", "(a := 5, b := 2)"),
            ("y", "(a := 5, b := 2)"),
            ("z", "(a := 5, b := 6)"),
            ("w", "(a := 9, b := 6)"),
            ("l[1]", "(a := 5, b := 2)"),
        ],
    );
    std(
        "TYPE Fast : TON := (PT := T#7ms); END_TYPE",
        "a : Fast; b : ARRAY[1..2] OF Fast; c : Fast := (PT := T#9ms);",
        "",
        &[("a.PT", "T#7ms"), ("b[2].PT", "T#7ms"), ("c.PT", "T#9ms")],
    );
    std(
        "TYPE Row : ARRAY[1..3] OF INT := [1, 2, 3]; Name : STRING[5] := 'ab'; END_TYPE",
        "r : Row; m : ARRAY[0..1] OF Row; n : Name;",
        "",
        &[("r", "[1, 2, 3]"), ("m[1][3]", "3"), ("n", "'ab'")],
    );
}

#[test]
fn enumerations_of_every_form() {
    let number = "i : INT; j : INT;";
    std(
        "TYPE E : (A, B := 5, C) := C; END_TYPE",
        "e : E; x : BOOL; k : E := A;",
        "x := e = E#C",
        &[("e", "C"), ("x", "TRUE"), ("k", "A")],
    );
    std(
        "TYPE C : DWORD (Red := 16#FF0000, Green := 16#00FF00, White := Red OR Green) := Green; END_TYPE",
        "c : C; d : DWORD; e : DWORD;",
        "d := c; c := White; e := c",
        &[("d", "65280"), ("e", "16776960")],
    );
    row(
        Profile::Codesys,
        "TYPE E : (A := 1, B, C := 10) USINT; END_TYPE",
        number,
        "i := E.B; j := C",
        &[("i", "2"), ("j", "10")],
    );
    std(
        "",
        "s : (idle, run) := run; t : (open, shut); x : BOOL;",
        "x := s = run; t := shut",
        &[("s", "run"), ("t", "shut"), ("x", "TRUE")],
    );
    std(
        "TYPE S : STRUCT m : (low, high) := high; END_STRUCT; END_TYPE",
        "s : S; x : ARRAY[0..1] OF (p, q);",
        "x[1] := q",
        &[("s.m", "high"), ("x[1]", "q"), ("x[0]", "p")],
    );
}

#[test]
fn enumerators_hide_and_clash() {
    let two = "TYPE A : (Red, Blue); B : (Red, Green); END_TYPE ";
    std(two, "a : A := Red; b : B; x : BOOL;", "b := Red; x := a = A#Red AND b = B#Red", &[("x", "TRUE")]);
    std("TYPE A : (Zero, One); END_TYPE", "One : INT := 7; i : INT;", "i := One", &[("i", "7")]);
    let unclear = format!("{two} FUNCTION f : BOOL f := Red = Red; END_FUNCTION");
    assert!(codes(Profile::Std, &unclear, Severity::Error).contains(&Code::AmbiguousEnumerator));
}

#[test]
fn nested_anonymous_structures() {
    row(
        Profile::Codesys,
        "TYPE S : STRUCT p : STRUCT x : INT := 1; y : STRUCT z : INT := 2; END_STRUCT; END_STRUCT; k : INT := 3; END_STRUCT; END_TYPE",
        "s : S; t : S := (p := (x := 10, y := (z := 20))); v : STRUCT a : BOOL := TRUE; b : INT; END_STRUCT; r : INT;",
        "r := t.p.x + t.p.y.z + s.p.y.z + t.k; v.b := 4",
        &[("r", "35"), ("v.a", "TRUE"), ("v.b", "4"), ("s.p.x", "1")],
    );
}

#[test]
fn subranges_start_at_their_lower_bound() {
    std(
        "TYPE Pct : INT (10..50); Q : Pct := 20; S : STRUCT p : Pct; q : Q; END_STRUCT; END_TYPE",
        "p : Pct; q : Q; s : S; u : USINT (3..9); a : ARRAY[0..2] OF Pct := [11];",
        "",
        &[("p", "10"), ("q", "20"), ("s", "(p := 10, q := 20)"), ("u", "3"), ("a", "[11, 10, 10]")],
    );
    for wrong in ["TYPE P : INT (5..1); END_TYPE", "TYPE P : INT (1..5) := 6; END_TYPE", "TYPE P : REAL (1..5); END_TYPE"] {
        assert_eq!(codes(Profile::Std, wrong, Severity::Error).len(), 1, "{wrong}");
    }
}

#[test]
fn initial_values_of_arrays() {
    let rows = [
        ("ARRAY[1..6] OF INT := [1, 2, 2(0), 1(7, 8)]", "[1, 2, 0, 0, 7, 8]"),
        ("ARRAY[1..4] OF INT := [2(7, 8)]", "[7, 8, 7, 8]"),
        ("ARRAY[1..3] OF INT := [3()]", "[0, 0, 0]"),
        ("ARRAY[0..1] OF P := [(x := 4), 1((y := 5))]", "[(x := 4, y := 2), (x := 1, y := 5)]"),
        ("ARRAY[0..1, 0..1] OF INT := [1, 2, 3, 4]", "[[1, 2], [3, 4]]"),
        ("ARRAY[0..1] OF ARRAY[0..1] OF INT := [[1, 2], [3, 4]]", "[[1, 2], [3, 4]]"),
        ("ARRAY[0..1] OF ARRAY[0..1] OF INT := [2([5, 6])]", "[[5, 6], [5, 6]]"),
        ("ARRAY[-1..1] OF STRING[3] := ['a', 2('bc')]", "['a', 'bc', 'bc']"),
    ];
    for (ty, value) in rows {
        std("TYPE P : STRUCT x : INT := 1; y : INT := 2; END_STRUCT; END_TYPE", &format!("a : {ty};"), "", &[("a", value)]);
    }
    row(Profile::Codesys2, "", "a : ARRAY[0..2] OF INT := 1, 2, 3;", "", &[("a", "[1, 2, 3]")]);
    row(
        Profile::Codesys2,
        "TYPE S : STRUCT a : ARRAY[0..3] OF INT := 1, 2(5), 3; END_STRUCT END_TYPE",
        "s : S;",
        "",
        &[("s.a", "[1, 5, 5, 3]")],
    );
}

#[test]
fn too_few_and_too_many_values_are_warnings() {
    for (init, value) in [("[1, 2]", "[1, 2, 0]"), ("[1, 2, 3, 4]", "[1, 2, 3]"), ("[5(9)]", "[9, 9, 9]")] {
        let vars = format!("a : ARRAY[1..3] OF INT := {init};");
        std("", &vars, "", &[("a", value)]);
        let text = format!("PROGRAM Main VAR {vars} END_VAR ; END_PROGRAM");
        assert_eq!(codes(Profile::Std, &text, Severity::Warning), [Code::BadInitializer], "{init}");
    }
}

#[test]
fn the_outermost_initial_value_wins() {
    std(
        "TYPE S : STRUCT a : INT := 1; b : INT := 2; END_STRUCT := (b := 20); T : STRUCT s : S := (a := 10); END_STRUCT; END_TYPE
         FUNCTION_BLOCK B VAR_INPUT s : S; END_VAR VAR t : T := (s := (b := 200)); END_VAR ; END_FUNCTION_BLOCK",
        "x : S; y : T; z : B; w : B := (s := (a := 7));",
        "",
        &[
            ("x", "(a := 1, b := 20)"),
            ("y.s", "(a := 10, b := 20)"),
            ("z.t.s", "(a := 10, b := 200)"),
            ("w.s", "(a := 7, b := 20)"),
        ],
    );
    // Constants of the file, whatever their order, and functions of the library.
    std(
        "VAR_GLOBAL CONSTANT last : INT := first + 2; first : INT := 3; END_VAR",
        "a : ARRAY[first..last] OF INT := [first(last)]; b : INT := MAX(first, 4) * 2; n : INT;",
        "n := a[5]",
        &[("b", "8"), ("n", "5")],
    );
}

#[test]
fn what_contains_itself() {
    for wrong in [
        "TYPE S : STRUCT s : S; END_STRUCT; END_TYPE",
        "TYPE A : STRUCT b : B; END_STRUCT; B : STRUCT a : ARRAY[0..1] OF A; END_STRUCT; END_TYPE",
        "TYPE A : B; B : A; END_TYPE",
    ] {
        assert!(codes(Profile::Std, wrong, Severity::Error).contains(&Code::RecursiveType), "{wrong}");
    }
    std(
        "TYPE N : STRUCT v : INT := 3; next : REF_TO N; END_STRUCT; END_TYPE",
        "n : N; r : INT;",
        "n.next := REF(n); r := n.next^.v",
        &[("r", "3")],
    );
}
