//! Namespaces, USING and lists of global variables (language reference §3.5, §3.10, §4.6, §12).

use takt_base::diag::render;
use takt_base::{Code, Profile};
use takt_compiler::driver::{File, Project, compile};
use takt_tests::plc::{Plc, compile_in};

fn errors(text: &str) -> Vec<Code> {
    takt_tests::plc::errors(Profile::Std, text)
}

#[test]
fn a_name_is_sought_from_the_inside_out() {
    let mut plc = Plc::new(
        "NAMESPACE a.b
           TYPE T : INT := 5; E : (red, green := 7); END_TYPE
           NAMESPACE c
             FUNCTION f : INT VAR_INPUT x : T; END_VAR f := x + g(); END_FUNCTION
             FUNCTION_BLOCK count VAR_OUTPUT n : DINT; END_VAR n := n + 1; END_FUNCTION_BLOCK
           END_NAMESPACE
           FUNCTION g : INT g := 100; END_FUNCTION
         END_NAMESPACE
         FUNCTION g : INT g := 1; END_FUNCTION
         TYPE T : INT := 9; END_TYPE
         PROGRAM Main
           VAR r : INT; s : INT; t : a.b.T; u : T; e : a.b.E; ok : BOOL; k : a.b.c.count; v : ARRAY[0..1] OF a.b.T; END_VAR
           r := a.b.c.f(x := 3);
           s := g() + a.b.g();
           e := a.b.E#green;
           ok := e = green;
           k();
         END_PROGRAM",
    );
    plc.scans(2);
    for (name, value) in
        [("r", "103"), ("s", "101"), ("t", "5"), ("u", "9"), ("ok", "TRUE"), ("k.n", "2"), ("v[1]", "5"), ("e", "green")]
    {
        assert!(plc.get(&format!("Main.{name}")).ends_with(value), "{name} {}", plc.get(&format!("Main.{name}")));
    }
}

#[test]
fn using_stands_in_three_places_and_imports_direct_members() {
    let mut plc = Plc::new(
        "USING lib;
         NAMESPACE lib
           FUNCTION twice : INT VAR_INPUT x : INT; END_VAR twice := 2 * x; END_FUNCTION
           NAMESPACE deep TYPE P : STRUCT x : INT := 4; END_STRUCT; END_TYPE END_NAMESPACE
           CLASS Base VAR PUBLIC n : INT := 3; END_VAR END_CLASS
         END_NAMESPACE
         NAMESPACE app
           USING lib.deep;
           FUNCTION sum : INT VAR_INPUT p : P; END_VAR sum := twice(p.x); END_FUNCTION
         END_NAMESPACE
         FUNCTION_BLOCK Sub USING app; EXTENDS lib.Base
           VAR p : lib.deep.P; END_VAR
           VAR_OUTPUT r : INT; END_VAR
           r := sum(p) + n;
         END_FUNCTION_BLOCK
         PROGRAM Main VAR s : Sub; r : INT; END_VAR s(); r := s.r + twice(1); END_PROGRAM",
    );
    plc.scans(1);
    assert_eq!(plc.get("Main.r"), "13");
}

#[test]
fn one_short_name_in_two_namespaces() {
    let two = "NAMESPACE a TYPE T : INT := 1; END_TYPE END_NAMESPACE NAMESPACE b TYPE T : REAL := 2.0; END_TYPE END_NAMESPACE ";
    let mut plc = Plc::new(&format!("{two} PROGRAM Main VAR x : a.T; y : b.T; END_VAR ; END_PROGRAM"));
    plc.scans(1);
    assert_eq!((plc.get("Main.x"), plc.get("Main.y")), ("1".to_owned(), "2.0".to_owned()));
    assert_eq!(errors(&format!("{two} USING a, b; TYPE U : T; END_TYPE")), [Code::AmbiguousName]);
    assert_eq!(errors(&format!("{two} USING a, b; TYPE U : a.T; END_TYPE")), []);
    // The inner USING wins over the outer one.
    assert_eq!(errors(&format!("{two} USING a; NAMESPACE c USING b; TYPE U : T := 1.5; END_TYPE END_NAMESPACE")), []);
    assert_eq!(
        errors("NAMESPACE a TYPE T : INT; END_TYPE END_NAMESPACE NAMESPACE a TYPE T : INT; END_TYPE END_NAMESPACE"),
        [Code::DuplicateName]
    );
}

