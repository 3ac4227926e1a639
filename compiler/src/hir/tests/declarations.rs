//! Types, sections and initial values (language reference §2, §3.1 to §3.3).

use super::*;

#[test]
fn types() {
    accept(
        check,
        &[
            "TYPE a : INT; b : a := 5; c : ARRAY [1..3, -1..1] OF b; d : STRING[20]; e : STRING(20); f : WSTRING; g : INT (-5..5) := 2; END_TYPE",
            "TYPE a : STRUCT x : INT := 1; y : ARRAY [0..2] OF REAL := [1.0, 2(2.0)]; z : STRUCT q : BOOL; END_STRUCT; END_STRUCT; END_TYPE",
            "TYPE a : (x, y := 5, z); b : USINT (p := 1, q); c : (u := 1, v) USINT; END_TYPE",
            "TYPE e : DWORD (Red := 16#FF0000, Green := 16#00FF00, Yellow := Red OR Green); END_TYPE",
            "PROGRAM p VAR a : ARRAY [1..2, 1..2, 1..2, 1..2, 1..2, 1..2, 1..2, 1..2] OF BOOL; END_VAR END_PROGRAM",
            "PROGRAM p VAR a : ARRAY [0..200000000] OF DINT; END_VAR END_PROGRAM",
            "PROGRAM p VAR a : TIME_OF_DAY; b : DATE_AND_TIME; c : LTIME_OF_DAY; END_VAR END_PROGRAM",
            "TYPE s : STRUCT t : TON; END_STRUCT; END_TYPE PROGRAM p VAR x : s; y : ARRAY [1..3] OF TON; END_VAR x.t(); y[2](); END_PROGRAM",
        ],
    );
    expect(
        check,
        &[
            ("PROGRAM p VAR a : NOPE; END_VAR END_PROGRAM", "P1004 1:19"),
            ("FUNCTION f : INT f := 1; END_FUNCTION PROGRAM p VAR a : f; END_VAR END_PROGRAM", "P1004 1:57"),
            ("PROGRAM q END_PROGRAM PROGRAM p VAR a : q; END_VAR END_PROGRAM", "P1004 1:41"),
            ("PROGRAM p VAR a : ARRAY [3..1] OF INT; END_VAR END_PROGRAM", "P2004 1:26"),
            ("PROGRAM p VAR n : INT; a : ARRAY [0..n] OF INT; END_VAR END_PROGRAM", "P2005 1:38"),
            ("PROGRAM p VAR a : ARRAY [0..1.5] OF INT; END_VAR END_PROGRAM", "P2001 1:29"),
            ("PROGRAM p VAR a : ARRAY [0..3000000000] OF BOOL; END_VAR END_PROGRAM", "P2004 1:29"),
            ("PROGRAM p VAR a : ARRAY [0..2000000000] OF BOOL; END_VAR END_PROGRAM", "P2016 1:19"),
            ("PROGRAM p VAR a : ARRAY [-2147483648..2147483647] OF BOOL; END_VAR END_PROGRAM", "P2016 1:26"),
            ("PROGRAM p VAR a : ARRAY [1..60000, 1..60000] OF BOOL; END_VAR END_PROGRAM", "P2016 1:19"),
            (
                "PROGRAM p VAR a : ARRAY [1..2, 1..2, 1..2, 1..2, 1..2, 1..2, 1..2, 1..2, 1..2] OF BOOL; END_VAR END_PROGRAM",
                "P2016 1:19",
            ),
            ("PROGRAM p VAR a : STRING[0]; END_VAR END_PROGRAM", "P2004 1:26"),
            ("PROGRAM p VAR a : STRING[32768]; END_VAR END_PROGRAM", "P2004 1:26"),
            ("PROGRAM p VAR a : INT (5..1); END_VAR END_PROGRAM", "P2004 1:19"),
            ("PROGRAM p VAR a : INT (0..40000); END_VAR END_PROGRAM", "P2004 1:27"),
            ("PROGRAM p VAR a : REAL (0..4); END_VAR END_PROGRAM", "P2003 1:19"),
            ("TYPE e : REAL (a, b); END_TYPE", "P2003 1:10"),
            ("TYPE e : USINT (a := 255, b); END_TYPE", "P2004 1:27"),
            ("TYPE e : (a := 40000); END_TYPE", "P2004 1:16"),
        ],
    );
}

