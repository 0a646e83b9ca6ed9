//! Passes libFuzzer's inputs to [`stiction_fuzz::wire`].
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stiction_fuzz::wire(bytes));
