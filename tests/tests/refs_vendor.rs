//! Pointers and references of the CODESYS profiles (language reference §2.10, §12), in the style of OSCAT, on both engines.

use takt_base::{Code, Profile};
use takt_image::Trap;
use takt_tests::plc::{Plc, check_profile, errors};

const V2: Profile = Profile::Codesys2;
const V3: Profile = Profile::Codesys;

fn run(profile: Profile, text: &str, expected: &[(&str, &str)]) {
    check_profile(profile, text, 1, expected);
}

fn trap(body: &str) -> Option<Trap> {
    let text = format!(
        "FUNCTION_BLOCK F VAR_IN_OUT x : DINT; END_VAR VAR n : INT; END_VAR x := x + 1; END_FUNCTION_BLOCK
        PROGRAM Main VAR p, q : POINTER TO DWORD; b : POINTER TO BYTE; a : ARRAY [0..9] OF BYTE; d : DWORD; x : DINT; f : F;
        in AT %IW0 : WORD; out AT %QW0 : WORD; big : POINTER TO ARRAY [0..1000000] OF BYTE; n : DINT; t : POINTER TO STRING; s : STRING;
        END_VAR {body} END_PROGRAM"
    );
    Plc::new_in(V2, &text).scan(0).err().map(|f| f.trap)
}