#[test]
fn recursive_types() {
    expect(
        check,
        &[
            ("TYPE a : STRUCT x : a; END_STRUCT; END_TYPE", "P2015 1:21"),
            ("TYPE a : ARRAY [0..1] OF a; END_TYPE", "P2015 1:26"),
            ("TYPE a : a; END_TYPE", "P2015 1:10"),
            ("TYPE a : STRUCT x : b; END_STRUCT; b : ARRAY [0..1] OF a; END_TYPE", "P2015 1:56"),
            ("FUNCTION_BLOCK a VAR x : a; END_VAR END_FUNCTION_BLOCK", "P2015 1:26"),
            (
                "FUNCTION_BLOCK a VAR x : b; END_VAR END_FUNCTION_BLOCK FUNCTION_BLOCK b VAR x : ARRAY [0..3] OF a; END_VAR END_FUNCTION_BLOCK",
                "P2015 1:97",
            ),
            ("VAR_GLOBAL CONSTANT a : INT := b; b : INT := a; END_VAR", "P2005 1:46"),
        ],
    );
}

#[test]
fn sections() {
    expect(
        check,
        &[
            ("PROGRAM p VAR_GLOBAL a : INT; END_VAR END_PROGRAM", "P3008 1:11"),
            ("FUNCTION f VAR t : TON; END_VAR END_FUNCTION", "P3008 1:20"),
            ("FUNCTION_BLOCK f VAR_TEMP t : TON; END_VAR END_FUNCTION_BLOCK", "P3008 1:31"),
            ("FUNCTION f VAR t : ARRAY [0..1] OF TON; END_VAR END_FUNCTION", "P3008 1:20"),
            ("FUNCTION f : TON END_FUNCTION", "P3012 1:10, P3008 1:14"),
            ("FUNCTION f VAR RETAIN x : INT; END_VAR END_FUNCTION", "P3008 1:12"),
            ("FUNCTION_BLOCK f VAR_IN_OUT RETAIN x : INT; END_VAR END_FUNCTION_BLOCK", "P3008 1:18"),
            ("PROGRAM p VAR RETAIN x : INT; END_VAR END_PROGRAM", ""),
            ("VAR_GLOBAL RETAIN x : INT; END_VAR", ""),
            ("PROGRAM p VAR NON_RETAIN x : INT; END_VAR END_PROGRAM", ""),
            ("PROGRAM p VAR CONSTANT t : TON; END_VAR END_PROGRAM", "P3008 1:28"),
            ("VAR_GLOBAL CONSTANT t : TON; END_VAR", "P3008 1:21"),
            ("FUNCTION f VAR_INPUT x : BOOL R_EDGE; END_VAR END_FUNCTION", "P3008 1:22"),
            ("PROGRAM p VAR x : BOOL R_EDGE; END_VAR END_PROGRAM", "P3008 1:15"),
            ("FUNCTION_BLOCK f VAR_INPUT x : BOOL R_EDGE; y : BOOL F_EDGE; END_VAR END_FUNCTION_BLOCK", ""),
            ("FUNCTION_BLOCK f VAR_INPUT CONSTANT x : INT := 5; END_VAR VAR y : INT; END_VAR y := x; END_FUNCTION_BLOCK", ""),
            ("FUNCTION_BLOCK f VAR_INPUT EN : BOOL; END_VAR END_FUNCTION_BLOCK", ""),
            ("FUNCTION_BLOCK f VAR_IN_OUT x : INT := 3; END_VAR END_FUNCTION_BLOCK", "P2010 1:40"),
            ("FUNCTION f VAR_OUTPUT t : TON; END_VAR END_FUNCTION", "P3008 1:27"),
        ],
    );
    // The parser takes the edge only behind BOOL; an alias of another type is caught here.
    accept(check, &["FUNCTION f VAR_EXTERNAL g : TON; END_VAR g(); END_FUNCTION VAR_GLOBAL g : TON; END_VAR"]);
}

