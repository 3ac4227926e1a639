//! Hostile texts: bounded nesting, linear time, no panic.

use super::*;
use std::time::{Duration, Instant};

/// Number of messages; the text must be parsed within a time that no quadratic algorithm would meet.
fn messages(text: &str) -> Vec<String> {
    let start = Instant::now();
    let got = codes(text);
    assert!(start.elapsed() < Duration::from_secs(5), "{} bytes took {:?}", text.len(), start.elapsed());
    got
}

fn program(body: &str) -> String {
    format!("PROGRAM p\n{body}\nEND_PROGRAM\nPROGRAM last\nEND_PROGRAM")
}

#[test]
fn nesting_has_a_limit_and_one_message() {
    const N: usize = 10_000;
    let cases = [
        format!("x := {}1{};", "(".repeat(N), ")".repeat(N)),
        format!("x := {}1;", "(".repeat(N)),
        format!("x := {}a;", "NOT ".repeat(N)),
        format!("x := {}a;", "-".repeat(N)),
        format!("x := {}a{};", "f(".repeat(N), ")".repeat(N)),
        format!("x := {}a{};", "a[".repeat(N), "]".repeat(N)),
        format!("x := a{};", " + a".repeat(N)),
        format!("x := a{};", ".b".repeat(N)),
        format!("x := a{};", "[1]".repeat(N)),
        format!("x := f{};", "()".repeat(N)),
        format!("x := 1{};", "**(a".repeat(N)),
        format!("{}{}", "IF a THEN ".repeat(N), "END_IF; ".repeat(N)),
        "IF a THEN ".repeat(N),
        format!("{}{}", "CASE a OF 1: ".repeat(N), "END_CASE; ".repeat(N)),
        format!("{}{}", "REPEAT ".repeat(N), "UNTIL a END_REPEAT; ".repeat(N)),
        "FOR i := 1 TO 2 DO ".repeat(N),
    ];
    for body in cases {
        let (file, diags, _) = parse(&program(&body));
        let got: Vec<_> = diags.iter().map(|d| d.code.text()).collect();
        assert_eq!(got, ["P0011"], "{:.60}", body);
        assert_eq!(file.items.len(), 2, "{:.60}", body);
    }
}

#[test]
fn types_and_initial_values_nest_within_the_limit() {
    const N: usize = 10_000;
    let cases = [
        format!("a : {}INT;", "ARRAY [0..1] OF ".repeat(N)),
        format!("a : INT := {}1{};", "[".repeat(N), "]".repeat(N)),
        format!("a : INT := {}1{};", "(a := ".repeat(N), ")".repeat(N)),
        format!("a : INT := {}1{};", "[2(".repeat(N), ")]".repeat(N)),
    ];
    for decl in cases {
        let text = format!("PROGRAM p VAR {decl} b : INT; END_VAR END_PROGRAM");
        let got = messages(&text);
        assert_eq!(got.len(), 1, "{:.60} {got:?}", decl);
        assert!(got[0].starts_with("P0011"), "{:.60} {got:?}", decl);
    }
    let nested = format!("TYPE a : {}{} END_TYPE", "STRUCT a : ".repeat(N), "END_STRUCT; ".repeat(N));
    assert!(messages(&nested)[0].starts_with("P0011"));
}

#[test]
fn what_is_not_nested_has_no_limit() {
    let many = program(&"IF a THEN x := (1 + 2) * f(a, b); END_IF;\n".repeat(20_000));
    assert!(messages(&many).is_empty());
    let deep = program(&format!("{}x := ((((1))));{}", "IF a THEN ".repeat(150), "END_IF;".repeat(150)));
    assert!(messages(&deep).is_empty());
    assert!(messages(&program(&format!("x := a{};", " OR a".repeat(250)))).is_empty());
    let both = format!("{}x := {}1{};{}", "IF a THEN ".repeat(198), "(".repeat(190), ")".repeat(190), "END_IF;".repeat(198));
    assert!(messages(&program(&both)).is_empty());
    let elements = format!("PROGRAM p VAR a : ARRAY [1..9] OF INT := [{}]; END_VAR END_PROGRAM", vec!["1"; 100_000].join(","));
    assert!(messages(&elements).is_empty());
}

#[test]
fn nested_and_unterminated_comments_take_linear_time() {
    const N: usize = 10_000;
    assert!(messages(&format!("{}{}", "(*".repeat(N), "*)".repeat(N))).is_empty());
    assert_eq!(messages(&"(*".repeat(N)), ["P0002 1:1"]);
    assert_eq!(messages(&"/* ".repeat(N)), ["P0002 1:1"]);
    assert_eq!(messages(&"{".repeat(N)), ["P0002 1:1"]);
}