/// §12: bits of a REAL through a pointer to DWORD, in a function whose argument is pointed to.
#[test]
fn the_bits_of_a_real() {
    run(
        V2,
        "FUNCTION REAL_BITS : DWORD VAR_INPUT x : REAL; END_VAR VAR pt : POINTER TO DWORD; temp : DWORD; END_VAR
            pt := ADR(x); temp := pt^; REAL_BITS := temp;
        END_FUNCTION
        FUNCTION BITS_REAL : REAL VAR_INPUT x : DWORD; END_VAR VAR pt : POINTER TO REAL; END_VAR
            pt := ADR(x); BITS_REAL := pt^;
        END_FUNCTION
        FUNCTION Half : REAL VAR_INPUT x : REAL; END_VAR VAR pt : POINTER TO DWORD; END_VAR
            Half := x; pt := ADR(Half); pt^ := pt^ - 16#00800000;
        END_FUNCTION
        PROGRAM Main VAR d : DWORD; r, h : REAL; END_VAR d := REAL_BITS(1.5); r := BITS_REAL(16#40490FDB); h := Half(3.0); END_PROGRAM",
        &[("Main.d", "1069547520"), ("Main.r", "3.1415927"), ("Main.h", "1.5")],
    );
}

/// Strings through pointers to BYTE and to arrays of bytes, stepped byte by byte.
#[test]
fn strings_as_bytes() {
    run(
        V2,
        "FUNCTION UPPER : STRING(20) VAR_INPUT str : STRING(20); END_VAR VAR pt : POINTER TO BYTE; l, i : INT; END_VAR
            pt := ADR(str); l := LEN(str);
            FOR i := 1 TO l DO
                IF pt^ > 96 AND pt^ < 123 THEN pt^ := pt^ AND 16#DF; END_IF;
                pt := pt + 1;
            END_FOR;
            UPPER := str;
        END_FUNCTION
        FUNCTION COUNT : INT VAR_INPUT str : STRING(20); c : BYTE; END_VAR VAR pt : POINTER TO ARRAY [0..20] OF BYTE; i : INT; END_VAR
            pt := ADR(str);
            WHILE pt^[i] <> 0 DO IF pt^[i] = c THEN COUNT := COUNT + 1; END_IF; i := i + 1; END_WHILE;
        END_FUNCTION
        FUNCTION STARS : STRING(20) VAR_INPUT n : INT; END_VAR VAR pt : POINTER TO BYTE; i : INT; END_VAR
            pt := ADR(STARS);
            FOR i := 1 TO n DO pt^ := 42; pt := pt + 1; END_FOR;
            pt^ := 0;
        END_FUNCTION
        PROGRAM Main VAR s, t : STRING(20) := 'Hello, World'; n : INT; b : BYTE; END_VAR
            s := UPPER(s); n := COUNT(t, 16#6C); t := CONCAT(STARS(3), t); b := UPPER('a') = 'A';
        END_PROGRAM"
            .replace("b : BYTE", "b : BOOL")
            .replace("c : BOOL; END_VAR VAR pt", "c : BYTE; END_VAR VAR pt")
            .as_str(),
        &[("Main.s", "'HELLO, WORLD'"), ("Main.n", "3"), ("Main.t", "'***Hello, World'"), ("Main.b", "TRUE")],
    );
}

/// An array of the caller by its address and size.
#[test]
fn arrays_by_address_and_size() {
    run(
        V2,
        "FUNCTION ARRAY_SUM : REAL VAR_INPUT pt : POINTER TO ARRAY [0..32000] OF REAL; size : UINT; END_VAR VAR i, stop : UINT; END_VAR
            stop := size / SIZEOF(pt) - 1;
            FOR i := 0 TO stop DO ARRAY_SUM := ARRAY_SUM + pt^[i]; END_FOR;
        END_FUNCTION
        FUNCTION ARRAY_INIT : BOOL VAR_INPUT pt : POINTER TO ARRAY [0..32000] OF REAL; size : UINT; init : REAL; END_VAR VAR i : UINT; END_VAR
            FOR i := 0 TO size / 4 - 1 DO pt^[i] := init; END_FOR;
            ARRAY_INIT := TRUE;
        END_FUNCTION
        FUNCTION Local : REAL VAR a : ARRAY [1..4] OF REAL; END_VAR ARRAY_INIT(ADR(a), SIZEOF(a), 2.5); Local := ARRAY_SUM(ADR(a), SIZEOF(a)); END_FUNCTION
        PROGRAM Main VAR a : ARRAY [0..9] OF REAL; sum, l : REAL; ok : BOOL; END_VAR
            ok := ARRAY_INIT(ADR(a), SIZEOF(a), 1.5); a[3] := 10.0; sum := ARRAY_SUM(ADR(a), SIZEOF(a)); l := Local();
        END_PROGRAM",
        &[("Main.sum", "23.5"), ("Main.ok", "TRUE"), ("Main.l", "10.0")],
    );
}

#[test]
fn arithmetic_and_comparison() {
    run(
        V3,
        "TYPE P : STRUCT x, y : INT; END_STRUCT END_TYPE
        PROGRAM Main VAR a : ARRAY [0..9] OF DINT; ps : ARRAY [0..3] OF P; p, q : POINTER TO DINT; pp : POINTER TO P; d : DWORD; i : INT := 2;
            n1, n2, n3, n4, n5 : DINT; c : ARRAY [0..7] OF BOOL; ud : UDINT; pb : POINTER TO BYTE; ptr : POINTER TO POINTER TO DINT; END_VAR
            FOR i := 0 TO 9 DO a[i] := i * 10; END_FOR; i := 2;
            p := ADR(a); q := p + SIZEOF(DINT); n1 := q^; n2 := p[3]; q := 8 + p; n3 := q^; p := p + 4 * i; n4 := p[-1];
            n5 := p - ADR(a[0]);
            pp := ADR(ps); pp[i].y := 7; pp^.x := 1; pp := pp + SIZEOF(P); pp^.x := (pp - 4)^.x + 1; pp := pp - SIZEOF(P);
            c[0] := p = q; c[1] := p <> NULL; c[2] := q = 0; c[3] := p > ADR(a); c[4] := q < p; c[5] := 0 <> q;
            d := ADR(a); p := d; c[6] := p^ = 0; ud := p; p := ud + 4; c[7] := p^ = 10;
            p := 0; pb := ADR(a[1]); pb^ := 11; p := pb; ptr := ADR(p); ptr^^ := ptr^^ + 1;
        END_PROGRAM",
        &[
            ("Main.n1", "10"), ("Main.n2", "30"), ("Main.n3", "20"), ("Main.n4", "10"), ("Main.n5", "8"),
            ("Main.ps[2].y", "7"), ("Main.ps[0].x", "1"), ("Main.ps[1].x", "2"),
            ("Main.c", "[TRUE, TRUE, FALSE, TRUE, FALSE, TRUE, TRUE, TRUE]"), ("Main.a[1]", "12"),
        ],
    );
}

#[test]
fn sizes() {
    run(
        V2,
        "TYPE S : STRUCT a : BYTE; b : DINT; END_STRUCT END_TYPE
        PROGRAM Main VAR p : POINTER TO REAL; s : STRING(9); w : ARRAY [1..3, 0..1] OF S; n : ARRAY [0..7] OF INT; END_VAR
            n[0] := SIZEOF(p); n[1] := SIZEOF(s); n[2] := SIZEOF(S); n[3] := SIZEOF(w); n[4] := SIZEOF(INT); n[5] := SIZEOF(w[1, 0].b);
            n[6] := SIZEOF(p^); n[7] := SIZEOF(TON);
        END_PROGRAM",
        &[("Main.n[0]", "4"), ("Main.n[1]", "10"), ("Main.n[3]", "48"), ("Main.n[4]", "2"), ("Main.n[5]", "4"), ("Main.n[6]", "4")],
    );
}

#[test]
fn blocks_through_pointers() {
    run(
        V3,
        "FUNCTION_BLOCK Acc VAR_INPUT d : INT; END_VAR VAR_OUTPUT q : INT; END_VAR q := q + d; END_FUNCTION_BLOCK
        FUNCTION_BLOCK User VAR_INPUT p : POINTER TO Acc; END_VAR VAR_OUTPUT q : INT; END_VAR
            IF p <> 0 THEN p^(d := 2); p^.d := 5; p^(); q := p^.q; END_IF;
        END_FUNCTION_BLOCK
        PROGRAM Main VAR a : ARRAY [0..2] OF Acc; u : User; i : INT; p : POINTER TO Acc; END_VAR
            u(p := ADR(a[1])); p := ADR(a); p[2](d := 9);
        END_PROGRAM",
        &[("Main.u.q", "7"), ("Main.a[2].q", "9")],
    );
}

#[test]
fn references_stand_for_what_they_are_bound_to() {
    run(
        V3,
        "TYPE P : STRUCT x, y : INT; END_STRUCT END_TYPE
        VAR_GLOBAL g : INT := 4; END_VAR
        FUNCTION_BLOCK Acc VAR_INPUT d : INT; r : REFERENCE TO INT; END_VAR VAR_OUTPUT q : INT; END_VAR q := q + d; IF __ISVALIDREF(r) THEN r := q; END_IF; END_FUNCTION_BLOCK
        FUNCTION Twice : INT VAR_INPUT v : REFERENCE TO INT; END_VAR v := v * 2; Twice := v; END_FUNCTION
        PROGRAM Main VAR a, b : INT; r : REFERENCE TO INT; p : P; rp : REFERENCE TO P; arr : ARRAY [0..3] OF INT; ra : REFERENCE TO ARRAY [0..3] OF INT;
            ok : ARRAY [0..2] OF BOOL; f : Acc; rf : REFERENCE TO Acc; rg : REFERENCE TO INT REF= g; n : INT; t : INT; END_VAR
            ok[0] := __ISVALIDREF(r);
            r REF= a; ok[1] := __ISVALIDREF(r); r := 5; b := r + 1; rp REF= p; rp.x := 7; rp.y := rp.x * 2; ra REF= arr; ra[2] := b;
            rf REF= f; rf(d := 3, r := t); rf(); n := rf.q; rg := rg + 1; Twice(b); r REF= b; r := r + 1; r REF= 0; ok[2] := __ISVALIDREF(r);
        END_PROGRAM"
            .replace("r REF= 0", "r REF= NULL")
            .as_str(),
        &[
            ("Main.a", "5"), ("Main.b", "13"), ("Main.p", "(x := 7, y := 14)"), ("Main.arr[2]", "6"), ("Main.n", "6"), ("Main.t", "6"),
            ("g", "5"), ("Main.ok", "[FALSE, TRUE, FALSE]"),
        ],
    );
}

/// What pointers reach: variables and %Q to write, %I too to read; nothing else.
#[test]
fn wild_pointers_trap_before_memory_is_touched() {
    for (body, expected) in [
        ("p := 8; d := p^;", Some(Trap::WildPointer)),
        ("p := 32; p^ := 16#FFFFFFFF;", Some(Trap::WildPointer)),
        ("p := 16#FFFFFFFF; d := p^;", Some(Trap::WildPointer)),
        ("p := 16#7FFFFFF0; p^ := 1;", Some(Trap::WildPointer)),
        ("d := p^;", Some(Trap::NullReference)),
        ("p^ := d;", Some(Trap::NullReference)),
        ("b := ADR(in); d := b^;", None),
        ("b := ADR(in); b^ := 1;", Some(Trap::WildPointer)),
        ("b := ADR(out); b^ := 1;", None),
        ("big := ADR(a); n := 500000; d := big^[n];", Some(Trap::WildPointer)),
        ("big := ADR(a); n := 500000; big^[n] := 3;", Some(Trap::WildPointer)),
        ("big := ADR(a); n := 9; big^[n] := 3;", None),
        ("b := ADR(f); p := b; p^ := 8; b := ADR(a); f(x := x);", None),
        ("t := 1; s := t^;", Some(Trap::WildPointer)),
        ("t := 20; t^ := s;", Some(Trap::WildPointer)),
        ("t := ADR(s); t^ := 'x'; t^ := CONCAT(t^, 'y');", None),
    ] {
        assert_eq!(trap(body), expected, "{body}");
    }
}

/// A pointer may change where a VAR_IN_OUT of an instance leads; its body then traps.
#[test]
fn a_changed_in_out_traps() {
    let text = |value: &str| {
        format!(
            "FUNCTION_BLOCK Inner VAR_IN_OUT x : DINT; END_VAR VAR_INPUT a : DINT; END_VAR x := a; END_FUNCTION_BLOCK
            FUNCTION Poke : DINT VAR_INPUT p : POINTER TO DWORD; END_VAR p := p + 4; p^ := {value}; Poke := 9; END_FUNCTION
            PROGRAM Main VAR i : Inner; x, y : DINT; END_VAR i(x := x, a := Poke(ADR(i))); END_PROGRAM"
        )
    };
    for value in ["12", "63", "16#FFFFFFF0", "16#7FFFFFFF"] {
        assert_eq!(Plc::new_in(V2, &text(value)).scan(0).err().map(|f| f.trap), Some(Trap::WildPointer), "{value}");
    }
    let mut plc = Plc::new_in(V2, &text("p + 8"));
    plc.scans(1);
    assert_eq!([plc.get("Main.x"), plc.get("Main.y")], ["0", "9"]);
}

#[test]
fn what_pointers_do_not_do() {
    let program = |body: &str| {
        format!(
            "PROGRAM Main VAR p : POINTER TO INT; q : POINTER TO DINT; r : REF_TO INT; x : INT; d : DINT; b : BOOL; f : REAL; s : STRING; w : WORD; END_VAR {body} END_PROGRAM"
        )
    };
    for (body, code) in [
        ("p := f;", Code::TypeMismatch),
        ("b := p;", Code::TypeMismatch),
        ("x := p;", Code::TypeMismatch),
        ("p := p + f;", Code::NoCommonType),
        ("p := ADR(w.3);", Code::NotReferable),
        ("p := ADR(7);", Code::NotAVariable),
        ("r := ADR(d);", Code::TypeMismatch),
        ("r REF= d;", Code::TypeMismatch),
        ("x := x^;", Code::NotAReference),
        ("x REF= d;", Code::NotAReference),
        ("p := ADR(x, d);", Code::WrongArgumentCount),
        ("x := SIZEOF(nothing);", Code::UnknownName),
    ] {
        assert_eq!(errors(V3, &program(body)).first(), Some(&code), "{body}");
    }
    assert!(errors(Profile::Std, &program("")).contains(&Code::VendorForm));
    let own = "FUNCTION F : INT VAR_INPUT n : INT; END_VAR VAR x : INT; p : POINTER TO INT; END_VAR p := ADR(x); IF n > 0 THEN F := F(n - 1); END_IF; END_FUNCTION
        PROGRAM Main F(3); END_PROGRAM";
    assert_eq!(errors(V3, own), [Code::NotReferable]);
}
