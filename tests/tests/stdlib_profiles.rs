//! Library functions whose result depends on the dialect of the calling file (library reference §2.2, §2.6, §5), on both engines.

use takt_base::{Code, Profile};
use takt_tests::plc::{Plc, compile_in};

/// The value of an expression, computed at run time and folded.
fn value(profile: Profile, ty: &str, from: &str, call: &str, x: &str) -> [String; 2] {
    let name = call.replace('?', "x");
    let folded = call.replace('?', &format!("{from}#{x}"));
    let x = if is_time(from) { format!("{from}#{x}") } else { x.to_owned() };
    let text = format!("PROGRAM p VAR x : {from} := {x}; a, b : {ty}; END_VAR a := {name}; b := {folded}; END_PROGRAM");
    let mut plc = Plc::new_in(profile, &text);
    plc.scan(0).unwrap();
    [plc.get("p.a"), plc.get("p.b")]
}

fn is_time(ty: &str) -> bool {
    ["TIME", "TOD", "DATE", "DT"].contains(&ty)
}

fn row(ty: &str, from: &str, call: &str, x: &str, [std, codesys, openplc]: [&str; 3]) {
    use Profile::{Codesys, Codesys2, OpenPlc, Std};
    for (profile, want) in [(Std, std), (Codesys, codesys), (Codesys2, codesys), (OpenPlc, openplc)] {
        assert_eq!(value(profile, ty, from, call, x), [want, want], "{call} of {x} in {profile:?}");
    }
}

#[test]
fn s2_6_vectors() {
    // The shortest text of the REAL 1065353216.0 is 1065353200.0.
    row("DWORD", "INT", "INT_TO_DWORD(?)", "-1", ["65535", "4294967295", "4294967295"]);
    row("REAL", "DWORD", "DWORD_TO_REAL(?)", "16#3F800000", ["1.0", "1065353200.0", "1065353200.0"]);
    row("DWORD", "REAL", "REAL_TO_DWORD(?)", "1.0", ["1065353216", "1", "1"]);
    row("BOOL", "BYTE", "BYTE_TO_BOOL(?)", "16#2", ["FALSE", "TRUE", "TRUE"]);
    row("BYTE", "USINT", "USINT_TO_BCD_BYTE(?)", "42", ["66", "66", "66"]);
    row("SINT", "BYTE", "BYTE_TO_SINT(?)", "16#FF", ["-1", "-1", "-1"]);
}

#[test]
fn s2_2_rounding() {
    for (x, std, codesys) in [
        ("0.4", "0", "0"),
        ("0.5", "0", "1"),
        ("1.5", "2", "2"),
        ("1.6", "2", "2"),
        ("2.5", "2", "3"),
        ("3.5", "4", "4"),
        ("-0.5", "0", "-1"),
        ("-1.5", "-2", "-2"),
        ("-2.5", "-2", "-3"),
        ("32767.4", "32767", "32767"),
    ] {
        row("INT", "REAL", "REAL_TO_INT(?)", x, [std, codesys, std]);
        row("INT", "LREAL", "TO_INT(?)", x, [std, codesys, std]);
    }
    row("INT", "LREAL", "LREAL_TO_INT(?)", "0.49999999999999994", ["0", "0", "0"]);
    row("INT", "REAL", "TRUNC_INT(?)", "-1.6", ["-1", "-1", "-1"]);
}

#[test]
fn s2_1_reals_and_bits_of_other_width_are_numbers_of_the_vendors() {
    let text = "PROGRAM p VAR x : REAL := 7.0; w : WORD; END_VAR w := REAL_TO_WORD(x); END_PROGRAM";
    let codes: Vec<_> = compile_in(Profile::Std, text).diags.iter().map(|d| d.code).collect();
    assert_eq!(codes, [Code::TypeMismatch]);
    for profile in [Profile::Codesys, Profile::Codesys2, Profile::OpenPlc] {
        let mut plc = Plc::new_in(profile, text);
        plc.scan(0).unwrap();
        assert_eq!(plc.get("p.w"), "7", "{profile:?}");
    }
}

