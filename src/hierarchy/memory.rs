//! Allocation that answers instead of aborting.

use crate::base::{Error, ErrorKind, Result};

/// An array of zeros. Large ones are untouched pages straight from the system.
pub(super) fn zeroed<T: Copy>(zero: T, len: usize) -> Result<Vec<T>> {
    // There is no fallible way to ask for zeroed pages, and filling reserved
    // memory by hand would touch every page twice. So the request is tried out.
    Vec::<T>::new().try_reserve_exact(len).map_err(|e| {
        let bytes = len.saturating_mul(size_of::<T>());
        Error::new(ErrorKind::OutOfResources, format!("{bytes} bytes could not be had: {e}"))
    })?;
    Ok(vec![zero; len])
}

/// Makes an array exactly `len` long, keeping its memory if it is large enough.
pub(super) fn resize<T: Copy>(list: &mut Vec<T>, zero: T, len: usize) -> Result<()> {
    if list.capacity() < len {
        *list = Vec::new();
        *list = zeroed(zero, len)?;
    }
    list.resize(len, zero);
    Ok(())
}
