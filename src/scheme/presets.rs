//! The named schemes. Members of the averaging family:
//!
//! | name | split | passes | univariate mask |
//! |---|---|---|---|
//! | Doo–Sabin | dual | – | [1,3,3,1]/4 |
//! | three-point(w) | dual | 1−16w | [w, ¼+w, ¾−2w, ¾−2w, ¼+w, w] |
//! | quartic B-spline | dual | 0 | [1,5,10,10,5,1]/16 |
//! | B-spline of degree 2+2k | dual | 0, k times | binomial |
//! | bilinear | primal | – | [1,2,1]/2 |
//! | B-spline of degree 1+2k | primal | 0, k times | binomial |

use super::averaging::out_of_range;
use super::{Method, Scheme};
use crate::base::{Fraction, Result};

/// The largest B-spline degree on offer.
const LARGEST_DEGREE: u32 = 65;

impl Scheme {
    /// Doo and Sabin's scheme (1978): biquadratic B-splines, C¹.
    pub fn doo_sabin() -> Self {
        Self::from_passes(Method::Dual, &[])
    }

    /// The founding paper's family: w = 1/32 is its scheme, C²; w = 0 is
    /// Doo–Sabin and w = 1/16 the quartic B-spline.
    ///
    /// # Errors
    /// [`crate::ErrorKind::ParameterOutOfRange`] unless 0 ≤ w ≤ 1/16, where all
    /// weights are non-negative; other passes t = 1−16w go by [`Scheme::dual`].
    pub fn three_point(w: Fraction) -> Result<Self> {
        let t = w.affine(1, -16).filter(|t| (0..=t.denominator()).contains(&t.numerator()));
        let t = t.ok_or_else(|| {
            out_of_range(format!(
                "w = {w} is not within 0 and 1/16; for others give the pass t = 1 - 16w itself"
            ))
        })?;
        Self::dual(&[t])
    }

    /// The tensor-product quartic B-spline.
    pub fn quartic() -> Self {
        Self::from_passes(Method::Dual, &[Fraction::ZERO])
    }

    /// Catmull and Clark's scheme (1978): bicubic B-splines, C² but at extraordinary
    /// vertices. Weights of vertices: (n−2)/n, 1/n² for neighbours and face points.
    pub fn catmull_clark() -> Self {
        Self::from_passes(Method::CatmullClark, &[])
    }

    /// Loop's scheme (1987) on triangles: quartic box splines, C² but at extraordinary
    /// vertices.
    pub fn loop_triangles() -> Self {
        Self::from_passes(Method::Loop, &[])
    }

    /// Linear refinement: midpoints of edges, means of faces.
    pub fn bilinear() -> Self {
        Self::from_passes(Method::Primal, &[])
    }

    /// The tensor-product B-spline of a degree: primal if it is odd, dual if even. On
    /// irregular meshes these are averaging schemes (Zorin and Schröder 2001, Stam 2001),
    /// whose degree 3 is not Catmull–Clark there.
    ///
    /// # Errors
    /// [`crate::ErrorKind::ParameterOutOfRange`] unless the degree is within 1 and 65.
    pub fn b_spline(degree: u32) -> Result<Self> {
        if !(1..=LARGEST_DEGREE).contains(&degree) {
            return Err(out_of_range(format!(
                "degree {degree}: there are B-splines of the degrees 1 to {LARGEST_DEGREE}"
            )));
        }
        let passes = vec![Fraction::ZERO; (degree as usize - 1) / 2];
        if degree.is_multiple_of(2) { Self::dual(&passes) } else { Self::primal(&passes) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::ErrorKind;

    fn w(num: i64, den: i64) -> Result<Scheme> {
        Scheme::three_point(Fraction::new(num, den)?)
    }

    #[test]
    fn the_range_of_w_is_enforced_at_its_ends() {
        assert_eq!(w(0, 1).unwrap().passes(), [Fraction::ONE]);
        assert_eq!(w(1, 16).unwrap().passes(), [Fraction::ZERO]);
        for (num, den) in [(-1, 1_000_000), (1_000_001, 16_000_000), (1, 15), (i64::MAX, 1)] {
            let error = w(num, den).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::ParameterOutOfRange);
            assert!(error.to_string().contains("1/16"), "{error}");
        }
    }

    #[test]
    fn b_splines_alternate_between_the_splits() {
        assert_eq!(Scheme::b_spline(1).unwrap(), Scheme::bilinear());
        assert_eq!(Scheme::b_spline(2).unwrap(), Scheme::doo_sabin());
        assert_eq!(Scheme::b_spline(4).unwrap(), Scheme::quartic());
        assert_eq!(Scheme::b_spline(7).unwrap().passes().len(), 3);
        assert_eq!(Scheme::b_spline(8).unwrap().passes().len(), 3);
        for degree in [0, 66, u32::MAX] {
            assert!(Scheme::b_spline(degree).is_err(), "{degree}");
        }
    }
}
