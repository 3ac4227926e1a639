//! What happens before the first scan (language reference, sections 3.1, 3.6, 4.4): computed initial values, FB_init, VAR_INST.
//! Run on both engines.

use takt_base::{Code, Profile};
use takt_tests::plc::{Plc, check_profile, compile_in, errors};

fn codesys(text: &str) -> Plc {
    Plc::new_in(Profile::Codesys, text)
}

fn check(text: &str, scans: i64, want: &[(&str, &str)]) {
    check_profile(Profile::Codesys, text, scans, want);
}

const DOUBLE: &str = "FUNCTION double : INT VAR_INPUT x : INT; END_VAR double := 2 * x; END_FUNCTION ";

#[test]
fn s3_1_initial_values_may_be_any_expression() {
    let text = "VAR_GLOBAL g : INT := double(4); h : INT := g + 1; END_VAR
        PROGRAM p VAR a : INT := 3; b : INT := a * 2 + h; c : INT := double(x := b); n : INT; END_VAR
          n := n + 1; a := 100; END_PROGRAM";
    check(&format!("{DOUBLE}{text}"), 2, &[("g", "8"), ("h", "9"), ("p.b", "15"), ("p.c", "30"), ("p.n", "2")]);
    assert_eq!(
        errors(Profile::Std, &format!("{DOUBLE} PROGRAM p VAR a : INT := 3; b : INT := double(a); END_VAR ; END_PROGRAM")),
        [Code::NotConstant]
    );
}

#[test]
fn s3_1_parts_of_arrays_and_structures() {
    let text = "TYPE S : STRUCT a : INT := 7; b : ARRAY[0..1] OF INT; END_STRUCT END_TYPE
        PROGRAM p VAR k : INT := 5;
          s : S := (b := [k, double(k)]);
          l : ARRAY[1..3] OF INT := [1, k, 3];
          m : ARRAY[1..2, 1..2] OF INT := [[1, k + 1], [k + 2, 4]];
          f : ARRAY[1..2, 1..2] OF INT := [1, 2, k, 4];
          t : ARRAY[1..2] OF S := [(a := k), (a := 1)];
          r : S := s; w : STRING[8] := CONCAT('k', INT_TO_STRING(k));
        END_VAR ; END_PROGRAM";
    let want = [
        ("p.s.a", "7"),
        ("p.s.b", "[5, 10]"),
        ("p.l", "[1, 5, 3]"),
        ("p.m", "[[1, 6], [7, 4]]"),
        ("p.f", "[[1, 2], [5, 4]]"),
        ("p.t[1].a", "5"),
        ("p.r.b[1]", "10"),
        ("p.w", "'k5'"),
    ];
    check(&format!("{DOUBLE}{text}"), 1, &want);
    let open = "PROGRAM p VAR k : INT; o AT %Q* : INT := k; END_VAR ; END_PROGRAM CONFIGURATION c RESOURCE r ON x PROGRAM q : p; END_RESOURCE
        VAR_CONFIG q.o AT %QW0 : INT; END_VAR END_CONFIGURATION";
    assert_eq!(errors(Profile::Codesys, open), [Code::NotConstant]);
    let configured =
        "PROGRAM p VAR k : INT; o : INT := k; END_VAR ; END_PROGRAM CONFIGURATION c RESOURCE r ON x PROGRAM q : p; END_RESOURCE
        VAR_CONFIG q.o : INT := 3; END_VAR END_CONFIGURATION";
    assert_eq!(errors(Profile::Codesys, configured), [Code::NotConfigurable]);
    let repeat = "PROGRAM p VAR k : INT; l : ARRAY[1..4] OF INT := [4(k)]; END_VAR ; END_PROGRAM";
    assert_eq!(errors(Profile::Codesys, repeat), [Code::NotConstant]);
}

