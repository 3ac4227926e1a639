//! VAR_ACCESS (IEC 61131-3 reference §3.8): names for variables, with a type and a direction, in configurations and programs.

use takt_image::image::Access;
use takt_image::path::resolve;
use takt_image::value::Patch;
use takt_tests::plc::{Plc, error_codes};

const UNITS: &str = "TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
FUNCTION_BLOCK Lamp VAR_INPUT lit : BOOL; END_VAR VAR q AT %Q* : BOOL; END_VAR VAR_OUTPUT n : DINT; END_VAR q := lit; n := n + 1; END_FUNCTION_BLOCK
PROGRAM Main VAR_INPUT i, c : INT; END_VAR VAR_OUTPUT z : DINT; END_VAR VAR CONSTANT k : INT := 4; END_VAR
VAR lamps : ARRAY [1..2] OF Lamp; p : Pair; m AT %MW4 : INT; in AT %I* : INT; list AT %MW8 : ARRAY [0..3] OF INT; END_VAR VAR_TEMP t : INT; END_VAR
VAR_ACCESS Own : lamps[2].n : DINT; Speed : i : INT READ_WRITE; Bit0 : %IX3.0 : BOOL READ_ONLY; END_VAR
z := z + 1; lamps[1](lit := z > 0); lamps[2](); END_PROGRAM";

fn plant(access: &str) -> String {
    format!(
        "{UNITS} CONFIGURATION Cell VAR_GLOBAL g : INT := 3; gp : Pair; END_VAR VAR_GLOBAL CONSTANT gk : INT := 9; END_VAR
        RESOURCE STATION ON PLC VAR_GLOBAL own : REAL := 2.5; inp AT %IW5 : INT; END_VAR PROGRAM P1 : Main (c := g); END_RESOURCE
        VAR_ACCESS {access} END_VAR
        VAR_CONFIG P1.lamps[1].q AT %QX0.1 : BOOL; P1.lamps[2].q AT %QX0.2 : BOOL; P1.in AT %IW6 : INT; END_VAR END_CONFIGURATION"
    )
}

fn codes(access: &str) -> Vec<&'static str> {
    error_codes(&plant(access))
}

#[test]
fn s3_8_a_path_is_the_variable() {
    let mut plc = Plc::new(&plant(
        "ABLE : STATION.%IX1.1 : BOOL READ_ONLY; BAKER : STATION.P1.z : DINT READ_WRITE; CHARLIE : STATION.own : REAL READ_WRITE;
        DOG : P1.lamps[1].n : DINT; EASY : P1.lamps[1].q : BOOL READ_WRITE; FOX : P1.p.b : INT READ_WRITE; GEORGE : g : INT;
        HOW : P1.list[2] : INT READ_WRITE; ITEM : P1.m : INT READ_WRITE; JIG : gp : Pair READ_WRITE; WORD0 : %QW3 : INT READ_WRITE; KING : P1.lamps : ARRAY [1..2] OF Lamp;",
    ));
    for (path, value) in
        [("BAKER", "40"), ("fox", "7"), ("HOW", "12"), ("ITEM", "13"), ("JIG.a", "8"), ("WORD0", "-2"), ("%IX1.1", "TRUE")]
    {
        plc.set(path, value);
    }
    plc.scan(0).unwrap();
    for (path, want) in [
        ("ABLE", "TRUE"),
        ("P1.z", "41"),
        ("BAKER", "41"),
        ("CHARLIE", "2.5"),
        ("DOG", "1"),
        ("EASY", "TRUE"),
        ("P1.p.b", "7"),
        ("GEORGE", "3"),
        ("P1.list[2]", "12"),
        ("P1.m", "13"),
        ("gp.a", "8"),
        ("WORD0", "-2"),
        ("%QW3", "65534"),
        ("P1.Own", "1"),
        ("P1.Bit0", "FALSE"),
    ] {
        assert_eq!(plc.get(path), want, "{path}");
    }
    plc.set("P1.Speed", "21");
    assert_eq!(plc.get("P1.i"), "21");
    assert!(plc.image.symbols.iter().any(|s| s.name == "DOG" && s.access == Some(Access::ReadOnly)));
}

#[test]
fn s3_8_a_path_without_a_direction_is_read_only() {
    let plc = Plc::new(&plant("A : g : INT; B : g : INT READ_ONLY; C : g : INT READ_WRITE; D : gp : Pair;"));
    for (path, writable) in [("A", false), ("B", false), ("C", true), ("D.a", false), ("P1.Own", false), ("P1.Speed", true)] {
        assert_eq!(resolve(&plc.image, path).unwrap().read_only, !writable, "{path}");
        let written = Patch::from_path(&plc.image, path, "1");
        assert_eq!(written.is_ok(), writable, "{path}");
        if let Err(e) = written {
            assert_eq!(e.code.text(), "C0009");
        }
    }
}

