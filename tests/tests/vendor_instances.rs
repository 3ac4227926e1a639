//! Programs as instances, VAR_STAT, arguments of instances, hierarchical addresses (language reference §3.1, §3.2, §3.6, §4.3, §16).

use takt_base::{Code, Profile};
use takt_tests::plc::{Plc, compile_st, errors};

fn codesys(text: &str) -> Plc {
    Plc::new_in(Profile::Codesys, text)
}

fn check(plc: &Plc, values: &[(&str, &str)]) {
    for (name, value) in values {
        assert_eq!(plc.get(name), *value, "{name}");
    }
}

#[test]
fn a_program_is_called_like_its_only_instance() {
    let text =
        "PROGRAM Sub VAR_INPUT in : INT := 3; END_VAR VAR_OUTPUT out : INT; END_VAR VAR n : DINT := 10; k : INT := 2; END_VAR
                  n := n + 1; out := in * k; END_PROGRAM
                PROGRAM Main VAR a : INT; b : INT; c : DINT; END_VAR
                  Sub(); a := Sub.out; Sub(in := 5, out => b); Sub.in := 7; c := Sub.n; END_PROGRAM";
    let mut plc = codesys(text);
    plc.scans(1);
    check(&plc, &[("Main.a", "6"), ("Main.b", "10"), ("Main.c", "12"), ("Sub.in", "7"), ("Sub.n", "12")]);
    plc.scans(1);
    check(&plc, &[("Main.a", "14"), ("Main.c", "14")]);
    assert!(!errors(Profile::Std, text).is_empty());
}

