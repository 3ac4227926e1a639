//! Every N code, its place, and that a wrong block gives out nothing.

use std::collections::BTreeSet;
use takt_base::units::{Mm, MmPerMin};
use takt_base::{Code, Severity, SourceId, Sources};
use takt_motion::canon::{Position, Step};
use takt_motion::ngc::{Interpreter, Language, Options, Style, Travel, check};

/// Defaults, with a travel of -1000..1000 on all axes, a grid of 0.001 mm and a largest feed of 10000 mm/min.
fn options() -> Options {
    let all = |v| Position { x: v, y: v, z: v, a: v, b: v, c: v };
    let travel = Travel { min: all(-1000.0), max: all(1000.0) };
    let tools = "T1 P1 Z10 D6\nT2 P2 Z20 D12.5 ;mill\nT3 P3 D2\nT5 P5\nT7 P7\n";
    let tools = Some(takt_motion::ngc::tool::read(SourceId(0), tools, 1.0).unwrap().into());
    Options { travel: Some(travel), grid: Some(Mm(0.001)), feed_max: Some(MmPerMin(10_000.0)), tools, ..Options::default() }
}

/// The same in a dialect, or leniently.
fn options_in(language: &str) -> Options {
    let lenient = language == "lenient";
    let dialect = if lenient { "ngc" } else { language };
    Options { language: Language::new(dialect, lenient, &[]).unwrap(), ..options() }
}

/// `CODE line:column` of each diagnostic.
fn shown(text: &str) -> String {
    shown_in("ngc", text)
}

fn shown_in(language: &str, text: &str) -> String {
    let mut sources = Sources::new();
    let id = sources.add("a.ngc", text);
    let at = |d: &takt_base::Diag| {
        let place = sources.line_col(id, d.span.start);
        assert!(d.help.is_some(), "{} has no help", d.code.text());
        assert!(!takt_base::diag::render(d, &sources).is_empty());
        format!("{} {}:{}", d.code.text(), place.line, place.column)
    };
    check(id, text, options_in(language)).iter().map(at).collect::<Vec<_>>().join(", ")
}

