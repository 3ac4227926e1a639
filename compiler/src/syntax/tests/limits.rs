//! What is too large or never ends: a message or a tree, in linear time, never a panic.

use super::*;
use std::time::{Duration, Instant};

/// Parses in time that only a loop over the text can reach; gives the codes of the messages.
fn bounded(text: &str) -> Vec<String> {
    let start = Instant::now();
    let codes = codes(text);
    let took = start.elapsed();
    assert!(took < Duration::from_secs(10), "{took:?} for {}..", text.chars().take(60).collect::<String>());
    codes
}

fn body(text: &str) -> String {
    format!("PROGRAM p\n{text}\nEND_PROGRAM\nPROGRAM q\nEND_PROGRAM")
}

/// One `P0011` for nesting that is closed again, and the unit behind it is still found.
#[test]
fn deep_nesting_is_one_message() {
    let n = 10_000;
    let nested = |open: &str, middle: &str, close: &str| body(&format!("{}{middle}{}", open.repeat(n), close.repeat(n)));
    let texts = [
        format!("PROGRAM p x := {}1{}; END_PROGRAM PROGRAM q END_PROGRAM", "(".repeat(n), ")".repeat(n)),
        format!("PROGRAM p x := {}1{}; END_PROGRAM PROGRAM q END_PROGRAM", "f(a := ".repeat(n), ")".repeat(n)),
        format!("PROGRAM p x := {}1{}; END_PROGRAM PROGRAM q END_PROGRAM", "a[".repeat(n), "]".repeat(n)),
        format!("PROGRAM p x := {}y; END_PROGRAM PROGRAM q END_PROGRAM", "NOT ".repeat(n)),
        format!("PROGRAM p x := {}y; END_PROGRAM PROGRAM q END_PROGRAM", "- ".repeat(n)),
        format!("PROGRAM p x := y{}; END_PROGRAM PROGRAM q END_PROGRAM", " + y".repeat(n)),
        format!("PROGRAM p x := y{}; END_PROGRAM PROGRAM q END_PROGRAM", ".y".repeat(n)),
        format!("PROGRAM p x := y{}; END_PROGRAM PROGRAM q END_PROGRAM", "[1]".repeat(n)),
        format!("PROGRAM p x{}(); END_PROGRAM PROGRAM q END_PROGRAM", "()".repeat(n)),
        format!("PROGRAM p VAR x : {}INT; END_VAR END_PROGRAM PROGRAM q END_PROGRAM", "ARRAY [0..1] OF ".repeat(n)),
        format!("PROGRAM p VAR x : INT := {}1{}; END_VAR END_PROGRAM PROGRAM q END_PROGRAM", "[".repeat(n), "]".repeat(n)),
        format!("PROGRAM p VAR x : S := {}1{}; END_VAR END_PROGRAM PROGRAM q END_PROGRAM", "(a := ".repeat(n), ")".repeat(n)),
        nested("IF x THEN\n", "y();", "END_IF;\n"),
        nested("IF x THEN ELSE ", "y();", " END_IF;"),
        nested("WHILE x DO\n", "y();", "END_WHILE;\n"),
        nested("REPEAT\n", "y();", "UNTIL x END_REPEAT;\n"),
        nested("FOR i := 1 TO 2 DO\n", "y();", "END_FOR;\n"),
        nested("CASE x OF 1:\n", "y();", "END_CASE;\n"),
    ];
    for text in texts {
        let found = bounded(&text);
        assert!(found.len() == 1 && found[0].starts_with("P0011"), "{found:?} for {}", text.chars().take(60).collect::<String>());
        assert_eq!(parse(&text).0.items.len(), 2, "{}", text.chars().take(60).collect::<String>());
    }
}

/// The height of a tree counts through the arguments of calls, also of those that are not supported.
#[test]
fn heights_add_up_through_arguments() {
    let nested = |assign: &str, levels: usize| {
        let (open, close) = (format!("f({assign} "), format!("{})", " + y".repeat(99)));
        codes(&format!("PROGRAM p x := {}1{}; END_PROGRAM", open.repeat(levels), close.repeat(levels)))
    };
    for assign in ["", "a :=", "a ?="] {
        let too_deep = |levels| nested(assign, levels).iter().any(|c| c.starts_with("P0011"));
        assert_eq!((too_deep(2), too_deep(3)), (false, true), "{assign}");
    }
}