#[test]
fn s3_8_s11_what_is_wrong_with_paths() {
    for (access, want) in [
        ("A : P1.zz : INT;", "P3081"),
        ("A : P2.z : DINT;", "P3081"),
        ("A : OTHER.P1.z : DINT;", "P3081"),
        ("A : OTHER.%IX0.0 : BOOL;", "P3081"),
        ("A : P1.lamps[3].n : DINT;", "P3081"),
        ("A : P1.z : INT;", "P3083"),
        ("A : STATION.%IX1.1 : INT;", "P3083"),
        ("A : %IX1.9 : BOOL;", "P0008"),
        ("A : P1.z : Nope;", "P1004"),
        ("A : P1.t : INT;", "P3082"),
        ("A : P1.k : INT READ_WRITE;", "P3084"),
        ("A : gk : INT READ_WRITE;", "P3084"),
        ("A : %IW1 : INT READ_WRITE;", "P3084"),
        ("A : inp : INT READ_WRITE;", "P3084"),
        ("A : P1.in : INT READ_WRITE;", "P3084"),
        ("A : P1.c : INT READ_WRITE;", "P3084"),
        ("A : g : INT; a : g : INT;", "P1001"),
        ("g : g : INT;", "P1001"),
        ("P1 : g : INT;", "P1001"),
        ("A : g;", "P0010"),
    ] {
        assert_eq!(codes(access), [want], "{access}");
    }
    for right in
        ["A : P1.k : INT READ_ONLY;", "A : inp : INT;", "A : P1.c : INT;", "A : P1.i : INT READ_WRITE;", "A : P1.in : INT;"]
    {
        assert_eq!(codes(right), [""; 0], "{right}");
    }
}

#[test]
fn s3_8_paths_of_programs() {
    let in_unit = |kind: &str, path: &str| {
        let text = format!(
            "{kind} Main VAR_INPUT i : INT; END_VAR VAR x : INT; END_VAR VAR_EXTERNAL g : INT; END_VAR VAR_ACCESS {path} END_VAR x := i + g; END_{kind}
            PROGRAM Last VAR y : INT; END_VAR END_PROGRAM
            CONFIGURATION c VAR_GLOBAL g : INT; END_VAR RESOURCE r ON PLC PROGRAM l : Last; PROGRAM m : {}; END_RESOURCE END_CONFIGURATION",
            if kind == "PROGRAM" { "Main (i := g)" } else { "Last" }
        );
        error_codes(&text)
    };
    for (path, want) in [
        ("A : x : DINT;", "P3083"),
        ("A : zz : INT;", "P3081"),
        ("A : g : INT;", "P3082"),
        ("A : i : INT READ_WRITE;", "P3084"),
        ("x : x : INT;", "P1001"),
        ("A : x : INT; A : x : INT;", "P1001"),
    ] {
        assert_eq!(in_unit("PROGRAM", path), [want], "{path}");
    }
    assert_eq!(in_unit("PROGRAM", "A : x : INT READ_WRITE;"), [""; 0]);
    assert_eq!(in_unit("FUNCTION_BLOCK", "A : x : INT;"), ["P3008"]);
}

#[test]
fn s3_8_paths_of_several_resources() {
    let text = "PROGRAM Main VAR z : DINT; END_VAR VAR_ACCESS Own : z : DINT READ_WRITE; END_VAR VAR_EXTERNAL g : INT; END_VAR z := z + g; END_PROGRAM
    CONFIGURATION c RESOURCE A ON PLC VAR_GLOBAL g : INT := 1; END_VAR PROGRAM p : Main; END_RESOURCE
    RESOURCE B ON PLC VAR_GLOBAL g : INT := 10; END_VAR PROGRAM p : Main; END_RESOURCE
    VAR_ACCESS X : A.p.z : DINT; Y : B.p.z : DINT; GA : A.g : INT READ_WRITE; GB : B.g : INT; END_VAR END_CONFIGURATION";
    let mut plc = Plc::new(text);
    plc.set("GA", "5");
    plc.set("B.p.Own", "100");
    plc.scan(0).unwrap();
    for (path, want) in [("X", "5"), ("Y", "110"), ("A.p.Own", "5"), ("B.p.Own", "110"), ("GB", "10")] {
        assert_eq!(plc.get(path), want, "{path}");
    }
    let ambiguous = text.replace("X : A.p.z", "X : p.z");
    assert!(Plc::load(&ambiguous).is_err_and(|m| m.contains("several resources have it")));
}
