//! Recovery: how many messages a mistake gives, where they stand, and what of the file survives.

use super::*;
use takt_base::diag::Code;

/// Messages of a file, and what is left of it: `recovers(text, messages, tree)`.
fn recovers(text: &str, want: &[&str], tree: &str) {
    let (file, diags, sources) = parse(text);
    let messages: String = diags.iter().map(|d| render(d, &sources)).collect();
    assert_eq!(codes(text), want, "{text}\n{messages}");
    assert_eq!(print::file(&file), tree, "{text}");
}

#[test]
fn statements_behind_a_mistake_survive() {
    let cases = [
        ("x := ;", "P0010 2:6", "(:= x ?)"),
        ("x := 1 2;", "P0010 2:8", "(:= x 1)"),
        ("x := (1 + ;", "P0010 2:11", "(:= x (+ 1 ?))"),
        ("x := f(1, , 2);", "P0010 2:11", "(:= x (call f 1 ?))"),
        ("x := a[;", "P0010 2:8", "(:= x a[?])"),
        ("x := 1", "P0010 2:7", "(:= x 1)"),
        ("x y := 1;", "P0010 2:3", "?"),
        ("x;", "P0010 2:2", "?"),
        ("1 := x;", "P0010 2:1", "?"),
        (") x := 1;", "P0010 2:1", "?"),
        ("THEN x := 1;", "P0010 2:1", "?"),
        ("x := a.;", "P0010 2:8", "(:= x ?)"),
        ("x : = 1;", "P0010 2:3", "?"),
        ("x := a =< b;", "P0010 2:9", "(:= x (= a ?))"),
        ("IF THEN x := 1; END_IF;", "P0010 2:4", "(if ? {(:= x 1)})"),
        ("IF a THEN x := ; END_IF;", "P0010 2:16", "(if a {(:= x ?)})"),
        ("IF a x := 1; END_IF;", "P0010 2:5", "(if a {(:= x 1)})"),
        ("WHILE DO END_WHILE;", "P0010 2:7", "(while ? {})"),
        ("FOR i 1 TO 2 DO x := 1; END_FOR;", "P0010 2:7", "(for i ? ? {(:= x 1)})"),
        ("FOR i := 1 DO x := 1; END_FOR;", "P0010 2:12", "(for i 1 ? {(:= x 1)})"),
        ("REPEAT x := 1; END_REPEAT;", "P0010 2:16", "(repeat {(:= x 1)} ?)"),
        ("CASE a OF 1 x := 1; END_CASE;", "P0010 2:12", "(case a (1 {(:= x 1)}))"),
        ("ELSE x := 1;", "P0010 2:1", "(:= x 1)"),
        ("END_FOR; x := 1;", "P0010 2:1", "(:= x 1)"),
        ("x := 'a;\n;", "P0003 2:6", "(:= x ?)"),
    ];
    for (body, message, tree) in cases {
        let text = format!("PROGRAM p\n{body}\ny := 2;\nEND_PROGRAM\nPROGRAM q\nEND_PROGRAM");
        let tree = format!("(program p {tree} (:= y 2)) (program q)");
        recovers(&text, &[message], &tree);
    }
}

#[test]
fn declarations_behind_a_mistake_survive() {
    let cases = [
        ("x INT;", "P0010 2:3", ""),
        ("x : ;", "P0010 2:5", "(x : ?) "),
        ("x : INT := ;", "P0010 2:12", "(x : INT := ?) "),
        ("x : ARRAY 1..2 OF INT;", "P0010 2:11", "(x : ?) "),
        ("x : ARRAY [1..2] INT;", "P0010 2:18", "(x : ?) "),
        ("x : ARRAY [1] OF INT;", "P0010 2:13", "(x : ?) "),
        ("x AT y : INT;", "P0010 2:6", ""),
        ("x : INT := 1, 2;", "P0010 2:13", "(x : INT := 1) "),
        ("x : INT", "P0010 2:8", "(x : INT) "),
        ("5 : INT;", "P0010 2:1", ""),
        ("x, : INT;", "P0010 2:4", ""),
        ("x : P := (a := );", "P0010 2:16", "(x : P := {a=?}) "),
    ];
    for (decl, message, tree) in cases {
        let text = format!("PROGRAM p VAR\n{decl}\ny : INT;\nEND_VAR\ny := 2;\nEND_PROGRAM\nPROGRAM q\nEND_PROGRAM");
        recovers(&text, &[message], &format!("(program p (var {tree}(y : INT)) (:= y 2)) (program q)"));
    }
}