#[test]
fn s5_vendors_shift_integers_as_bits() {
    let text = "PROGRAM p VAR x, y, z : INT := -2; k : INT; END_VAR y := SHR(x, 1); z := SHL(INT#3, 2); k := SHR(INT#-2, 1); END_PROGRAM";
    let codes: Vec<_> = compile_in(Profile::Std, text).diags.iter().map(|d| d.code).collect();
    assert_eq!(codes, [Code::BadOperand; 3]);
    let mut plc = Plc::new_in(Profile::Codesys, text);
    plc.scan(0).unwrap();
    assert_eq!(["p.y", "p.z", "p.k"].map(|v| plc.get(v)), ["32767", "12", "32767"]);
}

#[test]
fn s2_6_times_as_numbers() {
    row("DINT", "TIME", "TIME_TO_DINT(?)", "1s500ms", ["1500", "1500", "1"]);
    row("REAL", "TIME", "TIME_TO_REAL(?)", "1s500ms", ["1500.0", "1500.0", "1.5"]);
    row("TIME", "DINT", "DINT_TO_TIME(?)", "1500", ["T#1s500ms", "T#1s500ms", "T#25m"]);
    row("TIME", "REAL", "REAL_TO_TIME(?)", "1.5", ["T#1ms500us", "T#1ms500us", "T#1s500ms"]);
    row("UDINT", "TOD", "TOD_TO_UDINT(?)", "00:01:02.5", ["62500", "62500", "62"]);
    row("TOD", "UDINT", "UDINT_TO_TOD(?)", "62", ["TOD#00:00:00.062", "TOD#00:00:00.062", "TOD#00:01:02"]);
    row("UDINT", "DATE", "DATE_TO_UDINT(?)", "1970-01-02", ["86400", "86400", "86400"]);
    row("UDINT", "DT", "TO_UDINT(?)", "1970-01-01-00:01:00", ["60", "60", "60"]);
    row("STRING", "TIME", "TO_STRING(?)", "1s500ms", ["'T#1s500ms'", "'T#1s500ms'", "'T#1s500ms'"]);
}

/// A row per profile: std, codesys, codesys2, openplc.
fn row_of_four(ty: &str, from: &str, call: &str, x: &str, wanted: [&str; 4]) {
    for (profile, want) in Profile::ALL.into_iter().zip(wanted) {
        assert_eq!(value(profile, ty, from, call, x), [want, want], "{call} of {x} in {profile:?}");
    }
}

#[test]
fn s2_3_texts() {
    row("STRING", "BYTE", "BYTE_TO_STRING(?)", "16#AF", ["'16#AF'", "'175'", "'16#af'"]);
    row(
        "STRING",
        "LWORD",
        "TO_STRING(?)",
        "16#FFFFFFFFFFFFFFFF",
        ["'16#FFFFFFFFFFFFFFFF'", "'18446744073709551615'", "'16#ffffffffffffffff'"],
    );
    row("STRING", "INT", "INT_TO_STRING(?)", "-12", ["'-12'"; 3]);
    row("STRING", "BOOL", "BOOL_TO_STRING(?)", "TRUE", ["'TRUE'"; 3]);
    row("WSTRING", "WORD", "WORD_TO_WSTRING(?)", "16#AF", ["\"16#AF\"", "\"175\"", "\"16#af\""]);
    row("STRING", "TIME", "TIME_TO_STRING(?)", "0s", ["'T#0s'", "'T#0ms'", "'T#0s'"]);
    row("STRING", "TIME", "TIME_TO_STRING(?)", "1d3m5ms", ["'T#1d3m5ms'"; 3]);
    row("STRING", "DATE", "DATE_TO_STRING(?)", "2024-02-29", ["'D#2024-02-29'"; 3]);
    row_of_four("STRING", "REAL", "REAL_TO_STRING(?)", "1.5", ["'1.5'"; 4]);
    row_of_four("STRING", "REAL", "REAL_TO_STRING(?)", "100.0", ["'100.0'", "'100.0'", "'100'", "'100'"]);
    row_of_four("STRING", "REAL", "REAL_TO_STRING(?)", "0.1", ["'0.1'", "'0.1'", "'0.1'", "'0.1000000015'"]);
    row_of_four(
        "STRING",
        "REAL",
        "REAL_TO_STRING(?)",
        "16777217.0",
        ["'16777216.0'", "'16777220.0'", "'16777220'", "'16777216'"],
    );
    row_of_four("STRING", "LREAL", "LREAL_TO_STRING(?)", "1.0E20", ["'1.0E+20'", "'1.0E+20'", "'1.0E+20'", "'1e+20'"]);
    row_of_four("STRING", "LREAL", "LREAL_TO_STRING(?)", "-0.001953125", ["'-0.001953125'"; 4]);
}