#[test]
fn initial_values() {
    for (decl, value) in [
        ("INT", "0"),
        ("INT := 5", "5"),
        ("REAL := 5", "5.0"),
        ("REAL := 0.1", "0.10000000149011612"),
        ("STRING[5] := 'abc'", "'abc'"),
        ("INT (3..9)", "3"),
        ("INT (3..9) := 4", "4"),
        ("(a, b, c) := b", "1"),
        ("(a := 5, b)", "5"),
        ("ARRAY [1..3] OF INT := [1, 2, 3]", "[1, 2, 3]"),
        ("ARRAY [1..5] OF INT := [1, 2(7), 2(0)]", "[1, 7, 7, 0, 0]"),
        ("ARRAY [1..4] OF INT := [2(1, 2)]", "[1, 2, 1, 2]"),
        ("ARRAY [1..4] OF INT := [0(1, 2), 4(3)]", "[3, 3, 3, 3]"),
        ("ARRAY [1..3] OF INT := [3()]", "0"),
        ("ARRAY [1..3] OF INT (2..5) := [3, 2()]", "[3, 2, 2]"),
        ("ARRAY [1..2] OF INT (2..5)", "[2, 2]"),
        ("ARRAY [1..2, 1..2] OF INT := [[1, 2], [3, 4]]", "[1, 2, 3, 4]"),
        ("ARRAY [1..2, 1..2] OF INT := [1, 2, 3, 4]", "[1, 2, 3, 4]"),
        ("ARRAY [1..2, 1..2] OF INT := [2([1, 2])]", "[1, 2, 1, 2]"),
        ("ARRAY [1..2] OF ARRAY [1..2] OF INT := [[1, 2], [3, 4]]", "[[1, 2], [3, 4]]"),
        ("ARRAY [0..1] OF REAL := [2(1.5)]", "[1.5, 1.5]"),
        ("Pt := (x := 3)", "[3, 7, 0]"),
        ("Pt", "[0, 7, 0]"),
        ("Pt := (z := 'q', x := -1)", "[-1, 7, 'q']"),
        ("Q := (p := (y := 1))", "[[0, 1, 0], [5, 5]]"),
        ("Q := (a := [2, 3])", "[[0, 7, 0], [2, 3]]"),
        ("ARRAY [1..2] OF Pt := [(x := 1), (y := 2)]", "[[1, 7, 0], [0, 2, 0]]"),
        ("Mine", "4"),
        ("ARRAY [1..2] OF Mine", "[4, 4]"),
        ("T2", "[9, 7, 0]"),
        ("TIME := T#1s", "1000000000"),
        ("BOOL := TRUE", "1"),
        ("WORD := 16#FF", "255"),
    ] {
        let types = "TYPE Pt : STRUCT x : INT; y : INT := 7; z : STRING[3]; END_STRUCT; Q : STRUCT p : Pt; a : ARRAY [1..2] OF INT := [5, 5]; END_STRUCT; \
            Mine : INT := 4; T2 : Pt := (x := 9); END_TYPE";
        assert_eq!(init(types, decl), value, "{decl}");
    }
}

#[test]
fn wrong_initial_values() {
    for (decl, messages) in [
        ("INT := 1.5", "P2001 2:12"),
        ("SINT := 300", "P2004 2:13"),
        ("INT := [1]", "P2010 2:12"),
        ("INT := (a := 1)", "P2010 2:12"),
        ("ARRAY [1..2] OF INT := 5", "P2010 2:28"),
        ("ARRAY [1..2] OF INT := [1, 2, 3]", "P2010 2:35"),
        ("ARRAY [1..3] OF INT := [1, 2]", "P2010 2:28"),
        ("ARRAY [1..3] OF INT := [5(1)]", "P2010 2:29"),
        ("ARRAY [1..3] OF INT := [1, TRUE, 3]", "P2001 2:32"),
        ("Pt := (q := 1)", "P1005 2:12"),
        ("Pt := [1, 2]", "P2010 2:11"),
        ("TON := (Q := 1, PT := T#1s, nope := 3)", "P1005 2:33"),
        ("STRING[3] := 'abcd'", "P2004 2:18"),
        ("INT (0..5) := 6", "P2004 2:19"),
        ("INT := y", "P1003 2:12"),
        ("INT := x", "P1003 2:12"),
        ("ARRAY [1..3] OF INT := [F(1), 2, 3]", "P1003 2:29"),
        ("(a, b) := c", "P1003 2:15"),
    ] {
        assert_eq!(init("TYPE Pt : STRUCT x : INT; END_STRUCT; END_TYPE", decl), messages, "{decl}");
    }
}

/// Nothing here may take memory in proportion to the size of the variables.
#[test]
fn large_defaults_stay_small() {
    for (decl, messages) in [
        ("ARRAY [0..1000000000] OF BOOL", ""),
        ("ARRAY [0..100000000] OF INT (1..2)", "P2016 2:5"),
        ("ARRAY [0..1000000000] OF BOOL := [1000000001(FALSE)]", "P2016 2:39"),
        ("ARRAY [0..1000000000] OF BOOL := [1000000001()]", "P2016 2:39"),
        ("ARRAY [0..9, 0..99999999] OF BOOL := [[], []]", "P2010"),
        ("ARRAY [0..1000000000] OF BOOL := [TRUE]", "P2010 2:38, P2016 2:38"),
    ] {
        let start = std::time::Instant::now();
        let built = build(&program("", &format!("x : {decl};"), ""));
        assert!(built.codes().starts_with(messages), "{decl}: {}", built.codes());
        assert!(start.elapsed() < std::time::Duration::from_secs(5), "{decl}");
    }
    let many: String = (0..200).map(|i| format!("x{i} : ARRAY [0..99999] OF INT (1..2); ")).collect();
    assert!(build(&program("", &many, "")).codes().starts_with("P2016"));
}
