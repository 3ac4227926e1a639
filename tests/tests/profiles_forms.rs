//! Forms that one dialect has and another refuses (language reference, sections 0, 3.2, 3.9, 4.4, 4.7, 5.3, 12).

use takt_base::{Code, Profile, Severity};
use takt_tests::plc::{Plc, compile_in, errors};

fn codes(profile: Profile, text: &str) -> Vec<(Code, Severity)> {
    compile_in(profile, text).diags.iter().filter(|d| !d.code.is_advice()).map(|d| (d.code, d.severity)).collect()
}

fn after(profile: Profile, text: &str, scans: i64, values: &[(&str, &str)]) {
    let mut plc = Plc::new_in(profile, text);
    plc.scans(scans);
    for (name, value) in values {
        assert_eq!(plc.get(&format!("main.{name}")), *value, "{name}");
    }
}

/// MATIEC copies in-outs of function blocks in and back: they can be read and set from outside, and left out.
#[test]
fn s0_in_outs_of_openplc_are_copied() {
    let text = "FUNCTION_BLOCK Add VAR_IN_OUT sum : INT; list : ARRAY[0..1] OF INT; END_VAR VAR_INPUT plus : INT; END_VAR
          sum := sum + plus; list[1] := sum; END_FUNCTION_BLOCK
        PROGRAM main VAR a : Add; x : INT := 5; t : ARRAY[0..1] OF INT; y, z : INT; END_VAR
          a(sum := x, list := t, plus := 2); y := a.sum; a.sum := 100; a(plus := 1); z := a.sum; END_PROGRAM";
    after(Profile::OpenPlc, text, 1, &[("x", "7"), ("t[1]", "7"), ("y", "7"), ("z", "101")]);
    assert_eq!(
        errors(Profile::Std, text),
        [Code::UnknownMember, Code::UnknownMember, Code::MissingInOut, Code::MissingInOut, Code::UnknownMember]
    );
    let constant = "FUNCTION_BLOCK Add VAR_IN_OUT sum : INT; END_VAR sum := 1; END_FUNCTION_BLOCK
        PROGRAM main VAR a : Add; END_VAR a(sum := 3); END_PROGRAM";
    assert_eq!(errors(Profile::OpenPlc, constant), [Code::NotAVariable]);
}

/// An instance has state of its own: it is never copied.
#[test]
fn s0_instances_as_in_outs_of_openplc_stay_the_same() {
    let text = "FUNCTION_BLOCK Step VAR_IN_OUT c : CTU; END_VAR c(CU := TRUE); c(CU := FALSE); END_FUNCTION_BLOCK
        PROGRAM main VAR s : Step; c : CTU := (PV := 9); n : INT; END_VAR s(c := c); n := c.CV; END_PROGRAM";
    after(Profile::OpenPlc, text, 3, &[("n", "3")]);
}

#[test]
fn s3_9_the_last_semicolon_of_a_type_may_be_left_out() {
    let text = "TYPE Color : (Red, Green, Blue) END_TYPE TYPE N : INT := 4 END_TYPE
        PROGRAM main VAR c : Color := Blue; n : N; END_VAR END_PROGRAM";
    after(Profile::Std, text, 1, &[("c", "Blue"), ("n", "4")]);
}

#[test]
fn s2_6_subranges_of_bit_strings() {
    let text = "TYPE Low : WORD (1..4000); END_TYPE PROGRAM main VAR w : Low; v : WORD; END_VAR v := w + 1; w := v; END_PROGRAM";
    after(Profile::Codesys, text, 2, &[("w", "3")]);
    assert_eq!(errors(Profile::Std, text)[0], Code::BadOperand);
}

