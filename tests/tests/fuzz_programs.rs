//! Random ST programs: the compiler takes each, and interpreter and native code agree scan by scan, byte by byte.

use takt_tests::differential::run_many;
use takt_tests::generate::fuzzed;

/// Programs by default; `TAKT_PROGRAMS` sets another number, `TAKT_SEED` the first seed.
const PROGRAMS: u64 = 400;
const SCANS: i64 = 3;

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

#[test]
fn interpreter_and_native_code_agree() {
    let tally = run_many(setting("TAKT_SEED", 1), setting("TAKT_PROGRAMS", PROGRAMS), SCANS);
    println!("{} programs, {} ended, faults {:?}", tally.programs, tally.ended, tally.faults);
    for (seed, why) in tally.failures.iter().take(20) {
        println!("seed {seed}: {why}\n");
    }
    let first = tally.failures.first().map(|(seed, _)| fuzzed(*seed));
    assert_eq!(tally.failures.len(), 0, "{}", first.unwrap_or_default());
    assert!(10 * tally.ended >= 6 * tally.programs, "too many programs fault: {tally:?}");
}
