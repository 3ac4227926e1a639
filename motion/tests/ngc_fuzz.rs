//! Any text is read without panic or hang; generated programs obey the rules that hold for all programs.

mod common;

use common::programs::{Random, program};
use takt_base::{Severity, SourceId, Sources};
use takt_motion::canon::{Canon, Position, Step};
use takt_motion::ngc::{Dialect, Interpreter, Language, Options, Style, Travel, check};
use takt_motion::stats::Stats;
use takt_motion::{draw, print};

const RUNS: usize = 100_000;

const DIALECTS: [Dialect; 4] = [Dialect::LinuxCnc, Dialect::LinuxCnc, Dialect::FanucMill, Dialect::FanucTurn];

fn options(random: &mut Random) -> Options {
    let all = |v| Position { x: v, y: v, z: v, a: v, b: v, c: v };
    let travel = Travel { min: all(-100.0), max: all(100.0) };
    Options {
        style: *random.pick(&[Style::Auto, Style::Ngc, Style::Semicolon]),
        skip_deleted: random.below(2) == 0,
        travel: (random.below(2) == 0).then_some(travel),
        language: Language { dialect: *random.pick(&DIALECTS), lenient: random.below(4) == 0, ..Language::default() },
        ..Options::default()
    }
}

/// Reads a text in every way; what must hold for any text.
fn try_all(text: &str, random: &mut Random, readers: bool) {
    let options = options(random);
    let options_shown = format!("{options:?}");
    let fanuc = options.language.dialect.is_fanuc();
    let mut steps: Vec<Step> = Vec::new();
    let mut error = None;
    for step in Interpreter::new(SourceId(0), text, options.clone()).take(10_000) {
        match step {
            Ok(step) => steps.push(step),
            Err(diag) => error = Some(*diag),
        }
    }
    let diags = check(SourceId(0), text, options);
    let dialect = fanuc;
    let flows = dialect || text.contains(['o', 'O']) || text.contains("99");
    if !flows {
        assert_eq!(diags.iter().find(|d| d.severity == Severity::Error), error.as_ref(), "{text:?} {options_shown}");
    }
    let ended = matches!(steps.last().map(|s| &s.command), Some(Canon::ProgramEnd(_)));
    assert!(ended == error.is_none() || steps.len() == 10_000, "{text:?}");
    assert!(steps.windows(2).all(|w| w[0].block <= w[1].block && (flows || w[0].line <= w[1].line)), "{text:?}");
    assert!(diags.iter().all(|d| d.span.start <= d.span.end && d.span.end as usize <= text.len()), "{text:?}");
    if readers {
        read_all(text, &steps, &diags);
    }
}

fn read_all(text: &str, steps: &[Step], diags: &[takt_base::Diag]) {
    let mut sources = Sources::new();
    sources.add("fuzz.ngc", text);
    diags.iter().for_each(|d| assert!(!takt_base::diag::render(d, &sources).is_empty()));
    let stats = Stats::of(steps, Position::default());
    assert!(stats.feed_length_mm().is_finite() && stats.ideal_time_s().is_finite(), "{text:?}");
    assert!(text.contains("NaN") || !draw::draw(steps, text).to_svg().contains("NaN"), "{text:?}");
    for step in steps {
        let line = print::line(step, true);
        let back = print::parse(&line).unwrap_or_else(|e| panic!("{line}: {e:?}"));
        assert_eq!(print::command(&back.command), print::command(&step.command));
    }
}

const ALPHABET: &[u8] = b"GGGMXYZIJKRPFSTN0123456789.-+ ();%/\n\rabcO#[]=*\t\"\\&<,\0\xc3\xa4$";

#[test]
fn random_bytes() {
    let mut random = Random(1);
    for i in 0..RUNS {
        let length = random.below(48);
        let bytes: Vec<u8> = (0..length).map(|_| if i % 4 == 0 { random.next() as u8 } else { *random.pick(ALPHABET) }).collect();
        try_all(&String::from_utf8_lossy(&bytes), &mut random, i % 50 == 0);
        print::parse(&String::from_utf8_lossy(&bytes)).ok();
    }
}

