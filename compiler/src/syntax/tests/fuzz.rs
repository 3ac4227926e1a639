//! Random texts and damaged programs: no panic, no endless loop, messages inside the text. Seeded, so that a failure repeats.

use super::*;
use std::time::{Duration, Instant};

/// The corpus: every construct, valid, in small units.
const PROGRAMS: &[&str] = &[
    "PROGRAM p VAR a, b : INT := 5; c AT %QX0.1 : BOOL; t : TON := (PT := T#1s); END_VAR a := b + 2 * (a - 1); t(IN := c, Q => c); END_PROGRAM",
    "FUNCTION f : INT VAR_INPUT x : INT; END_VAR IF x > 1 THEN f := 1; ELSIF x = 0 THEN f := 2; ELSE RETURN; END_IF; END_FUNCTION",
    "FUNCTION_BLOCK fb VAR a : ARRAY [0..3, 1..2] OF INT := [1, 2(3)]; END_VAR FOR i := 1 TO 9 BY 2 DO a[i, 1] := -a.3; EXIT; END_FOR; END_FUNCTION_BLOCK",
    "TYPE e : (A, B := 2) := A; s : STRUCT x : REAL; y : STRING[8]; END_STRUCT; r : INT (0..9); END_TYPE",
    "PROGRAM q CASE x OF 1, 2..3: y := 'a$N'; Red: z(); ELSE ; END_CASE; WHILE a AND NOT b DO CONTINUE; END_WHILE; END_PROGRAM",
    "PROGRAM r REPEAT x := D#2024-01-01; y := INT#16#FF; UNTIL %IX0.0 OR_ELSE b END_REPEAT; END_PROGRAM",
    "CONFIGURATION c VAR_GLOBAL g : INT; END_VAR RESOURCE r ON PLC TASK t(INTERVAL := T#10ms, PRIORITY := 1); PROGRAM p WITH t : m(a := g); END_RESOURCE END_CONFIGURATION",
    "CLASS c METHOD m x := 1; END_METHOD END_CLASS INTERFACE i END_INTERFACE NAMESPACE n PROGRAM p END_PROGRAM END_NAMESPACE",
];

/// Pieces that mutations put in: every keyword class, operator and a few broken tokens.
const PIECES: &[&str] = &[
    "IF",
    "THEN",
    "ELSE",
    "ELSIF",
    "END_IF",
    "CASE",
    "OF",
    "END_CASE",
    "FOR",
    "TO",
    "BY",
    "DO",
    "END_FOR",
    "WHILE",
    "END_WHILE",
    "REPEAT",
    "UNTIL",
    "END_REPEAT",
    "VAR",
    "VAR_GLOBAL",
    "END_VAR",
    "PROGRAM",
    "END_PROGRAM",
    "FUNCTION",
    "END_FUNCTION",
    "TYPE",
    "END_TYPE",
    "STRUCT",
    "END_STRUCT",
    "ARRAY",
    "NOT",
    "AND",
    "MOD",
    "(",
    ")",
    "[",
    "]",
    ":=",
    "=>",
    "..",
    ".",
    ",",
    ";",
    ":",
    "#",
    "^",
    "**",
    "-",
    "=",
    "==",
    "'",
    "\"",
    "(*",
    "*)",
    "{",
    "}",
    "T#",
    "T#1",
    "16#",
    "%IX",
    "%IX1.2",
    "1.",
    "1e9",
    "x",
    "INT",
    "INT#",
    "STRING",
    "\n",
    "\u{20ac}",
    "$",
    "NULL",
    "THIS",
    "METHOD",
    "END_METHOD",
    "ACTION",
    "STEP",
    "LD",
    "JMP",
    "RETURN",
    "EXIT",
    "CONFIGURATION",
    "RESOURCE",
    "TASK",
    "WITH",
    "AT",
    "{external}",
];

/// xorshift64*: enough for tests.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        ((self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize) % n
    }
}

/// Parses; every message and every unit lies inside the text and can be shown.
fn survive(bytes: Vec<u8>) {
    let mut sources = Sources::new();
    let id = sources.add_bytes("a.st", bytes);
    let mut sink = Sink::new();
    let file = super::super::parse(&sources, id, &mut sink);
    let text = &sources.get(id).text;
    for d in &sink.diags {
        let inside = d.span.start <= d.span.end && text.get(d.span.start as usize..d.span.end as usize).is_some();
        assert!(inside, "{:?} in {text:?}", d.span);
    }
    if let Some(d) = sink.diags.first() {
        assert!(render(d, &sources).contains(d.code.text()));
    }
    assert!(file.items.len() <= text.len());
}

fn quickly(what: &str, mut run: impl FnMut()) {
    let start = Instant::now();
    run();
    assert!(start.elapsed() < Duration::from_secs(30), "{what} took {:?}", start.elapsed());
}

#[test]
fn random_bytes() {
    let mut random = Random(0x7461_6b74_2073_7431);
    quickly("100,000 random texts", || {
        for _ in 0..100_000 {
            let ascii_only = random.below(2) == 0;
            let len = random.below(60);
            let byte = |r: &mut Random| if ascii_only { 32 + r.below(95) as u8 } else { r.below(256) as u8 };
            survive((0..len).map(|_| byte(&mut random)).collect());
        }
    });
}

#[test]
fn mutated_programs() {
    let corpus: Vec<Vec<&str>> = PROGRAMS.iter().map(|p| p.split_inclusive([' ', '(', ')', ',', ';']).collect()).collect();
    let mut random = Random(0x7461_6b74_2073_7432);
    quickly("100,000 damaged programs", || {
        for _ in 0..100_000 {
            let mut parts = corpus[random.below(corpus.len())].clone();
            for _ in 0..=random.below(3) {
                mutate(&mut parts, &corpus, &mut random);
            }
            survive(parts.join(if random.below(8) == 0 { " " } else { "" }).into_bytes());
        }
    });
}

/// Takes a part out, doubles one, exchanges two, or puts in a piece or a run of another program.
fn mutate<'a>(parts: &mut Vec<&'a str>, corpus: &[Vec<&'a str>], random: &mut Random) {
    if parts.is_empty() {
        return;
    }
    let at = random.below(parts.len());
    match random.below(6) {
        0 => {
            parts.remove(at);
        }
        1 => parts.insert(at, parts[at]),
        2 => parts.insert(at, PIECES[random.below(PIECES.len())]),
        3 => parts[at] = PIECES[random.below(PIECES.len())],
        4 => parts.truncate(at),
        _ => {
            let other = &corpus[random.below(corpus.len())];
            let from = random.below(other.len());
            let to = (from + 1 + random.below(8)).min(other.len());
            parts.splice(at..at, other[from..to].iter().copied());
        }
    }
}

/// The corpus itself is valid: the mutations start from something.
#[test]
fn corpus_is_valid() {
    for program in &PROGRAMS[..PROGRAMS.len() - 1] {
        assert_eq!(codes(program), Vec::<String>::new(), "{program}");
    }
}
