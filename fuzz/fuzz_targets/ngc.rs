//! A part program into the g-code checker.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| takt_tests::fuzz::ngc(bytes));