#[test]
fn s3_1_each_instance_and_each_call_has_its_own() {
    let text = "FUNCTION_BLOCK b VAR_INPUT i : INT := 4; END_VAR VAR x : INT := double(i); me : POINTER TO INT := ADR(x); END_VAR
          VAR_TEMP t : INT := x + 1; END_VAR VAR_OUTPUT q : INT; END_VAR q := t; me^ := me^ + 10; END_FUNCTION_BLOCK
        FUNCTION f : INT VAR_INPUT a : INT; END_VAR VAR l : INT := a * 3; m : INT := l + 1; END_VAR f := m; END_FUNCTION
        PROGRAM p VAR x : b; y : b := (i := 10); z : ARRAY[0..2] OF b; r, s : INT; END_VAR
          x(); y(); z[1](); r := f(1); s := f(2); END_PROGRAM";
    let want =
        [("p.x.q", "9"), ("p.y.q", "21"), ("p.y.x", "30"), ("p.z[1].x", "18"), ("p.z[2].x", "8"), ("p.r", "4"), ("p.s", "7")];
    check(&format!("{DOUBLE}{text}"), 1, &want);
}

const NODE: &str = "FUNCTION_BLOCK node VAR n : INT := 5; order : INT; kept, copied : BOOL; END_VAR
    METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; a : INT; b : INT := 2; END_VAR
      n := n + 10 * a + b; kept := bInitRetains; copied := bInCopyCode; count := count + 1; order := count; END_METHOD
    n := n + 1000;
  END_FUNCTION_BLOCK
  VAR_GLOBAL count : INT; END_VAR ";

#[test]
fn s4_4_fb_init_runs_once_in_order() {
    let text = format!(
        "{NODE} VAR_GLOBAL g : node(a := 9); END_VAR
        PROGRAM p VAR k : INT := 7; x : node(a := 1); y : node(a := k, b := 3); z : ARRAY[1..2] OF node(a := 5);
          w : ARRAY[1..2] OF node[(a := 6), (a := 7, b := 0)]; first : INT; END_VAR
          IF first = 0 THEN first := count; END_IF; x(); END_PROGRAM
        PROGRAM q VAR x : node(a := 2); END_VAR ; END_PROGRAM"
    );
    let want = [
        ("g.n", "97"),
        ("p.x.n", "3017"),
        ("p.y.n", "78"),
        ("p.z[2].n", "57"),
        ("p.w[1].n", "67"),
        ("p.w[2].n", "75"),
        ("q.x.n", "27"),
        ("g.order", "1"),
        ("p.x.order", "2"),
        ("p.z[1].order", "4"),
        ("q.x.order", "8"),
        ("p.first", "8"),
        ("p.x.kept", "TRUE"),
        ("p.x.copied", "FALSE"),
        ("count", "8"),
    ];
    check(&text, 3, &want);
}

#[test]
fn s4_4_fb_init_of_bases_members_and_structures() {
    let text = "VAR_GLOBAL log : STRING := ''; END_VAR
        FUNCTION_BLOCK inner METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR log := CONCAT(log, 'i'); END_METHOD
        END_FUNCTION_BLOCK
        TYPE S : STRUCT one : inner; two : ARRAY[1..2] OF inner; END_STRUCT END_TYPE
        FUNCTION_BLOCK base VAR i : inner; v : INT := 3; END_VAR
          METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; k : INT; END_VAR log := CONCAT(log, 'b'); v := v + k; END_METHOD
        END_FUNCTION_BLOCK
        FUNCTION_BLOCK derived EXTENDS base VAR j : inner; END_VAR
          METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; k : INT; m : INT; END_VAR
            log := CONCAT(log, 'd'); v := v * m; END_METHOD
        END_FUNCTION_BLOCK
        FUNCTION_BLOCK plain EXTENDS derived END_FUNCTION_BLOCK
        PROGRAM p VAR d : derived(k := 4, m := 10); s : S; e : plain(k := 1, m := 2); END_VAR ; END_PROGRAM";
    check(text, 2, &[("log", "'iibdiiiiibd'"), ("p.d.v", "70"), ("p.e.v", "8")]);
}

