//! Where the dialects differ (language reference, section 0): the same text, another profile.

use takt_base::{Code, Profile, Severity};
use takt_tests::plc::{Plc, compile_in};

fn codes(profile: Profile, text: &str) -> Vec<(Code, Severity)> {
    compile_in(profile, text).diags.iter().map(|d| (d.code, d.severity)).collect()
}

#[test]
fn s0_inputs_may_be_written_with_a_warning() {
    let text = "FUNCTION f : INT VAR_INPUT a : INT; END_VAR a := a + 1; f := a; END_FUNCTION
        PROGRAM main VAR x : INT := 4; y : INT; END_VAR y := f(x); END_PROGRAM";
    for profile in Profile::ALL {
        let severity = if profile.is_vendor() { Severity::Warning } else { Severity::Error };
        assert_eq!(codes(profile, text), [(Code::AssignToInput, severity)], "{profile:?}");
    }
    let mut plc = Plc::new_in(Profile::Codesys, text);
    plc.scan(0).unwrap();
    assert_eq!((plc.get("main.x"), plc.get("main.y")), ("4".into(), "5".into()));
}

#[test]
fn s0_writing_an_aggregate_input_leaves_the_callers_value_alone() {
    let text = "TYPE A : ARRAY[0..2] OF INT; END_TYPE
        FUNCTION f : INT VAR_INPUT a : A; s : STRING; END_VAR a[1] := 7; s := 'new'; f := a[1]; END_FUNCTION
        PROGRAM main VAR x : A := [1, 2, 3]; t : STRING := 'old'; y : INT; END_VAR y := f(x, t); END_PROGRAM";
    let mut plc = Plc::new_in(Profile::Codesys2, text);
    plc.scan(0).unwrap();
    let got = ["main.x[1]", "main.t", "main.y"].map(|p| plc.get(p));
    assert_eq!(got, ["2", "'old'", "7"]);
}

#[test]
fn s0_default_string_length() {
    let text = "PROGRAM main VAR s : STRING; n : INT; END_VAR
        WHILE LEN(s) = n DO n := n + 1; s := CONCAT(s, 'x'); END_WHILE n := LEN(s); END_PROGRAM";
    for (profile, length) in Profile::ALL.into_iter().zip(["254", "80", "80", "126"]) {
        let mut plc = Plc::new_in(profile, text);
        plc.scan(0).unwrap();
        assert_eq!(plc.get("main.n"), length, "{profile:?}");
    }
}

#[test]
fn s12_nested_comments_end_where_the_profile_says() {
    let nested = "PROGRAM main VAR x : INT; END_VAR x := 1; (* a (* b *) x := 2; (* c *) END_PROGRAM";
    assert!(codes(Profile::Codesys, nested).iter().any(|c| c.0 == Code::UnterminatedComment));
    let mut plc = Plc::new_in(Profile::Codesys2, nested);
    plc.scan(0).unwrap();
    assert_eq!(plc.get("main.x"), "2");
    let marked = format!("(* @NESTEDCOMMENTS := 'Yes' *) {nested}");
    assert!(codes(Profile::Codesys2, &marked).iter().any(|c| c.0 == Code::UnterminatedComment));
}

#[test]
fn s1_2_underscores_are_free_with_the_vendors() {
    let text = "PROGRAM main VAR a__b, c_ : INT; END_VAR a__b := c_; END_PROGRAM";
    for profile in Profile::ALL {
        assert_eq!(codes(profile, text).is_empty(), profile.is_vendor(), "{profile:?}");
    }
}

#[test]
fn s5_1_chains_and_set_and_reset() {
    let text = "FUNCTION next : INT VAR_IN_OUT n : INT; END_VAR n := n + 1; next := n; END_FUNCTION
        PROGRAM main VAR n, a, b : INT; l : LREAL; start, stop, run, lamp : BOOL; END_VAR
        a := b := next(n); l := a := b; run S= start; run R= stop; lamp S= run S= stop; END_PROGRAM";
    let codes = codes(Profile::Std, text);
    assert_eq!(codes.iter().map(|c| c.0).collect::<Vec<_>>(), [Code::VendorForm; 5], "{codes:?}");
    let mut plc = Plc::new_in(Profile::Codesys, text);
    plc.set("main.start", "TRUE");
    plc.scan(0).unwrap();
    assert_eq!(
        ["n", "a", "b", "l", "run", "lamp"].map(|v| plc.get(&format!("main.{v}"))),
        ["1", "1", "1", "1.0", "TRUE", "FALSE"]
    );
    plc.set("main.stop", "TRUE");
    plc.scan(0).unwrap();
    assert_eq!(["n", "a", "run", "lamp"].map(|v| plc.get(&format!("main.{v}"))), ["2", "2", "TRUE", "TRUE"]);
}

