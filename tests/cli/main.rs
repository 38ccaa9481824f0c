//! The `carvel` command as its users meet it.

#![cfg(feature = "cli")]
// What is exact is compared exactly.
#![allow(clippy::float_cmp)]

mod analysed;
mod bench;
mod carried;
mod cases;
mod creases;
mod curves;
mod holes;
mod hostile;
mod limits;
mod masks;
mod pictures;
mod places;
mod plots;
mod primal;
mod refined;
mod spot;
mod stencils;
mod tessellated;
mod texture;
mod usage;
