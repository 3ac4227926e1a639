//! G-code reading, planning and interpolation. `cargo bench -p takt-tests --bench motion`

use divan::Bencher;
use divan::counter::ItemsCount;
use std::fmt::Write;
use takt_base::SourceId;
use takt_motion::canon::Step;
use takt_motion::ngc::{Interpreter, Options};
use takt_motion::plan::{PlanConfig, plan};

const BLOCKS: usize = 10_000;

fn main() {
    divan::main();
}

/// Short lines of a curve, as CAM systems write them.
fn part_program() -> String {
    let mut text = String::from("G21 G17 G90 F3000\n");
    for i in 0..BLOCKS {
        let a = i as f64 * 0.01;
        let _ = writeln!(text, "G1 X{:.4} Y{:.4}", 50.0 * cosine(a), 50.0 * cosine(a + std::f64::consts::FRAC_PI_2));
    }
    text + "M2\n"
}

/// Cosine by its series: the same text on every machine.
fn cosine(a: f64) -> f64 {
    let x = a % std::f64::consts::TAU;
    (0..24).fold((1.0, 0.0), |(term, sum), k| (-term * x * x / f64::from((2 * k + 1) * (2 * k + 2)), sum + term)).1
}

fn steps(text: &str) -> Vec<Step> {
    Interpreter::new(SourceId(0), text, Options::default()).map(|s| s.expect("a right block")).collect()
}

#[divan::bench(sample_count = 20)]
fn read_10000_blocks(bencher: Bencher) {
    let text = part_program();
    bencher.counter(ItemsCount::new(BLOCKS)).bench(|| steps(&text).len());
}

fn drain(text: &str) -> usize {
    Interpreter::new(SourceId(0), text, Options::default()).inspect(|s| assert!(s.is_ok())).count()
}

/// Arcs: centre and sweep are checked for each.
#[divan::bench(sample_count = 20)]
fn read_10000_arcs(bencher: Bencher) {
    let text = "F100\n".to_owned() + &"G2 X10 Y0 I5 J0\nG3 X0 Y0 I-5 J0\n".repeat(BLOCKS / 2);
    bencher.counter(ItemsCount::new(BLOCKS)).bench(|| drain(&text));
}

/// A loop with expressions and calls: 5 rows a turn and 3 in the subroutine.
#[divan::bench(sample_count = 20)]
fn run_80000_rows_of_a_macro(bencher: Bencher) {
    let sub = "o100 sub\n#1 = [#1 * 2 + 1]\nG1 X[#1 * SIN[#2]] Y[#1 * COS[#2]]\no100 endsub\n";
    let body = "o1 while [#10 LT 10000]\nG1 X[#10 / 1000]\no100 call [#10 / 100] [30]\n#10 = [#10 + 1]\no1 endwhile\nM2\n";
    let text = format!("F100\n{sub}{body}");
    bencher.counter(ItemsCount::new(8 * BLOCKS)).bench(|| drain(&text));
}

/// Look-ahead and interpolation at 1 ms, measured as `takt gcode --plan` does.
#[divan::bench(sample_count = 10)]
fn plan_10000_blocks(bencher: Bencher) {
    let steps = steps(&part_program());
    let config = PlanConfig::uniform(500.0, 5000.0);
    bencher.counter(ItemsCount::new(BLOCKS)).bench(|| plan(steps.clone(), &config).map(|r| r.blocks).unwrap_or(0));
}
