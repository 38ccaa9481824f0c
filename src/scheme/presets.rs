//! The named members of the dual averaging family.
//!
//! | name | passes | univariate mask |
//! |---|---|---|
//! | Doo–Sabin | – | [1,3,3,1]/4 |
//! | three-point(w) | 1−16w | [w, ¼+w, ¾−2w, ¾−2w, ¼+w, w] |
//! | quartic B-spline | 0 | [1,5,10,10,5,1]/16 |
//! | B-spline of degree 2+2k | 0, k times | binomial |

use super::Scheme;
use super::averaging::out_of_range;
use crate::base::{Fraction, Result};

/// The largest B-spline degree on offer.
const LARGEST_DEGREE: u32 = 64;

impl Scheme {
    /// Doo and Sabin's scheme (1978): biquadratic B-splines, C¹.
    pub fn doo_sabin() -> Self {
        Self::from_passes(&[])
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
        Self::from_passes(&[Fraction::ZERO])
    }

    /// The tensor-product B-spline of an even degree.
    ///
    /// # Errors
    /// [`crate::ErrorKind::ParameterOutOfRange`] unless the degree is even and
    /// within 2 and 64.
    pub fn b_spline(degree: u32) -> Result<Self> {
        if !(2..=LARGEST_DEGREE).contains(&degree) || !degree.is_multiple_of(2) {
            return Err(out_of_range(format!(
                "degree {degree}: the dual family has the even degrees 2 to {LARGEST_DEGREE}"
            )));
        }
        Self::dual(&vec![Fraction::ZERO; degree as usize / 2 - 1])
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
    fn b_splines_have_even_degrees() {
        assert_eq!(Scheme::b_spline(2).unwrap(), Scheme::doo_sabin());
        assert_eq!(Scheme::b_spline(4).unwrap(), Scheme::quartic());
        assert_eq!(Scheme::b_spline(8).unwrap().passes().len(), 3);
        for degree in [0, 1, 3, 65, 66, u32::MAX] {
            assert!(Scheme::b_spline(degree).is_err(), "{degree}");
        }
    }
}
