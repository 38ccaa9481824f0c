//! The primal schemes row by row, in exact arithmetic: each weight, rule and tag by a
//! number worked out by hand.
//!
//! A target of its own, so that a mutant of `scheme` or `refine` needs only this compiled.

#![allow(clippy::float_cmp, reason = "what is exact is compared exactly")]

mod channels;
mod control;
mod creases;
mod masks;
mod numbering;
mod support;
mod tags;
