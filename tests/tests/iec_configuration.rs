//! Instance-specific addresses and initial values, access paths, resources (IEC 61131-3 reference §3.4, §3.6 to §3.8, §10).

use takt_tests::plc::{Plc, error_codes};

const BLOCKS: &str = "
FUNCTION_BLOCK Inner
VAR in AT %I* : BOOL; lamp AT %Q* : BOOL; level AT %QW* : INT; n : INT := 3; END_VAR
lamp := in; level := n; n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Outer VAR a : Inner; list : ARRAY [2..3] OF Inner; END_VAR a(); list[2](); list[3](); END_FUNCTION_BLOCK
PROGRAM Main VAR fb : Outer; t : TON := (PT := T#9s, IN := TRUE); x : INT := 1; m AT %M* : DINT := 7; END_VAR
fb(); t(); x := x + 1; m := m + 1;
END_PROGRAM
";

fn addresses(path: &str, byte: u32) -> String {
    format!("{path}.in AT %IX{byte}.1 : BOOL; {path}.lamp AT %QX{byte}.2 : BOOL := TRUE; {path}.level AT %QW{} : INT; ", 4 + byte)
}

fn with(config: &str) -> String {
    let all = addresses("r.p.fb.a", 0) + &addresses("p.fb.list[2]", 1) + &addresses("r.p.fb.list[3]", 2);
    format!(
        "{BLOCKS} CONFIGURATION c RESOURCE r ON PLC TASK t (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM p WITH t : Main; END_RESOURCE
        VAR_CONFIG {all} p.m AT %MD0 : DINT; {config} END_VAR END_CONFIGURATION"
    )
}

#[test]
fn s3_7_every_instance_has_its_own_address() {
    let mut plc = Plc::new(&with(""));
    plc.set("%IX1.1", "TRUE");
    plc.scan(0).unwrap();
    for (path, want) in [
        ("%QX0.2", "FALSE"),
        ("%QX1.2", "TRUE"),
        ("%QX2.2", "FALSE"),
        ("%QW4", "3"),
        ("%QW5", "3"),
        ("%QW6", "3"),
        ("%MD0", "8"),
        ("p.fb.list[2].in", "TRUE"),
    ] {
        let got = plc.get(path);
        assert!(got == want || got == format!("16#{want}"), "{path}: {got}");
    }
    plc.set("%MD0", "100");
    plc.scan(10).unwrap();
    assert_eq!(plc.get("p.m"), "101");
}

#[test]
fn s3_6_the_image_starts_with_the_initial_values() {
    let plc = Plc::new(&with("p.fb.list[3].n : INT := 40;"));
    assert_eq!(plc.get("%QX2.2"), "TRUE");
    assert_eq!(plc.get("p.m"), "7");
    assert!(plc.get("%MD0").contains('7'));
}

#[test]
fn s3_7_initial_values_of_instances() {
    let text = with(
        "p.fb.a.n : INT := 10; r.p.fb.list[3].n : INT := 30; p.t : TON := (PT := T#2s); p.t.IN : BOOL := FALSE; p.x : INT := -5;",
    );
    let plc = Plc::new(&text);
    for (path, want) in [
        ("p.fb.a.n", "10"),
        ("p.fb.list[2].n", "3"),
        ("p.fb.list[3].n", "30"),
        ("p.t.PT", "T#2s"),
        ("p.t.IN", "FALSE"),
        ("p.x", "-5"),
    ] {
        assert_eq!(plc.get(path), want, "{path}");
    }
    // What an initialiser leaves out keeps the value of the declaration.
    assert_eq!(Plc::new(&with("p.t : TON := (PT := T#2s);")).get("p.t.IN"), "TRUE");
}

#[test]
fn s3_7_globals_and_two_programs() {
    let text = "FUNCTION_BLOCK F VAR o AT %Q* : BOOL; n : INT; END_VAR o := NOT o; n := n + 1; END_FUNCTION_BLOCK
    PROGRAM A VAR_EXTERNAL g : F; END_VAR VAR y AT %Q* : INT; END_VAR g(); y := g.n; END_PROGRAM
    CONFIGURATION c RESOURCE r ON PLC VAR_GLOBAL g : F; q AT %Q* : INT := 5; END_VAR
    TASK t (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM a WITH t : A; PROGRAM b WITH t : A; END_RESOURCE
    VAR_CONFIG r.g.o AT %QX0.0 : BOOL; g.n : INT := 20; r.q AT %QW4 : INT; a.y AT %QW1 : INT; b.y AT %QW2 : INT; END_VAR END_CONFIGURATION";
    let mut plc = Plc::new(text);
    assert_eq!(plc.get("q"), "5");
    plc.scan(0).unwrap();
    assert_eq!((plc.get("a.y"), plc.get("b.y"), plc.get("g.o")), ("21".into(), "22".into(), "FALSE".into()));
    assert!(plc.get("%QW2").ends_with("16") || plc.get("%QW2").ends_with("22"), "{}", plc.get("%QW2"));
}

#[test]
fn s3_4_s11_what_is_wrong_with_a_configuration() {
    assert_eq!(error_codes(BLOCKS), ["P3080", "P3080", "P3080", "P3080"]);
    for (config, want) in [
        ("p.y : INT := 1;", "P3081"),
        ("q.x : INT := 1;", "P3081"),
        ("p.fb.list[4].n : INT := 1;", "P3081"),
        ("p.x.y : INT := 1;", "P3081"),
        ("p.x : DINT := 1;", "P3083"),
        ("p : INT := 1;", "P3082"),
        ("p.x : INT := TRUE;", "P2001"),
        ("p.m AT %MD1 : DINT;", "P1001"),
    ] {
        assert_eq!(error_codes(&with(config)), [want], "{config}");
    }
    let one = |declared: &str, config: &str| {
        error_codes(&format!(
            "PROGRAM M {declared} END_PROGRAM CONFIGURATION c VAR_GLOBAL g : INT; END_VAR RESOURCE r ON PLC PROGRAM p : M; END_RESOURCE
            VAR_CONFIG {config} END_VAR END_CONFIGURATION"
        ))
    };
    for (declared, config, want) in [
        ("VAR x AT %Q* : BOOL; END_VAR", "p.x AT %IX0.0 : BOOL;", "P3083"),
        ("VAR x AT %Q* : INT; END_VAR", "p.x AT %QX0.0 : INT;", "P3011"),
        ("VAR x AT %Q* : INT; END_VAR", "p.x AT %Q* : INT;", "P3080"),
        ("VAR x AT %QW4 : INT; END_VAR", "p.x AT %QW9 : INT;", "P3082"),
        ("VAR CONSTANT k : INT := 1; END_VAR", "p.k : INT := 2;", "P3082"),
        ("VAR_TEMP k : INT; END_VAR", "p.k : INT := 2;", "P3082"),
        ("VAR_EXTERNAL g : INT; END_VAR", "p.g : INT := 2;", "P3082"),
        ("VAR_INPUT x AT %I* : INT; END_VAR", "p.x AT %IW0 : INT;", "P3008"),
        ("VAR x AT %I* : INT; END_VAR x := 1;", "p.x AT %IW0 : INT;", "P3013"),
    ] {
        assert!(one(declared, config).contains(&want), "{declared} {config}: {:?}", one(declared, config));
    }
}

#[test]
fn s3_4_derived_blocks_and_methods() {
    let text = |body: &str, config: &str| {
        format!(
            "FUNCTION_BLOCK Base VAR PROTECTED i AT %I* : BOOL; END_VAR VAR PUBLIC o AT %Q* : BOOL; END_VAR METHOD PUBLIC run {body} END_METHOD END_FUNCTION_BLOCK
            FUNCTION_BLOCK Sub EXTENDS Base VAR n : INT; END_VAR END_FUNCTION_BLOCK
            PROGRAM Main VAR s : Sub; END_VAR s.run(); END_PROGRAM
            CONFIGURATION c RESOURCE r ON PLC PROGRAM p : Main; END_RESOURCE VAR_CONFIG {config} END_VAR END_CONFIGURATION"
        )
    };
    let config = "p.s.i AT %IX0.5 : BOOL; p.s.o AT %QX0.6 : BOOL;";
    let mut plc = Plc::new(&text("o := NOT i;", config));
    plc.scan(0).unwrap();
    assert_eq!(plc.get("%QX0.6"), "TRUE");
    plc.set("%IX0.5", "TRUE");
    plc.scan(10).unwrap();
    assert_eq!(plc.get("%QX0.6"), "FALSE");
    assert_eq!(error_codes(&text("o := NOT i;", "p.s.i AT %IX0.5 : BOOL;")), ["P3080"]);
    assert_eq!(error_codes(&text("i := o;", config)), ["P3013"]);
}
