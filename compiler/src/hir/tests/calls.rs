//! Calls of functions and blocks (language reference §4.7).

use super::*;

#[test]
fn functions() {
    accept(
        stmt,
        &[
            "i := F(1, 2);",
            "i := F(a := 1, b := 2);",
            "i := F(b := 2, a := 1);",
            "i := F(a := 1);",
            "i := F();",
            "i := F(b := 2);",
            "F(1, 2);",
            "Pr(1);",
            "Pr(a := i);",
            "b1 := G(a := 1, io := d);",
            "b1 := G(a := i, io := d, o => j, q => b2);",
            "b1 := G(a := 1, io := d, NOT q => b2);",
            "b1 := G(1.5, i, b2, d);",
            "i := F(a := , b := 3);",
            "G(a := 1, io := d, o => );",
            "i := F(F(1, 2), F(a := 3));",
            "vDINT := F(1, 2);",
            "G(a := 1, io := d, o => vDINT);",
        ],
    );
    expect(
        stmt,
        &[
            ("i := F(1);", "P2013 4:6"),
            ("i := F(1, 2, 3);", "P2013 4:14"),
            ("i := F(c := 1);", "P1006 4:8"),
            ("i := F(a := 1, a := 2);", "P2013 4:21"),
            ("i := F(a := r);", "P2007 4:13"),
            ("i := F(a := 40000);", "P2004 4:13"),
            ("i := F(a => j);", "P1006 4:8"),
            ("b1 := G(a := 1, io := d, o := i);", "P1006 4:26"),
            ("b1 := G(a := 1);", "P3007 4:7"),
            ("b1 := G(a := 1, io := i);", "P2001 4:23"),
            ("b1 := G(a := 1, io := 5);", "P2014 4:23"),
            ("b1 := G(a := 1, io := d + 1);", "P2014 4:23"),
            ("b1 := G(a := 1, io := d, o => vSINT);", "P2007 4:31"),
            ("b1 := G(a := 1, io := d, NOT o => i);", "P2003 4:35"),
            ("i := Pr(1);", "P2012 4:6"),
            ("i := F(EN := i, a := 1);", "P2006 4:14"),
            ("i := nofun(1);", "P1003 4:6"),
            ("r := F(1, 2) + s;", "P2002 4:6"),
        ],
    );
}

#[test]
fn blocks() {
    accept(
        stmt,
        &[
            "fs(i := 3);",
            "fs();",
            "fs(i := 3, o => j);",
            "fs(3);",
            "fs(3, j);",
            "fbs[i](i := 3);",
            "fbs[1](i := 3, o => a[2]);",
            "ton1(IN := b1, PT := T#1s);",
            "ton1(IN := b1, PT := T#1s, Q => b2, ET => t);",
            "fb(i := 1, io := d, e := b1, NOT q => b2);",
            "fs(o => vDINT);",
            "i := fs.o; fs.i := 3; fs();",
        ],
    );
    expect(
        stmt,
        &[
            ("fb(i := 1);", "P3007 4:1"),
            ("fb(io := i);", "P2001 4:10"),
            ("fb(io := vWORD.3);", "P2014 4:10"),
            ("fs(x := 1);", "P1006 4:4"),
            ("fs(i := r);", "P2007 4:9"),
            ("fs(o => vSINT);", "P2007 4:9"),
            ("fs(1, 2, 3);", "P2013 4:10"),
            ("S(i := 1);", "P2012 4:1"),
            ("i := fs(i := 1);", "P2012 4:6"),
            ("i(1);", "P2012 4:1"),
            ("i := fs;", "P2001 4:6"),
            ("p1.x(1);", "P2012 4:1"),
            ("p();", "P2012 4:1"),
            ("Light();", "P2012 4:1"),
            ("fs(ENO := b1);", "P1006 4:4"),
        ],
    );
}

