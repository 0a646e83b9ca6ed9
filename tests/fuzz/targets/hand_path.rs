//! libFuzzer's inputs for [`stiction_fuzz::hand_path`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stiction_fuzz::hand_path(bytes));
