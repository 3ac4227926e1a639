//! Implicit conversions: the matrix of all elementary types, subranges, enumerations, strings (language reference §2.3).

use super::*;
use takt_image::Elementary;

/// The list of §2.3, as it stands there. Chains are closed under transitivity by the test, not by the checker.
const CHAINS: &[&[&str]] = &[
    &["SINT", "INT", "DINT", "LINT"],
    &["USINT", "UINT", "UDINT", "ULINT"],
    &["USINT", "INT"],
    &["UINT", "DINT"],
    &["UDINT", "LINT"],
    &["SINT", "REAL", "LREAL"],
    &["INT", "REAL"],
    &["USINT", "REAL"],
    &["UINT", "REAL"],
    &["DINT", "LREAL"],
    &["UDINT", "LREAL"],
    &["BOOL", "BYTE", "WORD", "DWORD", "LWORD"],
    &["TIME", "LTIME"],
    &["DATE", "LDATE"],
    &["TOD", "LTOD"],
    &["DT", "LDT"],
];

fn allowed(from: &str, to: &str) -> bool {
    let steps = || CHAINS.iter().flat_map(|c| c.windows(2)).map(|w| (w[0], w[1]));
    let mut reached = vec![from];
    for i in 0.. {
        let Some(&at) = reached.get(i) else { break };
        let next: Vec<&str> = steps().filter(|s| s.0 == at && !reached.contains(&s.1)).map(|s| s.1).collect();
        reached.extend(next);
    }
    reached.contains(&to)
}

/// §14: accept and reject for all 25 x 25 pairs.
#[test]
fn the_matrix_of_elementary_types() {
    let names: Vec<&str> = Elementary::ALL.iter().map(|e| e.name()).collect();
    assert_eq!(names.len(), 25);
    for from in &names {
        let body: Vec<String> = names.iter().map(|to| format!("v{to} := v{from};")).collect();
        let built = build(&program(TYPES, VARS, &body.join("\n")));
        let lines: Vec<u32> = built.diags.iter().map(|d| built.sources.line_col(d.span.source, d.span.start).line - 4).collect();
        for (i, to) in names.iter().enumerate() {
            let count = lines.iter().filter(|l| **l == i as u32).count();
            assert_eq!(count, usize::from(!allowed(from, to)), "{to} := {from}");
        }
    }
}

#[test]
fn narrowing_has_its_own_code_and_names_the_function() {
    expect(
        stmt,
        &[
            ("vINT := vDINT;", "P2007 4:9"),
            ("vREAL := vLREAL;", "P2007 4:10"),
            ("vBYTE := vWORD;", "P2007 4:10"),
            ("vTIME := vLTIME;", "P2007 4:10"),
            ("vUINT := vINT;", "P2001 4:10"),
            ("vREAL := vDINT;", "P2001 4:10"),
            ("vLREAL := vLINT;", "P2001 4:11"),
            ("vWORD := vINT;", "P2001 4:10"),
            ("vINT := vREAL;", "P2007 4:9"),
        ],
    );
    let text = build(&program(TYPES, VARS, "vINT := vDINT;")).text();
    assert!(text.contains("help: write DINT_TO_INT(vDINT)"), "{text}");
    assert!(text.contains("DINT, INT wanted"), "{text}");
}

#[test]
fn a_subrange_behaves_as_its_base_and_is_checked_when_stored() {
    accept(stmt, &["pct := i;", "i := pct;", "pct := pct;", "vDINT := pct;", "pct := 100;", "pct := vSINT;", "vREAL := pct;"]);
    expect(
        stmt,
        &[
            ("pct := 101;", "P2004 4:8"),
            ("pct := -1;", "P2004 4:8"),
            ("pct := vDINT;", "P2007 4:8"),
            ("vUINT := pct;", "P2001 4:10"),
        ],
    );
}

#[test]
fn enumerations_convert_to_nothing_but_named_values_to_their_base() {
    accept(stmt, &["light := light;", "col := vDWORD;", "vDWORD := col;", "vLWORD := col;", "col := 16#FF;", "col := White;"]);
    expect(
        stmt,
        &[
            ("i := light;", "P2001 4:6"),
            ("light := 1;", "P2001 4:10"),
            ("light := mode;", "P2001 4:10"),
            ("vWORD := col;", "P2001 4:10"),
            ("light := i;", "P2001 4:10"),
        ],
    );
}

