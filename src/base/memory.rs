//! Allocation that answers instead of aborting.

use super::{Error, ErrorKind, Result};

/// An array of zeros. Large ones are untouched pages straight from the system.
pub(crate) fn zeroed<T: Copy>(zero: T, len: usize) -> Result<Vec<T>> {
    try_out::<T>(len)?;
    Ok(vec![zero; len])
}

/// Fails if `len` values of a type could not be had now.
///
/// There is no fallible way to ask for zeroed pages, and filling reserved memory
/// by hand would touch every page twice. So the request is tried out first.
pub(crate) fn try_out<T>(len: usize) -> Result<()> {
    Vec::<T>::new().try_reserve_exact(len).map_err(|e| {
        let bytes = len.saturating_mul(size_of::<T>());
        Error::new(ErrorKind::OutOfResources, format!("{bytes} bytes could not be had: {e}"))
    })
}

/// Makes an array exactly `len` long, keeping its memory if it is large enough.
pub(crate) fn resize<T: Copy>(list: &mut Vec<T>, zero: T, len: usize) -> Result<()> {
    if list.capacity() < len {
        *list = Vec::new();
        *list = zeroed(zero, len)?;
    }
    list.resize(len, zero);
    Ok(())
}