#[test]
fn s1_3_words_of_edition_3_are_names_in_older_dialects() {
    let text = "FUNCTION override : INT VAR_INPUT step, on, from : INT; END_VAR override := step + on + from; END_FUNCTION
        PROGRAM main VAR class, ldt, r_edge, this, null : INT; END_VAR
        class := override(step := 1, on := 2, from := 3); ldt := class; r_edge := ldt; this := null; END_PROGRAM";
    for profile in Profile::ALL {
        let codes = codes(profile, text);
        assert_eq!(codes.is_empty(), !profile.reserves_new_words(), "{profile:?}: {codes:?}");
    }
}

#[test]
fn s2_3_bit_strings_and_integers_mix_in_codesys() {
    let text = "PROGRAM main VAR b : BYTE := 16#F0; w : WORD; d : DWORD := 7; i : INT := -1; n : DINT; r : REAL; l : LREAL := 0.5; t : TIME := T#1s500ms;
            x, y, z : BOOL; END_VAR
        w := b + 1; b := 255; b := b + 1; n := i AND 16#FF; d := d * 3 / 2 + i; i := w; w := i; n := NOT i; r := n; r := l + r;
        x := w > 200; IF d THEN y := TRUE; END_IF; z := b = 0; d := t; t := d + 1; END_PROGRAM";
    assert!(codes(Profile::Std, text).len() > 5);
    let warnings = codes(Profile::Codesys, text);
    assert!(warnings.iter().all(|c| *c == (Code::Narrowing, Severity::Warning)), "{warnings:?}");
    let mut plc = Plc::new_in(Profile::Codesys2, text);
    plc.scan(0).unwrap();
    let get = |v: &str| plc.get(&format!("main.{v}"));
    assert_eq!(["b", "w", "i", "n", "x", "y", "z"].map(get), ["0", "241", "241", "-242", "TRUE", "TRUE", "TRUE"]);
    assert_eq!(["r", "d", "t"].map(get), ["-241.5", "1500", "T#1s501ms"]);
}

#[test]
fn s5_4_vendors_compute_in_32_bits() {
    let text = "PROGRAM main VAR a, b : SINT := 100; u : USINT := 3; v : USINT := 5; i : INT; s : SINT; x : BOOL; END_VAR
        i := a + b; s := a + b; x := u - v < 0; v := u - v; i := i * 300 / 300; END_PROGRAM";
    let std = "PROGRAM main VAR a, b : SINT := 100; s : SINT; END_VAR s := a + b; END_PROGRAM";
    let mut plc = Plc::new(std);
    plc.scan(0).unwrap();
    assert_eq!(plc.get("main.s"), "-56");
    for profile in [Profile::Codesys, Profile::Codesys2, Profile::OpenPlc] {
        let codes = codes(profile, text);
        assert!(codes.is_empty(), "{profile:?} {codes:?}");
        let mut plc = Plc::new_in(profile, text);
        plc.scan(0).unwrap();
        assert_eq!(["i", "s", "x", "v"].map(|v| plc.get(&format!("main.{v}"))), ["200", "-56", "TRUE", "254"]);
    }
}

#[test]
fn s1_5_numbers_fill_bits_in_the_vendors_profiles() {
    let text = "PROGRAM main VAR b : BYTE := 200; i : INT := 16#FFFF; r : REAL := 1.; s : SINT; END_VAR s := 16#80; END_PROGRAM";
    assert_eq!(codes(Profile::Std, text).iter().filter(|c| c.1 == Severity::Error).count(), 2);
    for profile in [Profile::Codesys, Profile::Codesys2, Profile::OpenPlc] {
        let mut plc = Plc::new_in(profile, text);
        plc.scan(0).unwrap();
        assert_eq!(["b", "i", "r", "s"].map(|v| plc.get(&format!("main.{v}"))), ["200", "-1", "1.0", "-128"]);
    }
}