#[test]
fn a_mebibyte_of_one_token_takes_linear_time() {
    let tokens = [
        "(",
        ")",
        "[",
        "]",
        "{",
        "}",
        ";",
        ":",
        ":=",
        ",",
        ".",
        "..",
        "'",
        "\"",
        "a",
        "1",
        "1.",
        "#",
        "a#",
        "%",
        "%I",
        "T#",
        "D#1-",
        "@",
        "$",
        "ä",
        "\u{201c}",
        "\u{a0}",
        "\0",
        "(*",
        "*)",
        "/*",
        "//",
        "\n",
        "a ",
        "1 ",
        "a; ",
        "a: ",
        "a, ",
        "a.",
        "IF ",
        "END_IF ",
        "END_IF;",
        "ELSE ",
        "CASE ",
        "UNTIL ",
        "FOR ",
        "VAR ",
        "END_VAR ",
        "PROGRAM ",
        "END_PROGRAM ",
        "PROGRAM a ",
        "FUNCTION ",
        "TYPE ",
        "STRUCT ",
        "a : STRUCT ",
        "CLASS ",
        "METHOD ",
        "METHOD a ",
        "STEP a ",
        "NAMESPACE ",
        "RESOURCE ",
        "TASK ",
        "CONFIGURATION ",
        "VAR_CONFIG ",
        "ARRAY ",
        "NOT ",
        "AND ",
        "- ",
        "+",
        "x := ",
        "x := (",
        "f(",
        "a[",
        "exit := ",
        "'\n",
        "@;",
        "x := @;\n",
        "LD a ",
        "RETURN 1 ",
        "a : ",
        "a : ARRAY [",
        "a AT ",
        "INT#",
        "ENDIF ",
        "ELSEIF ",
        "ELSE IF a THEN ",
        "^",
        "?=",
        "== ",
    ];
    for token in tokens {
        let text = token.repeat((1 << 20) / token.len());
        let part = token.repeat((1 << 17) / token.len());
        for text in [text, format!("PROGRAM p {part}"), format!("PROGRAM p VAR {part}"), format!("PROGRAM p CASE a OF 1: {part}")]
        {
            let got = messages(&text);
            assert!(got.len() <= 2 * (crate::syntax::report::MAX_ERRORS + 1), "{token:?}: {}", got.len());
        }
    }
}

#[test]
fn everything_may_be_unterminated() {
    let text = include_str!("plant.st");
    assert_eq!(messages(text), [""; 0]);
    for (cut, _) in text.char_indices() {
        parse(&text[..cut]);
        parse(&text[cut..]);
    }
}

#[test]
fn errors_are_limited() {
    let got = messages(&program(&"x := ;\n".repeat(10_000)));
    assert_eq!(got.len(), crate::syntax::report::MAX_ERRORS + 1);
    assert!(got.last().is_some_and(|c| c.starts_with("P0013")));
}

/// A generator of numbers that is the same everywhere (xorshift64*).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % n
    }
}

#[test]
fn a_hundred_thousand_random_byte_strings() {
    let mut random = Random(7341);
    for _ in 0..100_000 {
        let bytes: Vec<u8> = (0..random.below(60)).map(|_| random.below(256) as u8).collect();
        let mut sources = Sources::new();
        let id = sources.add_bytes("a.st", bytes);
        crate::syntax::parse(&sources, id, &mut Sink::new());
    }
}

#[test]
fn a_hundred_thousand_mutated_programs() {
    let text = include_str!("plant.st");
    let mut sink = Sink::new();
    let mut sources = Sources::new();
    let id = sources.add("a.st", text);
    let tokens = crate::syntax::lexer::lex(text, id, &mut crate::syntax::report::Report::new(&mut sink)).list;
    let words: Vec<&str> = tokens.iter().map(|t| &text[t.start as usize..t.end as usize]).collect();
    let mut random = Random(4711);
    for _ in 0..100_000 {
        let from = random.below(words.len());
        let mut some: Vec<&str> = words[from..(from + 80).min(words.len())].to_vec();
        for _ in 0..1 + random.below(4) {
            let at = random.below(some.len());
            match random.below(3) {
                0 => drop(some.remove(at)),
                1 => some.insert(at, words[random.below(words.len())]),
                _ => some[at] = words[random.below(words.len())],
            }
            if some.is_empty() {
                some.push("x");
            }
        }
        let (_, diags, sources) = parse(&some.join(" "));
        for d in &diags {
            assert!(!render(d, &sources).is_empty() && !d.label.is_empty());
        }
    }
}
