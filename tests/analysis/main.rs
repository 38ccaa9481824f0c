//! What schemes do around extraordinary points.

mod exact;
mod spectra;