#[test]
fn what_a_task_runs_is_the_same_instance() {
    let mut plc = codesys(
        "PROGRAM Counter VAR n : INT := 5; END_VAR n := n + 1; END_PROGRAM
         PROGRAM Reader VAR_OUTPUT seen : INT; END_VAR seen := Counter.n; END_PROGRAM",
    );
    plc.scans(2);
    check(&plc, &[("Counter.n", "7"), ("Reader.seen", "7")]);
    let mut plc = codesys(
        "PROGRAM Counter VAR n : INT := 5; END_VAR n := n + 1; END_PROGRAM
         PROGRAM Reader VAR_OUTPUT seen : INT; END_VAR seen := Counter.n; END_PROGRAM
         CONFIGURATION c RESOURCE r ON plc TASK t (INTERVAL := T#10ms, PRIORITY := 1);
           PROGRAM count WITH t : Counter; PROGRAM read WITH t : Reader; END_RESOURCE END_CONFIGURATION",
    );
    plc.scans(3);
    check(&plc, &[("count.n", "8"), ("read.seen", "8")]);
}

#[test]
fn a_program_may_look_at_itself_and_be_a_variable() {
    let mut plc = codesys(
        "PROGRAM Self VAR n : INT; m : INT; t : TON; END_VAR
           n := n + 1; Self.t(IN := TRUE, PT := T#0s); m := Self.n + n; END_PROGRAM",
    );
    plc.scans(2);
    check(&plc, &[("Self.n", "2"), ("Self.m", "4"), ("Self.t.Q", "TRUE")]);
    let mut plc = codesys(
        "PROGRAM P VAR n : INT; END_VAR n := n + 1; END_PROGRAM
         PROGRAM Main VAR one : P; many : ARRAY[0..1] OF P; END_VAR one(); one(); many[1](); P(); P(); P(); END_PROGRAM",
    );
    plc.scans(1);
    check(&plc, &[("Main.one.n", "2"), ("Main.many[1].n", "1"), ("Main.many[0].n", "0"), ("P.n", "3")]);
    assert_eq!(errors(Profile::Codesys, "PROGRAM P VAR p : P; END_VAR ; END_PROGRAM"), [Code::RecursiveType]);
    assert_eq!(errors(Profile::Std, "PROGRAM P ; END_PROGRAM PROGRAM Q VAR p : P; END_VAR ; END_PROGRAM"), [Code::UnknownType]);
}

#[test]
fn var_stat_lasts() {
    let text = "FUNCTION f : INT VAR_STAT n : INT := 10; t : TON; END_VAR VAR l : INT; END_VAR n := n + 1; l := l + 1; f := n * 10 + l;
                END_FUNCTION
                FUNCTION g : INT VAR_STAT n : INT; END_VAR n := n + 1; g := n; END_FUNCTION
                FUNCTION_BLOCK B VAR_STAT all : INT; END_VAR VAR_OUTPUT o : INT; END_VAR all := all + 1; o := all; END_FUNCTION_BLOCK
                FUNCTION_BLOCK M METHOD m : INT VAR_STAT n : INT := 2; END_VAR n := n * 2; m := n; END_METHOD END_FUNCTION_BLOCK
                PROGRAM Main VAR a : INT; b : INT; c : INT; x : B; y : B; m : M; d : INT; END_VAR
                  a := f(); b := f(); c := g(); x(); y(); d := m.m() + m.m(); END_PROGRAM";
    let mut plc = codesys(text);
    plc.scans(1);
    check(&plc, &[("Main.a", "111"), ("Main.b", "121"), ("Main.c", "1"), ("Main.x.o", "1"), ("Main.y.o", "2"), ("Main.d", "12")]);
    assert!(errors(Profile::Std, text).contains(&Code::VendorForm));
}

#[test]
fn var_temp_starts_anew_everywhere() {
    let mut plc = Plc::new(
        "FUNCTION f : INT VAR_TEMP t : INT := 3; END_VAR t := t + 1; f := t; END_FUNCTION
         FUNCTION_BLOCK B VAR_TEMP t : INT := 4; END_VAR VAR_OUTPUT o : INT; END_VAR t := t + 1; o := t; END_FUNCTION_BLOCK
         CLASS C METHOD PUBLIC m : INT VAR_TEMP t : INT := 5; END_VAR t := t + 1; m := t; END_METHOD END_CLASS
         PROGRAM Main VAR_TEMP t : INT := 6; END_VAR VAR a : INT; b : B; c : C; d : INT; e : INT; END_VAR
           t := t + 1; a := f() * 10 + f(); b(); b(); d := c.m() + c.m(); e := t; END_PROGRAM",
    );
    plc.scans(2);
    check(&plc, &[("Main.a", "44"), ("Main.b.o", "5"), ("Main.d", "12"), ("Main.e", "7")]);
}

#[test]
fn constant_parameters() {
    let text = "FUNCTION_BLOCK B VAR_INPUT CONSTANT k : INT := 3; END_VAR VAR_OUTPUT CONSTANT v : INT := 8; END_VAR
                  VAR_OUTPUT o : INT; END_VAR o := k * 2 + v; END_FUNCTION_BLOCK
                PROGRAM Main VAR x : B; y : B := (k := 10); END_VAR x(); y(); END_PROGRAM";
    let mut plc = Plc::new_in(Profile::Codesys2, text);
    plc.scans(1);
    check(&plc, &[("Main.x.o", "14"), ("Main.y.o", "28")]);
    assert_eq!(errors(Profile::Std, text), [Code::SectionNotAllowed]);
}

#[test]
fn instances_have_arguments_and_initial_values() {
    let text = "FUNCTION_BLOCK FB VAR_INPUT a : INT := 1; b : INT := 2; END_VAR VAR_OUTPUT s : INT; END_VAR s := a + b; END_FUNCTION_BLOCK
                VAR_GLOBAL g : FB(b := 50); END_VAR
                PROGRAM Main VAR x : FB(a := 10, b := 20); y : FB(); z : FB; t : TON(PT := T#5s); END_VAR
                  x(); y(); z(a := 7); g(); END_PROGRAM";
    let mut plc = codesys(text);
    plc.scans(1);
    check(&plc, &[("Main.x.s", "30"), ("Main.y.s", "3"), ("Main.z.s", "9"), ("g.s", "51"), ("Main.t.PT", "T#5s")]);
    assert!(errors(Profile::Std, text).contains(&Code::VendorForm));
    let mut plc = Plc::new(
        "PROGRAM Main VAR t : TON := (PT := T#1s); many : ARRAY[1..3] OF TON := [(PT := T#2s), 2((PT := T#3s))]; END_VAR
           t(IN := TRUE); many[3](IN := TRUE); END_PROGRAM",
    );
    plc.scans(1);
    check(&plc, &[("Main.t.PT", "T#1s"), ("Main.many[1].PT", "T#2s"), ("Main.many[2].PT", "T#3s"), ("Main.many[3].PT", "T#3s")]);
    let wrong = "FUNCTION_BLOCK FB VAR_INPUT a : INT; END_VAR ; END_FUNCTION_BLOCK PROGRAM Main VAR x : FB(c := 1); END_VAR ; END_PROGRAM";
    assert_eq!(errors(Profile::Codesys, wrong), [Code::UnknownMember]);
}

#[test]
fn hierarchical_addresses_have_places_of_their_own() {
    let mut plc = Plc::new(
        "VAR_GLOBAL g AT %MW1.2.3 : INT := 7; h AT %MW1.2.4 : INT := 8; END_VAR
         PROGRAM Main VAR p AT %QX1.2.3.4.5.6.7.8 : BOOL; q AT %QX1.2 : BOOL; m AT %MW0 : INT; a : INT; b : BOOL; END_VAR
           m := 1; %MW1.2 := 5; a := WORD_TO_INT(%MW1.2.3) + WORD_TO_INT(%MW1.2) * 100 + m; p := TRUE; b := %QX1.2.3.4.5.6.7.8;
           %MD9.1 := 16#FFFFFFFF; %MX0.1.2 := TRUE; END_PROGRAM",
    );
    plc.scans(1);
    check(&plc, &[("g", "7"), ("h", "8"), ("Main.a", "508"), ("Main.b", "TRUE"), ("Main.q", "FALSE"), ("Main.m", "1")]);
    let nine = compile_st("PROGRAM Main %MW1.2.3.4.5.6.7.8.9 := 1; END_PROGRAM");
    assert!(nine.diags.iter().any(|d| d.code == Code::BadAddress));
}