#[test]
fn strings_and_characters() {
    accept(
        stmt,
        &[
            "s := s8;",
            "s8 := s;",
            "s := vCHAR;",
            "ws := vWCHAR;",
            "vCHAR := 'x';",
            "vWCHAR := \"x\";",
            "s := 'x';",
            "ws := \"ab\";",
            "s8 := '12345678';",
            "s := '';",
            "vCHAR := CHAR#16#41;",
            "vCHAR := CHAR#'A';",
            "vWCHAR := WCHAR#'A';",
            "s[1] := 'a';",
            "vCHAR := s[3];",
            "s := STRING#'OK';",
        ],
    );
    expect(
        stmt,
        &[
            ("s := ws;", "P2001 4:6"),
            ("ws := s;", "P2001 4:7"),
            ("vCHAR := s;", "P2001 4:10"),
            ("vCHAR := 'xy';", "P2001 4:10"),
            ("vCHAR := '';", "P2001 4:10"),
            ("vWCHAR := vCHAR;", "P2001 4:11"),
            ("s8 := '123456789';", "P2004 4:7"),
            ("s := \"w\";", "P2001 4:6"),
            ("s := 5;", "P2001 4:6"),
            ("vBYTE := vCHAR;", "P2001 4:10"),
        ],
    );
}

#[test]
fn derived_types_are_the_same_or_not() {
    accept(stmt, &["p1 := p2;", "row := rows[1];", "a := a;", "fs := fbs[2];", "ps[1] := p1;"]);
    expect(
        stmt,
        &[("p1 := row;", "P2001 4:7"), ("a := row;", "P2001 4:6"), ("fs := ton1;", "P2001 4:7"), ("p1 := 1;", "P2001 4:7")],
    );
    accept(check, &["PROGRAM p VAR a : ARRAY[1..3] OF INT; b : ARRAY [1..3] OF INT; END_VAR a := b; END_PROGRAM"]);
    let other = "PROGRAM p VAR a : ARRAY[0..2] OF INT; b : ARRAY [1..3] OF INT; END_VAR a := b; END_PROGRAM";
    assert_eq!(check(other), "P2001 1:77");
}

/// §1.5: untyped literals take the type of their context exactly, or not at all.
#[test]
fn untyped_literals() {
    accept(
        stmt,
        &[
            "vSINT := -128;",
            "vSINT := 127;",
            "vULINT := 18446744073709551615;",
            "vLINT := -9223372036854775808;",
            "vREAL := 5;",
            "vLREAL := 1;",
            "vBOOL := 1;",
            "vBOOL := 0;",
            "vWORD := 16#FFFF;",
            "vBYTE := 2#1111_0000;",
            "vINT := 16#7FFF;",
            "vUINT := 16#FFFF;",
            "vREAL := 1.5;",
            "vLREAL := 1.0E300;",
            "vINT := INT#16#7FFF;",
            "vWORD := WORD#1234;",
            "vREAL := REAL#5;",
            "vBOOL := BOOL#1;",
            "vDINT := INT#5;",
            "vLTIME := T#1s;",
            "vTIME := T#-14ms;",
        ],
    );
    expect(
        stmt,
        &[
            ("vSINT := 128;", "P2004 4:10"),
            ("vSINT := -129;", "P2004 4:10"),
            ("vUSINT := -1;", "P2004 4:11"),
            ("vINT := 16#FFFF;", "P2004 4:9"),
            ("vINT := INT#40000;", "P0006 4:9"),
            ("vBYTE := 16#100;", "P2004 4:10"),
            ("vBOOL := 2;", "P2004 4:10"),
            ("vWORD := 5;", "P2001 4:10"),
            ("vINT := 1.0;", "P2001 4:9"),
            ("vREAL := 1.0E39;", "P2004 4:10"),
            ("vINT := DINT#5;", "P2007 4:9"),
            ("vTIME := 5;", "P2001 4:10"),
            ("vTIME := LTIME#1s;", "P2007 4:10"),
            ("vDINT := TRUE;", "P2001 4:10"),
            ("vINT := BYTE#5;", "P2001 4:9"),
        ],
    );
}
