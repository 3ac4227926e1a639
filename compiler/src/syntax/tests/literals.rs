//! The lexer table of the language reference, §15, row by row; then what the rows leave open.

use super::*;

/// An expression as it is read: the tree, the codes of errors, or both when the code is a warning.
fn read(text: &str) -> String {
    let (file, diags, _) = parse(&format!("PROGRAM p x := {text}\n; END_PROGRAM"));
    let mut codes: Vec<&str> = diags.iter().map(|d| d.code.text()).collect();
    codes.dedup();
    let printed = print::file(&file);
    let tree = printed.strip_prefix("(program p (:= x ").and_then(|s| s.strip_suffix("))")).unwrap_or(&printed);
    match diags.iter().any(|d| d.severity == Severity::Error) {
        true => codes.join(" "),
        false if codes.is_empty() => tree.to_owned(),
        false => format!("{tree} warns {}", codes.join(" ")),
    }
}

fn table(rows: &[(&str, &str)]) {
    for (text, want) in rows {
        assert_eq!(read(text), *want, "{text}");
    }
}

/// Row `1_000` `0` `007`; row `1__0` `_1` `1_`.
#[test]
fn integers() {
    table(&[("1_000", "1000"), ("0", "0"), ("007", "7"), ("1__0", "P0005"), ("_1", "_1"), ("1_", "P0005")]);
    table(&[("18446744073709551615", "18446744073709551615"), ("99999999999999999999999999999999999999999", "P0005")]);
    table(&[("-9223372036854775808", "-9223372036854775808"), ("12abc", "P0005"), ("0x1F", "P0005"), ("10ms", "P0005")]);
}

/// Rows `16#FF_ff` and `16#`.
#[test]
fn based_integers() {
    table(&[("16#FF_ff", "65535b"), ("2#1111_0000", "240b"), ("8#377", "255b"), ("16#aF", "175b")]);
    table(&[("16#", "P0005"), ("2#102", "P0005"), ("16#-1", "P0005"), ("3#21", "P0005"), ("16#_1", "P0005"), ("16#1G", "P0005")]);
}

/// Rows `1.5` and `1.E3`.
#[test]
fn reals() {
    table(&[
        ("1.5", "1.5"),
        ("1.0E+6", "1000000.0"),
        ("1.0e-3", "0.001"),
        ("3.14159_26", "3.1415926"),
        ("-1.34E-12", "-1.34e-12"),
    ]);
    table(&[("1.E3", "P0005"), (".5", "P0005"), ("1e3", "1000.0 warns P0005"), ("1.", "1.0 warns P0005")]);
    table(&[("6.68E-012", "6.68e-12"), ("1.0E999", "P0005"), ("1.0_", "P0005"), ("1_.0", "P0005"), ("1.0__1", "P0005")]);
}

/// Row `1..5` `-5..-1`.
#[test]
fn ranges() {
    assert_eq!(stmt("CASE x OF 1..5: ; -5..-1: ; END_CASE;"), "(case x (1..5 {;}) (-5..-1 {;}))");
}

/// Rows `INT#-32768` and `BOOL#1`.
#[test]
fn typed_literals() {
    table(&[("INT#-32768", "INT#-32768"), ("INT#32768", "P0006"), ("UINT#-1", "P0006"), ("SINT#16#80", "P0006")]);
    table(&[("BOOL#1", "BOOL#true"), ("BOOL#TRUE", "BOOL#true"), ("BOOL#2", "P0006"), ("bool#false", "BOOL#false")]);
    table(&[("INT#16#7FFF", "INT#32767b"), ("WORD#16#AFF", "WORD#2815b"), ("WORD#1234", "WORD#1234"), ("int#+5", "INT#5")]);
    table(&[("REAL#5", "REAL#5.0"), ("LREAL#1.5E3", "LREAL#1500.0"), ("REAL#1.0E39", "P0006"), ("REAL#-1.5", "REAL#-1.5")]);
    table(&[("ULINT#18446744073709551615", "ULINT#18446744073709551615"), ("ULINT#18446744073709551616", "P0006")]);
    table(&[("LINT#-9223372036854775808", "LINT#-9223372036854775808"), ("LINT#9223372036854775808", "P0006")]);
    table(&[("CHAR#'X'", "CHAR#'X'"), ("CHAR#16#41", "CHAR#65b"), ("CHAR#'XY'", "P0006"), ("WCHAR#'x'", "WCHAR#\"x\"")]);
    table(&[("INT#1.5", "P0006"), ("INT#'a'", "P0006"), ("INT# 5", "P0006"), ("INT#", "P0006"), ("BYTE#256", "P0006")]);
    table(&[("INT#16#-1", "P0005"), ("INT#-16#1", "P0006"), ("Foo#5", "P0006"), ("INT#1_", "P0005")]);
}