/// Programs of the Fanuc-style dialects with every code, and macro statements, cut and mixed.
#[test]
fn mutated_fanuc_programs() {
    let mut random = Random(4);
    let rows = include_str!("fanuc/codes.txt").lines().filter_map(|row| row.split('|').nth(1));
    let seeds: Vec<String> = rows.chain(MACROS.iter().copied()).map(|row| row.replace("\\n", "\n")).collect();
    for i in 0..RUNS {
        let mut bytes = random.pick(&seeds).clone().into_bytes();
        if i % 3 == 0 {
            bytes.extend(b"\n");
            bytes.extend(random.pick(&seeds).bytes());
        }
        for _ in 0..=random.below(4) {
            mutate(&mut bytes, &mut random);
        }
        let text = String::from_utf8_lossy(&bytes);
        let dialect = *random.pick(&[Dialect::FanucMill, Dialect::FanucTurn]);
        let language = Language { dialect, lenient: i % 5 == 0, ..Language::default() };
        let options = Options { language, silent_rows_max: 2000, ..options(&mut random) };
        let steps = Interpreter::new(SourceId(0), &*text, options.clone()).take(5000).filter(Result::is_ok).count();
        assert!(steps > 0, "{text:?}");
        // A check follows endless programs very far: only those without loops are checked.
        if !text.to_ascii_uppercase().contains(['O', 'D']) && !text.contains("99") {
            let diags = check(SourceId(0), &*text, options);
            assert!(diags.iter().all(|d| d.span.start <= d.span.end && d.span.end as usize <= text.len()), "{text:?}");
        }
    }
}

/// Programs with G70 to G72.
fn contours() -> impl Iterator<Item = String> {
    include_str!("corpus/lathe.txt").lines().map(|row| row.replace("\\n", "\n"))
}

const MACROS: [&str; 8] = [
    "#1=0\\nWHILE[#1 LT 3]DO1\\nG0 X#1\\n#1=#1+1\\nEND1",
    "IF[#1 EQ #0]GOTO 20\\nG0 X1\\nN20 G0 X[SIN[30]*POW[2,3]]",
    "G65 P9 A1 I2 J3 I4\\nM30\\nO9\\n#100=#1+#4*#7\\nM99 P5",
    "M98 P20009\\nM30\\nO9\\nG91 G0 X1\\nM99",
    "#5221=10\\n#101=BCD[12] AND 7 OR 8\\n#[100+1]=##1\\n#3006=1(X)",
    "F9 G1 X10,R2\\nY10,C1\\nG3 X0 Y20 R10\\nG40",
    "F9 G6.2 P3 K0 X0 Y0\\nK0 X5 Y5\\nK0 X10 Y0\\nK1\\nK1\\nK1\\nG0 X0",
    "G98 F9 G0 X40\\nG12.1\\nG1 X30 C4\\nG3 X20 C0 R20\\nG13.1",
];

#[test]
fn mutated_programs() {
    let mut random = Random(2);
    let seeds: Vec<String> =
        (0..200).map(|_| program(&mut random, 6)).chain([include_str!("ngc/plate.ngc").to_owned()]).chain(contours()).collect();
    for i in 0..RUNS {
        let mut bytes = random.pick(&seeds).clone().into_bytes();
        for _ in 0..=random.below(4) {
            mutate(&mut bytes, &mut random);
        }
        try_all(&String::from_utf8_lossy(&bytes), &mut random, i % 50 == 0);
    }
}

fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len());
    let end = (at + random.below(12)).min(bytes.len());
    match random.below(4) {
        0 if at < bytes.len() => bytes[at] = *random.pick(ALPHABET),
        1 => bytes.insert(at, *random.pick(ALPHABET)),
        2 => drop(bytes.drain(at..end)),
        _ => {
            let part = bytes[at..end].to_vec();
            let to = random.below(bytes.len());
            bytes.splice(to..to, part);
        }
    }
}

/// Generated programs are right, however their blocks are written.
#[test]
fn generated_programs_are_right_in_every_style() {
    let mut random = Random(3);
    for _ in 0..500 {
        let text = program(&mut random, 30);
        let commands = |text: &str| {
            let steps = Interpreter::new(SourceId(0), text, Options::default());
            steps.map(|s| s.unwrap_or_else(|d| panic!("{d:?}\n{text}")).command).collect::<Vec<_>>()
        };
        let want = commands(&text);
        assert_eq!(commands(&text.replace('\n', ";")), want);
        assert_eq!(commands(&text.replace(' ', "").to_lowercase()), want);
        assert_eq!(
            commands(&text.replace('\n', " (note\t;) \r\n")).iter().filter(|c| !matches!(c, Canon::Comment(_))).count(),
            want.len()
        );
    }
}

/// Time is linear in the text, also for texts that are one long block or one long number.
#[test]
fn long_texts() {
    let n = 200_000;
    for text in [
        "X".repeat(n),
        "(".repeat(n),
        "1".repeat(n),
        ";".repeat(n),
        format!("G1X{}", "1 ".repeat(n)),
        "%\n".repeat(n),
        "G0X1X".repeat(n),
    ] {
        assert!(Interpreter::new(SourceId(0), text, Options::default()).count() < 10);
    }
    let words: String = "N1".to_owned() + &"G17".repeat(n);
    assert_eq!(check(SourceId(0), words, Options::default()).len(), n - 1);
}
