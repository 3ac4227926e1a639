//! One mistake gives one message at the right place, and what follows is still read.

use super::*;

/// Exactly these messages, `code line:column`; the unit behind the text is found and whole.
fn finds(text: &str, want: &[&str]) {
    let text = format!("{text}\nPROGRAM last\nx := 1;\nEND_PROGRAM");
    assert_eq!(codes(&text), want, "{text}");
    let printed = print::file(&parse(&text).0);
    assert!(printed.ends_with("(program last (:= x 1))"), "{text}\n{printed}");
}

/// The same for statements in a program; the statements behind them are found too.
fn finds_in_body(text: &str, want: &[&str]) {
    finds(&format!("PROGRAM p\n{text}\nEND_PROGRAM"), want);
    let printed = print::file(&parse(&format!("PROGRAM p\n{text}\nlast();\nEND_PROGRAM")).0);
    assert!(printed.contains("(call last)"), "{text}\n{printed}");
}

#[test]
fn expressions() {
    finds_in_body("x := ;\ny := 1;", &["P0010 2:6"]);
    finds_in_body("x := a + ;\ny := b *;", &["P0010 2:10", "P0010 3:9"]);
    finds_in_body("x := (a + b;\ny := 1;", &["P0010 2:12"]);
    finds_in_body("x := a + b);", &["P0010 2:11"]);
    finds_in_body("x := f(a, ;", &["P0010 2:11"]);
    finds_in_body("x := f(a b);", &["P0010 2:10"]);
    finds_in_body("x := a[1;", &["P0010 2:9"]);
    finds_in_body("x := a b;", &["P0010 2:8"]);
    finds_in_body("x := 1 2 3;", &["P0010 2:8"]);
    finds_in_body("x := a.;", &["P0010 2:8"]);
    finds_in_body("x := .5;", &["P0005 2:6"]);
    finds_in_body("x := a == b && c != d || e;", &["P0010 2:8", "P0010 2:13", "P0010 2:18", "P0010 2:23"]);
    finds_in_body("x := a => b;", &["P0010 2:8"]);
    finds_in_body("x := a % b;", &["P0010 2:8"]);
    finds_in_body("x := !a;", &["P0010 2:6"]);
    finds_in_body("x := 'abc;\ny := 1;", &["P0003 2:6"]);
    finds_in_body("x := a =< b;\ny := c >< d;", &["P0010 2:9", "P0010 3:9"]);
}

#[test]
fn statements() {
    finds_in_body("x := 1\ny := 2;", &["P0010 2:7"]);
    finds_in_body("x = 1;\ny == 2;", &["P0010 2:3", "P0010 3:3"]);
    finds_in_body("x += 1;\ny -= 2;", &["P0010 2:3", "P0010 3:3"]);
    finds_in_body("x++;", &["P0010 2:2"]);
    finds_in_body("x : = 1;", &["P0010 2:3"]);
    finds_in_body("x;", &["P0010 2:2"]);
    finds_in_body("5 := x;", &["P0010 2:1"]);
    finds_in_body(") x := 1;", &["P0010 2:1"]);
    finds_in_body("THEN x := 1;", &["P0010 2:1"]);
    finds_in_body("f(1)\ng(2);", &["P0010 2:5"]);
    finds_in_body("x := 1; # y := 2;", &["P0010 2:9"]);
}

