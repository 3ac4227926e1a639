//! The lexer test table of the language reference (§15) and the examples of §1.5 to §1.9.

use super::*;
use crate::syntax::lexer::{Tok, lex};
use crate::syntax::report::Report;

/// Each text is an expression that prints so, without a message.
fn good(cases: &[(&str, &str)]) {
    for (text, want) in cases {
        assert_eq!(expr(text), *want, "{text}");
    }
}

/// Each text gives exactly this one message, an error.
fn bad(cases: &[(&str, &str)]) {
    for (text, want) in cases {
        let (_, diags, _) = parse(&format!("PROGRAM p\nx := {text};\nEND_PROGRAM"));
        let got: Vec<_> = diags.iter().map(|d| (d.code.text(), d.severity)).collect();
        assert_eq!(got, [(*want, takt_base::diag::Severity::Error)], "{text}: {diags:?}");
    }
}

/// Each text is an expression with this value and exactly this one warning.
fn vendor(cases: &[(&str, &str, &str)]) {
    for (text, value, code) in cases {
        let (file, diags, _) = parse(&format!("PROGRAM p\nx := {text};\nEND_PROGRAM"));
        let got: Vec<_> = diags.iter().map(|d| (d.code.text(), d.severity)).collect();
        assert_eq!(got, [(*code, takt_base::diag::Severity::Warning)], "{text}");
        assert_eq!(print::file(&file), format!("(program p (:= x {value}))"), "{text}");
    }
}

/// Shapes of the tokens, and the codes of the messages.
fn tokens(text: &str) -> (Vec<Tok>, Vec<&'static str>) {
    let mut sink = Sink::new();
    let id = Sources::new().add("a.st", text);
    let mut tokens = lex(text, id, &mut Report::new(&mut sink)).list;
    tokens.pop();
    (tokens.iter().map(|t| t.kind).collect(), sink.diags.iter().map(|d| d.code.text()).collect())
}

#[test]
fn section_15_integers() {
    good(&[("1_000", "1000"), ("0", "0"), ("007", "7"), ("_1", "_1"), ("123_456", "123456")]);
    bad(&[("1__0", "P0005"), ("1_", "P0005"), ("12abc", "P0005"), ("10ms", "P0005"), ("0x1F", "P0005")]);
    good(&[("16#FF_ff", "65535b"), ("2#1111_0000", "240b"), ("8#377", "255b"), ("16#ff", "255b")]);
    bad(&[("16#", "P0005"), ("2#102", "P0005"), ("16#-1", "P0005"), ("3#21", "P0005"), ("16#_1", "P0005"), ("16#1__1", "P0005")]);
    good(&[("170141183460469231731687303715884105727", "170141183460469231731687303715884105727")]);
    bad(&[("170141183460469231731687303715884105728", "P0005")]);
}

#[test]
fn section_15_reals() {
    good(&[
        ("1.5", "1.5"),
        ("1.0E+6", "1000000.0"),
        ("1.0e-3", "0.001"),
        ("3.14159_26", "3.1415926"),
        ("-1.34E-12", "-1.34e-12"),
    ]);
    bad(&[("1.E3", "P0005"), (".5", "P0005"), ("1.5E999", "P0005"), ("1.5_", "P0005"), ("1.0E1_", "P0005")]);
    vendor(&[("1e3", "1000.0", "P0005"), ("1.", "1.0", "P0005"), ("6E-012", "6e-12", "P0005")]);
}

#[test]
fn section_15_ranges_are_no_reals() {
    assert_eq!(tokens("1..5").0, [Tok::Int, Tok::Range, Tok::Int]);
    assert_eq!(tokens("-5..-1").0, [Tok::Minus, Tok::Int, Tok::Range, Tok::Minus, Tok::Int]);
    assert_eq!(tokens("T#1s..T#2s").0, [Tok::Duration, Tok::Range, Tok::Duration]);
    assert_eq!(tokens("TOD#1:2:3..TOD#2:3:4").0, [Tok::Date, Tok::Range, Tok::Date]);
}

#[test]
fn section_15_typed_literals() {
    good(&[("INT#-32768", "INT#-32768"), ("INT#+5", "INT#5"), ("INT#16#7FFF", "INT#32767b"), ("int#-123", "INT#-123")]);
    good(&[("WORD#16#AFF", "WORD#2815b"), ("WORD#1234", "WORD#1234"), ("BYTE#16#FF", "BYTE#255b")]);
    good(&[("BOOL#1", "BOOL#true"), ("BOOL#0", "BOOL#false"), ("BOOL#TRUE", "BOOL#true"), ("BOOL#false", "BOOL#false")]);
    good(&[("REAL#5", "REAL#5.0"), ("LREAL#1.5E3", "LREAL#1500.0"), ("REAL#-1.5", "REAL#-1.5")]);
    good(&[("CHAR#16#41", "CHAR#65b"), ("CHAR#'X'", "CHAR#'X'"), ("WCHAR#'X'", "WCHAR#\"X\""), ("WCHAR#\"X\"", "WCHAR#\"X\"")]);
    good(&[("STRING#'OK'", "'OK'"), ("WSTRING#\"OK\"", "\"OK\""), ("WSTRING#'x'", "\"x\"")]);
    good(&[
        ("LINT#-9223372036854775808", "LINT#-9223372036854775808"),
        ("ULINT#18446744073709551615", "ULINT#18446744073709551615"),
    ]);
    bad(&[("INT#32768", "P0006"), ("INT#40000", "P0006"), ("UINT#-1", "P0006"), ("SINT#16#80", "P0006"), ("BOOL#2", "P0006")]);
    bad(&[("INT#1.5", "P0006"), ("INT#'a'", "P0006"), ("CHAR#'ab'", "P0006"), ("REAL#1.0E39", "P0006"), ("BYTE#256", "P0006")]);
    bad(&[("INT# 5", "P0006"), ("INT#", "P0006"), ("MyInt#5", "P0006"), ("INT#TRUE", "P0006")]);
}

