//! Parts of words, relative addresses, OVERLAP, UNION, string units and other forms of types (language reference §2.5 to §2.11), on both
//! engines.

use takt_base::{Code, Profile};
use takt_image::Trap;
use takt_tests::plc::{Plc, check_in, check_profile, errors};

fn run(profile: Profile, text: &str, expected: &[(&str, &str)]) {
    check_profile(profile, text, 1, expected);
}

/// §2.11.
#[test]
fn parts_of_members_elements_and_references() {
    check_in(
        "TYPE S : STRUCT w : WORD; a : ARRAY [0..1] OF DWORD; END_STRUCT; END_TYPE",
        "s : S; r : REF_TO S; rw : REF_TO LWORD; l : LWORD; b : BOOL; y : BYTE; i : INT := 1;",
        "r := REF(s); r^.w.3 := TRUE; r^.a[i].%W1 := 16#1234; s.a[i].%B0 := 16#AB; b := r^.w.3; rw := REF(l); rw^.%D1 := 16#80000001; rw^.0 := TRUE; y := r^.a[1].%B3;",
        &[("s.w", "8"), ("s.a", "[0, 305397931]"), ("l", "9223372041149743105"), ("b", "TRUE"), ("y", "18")],
    );
}

#[test]
fn parts_of_integers() {
    run(
        Profile::Codesys2,
        "VAR_GLOBAL CONSTANT cBit : INT := 3; END_VAR
        PROGRAM Main VAR i : INT; u : UDINT; w : WORD; s : SINT; b, c : BOOL; END_VAR VAR CONSTANT mine : INT := 15; END_VAR
            i.0 := TRUE; i.15 := TRUE; u.31 := i.15; w.cBit := TRUE; w.mine := NOT w.mine; b := w.cBit; s.7 := TRUE; c := s.7 AND NOT s.6;
        END_PROGRAM",
        &[("Main.i", "-32767"), ("Main.u", "2147483648"), ("Main.w", "32776"), ("Main.b", "TRUE"), ("Main.s", "-128"), ("Main.c", "TRUE")],
    );
    let one = |body: &str| errors(Profile::Std, &format!("PROGRAM p VAR i : INT; w : WORD; n : INT; END_VAR {body} END_PROGRAM"));
    assert_eq!(one("i.0 := TRUE;"), [Code::BadOperand]);
    assert_eq!(one("w.16 := TRUE;"), [Code::IndexOutOfRange]);
    assert_eq!(one("w.n := TRUE;"), [Code::UnknownMember]);
}

/// §2.8.
#[test]
fn relative_addresses() {
    check_in(
        "TYPE Frame : STRUCT kind AT %B0 : USINT := 7; len AT %B2 : UINT := 16#0102; hot AT %X1.0 : BOOL := TRUE; full AT %X1.7 : BOOL; v AT %B5 : DINT; END_STRUCT; END_TYPE",
        "f, g : Frame; h : Frame := (v := -2, full := TRUE); b : BOOL; a : ARRAY [0..1] OF Frame;",
        "f.full := TRUE; f.hot := FALSE; f.v := f.len + 1; b := f.full AND NOT f.hot AND g.hot; a[1] := f; a[1].kind := 1;",
        &[
            ("f.hot", "128"),
            ("f.v", "259"),
            ("b", "TRUE"),
            ("g.kind", "7"),
            ("g.len", "258"),
            ("h.v", "-2"),
            ("h.hot", "129"),
            ("h.full", "129"),
            ("a[1].v", "259"),
            ("a[0].kind", "7"),
            ("a[1].kind", "1"),
        ],
    );
}

#[test]
fn overlapping_members() {
    check_in(
        "TYPE R : STRUCT OVERLAP d AT %B0 : DWORD; lo AT %B0 : WORD; hi AT %B2 : WORD; r AT %B0 : REAL; top AT %X3.7 : BOOL; low AT %X0.0 : BOOL; END_STRUCT; END_TYPE",
        "x : R; w, v : WORD; b : BOOL; f : REAL; n : BOOL;",
        "x.r := 1.0; w := x.hi; x.lo := 16#0001; v := x.lo; b := x.low; x.top := TRUE; f := x.r; x.d := 16#40000000; n := NOT x.low; x.d := x.d OR 16#1;",
        &[("w", "16256"), ("v", "1"), ("b", "TRUE"), ("f", "-1.0000001"), ("n", "TRUE"), ("x.lo", "1")],
    );
}