#[test]
fn missing_parts() {
    finds_in_body("IF a\n  b();\nEND_IF;", &["P0010 2:5"]);
    finds_in_body("IF a b(); END_IF;", &["P0010 2:5"]);
    finds_in_body("IF a DO b(); END_IF;", &["P0010 2:6"]);
    finds_in_body("IF THEN b(); END_IF;", &["P0010 2:4"]);
    finds_in_body("IF a := 1 THEN b(); END_IF;", &["P0010 2:6"]);
    finds_in_body("WHILE a\n  b();\nEND_WHILE;", &["P0010 2:8"]);
    finds_in_body("WHILE a THEN b(); END_WHILE;", &["P0010 2:9"]);
    finds_in_body("FOR i := 1 TO 3\n  b();\nEND_FOR;", &["P0010 2:16"]);
    finds_in_body("FOR i = 1 TO 3 DO b(); END_FOR;", &["P0010 2:7"]);
    finds_in_body("FOR i := 1 DO b(); END_FOR;", &["P0010 2:12"]);
    finds_in_body("FOR i := 0; i < 10; i++ DO b(); END_FOR;", &["P0010 2:11"]);
    finds_in_body("FOR i TO 3 DO b(); END_FOR;", &["P0010 2:7"]);
    finds_in_body("FOR i := 1, 3 DO b(); END_FOR;", &["P0010 2:11"]);
    finds_in_body("CASE x 1: b(); END_CASE;", &["P0010 2:8"]);
    finds_in_body("CASE x OF b(); END_CASE;", &["P0010 2:11"]);
    finds_in_body("CASE x OF 1 b(); END_CASE;", &["P0010 2:13"]);
    finds_in_body("CASE x OF 1..: b(); 2: c(); END_CASE;", &["P0010 2:14"]);
    finds_in_body("REPEAT b(); END_REPEAT;", &["P0010 2:13"]);
}

#[test]
fn missing_and_wrong_ends() {
    finds("PROGRAM p\nIF a THEN\n  b();\nEND_PROGRAM", &["P0010 4:1"]);
    finds("PROGRAM p\nIF a THEN\n IF b THEN\n c();\n END_IF;\nEND_PROGRAM", &["P0010 6:1"]);
    finds("PROGRAM p\nWHILE a DO\n IF b THEN\n c();\nEND_WHILE;\nEND_PROGRAM", &["P0010 5:1"]);
    finds("PROGRAM p\nIF a THEN b(); END_WHILE;\nc();\nEND_PROGRAM", &["P0010 2:16"]);
    finds("PROGRAM p\nFOR i := 1 TO 2 DO\n WHILE a DO\n REPEAT\n c();\nEND_PROGRAM", &["P0010 6:1"]);
    finds_in_body("a();\nEND_IF;\nb();", &["P0010 3:1"]);
    finds_in_body("ELSE a();", &["P0010 2:1"]);
    finds_in_body("IF a THEN b(); ENDIF;", &["P0010 2:16"]);
    finds_in_body("IF a THEN b(); ELSEIF c THEN d(); END_IF;", &["P0010 2:16"]);
    finds_in_body("IF a THEN b(); ELSE c(); ELSE d(); END_IF;", &["P0010 2:26"]);
    finds_in_body("IF a THEN b();\nELSE IF c THEN d(); END_IF;\nx := 1; END_IF;", &[]);
    finds("PROGRAM p\nIF a THEN b();\nELSE IF c THEN d();\nEND_IF;\nEND_PROGRAM", &["P0010 5:1"]);
    finds("PROGRAM p\nx := 1;\n", &["P0010 4:1"]);
    finds("PROGRAM p\nx := 1;\nEND_FUNCTION", &["P0010 3:1"]);
    finds("PROGRAM p\nVAR x : INT;\nx := 1;\nEND_PROGRAM", &["P0010 3:1"]);
    finds("PROGRAM p\nVAR x : INT;\nIF a THEN b(); END_IF;\nEND_PROGRAM", &["P0010 3:1"]);
    finds("PROGRAM p\nVAR x : INT;\nVAR_INPUT y : INT; END_VAR\nEND_PROGRAM", &["P0010 3:1"]);
    assert_eq!(codes("PROGRAM p\nx := 1;"), ["P0010 2:8"]);
    assert_eq!(codes("PROGRAM p\nVAR x : INT;"), ["P0010 2:13"]);
    assert_eq!(codes("PROGRAM p IF a THEN b();"), ["P0010 1:25"]);
}

