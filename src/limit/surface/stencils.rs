//! Samples of a surface as a stencil table on the control vertices.

use super::{Derivatives, Sample, Surface, SurfaceWeight, named};
use crate::base::{Context, Error, ErrorKind, Result, Scalar, memory};
use crate::sparse::{StencilTable, assemble};

/// What a thread came to last.
struct Last<T> {
    sample: Option<usize>,
    weights: Vec<SurfaceWeight>,
    row: Vec<(u32, T)>,
}

impl Surface {
    /// A table from values of the control vertices to those of samples: for each sample
    /// [`Derivatives::records`] rows, in the order of [`Surface::evaluate`]. For samples that are
    /// evaluated again and again while control vertices move, and, by the transpose, for
    /// gradients by control vertices.
    ///
    /// Weights are computed in double precision and rounded once; columns of a row ascend, and
    /// weights of 0 are left out. Each sample costs as much as evaluating as many values as its
    /// face has control vertices.
    ///
    /// # Errors
    /// As [`Surface::weights`], for the first sample concerned; [`ErrorKind::NotFinite`] for a
    /// weight beyond the number type, of derivatives very near an extraordinary vertex;
    /// [`ErrorKind::TooLarge`] for 2³² − 1 rows or weights and more;
    /// [`ErrorKind::MemoryCeiling`], [`ErrorKind::Cancelled`].
    ///
    /// # Example
    /// Position and tangents at the middle of a cube's face:
    /// ```
    /// use carvel::limit::{Derivatives, Sample, Surface};
    /// use carvel::{Context, Mesh, Records, RecordsMut, Scheme};
    /// use std::sync::Arc;
    /// let cube = Arc::new(Mesh::from_polygons(8, &[4; 6], &[
    ///     0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3,
    /// ])?);
    /// let context = Context::serial();
    /// let surface = Surface::new(&context, &cube, &Scheme::catmull_clark())?;
    /// let middle = Sample { face: 0, sector: 0, u: 0.5, v: 0.5 };
    /// let table = surface.stencils::<f64>(&context, &[middle], Derivatives::First)?;
    /// let corners: Vec<f64> = (0..24).map(|i| f64::from(i / 3 >> (i % 3) & 1)).collect();
    /// let mut out = [0.0; 9];
    /// let values = Records::packed(&corners, 3);
    /// table.apply(&context, values, RecordsMut::packed(&mut out, 3))?;
    /// // The face lies in the plane z = 0, and so do both tangents.
    /// assert!(out[5].abs() < 1e-15 && out[8].abs() < 1e-15);
    /// # Ok::<(), carvel::Error>(())
    /// ```
    pub fn stencils<T: Scalar>(
        &self,
        context: &Context,
        samples: &[Sample],
        derivatives: Derivatives,
    ) -> Result<StencilTable<T>> {
        let records = derivatives.records();
        let rows = samples.len().saturating_mul(records);
        let columns = self.columns;
        let nothing = || Ok(Last { sample: None, weights: Vec::new(), row: Vec::new() });
        assemble(context, rows, columns, nothing, |last, row, out| {
            let (sample, record) = (row / records, row % records);
            if last.sample != Some(sample) {
                last.weights = self.weights(&samples[sample], derivatives)?;
                last.sample = Some(sample);
            }
            let weights = last.weights.iter().map(|&(v, of)| (v, T::from_f64(of[record])));
            last.row.clear();
            memory::extend(&mut last.row, weights.filter(|&(_, weight)| weight != T::default()))?;
            if last.row.iter().any(|(_, weight)| !weight.is_finite()) {
                let error = Error::new(ErrorKind::NotFinite, "a weight there is not finite");
                return Err(named(error, &samples[sample]));
            }
            out.row(last.row.iter().map(|term| term.0), last.row.iter().map(|term| term.1))
        })
    }
}
