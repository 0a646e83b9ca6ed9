//! Passes libFuzzer's inputs to [`stiction_fuzz::solver`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stiction_fuzz::solver(bytes));
