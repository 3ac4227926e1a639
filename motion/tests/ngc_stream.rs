//! Part programs that are read by blocks: the same commands as from memory, an index of lines, and what happens to a file that changes.

mod common;
use common::Random;
use std::io;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, SystemTime};
use takt_base::{Code, Diag, SourceId, Sources};
use takt_motion::canon::{Canon, Step};
use takt_motion::ngc::text::window::{BLOCK, ROW_MAX};
use takt_motion::ngc::text::{ReadAt, Stamp, WHOLE_MAX};
use takt_motion::ngc::{Interpreter, Options, Text, check};

/// A file in memory that reads as badly as files may.
struct Fake {
    bytes: Vec<u8>,
    /// Most bytes that a read gives.
    part: usize,
    reads: AtomicU64,
    /// From this read on the file has another time; or reading fails; or it is shorter.
    changes: u64,
    fails: u64,
    shrinks: u64,
}

impl Fake {
    fn new(bytes: impl Into<Vec<u8>>) -> Self {
        let never = u64::MAX;
        Fake { bytes: bytes.into(), part: usize::MAX, reads: AtomicU64::new(0), changes: never, fails: never, shrinks: never }
    }
}

impl ReadAt for Fake {
    fn read_at(&self, buffer: &mut [u8], offset: u64) -> io::Result<usize> {
        let read = self.reads.fetch_add(1, Ordering::Relaxed);
        if read.is_multiple_of(3) && self.part < 1000 {
            return Err(io::ErrorKind::Interrupted.into());
        }
        if read >= self.fails {
            return Err(io::ErrorKind::TimedOut.into());
        }
        let end = if read >= self.shrinks { 0 } else { self.bytes.len() };
        let rest = self.bytes[..end].get(offset as usize..).unwrap_or(&[]);
        let n = rest.len().min(buffer.len()).min(self.part);
        buffer[..n].copy_from_slice(&rest[..n]);
        Ok(n)
    }
    fn stamp(&self) -> io::Result<Stamp> {
        let changed = self.reads.load(Ordering::Relaxed) > self.changes;
        Ok(Stamp { len: self.bytes.len() as u64, modified: Some(SystemTime::UNIX_EPOCH + Duration::from_secs(changed.into())) })
    }
}

fn streamed(fake: Fake) -> Text {
    Text::streamed(fake).unwrap()
}

fn run(text: Text) -> (Vec<Step>, Option<Diag>) {
    let (mut steps, mut error) = (Vec::new(), None);
    for step in Interpreter::new(SourceId(0), text, Options::default()) {
        match step {
            Ok(step) => steps.push(step),
            Err(diag) => error = Some(*diag),
        }
    }
    (steps, error)
}

fn some_rows(random: &mut Random, n: usize) -> Vec<String> {
    let mut row = |i| match random.below(5) {
        0 => format!("(row {i}, ä)"),
        1 => format!("  N{i} g1 x{} y-{}.25", random.below(1000), random.below(100)),
        2 => "G2 X[#5420 + 2] Y#5421 I1 J0".to_owned(),
        3 => format!("#<v{}> = [#1 + {i}]", random.below(9)),
        _ => format!("G0 Z{}.{}", random.below(10), random.below(1000)),
    };
    (0..n).map(&mut row).collect()
}

/// A program of some blocks with a loop, a branch, a subroutine behind its call, comments, and line ends of all kinds.
fn program(seed: u64) -> String {
    let mut random = Random(seed);
    let end = ["\n", "\r\n", "\r"][random.below(3)];
    let semicolon = if random.below(2) == 0 { " ;" } else { "" };
    let mut all = vec!["%".to_owned(), "F100 #1 = 3".to_owned()];
    all.extend(some_rows(&mut random, 9000));
    all.extend(["o1 repeat [3]", "o2 if [#1 GT 4]"].map(str::to_owned));
    all.extend(some_rows(&mut random, 50));
    all.extend(["o2 else", "o<far> call [7] [8]", "#1 = [#1 + 1]", "o2 endif", "o1 endrepeat"].map(str::to_owned));
    all.extend(some_rows(&mut random, 9000));
    all.extend(["o<far> sub", "G1 X#1 Y#2 (arguments)", "o<far> endsub", "M2"].map(str::to_owned));
    let line = |row: String| if row.starts_with(['%', '(']) { row + end } else { row + semicolon + end };
    all.into_iter().map(line).collect()
}

