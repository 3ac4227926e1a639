//! One mistake gives one message at its line, and the units behind it are still checked: each case is a mistake in the middle of a file.

use takt_base::Severity;
use takt_tests::plc::compile_st;

/// The file: `@` is where the mistake goes. The last unit has an error of types, which must be found.
const FRAME: &str = "TYPE Level : INT (0..100); END_TYPE
FUNCTION_BLOCK Before
  VAR_INPUT i : INT; END_VAR
  VAR_OUTPUT q : INT; END_VAR
  q := i;
END_FUNCTION_BLOCK
@
PROGRAM Last
  VAR s : STRING; n : INT; END_VAR
  n := s;
END_PROGRAM
";

/// A program around declarations and statements.
fn program(vars: &str, body: &str) -> String {
    format!(
        "PROGRAM Middle\n  VAR\n    a, b, i : INT; c : BOOL; t : Before; l : ARRAY [0..9] OF INT;\n{vars}\n  END_VAR\n  a := 1;\n{body}\n  b := a;\nEND_PROGRAM"
    )
}

/// Lines of all errors about the frame with this in its middle, counted from the first line of the insertion; `!` for the one at the end.
fn errors(middle: &str) -> Vec<String> {
    let c = compile_st(&FRAME.replace('@', middle));
    let first = FRAME.lines().position(|l| l == "@").unwrap_or(0);
    let last = first + middle.lines().count() + 2;
    let errors = c.diags.iter().filter(|d| d.severity == Severity::Error);
    errors
        .map(|d| {
            let line = c.sources.line_col(d.span.source, d.span.start).line as usize - 1;
            if line == last && d.code.text() == "P2001" { "!".to_owned() } else { format!("{}: {}", line - first, d.code.text()) }
        })
        .collect()
}

