//! Parts of the language that this version lacks: one `P0012` that names the construct, and the parser goes on behind it.

use super::*;

/// The only message is a P0012 that names `what`; the unit behind the text is found.
fn lacks(what: &str, text: &str) {
    let (file, diags, sources) = parse(&format!("{text}\nPROGRAM last\nx := 1;\nEND_PROGRAM"));
    let shown: String = diags.iter().map(|d| render(d, &sources)).collect();
    assert!(diags.len() == 1 && diags[0].code == Code::NotSupportedYet, "{text}\n{shown}");
    assert!(diags[0].message.contains(what), "{what} in\n{shown}");
    let printed = print::file(&file);
    assert!(printed.ends_with("(program last (:= x 1))"), "{text}\n{printed}");
}

#[test]
fn sections_and_types() {
    lacks(
        "not supported",
        "CONFIGURATION c TASK t(MULTI := [%IX0.0, %IX0.1], PRIORITY := 1); PROGRAM p WITH t : m; END_CONFIGURATION",
    );
}

#[test]
fn statements() {
    lacks("__TRY", "PROGRAM p VAR x : INT; END_VAR __TRY x := 1; __CATCH(e) x := 2; __FINALLY x := 3; __ENDTRY; END_PROGRAM");
    lacks("inline C", "PROGRAM p {extern int x;} x := 1; END_PROGRAM");
}

#[test]
fn charts() {
    let chart = "INITIAL_STEP s0: act(N); END_STEP TRANSITION t1 FROM s0 TO s1 := x > 1; END_TRANSITION STEP s1: END_STEP \
        ACTION act: y := 1; END_ACTION";
    lacks("Sequential Function Chart", &format!("PROGRAM p VAR x : INT; END_VAR {chart} END_PROGRAM"));
}

/// A construct without its end does not take the rest of the file with it.
#[test]
fn an_open_construct_ends_at_the_next_unit() {
    let printed = |text: &str| print::file(&parse(text).0);
    let open = printed("FUNCTION_BLOCK b METHOD m x := 1; END_FUNCTION_BLOCK PROGRAM p END_PROGRAM");
    assert_eq!(open, "(fb b (method m (:= x 1))) (program p)");
    assert_eq!(printed("CLASS c METHOD m END_METHOD PROGRAM p END_PROGRAM"), "(class c (method m)) (program p)");
    assert_eq!(printed("PROGRAM a VAR_CONFIG x.y : INT; END_PROGRAM PROGRAM p END_PROGRAM"), "(program a) (program p)");
}

/// Forms of another profile are understood and named.
#[test]
fn vendor_forms() {
    assert_eq!(codes("PROGRAM p x S= y AND z; END_PROGRAM"), ["P0014 1:13"]);
    assert_eq!(codes("PROGRAM p x := y := 1; x := 1; END_PROGRAM"), ["P0014 1:18"]);
}
