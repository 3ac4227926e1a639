//! Compile time, from text to image. `cargo bench -p takt-tests --bench compile`

use divan::Bencher;
use takt_tests::plc::{check_st, compile_st};
use takt_tests::workloads::{ladder, lines};

fn main() {
    divan::main();
}

/// Lines of ordinary ST; the standard library is compiled along every time.
#[divan::bench(args = [100, 1000, 10_000], sample_count = 10)]
fn st_lines(bencher: Bencher, count: usize) {
    let text = lines(count);
    bencher.counter(divan::counter::ItemsCount::new(text.lines().count())).bench(|| compile_st(&text).image.is_some());
}

/// What `takt check` does with 100,000 lines: everything but machine code. Reported as lines per second.
#[divan::bench(sample_count = 5)]
fn check_100_000_lines(bencher: Bencher) {
    let text = lines(100_000);
    bencher.counter(divan::counter::ItemsCount::new(text.lines().count())).bench(|| check_st(&text).diags.len());
}

#[divan::bench(sample_count = 10)]
fn ladder_1000_rungs(bencher: Bencher) {
    let text = ladder(1000);
    bencher.bench(|| compile_st(&text).image.is_some());
}
