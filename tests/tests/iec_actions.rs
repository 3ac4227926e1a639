//! ACTION as a part of a unit (language reference, sections 4.5, 5.7, 17) run on both engines.

use takt_base::{Code, Profile};
use takt_image::Trap;
use takt_tests::plc::{Plc, check_profile, errors};

#[test]
fn s4_5_an_action_shares_the_variables_of_its_program() {
    let text = "PROGRAM p VAR n, m : INT; t : INT := 7; END_VAR VAR CONSTANT c : INT := 3; END_VAR
          step1(); step1(); m := m + t;
          ACTION step1: n := n + c; IF n > 5 THEN twice(); END_IF; END_ACTION
          ACTION twice: m := m + 100; END_ACTION
        END_PROGRAM";
    for profile in Profile::ALL {
        check_profile(profile, text, 1, &[("p.n", "6"), ("p.m", "107")]);
    }
}

#[test]
fn s4_5_inputs_outputs_temporaries_and_in_outs_of_a_block() {
    let text = "TYPE S : STRUCT a : INT; END_STRUCT END_TYPE
        FUNCTION_BLOCK f VAR_INPUT x : INT; END_VAR VAR_OUTPUT y : INT; END_VAR VAR_IN_OUT io : INT; s : S; a : ARRAY[*] OF INT; END_VAR
          VAR_TEMP t : INT := 4; u : STRING[8] := 'ab'; END_VAR VAR k : INT; i : DINT; END_VAR
          ACTION work: y := x * 2 + t; io := io + 1; s.a := s.a + io; t := t + 1; u := CONCAT(u, 'c');
            FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO a[i] := a[i] + 1; END_FOR; END_ACTION
          work(); work(); k := t * 10 + LEN(u);
        END_FUNCTION_BLOCK
        PROGRAM p VAR b : f; io : INT := 10; s : S; v : ARRAY[3..4] OF INT; y, k : INT; END_VAR
          b(x := 5, io := io, s := s, a := v, y => y); k := k * 100 + b.k; END_PROGRAM";
    check_profile(Profile::Std, text, 1, &[("p.io", "12"), ("p.s.a", "23"), ("p.y", "15"), ("p.b.k", "64"), ("p.v", "[2, 2]")]);
    check_profile(Profile::Std, text, 2, &[("p.io", "14"), ("p.b.k", "64"), ("p.k", "6464")]);
}

#[test]
fn s4_5_calls_from_outside() {
    let text = "FUNCTION_BLOCK f VAR_OUTPUT n : INT; END_VAR
          ACTION reset: n := 0; END_ACTION
          ACTION up: n := n + 1; END_ACTION
          up();
        END_FUNCTION_BLOCK
        PROGRAM p VAR b : f; l : ARRAY[1..2] OF f; END_VAR b(); b.up(); b.up(); l[2].up(); l[1](); l[1].reset(); END_PROGRAM";
    check_profile(Profile::Std, text, 1, &[("p.b.n", "3"), ("p.l[2].n", "1"), ("p.l[1].n", "0")]);
    let text = "PROGRAM sub VAR n : INT; END_VAR n := n + 1; END_PROGRAM ACTION add: n := n + 10; END_ACTION
        PROGRAM p sub(); sub.add(); END_PROGRAM";
    check_profile(Profile::Codesys, text, 1, &[("sub.n", "11")]);
}

/// Section 5.7: RETURN leaves the action alone.
#[test]
fn s5_7_return_leaves_the_action() {
    let text = "PROGRAM p VAR n : INT; END_VAR
          early(); n := n + 10;
          ACTION early: n := n + 1; IF n > 0 THEN RETURN; END_IF; n := 1000; END_ACTION
        END_PROGRAM";
    check_profile(Profile::Std, text, 1, &[("p.n", "11")]);
}

#[test]
fn s4_5_bodies_in_instruction_list() {
    let text = "PROGRAM p VAR n : INT; END_VAR
          add();
          ACTION add:
            LD n
            ADD 5
            ST n
          END_ACTION
        END_PROGRAM
        FUNCTION_BLOCK f VAR_OUTPUT n : INT; END_VAR
          ACTION up:
            n := n + 1;
          END_ACTION
          LD 1
          ST n
        END_FUNCTION_BLOCK";
    check_profile(Profile::Std, text, 2, &[("p.n", "10")]);
}