#[test]
fn a_streamed_file_gives_the_same_commands() {
    for seed in 0..8 {
        let text = program(seed);
        assert!(text.len() > 2 * BLOCK);
        let (want, error) = run(text.as_str().into());
        assert_eq!(error, None);
        for part in [usize::MAX, 4096, 997] {
            assert!(
                run(streamed(Fake { part, ..Fake::new(text.as_str()) })) == (want.clone(), None),
                "seed {seed}, parts of {part}"
            );
        }
    }
}

#[test]
fn a_streamed_file_has_the_same_errors_in_the_same_places() {
    for seed in 0..4 {
        let mut text = program(seed).into_bytes();
        let mut random = Random(seed + 50);
        for _ in 0..40 {
            let at = random.below(text.len());
            text[at] = b"$X9#[\n"[random.below(6)];
        }
        let text = String::from_utf8_lossy(&text).into_owned();
        let want = check(SourceId(0), text.as_str(), Options::default());
        assert!(want.len() > 5, "{want:?}");
        let text = streamed(Fake::new(text));
        assert_eq!(check(SourceId(0), text, Options::default()), want, "seed {seed}");
    }
}

/// Messages show the line of a streamed file, also of one in Latin-1.
#[test]
fn messages_show_the_line() {
    let mut bytes = "G0 X1 (a row)\n".repeat(20_000).into_bytes();
    bytes.extend_from_slice(b"(gr\xfcn) G0 X1 X2\nG0 Y1 Y2 Z\n");
    let text = streamed(Fake::new(bytes));
    let diags = check(SourceId(0), text.clone(), Options::default());
    let mut sources = Sources::new();
    let id = sources.add("big.ngc", "");
    for diag in &diags {
        sources.add_excerpt(id, text.excerpt(diag.span.start).unwrap());
    }
    let shown: Vec<_> = diags.iter().map(|d| takt_base::diag::render(d, &sources)).collect();
    assert!(
        shown[0].contains("--> big.ngc:20001:14\n20001 | (grün) G0 X1 X2\n      |              ^^ a second X word"),
        "{}",
        shown[0]
    );
    assert!(shown[1].contains("--> big.ngc:20002:10\n20002 | G0 Y1 Y2 Z\n"), "{}", shown[1]);
}

fn lines(n: usize) -> String {
    (0..n).fold("F100\n".to_owned(), |text, i| text + &format!("G1 X{}\n", i + 2))
}

/// Commands up to an error of this code, which are those of the whole program as far as they go.
fn ends_with(fake: Fake, code: Code) {
    let (want, _) = run(String::from_utf8(fake.bytes.clone()).unwrap().into());
    let (steps, error) = run(streamed(fake));
    let error = error.expect("an error");
    assert_eq!(error.code, code);
    assert!(error.help.is_some());
    assert!(steps.len() < want.len() && steps.iter().zip(&want).all(|(a, b)| a == b), "{} commands", steps.len());
    assert!(steps.len() > 1000, "{} commands", steps.len());
}

/// N0040: no row of the new contents is executed.
#[test]
fn a_file_that_changes_stops_the_program() {
    ends_with(Fake { changes: 4, ..Fake::new(lines(60_000)) }, Code::FileChanged);
    ends_with(Fake { shrinks: 4, ..Fake::new(lines(60_000)) }, Code::FileChanged);
}

/// N0041
#[test]
fn a_file_that_can_not_be_read_stops_the_program() {
    ends_with(Fake { fails: 3, ..Fake::new(lines(60_000)) }, Code::FileUnreadable);
    let text = streamed(Fake { fails: 3, ..Fake::new(lines(60_000)) });
    let diags = check(SourceId(0), text, Options::default());
    assert_eq!(diags.iter().map(|d| d.code).collect::<Vec<_>>(), [Code::FileUnreadable], "said once, and nothing hangs");
}

/// The same in a way over rows that are not executed, and with `rs274 -n 0`, which goes on behind errors.
#[test]
fn a_file_that_can_not_be_read_ends_the_search_for_a_subroutine() {
    let text = format!("o<last> call\n{}o<last> sub\no<last> endsub\nM2\n", lines(60_000));
    let mut interpreter = Interpreter::new(SourceId(0), streamed(Fake { fails: 3, ..Fake::new(text) }), Options::default());
    let error = interpreter.find_map(Result::err).unwrap();
    assert_eq!(error.code, Code::FileUnreadable);
    interpreter.go_on();
    assert!(interpreter.next().is_none());
}

