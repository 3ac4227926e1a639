//! Typical mistakes and the messages that they give, in full: `mistakes.txt` is there to be read.
//! With TAKT_BLESS set the test writes the file anew.

use super::*;

/// What users write.
const MISTAKES: &[(&str, &str)] = &[
    ("a missing semicolon", "PROGRAM p\n  x := 1\n  y := 2;\nEND_PROGRAM\n"),
    ("= instead of :=", "PROGRAM p\n  x = 1;\nEND_PROGRAM\n"),
    (":= instead of =", "PROGRAM p\n  IF x := 1 THEN\n    y := 2;\n  END_IF;\nEND_PROGRAM\n"),
    ("operators of C", "PROGRAM p\n  ok := a == 1 && b != 2 || !c;\nEND_PROGRAM\n"),
    ("updates of C", "PROGRAM p\n  n += 1;\n  m++;\nEND_PROGRAM\n"),
    ("a missing THEN", "PROGRAM p\n  IF a > 3\n    x := 1;\n  END_IF;\nEND_PROGRAM\n"),
    ("a missing DO", "PROGRAM p\n  FOR i := 1 TO 10 x := i; END_FOR;\nEND_PROGRAM\n"),
    ("a missing END_IF", "PROGRAM p\n  IF a THEN\n    x := 1;\n  y := 2;\nEND_PROGRAM\nPROGRAM q\nEND_PROGRAM\n"),
    ("ELSE IF", "PROGRAM p\n  IF a THEN\n    x := 1;\n  ELSE IF b THEN\n    x := 2;\n  END_IF;\nEND_PROGRAM\n"),
    ("ELSEIF and ENDIF", "PROGRAM p\n  IF a THEN\n    x := 1;\n  ELSEIF b THEN\n    x := 2;\n  ENDIF;\nEND_PROGRAM\n"),
    ("the wrong END", "PROGRAM p\n  FOR i := 1 TO 3 DO\n    x := i;\n  END_WHILE;\nEND_PROGRAM\n"),
    ("an END too many", "PROGRAM p\n  x := 1;\n  END_IF;\n  y := 2;\nEND_PROGRAM\n"),
    ("a missing END_VAR", "PROGRAM p\nVAR\n  x : INT;\n  IF x = 1 THEN\n    x := 2;\n  END_IF;\nEND_PROGRAM\n"),
    ("a missing END_VAR before an assignment", "PROGRAM p\nVAR\n  x : INT;\n  x := 2;\n  x := 3;\nEND_PROGRAM\n"),
    ("the type first", "PROGRAM p\nVAR\n  INT x;\n  count speed;\n  y : INT;\nEND_VAR\nEND_PROGRAM\n"),
    ("a missing type", "PROGRAM p\nVAR\n  x := 5;\n  y : INT = 5;\nEND_VAR\nEND_PROGRAM\n"),
    ("a keyword as a name", "PROGRAM p\nVAR\n  step : INT;\n  dt : REAL;\nEND_VAR\n  step := step + 1;\nEND_PROGRAM\n"),
    ("a variable behind a statement", "PROGRAM p\n  x := 1;\nVAR\n  y : INT;\nEND_VAR\n  y := 2;\nEND_PROGRAM\n"),
    ("a bracket that is not closed", "PROGRAM p\n  x := (a + b * c;\n  y := f(1, 2;\n  z := a[3 + 1;\nEND_PROGRAM\n"),
    ("a string that is not closed", "PROGRAM p\n  s := 'it''s;\n  t := 'done;\n  u := 1;\nEND_PROGRAM\n"),
    ("durations", "PROGRAM p\n  t1(PT := 500ms);\n  t2(PT := T#500);\n  t3(PT := T#1.5m30s);\nEND_PROGRAM\n"),
    ("numbers", "PROGRAM p\n  a := 0xFF;\n  b := 2#102;\n  c := .5;\n  d := INT#40000;\nEND_PROGRAM\n"),
    ("a missing END_PROGRAM", "PROGRAM p\n  x := 1;\n\nFUNCTION_BLOCK b\nEND_FUNCTION_BLOCK\n"),
    ("a call without parentheses", "PROGRAM p\n  motor;\n  valve := ;\nEND_PROGRAM\n"),
    ("a comment that is not closed", "PROGRAM p\n  x := 1; (* why (* so *)\nEND_PROGRAM\n"),
    ("CASE without labels", "PROGRAM p\n  CASE x OF\n    y := 1;\n    2: y := 2;\n  END_CASE;\nEND_PROGRAM\n"),
    (
        "a class",
        "FUNCTION_BLOCK b EXTENDS a\n  METHOD PUBLIC m : INT\n    m := 1;\n  END_METHOD\n  x := THIS^.y;\nEND_FUNCTION_BLOCK\n",
    ),
    ("text from a word processor", "PROGRAM p\n  s := \u{2018}on\u{2019};\n  ok := a \u{2264} 3;\nEND_PROGRAM\n"),
    ("no PROGRAM at all", "x := 1;\ny := 2;\n"),
];

/// All of them as one text.
fn rendered() -> String {
    let mut out = String::new();
    for (title, text) in MISTAKES {
        let (_, diags, sources) = parse(text);
        out += &format!("==== {title}\n{text}----\n");
        for diag in &diags {
            out += &render(diag, &sources);
        }
        out.push('\n');
    }
    out
}

#[test]
fn messages_of_typical_mistakes() {
    let got = rendered();
    if std::env::var_os("TAKT_BLESS").is_some() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/syntax/tests/mistakes.txt");
        std::fs::write(path, &got).expect("the file can be written");
        return;
    }
    let want = include_str!("mistakes.txt");
    for (got, want) in got.split("==== ").zip(want.split("==== ")) {
        assert_eq!(got, want);
    }
    assert_eq!(got, want);
}
