//! Random modules: the verifier accepts them, the text reads back, and interpreter and native code agree on every byte.

use std::sync::Arc;
use takt_compiler::codegen::Effort;
use takt_compiler::mir::{text, verify};
use takt_tests::mir_gen::{Case, generate};
use takt_tests::mir_run::{interpret, native_with};

/// Modules by default; `TAKT_MODULES` sets another number, `TAKT_SEED` the first seed.
const MODULES: u64 = 1500;

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

#[test]
fn interpreter_and_native_code_agree() {
    let first = setting("TAKT_SEED", 1);
    let mut traps = 0;
    for seed in first..first + setting("TAKT_MODULES", MODULES) {
        traps += u64::from(check(seed, &generate(seed)));
    }
    println!("{traps} of them trapped");
}

/// Runs one module; true if it trapped.
fn check(seed: u64, case: &Case) -> bool {
    let problems = verify(&case.module);
    assert!(problems.is_empty(), "seed {seed}: {}", problems[0]);
    let printed = text::print(&case.module);
    let read = text::parse(&printed).unwrap_or_else(|e| panic!("seed {seed}: {e}\n{printed}"));
    assert!(read == case.module, "seed {seed} does not read back:\n{printed}");
    let module = Arc::new(read);
    let argument = seed as u32;
    let expected = interpret(&module, case.map, &case.contents, case.entry(), argument);
    for effort in [Effort::Full, Effort::Quick] {
        let found = native_with(&module, effort, case.map, &case.contents, case.entry(), argument);
        assert_eq!(found.result, expected.result, "seed {seed}, {effort:?}:\n{printed}");
        let difference = found.memory.iter().zip(&expected.memory).position(|(a, b)| a != b);
        assert_eq!(difference, None, "seed {seed}, {effort:?}: native code leaves another byte behind the header:\n{printed}");
    }
    expected.result.is_err()
}