#[test]
fn unions() {
    run(
        Profile::Codesys,
        "TYPE U : UNION r : REAL; d : DWORD; b : ARRAY [0..3] OF BYTE; t : BOOL; p : POINTER TO INT; END_UNION END_TYPE
            V : UNION l : LWORD; s : STRING(7); END_UNION;
        PROGRAM Main VAR u : U; v : V; d : DWORD; t, n : BOOL; s : STRING(7); x : REAL; END_VAR
            u.r := 1.5; d := u.d; u.b[3] := 16#40; x := u.r; u.d := 16#FE; t := u.t; n := NOT u.t; v.l := 16#00434241; s := v.s;
        END_PROGRAM"
            .replace("END_UNION END_TYPE\n            V", "END_UNION\n            V")
            .replace("END_UNION;\n", "END_UNION END_TYPE\n")
            .as_str(),
        &[("Main.d", "1069547520"), ("Main.x", "6.0"), ("Main.t", "TRUE"), ("Main.n", "FALSE"), ("Main.s", "'ABC'")],
    );
    let text = "TYPE U : UNION d : DWORD; p : POINTER TO INT; END_UNION END_TYPE PROGRAM Main VAR u : U; n : INT; END_VAR u.d := 5; n := u.p^; END_PROGRAM";
    assert_eq!(Plc::new_in(Profile::Codesys, text).scan(0).err().map(|f| f.trap), Some(Trap::WildPointer));
    assert_eq!(errors(Profile::Std, "TYPE U : UNION d : DWORD; END_UNION; END_TYPE"), [Code::VendorForm]);
}

#[test]
fn layouts_that_are_wrong() {
    for (members, code) in [
        ("a AT %B0 : UINT; b AT %B1 : BYTE;", Code::BadLayout),
        ("a AT %X0.0 : BOOL; b AT %X0.0 : BOOL;", Code::BadLayout),
        ("a AT %B0 : UINT; b : BYTE;", Code::BadLayout),
        ("a AT %X0.0 : UINT;", Code::BadLayout),
        ("a AT %B0 : BOOL;", Code::BadLayout),
        ("a AT %X0.8 : BOOL;", Code::BadLayout),
        ("a AT %B0 : TON;", Code::BadLayout),
        ("a AT %B0 : BYTE; a AT %B1 : BYTE;", Code::DuplicateName),
        ("a AT %B4000000000 : BYTE;", Code::TypeTooLarge),
    ] {
        assert_eq!(errors(Profile::Std, &format!("TYPE T : STRUCT {members} END_STRUCT; END_TYPE")), [code], "{members}");
    }
    let overlap = "TYPE T : STRUCT OVERLAP a AT %B0 : UINT := 5; END_STRUCT; END_TYPE";
    assert_eq!(errors(Profile::Std, overlap), [Code::BadInitializer]);
    let init = "TYPE T : STRUCT OVERLAP a AT %B0 : UINT; b AT %B0 : UINT; END_STRUCT; END_TYPE PROGRAM p VAR t : T := (a := 1); END_VAR END_PROGRAM";
    assert_eq!(errors(Profile::Std, init), [Code::BadInitializer]);
    assert_eq!(errors(Profile::Std, "PROGRAM p VAR x AT %B2 : BYTE; END_VAR END_PROGRAM"), [Code::BadAddress]);
}

/// §2.9: the vendors index bytes from 0.
#[test]
fn string_units() {
    run(
        Profile::Codesys,
        "PROGRAM Main VAR s : STRING(5) := 'abc'; w : WSTRING(3) := \"xy\"; b, z : BYTE; i : INT := 1; u : WORD; p : POINTER TO STRING(5); END_VAR
            b := s[0]; s[i] := 16#58; z := s[3]; u := w[1]; w[0] := 16#41; s[3] := 33; p := ADR(s); p^[2] := p^[0];
        END_PROGRAM",
        &[("Main.b", "97"), ("Main.s", "'aXa!'"), ("Main.z", "0"), ("Main.u", "121"), ("Main.w", "\"Ay\"")],
    );
    for index in ["-1", "6"] {
        let text = format!("PROGRAM Main VAR s : STRING(5); i : INT := {index}; END_VAR s[i] := 1; END_PROGRAM");
        assert_eq!(Plc::new_in(Profile::Codesys, &text).scan(0).err().map(|f| f.trap), Some(Trap::Index));
    }
}

#[test]
fn bits_and_enumerations_as_bounds() {
    run(
        Profile::Codesys,
        "TYPE Light : (Red, Amber, Green); S : STRUCT a, b : BIT; n : BYTE; END_STRUCT; END_TYPE
        PROGRAM Main VAR n : ARRAY [Light] OF INT; l : Light := Light.Green; s : S; k : INT; m : ARRAY [Light, 1..2] OF INT; END_VAR
            n[Red] := 1; n[l] := 3; s.b := TRUE; k := SIZEOF(S); m[Light.Amber, 2] := 7;
        END_PROGRAM",
        &[("Main.n", "[1, 0, 3]"), ("Main.s.b", "TRUE"), ("Main.k", "3"), ("Main.m", "[[0, 0], [0, 7], [0, 0]]")],
    );
}
