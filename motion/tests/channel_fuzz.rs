//! Broken programs that ask the machine, and a machine that answers anything: no panic, no hang.

mod common;
use common::Random;
use common::shop::{disk, environment};
use takt_base::SourceId;
use takt_motion::canon::Position;
use takt_motion::feeder::{ChannelHost, PartProgram, ngc_reader};
use takt_motion::ngc::HostRef;
use takt_motion::run::{RunReader, Work};
use takt_motion::sync::{Answer, waits_for_answer};

/// Programs; a loop that asks nothing runs for a million rows before it is ended.
const SEEDS: u64 = 20_000;

const ROWS: &[&str] = &[
    "#1 = #<_plc_level>",
    "#<_plc_main.count> = [#1 * 2]",
    "#<_plc_flag> = 1 #<_plc_v3> = #<_plc_v4>",
    "o1 while [#<_plc_v0> LT 3]",
    "o1 endwhile",
    "o2 if [#<_plc_v1> GT 0]",
    "o2 elseif [#<_plc_v2> GT #<_plc_v5>]",
    "o2 else",
    "o2 endif",
    "o<s> sub",
    "o<s> endsub [#<_plc_level>]",
    "o<s> call [#<_plc_v6>] [2]",
    "o[#<_plc_v7>] call",
    "o3 do",
    "o3 continue",
    "o3 while [#<_plc_v8> LT 2]",
    "o4 repeat [#<_plc_level>]",
    "o4 endrepeat",
    "G38.2 Z-#<_plc_v9> F100",
    "G38.5 X5 Y#1",
    "M66 P1 L3 Q1",
    "M66 E#<_plc_v1> L0",
    "M62 P3 G1 X1 F10",
    "M67 E2 Q#<_plc_level>",
    "G41.1 D#<_plc_v2>",
    "G40",
    "G1 X#5399 Y#5061 F100",
    "G5.2 X1 Y#<_plc_v3> P1 L3",
    "G5.3",
    "G33 Z-1 K#<_plc_v4>",
    "G33.1 Z-1 K1",
    "S100 M3",
    "G96 S#<_plc_v5> D1000",
    "G95 F0.1",
    "(PRINT, #<_plc_level> #<_plc_none>)",
    "#<_plc_none> = 1",
    "G20",
    "G92 X#<_plc_v6>",
    "G10 L1 P1 Z#<_plc_v7>",
    "T1 M6 G43",
    "M30",
];

fn text(r: &mut Random) -> String {
    let mut out = String::new();
    for _ in 0..1 + r.below(30) {
        let mut row = ROWS[r.below(ROWS.len())].to_owned();
        if r.below(6) == 0 && !row.is_empty() {
            let at = r.below(row.len());
            match r.below(3) {
                0 => drop(row.remove(at)),
                1 => row.insert(at, char::from(b' ' + r.below(95) as u8)),
                _ => row.truncate(at),
            }
        }
        out += &row;
        out.push('\n');
    }
    out
}

fn number(r: &mut Random) -> f64 {
    [0.0, 1.0, -1.0, 2.5, 1e9, -1e300, f64::MAX, f64::MIN_POSITIVE, r.between(-10.0, 10.0)][r.below(9)]
}

fn answer(r: &mut Random) -> Answer {
    let point = |r: &mut Random| std::array::from_fn(|_| number(r));
    match r.below(4) {
        0 => Answer::Input(number(r)),
        1 => Answer::Probe { trip: (r.below(2) == 0).then(|| point(r)), stop: point(r) },
        _ => Answer::Values(std::array::from_fn(|_| number(r))),
    }
}

#[test]
fn any_answer_to_any_program() {
    let reader = ngc_reader();
    let (mut answers, mut errors) = (0, 0);
    for seed in 1..SEEDS {
        let mut r = Random(seed * 0x9E37_79B9);
        let text = text(&mut r);
        let environment = environment(&disk(&[("s.ngc", "o<s> sub\nG38.2 Z#1 F10\no<s> endsub\n")]));
        let mut sources = takt_base::Sources::new();
        let source: SourceId = sources.add("a.ngc", text.as_str());
        let symbols = environment.symbols.clone();
        let host = HostRef::new(std::sync::Arc::new(ChannelHost::new(environment, "a.ngc", &[], sources)));
        let program = PartProgram {
            source,
            text: text.as_str().into(),
            start: Position::default(),
            modes: String::new(),
            language: takt_motion::ngc::Language::default(),
            host,
            kept: Default::default(),
            skip_deleted: false,
            modal: None,
        };
        let mut steps = reader(&program);
        let mut run = RunReader::new(Work::default(), [0.0; 6]).with_symbols(symbols);
        for _ in 0..2000 {
            let Some(Ok(step)) = steps.next() else { break };
            if run.read(&step, &mut |_, _| {}).is_err() {
                errors += 1;
                break;
            }
            if waits_for_answer(&step.command) && r.below(20) > 0 {
                answers += 1;
                let said = answer(&mut r);
                steps.answer(&said);
                if let Answer::Probe { stop, .. } = said {
                    run.stand_at(stop);
                }
            }
        }
        let _ = steps.kept();
    }
    assert!(answers > 10_000 && errors > 500, "{answers} answers, {errors} errors");
}