#[test]
fn long_lists_have_no_limit() {
    let n = 20_000;
    let ok = |text: String| assert_eq!(bounded(&text), Vec::<String>::new(), "{}", text.chars().take(60).collect::<String>());
    ok(body(&"x := y; ".repeat(n)));
    ok(body(&format!("IF a THEN {} END_IF", "ELSIF b THEN x(); ".repeat(n))));
    ok(body(&format!("CASE a OF {} END_CASE", "1: x(); ".repeat(n))));
    ok(body(&format!("CASE a OF {}2: ; END_CASE", "1, ".repeat(n))));
    ok(body(&format!("f({}1);", "1, ".repeat(n))));
    ok(body(&format!("f({}b := 1);", "a := 1, ".repeat(n))));
    ok(format!("PROGRAM p VAR {}x : INT; END_VAR END_PROGRAM", "x, ".repeat(n)));
    ok(format!("TYPE e : ({}x); END_TYPE", "x, ".repeat(n)));
    ok(format!("TYPE e : STRUCT {} END_STRUCT; END_TYPE", "x : INT;".repeat(n)));
    ok("PROGRAM p END_PROGRAM ".repeat(n));
    ok(format!("{}{} PROGRAM p END_PROGRAM", "(*".repeat(n), "*)".repeat(n)));
}

/// A part that is opened and never closed gives few messages, whatever it is and however often.
#[test]
fn unterminated_everything() {
    let n = 10_000;
    let openers = [
        "(",
        "[",
        "f(",
        "a[",
        "IF ",
        "IF x THEN\n",
        "CASE x OF\n",
        "CASE x OF 1:",
        "FOR ",
        "FOR i := 1; ",
        "FOR i := 1 TO 2 DO\n",
        "WHILE x DO\n",
        "REPEAT\n",
        "NOT ",
        "x := (",
        "x := f(a := ",
        "VAR ",
        "VAR x : ",
        "{",
        "(*",
        "/*",
        "x := ARRAY [",
        "TYPE ",
        "STRUCT ",
    ];
    for opener in openers {
        for text in [body(&opener.repeat(n)), opener.repeat(n), format!("PROGRAM p {}", opener.repeat(n))] {
            let found = bounded(&text);
            assert!(!found.is_empty(), "{opener}");
        }
    }
    for opener in [
        "PROGRAM ",
        "PROGRAM p ",
        "FUNCTION f : ",
        "TYPE x : ",
        "VAR_GLOBAL ",
        "CLASS c ",
        "NAMESPACE n ",
        "CONFIGURATION c ",
        "RESOURCE r ON x ",
    ] {
        assert!(!bounded(&opener.repeat(n)).is_empty(), "{opener}");
    }
    for opener in ["TYPE x : STRUCT ", "TYPE x : ARRAY [0..1] OF ", "TYPE x : REF_TO ", "TYPE x : POINTER TO "] {
        assert!(!bounded(&format!("TYPE x : {}", opener.trim_start_matches("TYPE x : ").repeat(n))).is_empty(), "{opener}");
    }
}

/// One token of 1 MiB, of every kind.
#[test]
fn one_long_token() {
    let n = 1 << 20;
    for (open, fill, close) in [
        ("", "a", ""),
        ("", "1", ""),
        ("16#", "F", ""),
        ("1.", "0", ""),
        ("1e", "9", ""),
        ("'", "x", "'"),
        ("'", "x", ""),
        ("'", "$N", "'"),
        ("\"", "x", "\""),
        ("T#", "1", "s"),
        ("T#", "1s", ""),
        ("T#1.", "3", "s"),
        ("D#", "1", ""),
        ("DT#", "1-", ""),
        ("TOD#", "1:", ""),
        ("%I", "1.", "1"),
        ("%", "X", ""),
        ("", "_", ""),
        ("", "a_", ""),
        ("", "(*", ""),
        ("(*", "x", "*)"),
        ("{", "x", "}"),
        ("//", "x", ""),
        ("", "$", ""),
        ("", "\u{20ac}", ""),
        ("", "#", ""),
        ("", "a#", ""),
        ("INT#", "9", ""),
        ("", ".", ""),
        ("", "*", ""),
        ("", "=", ""),
        ("", " ", "1"),
        ("", "\n", "1"),
        ("", "\u{e4}", ""),
        ("1", "_", ""),
    ] {
        let token = format!("{open}{}{close}", fill.repeat(n / fill.len()));
        bounded(&format!("PROGRAM p x := {token}\n; END_PROGRAM"));
        bounded(&token);
    }
}

/// A binary file gives a bounded number of messages, the last of which says so.
#[test]
fn messages_are_bounded() {
    let found = bounded(&body(&"$;".repeat(100_000)));
    assert_eq!(found.len(), 201);
    assert!(found[200].starts_with("P0013"));
    assert!(bounded(&body(&") ".repeat(100_000))).len() <= 201);
    assert!(bounded(&body(&"x := ;\n".repeat(100_000))).len() <= 201);
}

/// A mistake before a CASE label once kept the parser at the label for ever.
#[test]
fn a_mistake_before_case_labels_ends() {
    for text in [
        "PROGRAM p CASE -k OF OF -5. 10..100, 200:",
        "PROGRAM p CASE OF 1: 2",
        "PROGRAM p CASE ( OF 1, 2: x := 1; END_CASE; END_PROGRAM",
    ] {
        assert!(!codes(text).is_empty());
    }
}
