//! What these tests share with those of the kernel.

#![allow(dead_code, reason = "one set of numbers for all tests")]

#[path = "../../kernel/support/exact.rs"]
pub mod exact;
#[path = "../../kernel/support/number.rs"]
pub mod number;
