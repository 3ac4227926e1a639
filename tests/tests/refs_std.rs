//! References of the standard (language reference §2.10): REF_TO, REF, `^`, NULL, `?=`, on both engines.

use takt_base::Code;
use takt_image::Trap;
use takt_tests::plc::{Plc, compile_st};

fn run(text: &str) -> Plc {
    let mut plc = Plc::new(text);
    plc.scans(1);
    plc
}

fn trap(text: &str) -> Trap {
    Plc::new(text).scan(0).expect_err("a fault").trap
}

/// Codes of all errors, in order.
fn codes(text: &str) -> Vec<Code> {
    let c = compile_st(text);
    c.diags.iter().filter(|d| d.severity == takt_base::Severity::Error).map(|d| d.code).collect()
}

#[test]
fn a_reference_reads_and_writes_its_variable() {
    let plc = run("VAR_GLOBAL g : INT := 7; END_VAR
        PROGRAM Main VAR r : REF_TO INT; a : INT; same, other, none : BOOL; r2 : REF_TO INT; END_VAR
        VAR_EXTERNAL g : INT; END_VAR
            none := r = NULL;
            r := REF(g); a := r^; r^ := a + 1;
            r2 := r; same := r = r2;
            r2 := REF(a); other := r <> r2 AND r2 <> NULL AND NULL <> r2;
            r2^ := r2^ * 10;
        END_PROGRAM");
    assert_eq!(["g", "a"].map(|v| plc.get(if v == "a" { "Main.a" } else { v })), ["8", "70"]);
    assert_eq!(["none", "same", "other"].map(|v| plc.get(&format!("Main.{v}"))), ["TRUE"; 3]);
}

#[test]
fn every_type_can_be_referred_to() {
    let plc = run("TYPE Pair : STRUCT x : INT; y : ARRAY [1..3] OF INT; END_STRUCT; END_TYPE
        FUNCTION_BLOCK Count VAR_INPUT d : INT; END_VAR VAR_OUTPUT n : INT; END_VAR n := n + d; END_FUNCTION_BLOCK
        PROGRAM Main
        VAR p, q : Pair; rp : REF_TO Pair; a : ARRAY [0..2] OF DINT; ra : REF_TO ARRAY [0..2] OF DINT; re : REF_TO DINT;
            s, t : STRING[10] := 'abc'; rs : REF_TO STRING[10]; c : Count; rc : REF_TO Count; n : INT;
            rr : REF_TO REF_TO Pair; i : INT := 2; list : ARRAY [1..2] OF REF_TO INT; u, v : INT; END_VAR
            rp := REF(p); rp^.x := 5; rp^.y[i] := 6; q := rp^; rp^.y := q.y;
            ra := REF(a); ra^[i] := 9; re := REF(a[1]); re^ := 8;
            rs := REF(s); rs^ := 'hello'; t := rs^;
            rc := REF(c); rc^(d := 3); rc^(d := 4); n := rc^.n;
            rr := REF(rp); rr^^.x := rr^^.x + 1;
            list[1] := REF(u); list[2] := REF(v); list[1]^ := 1; list[i]^ := 2;
        END_PROGRAM");
    let of = |v: &str| plc.get(&format!("Main.{v}"));
    assert_eq!([of("p.x"), of("p.y"), of("q.x")], ["6", "[0, 6, 0]", "5"]);
    assert_eq!([of("a"), of("s"), of("t"), of("n")], ["[0, 8, 9]", "'hello'", "'hello'", "7"]);
    assert_eq!([of("u"), of("v")], ["1", "2"]);
}

/// §2.8: a structure may contain itself through a reference.
#[test]
fn lists_of_structures_that_refer_to_each_other() {
    let plc = run("TYPE Node : STRUCT value : INT; next : REF_TO Node; END_STRUCT;
             A : STRUCT b : REF_TO B; n : INT; END_STRUCT; B : STRUCT a : A; m : INT; END_STRUCT; END_TYPE
        VAR_GLOBAL ring : Node := (value := 3, next := REF(ring)); END_VAR
        PROGRAM Main VAR n1, n2, n3 : Node; here : REF_TO Node; sum : INT; x : A; y : B; END_VAR VAR_EXTERNAL ring : Node; END_VAR
            n1.value := 1; n2.value := 2; n3.value := 4;
            n1.next := REF(n2); n2.next := REF(n3); n3.next := NULL;
            here := REF(n1);
            WHILE here <> NULL DO sum := sum + here^.value; here := here^.next; END_WHILE;
            x.b := REF(y); x.b^.m := 5; y.a.b := x.b; y.a.b^.a.n := 6;
            sum := sum * 10 + ring.next^.next^.value;
        END_PROGRAM");
    assert_eq!(plc.get("Main.sum"), "73");
    assert_eq!([plc.get("Main.y.m"), plc.get("Main.y.a.n")], ["5", "6"]);
}

#[test]
fn blocks_may_refer_to_their_own_kind() {
    let plc =
        run("FUNCTION_BLOCK Cell VAR_INPUT next : REF_TO Cell; END_VAR VAR n : INT; END_VAR VAR_OUTPUT total : INT; END_VAR
            n := n + 1; total := n;
            IF next <> NULL THEN total := total + next^.total; END_IF;
        END_FUNCTION_BLOCK
        PROGRAM Main VAR a, b : Cell; END_VAR b(next := NULL); a(next := REF(b)); a(); END_PROGRAM");
    assert_eq!(plc.get("Main.a.total"), "3");
}

#[test]
fn references_are_passed_and_returned() {
    let plc = run("FUNCTION Larger : REF_TO INT VAR_INPUT a, b : REF_TO INT; END_VAR
            IF a^ > b^ THEN Larger := a; ELSE Larger := b; END_IF;
        END_FUNCTION
        FUNCTION Find : BOOL VAR_IN_OUT x : INT; END_VAR VAR_OUTPUT r : REF_TO INT; END_VAR r := REF(x); Find := TRUE; END_FUNCTION
        FUNCTION Bump : INT VAR_IN_OUT x : INT; END_VAR x := x + 1; Bump := x; END_FUNCTION
        PROGRAM Main VAR x : INT := 3; y : INT := 5; r : REF_TO INT; ok : BOOL; n : INT; END_VAR
            Larger(REF(x), REF(y))^ := 50;
            n := Larger(a := REF(x), b := REF(y))^;
            ok := Find(x := x, r => r); r^ := 30; Bump(r^); n := n + Bump(x := r^);
        END_PROGRAM");
    assert_eq!(["x", "y", "n"].map(|v| plc.get(&format!("Main.{v}"))), ["32", "50", "82"]);
}

#[test]
fn initial_values_refer_to_globals() {
    let plc = run("TYPE S : STRUCT a : INT; b : ARRAY [1..3] OF INT := [3(4)]; END_STRUCT; R : REF_TO INT; END_TYPE
        VAR_GLOBAL r : REF_TO INT := REF(later.b[2]); list : ARRAY [0..1] OF R := [REF(one), NULL]; later : S; one : INT := 1; END_VAR
        PROGRAM Main VAR mine : R := REF(later.a); x, y : INT; none : BOOL; END_VAR
        VAR_EXTERNAL r : REF_TO INT; list : ARRAY [0..1] OF R; END_VAR
            x := r^; r^ := 9; mine^ := 8; y := list[0]^; none := list[1] = NULL;
        END_PROGRAM");
    assert_eq!(["later.b", "later.a", "Main.x", "Main.y", "Main.none"].map(|v| plc.get(v)), ["[4, 9, 4]", "8", "4", "1", "TRUE"]);
}

#[test]
fn an_attempt_of_the_same_type_assigns() {
    let plc = run("PROGRAM Main VAR x : INT; r, s : REF_TO INT; END_VAR r := REF(x); s ?= r; s^ := 4; r ?= NULL; END_PROGRAM");
    assert_eq!(plc.get("Main.x"), "4");
    assert_eq!(plc.get("Main.r"), "NULL");
}

#[test]
fn null_traps_wherever_it_is_used() {
    let program = |body: &str| {
        format!(
            "TYPE S : STRUCT a : ARRAY [0..9] OF INT; r : REF_TO S; END_STRUCT; END_TYPE
            FUNCTION_BLOCK B VAR n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK
            FUNCTION F : INT VAR_IN_OUT x : INT; END_VAR x := 1; END_FUNCTION
            PROGRAM Main VAR r : REF_TO INT; s : REF_TO S; t : S; b : REF_TO B; x : INT; q : REF_TO STRING; u : STRING; END_VAR {body}
            END_PROGRAM"
        )
    };
    for body in [
        "x := r^;",
        "r^ := 1;",
        "x := s^.a[3];",
        "s^.a[x + 9] := 1;",
        "t := s^;",
        "s^ := t;",
        "b^();",
        "F(r^);",
        "u := q^;",
        "q^ := u;",
        "s := s^.r;",
        "r := REF(s^.a[1]);",
        "s := REF(t); s^.r^.a[0] := 1;",
        "FOR x := 1 TO r^ DO ; END_FOR;",
    ] {
        assert_eq!(trap(&program(body)), Trap::NullReference, "{body}");
    }
    // The right side of AND is not looked at if the left decides (§5.4).
    run(&program("IF r <> NULL AND r^ > 3 THEN x := 1; END_IF; IF r = NULL OR r^ > 3 THEN x := 2; END_IF;"));
}

#[test]
fn what_has_no_lasting_place_is_not_referred_to() {
    let program = |decl: &str, body: &str| {
        format!("VAR_GLOBAL CONSTANT k : INT := 1; END_VAR
        FUNCTION Three : INT Three := 3; END_FUNCTION
        PROGRAM Main VAR r : REF_TO INT; w : WORD; rb : REF_TO BOOL; rc : REF_TO CHAR; s : STRING; i : INT; {decl} END_VAR {body} END_PROGRAM")
    };
    for (decl, body, code) in [
        ("", "r := REF(k);", Code::NotReferable),
        ("", "rb := REF(w.3);", Code::NotReferable),
        ("", "rc := REF(s[1]);", Code::NotReferable),
        ("END_VAR VAR_TEMP t : INT;", "r := REF(t);", Code::NotReferable),
        ("in AT %IW3 : INT;", "r := REF(in);", Code::NotReferable),
        ("b AT %QX1.2 : BOOL;", "rb := REF(b);", Code::NotReferable),
        ("", "r := REF(i + 1);", Code::NotAVariable),
        ("", "r := REF(Three());", Code::NotAVariable),
        ("", "r := REF(7);", Code::NotAVariable),
        ("", "i^ := 1;", Code::NotAReference),
        ("", "r := REF(w);", Code::TypeMismatch),
        ("", "r := i;", Code::TypeMismatch),
        ("", "r := 0;", Code::TypeMismatch),
        ("", "i := r;", Code::TypeMismatch),
        ("", "i := NULL;", Code::TypeMismatch),
        ("", "i := r.x;", Code::UnknownMember),
        ("", "r := r + 1;", Code::NoCommonType),
        ("", "IF r < r THEN ; END_IF;", Code::BadOperand),
        ("", "IF r = rb THEN ; END_IF;", Code::NoCommonType),
        ("", "r ?= rb;", Code::TypeMismatch),
        ("", "r := REF();", Code::WrongArgumentCount),
        ("a AT %MD4 : REF_TO INT;", "", Code::ReferenceKept),
        ("END_VAR VAR RETAIN a : REF_TO INT;", "", Code::ReferenceKept),
        ("p : POINTER TO INT;", "", Code::VendorForm),
        ("p : REFERENCE TO INT;", "", Code::VendorForm),
    ] {
        let text = program(decl, body);
        assert_eq!(codes(&text).first(), Some(&code), "{decl} {body}");
    }
    let local = "FUNCTION f : INT VAR_INPUT a : INT; END_VAR VAR x : INT; r : REF_TO INT; END_VAR r := REF(x); r := REF(a); r := REF(f); END_FUNCTION";
    assert_eq!(codes(local), [Code::NotReferable; 3]);
}