#[test]
fn declarations() {
    let var = |decl: &str, want: &[&str]| {
        let text = format!("PROGRAM p VAR\n{decl}\nlast : INT; END_VAR\nx := 1; END_PROGRAM");
        finds(&text, want);
        let printed = print::file(&parse(&text).0);
        assert!(printed.contains("(last : INT)") && printed.contains("(program p") && printed.contains("(:= x 1)"), "{printed}");
    };
    var("a INT;", &["P0010 2:3"]);
    var("a : ;", &["P0010 2:5"]);
    var("a : INT", &["P0010 2:8"]);
    var("a := 5;", &["P0010 2:3"]);
    var("INT a;", &["P1002 2:1", "P0010 2:5"]);
    var("a : INT = 5;", &["P0010 2:9"]);
    var("a : INT := ;", &["P0010 2:12"]);
    var("a, : INT;", &["P0010 2:4"]);
    var("a b : INT;", &["P0010 2:3"]);
    var("a AT QX0.0 : BOOL;", &["P0010 2:6"]);
    var("a AT %QZ0 : BOOL;", &["P0008 2:6"]);
    var("a : ARRAY (0..9) OF INT;", &["P0010 2:11"]);
    var("a : ARRAY [10] OF INT;", &["P0010 2:14"]);
    var("a : ARRAY [0..9] INT;", &["P0010 2:18"]);
    var("a : ARRAY [0..9] OF;", &["P0010 2:20"]);
    var("a : ARRAY [0..1] OF INT := 1, 2;", &["P0010 2:29"]);
    var("1a : INT;", &["P0005 2:1"]);
    var("a : INT; ; b : BOOL;", &[]);
}

#[test]
fn types_and_configurations() {
    finds("TYPE a (X, Y); b : INT; END_TYPE", &["P0010 1:8"]);
    finds("TYPE a : STRUCT x : INT; END_TYPE", &["P0010 1:26"]);
    finds("TYPE a : STRUCT x INT; y : INT; END_STRUCT; END_TYPE", &["P0010 1:19"]);
    finds("TYPE a : (X, , Y); END_TYPE", &["P0010 1:14"]);
    finds("TYPE a : INT;\n", &["P0010 3:1"]);
    finds("TYPE a : INT := 5 END_TYPE", &[]);
    finds("CONFIGURATION c RESOURCE r ON x PROGRAM p : m; END_CONFIGURATION", &["P0010 1:48"]);
    finds("CONFIGURATION c TASK t(FREQ := 1); PROGRAM p : m; END_CONFIGURATION", &["P0010 1:24"]);
    finds("CONFIGURATION c TASK t; PROGRAM p : m; END_CONFIGURATION", &["P0010 1:23"]);
    finds("CONFIGURATION c PROGRAM p WITH : m; PROGRAM q : m; END_CONFIGURATION", &["P0010 1:32"]);
    finds("CONFIGURATION c TASK t(PRIORITY := 1, PRIORITY := 2); END_CONFIGURATION", &["P1001 1:39"]);
    finds("CONFIGURATION c x := 1; PROGRAM q : m; END_CONFIGURATION", &["P0010 1:17"]);
}

#[test]
fn between_units() {
    finds("x := 1;", &["P0010 1:1"]);
    finds("END_PROGRAM", &["P0010 1:1"]);
    finds("hello world", &["P0010 1:1"]);
    finds("FUNCTION : INT x := 1; END_FUNCTION", &["P0010 1:10"]);
    finds("FUNCTION f INT; f := 1; END_FUNCTION", &["P0010 1:12"]);
    finds("FUNCTION f : ; f := 1; END_FUNCTION", &["P0010 1:14"]);
    finds("FUNCTION 5 : INT END_FUNCTION", &["P0010 1:10"]);
    finds("FUNCTIONBLOCK f END_FUNCTION_BLOCK", &["P0010 1:1"]);
    finds("RESOURCE r ON x PROGRAM p : m; END_RESOURCE", &["P0010 1:1"]);
    finds("VAR x : INT; END_VAR", &["P0010 1:1"]);
    finds("PROGRAM\nVAR x : INT; END_VAR\nx := 1;\nEND_PROGRAM", &["P0010 2:1"]);
    finds("PROGRAM\nx := 1;\nEND_PROGRAM", &["P0010 2:3"]);
    finds("TYPE a STRUCT x : INT; END_STRUCT; b INT; END_TYPE", &["P0010 1:8", "P0010 1:38"]);
}

/// Several mistakes, each far from the other, are all found.
#[test]
fn every_mistake_is_found() {
    let text =
        "PROGRAM a\nx := ;\ny := 1;\nIF x THEN y(; END_IF;\nEND_PROGRAM\nPROGRAM b\nVAR x INT; END_VAR\nx = 1;\nEND_PROGRAM";
    finds(text, &["P0010 2:6", "P0010 4:13", "P0010 7:7", "P0010 8:3"]);
}