#[test]
fn s5_6_for_counts_in_any_place_of_codesys() {
    let text = "TYPE S : STRUCT i : INT; n : INT; END_STRUCT END_TYPE
        PROGRAM main VAR s : S; k : INT; END_VAR
        FOR s.i := 1 TO 3 DO s.n := s.n + s.i; END_FOR FOR k := 1 TO 10 DO k := k + 1; s.n := s.n + 100; END_FOR END_PROGRAM";
    assert!(codes(Profile::Std, text).iter().all(|c| *c == (Code::ForVariable, Severity::Error)));
    assert_eq!(codes(Profile::Codesys, text), [(Code::ForVariable, Severity::Warning)]);
    let mut plc = Plc::new_in(Profile::Codesys, text);
    plc.scan(0).unwrap();
    assert_eq!(["s.i", "s.n", "k"].map(|v| plc.get(&format!("main.{v}"))), ["4", "506", "11"]);
}

#[test]
fn s12_lists_without_brackets_and_the_prelude_of_codesys_2() {
    let text = "TYPE CONSTANTS_MATH : STRUCT PI : REAL := 3.14; FACTS : ARRAY[0..3] OF DINT := 1,1,2,6; N : ARRAY[1..2, 1..3] OF INT := 2(7), 3(0), 5; END_STRUCT END_TYPE
        FUNCTIONBLOCK f VAR a : ARRAY[1..4] OF INT := 1, 2(5), 9; END_VAR VAR_OUTPUT y : DINT; END_VAR y := a[3] + math.FACTS[3]; END_FUNCTION_BLOCK
        PROGRAM main VAR b : f; s : STRING(STRING_LENGTH); r : REAL; n : INT; END_VAR b(); r := MATH.PI; n := MATH.N[2, 3] + MATH.N[1, 2] + LIST_LENGTH; END_PROGRAM";
    let mut plc = Plc::new_in(Profile::Codesys2, text);
    plc.scan(0).unwrap();
    assert_eq!(["b.y", "r", "n"].map(|v| plc.get(&format!("main.{v}"))), ["11", "3.14", "262"]);
    let own = text.replace("PROGRAM main", "VAR_GLOBAL MATH : CONSTANTS_MATH := (PI := 3.0); END_VAR PROGRAM main");
    let mut plc = Plc::new_in(Profile::Codesys2, &own);
    plc.scan(0).unwrap();
    assert_eq!(plc.get("main.r"), "3.0");
    assert!(!codes(Profile::Codesys, text).is_empty());
}

#[test]
fn s12_bit_strings_count_and_take_signs_in_codesys() {
    let text = "PROGRAM main VAR a : ARRAY[0..3] OF INT := [1, 2, 3, 4]; b : BYTE := 2; w : WORD := 1; n : BYTE := 1; i, j : INT; d : DINT; END_VAR
        i := a[b]; w := SHL(w, b + 1); j := -b; d := i * 60000 + -n; END_PROGRAM";
    let mut plc = Plc::new_in(Profile::Codesys2, text);
    plc.scan(0).unwrap();
    assert_eq!(["i", "w", "j", "d"].map(|v| plc.get(&format!("main.{v}"))), ["3", "8", "-2", "179999"]);
}

#[test]
fn s1_1_a_character_of_a_latin_1_file_is_one_byte() {
    let bytes = b"PROGRAM main VAR s : STRING(3) := 'a\xE4\x80'; n : INT; END_VAR n := LEN(s); END_PROGRAM".to_vec();
    let mut plc = Plc::from_bytes(Profile::Codesys2, bytes);
    plc.scan(0).unwrap();
    assert_eq!((plc.get("main.n"), plc.get("main.s")), ("3".into(), "'aä$80'".into()));
}

#[test]
fn s17_a_graphical_body_of_an_export_is_named_and_skipped() {
    let text = "(* @NESTEDCOMMENTS := 'Yes' *)\nFUNCTION_BLOCK pump\nVAR x : INT; END_VAR\n(* @END_DECLARATION := '0' *)\n_FBD_BODY\n_NETWORKS : 1\n_NETWORK\n_COMMENT\n'it's $ broken\n_END_COMMENT\n_EXPRESSION\n_POSITIV\nEND_FUNCTION_BLOCK\nPROGRAM main VAR p : pump; END_VAR p(; END_PROGRAM";
    let c = compile_in(Profile::Codesys2, text);
    let found: Vec<_> = c.diags.iter().map(|d| (d.code, c.sources.line_col(d.span.source, d.span.start).line)).collect();
    assert_eq!(found, [(Code::NotSupportedYet, 5), (Code::Expected, 14)]);
    assert!(c.diags[0].message.contains("FBD"));
}