#[test]
fn s5_3_a_power_of_integers_is_an_integer_where_one_is_wanted() {
    let text = "PROGRAM main VAR x, y : DINT := 3; l : LINT := 2; n : INT; r : LREAL; END_VAR
        y := x ** 4; l := EXPT(l, 40); n := 7 - DINT_TO_INT(x) ** 2; r := x ** 2; END_PROGRAM";
    after(Profile::Std, text, 1, &[("y", "81"), ("l", "1099511627776"), ("n", "-2"), ("r", "9.0")]);
}

#[test]
fn s3_2_a_constant_is_not_retained_and_has_a_value() {
    let retained = "PROGRAM main VAR CONSTANT RETAIN c : INT := 1; END_VAR END_PROGRAM";
    assert_eq!(errors(Profile::Std, retained), [Code::SectionNotAllowed]);
    assert!(errors(Profile::Codesys, retained).is_empty());
    for text in [
        "PROGRAM main VAR CONSTANT c : INT; END_VAR END_PROGRAM",
        "VAR_GLOBAL CONSTANT c : ARRAY[1..2] OF INT; END_VAR PROGRAM main END_PROGRAM",
    ] {
        assert_eq!(codes(Profile::Std, text), [(Code::ConstantWithoutValue, Severity::Error)]);
        assert_eq!(codes(Profile::Codesys, text), [(Code::ConstantWithoutValue, Severity::Warning)]);
    }
    for text in [
        "TYPE N : INT := 4; END_TYPE PROGRAM main VAR CONSTANT c : N; END_VAR END_PROGRAM",
        "VAR_GLOBAL CONSTANT c : INT := 0; END_VAR PROGRAM main VAR_EXTERNAL CONSTANT c : INT; END_VAR END_PROGRAM",
    ] {
        assert_eq!(errors(Profile::Std, text), []);
    }
}

#[test]
fn s4_7_an_informal_call_of_a_block_gives_all_inputs() {
    let text = "PROGRAM main VAR t : TON; END_VAR t(TRUE); END_PROGRAM";
    assert_eq!(errors(Profile::Std, text), [Code::WrongArgumentCount]);
    assert_eq!(errors(Profile::Codesys, text), []);
    assert_eq!(errors(Profile::Std, "PROGRAM main VAR t : TON; END_VAR t(TRUE, T#1s); t(); t(IN := TRUE); END_PROGRAM"), []);
}

#[test]
fn s4_4_internal_is_for_the_namespace() {
    let used = |place: &str| {
        let text = format!(
            "NAMESPACE A CLASS C VAR INTERNAL v : INT; END_VAR METHOD INTERNAL m v := v + 1; END_METHOD END_CLASS
               NAMESPACE B {} END_NAMESPACE {} END_NAMESPACE {}",
            if place == "inner" { "PROGRAM main VAR c : C; END_VAR c.v := 1; c.m(); END_PROGRAM" } else { "" },
            if place == "same" { "PROGRAM main VAR c : C; END_VAR c.v := 1; c.m(); END_PROGRAM" } else { "" },
            if place == "outside" { "PROGRAM main VAR c : A.C; END_VAR c.v := 1; c.m(); END_PROGRAM" } else { "" },
        );
        errors(Profile::Std, &text)
    };
    assert_eq!(used("same"), []);
    assert_eq!(used("inner"), []);
    assert_eq!(used("outside"), [Code::AccessDenied, Code::AccessDenied]);
}

#[test]
fn s12_codesys_pins_of_strings_null_as_zero_and_new_type_names_as_members() {
    let text = "INTERFACE I METHOD m : INT END_METHOD END_INTERFACE
        FUNCTION_BLOCK F IMPLEMENTS I METHOD m : INT m := 7; END_METHOD END_FUNCTION_BLOCK
        TYPE Calendar : STRUCT LDT : DT; LTOD : TOD; END_STRUCT END_TYPE
        PROGRAM main VAR f : F; i : I; n, k : INT; s : STRING; c : Calendar; END_VAR
          IF i = 0 THEN n := 1; END_IF i := f; IF i <> 0 THEN k := i.m(); END_IF i := 0; IF i = 0 THEN n := n + 10; END_IF
          s := MID(STR := CONCAT(STR1 := 'abc', STR2 := 'def'), LEN := 2, POS := 3); n := n + 100 * LEN(STR := s);
          c.LTOD := TOD#10:00:00; END_PROGRAM";
    after(Profile::Codesys, text, 1, &[("n", "211"), ("k", "7"), ("s", "'cd'"), ("c.LTOD", "TOD#10:00:00")]);
}

