//! Every code of the book's tables A.1 (turning) and A.2 (milling): what it gives, or why not (R2-340..R2-343).

use std::collections::BTreeSet;
use takt_base::{Severity, SourceId};
use takt_motion::canon::Canon;
use takt_motion::ngc::{Dialect, Interpreter, Options, check, tool};
use takt_motion::print;

const TABLE: &str = include_str!("fanuc/codes.txt");

/// Table A.1.
const TURNING: &str = "00 01 02 03 04 10 17 18 19 20 21 22 23 25 26 27 28 29 30 31 32 34 36 37 40 41 42 50 52 53 54 55 56 57 58 59 65 66 67 68 \
69 70 71 72 73 74 75 76 80 83 84 85 87 88 89 90 92 94 96 97 98 99 107 112 113";
/// Table A.2.
const MILLING: &str = "00 01 02 03 04 10 15 16 17 18 19 20 21 22 23 27 28 29 30 31 33 39 40 41 42 43 44 49 50 51 52 53 54 55 56 57 58 59 61 62 63 \
64 65 66 67 68 69 73 74 76 80 81 82 83 84 85 86 87 88 89 90 91 92 94 95 96 97 98 99 107 112 113 84.2 84.3";

fn options(machine: &str) -> Options {
    let tools = tool::read(SourceId(0), "T1 P1 Z10 D2 Q3\nT2 P2\nT3 P3\n", 1.0).unwrap();
    let mut options = Options { tools: Some(tools.into()), ..Options::default() };
    options.language.dialect = Dialect::named(&format!("fanuc-{machine}")).unwrap();
    options
}

/// 4 decimals without the zeros at the end.
fn short(text: &str) -> String {
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(|&v| short(&print::command(&Canon::Dwell(v))[6..].replace(')', ""))).collect::<Vec<_>>().join(" ")
}

/// A command in few characters; rotary axes only where one is not 0.
fn shown(command: &Canon) -> String {
    let place = |p: &takt_motion::canon::Position| match (p.a, p.b, p.c) {
        (0.0, 0.0, 0.0) => numbers(&[p.x, p.y, p.z]),
        _ => numbers(&[p.x, p.y, p.z, p.a, p.b, p.c]),
    };
    match command {
        Canon::StraightTraverse(p) => format!("rapid {}", place(p)),
        Canon::StraightFeed(p) => format!("feed {}", place(p)),
        Canon::SetOriginOffsets(p) => format!("origin {}", place(p)),
        Canon::ArcFeed(a) => {
            format!(
                "arc {} {}",
                numbers(&[a.first_end, a.second_end, a.first_axis, a.second_axis]),
                numbers(&[a.rotation.into(), a.axis_end_point])
            )
        }
        other => {
            let text = print::command(other);
            let (name, inside) = text.split_once('(').unwrap();
            let inside = inside.trim_end_matches(')');
            let args: Vec<String> = inside
                .split(", ")
                .map(|a| if a.contains('.') { short(a) } else { a.to_owned() })
                .filter(|a| !a.is_empty())
                .collect();
            [name.to_owned()].into_iter().chain(args).collect::<Vec<_>>().join(" ")
        }
    }
}

/// All commands behind the prologue, or the numbers of all errors.
fn given(machine: &str, program: &str) -> String {
    let text = program.replace("\\n", "\n");
    let errors: Vec<String> = check(SourceId(0), text.as_str(), options(machine))
        .into_iter()
        .filter(|d| d.severity == Severity::Error)
        .map(|d| {
            assert!(d.help.is_some(), "{program}: {} has no help", d.code.text());
            d.code.text().to_owned()
        })
        .collect();
    if !errors.is_empty() {
        return errors.join(" ");
    }
    let steps = Interpreter::new(SourceId(0), text.as_str(), options(machine)).map(|s| s.unwrap());
    let commands = steps.map(|s| s.command).skip(5).filter(|c| !matches!(c, Canon::ProgramEnd(_)));
    commands.map(|c| shown(&c)).collect::<Vec<_>>().join("; ")
}

fn rows() -> impl Iterator<Item = (&'static str, &'static str, &'static str, &'static str)> {
    TABLE.lines().filter(|r| !r.starts_with(";;") && !r.is_empty()).map(|row| {
        let mut parts = row.splitn(3, '|').map(str::trim);
        let (machine, code) = parts.next().unwrap().split_once(' ').unwrap();
        (machine, code, parts.next().unwrap(), parts.next().unwrap_or(""))
    })
}

#[test]
fn every_code_gives_what_the_table_says() {
    let mut wrong = Vec::new();
    for (machine, code, program, want) in rows() {
        let is = given(machine, program);
        if is != want {
            wrong.push(format!("{machine} {code} | {program} | {is}"));
        }
    }
    assert!(wrong.is_empty(), "{} rows differ:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn the_table_has_every_code_of_the_book() {
    for (machine, codes) in [("turn", TURNING), ("mill", MILLING)] {
        let has: BTreeSet<&str> = rows().filter(|r| r.0 == machine).map(|r| r.1.trim_start_matches('G')).collect();
        let all: Vec<&str> = codes.split_whitespace().collect();
        assert_eq!(all.len(), if machine == "turn" { 65 } else { 74 });
        for code in all {
            assert!(has.contains(code), "{machine} G{code} has no row");
        }
    }
}

/// R2-341: codes of the other machine are refused, with what to write instead.
#[test]
fn codes_of_the_other_machine() {
    for (machine, program) in [
        ("turn", "G91"),
        ("turn", "G43 H1"),
        ("turn", "G33 Z1"),
        ("turn", "G95"),
        ("mill", "G32 Z1"),
        ("mill", "G71"),
        ("mill", "G25"),
    ] {
        assert_eq!(given(machine, program), "N0003", "{machine} {program}");
    }
}

/// R2-343: two codes of one modal group in a block.
#[test]
fn two_codes_of_a_group() {
    for (machine, program) in
        [("mill", "G0 G1 X1"), ("mill", "G90 G91"), ("mill", "G17 G18"), ("turn", "G98 G99"), ("mill", "G54 G55")]
    {
        assert_eq!(given(machine, program), "N0004", "{machine} {program}");
    }
}
