//! Compile time, from text to image. `cargo bench -p takt-tests --bench compile`

use divan::Bencher;
use takt_tests::plc::compile_st;
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

#[divan::bench(sample_count = 10)]
fn ladder_1000_rungs(bencher: Bencher) {
    let text = ladder(1000);
    bencher.bench(|| compile_st(&text).image.is_some());
}
