//! No tree that the parser can make brings the checker down: seeded mutations of valid programs, and deep nesting on a small stack.

use super::*;
use takt_base::Span;

/// xorshift64*.
struct Rng(u64);

impl Rng {
    fn next(&mut self, below: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % below.max(1)
    }
}

/// Words of the valid programs and what provokes the checker.
fn words(text: &str) -> Vec<&str> {
    let mut out = Vec::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let kind = |c: char| (c.is_alphanumeric() || c == '_', c.is_whitespace());
        let end = match kind(c) {
            (false, false) => c.len_utf8(),
            k => rest.find(|d| kind(d) != k).unwrap_or(rest.len()),
        };
        out.push(&rest[..end]);
        rest = &rest[end..];
    }
    out
}

const SPICE: &[&str] = &[
    "9223372036854775808",
    "-1",
    "0",
    "16#FFFF_FFFF_FFFF_FFFF",
    "1.0E308",
    "T#99999d",
    "'a'",
    "\"\"",
    "%QX0.0",
    "%IL8191",
    "TRUE",
    "Light#Red",
    "p1",
    "a[",
    "]",
    ".x",
    ".%B1",
    "TON",
    "F(",
    ")",
    "**",
    "MOD",
    "/",
    "fb",
    "s[1]",
    "ARRAY [0..2147483647] OF",
    "STRING[99999]",
    "=>",
    ":=",
    "STRUCT",
    "END_STRUCT",
    "R_EDGE",
    "VAR_IN_OUT",
    "CONSTANT",
    "RETAIN",
    "MUX(",
    "SEL(",
    "LIMIT(",
    "CONCAT(",
    "INT_TO_STRING(",
    "TO_INT(",
];

fn seeds() -> Vec<String> {
    let bodies = [
        "i := F(1, 2); fb(i := 1, io := d, NOT q => b2); ton1(IN := b1, PT := T#1s); light := SEL(b1, Red, Green);",
        "FOR i := 1 TO 10 BY 2 DO a[i] := pct; IF a[i] > 3 THEN EXIT; END_IF; END_FOR; CASE light OF Red: i := 1; Green..Amber: ; END_CASE;",
        "r := vLREAL_TO_REAL; t := t * 2.5; vDT := vDT + t; s := CONCAT(s8, 'x', INT_TO_STRING(i)); vWORD.3 := s[1] = 'q';",
        "m[1, 2] := r ** 2; p1 := ps[2]; p1.tag := LEFT(s, 3); %QW3 := %IW2 OR vWORD; WHILE NOT b1 DO i := i MOD 3; END_WHILE;",
    ];
    let mut seeds: Vec<String> = bodies.iter().map(|b| program(TYPES, VARS, b)).collect();
    seeds.push("VAR_GLOBAL CONSTANT N : INT := 4; T : ARRAY [0..N] OF REAL := [1.0, 4(2.0)]; END_VAR VAR_GLOBAL g AT %QX0.1 : BOOL; RETAIN : INT; END_VAR \
        TYPE P : STRUCT a : ARRAY [1..N] OF Q; END_STRUCT; Q : STRUCT s : STRING[N] := 'ab'; e : (u, v := 5) := v; END_STRUCT; END_TYPE \
        PROGRAM A VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : DINT; END_VAR VAR x : P := (a := [N((s := 'q'))]); END_VAR o := i; END_PROGRAM \
        CONFIGURATION c VAR_GLOBAL z : DINT; END_VAR RESOURCE r ON q TASK t (SINGLE := g, INTERVAL := T#1s, PRIORITY := 1); \
        PROGRAM p WITH t : A (i := N, o => z); END_RESOURCE END_CONFIGURATION".to_owned());
    seeds.push("FUNCTION_BLOCK F VAR q AT %Q* : BOOL; END_VAR VAR_EXTERNAL g : INT; END_VAR g := g + 1; END_FUNCTION_BLOCK \
        PROGRAM A VAR_OUTPUT o : BOOL; END_VAR VAR f : F; k : ARRAY [1..2] OF INT; END_VAR VAR_ACCESS own : k[2] : INT READ_WRITE; END_VAR f(); END_PROGRAM \
        CONFIGURATION c VAR_GLOBAL g : INT; END_VAR RESOURCE r ON q TASK t (SINGLE := p.o); PROGRAM p WITH t : A (f WITH t); END_RESOURCE \
        RESOURCE s ON q VAR_GLOBAL g : INT; END_VAR TASK t (INTERVAL := T#1s); PROGRAM RETAIN p WITH t : A (o => %QX0.3); END_RESOURCE \
        VAR_ACCESS a : r.p.k[1] : INT; b : s.g : INT READ_WRITE; d : r.%IX0.3 : BOOL; END_VAR \
        VAR_CONFIG r.p.f.q AT %QX0.1 : BOOL; s.p.f.q AT %QX0.2 : BOOL := TRUE; s.g : INT := 4; END_VAR END_CONFIGURATION".to_owned());
    let test =
        "%IX0.0 := ASSERT_EQ(Red, light, 'm'); ASSERT_NEAR(EXPECTED := r, ACTUAL := 1, TOLERANCE := 0.5); ASSERT_NE(s, 'x', s8);";
    seeds.push(format!("{TYPES} {{test 'a', scans := 3}} {}", program("", VARS, test)));
    seeds
}

