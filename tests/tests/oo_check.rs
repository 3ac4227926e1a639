//! Rules of object orientation (language reference, sections 3.1, 4.2 to 4.4): what is wrong is said once, at its place, with its code.

use takt_base::{Profile, Severity};
use takt_tests::plc::compile_in;

fn found(profile: Profile, text: &str) -> Vec<String> {
    let c = compile_in(profile, text);
    let mark = |s: Severity| if s == Severity::Error { "" } else { "w" };
    let diags = c.diags.iter().filter(|d| !d.code.is_advice());
    diags.map(|d| format!("{}{}", mark(d.severity), d.code.text())).filter(|t| t != "wP4002" && t != "P4002").collect()
}

/// Each text gives exactly these codes (`w`: a warning), at what the text `place` marks.
fn check(cases: &[(&str, &str, &str)]) {
    for (text, code, place) in cases {
        let c = compile_in(Profile::Std, text);
        let codes = found(Profile::Std, text);
        assert_eq!(codes.join(" "), *code, "{text}");
        if let Some(d) = c.diags.iter().find(|d| code.ends_with(d.code.text())) {
            assert_eq!(c.sources.text(d.span), *place, "{text}");
            let older = d.code.text() == "P2012";
            assert!(!d.label.is_empty() && (older || d.help.is_some() || !d.related.is_empty()), "{text}: {d:?}");
        }
    }
}

#[test]
fn heritage() {
    check(&[
        ("CLASS A EXTENDS B END_CLASS CLASS B EXTENDS A END_CLASS", "P2031", "A"),
        ("FUNCTION_BLOCK A EXTENDS A END_FUNCTION_BLOCK", "P2031", "A"),
        ("INTERFACE A EXTENDS A END_INTERFACE", "P2031", "A"),
        ("CLASS A EXTENDS B END_CLASS", "P1004", "B"),
        ("FUNCTION_BLOCK B END_FUNCTION_BLOCK CLASS A EXTENDS B END_CLASS", "P2030", "B"),
        ("INTERFACE B END_INTERFACE CLASS A EXTENDS B END_CLASS", "P2030", "B"),
        ("CLASS B END_CLASS CLASS A IMPLEMENTS B END_CLASS", "P2030", "B"),
        ("CLASS B END_CLASS CLASS C END_CLASS CLASS A EXTENDS B, C END_CLASS", "P2030", "C"),
        ("CLASS FINAL B END_CLASS CLASS A EXTENDS B END_CLASS", "P3043", "B"),
        (
            "TYPE T : STRUCT a : INT; END_STRUCT END_TYPE TYPE U EXTENDS T : STRUCT b : INT; END_STRUCT END_TYPE",
            "P0014",
            "EXTENDS",
        ),
        ("TYPE T : INT; END_TYPE FUNCTION_BLOCK A EXTENDS T END_FUNCTION_BLOCK", "P2030", "T"),
    ]);
}

#[test]
fn methods_and_variables_of_types() {
    check(&[
        ("CLASS A VAR m : INT; END_VAR METHOD m END_METHOD END_CLASS", "P1021", "m"),
        ("CLASS B VAR m : INT; END_VAR END_CLASS CLASS A EXTENDS B METHOD m END_METHOD END_CLASS", "P1021", "m"),
        ("CLASS B VAR m : INT; END_VAR END_CLASS CLASS A EXTENDS B VAR m : INT; END_VAR END_CLASS", "P1022", "m"),
        ("CLASS B VAR PRIVATE m : INT; END_VAR END_CLASS CLASS A EXTENDS B VAR m : INT; END_VAR END_CLASS", "", ""),
        ("CLASS A METHOD m END_METHOD METHOD m END_METHOD END_CLASS", "P1001", "m"),
        ("CLASS A VAR_INPUT x : INT; END_VAR END_CLASS", "P3008", "VAR_INPUT"),
        ("INTERFACE A METHOD m END_METHOD END_INTERFACE CLASS C IMPLEMENTS A END_CLASS", "P3040", "C"),
        ("CLASS ABSTRACT B METHOD PUBLIC ABSTRACT m END_METHOD END_CLASS CLASS C EXTENDS B END_CLASS", "P3040", "C"),
        ("CLASS ABSTRACT B METHOD PUBLIC ABSTRACT m END_METHOD END_CLASS CLASS ABSTRACT C EXTENDS B END_CLASS", "", ""),
        ("CLASS B METHOD PUBLIC ABSTRACT m END_METHOD END_CLASS", "P3045", "ABSTRACT"),
        ("CLASS A METHOD PUBLIC OVERRIDE m END_METHOD END_CLASS", "P3044", "OVERRIDE"),
        ("CLASS B METHOD m END_METHOD END_CLASS CLASS A EXTENDS B METHOD m END_METHOD END_CLASS", "P3042", "m"),
        ("CLASS B METHOD FINAL m END_METHOD END_CLASS CLASS A EXTENDS B METHOD OVERRIDE m END_METHOD END_CLASS", "P3043", "m"),
        (
            "CLASS B METHOD PUBLIC m END_METHOD END_CLASS CLASS A EXTENDS B METHOD PRIVATE OVERRIDE m END_METHOD END_CLASS",
            "P3041",
            "m",
        ),
    ]);
}