/// §2.4: a text in a variable.
#[test]
fn s2_4_beginnings_of_texts() {
    for (ty, text, std, codesys) in [
        ("INT", "12abc", "0", "12"),
        ("INT", "  -7 ", "0", "-7"),
        ("INT", "16#FFG", "0", "255"),
        ("INT", "16#", "0", "16"),
        ("INT", "abc", "0", "0"),
        ("INT", "", "0", "0"),
        ("INT", "99999", "32767", "32767"),
        ("UINT", "-5", "0", "0"),
        ("REAL", "1.5.2", "0.0", "1.5"),
        ("REAL", "2e", "0.0", "2.0"),
        ("REAL", "2.e5", "0.0", "2.0"),
        ("BOOL", "TRUEISH", "FALSE", "TRUE"),
        ("TIME", "T#5m3", "T#0s", "T#5m"),
        ("DATE", "D#2024-02-29x", "D#1970-01-01", "D#2024-02-29"),
    ] {
        let text = format!("PROGRAM p VAR s : STRING := '{text}'; x : {ty}; END_VAR x := STRING_TO_{ty}(s); END_PROGRAM");
        for profile in Profile::ALL {
            let mut plc = Plc::new_in(profile, &text);
            plc.scan(0).unwrap();
            assert_eq!(plc.get("p.x"), if profile.is_codesys() { codesys } else { std }, "{text} {profile:?}");
        }
    }
    let text = "PROGRAM p VAR s : STRING := '12x'; x : INT; a, b : BOOL; END_VAR
        x := STRING_TO_INT(IN := s, ENO => a); s := '99999'; x := STRING_TO_INT(IN := s, ENO => b); END_PROGRAM";
    for (profile, want) in [(Profile::Std, "FALSE"), (Profile::Codesys, "TRUE")] {
        let mut plc = Plc::new_in(profile, text);
        plc.scan(0).unwrap();
        assert_eq!((plc.get("p.a").as_str(), plc.get("p.b").as_str()), (want, "FALSE"), "{profile:?}");
    }
}

#[test]
fn s6_mux_and_limit() {
    for (k, std, codesys) in [("-1", "10", "30"), ("0", "10", "10"), ("1", "20", "20"), ("2", "30", "30"), ("3", "10", "30")] {
        row("INT", "INT", "MUX(?, 10, 20, 30)", k, [std, codesys, std]);
    }
    for (x, std, openplc) in [("0", "3", "5"), ("5", "3", "5"), ("6", "3", "3"), ("4", "3", "5")] {
        row("INT", "INT", "LIMIT(INT#5, ?, INT#3)", x, [std, std, openplc]);
        row("INT", "INT", "LIMIT(INT#3, ?, INT#5)", x, [&format!("{}", x.parse::<i32>().unwrap().clamp(3, 5)); 3]);
    }
    let text = "PROGRAM p VAR k : INT := 2; x, y : INT; a, b : BOOL; END_VAR
        x := MUX(K := k, IN0 := 1, IN1 := 2, ENO => a); k := 1; y := MUX(K := k, IN0 := 1, IN1 := 2, ENO => b); END_PROGRAM";
    for (profile, want) in [(Profile::Std, "1"), (Profile::Codesys, "2")] {
        let mut plc = Plc::new_in(profile, text);
        plc.scan(0).unwrap();
        assert_eq!(["p.x", "p.y", "p.a", "p.b"].map(|v| plc.get(v)), [want, "2", "FALSE", "TRUE"], "{profile:?}");
    }
}

