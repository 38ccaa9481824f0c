//! Exact analysis of masks, that is of curves and regular grids: what is claimed here is proved
//! in rational arithmetic, or with all roundings counted.
//!
//! ```
//! use carvel::Context;
//! use carvel::analysis::mask::{Analysis, Effort};
//! use carvel::curve::catalogue;
//! let paper = catalogue::mask("three-point:1/32")?;
//! let analysis = Analysis::of(&Context::serial(), &paper, Effort::default())?;
//! assert_eq!(analysis.continuity, Some(2));
//! # Ok::<(), carvel::Error>(())
//! ```
//!
//! | module | its one idea |
//! |---|---|
//! | `sum_rules` | smoothing factors of a symbol |
//! | `contractivity` | C^k by a norm below 1 |
//! | `joint_radius` | bounds on the growth of products; `words` below, `polytope` above |
//! | `reproduction` | polynomials that are generated and reproduced |
//! | `response` | shrinking and artifacts of waves |
//! | `range` | parameters of a family for which it is C^k |
//! | `bivariate` | polynomials in two variables, C^k on grids |
//! | `report` | all of it for one mask |

mod bivariate;
mod contractivity;
mod joint_radius;
mod polytope;
mod range;
mod report;
mod reproduction;
mod response;
mod spectral;
mod sum_rules;
mod words;

pub use bivariate::{Bivariate, GridContractivity, grid_contractivity};
pub use contractivity::{Contractivity, PowerNorms, contractivity};
pub use joint_radius::{Certificate, JointRadius};
pub use range::{AffineFamily, End, ParameterRange};
pub use report::{Analysis, Effort, Holder};
pub use reproduction::Degrees;
pub use response::{FrequencyResponse, Response};
pub use sum_rules::{Smoothing, difference_symbol};
