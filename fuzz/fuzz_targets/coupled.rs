#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| femto_fuzz::coupled::run(data));
