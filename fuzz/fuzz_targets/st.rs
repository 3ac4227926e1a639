//! Source text into the compiler.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| takt_tests::fuzz::st(bytes));
