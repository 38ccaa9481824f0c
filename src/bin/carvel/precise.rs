//! The two number types between files, which hold doubles, and the kernel.

use crate::memory::zeroed;
use carvel::base::Scalar;
use carvel::{Element, Error, ErrorKind, Result};
use std::borrow::Cow;

/// A number type that the kernel computes in.
pub trait Precise: Scalar {
    /// A file's values in this type; `width` of them belong to each vertex.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] for a value that this type cannot hold.
    fn narrow(values: &[f64], width: usize) -> Result<Cow<'_, [Self]>>;

    /// The same values as doubles.
    fn widen(values: Vec<Self>) -> Result<Vec<f64>>;

    /// Doubles for so many points, filled in this type by `fill`.
    fn points(len: u64, fill: impl FnOnce(&mut [Self]) -> Result<()>) -> Result<Vec<[f64; 3]>>;
}

impl Precise for f64 {
    fn narrow(values: &[f64], _: usize) -> Result<Cow<'_, [Self]>> {
        Ok(Cow::Borrowed(values))
    }

    fn widen(values: Vec<Self>) -> Result<Vec<f64>> {
        Ok(values)
    }

    fn points(len: u64, fill: impl FnOnce(&mut [Self]) -> Result<()>) -> Result<Vec<[f64; 3]>> {
        let mut points = zeroed([0.0; 3], len)?;
        fill(points.as_flattened_mut())?;
        Ok(points)
    }
}

impl Precise for f32 {
    fn narrow(values: &[f64], width: usize) -> Result<Cow<'_, [Self]>> {
        let narrow: Vec<Self> = values.iter().map(|&x| x as Self).collect();
        match narrow.iter().position(|x| !x.is_finite()) {
            None => Ok(Cow::Owned(narrow)),
            Some(place) => Err(too_large(values[place], place / width)),
        }
    }

    fn widen(values: Vec<Self>) -> Result<Vec<f64>> {
        let mut wide = zeroed(0.0, values.len() as u64)?;
        wide.iter_mut().zip(values).for_each(|(to, from)| *to = f64::from(from));
        Ok(wide)
    }

    fn points(len: u64, fill: impl FnOnce(&mut [Self]) -> Result<()>) -> Result<Vec<[f64; 3]>> {
        let mut narrow = zeroed(0.0, 3 * len)?;
        fill(&mut narrow)?;
        let mut points = zeroed([0.0; 3], len)?;
        for (to, from) in points.iter_mut().zip(narrow.as_chunks().0) {
            *to = <[Self; 3]>::map(*from, f64::from);
        }
        Ok(points)
    }
}

fn too_large(value: f64, vertex: usize) -> Error {
    let message =
        format!("the value {value:e} at vertex {vertex} is too large for single precision");
    Error::new(ErrorKind::Overflow, message).with_elements([Element::Vertex(vertex as u64)])
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // what is exact is compared exactly
mod tests {
    use super::*;

    #[test]
    fn single_precision_has_an_end() {
        let error = f32::narrow(&[0.0, 1.0, 2.0, 1e39], 3).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Overflow);
        assert_eq!(error.elements(), [Element::Vertex(1)]);
        assert_eq!(f32::narrow(&[0.1], 1).unwrap()[0].to_bits(), 0.1_f32.to_bits());
    }
}
