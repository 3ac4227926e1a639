//! Random ST programs: accepted by the checker, and the interpreter and native code agree on every byte and every fault.
//! `TAKT_PROGRAMS=10000 TAKT_SEED=1 cargo test --release -p takt-tests --test fuzz_programs` runs more of them.

use takt_tests::generate::{Shape, program};
use takt_tests::plc::Plc;

/// Programs of an ordinary test run.
const PROGRAMS: u64 = 300;
/// Scans of each.
const SCANS: i64 = 3;

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

#[test]
fn generated_programs_agree_on_both_engines() {
    let (first, count) = (setting("TAKT_SEED", 1), setting("TAKT_PROGRAMS", PROGRAMS));
    let faults = (first..first + count).filter(|&seed| faults(seed)).count() as u64;
    println!("{count} programs, {faults} of them faulted");
    assert!(faults * 10 < count * 9, "programs that fault at once test little");
}

/// Runs a program; true if it faulted. A difference panics and names the seed.
fn faults(seed: u64) -> bool {
    let text = program(seed, Shape::default());
    let outcome = std::panic::catch_unwind(|| {
        let mut plc = Plc::new(&text);
        (0..SCANS).any(|i| plc.scan(10 * i).is_err())
    });
    outcome.unwrap_or_else(|_| panic!("seed {seed}:\n{text}"))
}
