//! The bodies of the fuzz targets with random and mutated bytes. `TAKT_RUNS` and `TAKT_SEED` set how many and from where.

use takt_base::Severity;
use takt_image::encode::encode;
use takt_tests::fuzz;
use takt_tests::generate::{Shape, program};
use takt_tests::plc::compile_st;
use takt_tests::rng::Rng;

const ST: &str = "TYPE R : INT (0..9); E : (a1, b1); S : STRUCT x : R; s : STRING[5]; END_STRUCT; END_TYPE
FUNCTION_BLOCK f VAR_INPUT c : BOOL R_EDGE; END_VAR VAR_IN_OUT n : DINT; END_VAR n := n * 2; END_FUNCTION_BLOCK
PROGRAM p VAR a : ARRAY[1..3] OF S; i : INT; t : TON; d AT %QW1 : WORD; b : f; k : DINT; END_VAR
FOR i := 1 TO 3 BY 2 DO a[i].x := LIMIT(0, i, 9); IF d.3 THEN EXIT; ELSIF i = 2 THEN CONTINUE; END_IF; END_FOR;
CASE i OF 1..3, 5: t(IN := NOT d.%X1, PT := T#1s5ms); ELSE b(c := t.Q, n := k); END_CASE;
a[2].s := CONCAT('x$'', MID(a[1].s, 1, 2)); WHILE k < 16#7F DO k := k + 1; END_WHILE END_PROGRAM
CONFIGURATION c RESOURCE r ON plc TASK fast (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM x WITH fast : p (t WITH slow);
TASK slow (PRIORITY := 3, SINGLE := %IX0.1); END_RESOURCE RESOURCE s ON plc.x PROGRAM x : p; END_RESOURCE
VAR_ACCESS i : r.x.i : INT READ_WRITE; j : s.x.a[2].x : R; END_VAR END_CONFIGURATION";

/// Instruction List.
const IL: &str = "FUNCTION f : INT VAR_INPUT a : INT; b : INT; END_VAR
LD a
SUB( b
MUL( 3
ADD a
)
)
ST f
END_FUNCTION
PROGRAM p VAR t : TON; c : CTU; q, r : BOOL; n : INT; END_VAR
again: LDN q
AND N ( r
ORN %IX0.0
)
ST q
JMPC over
LD 1
JMP both
over: LD 2
both: ST n
f 5
CAL t(IN := q, PT := T#1s, Q => r)
LD q
CALC t(
 IN := ( LD q
   AND r )
 NOT Q => q
)
LD q
CU c
R c
S r
LD n
ADD 1
ST n
LT 9
JMPCN again
RET
END_PROGRAM";

const NGC: &str = "%\nO100 (plate)\nN10 G90 G21 G17\nN20 G0 X10.5 Y-3 Z2\nG1 F200 Z-1\nG2 X20 Y0 I5 J3\nG81 R2 Z-5 X3\nG80\n#1=[2+3*SIN[30]]\nM3 S1000\nM30\n%\n";

const WORDS: [&str; 24] = [
    "END_IF", "(", ")", "[", "]", ";", ":=", "=>", "VAR", "END_VAR", "'", "\"", "16#", "T#", "..", "%IX0.", "ARRAY[", "OF", "-",
    "**", "E", "#", "(*", "\0",
];

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

/// A text with some bytes changed, dropped, doubled or replaced by words.
fn mutate(text: &[u8], random: &mut Rng) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for _ in 0..1 + random.below(6) {
        let at = random.below(bytes.len() + 1);
        let end = (at + random.below(20)).min(bytes.len());
        match random.below(5) {
            0 if at < bytes.len() => bytes[at] = random.bits() as u8,
            1 => drop(bytes.drain(at..end)),
            2 => {
                let to = random.below(bytes.len() + 1);
                let part = bytes[at..end].to_vec();
                drop(bytes.splice(to..to, part));
            }
            _ => drop(bytes.splice(at..at, random.pick(&WORDS).bytes())),
        }
    }
    bytes
}

fn random_bytes(random: &mut Rng) -> Vec<u8> {
    (0..random.below(200)).map(|_| random.bits() as u8).collect()
}

/// Calls a target with mutations of the texts, now and then with noise.
fn drive(runs: u64, texts: &[Vec<u8>], target: fn(&[u8])) {
    let mut random = Rng::new(setting("TAKT_SEED", 1));
    for i in 0..setting("TAKT_RUNS", runs) {
        let bytes = if i % 10 == 0 { random_bytes(&mut random) } else { mutate(&texts[random.below(texts.len())], &mut random) };
        target(&bytes);
    }
}

#[test]
fn source_text() {
    let generated = (0..5).map(|seed| program(seed, Shape { statements: 2, scalars: 5, units: 1 }).into_bytes());
    let texts: Vec<_> = [ST, IL].map(|t| t.as_bytes().to_vec()).into_iter().chain(generated).collect();
    assert!(compile_st(IL).diags.iter().all(|d| d.severity != Severity::Error), "{:?}", compile_st(IL).diags);
    assert!(compile_st(ST).diags.iter().all(|d| d.severity != Severity::Error), "{:?}", compile_st(ST).diags);
    drive(1500, &texts, fuzz::st);
}

#[test]
fn part_programs() {
    drive(20_000, &[NGC.into()], fuzz::ngc);
}

#[test]
fn images() {
    let image = compile_st(ST).image.expect("no errors");
    drive(3000, &[encode(&image)], fuzz::image);
}

#[test]
fn seeds() {
    drive(30, &[vec![1, 2, 3, 4, 5]], fuzz::seed);
}
