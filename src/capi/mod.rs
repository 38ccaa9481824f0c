//! The C interface: `include/carvel.h`, object by object.
//!
//! A file for each object of the header, in its order, one for each description that is
//! long (`mesh_desc`, `refine_desc`), and `polygon` for what masks make of points; each function checks what it is given,
//! borrows, calls the kernel once and writes out. The rest is what they share:
//!
//! | file | its idea |
//! |---|---|
//! | `status` | codes, and the failures that become them |
//! | `guard` | the border: panics caught, errors filled in, objects poisoned |
//! | `object` | handles: C's opaque pointers and what is behind them |
//! | `versioned` | structs that may grow, by `struct_size` |
//! | `buffer` | pointers with counts: NULL, alignment, size, overlap |
//! | `values` | records with a stride |
//!
//! The header is the manual; nothing here is documented twice. From Rust use the
//! crate itself. Nothing imports this module.
#![allow(unsafe_code)]
// Names and contracts are those of the header.
#![allow(non_camel_case_types, missing_docs, clippy::missing_safety_doc)]

mod buffer;
mod catalogue;
mod channel;
mod context;
mod error;
mod grid_mask;
mod guard;
mod hierarchy;
mod mask;
mod mesh;
mod mesh_desc;
mod object;
mod polygon;
mod predict;
mod refine_desc;
mod refiner;
mod scheme;
mod search;
mod status;
mod stencils;
mod surface;
mod tessellation;
mod values;
mod versioned;

pub use catalogue::*;
pub use channel::*;
pub use context::*;
pub use error::*;
pub use grid_mask::*;
pub use hierarchy::*;
pub use mask::*;
pub use mesh::*;
pub use mesh_desc::*;
pub use polygon::*;
pub use predict::*;
pub use refine_desc::*;
pub use refiner::*;
pub use scheme::*;
pub use search::*;
pub use status::*;
pub use stencils::*;
pub use surface::*;
pub use tessellation::*;
pub use values::*;
