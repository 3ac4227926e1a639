//! Scopes: variables, enumerators, globals, externals (language reference §2.5, §3.5, §3.10).

use super::*;

#[test]
fn case_does_not_matter() {
    accept(stmt, &["VINT := vint;", "LIGHT := RED;", "I := f(A := 1);", "P1.X := p2.x;"]);
    expect(check, &[("PROGRAM p VAR a, A : INT; END_VAR END_PROGRAM", "P1001 1:18")]);
}

#[test]
fn duplicates() {
    expect(
        check,
        &[
            ("PROGRAM p END_PROGRAM PROGRAM P END_PROGRAM", "P1001 1:31"),
            ("TYPE a : INT; A : REAL; END_TYPE", "P1001 1:15"),
            ("TYPE a : INT; END_TYPE FUNCTION a : INT a := 1; END_FUNCTION", "P1001 1:33"),
            ("VAR_GLOBAL a : INT; a : INT; END_VAR", "P1001 1:21"),
            ("FUNCTION f : INT VAR f : INT; END_VAR f := 1; END_FUNCTION", "P1001 1:22"),
            ("PROGRAM p VAR a : INT; END_VAR VAR_INPUT a : INT; END_VAR END_PROGRAM", "P1001 1:42"),
            ("TYPE s : STRUCT a : INT; a : INT; END_STRUCT; END_TYPE", "P1001 1:26"),
            ("TYPE e : (a, b, a); END_TYPE", "P1001 1:17"),
            ("PROGRAM p VAR x : TON := (PT := T#1s, PT := T#2s); END_VAR END_PROGRAM", "P1001 1:39"),
        ],
    );
}

#[test]
fn unknown_names_have_a_suggestion() {
    let text = build(&program(TYPES, VARS, "i := lihgt;")).text();
    assert!(text.contains("P1003") && text.contains("did you mean `light`?"), "{text}");
    let text = build("PROGRAM p VAR x : BOOLL; END_VAR END_PROGRAM").text();
    assert!(text.contains("P1004") && text.contains("did you mean `BOOL`?"), "{text}");
    let text = build(&program(TYPES, VARS, "r := SIM(r);")).text();
    assert!(text.contains("did you mean `SIN`?"), "{text}");
    let text = build(&program(TYPES, VARS, "r := p1.tg;")).text();
    assert!(text.contains("P1005"), "{text}");
}

#[test]
fn things_that_are_no_values() {
    expect(
        stmt,
        &[
            ("i := F;", "P2014 4:6"),
            ("i := TON;", "P2014 4:6"),
            ("i := Point;", "P2014 4:6"),
            ("i := SIN;", "P2014 4:6"),
            ("F := 1;", "P2014 4:1"),
            ("Red := light;", "P2014 4:1"),
        ],
    );
}

#[test]
fn enumerators() {
    accept(
        stmt,
        &[
            "light := Red;",
            "light := Light#Red;",
            "IF light = Amber THEN ; END_IF;",
            "mode := Mode#Off;",
            "CASE light OF Red: ; Amber, Green: ; END_CASE;",
            "light := SEL(b1, Red, Green);",
            "light := MUX(i, Red, Amber, Green);",
        ],
    );
    let two = "TYPE L1 : (Go, Off); L2 : (Off, Standby); END_TYPE";
    let vars = "a : L1; b : L2; i : INT;";
    let case = |body: &str| check_in(two, vars, body);
    assert_eq!(case("a := Off; b := Off; a := L1.Go; a := L1#Go;"), "");
    assert_eq!(case("a := L1.Standby;"), "P1005 4:9");
    assert_eq!(case("IF a = Off THEN ; END_IF;"), "");
    assert_eq!(case("IF Off = b THEN ; END_IF;"), "");
    assert_eq!(case("i := Off;"), "P1007 4:6");
    assert_eq!(case("a := Standby;"), "P2001 4:6");
    assert_eq!(case("a := L2#Off;"), "P2001 4:6");
    assert_eq!(case("a := L1#Stand;"), "P1005 4:9");
    assert_eq!(case("a := L9#Off;"), "P1004 4:6");
    // A variable of the name wins.
    assert_eq!(check_in(two, "Go : INT; a : L1;", "Go := 5;"), "");
    assert_eq!(check_in(two, "Go : INT; a : L1;", "a := Go;"), "P2001 4:6");
}