#[test]
fn units_behind_a_mistake_survive() {
    recovers("PROGRAM\nEND_PROGRAM\nPROGRAM q\nEND_PROGRAM", &["P0010 2:1"], "(program) (program q)");
    recovers("PROGRAM p\nFUNCTION f : INT\nEND_FUNCTION", &["P0010 2:1"], "(program p) (function f : INT)");
    recovers("PROGRAM p\nEND_FUNCTION\nPROGRAM q\nEND_PROGRAM", &["P0010 2:1"], "(program p) (program q)");
    recovers("FUNCTION f : \nEND_FUNCTION\nPROGRAM q\nEND_PROGRAM", &["P0010 2:1"], "(function f : ?) (program q)");
    recovers("x := 1;\ny := 2;\nPROGRAM q\nEND_PROGRAM", &["P0010 1:1"], "(program q)");
    recovers("END_PROGRAM\nPROGRAM q\nEND_PROGRAM", &["P0010 1:1"], "(program q)");
    recovers("TYPE a : ; b : INT; END_TYPE PROGRAM q END_PROGRAM", &["P0010 1:10"], "(type a ?) (type b INT) (program q)");
    recovers("TYPE a : INT;\nPROGRAM q END_PROGRAM", &["P0010 2:1"], "(type a INT) (program q)");
    recovers("PROGRAM p VAR x : INT;\nPROGRAM q END_PROGRAM", &["P0010 2:1"], "(program p (var (x : INT))) (program q)");
    recovers("RESOURCE r ON PLC PROGRAM a : B; END_RESOURCE PROGRAM q END_PROGRAM", &["P0010 1:1"], "(program q)");
    recovers(
        "CONFIGURATION c TASK t; PROGRAM a : B; END_CONFIGURATION",
        &["P0010 1:23"],
        "(configuration c (resource (task t) (instance a : B)))",
    );
}

#[test]
fn two_mistakes_give_two_messages() {
    let text = "PROGRAM p\nx := ;\nIF a\n  y := );\nEND_IF;\nz := 1 +;\nEND_PROGRAM";
    assert_eq!(codes(text), ["P0010 2:6", "P0010 3:5", "P0010 4:8", "P0010 6:9"]);
}

#[test]
fn an_unclosed_statement_is_reported_once() {
    let text = "PROGRAM p\nWHILE a DO\nIF b THEN\nFOR i := 1 TO 2 DO\nx := 1;\nEND_PROGRAM\nPROGRAM q\nEND_PROGRAM";
    recovers(text, &["P0010 6:1"], "(program p (while a {(if b {(for i 1 2 {(:= x 1)})})})) (program q)");
    assert_eq!(codes("PROGRAM p\nIF a THEN\nFOR i := 1 TO 2 DO\nx := 1;\nEND_IF;\ny := 1;\nEND_PROGRAM"), ["P0010 5:1"]);
}

/// The first example of every page of a code of this stage gives that code; P0011 and P0013 are too long for a page.
#[test]
fn the_pages_of_the_codes_show_what_they_describe() {
    let codes_here = Code::ALL.iter().filter(|c| c.text().starts_with("P0") || **c == Code::KeywordAsName);
    for code in codes_here.filter(|c| !matches!(c, Code::NestedTooDeep | Code::TooMuch)) {
        let example = code.page().split("```st\n").nth(1).and_then(|s| s.split("```").next()).unwrap_or("");
        let got = codes(example);
        assert!(!got.is_empty() && got.iter().all(|c| c.starts_with(code.text())), "{}: {got:?}", code.text());
    }
}