/// N0042
#[test]
fn a_row_without_end_is_no_part_program() {
    for n in [ROW_MAX + 1, BLOCK + 1, 3 * BLOCK] {
        let text = format!("{}({})", lines(2000), "x".repeat(n));
        ends_with(Fake::new(text + "\nG0 X1\n"), Code::RowTooLong);
    }
    let text = format!("{}({})\n", lines(2000), "x".repeat(ROW_MAX - 2));
    assert_eq!(run(streamed(Fake::new(text))).1, None);
}

/// N0043
#[test]
fn what_a_program_may_need_is_bounded() {
    let codes = |text: String| check(SourceId(0), text, Options::default()).iter().map(|d| d.code).collect::<Vec<_>>();
    let names = |n: usize| (0..n).map(|i| format!("#<name{i}> = 1\n")).collect::<String>();
    assert_eq!(codes(names(50_000)), []);
    assert_eq!(codes(names(50_001)), [Code::ProgramTooLarge]);
    let subs = |n: usize| (0..n).map(|i| format!("o{i} sub\no{i} endsub\n")).collect::<String>();
    assert_eq!(codes(subs(50_001))[0], Code::ProgramTooLarge);
    let waiting = |n: usize, row: &str| format!("F100\nG41.1 D2\nG1 X5 Y5\n{}X50\n", format!("{row}\n").repeat(n));
    assert_eq!(codes(waiting(19_999, "Z1")), []);
    assert_eq!(codes(waiting(20_001, "Z1")), [Code::ProgramTooLarge]);
    assert_eq!(codes(waiting(20_001, "M8")), [Code::ProgramTooLarge]);
}

fn first_feed(interpreter: &mut Interpreter) -> (u32, f64) {
    let moves = interpreter.map(Result::unwrap);
    let mut moves = moves.filter_map(|s| match s.command {
        Canon::StraightFeed(p) => Some((s.line, p.x)),
        _ => None,
    });
    moves.next().unwrap()
}

/// Rows without a command are no endless program, however many follow each other.
#[test]
fn a_million_rows_that_do_nothing() {
    let text = "N1\n; nothing\n".repeat(600_000) + "G0 X1\nM2\n";
    assert_eq!(run(streamed(Fake::new(text))).1, None);
    assert_eq!(run("N1\nM99\n".into()).1.map(|d| d.code), Some(Code::EndlessProgram));
}

/// Places have 32 bits.
#[test]
fn a_file_above_4_gib_is_refused() {
    struct Huge;
    impl ReadAt for Huge {
        fn read_at(&self, _: &mut [u8], _: u64) -> io::Result<usize> {
            Ok(0)
        }
        fn stamp(&self) -> io::Result<Stamp> {
            Ok(Stamp { len: 1 << 32, modified: None })
        }
    }
    assert_eq!(Text::streamed(Huge).map_err(|e| e.kind()).unwrap_err(), io::ErrorKind::FileTooLarge);
}

/// R1-103 (block search): from any line, forth and back.
#[test]
fn a_program_starts_at_any_line() {
    let text = lines(50_000);
    for text in [Text::from(text.as_str()), streamed(Fake::new(text.as_str()))] {
        for line in [2, 40_000, 1024, 1025, 1026, 50_001, 3] {
            let mut interpreter = Interpreter::new(SourceId(0), text.clone(), Options::default());
            assert!(interpreter.by_ref().take(7).all(|s| s.is_ok()), "the feed of line 1 is in force");
            interpreter.seek(line).unwrap();
            assert_eq!(first_feed(&mut interpreter), (line, f64::from(line)));
        }
        assert_eq!(text.lines(), Ok(50_001));
        assert_eq!(text.start_of(3), Ok(Some(11)));
        assert_eq!(text.to_whole().as_deref(), Ok(lines(50_000).as_str()));
    }
}

/// N0044
#[test]
fn a_line_that_does_not_exist() {
    for text in [Text::from("G0 X1\nM2\n"), streamed(Fake::new("G0 X1\nM2\n"))] {
        let mut interpreter = Interpreter::new(SourceId(0), text, Options::default());
        assert_eq!(interpreter.seek(3).unwrap_err().code, Code::NoSuchLine);
        assert_eq!(interpreter.seek(2), Ok(()));
    }
}