/// Row `T#1d2h3m4s5ms6us7ns` and the two below it, row `LTIME#100us`.
#[test]
fn durations() {
    table(&[
        ("T#1d2h3m4s5ms6us7ns", "TIME#93784005006007"),
        ("T#-1.5s", "TIME#-1500000000"),
        ("t#14.7d", "TIME#1270080000000000"),
    ]);
    table(&[("T#25h_15m", "TIME#90900000000000"), ("T#1m_30.5s", "TIME#90500000000")]);
    table(&[("T#1.5h_3m", "P0007"), ("T#3s_2m", "P0007"), ("T#", "P0007"), ("T#5", "P0007"), ("T#0", "TIME#0 warns P0007")]);
    table(&[("LTIME#100us", "LTIME#100000"), ("LT#1ns", "LTIME#1"), ("TIME#5d_14h_12m_18s_3.5ms", "TIME#483138003500000")]);
    table(&[("T#1000ms", "TIME#1000000000"), ("T#1s1000ms", "TIME#2000000000 warns P0007"), ("T#1S5MS", "TIME#1005000000")]);
    table(&[("T#0.5ns", "TIME#0 warns P0007"), ("T#1.5ns", "TIME#2 warns P0007"), ("T#2.5ns", "TIME#2 warns P0007")]);
    table(&[("T#9223372036854775807ns", "TIME#9223372036854775807"), ("T#9223372036854775808ns", "P0007")]);
    table(&[
        ("T#-9223372036854775808ns", "TIME#-9223372036854775808"),
        ("T#1x", "P0007"),
        ("T#1s_", "P0007"),
        ("T#--1s", "P0007"),
    ]);
    table(&[("T#1s1s", "P0007"), ("T#1.s", "P0007"), ("T#1__0s", "P0007"), ("T#1_0s", "TIME#10000000000")]);
}

/// Rows `D#2024-02-29`, `TOD#23:59:59.999` and `DT#1984-06-25-15:36:55.360_227_400`.
#[test]
fn dates() {
    table(&[
        ("D#2024-02-29", "DATE#1709164800000000000"),
        ("D#2023-02-29", "P0007"),
        ("DATE#1984-6-5", "DATE#455241600000000000"),
    ]);
    table(&[("TOD#23:59:59.999", "TOD#86399999000000"), ("TOD#24:00:00", "P0007")]);
    table(&[("TOD#12:00", "TOD#43200000000000 warns P0007"), ("TOD#7:5:3", "TOD#25503000000000")]);
    table(&[("DT#1984-06-25-15:36:55.360_227_400", "DT#457025815360227400")]);
    table(&[("LDT#1970-01-01-00:00:00", "LDT#0"), ("LD#1969-12-31", "LDATE#-86400000000000"), ("LTOD#0:0:0", "LTOD#0")]);
    table(&[
        ("D#1900-02-29", "P0007"),
        ("D#2000-02-29", "DATE#951782400000000000"),
        ("D#2024-13-01", "P0007"),
        ("D#2024-00-01", "P0007"),
    ]);
    table(&[
        ("D#2024-04-31", "P0007"),
        ("D#9999-01-01", "P0007"),
        ("D#1677-01-01", "P0007"),
        ("D#2024-1", "P0007"),
        ("D#", "P0007"),
    ]);
    table(&[
        ("TOD#12:60:00", "P0007"),
        ("TOD#12:00:60", "P0007"),
        ("DT#2024-01-01", "P0007"),
        ("DT#2024-01-01-25:00:00", "P0007"),
    ]);
}

/// Rows `'$''` and `'$q'`, row `"$00C4"`.
#[test]
fn strings() {
    table(&[("'$''", "'\\''"), ("'$$'", "'$'"), ("'$0A$0d'", "'\\n\\r'"), ("'$R$L'", "'\\r\\n'"), ("'a\"b'", "'a\\\"b'")]);
    table(&[("'$q'", "P0004"), ("'$4'", "P0004"), ("'$n$t$p$l'", "'\\n\\t\\x0c\\n'"), ("'a$\"b'", "'a\\\"b'"), ("''", "''")]);
    table(&[("\"$00C4\"", "\"\u{c4}\""), ("\"$\"\"", "\"\"\""), ("WSTRING#'x'", "\"x\""), ("STRING#'OK'", "'OK'")]);
    table(&[
        ("\"$C4\"", "P0004"),
        ("'a\tb'", "P0004"),
        ("'\u{e4}'", "'\\xc3\\xa4'"),
        ("'(* no comment *) // {'", "'(* no comment *) // {'"),
    ]);
    assert_eq!(codes("PROGRAM p\nx := 'abc\n;\ny := 'd';\nEND_PROGRAM"), ["P0003 2:6"]);
    assert_eq!(codes("PROGRAM p\nx := \"abc$\n;\nEND_PROGRAM"), ["P0003 2:6"]);
}

