//! Passes libFuzzer's inputs to [`stiction_fuzz::scene_file`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stiction_fuzz::scene_file(bytes));
