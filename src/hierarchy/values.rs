//! Data on vertices: checks, and any width as columns of up to four lanes.

use crate::base::{Context, Error, ErrorKind, Result, Scalar};

/// Checks the length of an input and that its values are finite; returns the
/// largest magnitude.
pub(super) fn check<T: Scalar>(
    context: &Context,
    name: &str,
    data: &[T],
    width: usize,
    vertices: usize,
) -> Result<f64> {
    check_length(name, data.len(), width, vertices)?;
    let largest = largest_magnitude(context, data)?;
    if largest.is_finite() {
        return Ok(largest);
    }
    let place = data.iter().position(|x| !x.is_finite()).unwrap_or_default();
    Err(Error::new(
        ErrorKind::NotFinite,
        format!("{name}: value {} of vertex {} is {:?}", place % width, place / width, data[place]),
    )
    .with_elements([crate::base::Element::Vertex((place / width) as u64)]))
}

/// The largest number of values per vertex.
pub(crate) const WIDEST: usize = 1 << 16;

/// Checks that there is one record of `width` values per vertex.
pub(super) fn check_length(name: &str, len: usize, width: usize, vertices: usize) -> Result<()> {
    if (1..=WIDEST).contains(&width) && vertices.checked_mul(width) == Some(len) {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::LengthMismatch,
        format!("{name}: {len} values of width {width} for {vertices} vertices"),
    ))
}

/// The largest magnitude, infinite if any value is not finite.
fn largest_magnitude<T: Scalar>(context: &Context, data: &[T]) -> Result<f64> {
    let parts = context.map(context.chunks(data.len()), |range| {
        let mut largest = 0.0_f64;
        let mut finite = true;
        for x in &data[range] {
            finite &= x.is_finite();
            largest = largest.max(x.to_f64().abs());
        }
        if finite { largest } else { f64::INFINITY }
    })?;
    Ok(parts.into_iter().fold(0.0, f64::max))
}

/// Fails if a refined value left the range of the number type.
pub(super) fn check_overflow<T: Scalar>(context: &Context, data: &[T], level: usize) -> Result<()> {
    if largest_magnitude(context, data)?.is_finite() {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::Overflow,
        format!("a value leaves the range of the number type by level {level}"),
    ))
}

/// The columns of a width: runs of at most four lanes.
pub(super) fn lanes(width: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..width).step_by(4).map(move |first| (first, (width - first).min(4)))
}

/// Copies the lanes `first..first + W` of every record.
pub(super) fn gather<T: Scalar, const W: usize>(
    data: &[T],
    width: usize,
    first: usize,
    out: &mut Vec<[T; W]>,
) {
    out.clear();
    out.extend(data.chunks_exact(width).map(|record| {
        let mut lanes = [T::default(); W];
        lanes.copy_from_slice(&record[first..first + W]);
        lanes
    }));
}

/// Writes lanes back into records.
pub(super) fn scatter<T: Scalar, const W: usize>(
    lanes: &[[T; W]],
    width: usize,
    first: usize,
    out: &mut [T],
) {
    for (record, lanes) in out.chunks_exact_mut(width).zip(lanes) {
        record[first..first + W].copy_from_slice(lanes);
    }
}
