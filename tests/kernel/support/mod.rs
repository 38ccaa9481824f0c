//! The independent oracle of the tests: a slow reference of the averaging
//! family, the golden cases, mesh generators and comparison.
//!
//! The oracle does not use the kernel ([`kernel`], [`exact`] and [`cases`] are
//! how tests put the two together), and nothing in it is written for speed: what
//! the tests believe must be readable at one glance. A test binary takes it in
//! with `mod support;`.
//!
//! | module | what it holds |
//! |---|---|
//! | [`number`] | the scalar trait: `f64` and exact rationals |
//! | [`poly`] | the polygon mesh that everything here speaks |
//! | [`topology`] | adjacency rebuilt from the faces alone |
//! | [`manifold`] | a brute-force check that a face list is manifold |
//! | [`reference`] | the averaging family, step by step |
//! | [`univariate`] | its curves and their tensor products, exactly |
//! | [`compare`] | equality of meshes up to numbering |
//! | [`generate`] | random manifold meshes |
//! | [`golden`] | the cases of `tests/golden` |
//! | [`tensor`] | grids as meshes, compared exactly |
//! | [`tolerance`] | every tolerance, with its reason |
//! | [`cases`] | configuration of property tests, random schemes |
//! | [`kernel`] | the kernel in the oracle's words |
//! | [`exact`] | the kernel's weights in exact arithmetic |
//! | [`allocation`] | the most memory that a thread holds |

// Small integer weights and indices before the start of a curve are signed; no
// mesh of a test comes near the range of either type.
#![allow(clippy::cast_possible_wrap, clippy::cast_sign_loss)]

pub mod allocation;
pub mod bases;
pub mod cases;
pub mod compare;
pub mod exact;
pub mod generate;
pub mod golden;
pub mod kernel;
pub mod manifold;
pub mod number;
pub mod poly;
pub mod reference;
pub mod rng;
pub mod tensor;
pub mod tolerance;
pub mod topology;
pub mod univariate;