/// A search leaves calls and loops behind.
#[test]
fn a_search_from_within_a_subroutine() {
    let text = "F100\no1 sub\no2 repeat [5]\nG1 X1\no2 endrepeat\no1 endsub\no1 call\nG1 X9\nM2\n";
    let mut interpreter = Interpreter::new(SourceId(0), text, Options::default());
    assert_eq!(first_feed(&mut interpreter), (4, 1.0));
    interpreter.seek(8).unwrap();
    let rest: Vec<_> = interpreter.map(|s| s.unwrap().line).collect();
    assert_eq!(rest, [8, 9]);
}

/// A file on the disk: small ones are read at once, a large one stays open and may even be removed.
#[test]
fn files_on_the_disk() {
    let path = std::env::temp_dir().join(format!("takt-stream-{}.ngc", std::process::id()));
    let text = lines(120_000);
    assert!(text.len() as u64 > WHOLE_MAX);
    std::fs::write(&path, &text).unwrap();
    let (want, _) = run(text.as_str().into());
    let opened = Text::open(&path).unwrap();
    assert_eq!(opened.whole(), None);
    let mut changed = Interpreter::new(SourceId(0), Text::open(&path).unwrap(), Options::default());
    assert!(changed.by_ref().take(100).all(|s| s.is_ok()));
    std::fs::remove_file(&path).unwrap();
    assert!(run(opened) == (want, None), "the removed file is still there for those who have it open");
    std::fs::write(&path, "\u{feff}G0 X1 (ü)\n").unwrap();
    assert_eq!(Text::open(&path).unwrap().whole(), Some("G0 X1 (ü)\n"));
    std::fs::write(&path, b"G0 X1 (\xfc)\n").unwrap();
    assert_eq!(Text::open(&path).unwrap().whole(), Some("G0 X1 (ü)\n"));
    std::fs::write(&path, &text).unwrap();
    let mut changed = Interpreter::new(SourceId(0), Text::open(&path).unwrap(), Options::default());
    assert!(changed.by_ref().take(100).all(|s| s.is_ok()));
    std::fs::OpenOptions::new().append(true).open(&path).and_then(|mut f| io::Write::write_all(&mut f, b"G0 X0\n")).unwrap();
    assert_eq!(changed.find_map(Result::err).map(|d| d.code), Some(Code::FileChanged));
    std::fs::remove_file(&path).unwrap();
    assert!(Text::open(&path).is_err());
}

/// The same for a Fanuc-style dialect: GOTO, subprograms, loops, comments.
#[test]
fn a_streamed_file_in_a_fanuc_dialect() {
    let far: String = (0..6000).map(|i| format!("N{} G01 X{}. Y-{}.5 (row {i})\n", 100 + i, i % 90, i % 7)).collect();
    let loops = "#1=0\nWHILE[#1LT3]DO1\nG01X#1\nM98P2L2\n#1=#1+1\nEND1\nIF[#2EQ1]GOTO7\n#2=1\nGOTO6000\nN7M30\n";
    let text = format!("%\nO1\nG21G90G94F100\n{far}{loops}O2\nG91G01Z-1.\nG90\nM99\n%\n");
    assert!(text.len() > BLOCK);
    let options =
        || Options { language: takt_motion::ngc::Language::new("fanuc-mill", false, &[]).unwrap(), ..Options::default() };
    let steps = |text: Text| Interpreter::new(SourceId(0), text, options()).map(Result::unwrap).collect::<Vec<_>>();
    let want = steps(text.as_str().into());
    assert!(want.len() > 6000, "{} commands", want.len());
    assert!(steps(streamed(Fake { part: 997, ..Fake::new(text.as_str()) })) == want);
    let changed = streamed(Fake { changes: 3, ..Fake::new(text.as_str()) });
    assert_eq!(Interpreter::new(SourceId(0), changed, options()).find_map(Result::err).map(|d| d.code), Some(Code::FileChanged));
    let mut interpreter = Interpreter::new(SourceId(0), streamed(Fake::new(text.as_str())), options());
    assert!(interpreter.by_ref().take(20).all(|s| s.is_ok()), "the feed is in force");
    interpreter.seek(5000).unwrap();
    let line = interpreter.find_map(|s| s.ok().map(|s| s.line).filter(|l| *l > 0));
    assert_eq!(line, Some(5000));
}