const CASES: &[(&str, &str)] = &[
    ("G1 X1 F100 $", "N0001 1:12"),
    ("G0 X1\n%%", "N0001 2:1"),
    ("G0 X1 )", "N0001 1:7"),
    ("G0 X", "N0002 1:4"),
    ("G0 X1 N5", "N0002 1:7"),
    ("N-5 G0", "N0002 1:1"),
    ("G0 X9999999999999", "N0002 1:4"),
    ("F100\nG5.1 X1 Y1", "N0006 2:1"),
    ("G44 H1", "N0003 1:1"),
    ("G1.05", "N0003 1:1"),
    ("G-1", "N0003 1:1"),
    ("G81 Z-5 R1", "N0008 1:1"),
    ("M98 P100", "N0020 1:1"),
    ("M200", "N0003 1:1"),
    ("M3.5", "N0003 1:1"),
    ("G0 G1 X1 F100", "N0004 1:4"),
    ("G17 G18", "N0004 1:5"),
    ("G54 G55", "N0004 1:5"),
    ("M3 M4", "N0004 1:4"),
    ("M7 M8", "N0004 1:4"),
    ("M2 M30", "N0004 1:4"),
    ("M110 M111", "N0004 1:6"),
    ("G4 P1 G64", "N0004 1:4"),
    ("G4 P1 M110", "N0004 1:4"),
    ("G0 X1 Y2 X3", "N0005 1:10"),
    ("F1 F2", "N0005 1:4"),
    ("G4", "N0006 1:1"),
    ("F100\nG2 X10", "N0006 2:1"),
    ("F100 G90.1\nG2 X10 I5", "N0006 2:1"),
    ("F100 G2 X20 I5", "N0007 1:1"),
    ("F100 G2 X20 R5", "N0007 1:13"),
    ("F100 G2 X10 I0", "N0007 1:13"),
    ("G1 X1\nX2\nX3", "N0008 1:1"),
    ("F0 G2 X10 I5", "N0008 1:4"),
    ("X1", "N0009 1:1"),
    ("G0 X1\nG80\nX2", "N0009 3:1"),
    ("G80 X2", "N0009 1:5"),
    ("G0 X1 I5", "N0009 1:7"),
    ("P1", "N0009 1:1"),
    ("G0 U1", "N0009 1:4"),
    ("G0 X1E2", "N0009 1:6"),
    ("F100 G2 X10 I5 K1", "N0009 1:16"),
    ("F100 G2 X10 I5 R5", "N0009 1:13"),
    ("F-1", "N0010 1:1"),
    ("S-1", "N0010 1:1"),
    ("T1.5", "N0010 1:1"),
    ("T-1", "N0010 1:1"),
    ("G4 P-1", "N0010 1:4"),
    ("G64 P-1", "N0010 1:5"),
    ("F20000", "N0010 1:1"),
    ("G20\nF400", "N0010 2:1"),
    ("F100 G2 X10 I5 P0", "N0010 1:16"),
    ("F100 G2 X10 I5 P1.5", "N0010 1:16"),
    ("F100 G2 I5 R5 X0", "N0009 1:9"),
    ("F100 G2 X0 R5", "N0010 1:12"),
    ("G0 X1 (open", "N0011 1:7"),
    ("G0 X1 (a (b))", "N0011 1:7"),
    ("G0 X1001", "N0012 1:1"),
    ("G0 X990\nG2 X990 J20 F100", "N0012 2:1"),
    ("G0 C-1001", "N0012 1:1"),
    ("G0 X1.0005", "N0013 1:1"),
    ("G2 X0.001 I0.0005 F100", "N0013 1:1"),
    ("#1=5", ""),
    ("G0 X#1", ""),
    ("G0 X[1+2]", ""),
    ("O100 SUB", "N0019 1:1"),
    ("G71.5 Q1", "N0014 1:1"),
    ("G18 F1 G71 Q1", "N0020 1:8"),
    ("G18 F1 G0 X9 Z1\no1 sub\nG0 X2\nG1 Z-5\nX4 Z-3\nX9\no1 endsub\nG71 Q1", "N0056 8:1"),
    ("G0 X[1 + * 2]", "N0016 1:10"),
    ("G0 X#<never_set>", "N0017 1:5"),
    ("G0 X[1 / [2 - 2]]", "N0018 1:8"),
    ("o1 endif", "N0019 1:1"),
    ("o<no_such_sub> call", "N0020 1:1"),
    ("o1 sub\no1 call\no1 endsub\no1 call", "N0021 2:1"),
    ("o1 while [1]\no1 endwhile", "N0022 1:1"),
    ("T777", "N0023 1:1"),
    ("G41 D999", "N0023 1:5"),
    ("F100\nG41.1 D20\nG1 X5", "N0025 3:1"),
    ("F100\nG41.1 D20\nG1 X30\nG1 X40\nG3 X50 I5", "N0025 5:1"),
    ("F100\nG41.1 D20\nG1 X20\nX30\nY5\nX20", "N0025 6:1"),
    ("G41 D1\nG41 D1", "N0027 2:1"),
    ("G41 D1\nG55", "N0027 2:1"),
    ("G19 G41 D1", "N0027 1:5"),
    ("G33 K1 Z-5", "N0026 1:1"),
    ("G91\nG53 G0 X1", "N0027 2:1"),
    ("(ABORT, no stock)", "N0028 1:8"),
    ("o1 if [0]\nG0 X[1\no1 endif\nG0 X$", "N0016 2:5, N0002 4:4"),
    ("F100 G2 X20 R10", "N0015 1:13"),
    ("F100 G3 X0.1 R-100", "N0013 1:1, N0015 1:14"),
    // Several in a block, and in a file: all are found, each once.
    ("G0 X1 X2 $\nG0 Y1 Y2\nM3 M4 F-2\nG9", "N0001 1:10, N0005 2:7, N0004 3:4, N0010 3:7, N0003 4:1"),
    // What is right.
    ("", ""),
    ("%\nG21 G90 (setup)\nG0 X1 ; go\nM2\nG99 nothing reads this", ""),
    ("G1 F100 X1\n(a block without words)\nN7\n/G0 X5", ""),
    ("g1f1 0 0x-1. 5 y +.5", ""),
];