/// Section 17: the objects of an export, with the actions behind their unit.
#[test]
fn s17_actions_behind_the_unit() {
    let text = "(* @NESTEDCOMMENTS := 'Yes' *)
        PROGRAM p
        VAR n : INT; END_VAR
        (* @END_DECLARATION := '0' *)
        first();
        second();
        END_PROGRAM
        ACTION first:
        n := n + 1;
        END_ACTION

        (* @OBJECTFLAGS := '0, 8' *)
        ACTION second:
        n := n * 3;
        END_ACTION
        FUNCTION_BLOCK g VAR m : INT; END_VAR a(); END_FUNCTION_BLOCK
        ACTIONS ACTION a: m := 1; END_ACTION ACTION b: m := 2; END_ACTION END_ACTIONS
        PROGRAM q VAR x : g; END_VAR x(); x.b(); ACTIONS q ACTION c: ; END_ACTION END_ACTIONS END_PROGRAM";
    check_profile(Profile::Codesys2, text, 1, &[("p.n", "3"), ("q.x.m", "2")]);
    let behind = "PROGRAM p a(); END_PROGRAM ACTION a: ; END_ACTION";
    assert_eq!(errors(Profile::Std, behind), [Code::VendorForm]);
    assert_eq!(errors(Profile::Std, "PROGRAM p a(); ACTIONS ACTION a: ; END_ACTION END_ACTIONS END_PROGRAM"), [Code::VendorForm]);
}

#[test]
fn s4_5_actions_are_inherited_and_replaced() {
    let text = "FUNCTION_BLOCK base VAR n : INT; END_VAR
          ACTION one: n := n + 1; END_ACTION
          ACTION two: n := n + 10; END_ACTION
          one(); two();
        END_FUNCTION_BLOCK
        FUNCTION_BLOCK derived EXTENDS base
          ACTION two: n := n + 100; SUPER.two(); END_ACTION
          ACTION three: two(); one(); END_ACTION
          SUPER(); three();
        END_FUNCTION_BLOCK
        FUNCTION touch VAR_IN_OUT b : base; END_VAR b.two(); END_FUNCTION
        PROGRAM p VAR b : base; d, e : derived; END_VAR b(); d(); touch(e); e.one(); END_PROGRAM";
    check_profile(Profile::Std, text, 1, &[("p.b.n", "11"), ("p.d.n", "222"), ("p.e.n", "111")]);
    check_profile(Profile::Codesys, &text.replace("SUPER.", "SUPER^.").replace("SUPER(", "SUPER^("), 1, &[("p.d.n", "222")]);
}

/// A VAR_IN_OUT is bound during calls of the body only; outside it is nothing, also of a derived block.
#[test]
fn s4_7_an_in_out_outside_of_a_call_is_a_fault() {
    let text = "FUNCTION_BLOCK f VAR_IN_OUT io : INT; END_VAR ACTION a: io := 1; END_ACTION a(); END_FUNCTION_BLOCK
        FUNCTION_BLOCK g EXTENDS f END_FUNCTION_BLOCK
        FUNCTION_BLOCK h EXTENDS f SUPER(); a(); END_FUNCTION_BLOCK
        PROGRAM p VAR x : f; y : g; z : h; i : INT; n : INT; END_VAR
          IF n = 0 THEN x(io := i); y(io := i); z(io := i); ELSIF n = 1 THEN x.a(); ELSE y.a(); END_IF; END_PROGRAM";
    for n in ["1", "2"] {
        let mut plc = Plc::new(text);
        plc.scans(1);
        plc.set("p.n", n);
        assert_eq!(plc.scan(10).expect_err("a fault").trap, Trap::Reference);
    }
}

#[test]
fn what_actions_can_not_have() {
    let edge =
        "FUNCTION_BLOCK f VAR_INPUT c : BOOL R_EDGE; END_VAR VAR n : INT; END_VAR ACTION a: IF c THEN n := 1; END_IF; END_ACTION
        a(); END_FUNCTION_BLOCK PROGRAM p VAR x : f; END_VAR x(); END_PROGRAM";
    assert_eq!(errors(Profile::Std, edge), [Code::NotSupportedYet]);
    assert_eq!(errors(Profile::Std, "FUNCTION f : INT f := 1; ACTION a: ; END_ACTION END_FUNCTION"), [Code::Expected]);
    assert_eq!(errors(Profile::Std, "TYPE t : INT; END_TYPE ACTION a: ; END_ACTION"), [Code::Expected]);
    assert_eq!(
        errors(Profile::Std, "PROGRAM p ACTION a: ; END_ACTION ACTION A: ; END_ACTION END_PROGRAM"),
        [Code::DuplicateName]
    );
    assert_eq!(errors(Profile::Std, "PROGRAM p VAR a : INT; END_VAR ACTION a: ; END_ACTION END_PROGRAM"), [Code::MemberClash]);
    assert_eq!(errors(Profile::Std, "PROGRAM p a(1); ACTION a: ; END_ACTION END_PROGRAM"), [Code::WrongArgumentCount]);
    assert_eq!(
        errors(Profile::Std, "PROGRAM p VAR i : INT; END_VAR i := a(); ACTION a: ; END_ACTION END_PROGRAM"),
        [Code::NotCallable]
    );
}
