//! What a step does: a mask, or rules that change.

use crate::args::{MaskSource, check_name};
use crate::exit::{Doing, Failure};
use carvel::analysis::mask::contractivity;
use carvel::curve::{Coordinate, CurveScheme, Polygon};
use carvel::{Context, ErrorKind, Result as Made};

/// The scheme of a mask, or of a name of the catalogue.
///
/// # Errors
/// A usage error.
pub fn scheme(source: MaskSource) -> Result<CurveScheme, Failure> {
    let MaskSource::Named(text) = source else {
        return source.mask().map(CurveScheme::Stationary);
    };
    check_name(text)?;
    CurveScheme::named(text).map_err(|e| Failure::from_error(&e, Doing::Asking))
}

/// The points of the limit that belong to a polygon's; none where there is no mask, or it is
/// not proved to converge.
///
/// # Errors
/// As [`Polygon::limit`].
pub fn limit<T: Coordinate>(
    context: &Context,
    scheme: &CurveScheme,
    polygon: &Polygon<T>,
) -> Made<Option<Polygon<T>>> {
    /// Powers that a proof of convergence may take.
    const LONGEST: u32 = 12;
    let Some(mask) = scheme.mask() else { return Ok(None) };
    if contractivity(context, mask, 0, LONGEST)?.is_none() {
        return Ok(None);
    }
    match polygon.limit(context, mask, 0) {
        Err(e) if e.kind() == ErrorKind::Unsupported => Ok(None),
        limit => limit.map(Some),
    }
}
