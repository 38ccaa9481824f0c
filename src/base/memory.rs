//! Allocation that answers instead of aborting, for every array that grows with
//! the mesh.

use super::pages::{prefer_huge, roomy};
use super::{Error, ErrorKind, Result};
use bytemuck::Zeroable;
use bytemuck::allocation::try_zeroed_vec;

/// An array of zeros. Large ones are untouched pages straight from the system.
pub(crate) fn zeroed<T: Zeroable>(len: usize) -> Result<Vec<T>> {
    let room = roomy::<T>(len);
    let mut list = try_zeroed_vec(room)
        // More than was asked for must not fail where that would not.
        .or_else(|()| if room > len { try_zeroed_vec(len) } else { Err(()) })
        .map_err(|()| refused::<T>(len))?;
    prefer_huge(&mut list);
    list.truncate(len);
    Ok(list)
}

/// The same, as long as asked for and no longer: for what is kept by the caller.
pub(crate) fn zeroed_exact<T: Zeroable>(len: usize) -> Result<Vec<T>> {
    let mut list = try_zeroed_vec(len).map_err(|()| refused::<T>(len))?;
    prefer_huge(&mut list);
    Ok(list)
}

/// An array of one value.
pub(crate) fn filled<T: Copy>(value: T, len: usize) -> Result<Vec<T>> {
    let mut list = reserved(len)?;
    list.resize(len, value);
    Ok(list)
}

/// An empty array with room for `len` values.
pub(crate) fn reserved<T>(len: usize) -> Result<Vec<T>> {
    let mut list = Vec::new();
    let room = roomy::<T>(len);
    let taken = list.try_reserve_exact(room);
    taken
        .or_else(|error| if room > len { list.try_reserve_exact(len) } else { Err(error) })
        .map_err(|_| refused::<T>(len))?;
    prefer_huge(&mut list);
    Ok(list)
}

/// What an iterator gives.
pub(crate) fn collect<T>(items: impl IntoIterator<Item = T>) -> Result<Vec<T>> {
    let mut list = Vec::new();
    extend(&mut list, items)?;
    Ok(list)
}

/// Adds what an iterator gives.
pub(crate) fn extend<T>(list: &mut Vec<T>, items: impl IntoIterator<Item = T>) -> Result<()> {
    let items = items.into_iter();
    let least = items.size_hint().0;
    list.try_reserve(least).map_err(|_| refused::<T>(least))?;
    for item in items {
        if list.len() == list.capacity() {
            list.try_reserve(1).map_err(|_| refused::<T>(list.len()))?;
        }
        list.push(item);
    }
    Ok(())
}

/// Makes room for more values; a list that grows again and again grows by large steps.
pub(crate) fn grow<T>(list: &mut Vec<T>, additional: usize) -> Result<()> {
    if list.capacity() - list.len() >= additional {
        return Ok(());
    }
    list.try_reserve(additional)
        .map_err(|_| refused::<T>(list.len().saturating_add(additional)))?;
    prefer_huge(list);
    Ok(())
}

/// A copy of a slice.
pub(crate) fn copied<T: Copy>(slice: &[T]) -> Result<Vec<T>> {
    let mut list = reserved(slice.len())?;
    list.extend_from_slice(slice);
    Ok(list)
}

/// An array without much room to spare: a copy, if there was much and memory for one. To give
/// memory back may need some, and `shrink_to_fit` aborts where there is none.
pub(crate) fn fitted<T: Copy>(list: Vec<T>) -> Vec<T> {
    let spare = list.capacity() - list.len();
    if spare > list.len() / 4 { copied(&list).unwrap_or(list) } else { list }
}

/// Makes an array exactly `len` long, keeping its memory if it is large enough.
pub(crate) fn resize<T: Copy + Zeroable>(list: &mut Vec<T>, len: usize) -> Result<()> {
    if list.capacity() < len {
        *list = Vec::new();
        *list = zeroed(len)?;
    }
    list.resize(len, T::zeroed());
    Ok(())
}

fn refused<T>(len: usize) -> Error {
    let bytes = len.saturating_mul(size_of::<T>());
    Error::new(ErrorKind::OutOfResources, format!("{bytes} bytes could not be had"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_had_is_refused() {
        let kind = |result: Result<Vec<u32>>| result.unwrap_err().kind();
        assert_eq!(kind(zeroed(usize::MAX / 2)), ErrorKind::OutOfResources);
        assert_eq!(kind(filled(1, usize::MAX / 2)), ErrorKind::OutOfResources);
        assert_eq!(kind(reserved(usize::MAX / 2)), ErrorKind::OutOfResources);
    }

    #[test]
    fn collects_whatever_the_hint_says() {
        assert_eq!(collect((0..100).filter(|i| i % 3 == 0)).unwrap().len(), 34);
        let mut list = vec![7];
        extend(&mut list, 0..3).unwrap();
        assert_eq!(list, [7, 0, 1, 2]);
        resize(&mut list, 2).unwrap();
        assert_eq!(list, [7, 0]);
    }
}