#[test]
fn anonymous_enumerations_are_local() {
    assert_eq!(check_in("", "s : (idle, run) := run;", "s := idle; IF s = run THEN ; END_IF;"), "");
    let text =
        "FUNCTION_BLOCK a VAR s : (idle, run); END_VAR END_FUNCTION_BLOCK PROGRAM p VAR i : INT; END_VAR i := idle; END_PROGRAM";
    assert_eq!(check(text), "P1003 1:102");
    assert_eq!(check("VAR_GLOBAL g : (one, two); END_VAR PROGRAM p g := two; END_PROGRAM"), "P1008 1:46");
}

#[test]
fn globals_and_externals() {
    let globals = "VAR_GLOBAL g : INT := 3; END_VAR VAR_GLOBAL CONSTANT k : INT := 5; END_VAR";
    let case = |pou: &str| check(&format!("{globals}\n{pou}"));
    assert_eq!(case("PROGRAM p VAR_EXTERNAL g : INT; END_VAR g := 1; END_PROGRAM"), "");
    assert_eq!(case("PROGRAM p VAR_EXTERNAL CONSTANT k : INT; END_VAR VAR a : ARRAY[0..k] OF INT; END_VAR END_PROGRAM"), "");
    assert_eq!(case("PROGRAM p g := 1; g := 2; END_PROGRAM"), "P1008 2:11");
    assert_eq!(case("PROGRAM p VAR_EXTERNAL g : DINT; END_VAR END_PROGRAM"), "P1009 2:24");
    assert_eq!(case("PROGRAM p VAR_EXTERNAL k : INT; END_VAR END_PROGRAM"), "P1009 2:24");
    assert_eq!(case("PROGRAM p VAR_EXTERNAL CONSTANT g : INT; END_VAR END_PROGRAM"), "P1009 2:33");
    assert_eq!(case("PROGRAM p VAR_EXTERNAL g : INT := 4; END_VAR END_PROGRAM"), "P1009 2:24");
    assert_eq!(case("PROGRAM p VAR_EXTERNAL h : INT; END_VAR h := 1; END_PROGRAM"), "P1009 2:24");
    assert_eq!(case("PROGRAM p VAR_EXTERNAL CONSTANT k : INT; END_VAR k := 1; END_PROGRAM"), "P3001 2:50");
    assert_eq!(case("PROGRAM p VAR g : REAL; END_VAR g := 1.5; END_PROGRAM"), "");
}

#[test]
fn globals_of_generated_declarations_need_no_external() {
    let built = build_with(&["VAR_GLOBAL axis : INT; END_VAR"], "PROGRAM p axis := 1; END_PROGRAM");
    assert_eq!(built.codes(), "");
}

/// §4.1: a user's unit replaces a library's; a function of a standard name is mentioned.
#[test]
fn user_declarations_win() {
    accept(
        check,
        &[
            "FUNCTION_BLOCK TON VAR_INPUT mine : INT; END_VAR END_FUNCTION_BLOCK PROGRAM p VAR t : TON; END_VAR t(mine := 3); END_PROGRAM",
            "TYPE CTU : INT; END_TYPE PROGRAM p VAR c : CTU; END_VAR c := 3; END_PROGRAM",
        ],
    );
    let text = "FUNCTION CONCAT : INT VAR_INPUT a : INT; END_VAR CONCAT := a; END_FUNCTION PROGRAM p VAR i : INT; END_VAR i := CONCAT(3); END_PROGRAM";
    assert_eq!(check(text), "P1001 1:10");
}

#[test]
fn declaration_order_does_not_matter() {
    accept(
        check,
        &[
            "PROGRAM p VAR a : A; END_VAR a.b[N] := 1; END_PROGRAM TYPE A : STRUCT b : B; END_STRUCT; B : ARRAY [0..N] OF INT; END_TYPE VAR_GLOBAL CONSTANT N : INT := M + 1; M : INT := 4; END_VAR"
                .replace("a.b[N]", "a.b[5]")
                .as_str(),
        ],
    );
}
