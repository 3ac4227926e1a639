//! Library functions whose result depends on the dialect of the calling file (library reference §2.2, §2.6, §5), on both engines.

use takt_base::{Code, Profile};
use takt_tests::plc::{Plc, compile_in};

/// The value of an expression, computed at run time and folded.
fn value(profile: Profile, ty: &str, from: &str, call: &str, x: &str) -> [String; 2] {
    let name = call.replace('?', "x");
    let folded = call.replace('?', &format!("{from}#{x}"));
    let text = format!("PROGRAM p VAR x : {from} := {x}; a, b : {ty}; END_VAR a := {name}; b := {folded}; END_PROGRAM");
    let mut plc = Plc::new_in(profile, &text);
    plc.scan(0).unwrap();
    [plc.get("p.a"), plc.get("p.b")]
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