#[test]
fn what_a_namespace_does_not_show() {
    assert_eq!(errors("USING drivez;"), [Code::UnknownNamespace]);
    assert_eq!(errors("NAMESPACE a TYPE T : INT; END_TYPE END_NAMESPACE TYPE U : T; END_TYPE"), [Code::UnknownType]);
    let inner = "NAMESPACE a NAMESPACE INTERNAL b TYPE T : INT; END_TYPE END_NAMESPACE TYPE V : b.T; END_TYPE END_NAMESPACE ";
    assert_eq!(errors(inner), []);
    assert_eq!(errors(&format!("{inner} TYPE U : a.b.T; END_TYPE")), [Code::InternalNamespace]);
    assert_eq!(errors(&format!("{inner} USING a.b;")), [Code::InternalNamespace]);
    assert_eq!(errors(&format!("{inner} TYPE U : a.V; END_TYPE")), []);
    // USING a does not make b a name.
    assert_eq!(errors("USING a; NAMESPACE a.b TYPE T : INT; END_TYPE END_NAMESPACE TYPE U : b.T; END_TYPE"), [Code::UnknownType]);
    let red = "NAMESPACE a TYPE E : (red); END_TYPE END_NAMESPACE ";
    assert_eq!(errors(&format!("{red} FUNCTION f : BOOL VAR e : a.E; END_VAR f := e = red; END_FUNCTION")), []);
    assert_eq!(errors(&format!("{red} FUNCTION f : INT CASE 1 OF red: ; END_CASE f := 1; END_FUNCTION")).len(), 1);
    let plant = "NAMESPACE plant VAR_GLOBAL speed : INT; END_VAR END_NAMESPACE ";
    assert_eq!(errors(&format!("{plant} PROGRAM Main speed := 5; END_PROGRAM")), [Code::QualifiedOnly]);
    assert_eq!(errors(&format!("{plant} PROGRAM Main plant.speed := 5; END_PROGRAM")), []);
}

#[test]
fn library_names_are_seen_everywhere_and_a_namespace_may_have_its_own() {
    let mut plc = Plc::new(
        "NAMESPACE n
           FUNCTION ABS : INT VAR_INPUT x : INT; END_VAR ABS := 77; END_FUNCTION
           FUNCTION f : INT VAR t : INT; END_VAR t := ABS(-5); f := t + MAX(1, 2); END_FUNCTION
           PROGRAM Prog VAR t : TON; x : INT; END_VAR t(IN := TRUE, PT := T#0s); IF t.Q THEN x := f() + 1000; END_IF END_PROGRAM
         END_NAMESPACE
         CONFIGURATION c
           VAR_GLOBAL g : INT; END_VAR
           RESOURCE r ON plc
             TASK t (INTERVAL := T#10ms, PRIORITY := 1);
             PROGRAM p WITH t : n.Prog;
           END_RESOURCE
         END_CONFIGURATION
         FUNCTION h : INT h := ABS(-5); END_FUNCTION",
    );
    plc.scans(3);
    assert_eq!(plc.get("p.x"), "1079");
}

#[test]
fn a_local_variable_hides_a_namespace() {
    let mut plc = Plc::new(
        "NAMESPACE a FUNCTION f : INT f := 1; END_FUNCTION VAR_GLOBAL x : INT := 8; END_VAR END_NAMESPACE
         TYPE S : STRUCT x : INT := 3; END_STRUCT; END_TYPE
         PROGRAM Main VAR a : S; r : INT; END_VAR r := a.x; END_PROGRAM",
    );
    plc.scans(1);
    assert_eq!(plc.get("Main.r"), "3");
}

/// Files of CODESYS by name.
fn project(files: &[(&str, &str)]) -> Vec<String> {
    let file = |(name, text): &(&str, &str)| File {
        name: (*name).into(),
        bytes: (*text).into(),
        library: false,
        profile: Profile::Codesys,
    };
    let files = files.iter().map(file).collect();
    let c = compile(Project { name: "test".into(), files, attachments: vec![], interval: None, native: true });
    c.diags.iter().filter(|d| !d.code.is_advice()).map(|d| render(d, &c.sources)).collect()
}

#[test]
fn a_file_of_globals_is_a_list() {
    let lists = [
        ("src/GVL.st", "VAR_GLOBAL a : INT; both : INT; END_VAR"),
        (
            "Other.TcGVL.st",
            "{attribute 'qualified_only'} VAR_GLOBAL CONSTANT n : INT := 3; END_VAR VAR_GLOBAL both : INT; END_VAR",
        ),
    ];
    let with = |body: &str| {
        let main = format!("PROGRAM Main VAR v : ARRAY[0..Other.n] OF INT; END_VAR {body} END_PROGRAM");
        project(&[lists[0], lists[1], ("main.st", &main)])
    };
    assert_eq!(with("a := 1; GVL.a := 2; gvl.A := other.n; .a := 5; v[3] := Other.both + GVL.both;"), Vec::<String>::new());
    let [message] = with("a := n;").try_into().expect("one message");
    assert!(message.contains("P1043") && message.contains("write Other.n"), "{message}");
    let [message] = with("a := both;").try_into().expect("one message");
    assert!(message.contains("P1040"), "{message}");
    assert!(project(&[lists[0], ("main.st", "PROGRAM Main GVL.z := 1; END_PROGRAM")])[0].contains("error"));
}

#[test]
fn a_point_in_front_means_the_global() {
    let text = "VAR_GLOBAL x : INT := 5; END_VAR PROGRAM Main VAR x : INT; y : INT; z : INT; END_VAR
                x := 1; y := .x; .x := 7; z := test.x; END_PROGRAM";
    let mut plc = Plc::new_in(Profile::Codesys, text);
    plc.scans(1);
    assert_eq!(
        (plc.get("Main.x"), plc.get("Main.y"), plc.get("Main.z"), plc.get("x")),
        ("1".into(), "5".into(), "7".into(), "7".into())
    );
    assert!(compile_in(Profile::Std, text).diags.iter().any(|d| d.code == Code::VendorForm));
}