#[test]
fn section_15_enumerators() {
    good(&[("Color#Red", "Color#Red")]);
    bad(&[("INT#Red", "P0006")]);
}

#[test]
fn section_15_durations() {
    good(&[
        ("T#1d2h3m4s5ms6us7ns", "TIME#93784005006007"),
        ("T#-1.5s", "TIME#-1500000000"),
        ("t#14.7d", "TIME#1270080000000000"),
    ]);
    good(&[("T#25h_15m", "TIME#90900000000000"), ("T#1m_30.5s", "TIME#90500000000"), ("LTIME#100us", "LTIME#100000")]);
    good(&[("LT#1ns", "LTIME#1"), ("T#14ms", "TIME#14000000"), ("T#-14ms", "TIME#-14000000"), ("T#1000ms", "TIME#1000000000")]);
    good(&[("TIME#5d_14h_12m_18s_3.5ms", "TIME#483138003500000"), ("LTIME#5m_30s_500ms_100.1us", "LTIME#330500100100")]);
    good(&[("T#0.000_000_001s", "TIME#1"), ("T#106751d", "TIME#9223286400000000000"), ("T#1H_2M", "TIME#3720000000000")]);
    bad(&[
        ("T#1.5h_3m", "P0007"),
        ("T#3s_2m", "P0007"),
        ("T#", "P0007"),
        ("T#5", "P0007"),
        ("T#1s_", "P0007"),
        ("T#1s1s", "P0007"),
    ]);
    bad(&[("T#1x", "P0007"), ("T#ms", "P0007"), ("T#106752d", "P0007"), ("T#1__0s", "P0007"), ("T#1.2.3s", "P0007")]);
    bad(&[("T#99999999999999999999999999999999999999999999d", "P0007")]);
    vendor(&[("T#0", "TIME#0", "P0007"), ("T#1h_61m", "TIME#7260000000000", "P0007")]);
}

#[test]
fn durations_are_exact_and_round_half_to_even() {
    vendor(&[("T#0.5ns", "TIME#0", "P0007"), ("T#1.5ns", "TIME#2", "P0007"), ("T#2.5ns", "TIME#2", "P0007")]);
    vendor(&[("T#2.50000000000000000000000000000001ns", "TIME#3", "P0007"), ("T#0.0000000001s", "TIME#0", "P0007")]);
    good(&[("T#0.1s", "TIME#100000000"), ("T#0.300000000s", "TIME#300000000")]);
}

#[test]
fn section_15_dates() {
    let day = |n: i64| format!("{}", n * 86_400_000_000_000);
    good(&[("D#2024-02-29", &format!("DATE#{}", day(19782))), ("DATE#1984-6-5", &format!("DATE#{}", day(5269)))]);
    good(&[
        ("D#1970-01-01", "DATE#0"),
        ("LDATE#1969-12-31", &format!("LDATE#{}", day(-1))),
        ("LD#2000-2-29", "LDATE#951782400000000000"),
    ]);
    good(&[("TOD#23:59:59.999", "TOD#86399999000000"), ("TIME_OF_DAY#7:5:3", "TOD#25503000000000"), ("LTOD#0:0:0", "LTOD#0")]);
    good(&[("DT#1984-06-25-15:36:55.360_227_400", "DT#457025815360227400"), ("LDT#1970-1-1-0:0:0.000000001", "LDT#1")]);
    bad(&[
        ("D#2023-02-29", "P0007"),
        ("D#1900-02-29", "P0007"),
        ("D#2024-13-01", "P0007"),
        ("D#2024-00-01", "P0007"),
        ("D#2024-02", "P0007"),
    ]);
    bad(&[
        ("TOD#24:00:00", "P0007"),
        ("TOD#12:60:00", "P0007"),
        ("TOD#12:00:60", "P0007"),
        ("DT#2024-01-01", "P0007"),
        ("D#", "P0007"),
    ]);
    bad(&[("D#3000-01-01", "P0007"), ("DT#1600-01-01-00:00:00", "P0007")]);
    vendor(&[("TOD#12:00", "TOD#43200000000000", "P0007")]);
}

