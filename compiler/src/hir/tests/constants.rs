//! Constants: where they are needed, what they may be made of (language reference §3.1).

use super::*;

#[test]
fn constant_expressions() {
    for (value, result) in [
        ("K + 1", "6"),
        ("K * K - 3", "22"),
        ("INT_TO_DINT(K)", "5"),
        ("MAX(K, 9)", "9"),
        ("SHL(WORD#1, K)", "P2001 2:13"),
        ("Red", "P2001 2:13"),
        ("N", "P2005 2:13"),
        ("Arr[1]", "4"),
        ("Arr[2]", "P2009 2:17"),
        ("Rec.y", "8"),
        ("LEN('abc')", "P2005 2:13"),
        ("F(1)", "P2005 2:13"),
        ("SEL(TRUE, 1, 2)", "2"),
        ("REAL_TO_DINT(SQRT(16.0))", "4"),
        ("TIME_TO_DINT(T#2s)", "2000"),
    ] {
        let declarations = "TYPE C : (Red); R : STRUCT x : INT; y : INT; END_STRUCT; END_TYPE VAR_GLOBAL CONSTANT K : INT := 5; Arr : ARRAY [0..1] OF INT := [3, 4]; \
            Rec : R := (y := 8); END_VAR VAR_GLOBAL N : INT; END_VAR FUNCTION F : INT VAR_INPUT a : INT; END_VAR F := a; END_FUNCTION";
        let built = build(&program(declarations, &format!("x : DINT := {value};"), ""));
        let errors: Vec<_> = built.diags.iter().filter(|d| d.code.text() != "P1008").cloned().collect();
        let got = match errors.is_empty() {
            true => show(&built.pou("p").vars.iter().next().expect("x").init),
            false => Built { diags: errors, ..built }.codes(),
        };
        assert_eq!(got, result, "{value}");
    }
}

#[test]
fn local_constants_size_arrays() {
    let text = "PROGRAM p VAR CONSTANT n : INT := 4; m : INT := n * 2; END_VAR VAR a : ARRAY [1..m] OF INT; END_VAR a[8] := 1; a[n] := 2; END_PROGRAM";
    assert_eq!(check(text), "");
    assert_eq!(check(&text.replace("a[8]", "a[9]")), "P2009 1:103");
}

#[test]
fn named_repetitions() {
    let text = "PROGRAM p VAR CONSTANT n : INT := 2; END_VAR VAR a : ARRAY [1..4] OF INT := [n(1, 7)]; b : ARRAY [1..2] OF INT := [n()]; END_VAR END_PROGRAM";
    let built = build(text);
    assert_eq!(built.codes(), "");
    assert_eq!(show(&built.pou("p").vars[VarId(1)].init), "[1, 7, 1, 7]");
    assert_eq!(check(&text.replace("[n()]", "[m()]").replace("END_VAR VAR", "END_VAR VAR m : INT;")), "P2005 1:125");
}

#[test]
fn an_input_with_a_default_is_no_constant() {
    let text =
        "FUNCTION_BLOCK b VAR_INPUT CONSTANT n : INT := 4; END_VAR VAR a : ARRAY [1..n] OF INT; END_VAR END_FUNCTION_BLOCK";
    assert_eq!(check(text), "P2005 1:77");
}

/// Chains of constants are as deep as they like, within the limit of nesting.
#[test]
fn chains_of_constants() {
    let chain = |n: usize| {
        let decls: String = (0..n).map(|i| format!("c{i} : INT := c{};\n", i + 1)).collect();
        check(&format!("VAR_GLOBAL CONSTANT {decls} c{n} : INT := 1; END_VAR"))
    };
    assert_eq!(chain(100), "");
    assert!(chain(5000).starts_with("P0011"));
}