#[test]
fn in_outs_bind_variables_of_exactly_their_type() {
    let b = "FUNCTION_BLOCK Q VAR_IN_OUT w : BOOL; c : CHAR; END_VAR END_FUNCTION_BLOCK";
    let vars = "x : BOOL; c : CHAR; w : WORD; s : STRING; fb : Q; p : INT (0..5);";
    assert_eq!(check_in(b, vars, "fb(w := x, c := c);"), "");
    assert_eq!(check_in(b, vars, "fb(w := w.3, c := c);"), "P2014 4:9");
    assert_eq!(check_in(b, vars, "fb(w := x, c := s[1]);"), "P2014 4:17");
    assert_eq!(check_in(b, vars, "fb(w := TRUE, c := c);"), "P2014 4:9");
    assert_eq!(check_in(b, vars, "fb(w := %IX0.0, c := c);"), "P3013 4:9");
    let constant = "FUNCTION_BLOCK Q VAR_IN_OUT w : INT; END_VAR END_FUNCTION_BLOCK VAR_GLOBAL CONSTANT k : INT := 1; END_VAR PROGRAM p VAR f : Q; END_VAR VAR_EXTERNAL CONSTANT k : INT; END_VAR f(w := k); END_PROGRAM";
    assert_eq!(check(constant), "P3001 1:182");
}

#[test]
fn instances_passed_by_reference_can_be_called() {
    let text =
        "FUNCTION_BLOCK W VAR_IN_OUT t : TON; END_VAR VAR_OUTPUT q : BOOL; END_VAR t(IN := TRUE); q := t.Q; END_FUNCTION_BLOCK";
    assert_eq!(check(text), "");
    let input = "FUNCTION_BLOCK W VAR_INPUT t : TON; END_VAR t(IN := TRUE); END_FUNCTION_BLOCK";
    assert_eq!(check(input), "P2012 1:45");
    assert_eq!(check("FUNCTION_BLOCK W VAR_INPUT t : TON; END_VAR VAR b : BOOL; END_VAR b := t.Q; END_FUNCTION_BLOCK"), "");
}

#[test]
fn recursion_is_a_warning() {
    expect(
        check,
        &[
            ("FUNCTION f : INT VAR_INPUT n : INT; END_VAR f := f(n - 1); END_FUNCTION", "P3009 1:50"),
            (
                "FUNCTION f : INT f := g(); END_FUNCTION\nFUNCTION g : INT g := h(); END_FUNCTION\nFUNCTION h : INT h := f(); END_FUNCTION",
                "P3009 1:23, P3009 2:23, P3009 3:23",
            ),
            ("FUNCTION f : INT f := g(); END_FUNCTION FUNCTION g : INT g := 1; END_FUNCTION", ""),
        ],
    );
    assert!(
        !build("FUNCTION f : INT f := f(); END_FUNCTION PROGRAM p END_PROGRAM")
            .diags
            .iter()
            .any(|d| d.severity == takt_base::Severity::Error)
    );
}

#[test]
fn external_units() {
    accept(
        check,
        &[
            "{external} FUNCTION_BLOCK MC_Power VAR_INPUT Enable : BOOL; END_VAR VAR_OUTPUT Status : BOOL; END_VAR END_FUNCTION_BLOCK PROGRAM p VAR m : MC_Power; b : BOOL; END_VAR m(Enable := TRUE, Status => b); END_PROGRAM",
        ],
    );
    assert_eq!(check("{external} FUNCTION f : INT f := 1; END_FUNCTION"), "P0012 1:29");
    assert_eq!(check("TYPE S : STRUCT a : INT; END_STRUCT; END_TYPE {external} FUNCTION f : S END_FUNCTION"), "P0012 1:71");
    assert_eq!(check("{external} FUNCTION f : ARRAY[0..1] OF INT END_FUNCTION"), "P0012 1:25");
    // The name of a native of the library stands for that native alone.
    assert_eq!(check("{external} FUNCTION Sin_Lreal : DINT VAR_INPUT a : DINT; END_VAR END_FUNCTION"), "P1001 1:21");
    let built = build("{external} FUNCTION_BLOCK E END_FUNCTION_BLOCK PROGRAM p VAR e : E; END_VAR e(); END_PROGRAM");
    assert!(built.pou("E").external && built.pou("E").reachable);
}

/// Parameters of a standard function are inputs and need a value.
#[test]
fn standard_arguments_without_a_value() {
    assert_eq!(check_in("", "x : LREAL;", "x := SIN(IN => x);"), "P1006 4:10");
    assert_eq!(check_in("", "x : LREAL;", "x := SIN(IN := );"), "P2013 4:10");
    assert_eq!(check_in("", "x : LREAL;", "IF SIN(IN := ) > 1.0 THEN x := 1.0; END_IF;"), "P2013 4:8");
    assert_eq!(check_in("", "x : LREAL; i : INT;", "x := INT_TO_LREAL(IN => i);"), "P1006 4:19");
}