fn mutate(rng: &mut Rng, words: &[&str], other: &[&str]) -> String {
    let mut out: Vec<&str> = words.to_vec();
    for _ in 0..1 + rng.next(4) {
        let at = rng.next(out.len());
        match rng.next(6) {
            0 => drop(out.remove(at)),
            1 => out[at] = SPICE[rng.next(SPICE.len())],
            2 => out.insert(at, SPICE[rng.next(SPICE.len())]),
            3 => out[at] = other[rng.next(other.len())],
            4 => {
                let to = rng.next(out.len());
                out.swap(at, to);
            }
            _ => {
                let end = (at + rng.next(12)).min(out.len());
                let piece: Vec<&str> = out[at..end].to_vec();
                let to = rng.next(out.len());
                out.splice(to..to, piece);
            }
        }
    }
    out.concat()
}

/// Checks without the library, for speed.
fn run(text: &str) -> usize {
    let mut sources = Sources::new();
    let id = sources.add("a.st", text);
    let mut sink = Sink::new();
    let file = syntax::parse(&sources, id, &mut sink);
    let hir = crate::hir::build(&[(id, file)], &sources, &mut sink);
    let fits = |s: Span| s.start <= s.end && s.end as usize <= text.len();
    assert!(sink.diags.iter().all(|d| fits(d.span)), "{text}");
    hir.pous.len() + sink.diags.len()
}

#[test]
fn twenty_thousand_mutations() {
    let seeds = seeds();
    let split: Vec<Vec<&str>> = seeds.iter().map(|s| words(s)).collect();
    let mut rng = Rng(0x7341_5EED);
    let mut total = 0;
    for _ in 0..20_000 {
        let (a, b) = (rng.next(split.len()), rng.next(split.len()));
        total += run(&mutate(&mut rng, &split[a], &split[b]));
    }
    assert!(total > 20_000);
}

/// The deepest trees that the parser lets through, on the stack of a test thread.
#[test]
fn deep_trees() {
    let wrap = |open: &str, close: &str, n: usize| format!("{}{}{}", open.repeat(n), "i", close.repeat(n));
    for body in [
        format!("i := {};", wrap("(", ")", 199)),
        format!("i := {};", wrap("-", "", 199)),
        format!("i := {};", wrap("F(", ", 1)", 199)),
        format!("i := {};", wrap("a[", "]", 199)),
        format!("i := i{};", " + i".repeat(255)),
        format!("b1 := b1{};", " AND (j / i > 2)".repeat(250)),
        format!("i := p1{};", ".x".repeat(255)),
        format!("{}i := i{};{}", "IF b1 THEN ".repeat(195), " + i".repeat(250), "END_IF;".repeat(195)),
        format!("s := {};", wrap("CONCAT(", ", 'x')", 199)),
    ] {
        run(&program(TYPES, VARS, &body));
    }
    let legal = format!("{}i := i{};{}", "IF b1 THEN ".repeat(195), " + i".repeat(250), "END_IF;".repeat(195));
    assert_eq!(stmt(&legal), "");
    let types: String = (0..5_000).map(|i| format!("t{i} : STRUCT m : t{}; END_STRUCT;\n", i + 1)).collect();
    assert!(check(&format!("TYPE {types} t5000 : INT; END_TYPE")).starts_with("P0011"));
}

/// Nothing takes more than linear time.
#[test]
fn large_programs() {
    let start = std::time::Instant::now();
    let vars: String = (0..5_000).map(|i| format!("w{i} : INT; ")).collect();
    let body: String = (0..20_000).map(|i| format!("w{} := w{} + 1;", i % 5_000, (i + 1) % 5_000)).collect();
    assert_eq!(check_in("", &vars, &body), "");
    let labels: String = (0..20_000).map(|i| format!("{}: ;", i)).collect();
    assert_eq!(check_in("", "i : INT;", &format!("CASE i OF {labels} END_CASE;")), "");
    assert!(start.elapsed() < std::time::Duration::from_secs(10), "{:?}", start.elapsed());
}
