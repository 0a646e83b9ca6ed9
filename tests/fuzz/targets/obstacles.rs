//! libFuzzer's inputs for [`stiction_fuzz::obstacles`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stiction_fuzz::obstacles(bytes));