#[test]
fn s8_1_durations_of_whole_milliseconds() {
    row("TIME", "TIME", "DIV_TIME(?, 4)", "11ms", ["T#2ms750us", "T#2ms", "T#2ms750us"]);
    row("TIME", "TIME", "? / 4", "10ms", ["T#2ms500us", "T#2ms", "T#2ms500us"]);
    row("TIME", "TIME", "? * 0.3333", "1s", ["T#333ms300us", "T#333ms", "T#333ms300us"]);
    row("TIME", "TIME", "MUL_TIME(?, 2)", "1s500ms", ["T#3s"; 3]);
    row("TIME", "TIME", "? / 0.3", "1ms", ["T#3ms333us333ns", "T#3ms", "T#3ms333us333ns"]);
    let text = "PROGRAM p VAR z : INT; r : LREAL; t, u : TIME; a, b : BOOL; END_VAR
        t := DIV_TIME(IN1 := T#1s, IN2 := z, ENO => a); u := DIV_TIME(IN1 := T#1s, IN2 := r, ENO => b); END_PROGRAM";
    for profile in Profile::ALL {
        let mut plc = Plc::new_in(profile, text);
        plc.scan(0).unwrap();
        assert_eq!(["p.t", "p.u", "p.a", "p.b"].map(|v| plc.get(v)), ["T#0s", "T#0s", "FALSE", "FALSE"], "{profile:?}");
    }
}

#[test]
fn s9_byte_order() {
    row("WORD", "WORD", "TO_BIG_ENDIAN(?)", "16#1234", ["13330"; 3]);
    row("DWORD", "DWORD", "FROM_BIG_ENDIAN_DWORD(?)", "16#01020304", ["67305985"; 3]);
    row("LINT", "LINT", "TO_BIG_ENDIAN(?)", "1", ["72057594037927936"; 3]);
    row("INT", "INT", "TO_BIG_ENDIAN(?)", "128", ["-32768"; 3]);
    row("BYTE", "BYTE", "TO_BIG_ENDIAN(?)", "16#12", ["18"; 3]);
    row("BOOL", "BOOL", "TO_BIG_ENDIAN(?)", "TRUE", ["TRUE"; 3]);
    row("REAL", "REAL", "FROM_BIG_ENDIAN(TO_BIG_ENDIAN(?))", "1.5", ["1.5"; 3]);
    row("TIME", "TIME", "FROM_BIG_ENDIAN(TO_BIG_ENDIAN(?))", "5ms", ["T#5ms"; 3]);
    row("DWORD", "DWORD", "TO_LITTLE_ENDIAN(?)", "16#01020304", ["16909060"; 3]);
    let text = "PROGRAM p VAR s : STRING := 'ab'; w : WSTRING := \"ab\"; a : ARRAY [1..2] OF INT := [1, 2];
        b : ARRAY [1..2] OF INT; t : STRING; v, u : WSTRING; END_VAR
        t := TO_BIG_ENDIAN(s); v := TO_BIG_ENDIAN(w); u := FROM_BIG_ENDIAN(v); b := TO_LITTLE_ENDIAN(a); END_PROGRAM";
    let mut plc = Plc::new(text);
    plc.scan(0).unwrap();
    assert_eq!(["p.t", "p.u", "p.b[2]"].map(|v| plc.get(v)), ["'ab'", "\"ab\"", "2"]);
    assert_ne!(plc.get("p.v"), "\"ab\"");
}

#[test]
fn s8_2_names_of_edition_2() {
    let text = "PROGRAM p VAR a, b : DT; END_VAR a := CONCAT_DATE_TOD(IN1 := D#2024-02-29, IN2 := TOD#12:30:15.5);
        b := CONCAT_DATE_TOD(DATE := D#2024-02-29, TOD := TOD#12:30:15.5); END_PROGRAM";
    let mut plc = Plc::new(text);
    plc.scan(0).unwrap();
    assert_eq!(["p.a", "p.b"].map(|v| plc.get(v)), ["DT#2024-02-29-12:30:15.5"; 2]);
}
