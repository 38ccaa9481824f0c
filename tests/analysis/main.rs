//! What schemes do around extraordinary points.

mod spectra;
