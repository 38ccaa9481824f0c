//! Any bytes as OBJ.
#![no_main]

mod exercise;

libfuzzer_sys::fuzz_target!(|data: &[u8]| exercise::exercise(data, carvel::io::Format::Obj));