/// Each case: the text, and the line of it that is reported.
fn check(around: fn(&str) -> String, offset: usize, cases: &[(&str, usize)]) {
    let mut wrong = Vec::new();
    for (text, line) in cases {
        let found = errors(&around(text));
        let wanted = found.len() == 2 && found[0].starts_with(&format!("{}: ", offset + line)) && found[1] == "!";
        if !wanted {
            wrong.push(format!("{text}\n  wanted line {}, found {found:?}\n", offset + line));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}

#[test]
fn the_frame_has_one_error() {
    assert_eq!(errors(&program("", "")), ["!"]);
}

/// Mistakes in statements; line 0 is the first of the text.
#[test]
fn statements() {
    check(
        |body| program("", body),
        6,
        &[
            ("  a := 1\n  b := 2;", 0),
            ("  a = 1;", 0),
            ("  a == 1;", 0),
            ("  a := (1 + 2;\n  b := 2;", 0),
            ("  a := 1 + 2);", 0),
            ("  a := 1 + ;", 0),
            ("  a := * 2;", 0),
            ("  a := l[1;\n  b := 3;", 0),
            ("  a := l 1];", 0),
            ("  IF c\n    a := 1;\n  END_IF;", 0),
            ("  IF c THEN\n    a := 1;\n  ENDIF;", 2),
            ("  IF c THEN\n    a := 1;\n  END_FI;", 2),
            ("  IF c THEN\n    a := 1;\n  ELSEIF a > 1 THEN\n    a := 2;\n  END_IF;", 2),
            ("  IF c THEN\n    a := 1;\n  ELS\n    a := 2;\n  END_IF;", 2),
            ("  IF c THAN\n    a := 1;\n  END_IF;", 0),
            ("  IFF c THEN\n    a := 1;\n  END_IF;", 0),
            ("  FOR i = 1 TO 3 DO\n    a := i;\n  END_FOR;", 0),
            ("  FOR i := 1 TO 3\n    a := i;\n  END_FOR;", 0),
            ("  FOR i := 1 UNTIL 3 DO\n    a := i;\n  END_FOR;", 0),
            ("  FOR i := 1 TO 3 DO\n    a := i;\n  ENDFOR;", 2),
            ("  WHILE c THEN\n    a := 1;\n  END_WHILE;", 0),
            ("  WHILE c DO\n    a := 1;\n  END_WHIL;", 2),
            ("  REPEAT\n    a := 1;\n  END_REPEAT;", 2),
            ("  CASE a OF\n    1 a := 1;\n    2: a := 2;\n  END_CASE;", 1),
            ("  CASE a\n    1: a := 1;\n  END_CASE;", 0),
            ("  CASE a OF\n    1: a := 1;\n  END_CAES;", 2),
            ("  t(i := 1;\n  b := 2;", 0),
            ("  t(i = c AND);", 0),
            ("  a := ABS(1, ;", 0),
            ("  a := b b;", 0),
            ("  a := 3 $ 4;", 0),
            ("  a := 12abc;", 0),
            ("  a := 'abc;\n  b := 3;", 0),
            ("  (* never closed\n  b := 3;", 0),
            ("  a := 1; (* see (* above *)\n  b := 3;", 0),
            ("  { never closed\n  b := 3;", 0),
            ("  a++;", 0),
            ("  a += 1;", 0),
            ("  a : = 1;", 0),
            ("  THEN\n  a := 1;", 0),
            ("  END_IF;\n  a := 1;", 0),
            ("  ELSE\n  a := 1;", 0),
            ("  ) a := 1;", 0),
            ("  , a := 1;", 0),
            ("  return a;", 0),
            ("  a := unknown1;", 0),
            ("  unknown2(1);", 0),
            ("  goto out;", 0),
        ],
    );
}

/// Mistakes in declarations of variables.
#[test]
fn declarations() {
    check(
        |vars| program(vars, ""),
        3,
        &[
            ("    d : INT\n    e : INT;", 0),
            ("    d INT;", 0),
            ("    d : NIT;", 0),
            ("    d : ;", 0),
            ("    d := 1;", 0),
            ("    d : INT = 1;", 0),
            ("    d : INT := ;", 0),
            ("    INT d;", 0),
            ("    d e : INT;", 0),
            ("    d : ARRAY [0..9 OF INT;", 0),
            ("    d : ARRAY [0.9] OF INT;", 0),
            ("    d : ARRAY 0..9] OF INT;", 0),
            ("    d : ARRAY [0..9] INT;", 0),
            ("    d : STRING[10;", 0),
            ("    d AT QX0.0 : BOOL;", 0),
            ("    d : INT; }", 0),
            ("    (* never closed\n    e : INT;", 0),
            ("    d : STRING := 'abc;\n    e : INT;", 0),
        ],
    );
}

/// Mistakes in the shape of units.
#[test]
fn units() {
    check(
        str::to_owned,
        0,
        &[
            ("PROGRAM Middle\n  VAR a : INT; END_VAR\n  a := 1;\nENDPROGRAM", 3),
            ("PROGRAM Middle\n  VAR a : INT; END_VAR\n  a := 1;\nEND_PROGRAMM", 3),
            ("PROGRAM Middle\n  VAR a : INT; END_VAR\n  a := 1;\nEND_FUNCTION", 3),
            ("PROGRAM Middle\n  VAR a : INT; END_VAR\n  a := 1;", 3),
            ("PROGRAM Middle\n  VAR a : INT; ENDVAR\n  a := 1;\nEND_PROGRAM", 1),
            ("PROGRAM Middle\n  VAR a : INT;\n  a := 1;\nEND_PROGRAM", 2),
            ("PROGRAM Middle\n  VARS a : INT; END_VAR\n  a := 1;\nEND_PROGRAM", 1),
            ("PROGRAM Middle\n  VAR_TMP a : INT; END_VAR\n  a := 1;\nEND_PROGRAM", 1),
            ("PROGRAM\n  VAR a : INT; END_VAR\n  a := 1;\nEND_PROGRAM", 1),
            ("PROGRAM 5\n  VAR a : INT; END_VAR\n  a := 1;\nEND_PROGRAM", 0),
            ("PROGRAMM Middle\n  VAR a : INT; END_VAR\n  a := 1;\nEND_PROGRAM", 0),
            ("FUNCTION Middle INT\n  Middle := 1;\nEND_FUNCTION", 0),
            ("FUNCTION Middle : NIT\n  Middle := 1;\nEND_FUNCTION", 0),
            ("FUNCTION Middle : \n  Middle := 1;\nEND_FUNCTION", 0),
            ("FUNCTION Middle : INT\n  VAR_INPUT a : INT END_VAR\n  Middle := a;\nEND_FUNCTION", 1),
            ("TYPE Color : (red, green; END_TYPE", 0),
            ("TYPE Color (red, green); END_TYPE", 0),
            ("TYPE Point : STRUCT\n  x : INT\n  y : INT;\nEND_STRUCT; END_TYPE", 1),
            ("TYPE Point : STRUCT\n  x : INT;\nENDSTRUCT; END_TYPE", 2),
            ("TYPE Point : STRUCT\n  x : INT;\nEND_STRUCT;\nENDTYPE", 3),
            ("FUNCTION_BLOCK Middle\n  METHOD PUBLIC m : INT\n    m := ;\n  END_METHOD\nEND_FUNCTION_BLOCK", 2),
            ("FUNCTION_BLOCK Middle\n  METHOD PUBLIC m : INT\n    m := 1;\n  ENDMETHOD\nEND_FUNCTION_BLOCK", 3),
            ("x := 1;", 0),
            ("END_PROGRAM", 0),
            (";;; stray", 0),
        ],
    );
}
