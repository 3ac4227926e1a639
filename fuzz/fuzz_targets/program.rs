//! A seed into a generated program, on both engines.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| takt_tests::fuzz::seed(bytes));
