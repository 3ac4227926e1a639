//! Standard blocks by the profile of the file that declares them, their other pin names, and outputs of several types (library
//! reference §8.2, §10). The cycle tables of the vendors are `conformance/iec/blocks/codesys.md` and `openplc.md`.

use std::collections::HashSet;
use takt_base::{Code, Profile};
use takt_compiler::driver::{Compilation, File};
use takt_stdlib::SOURCES;
use takt_tests::plc::{Plc, check, compile_in, compile_st};

/// Every block and procedure of §8.2 and §10.
#[test]
fn s10_all_blocks_are_there() {
    let has = |line: &str| ["FUNCTION_BLOCK ", "FUNCTION "].iter().find_map(|head| line.strip_prefix(head).map(str::to_owned));
    let known: HashSet<String> = SOURCES.iter().flat_map(|(_, text)| text.lines()).filter_map(has).collect();
    let mut wanted: Vec<String> = "SR RS R_TRIG F_TRIG CTU CTD CTUD TP TON TOF RTC SEMA INTEGRAL DERIVATIVE PID RAMP HYSTERESIS
        SPLIT_DATE SPLIT_TOD SPLIT_LTOD SPLIT_DT SPLIT_LDT"
        .split_whitespace()
        .map(str::to_owned)
        .collect();
    for counter in ["CTU", "CTD", "CTUD"] {
        wanted.extend(["INT", "DINT", "LINT", "UDINT", "ULINT"].map(|ty| format!("{counter}_{ty}")));
    }
    for timer in ["TP", "TON", "TOF"] {
        wanted.extend(["TIME", "LTIME"].map(|ty| format!("{timer}_{ty}")));
    }
    let missing: Vec<_> = wanted.iter().filter(|name| !known.contains(*name)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// Every counter and timer name can be declared and called in every profile.
#[test]
fn s10_all_blocks_run_in_all_profiles() {
    for profile in Profile::ALL {
        let mut vars = String::new();
        let mut body = String::new();
        for counter in ["CTU", "CTD", "CTUD"] {
            for ty in ["", "_INT", "_DINT", "_LINT", "_UDINT", "_ULINT"] {
                vars += &format!("{counter}{ty}1 : {counter}{ty}; ");
                body += &format!("{counter}{ty}1(PV := 3); ");
            }
        }
        for timer in ["TP", "TON", "TOF", "TP_TIME", "TON_TIME", "TOF_TIME", "TP_LTIME", "TON_LTIME", "TOF_LTIME"] {
            vars += &format!("{timer}1 : {timer}; ");
            body += &format!("{timer}1(IN := TRUE); ");
        }
        let mut plc = Plc::new_in(profile, &format!("PROGRAM p VAR {vars} END_VAR {body} END_PROGRAM"));
        plc.scans(2);
        assert_eq!(plc.get("p.TON1.Q"), "TRUE", "{profile:?}");
    }
}

fn codes(c: &Compilation) -> Vec<Code> {
    c.diags.iter().map(|d| d.code).collect()
}

#[test]
fn s10_1_long_pin_names_are_of_the_vendors() {
    let text = "PROGRAM p VAR a : SR; b : RS; x, y : BOOL; END_VAR
        a.SET1 := TRUE; a(RESET := TRUE); b(SET := TRUE, RESET1 := FALSE); x := a.Q1 AND a.S1; y := b.SET AND b.Q1; END_PROGRAM";
    for profile in [Profile::Codesys, Profile::Codesys2, Profile::OpenPlc] {
        let mut plc = Plc::new_in(profile, text);
        plc.scan(0).unwrap();
        assert_eq!((plc.get("p.x"), plc.get("p.y")), ("TRUE".into(), "TRUE".into()), "{profile:?}");
    }
    assert_eq!(codes(&compile_st(text))[..2], [Code::UnknownMember, Code::UnknownParameter]);
    // Of a block of the user's own they are nothing.
    let own = "FUNCTION_BLOCK SR VAR_INPUT S1 : BOOL; END_VAR VAR_OUTPUT Q1 : BOOL; END_VAR Q1 := S1; END_FUNCTION_BLOCK
        PROGRAM p VAR a : SR; END_VAR a(SET1 := TRUE); END_PROGRAM";
    assert_eq!(codes(&compile_in(Profile::Codesys, own)), [Code::UnknownParameter]);
}

#[test]
fn s10_4_timers_of_codesys_and_ltime() {
    let text = "PROGRAM p VAR t : LTON; END_VAR t(IN := TRUE, PT := LTIME#5ms); END_PROGRAM";
    let wrong = compile_st(text);
    assert_eq!(codes(&wrong), [Code::VendorForm]);
    assert!(compile_in(Profile::Codesys2, text).image.is_some());
    // The plain timers take both.
    let vars = "t : TON; long : LTIME := LTIME#0s; et : LTIME; q : BOOL;";
    check(vars, "t(IN := TRUE, PT := long, Q => q, ET => et);", &[("q", "TRUE"), ("et", "LT#0s")]);
    let program = "PROGRAM p VAR t : TON; et : LTIME; END_VAR t(IN := TRUE, PT := LTIME#25ms, ET => et); END_PROGRAM";
    let mut plc = Plc::new(program);
    plc.scans(5);
    assert_eq!((plc.get("p.et"), plc.get("p.t.Q")), ("LT#25ms".into(), "TRUE".into()));
}

/// The file that declares the instance decides, and a block of the project wins over both.
#[test]
fn s10_2_profiles_mix_in_a_project() {
    let file = |name: &str, profile, text: &str| File { name: name.into(), bytes: text.into(), library: false, profile };
    let block = |name: &str| {
        format!(
            "FUNCTION_BLOCK {name} VAR_OUTPUT n : INT; END_VAR VAR f : F_TRIG; c : CTU; END_VAR
            f(CLK := FALSE); IF f.Q THEN n := n + 1; END_IF; END_FUNCTION_BLOCK\n"
        )
    };
    let program = "PROGRAM p VAR a : Mine; b : Theirs; x, y : INT; END_VAR a(n => x); b(n => y); END_PROGRAM";
    let files = || vec![file("a.st", Profile::Std, &(block("Mine") + program)), file("b.st", Profile::Codesys, &block("Theirs"))];
    let mut plc = Plc::from_files(files());
    plc.scans(2);
    assert_eq!((plc.get("p.x"), plc.get("p.y")), ("1".into(), "0".into()));
    let own = "FUNCTION_BLOCK F_TRIG VAR_INPUT CLK : BOOL; END_VAR VAR_OUTPUT Q : BOOL; END_VAR Q := TRUE; END_FUNCTION_BLOCK";
    let mut all = files();
    all.push(file("c.st", Profile::Std, own));
    let mut plc = Plc::from_files(all);
    plc.scans(2);
    assert_eq!((plc.get("p.x"), plc.get("p.y")), ("2".into(), "2".into()));
}

#[test]
fn s8_2_split_into_any_integer() {
    let vars = "y : DINT; m : USINT; d : LINT; h : BYTE; s : SINT; n : INT;";
    let body = "SPLIT_DATE(IN := D#2024-02-29, YEAR => y, MONTH => m, DAY => d);
        SPLIT_DT(IN := DT#2024-02-29-23:58:57.123, SECOND => s, MILLISECOND => n);";
    let want = [("y", "2024"), ("m", "2"), ("d", "29"), ("s", "57"), ("n", "123")];
    check(vars, body, &want);
    let wrong = "PROGRAM p VAR h : BYTE; END_VAR SPLIT_TOD(IN := TOD#01:02:03, HOUR => h); END_PROGRAM";
    assert_eq!(codes(&compile_st(wrong)), [Code::TypeMismatch]);
}