#[test]
fn section_15_strings() {
    good(&[("'$''", r"'\''"), ("'$$'", "'$'"), ("'$0A$0d'", r"'\n\r'"), ("'$R$L'", r"'\r\n'"), ("'a\"b'", "'a\\\"b'")]);
    good(&[
        ("'$n$P$t'", r"'\n\x0c\t'"),
        ("'$\"'", "'\\\"'"),
        ("''", "''"),
        ("'ä'", r"'\xc3\xa4'"),
        ("'(* no *) // {'", "'(* no *) // {'"),
    ]);
    good(&[("\"$00C4\"", "\"\u{c4}\""), ("\"$\"\"", "\"\"\""), ("\"ä😀\"", "\"ä😀\"")]);
    bad(&[("'$q'", "P0004"), ("'$4'", "P0004"), ("\"$41\"", "P0004"), ("'a\tb'", "P0004"), ("'$ä'", "P0004")]);
    assert_eq!(codes("PROGRAM p\nx := 'abc\n;y := 1;\nEND_PROGRAM"), ["P0003 2:6"]);
    assert_eq!(codes("PROGRAM p\nx := \"abc$\n;y := 1;\nEND_PROGRAM"), ["P0003 2:6"]);
}

#[test]
fn section_15_addresses() {
    good(&[("%IX1.2", "%IX1.2"), ("%QW3", "%QW3"), ("%MD48", "%MD48"), ("%I*", "%IX*"), ("%ix0.0", "%IX0.0"), ("%I3", "%IX3")]);
    good(&[("%QX1.2.3.4", "%QX1.2.3.4"), ("%ML7", "%ML7"), ("%MB*", "%MB*")]);
    bad(&[("%Z1", "P0008"), ("%IX", "P0008"), ("%I1*", "P0008"), ("%IX99999999999", "P0008"), ("%I1.2.3.4.5.6.7.8.9", "P0008")]);
}

#[test]
fn section_15_comments() {
    assert_eq!(tokens("(* a (* b *) c *) x"), (vec![Tok::Word], vec![]));
    assert_eq!(tokens("/* a /* b */ (* c */ x"), (vec![Tok::Word], vec![]));
    assert_eq!(tokens("// x (* y\nz"), (vec![Tok::Word], vec![]));
    assert_eq!(tokens("(* // *) z // '"), (vec![Tok::Word], vec![]));
    assert_eq!(tokens("x (* (* *)"), (vec![Tok::Word], vec!["P0002"]));
    assert_eq!(tokens("x /* *"), (vec![Tok::Word], vec!["P0002"]));
    assert_eq!(tokens("(*)"), (vec![], vec!["P0002"]));
    assert_eq!(tokens("a{attribute 'x' := 'y'}b{{ } }}c"), (vec![Tok::Word; 3], vec![]));
    assert_eq!(tokens("a { b"), (vec![Tok::Word], vec!["P0002"]));
}

#[test]
fn pragmas_that_change_the_program_are_refused() {
    for text in ["{IF defined(x)}", "{#include \"a\"}", "{extern int x;}", "{{extern int x;}}"] {
        assert_eq!(tokens(text), (vec![], vec!["P0012"]), "{text}");
    }
}

#[test]
fn section_15_identifiers() {
    let names = |body: &str| codes(&format!("PROGRAM p VAR {body} : INT; END_VAR END_PROGRAM"));
    assert_eq!(names("A_B, a_b, _x, Größe, x1"), [""; 0]);
    assert_eq!(names("A__B"), ["P0009 1:15"]);
    assert_eq!(names("A_"), ["P0009 1:15"]);
    assert_eq!(codes("PROGRAM p\nA__B := a__b;\nEND_PROGRAM"), ["P0009 2:1"], "reported once");
}

#[test]
fn section_15_parts_and_members() {
    good(&[("x.3", "x.%X3"), ("x.%X3", "x.%X3"), ("x.%B1", "x.%B1"), ("r.f", "r.f"), ("x.%w1", "x.%W1"), ("x[1].2", "x[1].%X2")]);
    bad(&[("x.%Z1", "P0008"), ("x.99999999999", "P0008"), ("x.%X1.2", "P0008")]);
}

#[test]
fn characters_that_start_nothing_give_one_message_a_run() {
    assert_eq!(tokens("a ??? b").1, ["P0001"]);
    assert_eq!(tokens("a \u{201c}b\u{201d}").1, ["P0001", "P0001"]);
    assert_eq!(tokens("a\u{a0}b"), (vec![Tok::Word, Tok::Word], vec!["P0001"]));
    assert_eq!(codes("PROGRAM p\nx := 5 ? 3;\ny := @;\nEND_PROGRAM"), ["P0001 2:8", "P0001 3:6"]);
}

#[test]
fn operators_are_the_longest_that_fit() {
    use Tok::*;
    let (list, diags) = tokens(":= => <> <= >= ** .. < > = * / + - & ^ ( ) [ ] , ; : . ?=");
    let want = vec![
        Assign, Arrow, Ne, Le, Ge, Power, Range, Lt, Gt, Eq, Star, Slash, Plus, Minus, Amp, Caret, LParen, RParen, LBracket,
        RBracket, Comma, Semi, Colon, Dot, RefAssign,
    ];
    assert_eq!((list, diags), (want, vec![]));
}
