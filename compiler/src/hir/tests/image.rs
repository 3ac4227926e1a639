//! Direct addresses and located variables (language reference §3.4).

use super::*;
use takt_image::image::Place as At;

fn places(text: &str) -> (Vec<Storage>, [u32; 3]) {
    let built = build(text);
    assert_eq!(built.codes(), "");
    (built.pou("p").vars.iter().map(|v| v.storage).collect(), built.hir.image_bytes)
}

/// Areas begin behind the header of 64 bytes, each at a multiple of 8.
#[test]
fn areas_follow_each_other_and_views_overlap() {
    let text = "PROGRAM p VAR a AT %IX1.2 : BOOL; b AT %IW1 : INT; c AT %QD1 : REAL; d AT %MB3 : SINT; e AT %IX13 : BOOL; \
        f AT %QW2 : ARRAY [0..3] OF INT; END_VAR %ML1 := LWORD#16#0; END_PROGRAM";
    let (vars, bytes) = places(text);
    let want = [At::Bit(65, 2), At::Byte(66), At::Byte(76), At::Byte(91), At::Bit(65, 5), At::Byte(76)];
    assert_eq!(vars, want.map(Storage::Image));
    assert_eq!(bytes, [4, 12, 16]);
}

#[test]
fn globals_are_located_too() {
    let built = build("VAR_GLOBAL g AT %QX0.0 : BOOL := TRUE; AT %MW2 : INT := 7; END_VAR PROGRAM p END_PROGRAM");
    assert_eq!(built.codes(), "");
    let globals: Vec<_> = built.hir.globals.iter().map(|g| (g.name.as_str(), g.place, show(&g.init))).collect();
    assert_eq!(globals, [("g", Some(At::Bit(64, 0)), "1".to_owned()), ("%MW2", Some(At::Byte(76)), "7".to_owned())]);
}

#[test]
fn what_an_address_takes() {
    expect(
        check,
        &[
            ("PROGRAM p VAR a AT %QX0.0 : INT; END_VAR END_PROGRAM", "P3011 1:20"),
            ("PROGRAM p VAR a AT %QW0 : DINT; END_VAR END_PROGRAM", "P3011 1:20"),
            ("PROGRAM p VAR a AT %QD0 : TIME; END_VAR END_PROGRAM", "P3011 1:20"),
            ("PROGRAM p VAR a AT %QL0 : TIME; END_VAR END_PROGRAM", ""),
            ("PROGRAM p VAR a AT %QB0 : BOOL; END_VAR END_PROGRAM", "P3011 1:20"),
            ("PROGRAM p VAR a AT %QB0 : STRING; END_VAR END_PROGRAM", "P3011 1:20"),
            ("PROGRAM p VAR a AT %QX0.0 : ARRAY [0..7] OF BOOL; END_VAR END_PROGRAM", "P3011 1:20"),
            ("PROGRAM p VAR a AT %QB0 : CHAR; b AT %QW4 : (x, y); c AT %QW8 : INT (0..5); END_VAR END_PROGRAM", ""),
            ("PROGRAM p VAR a AT %QX0.8 : BOOL; END_VAR END_PROGRAM", "P0008 1:20"),
            ("PROGRAM p VAR a AT %I* : BOOL; END_VAR END_PROGRAM", "P3080 1:15"),
            ("PROGRAM p VAR a AT %QB65536 : BYTE; END_VAR END_PROGRAM", "P2016 1:20"),
            ("PROGRAM p VAR a AT %QB65535 : BYTE; b AT %QD16383 : DWORD; END_VAR END_PROGRAM", ""),
            ("PROGRAM p VAR a AT %QB65535 : ARRAY [0..1] OF BYTE; END_VAR END_PROGRAM", "P2016 1:20"),
            ("PROGRAM p VAR a AT %QW1.2 : INT; END_VAR END_PROGRAM", ""),
            ("PROGRAM p VAR b : BYTE; END_VAR b := %IB70000; END_PROGRAM", "P2016 1:38"),
            ("FUNCTION_BLOCK b VAR a AT %QX0.0 : BOOL; END_VAR END_FUNCTION_BLOCK", "P3008 1:27"),
            ("PROGRAM p VAR_INPUT a AT %QX0.0 : BOOL; END_VAR END_PROGRAM", "P3008 1:26"),
            ("FUNCTION f VAR a AT %QX0.0 : BOOL; END_VAR END_FUNCTION", "P3008 1:21"),
        ],
    );
}

/// The type of an address is that of its size.
#[test]
fn addresses_in_expressions() {
    expect(
        expr,
        &[("%IX0.0", "BOOL"), ("%IB0", "BYTE"), ("%IW0", "WORD"), ("%QD0", "DWORD"), ("%ML0", "LWORD"), ("%I5", "BOOL")],
    );
    expect(expr, &[("%IX0.9", "P0008"), ("%IW1.2", "WORD")]);
}
