//! Scan time. Each program stands beside a twin in Rust: compare the two of one run, since machines differ. The twin of the ladder
//! walks a table of rungs, the twin of the loops is plain Rust.
//! `cargo bench -p takt-tests --bench scan`

mod common;

use common::Loaded;
use divan::{Bencher, black_box};
use takt_tests::workloads::{MANDELBROT, RustLadder, ladder, rust_mandelbrot};

const RUNGS: usize = 1000;

fn main() {
    divan::main();
}

fn scans(bencher: Bencher, text: &str) {
    let mut program = Loaded::new(text);
    bencher.bench_local(|| program.scan());
}

#[divan::bench]
fn blink(bencher: Bencher) {
    scans(bencher, include_str!("../../examples/01-blink/blink.st"));
}

/// What a call into native code costs by itself.
#[divan::bench]
fn empty(bencher: Bencher) {
    scans(bencher, "PROGRAM main\nEND_PROGRAM\n");
}

#[divan::bench]
fn ladder_1000_rungs(bencher: Bencher) {
    scans(bencher, &ladder(RUNGS));
}

#[divan::bench]
fn ladder_1000_rungs_as_a_table_in_rust(bencher: Bencher) {
    let mut twin = RustLadder::new(RUNGS);
    bencher.bench_local(|| twin.scan());
}

#[divan::bench]
fn floating_point(bencher: Bencher) {
    scans(bencher, MANDELBROT);
}

#[divan::bench]
fn floating_point_in_rust(bencher: Bencher) {
    bencher.bench_local(|| black_box(rust_mandelbrot()));
}