/// Of the dialects.
const OTHERS: &[(&str, &str, &str)] = &[
    ("fanuc-mill", "IF[#1 GT 0]#2=1", "N0050 1:1"),
    ("fanuc-mill", "#1", "N0050 1:1"),
    ("fanuc-mill", "END1", "N0050 1:1"),
    ("fanuc-mill", "WHILE[#1 LT 0]DO1", "N0050 1:1"),
    ("fanuc-mill", "M98 P2\nM30\nO2\nG0 X1", "N0050 4:5"),
    ("fanuc-mill", "GOTO 10", "N0051 1:1"),
    ("fanuc-mill", "IF[1 EQ 1]GOTO#1", "N0051 1:1"),
    ("fanuc-turn", "F1 G71 P1 Q2", "N0051 1:4"),
    ("fanuc-mill", "G41.2", "N0052 1:1"),
    ("fanuc-mill", "M198 P1", "N0052 1:1"),
    ("fanuc-mill", "DPRNT[X#1[53]]", "N0052 1:1"),
    ("fanuc-mill", "#1=PRM[5]", "N0052 1:4"),
    ("fanuc-turn", "G1 X5 ,A30 F1", "N0052 1:7"),
    ("fanuc-mill", "#34=1", "N0053 1:1"),
    ("fanuc-mill", "G0 X#3001", "N0053 1:5"),
    ("fanuc-mill", "#0=1", "N0053 1:1"),
    ("fanuc-mill", "#1000=1", "N0053 1:1"),
    ("fanuc-mill", "#3000=7(NO)", "N0054 1:1"),
    ("fanuc-mill", "F100\nG1 X10 ,R20\nY10", "N0055 2:8"),
    ("fanuc-mill", "F100\nG1 X10 ,C2\nM5", "N0055 2:8"),
    ("fanuc-turn", "G0 X50 Z2\nG71 U2 R1\nG71 P1 Q2\nN1 G0 X20\nN2 G1 X60 Z-5 F1", "N0056 3:1"),
    ("fanuc-turn", "G98 F100 G0 X50 Z2\nG71 U2 R1\nG71 P1 Q4\nN1 G0 X20\nG1 Z-5\nX10 Z-8\nN4 X50 Z-20", "N0056 3:1"),
    ("fanuc-turn", "G98 F100 G0 X40\nG12.1\nG1 X-40", "N0058 3:1"),
    ("fanuc-mill", "M98 P77", "N0020 1:1"),
    ("fanuc-mill", "G65 P1\nM30\nO1\nG65 P1\nM99", "N0021 4:1"),
    ("fanuc-mill", "N1 #1=1\nGOTO 1", "N0022 1:1"),
    ("fanuc-mill", "G0 X[#1/0]", "N0018 1:8"),
    ("fanuc-mill", "G0 X[1+", "N0016 1:8"),
    ("fanuc-mill", "G0 X1 Q5", "N0009 1:7"),
    ("fanuc-mill", "G84 Z-5 R1 F100", "N0026 1:1"),
    ("fanuc-mill", "G17 G0 X1 N5 N6", "N0005 1:14"),
    ("fanuc-mill", "F9 G1 X10 ,C2\nM5\nG1 Y5", "N0055 1:11"),
    ("fanuc-mill", "GOTO 9\nG0 X$\nN9 M30\nO2\nG0 X\nM99\n%\nno program $", "N0002 2:4, N0002 5:4"),
    ("lenient", "M104 S200", "N0057 1:1"),
    ("lenient", "G0 X1\n%\nG0 X2", "N0057 2:1"),
];