/// Rows `%IX1.2` and `%Z1`.
#[test]
fn addresses() {
    table(&[("%IX1.2", "%IX1.2"), ("%QW3", "%QW3"), ("%MD48", "%MD48"), ("%ix0.0", "%IX0.0"), ("%QX1.2.3.4", "%QX1.2.3.4")]);
    table(&[("%I5", "%IX5"), ("%ML1", "%ML1"), ("%qb7", "%QB7")]);
    table(&[("%Z1", "P0008"), ("%IX", "P0008"), ("%I1*", "P0008"), ("%I99999999999", "P0008"), ("%I1.2.3.4.5.6.7.8.9", "P0008")]);
    assert_eq!(tree("PROGRAM p VAR a AT %I* : BOOL; END_VAR END_PROGRAM"), "(program p (var (a at %IX* : BOOL)))");
}

/// Rows `(* a (* b *) c *)` and `// x (* y`.
#[test]
fn comments() {
    table(&[("(* a (* b *) c *) z", "z"), ("// x (* y\n z", "z"), ("/* a /* b */ (* c */ z", "z"), ("(**) (*)*) z", "z")]);
    table(&[("{a pragma} z", "z"), ("{{ with } inside }} z", "z"), ("{attribute 'x' := '1'} z", "z"), ("(* // *) z", "z")]);
    assert_eq!(codes("PROGRAM p END_PROGRAM (* (* *)"), ["P0002 1:23"]);
    assert_eq!(codes("PROGRAM p END_PROGRAM { x"), ["P0002 1:23"]);
    assert_eq!(codes("PROGRAM p END_PROGRAM /*"), ["P0002 1:23"]);
    assert_eq!(codes("PROGRAM p {IF defined(x)} END_PROGRAM"), ["P0012 1:11"]);
}

/// Row `A_B` `a_b`.
#[test]
fn identifiers() {
    let (file, ..) = parse("PROGRAM A_B END_PROGRAM PROGRAM a_b END_PROGRAM");
    let name = |i: usize| match &file.items[i] {
        Item::Pou(p) => p.name.clone(),
        other => panic!("{other:?}"),
    };
    assert!(name(0).is("a_b") && name(0).key() == name(1).key());
    table(&[("A__B", "P0009"), ("A_", "P0009"), ("_a", "_a"), ("\u{e4}\u{f6}1", "\u{e4}\u{f6}1")]);
    assert_eq!(codes("PROGRAM p a_ := 1; a_ := 2; END_PROGRAM"), ["P0009 1:11"]);
}

/// Row `x.3` `x.%X3` `x.%B1` `r.f`.
#[test]
fn parts_and_members() {
    table(&[("x.3", "x.%X3"), ("x.%X3", "x.%X3"), ("x.%B1", "x.%B1"), ("r.f", "r.f"), ("x.%D0.%W1.%B0.7", "x.%D0.%W1.%B0.%X7")]);
    table(&[
        ("x.%Q1", "P0008"),
        ("x.%X", "P0008"),
        ("x.%B1.2.3", "P0008"),
        ("x.%X1a", "P0008"),
        ("x.99999999999", "P0008"),
        ("a[1].b.c[2, 3].4", "a[1].b.c[2 3].%X4"),
    ]);
}

/// Row `Color#Red` `INT#Red`.
#[test]
fn enumerators() {
    table(&[("Color#Red", "Color#Red"), ("INT#Red", "P0006")]);
}

#[test]
fn unknown_characters() {
    assert_eq!(codes("PROGRAM p\nx := \u{2018}a;\ny := 1;\nEND_PROGRAM"), ["P0001 2:6"]);
    assert_eq!(codes("PROGRAM p\nx := a $$$ b;\nEND_PROGRAM"), ["P0001 2:8"]);
    assert_eq!(tree("\u{feff}PROGRAM p END_PROGRAM"), "(program p)");
}