#[test]
fn signatures() {
    let pair = |a: &str, b: &str| {
        format!("INTERFACE I METHOD m {a} END_METHOD END_INTERFACE CLASS C IMPLEMENTS I METHOD PUBLIC m {b} END_METHOD END_CLASS")
    };
    let x = |t: &str| format!("VAR_INPUT x : {t}; END_VAR");
    for (a, b, place) in [
        (": INT", ": DINT m := 1;", "m"),
        (": INT", "", "m"),
        ("", ": INT m := 1;", "m"),
        (&x("INT"), &x("DINT"), "x"),
        (&x("INT"), "VAR_INPUT y : INT; END_VAR", "y"),
        (&x("INT"), "VAR_IN_OUT x : INT; END_VAR", "x"),
        (&x("INT"), "", "m"),
        ("", &x("INT"), "m"),
    ] {
        check(&[(&pair(a, b), "P3041", place)]);
    }
    check(&[(&pair(&x("INT"), &x("INT").to_lowercase()), "", "")]);
}

#[test]
fn uses() {
    let with = |types: &str, vars: &str, body: &str| format!("{types} PROGRAM main VAR {vars} END_VAR {body} END_PROGRAM");
    let c = "CLASS C VAR PRIVATE p : INT; END_VAR VAR PROTECTED q : INT; END_VAR VAR PUBLIC r : INT; END_VAR VAR s : INT; END_VAR
        METHOD PUBLIC start END_METHOD METHOD PRIVATE hid END_METHOD METHOD soft END_METHOD END_CLASS";
    let i = "INTERFACE I METHOD m END_METHOD END_INTERFACE INTERFACE J METHOD m END_METHOD END_INTERFACE
        CLASS D IMPLEMENTS I METHOD PUBLIC m END_METHOD END_CLASS CLASS ABSTRACT E END_CLASS";
    let t = "CLASS T VAR v : INT; END_VAR PROPERTY PUBLIC g : INT GET g := v; END_GET END_PROPERTY
        PROPERTY PUBLIC w : INT SET v := w; END_SET END_PROPERTY METHOD PUBLIC m END_METHOD END_CLASS
        FUNCTION f VAR_IN_OUT x : INT; END_VAR x := 1; END_FUNCTION";
    for (types, vars, body, code, place) in [
        (c, "c : C; x : INT;", "x := c.p;", "P1020", "p"),
        (c, "c : C; x : INT;", "x := c.q;", "P1020", "q"),
        (c, "c : C; x : INT;", "x := c.r; c.r := 2;", "", ""),
        (c, "c : C; x : INT;", "x := c.s;", "wP1020", "s"),
        (c, "c : C;", "c.hid();", "P1020", "hid"),
        (c, "c : C;", "c.soft();", "wP1020", "soft"),
        (c, "c : C;", "c.strat();", "P1023", "strat"),
        (c, "c : C; x : INT;", "x := c.start();", "P2012", "c.start()"),
        (c, "c : C; x : INT;", "x := c.start;", "P2014", "start"),
        (c, "c : C;", "c();", "P2012", "c"),
        (i, "d : D; j : J;", "j := d; j.m();", "P2033", "d"),
        (i, "d : D; k : I; j : J;", "k := d; j := k; j.m();", "P2033", "k"),
        (i, "e : E;", ";", "P2032", "E"),
        (i, "k : I;", "k.m();", "wP3047", "k"),
        (i, "k : I; x : INT;", "k := x; k.m();", "P2001", "x"),
        (i, "k : I; d : D;", "k := d; k.n();", "P1023", "n"),
        (i, "k, l : I; b : BOOL;", "k := l; b := k > l;", "P2003", "k > l"),
        (i, "k : I; x : INT;", "x ?= k;", "P2001", "x"),
        (t, "t : T; x : INT;", "t.g := 1;", "P3046", "g"),
        (t, "t : T; x : INT;", "x := t.w;", "P3046", "w"),
        (t, "t : T;", "f(t.g);", "P2014", "g"),
        (t, "t : T;", "t.m(1);", "P2013", "1"),
        (t, "", "SUPER();", "P1025", "SUPER"),
    ] {
        check(&[(&with(types, vars, body), code, place)]);
    }
    check(&[
        ("FUNCTION f : INT f := THIS.x; END_FUNCTION", "P1024", "THIS"),
        ("FUNCTION f : INT f := 1; SUPER(); END_FUNCTION", "P1024", "SUPER"),
        ("CLASS A METHOD m SUPER.m(); END_METHOD END_CLASS", "P1025", "SUPER"),
        (
            "CLASS ABSTRACT A METHOD PUBLIC ABSTRACT m END_METHOD END_CLASS CLASS B EXTENDS A METHOD PUBLIC OVERRIDE m SUPER.m(); END_METHOD END_CLASS",
            "P3045",
            "SUPER.m()",
        ),
        ("FUNCTION_BLOCK A VAR_IN_OUT x : INT; END_VAR METHOD PUBLIC m x := 1; END_METHOD END_FUNCTION_BLOCK", "P0012", "x"),
    ]);
}

