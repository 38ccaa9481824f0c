//! The averaging family: a split and a list of smoothing passes.
//!
//! * Dual split: the corner split, the new vertex of a corner placed by C_½ on
//!   its face.
//! * Pass M_t: every vertex moves to the mean, over its faces, of the points C_t
//!   of its corners there.
//!
//! On a regular quad mesh a pass is the tensor square of the filter
//! (a/2, 1−a, a/2), a = (1−t)/2, so the family holds every tensor-product scheme
//! whose mask is that of a Chaikin step times such filters. The founding paper's
//! scheme, mask [1,9,22,22,9,1]/32, is the dual split with one pass t = ½.

use super::CornerRule;
use crate::base::{Error, ErrorKind, Fraction, Result, memory};
use crate::mesh::Mesh;
use crate::refine::Anchor;

/// What happens along a boundary, in OpenSubdiv's vocabulary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Boundary {
    /// No added points: the surface ends half a cell inside.
    None,
    /// The boundary curve is the univariate curve of the boundary polygon;
    /// tagged corners are interpolated.
    Edge,
    /// Also interpolates the boundary vertices with a single face.
    #[default]
    EdgeAndCorner,
}

/// The largest |t| of a pass. Beyond it the weights say nothing about a
/// surface any more and coordinates overflow within a few levels.
const LARGEST_PASS: i64 = 1000;
/// The largest number of passes in one step.
pub(crate) const MOST_PASSES: usize = 64;

/// A subdivision scheme of the dual averaging family.
///
/// # Example
/// ```
/// use carvel::{Fraction, Scheme};
/// let paper = Scheme::three_point(Fraction::new(1, 32)?)?;
/// assert_eq!(paper.passes(), [Fraction::HALF]);
/// # Ok::<(), carvel::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Scheme {
    passes: Vec<Fraction>,
    rule: CornerRule,
    boundary: Boundary,
}

impl Scheme {
    /// The dual split followed by the passes M_t, in order.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for |t| > 1000 or more than 64 passes.
    pub fn dual(passes: &[Fraction]) -> Result<Self> {
        if passes.len() > MOST_PASSES {
            return Err(out_of_range(format!(
                "{} passes: the limit is {MOST_PASSES}",
                passes.len()
            )));
        }
        let too_large = |t: &&Fraction| t.to_f64().abs() > LARGEST_PASS as f64;
        if let Some(t) = passes.iter().find(too_large) {
            return Err(out_of_range(format!("pass {t} is not within ±{LARGEST_PASS}")));
        }
        Ok(Self::from_passes(passes))
    }

    /// A scheme with passes that are known to be in range.
    pub(super) fn from_passes(passes: &[Fraction]) -> Self {
        Self { passes: passes.to_vec(), rule: CornerRule::default(), boundary: Boundary::default() }
    }

    /// The same scheme with another corner operator on n-gons.
    #[must_use]
    pub fn with_rule(mut self, rule: CornerRule) -> Self {
        self.rule = rule;
        self
    }

    /// The same scheme with another boundary rule.
    #[must_use]
    pub fn with_boundary(mut self, boundary: Boundary) -> Self {
        self.boundary = boundary;
        self
    }

    /// The passes, in order.
    pub fn passes(&self) -> &[Fraction] {
        &self.passes
    }

    /// The corner operator.
    pub fn rule(&self) -> CornerRule {
        self.rule
    }

    /// The boundary rule.
    pub fn boundary(&self) -> Boundary {
        self.boundary
    }

    /// What the next step of this scheme does along the boundary of a mesh.
    pub(crate) fn anchor(&self, mesh: &Mesh) -> Result<Anchor> {
        if self.boundary == Boundary::None || mesh.is_anchored() {
            return Ok(Anchor::Keep);
        }
        let mut kappas = memory::copied(mesh.corner_tags())?;
        if self.boundary == Boundary::EdgeAndCorner {
            memory::extend(&mut kappas, mesh.single_face_vertices())?;
            kappas.sort_unstable();
            kappas.dedup();
        }
        Ok(Anchor::Lay { kappas })
    }

    /// True if a step of this scheme leaves the mesh anchored.
    pub(crate) fn anchors(&self) -> bool {
        self.boundary != Boundary::None
    }

    /// A bound on how much one step can enlarge a coordinate: the row norms of
    /// C_t on a mirrored face are at most 9 times those of C_t itself.
    pub(crate) fn growth(&self) -> f64 {
        const MIRROR: f64 = 9.0;
        let cosine = |t: f64| t * t + (1.0 - t * t).abs() + 2.0 * (t * (1.0 - t)).abs();
        let average = |t: f64| (t.abs() + (1.0 - t).abs()).powi(2);
        let norm = |t: f64| cosine(t).max(average(t));
        let passes = self.passes.iter().map(|t| MIRROR * norm(t.to_f64()));
        MIRROR * norm(0.5) * passes.product::<f64>()
    }
}

pub(super) fn out_of_range(message: String) -> Error {
    Error::new(ErrorKind::ParameterOutOfRange, message)
}
