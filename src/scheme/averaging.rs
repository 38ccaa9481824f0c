//! The averaging family: a split and a list of smoothing passes.
//!
//! * Dual split: the corner split, the new vertex of a corner placed by C_½ on
//!   its face.
//! * Primal split: the quad split, new vertices on edges at midpoints and in faces at
//!   centroids, old ones in place.
//! * Pass M_t: every vertex moves to the mean, over its faces, of the points C_t
//!   of its corners there.
//!
//! On a regular quad mesh a pass is the tensor square of the filter
//! (a/2, 1−a, a/2), a = (1−t)/2, so the family holds every tensor-product scheme
//! whose mask is that of a Chaikin or linear step times such filters. The founding
//! paper's scheme, mask [1,9,22,22,9,1]/32, is the dual split with one pass t = ½.

use super::scheme_options::Boundary;
use super::{Method, Scheme};
use crate::base::{Error, ErrorKind, Fraction, Result, memory};
use crate::mesh::Mesh;
use crate::refine::Anchor;

/// The largest |t| of a pass. Beyond it the weights say nothing about a
/// surface any more and coordinates overflow within a few levels.
const LARGEST_PASS: i64 = 1000;
/// The largest number of passes in one step.
pub(crate) const MOST_PASSES: usize = 64;

impl Scheme {
    /// The dual split followed by the passes M_t, in order.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for |t| > 1000 or more than 64 passes.
    pub fn dual(passes: &[Fraction]) -> Result<Self> {
        check_passes(passes)?;
        Ok(Self::from_passes(Method::Dual, passes))
    }

    /// The quad split, linear, followed by the passes M_t, in order.
    ///
    /// Along boundaries a pass is the univariate filter, vertices of a single face stay,
    /// and the boundary mode has no influence. Creases and non-manifold parts are
    /// refused if there is any pass.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for |t| > 1000 or more than 64 passes.
    pub fn primal(passes: &[Fraction]) -> Result<Self> {
        check_passes(passes)?;
        Ok(Self::from_passes(Method::Primal, passes))
    }

    /// What the next step of a dual scheme does along the boundary of a mesh.
    pub(crate) fn anchor(&self, mesh: &Mesh) -> Result<Anchor> {
        if self.boundary() == Boundary::None || mesh.is_anchored() {
            return Ok(Anchor::Keep);
        }
        let mut kappas = memory::copied(mesh.corner_tags())?;
        if self.boundary() == Boundary::EdgeAndCorner {
            memory::extend(&mut kappas, mesh.single_face_vertices())?;
            kappas.sort_unstable();
            kappas.dedup();
        }
        Ok(Anchor::Lay { kappas })
    }

    /// True if a step of this scheme leaves the mesh anchored.
    pub(crate) fn anchors(&self) -> bool {
        self.method() == Method::Dual && self.boundary() != Boundary::None
    }

    /// A bound on how much the passes and a dual split can enlarge a coordinate: the row
    /// norms of C_t on a mirrored face are at most 9 times those of C_t itself.
    pub(super) fn averaging_growth(&self) -> f64 {
        const MIRROR: f64 = 9.0;
        let cosine = |t: f64| t * t + (1.0 - t * t).abs() + 2.0 * (t * (1.0 - t)).abs();
        let average = |t: f64| (t.abs() + (1.0 - t).abs()).powi(2);
        let norm = |t: f64| cosine(t).max(average(t));
        let passes = self.passes().iter().map(|t| MIRROR * norm(t.to_f64()));
        MIRROR * norm(0.5) * passes.product::<f64>()
    }
}

fn check_passes(passes: &[Fraction]) -> Result<()> {
    if passes.len() > MOST_PASSES {
        return Err(out_of_range(format!("{} passes: the limit is {MOST_PASSES}", passes.len())));
    }
    let too_large = |t: &&Fraction| t.to_f64().abs() > LARGEST_PASS as f64;
    match passes.iter().find(too_large) {
        Some(t) => Err(out_of_range(format!("pass {t} is not within ±{LARGEST_PASS}"))),
        None => Ok(()),
    }
}

pub(super) fn out_of_range(message: String) -> Error {
    Error::new(ErrorKind::ParameterOutOfRange, message)
}
