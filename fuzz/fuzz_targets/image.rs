//! A file into the image decoder.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| takt_tests::fuzz::image(bytes));
