//! What users read: typical mistakes with their whole messages, compared with `compiler/tests/snapshots/syntax_mistakes.txt`.
//! `TAKT_BLESS=1 cargo test -p takt-compiler mistakes` writes the file anew; read the difference before it is committed.

use super::*;

/// What somebody did, and the text.
const MISTAKES: &[(&str, &str)] = &[
    ("= where := is meant", "PROGRAM pump\n  level = level + 1;\nEND_PROGRAM"),
    (":= where = is meant", "PROGRAM pump\n  IF level := 5 THEN\n    stop();\n  END_IF;\nEND_PROGRAM"),
    ("operators of C", "PROGRAM pump\n  run := a == 1 && b != 2 || !c;\n  n += 1;\n  n++;\nEND_PROGRAM"),
    ("no semicolon", "PROGRAM pump\n  a := 1\n  b := 2;\nEND_PROGRAM"),
    ("no THEN", "PROGRAM pump\n  IF level > 5\n    stop();\n  END_IF;\nEND_PROGRAM"),
    ("THEN where DO is meant", "PROGRAM pump\n  WHILE level > 5 THEN\n    stop();\n  END_WHILE;\nEND_PROGRAM"),
    ("no DO", "PROGRAM pump\n  FOR i := 1 TO 10\n    stop();\n  END_FOR;\nEND_PROGRAM"),
    ("no END_IF", "PROGRAM pump\n  IF level > 5 THEN\n    IF level > 6 THEN\n      stop();\n    END_IF;\nEND_PROGRAM"),
    ("ELSE IF for ELSIF", "PROGRAM pump\n  IF a THEN\n    b();\n  ELSE IF c THEN\n    d();\n  END_IF;\nEND_PROGRAM"),
    ("ELSEIF and ENDIF", "PROGRAM pump\n  IF a THEN\n    b();\n  ELSEIF c THEN\n    d();\n  ENDIF;\nEND_PROGRAM"),
    ("no END_VAR", "PROGRAM pump\nVAR\n  level : INT;\n\n  level := 1;\nEND_PROGRAM"),
    ("a keyword as a name", "PROGRAM pump\nVAR\n  step : INT;\nEND_VAR\n  step := step + 1;\nEND_PROGRAM"),
    ("type before name", "PROGRAM pump\nVAR\n  Motor m1;\n  level INT;\nEND_VAR\nEND_PROGRAM"),
    (
        "array bounds in parentheses",
        "PROGRAM pump\nVAR\n  a : ARRAY (0..9) OF INT;\n  b : ARRAY [10] OF INT;\nEND_VAR\nEND_PROGRAM",
    ),
    ("string that does not end", "PROGRAM pump\n  name := 'main pump;\n  text := 'costs 5$';\nEND_PROGRAM"),
    ("comment that does not end", "PROGRAM pump\n  (* first (* second *)\n  a := 1;\nEND_PROGRAM"),
    ("quotes of a word processor", "PROGRAM pump\n  name := \u{2018}main\u{2019};\nEND_PROGRAM"),
    ("numbers of C", "PROGRAM pump\n  a := 0x1F;\n  b := .5;\n  c := 1.E3;\n  t1(PT := 100ms);\nEND_PROGRAM"),
    ("durations", "PROGRAM pump\n  a := T#100;\n  b := T#5s_3m;\n  c := T#5min;\nEND_PROGRAM"),
    ("out of range", "PROGRAM pump\n  a := INT#40000;\n  b := BYTE#256;\n  c := D#2023-02-29;\nEND_PROGRAM"),
    ("addresses", "PROGRAM pump\n  a := %Z1;\n  b := %IX;\nEND_PROGRAM"),
    ("underscores", "PROGRAM pump\nVAR\n  a__b : INT;\n  c_ : INT;\nEND_VAR\nEND_PROGRAM"),
    ("bracket that does not close", "PROGRAM pump\n  a := (b + c * (d - 1);\n  e := f(1, 2;\nEND_PROGRAM"),
    ("CASE without labels", "PROGRAM pump\n  CASE state OF\n    a := 1;\n  END_CASE;\nEND_PROGRAM"),
    (
        "not in this version",
        "FUNCTION_BLOCK pump\nVAR\n  p : a.b;\nEND_VAR\n  a := p;\nMETHOD m : INT\n  m := 1;\nEND_METHOD\nEND_FUNCTION_BLOCK",
    ),
    ("wrong end of a unit", "FUNCTION_BLOCK pump\n  a := 1;\nEND_FUNCTION\nPROGRAM p\nEND_PROGRAM"),
];

fn rendered() -> String {
    let mut out = String::new();
    for (what, text) in MISTAKES {
        let (_, diags, sources) = parse(text);
        out += &format!("=== {what}\n");
        for diag in &diags {
            out += &render(diag, &sources);
        }
        out += "\n";
    }
    out
}

#[test]
fn mistakes_are_explained_as_in_the_snapshot() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/snapshots/syntax_mistakes.txt");
    let found = rendered();
    if std::env::var_os("TAKT_BLESS").is_some() {
        std::fs::write(path, &found).expect("the snapshot can be written");
    }
    let want = std::fs::read_to_string(path).unwrap_or_default();
    for (found, want) in found.split("=== ").zip(want.split("=== ")) {
        assert_eq!(found, want);
    }
    assert_eq!(found, want);
}