/// What can't be called does not hide the function of its name.
#[test]
fn s3_10_a_number_and_a_function_may_share_a_name() {
    let text = "FUNCTION scale : INT VAR_INPUT x : INT; END_VAR scale := 2 * x; END_FUNCTION
        PROGRAM main VAR limit : INT := 3; scale : INT := 4; n : INT; END_VAR
          n := LIMIT(0, scale(limit), scale) + limit; END_PROGRAM";
    for profile in Profile::ALL {
        after(profile, text, 1, &[("n", "7")]);
    }
    let text = "FUNCTION_BLOCK abs END_FUNCTION_BLOCK PROGRAM main VAR limit : TON; sel : INT; n : INT; END_VAR
        n := LIMIT(0, 1, 2); sel := nothing(1); END_PROGRAM";
    assert_eq!(errors(Profile::Std, text), [Code::NotCallable, Code::UnknownName]);
}

/// A variable of an instance needs no open address to get one.
#[test]
fn s3_7_var_config_gives_addresses_to_plain_variables() {
    let text = "FUNCTION_BLOCK Fb VAR n : INT := 7; lamp : BOOL; END_VAR n := n + 1; lamp := n > 8; END_FUNCTION_BLOCK
        PROGRAM Main VAR fb : Fb; counter : INT; inside : INT; located AT %MW40 : INT; END_VAR
          fb(); counter := counter + 1; inside := counter; END_PROGRAM
        CONFIGURATION c PROGRAM main : Main;
          VAR_CONFIG main.counter AT %MW0 : INT := 5; main.fb.lamp AT %QX0.1 : BOOL; END_VAR END_CONFIGURATION";
    let mut plc = Plc::new(text);
    plc.scans(2);
    for (path, value) in [("main.counter", "7"), ("main.fb.n", "9"), ("main.fb.lamp", "TRUE"), ("%MW0", "7"), ("%QX0.1", "TRUE")]
    {
        assert_eq!(plc.get(path), value, "{path}");
    }
    let located = text.replace("main.counter AT %MW0 : INT := 5", "main.located AT %MW0 : INT");
    assert_eq!(errors(Profile::Std, &located), [Code::NotConfigurable]);
}

/// The standard's own computed initial value: the place of a variable of the instance.
#[test]
fn s3_9_references_to_variables_of_the_instance_as_initial_values() {
    let text = "FUNCTION_BLOCK Fb VAR x : INT := 4; r : REF_TO INT := REF(x); END_VAR r^ := r^ + 1; END_FUNCTION_BLOCK
        FUNCTION f : INT VAR_INPUT a : INT; END_VAR VAR_IN_OUT io : INT; END_VAR VAR r : REF_TO INT := REF(io); END_VAR
          r^ := r^ + a; f := r^; END_FUNCTION
        PROGRAM main VAR one, two : Fb; n : INT := 3; p : REF_TO INT := REF(n); k : INT; END_VAR
          one(); two(); two(); p^ := p^ * 2; k := f(1, n); END_PROGRAM";
    for profile in [Profile::Std, Profile::Codesys] {
        after(profile, text, 1, &[("one.x", "5"), ("two.x", "6"), ("n", "7"), ("k", "7")]);
    }
    assert_eq!(errors(Profile::Std, "PROGRAM main VAR a : INT; b : INT := a + 1; END_VAR END_PROGRAM"), [Code::NotConstant]);
}