#[test]
fn places_of_errors_of_the_dialects() {
    let all = OTHERS.iter().map(|(language, text, want)| (language, text, shown_in(language, text), *want));
    let wrong: Vec<_> = all.filter(|(.., is, want)| is != want).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn places_of_all_errors() {
    for (text, want) in CASES {
        let mut found: Vec<_> = shown(text).split(", ").map(str::to_owned).collect();
        let mut wanted: Vec<_> = want.split(", ").map(str::to_owned).collect();
        found.sort();
        wanted.sort();
        assert_eq!(found, wanted, "{text}");
    }
}

/// Codes that a short text can provoke. Those of tables are tested below, those of files and large programs in `ngc_stream.rs`,
/// those from N0070 on, which need a channel, in `channel_errors.rs`.
fn of_programs() -> impl Iterator<Item = Code> {
    use Code::{BadTable, FileChanged, FileUnreadable, NoSuchLine, ProgramTooLarge, RowTooLong};
    let others = [BadTable, FileChanged, FileUnreadable, RowTooLong, ProgramTooLarge, NoSuchLine];
    let of_channels = |c: &Code| ("N0070".."N0090").contains(&c.text());
    Code::ALL.iter().copied().filter(move |c| c.text().starts_with('N') && !of_channels(c) && !others.contains(c))
}

#[test]
fn every_n_code_is_provoked_and_has_a_page() {
    let provoked: BTreeSet<&str> = CASES
        .iter()
        .map(|c| c.1)
        .chain(OTHERS.iter().map(|o| o.2))
        .flat_map(|want| want.split(", "))
        .filter_map(|w| w.split(' ').next())
        .collect();
    for code in of_programs() {
        assert!(provoked.contains(code.text()), "{} is never provoked", code.text());
        let page = code.page();
        assert!(page.contains("```ngc") && page.lines().count() <= 15, "{} has no page", code.text());
    }
}

/// The fenced example of each page provokes its code.
#[test]
fn pages_show_what_they_say() {
    for code in of_programs() {
        let example = code.page().split("```ngc").nth(1).and_then(|p| p.split("```").next()).unwrap();
        // Behind the fence stands the dialect, if it is another one.
        let (language, example) = example.split_once('\n').unwrap();
        let found = shown_in(if language.is_empty() { "ngc" } else { language.trim() }, example);
        assert!(found.contains(code.text()), "{}: {found}", code.text());
    }
}

/// N0024 is of tables, not of programs.
#[test]
fn tool_tables() {
    let read = |text: &str| takt_motion::ngc::tool::read(SourceId(0), text, 25.4);
    let tools = read("; tools\nT1 P7 X1 Z-0.5 A3 D0.25 I10 J20 Q3 ;drill\n\nt2p9\n").unwrap();
    assert_eq!((tools[0].tool, tools[0].pocket, tools[0].orientation, tools[1].pocket), (1, 7, 3, 9));
    assert_eq!((tools[0].offset[..4].to_vec(), tools[0].diameter), (vec![25.4, 0.0, -12.7, 3.0], 6.35));
    let example = Code::BadTable.page().split("```ngc\n").nth(1).and_then(|p| p.split("```").next()).unwrap();
    for (text, start) in [("P1 Z3", 0), ("T1\nT1", 3), ("T1\n T1.5", 3), ("T1 X", 0), ("T1 Q10", 0), (example, 0)] {
        let diags = read(text).unwrap_err();
        assert_eq!((diags.len(), diags[0].code, diags[0].span.start), (1, Code::BadTable, start), "{text}");
    }
}

/// A wrong block emits nothing, what stands before it is emitted, and nothing follows.
#[test]
fn wrong_block_emits_nothing() {
    // Errors in rows that are not executed are found by a check alone.
    for (text, want) in CASES.iter().filter(|(text, _)| !text.contains("if [0]")) {
        let error_line = |d: &takt_base::Diag| text[..d.span.start as usize].lines().count().max(1) as u32;
        let first = check(SourceId(0), *text, options()).into_iter().find(|d| d.severity == Severity::Error);
        let mut interpreter = Interpreter::new(SourceId(0), *text, options());
        let steps: Vec<Step> = interpreter.by_ref().map_while(Result::ok).collect();
        let Some(first) = first else {
            assert!(
                matches!(steps.last(), Some(s) if matches!(s.command, takt_motion::canon::Canon::ProgramEnd(_))),
                "{text}: {want}"
            );
            continue;
        };
        let line = error_line(&first) + u32::from(text[..first.span.start as usize].ends_with('\n'));
        assert!(steps.iter().all(|s| s.line < line), "{text}: {steps:?}");
        assert!(interpreter.next().is_none());
        let again = Interpreter::new(SourceId(0), *text, options()).find_map(Result::err);
        assert_eq!(again.as_deref(), Some(&first), "{text}");
    }
}

#[test]
fn an_interpreter_can_go_to_another_thread() {
    let interpreter = Interpreter::new(SourceId(0), "G0 X1", Options::default());
    let steps = std::thread::spawn(move || interpreter.filter_map(Result::ok).count()).join().unwrap();
    assert_eq!(steps, 5 + 2);
}

#[test]
fn block_delete_is_an_option() {
    let count = |skip_deleted| {
        let options = Options { skip_deleted, style: Style::Ngc, ..Options::default() };
        Interpreter::new(SourceId(0), "G0 X1\n / X2\nX3", options).map(Result::unwrap).last().unwrap().block
    };
    assert_eq!((count(false), count(true)), (3, 2));
}

#[test]
fn modes_before_a_program() {
    let options = |modes: &str| Options::default().with_modes(SourceId(0), modes);
    assert!(options("G17 G20 G91 G90.1 G55 G64 G94 G1").is_ok());
    for (modes, want) in [("G4 P1", Code::BadValue), ("M3", Code::BadValue), ("X1", Code::BadValue), ("$", Code::BadCharacter)] {
        assert_eq!(options(modes).unwrap_err().code, want, "{modes}");
    }
}

/// PC-03: at least 1000 blocks; here 50,000, with numbers up to the end.
#[test]
fn many_blocks() {
    let text: String = (1..=50_000).map(|n| format!("N{n}G1X{}F100\n", n % 7)).collect();
    let last =
        Interpreter::new(SourceId(0), text, Options::default()).map(Result::unwrap).filter(|s| s.n.is_some()).last().unwrap();
    assert_eq!((last.block, last.n, last.line), (50_000, Some(50_000), 50_000));
}
