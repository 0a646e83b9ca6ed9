//! Passes libFuzzer's inputs to [`stiction_fuzz::hand_path`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stiction_fuzz::hand_path(bytes));
