//! What schemes do around extraordinary points.

mod curvature;
mod exact;
mod spectra;
mod tuned;