#[test]
fn s1_4_conditional_compilation() {
    let text = "{define fast}\nPROGRAM main VAR x : INT; END_VAR\n{IF defined(fast)} x := 1; {ELSE} x := := 2; {END_IF}\n{IF NOT defined(fast)} x := 3; {END_IF} END_PROGRAM";
    assert!(codes(Profile::Std, text).iter().any(|c| c.0 == Code::NotSupportedYet));
    let mut plc = Plc::new_in(Profile::Codesys, text);
    plc.scan(0).unwrap();
    assert_eq!(plc.get("main.x"), "1");
    assert_eq!(codes(Profile::Codesys, "{IF defined(a)} PROGRAM p END_PROGRAM"), [(Code::Expected, Severity::Error)]);
}

#[test]
fn s12_a_constant_may_be_declared_behind_its_use_in_a_bound() {
    let text =
        "FUNCTION_BLOCK f VAR a : ARRAY[0..n] OF INT; END_VAR VAR_OUTPUT y : INT; END_VAR VAR CONSTANT n : INT := 3; END_VAR
        a[n] := 7; y := a[3]; END_FUNCTION_BLOCK PROGRAM main VAR b : f; END_VAR b(); END_PROGRAM";
    let mut plc = Plc::new_in(Profile::Codesys2, text);
    plc.scan(0).unwrap();
    assert_eq!(plc.get("main.b.y"), "7");
}

#[test]
fn l2_6_conversions_between_bits_and_numbers() {
    let vars = "d, dr : DWORD; r : REAL; b : BOOL;";
    let body = "d := INT_TO_DWORD(INT#-1); r := DWORD_TO_REAL(16#3F800000); dr := REAL_TO_DWORD(1.0); b := BYTE_TO_BOOL(BYTE#2);";
    let text = format!("PROGRAM main VAR {vars} END_VAR {body} END_PROGRAM");
    for profile in Profile::ALL {
        let mut plc = Plc::new_in(profile, &text);
        plc.scan(0).unwrap();
        let want = match profile {
            Profile::Std => ["65535", "1.0", "1065353216", "FALSE"],
            _ => ["4294967295", "1065353200.0", "1", "TRUE"],
        };
        assert_eq!(["d", "r", "dr", "b"].map(|v| plc.get(&format!("main.{v}"))), want, "{profile:?}");
    }
    let other_width = "PROGRAM main VAR w : WORD := 16#9C40; r : REAL; END_VAR r := WORD_TO_REAL(w); END_PROGRAM";
    assert_eq!(codes(Profile::Std, other_width), [(Code::TypeMismatch, Severity::Error)]);
    let mut plc = Plc::new_in(Profile::Codesys2, other_width);
    plc.scan(0).unwrap();
    assert_eq!(plc.get("main.r"), "40000.0");
}

#[test]
fn s2_11_integers_have_bits_in_codesys() {
    let text = "PROGRAM main VAR i : INT := 5; x : BOOL; END_VAR x := i.2; i.0 := FALSE; i.15 := TRUE; END_PROGRAM";
    assert!(codes(Profile::Std, text).iter().all(|c| c.0 == Code::BadOperand));
    let mut plc = Plc::new_in(Profile::Codesys, text);
    plc.scan(0).unwrap();
    assert_eq!(["x", "i"].map(|v| plc.get(&format!("main.{v}"))), ["TRUE", "-32764"]);
}

#[test]
fn s1_4_inline_c_of_matiec_matters_where_it_is_called() {
    let unit =
        "FUNCTION ticks : DINT VAR_INPUT x : DINT; END_VAR ticks := x; {extern long t; ticks = t;} END_FUNCTION (* a (* b *)";
    let idle = format!("{unit} PROGRAM main VAR n : DINT; END_VAR n := 1; END_PROGRAM");
    assert_eq!(codes(Profile::OpenPlc, &idle), [(Code::NotSupportedYet, Severity::Warning)]);
    let calling = format!("{unit} PROGRAM main VAR n : DINT; END_VAR n := ticks(1); END_PROGRAM");
    assert_eq!(codes(Profile::OpenPlc, &calling), [(Code::NotSupportedYet, Severity::Error)]);
    assert_eq!(codes(Profile::Codesys2, &calling), [(Code::NotSupportedYet, Severity::Error)]);
}