/// TwinCAT writes arguments without names: the parameters of the type's own FB_init in order. They may be variables, references and THIS.
#[test]
fn s4_4_arguments_without_names() {
    let text = format!(
        "{NODE} FUNCTION_BLOCK Lamp VAR_INPUT on : BOOL; END_VAR END_FUNCTION_BLOCK
        FUNCTION_BLOCK Switch VAR lamp : REFERENCE TO Lamp; level : INT; END_VAR
          METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; l : REFERENCE TO Lamp; level : INT; END_VAR
            THIS^.lamp REF= l; THIS^.level := level; END_METHOD
          lamp.on := TRUE;
        END_FUNCTION_BLOCK
        PROGRAM p VAR k : INT := 7; x : node(1); y : node(k, 3); w : ARRAY[1..2] OF node[(6), (7, 0)]; z : ARRAY[1..2] OF node(k + 1);
          lamp : Lamp; switch : Switch(lamp, 100); END_VAR
          switch(); END_PROGRAM"
    );
    let want = [
        ("p.x.n", "17"),
        ("p.y.n", "78"),
        ("p.w[1].n", "67"),
        ("p.w[2].n", "75"),
        ("p.z[2].n", "87"),
        ("p.lamp.on", "TRUE"),
        ("p.switch.level", "100"),
    ];
    check(&text, 1, &want);
}

#[test]
fn s4_4_wrong_arguments_of_fb_init() {
    let with = |decl: &str| errors(Profile::Codesys, &format!("{NODE} PROGRAM p VAR {decl} END_VAR ; END_PROGRAM"));
    assert_eq!(with("x : node;"), [Code::WrongArgumentCount]);
    assert_eq!(with("x : node(a := 1, c := 2);"), [Code::UnknownParameter]);
    assert_eq!(with("x : node(a := 'text');"), [Code::TypeMismatch]);
    assert_eq!(with("x : ARRAY[1..3] OF node[(a := 1)];"), [Code::BadInitializer]);
    assert_eq!(with("x : node(a := 1) := (n := 4);"), []);
    assert_eq!(with("x : node(1, 2, 3);"), [Code::WrongArgumentCount]);
    assert_eq!(with("x : TON(TRUE);"), [Code::BadInitializer]);
    assert_eq!(errors(Profile::Std, "PROGRAM p VAR x : TON(TRUE); END_VAR ; END_PROGRAM"), [Code::VendorForm]);
}

/// In profile `std` FB_init is a method like any other, and says so.
#[test]
fn life_cycle_methods_that_nobody_calls() {
    let text =
        "FUNCTION_BLOCK f VAR n : INT; END_VAR METHOD PUBLIC FB_init n := 1; END_METHOD METHOD PUBLIC FB_exit n := 2; END_METHOD
        n := n + 10; END_FUNCTION_BLOCK PROGRAM p VAR x : f; END_VAR x(); END_PROGRAM";
    let warnings = |profile| compile_in(profile, text).diags.iter().filter(|d| d.code == Code::NotSupportedYet).count();
    assert_eq!((warnings(Profile::Std), warnings(Profile::Codesys)), (2, 1));
    let mut plc = Plc::new(text);
    plc.scans(1);
    assert_eq!(plc.get("p.x.n"), "10");
}

