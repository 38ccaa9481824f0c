//! What eigenvalues and characteristic map say about the surface.

use super::{CharacteristicMap, Feature, Spectrum};
use crate::base::Result;
use crate::scheme::Scheme;
use std::fmt;

/// A Jacobian is no larger than rounding makes one.
const FLAT: f64 = 1e-6;
/// μ/λ² is 1 if it is not farther off.
const SAME: f64 = 1e-7;

/// Whether the surface has a continuous tangent plane at a feature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tangent {
    /// Eigenvalues as they must be, and a characteristic map that is regular and injective
    /// at all samples. The eigenvalues are computed, regularity is sampled.
    Continuous,
    /// Eigenvalues as they must be, but the map is not regular, or not injective, at some sample.
    Folded,
    /// The two largest eigenvalues beside 1 do not span a tangent plane.
    Undefined,
    /// The surface is sharp on purpose: it has sides with a tangent plane each, or a sharp edge
    /// runs into the vertex.
    Sharp,
}

impl fmt::Display for Tangent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Continuous => "C1 (spectrum computed, map sampled)",
            Self::Folded => "not C1: the characteristic map folds",
            Self::Undefined => "not C1: no tangent plane by the eigenvalues",
            Self::Sharp => "sharp",
        })
    }
}

/// How the curvature behaves on the way to an interior feature, by μ/λ².
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Curvature {
    /// It vanishes: a flat spot.
    Vanishing,
    /// It stays bounded and, in general, does not vanish.
    Bounded,
    /// It grows with the number of steps: a Jordan block.
    Growing,
    /// It grows like a power of the distance.
    Unbounded,
}

impl fmt::Display for Curvature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Vanishing => "vanishing",
            Self::Bounded => "bounded",
            Self::Growing => "growing (Jordan block)",
            Self::Unbounded => "unbounded",
        })
    }
}

/// A verdict on a scheme at a feature.
#[derive(Debug, Clone)]
pub struct Smoothness {
    /// The largest eigenvalue beside 1.
    pub lambda: f64,
    /// The largest after those of the tangent plane.
    pub mu: f64,
    /// μ/λ² of an interior feature: below 1 the curvature vanishes, above it grows.
    pub ratio: Option<f64>,
    /// The tangent plane.
    pub tangent: Tangent,
    /// The curvature; only where the surface is C¹ and the feature symmetric.
    pub curvature: Option<Curvature>,
}

impl Smoothness {
    /// The verdict on a scheme by its spectrum at a feature and the map.
    ///
    /// # Errors
    /// As [`CharacteristicMap::new`].
    pub fn new(scheme: &Scheme, spectrum: &Spectrum) -> Result<Self> {
        let map = CharacteristicMap::new(scheme, spectrum)?;
        Ok(Self::of(spectrum, map.as_ref()))
    }

    /// The verdict of a spectrum and a map that are there already.
    pub fn of(spectrum: &Spectrum, map: Option<&CharacteristicMap>) -> Self {
        let (lambda, mu) = (spectrum.lambda(), spectrum.mu());
        let interior = spectrum.sectors() > 1 && lambda > 0.0;
        let ratio = interior.then(|| mu / (lambda * lambda));
        let tangent = match (spectrum.feature(), map) {
            (Feature::Crease { .. } | Feature::Corner { .. } | Feature::Dart { .. }, _) => {
                Tangent::Sharp
            }
            (_, Some(map)) if map.least_jacobian > FLAT && map.injective => Tangent::Continuous,
            (_, Some(_)) => Tangent::Folded,
            (_, None) => Tangent::Undefined,
        };
        let smooth = ratio.filter(|_| tangent == Tangent::Continuous);
        let curvature = smooth.map(|ratio| curvature(spectrum, ratio));
        Self { lambda, mu, ratio, tangent, curvature }
    }
}

fn curvature(spectrum: &Spectrum, ratio: f64) -> Curvature {
    let jordan = spectrum
        .eigenvalues()
        .iter()
        .any(|e| (e.size() - spectrum.mu()).abs() < SAME && e.vectors < e.copies);
    match ratio - 1.0 {
        beyond if beyond > SAME => Curvature::Unbounded,
        beyond if beyond < -SAME => Curvature::Vanishing,
        _ if jordan => Curvature::Growing,
        _ => Curvature::Bounded,
    }
}