#[test]
fn the_vendors_ask_for_less() {
    let text = "CLASS B VAR v : INT; END_VAR METHOD m END_METHOD END_CLASS CLASS A EXTENDS B METHOD m END_METHOD END_CLASS
        PROGRAM main VAR a : A; x : INT; END_VAR a.m(); x := a.v; END_PROGRAM";
    assert_eq!(found(Profile::Codesys, text), Vec::<String>::new());
    assert_eq!(found(Profile::Std, text), ["P3042", "wP1020", "wP1020"]);
    let init = "FUNCTION_BLOCK F METHOD FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR FB_init := TRUE; END_METHOD END_FUNCTION_BLOCK";
    assert_eq!(found(Profile::Codesys, init), Vec::<String>::new());
    assert_eq!(found(Profile::Codesys, &init.replace("FB_init", "FB_exit")), ["wP0012"]);
}

#[test]
fn one_mistake_one_message() {
    let after = " FUNCTION_BLOCK Last METHOD PUBLIC m END_METHOD END_FUNCTION_BLOCK PROGRAM main VAR l : Last; END_VAR l.m(); END_PROGRAM";
    for text in [
        "CLASS A METHOD m x : = 1; END_METHOD END_CLASS",
        "CLASS A METHOD PUBLIC END_METHOD END_CLASS",
        "CLASS A METHOD m ; IF TRUE THEN END_METHOD END_CLASS",
        "FUNCTION_BLOCK A METHOD m END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK A METHOD m VAR x : INT END_VAR END_METHOD END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK A EXTENDS END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK A IMPLEMENTS , B END_FUNCTION_BLOCK",
        "CLASS A PROPERTY p INT GET p := 1; END_GET END_PROPERTY END_CLASS",
        "CLASS A PROPERTY p : INT GET p := 1; END_PROPERTY END_CLASS",
        "CLASS A METHOD m END_METHOD",
        "INTERFACE I METHOD m ; x := 1; END_METHOD END_INTERFACE",
        "INTERFACE METHOD m END_METHOD END_INTERFACE",
        "CLASS A METHOD m : END_METHOD END_CLASS",
        "CLASS A VAR PUBLIC x INT; END_VAR METHOD m END_METHOD END_CLASS",
        "FUNCTION f : INT METHOD m END_METHOD f := 1; END_FUNCTION",
        "CLASS A METHOD m m(; END_METHOD END_CLASS",
    ] {
        let text = format!("{text}{after}");
        let errors: Vec<_> = found(Profile::Std, &text).into_iter().filter(|c| !c.starts_with('w')).collect();
        assert_eq!(errors.len(), 1, "{text}\n{errors:?}");
    }
}