/// Section 3.6: restored values come last.
#[test]
fn s3_6_retained_values_win() {
    let text = format!(
        "{DOUBLE} VAR_GLOBAL RETAIN g : INT := double(1); END_VAR
        FUNCTION_BLOCK f VAR RETAIN r : INT := double(2); END_VAR VAR n : INT := double(3); fresh : BOOL; END_VAR
          METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR fresh := bInitRetains; END_METHOD
          r := r + 1; n := n + 1; END_FUNCTION_BLOCK
        PROGRAM p VAR x : f; END_VAR x(); g := g + 1; END_PROGRAM"
    );
    let mut plc = codesys(&text);
    plc.scans(1);
    let first = [("g", "3"), ("p.x.r", "5"), ("p.x.n", "7"), ("p.x.fresh", "TRUE")];
    first.iter().for_each(|(n, v)| assert_eq!(plc.get(n), *v, "{n}"));
    let retained: Vec<_> = plc.image.retained.iter().map(|r| r.path.clone()).collect();
    assert!(retained.iter().any(|r| r == "restored at start"), "{retained:?}");
    let kept = plc.kept();
    let mut plc = codesys(&text);
    plc.restore(&kept);
    plc.scans(1);
    let second = [("g", "4"), ("p.x.r", "6"), ("p.x.n", "7"), ("p.x.fresh", "FALSE")];
    second.iter().for_each(|(n, v)| assert_eq!(plc.get(n), *v, "{n}"));
}

/// Section 18, example 10: three counters over a warm and a cold start.
#[test]
fn s18_10_restart() {
    let text =
        "PROGRAM p VAR a : INT := 3; END_VAR VAR RETAIN b : INT := 1; END_VAR VAR NON_RETAIN c : INT := 2; END_VAR ; END_PROGRAM";
    let values = |plc: &Plc| ["p.a", "p.b", "p.c"].map(|n| plc.get(n));
    let mut plc = Plc::new(text);
    [("p.a", "30"), ("p.b", "10"), ("p.c", "20")].iter().for_each(|(n, v)| plc.set(n, v));
    plc.scans(1);
    let kept = plc.kept();
    let mut warm = Plc::new(text);
    warm.restore(&kept);
    warm.scans(1);
    assert_eq!(values(&warm), ["3", "10", "2"]);
    let mut cold = Plc::new(text);
    cold.scans(1);
    assert_eq!(values(&cold), ["3", "1", "2"]);
}

/// What goes wrong is a fault of the first scan, with its place.
#[test]
fn s3_1_a_fault_in_an_initial_value() {
    let mut plc = codesys("PROGRAM p VAR z : INT; x : INT := 5 / z; n : INT; END_VAR\nn := n + 1; END_PROGRAM");
    let fault = plc.scan(0).expect_err("a fault");
    assert_eq!((fault.trap, fault.line), (takt_image::Trap::DivisionByZero, 1));
    plc.scan(10).expect("the start is over");
    assert_eq!(plc.get("p.n"), "1");
}

#[test]
fn s3_1_var_inst_is_one_for_each_instance() {
    let text = "FUNCTION_BLOCK f
          METHOD next : INT VAR_INST n : INT := 10; t : TON; END_VAR VAR l : INT; END_VAR
            n := n + 1; l := l + 1; t(IN := TRUE, PT := T#5ms); next := n * 10 + l; END_METHOD
          METHOD other : INT VAR_INST n : INT; END_VAR n := n + 5; other := n; END_METHOD
          PROPERTY count : INT GET VAR_INST c : INT; END_VAR c := c + 1; count := c; END_GET END_PROPERTY
        END_FUNCTION_BLOCK
        FUNCTION_BLOCK g EXTENDS f METHOD third : INT VAR_INST n : INT := 7; END_VAR third := n + next(); END_METHOD END_FUNCTION_BLOCK
        PROGRAM p VAR a, b : f; c : g; x, y, z, o, k : INT; END_VAR
          x := a.next(); x := a.next(); y := b.next(); o := a.other(); z := c.third(); k := a.count + a.count; END_PROGRAM";
    check(text, 1, &[("p.x", "121"), ("p.y", "111"), ("p.o", "5"), ("p.z", "118"), ("p.k", "3")]);
    assert_eq!(
        errors(Profile::Std, "FUNCTION_BLOCK f METHOD m VAR_INST x : INT; END_VAR ; END_METHOD END_FUNCTION_BLOCK"),
        [Code::VendorForm]
    );
    let outside = "FUNCTION f : INT VAR_INST x : INT; END_VAR f := 1; END_FUNCTION";
    assert_eq!(errors(Profile::Codesys, outside), [Code::SectionNotAllowed]);
}
