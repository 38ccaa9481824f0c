//! Pointers with counts: everything that can be checked is, before it is used.

use super::status::{
    CARVEL_STATUS_BUFFER_TOO_SMALL, CARVEL_STATUS_MISALIGNED, CARVEL_STATUS_OVERLAP,
    CARVEL_STATUS_TOO_LARGE, Fault, Result,
};
use std::fmt;

/// An argument's name in a message, such as `attributes[3]`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Name {
    pub(super) text: &'static str,
    pub(super) index: Option<usize>,
}

impl From<&'static str> for Name {
    fn from(text: &'static str) -> Self {
        Self { text, index: None }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text)?;
        self.index.map_or(Ok(()), |i| write!(f, "[{i}]"))
    }
}

/// Checks a pointer for NULL and alignment.
pub(super) fn check_pointer<T>(pointer: *const T, name: impl Into<Name>) -> Result<()> {
    let name = name.into();
    if pointer.is_null() {
        return Err(Fault::null(name));
    }
    if !pointer.is_aligned() {
        return Err(Fault::new(
            CARVEL_STATUS_MISALIGNED,
            format!("{name} is not aligned to {} bytes", align_of::<T>()),
        ));
    }
    Ok(())
}

/// Checks that `count` elements of `size` bytes from a pointer on are within what
/// one object in memory can be; returns the bytes.
pub(super) fn check_extent(start: usize, count: u64, size: u64, name: Name) -> Result<usize> {
    let bytes = count.checked_mul(size).filter(|&bytes| isize::try_from(bytes).is_ok());
    let bytes = bytes.filter(|&bytes| start.checked_add(bytes as usize).is_some());
    bytes.map(|bytes| bytes as usize).ok_or_else(|| {
        Fault::new(
            CARVEL_STATUS_TOO_LARGE,
            format!("{name}: {count} times {size} bytes are more than memory can hold"),
        )
    })
}

/// A caller's array to read; not looked at if it has no elements.
///
/// # Safety
/// `count` elements can be read, and are not written, as long as the slice lives.
pub(super) unsafe fn input<'a, T>(
    data: *const T,
    count: u64,
    name: impl Into<Name>,
) -> Result<&'a [T]> {
    let name = name.into();
    if count == 0 {
        return Ok(&[]);
    }
    check_pointer(data, name)?;
    check_extent(data.addr(), count, size_of::<T>() as u64, name)?;
    // SAFETY: not NULL, aligned, of a possible size; the rest is the contract.
    Ok(unsafe { std::slice::from_raw_parts(data, count as usize) })
}

/// A caller's buffer, of which the first `needed` elements are to be written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Target<T> {
    data: *mut T,
    capacity: u64,
    needed: u64,
    name: Name,
}

impl<T: Copy> Target<T> {
    pub(super) fn new((data, capacity): (*mut T, u64), needed: u64, name: impl Into<Name>) -> Self {
        Self { data, capacity, needed, name: name.into() }
    }

    /// False for a buffer that need not be there: neither pointer nor capacity.
    pub(super) fn is_given(&self) -> bool {
        !self.data.is_null() || self.capacity > 0
    }

    /// Checks the buffer; returns what will be written.
    pub(super) fn span(&self) -> Result<Span> {
        check_capacity(self.capacity, self.needed, self.name)?;
        if self.needed > 0 {
            check_pointer(self.data, self.name)?;
        }
        let size = size_of::<T>() as u64;
        let record = check_extent(self.data.addr(), self.needed, size, self.name)?;
        let (start, count, name) = (self.data.addr(), usize::from(record > 0), self.name);
        Ok(Span { start, record, period: record, count, written: true, name })
    }

    /// Borrows what will be written.
    ///
    /// # Safety
    /// [`Target::span`] has been checked; it can be written, and nothing else uses
    /// it as long as the slice lives. It may hold anything: only types for which
    /// every pattern of bits is a value come here, and they are written before they
    /// are read.
    pub(super) unsafe fn slice<'a>(&self) -> &'a mut [T] {
        if self.needed == 0 {
            return &mut [];
        }
        // SAFETY: not NULL, aligned and of a possible size as `span` says; the
        // rest is the contract.
        unsafe { std::slice::from_raw_parts_mut(self.data, self.needed as usize) }
    }
}

/// The first `needed` elements of a caller's buffer of `capacity`.
///
/// # Safety
/// The buffer can be written, and nothing else uses it as long as the slice lives.
pub(super) unsafe fn output<'a, T: Copy>(
    buffer: (*mut T, u64),
    needed: u64,
    name: impl Into<Name>,
) -> Result<&'a mut [T]> {
    let target = Target::new(buffer, needed, name);
    target.span()?;
    // SAFETY: checked; the rest is the contract.
    Ok(unsafe { target.slice() })
}

pub(super) fn check_capacity(capacity: u64, needed: u64, name: Name) -> Result<()> {
    if capacity >= needed {
        return Ok(());
    }
    Err(Fault::new(
        CARVEL_STATUS_BUFFER_TOO_SMALL,
        format!("{name}: the buffer has room for {capacity}, {needed} are needed"),
    ))
}

/// A count as the library has it; what does not fit is too many of anything.
pub(super) fn size(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

/// Checks where a list is to go before it is made, as far as that is possible.
pub(super) fn check_list<T: Copy>(out: *mut T, capacity: u64, count: *mut u64) -> Result<()> {
    Target::new((out, capacity), capacity.min(1), "out").span()?;
    if count.is_null() { Ok(()) } else { check_pointer(count, "count") }
}

/// Answers a query in two calls: the count always, the list if there is room.
///
/// # Safety
/// `out` can take `capacity` elements, `count` is NULL or can be written.
pub(super) unsafe fn list<T: Copy>(
    list: &[T],
    out: *mut T,
    capacity: u64,
    count: *mut u64,
) -> Result<()> {
    check_list(out, capacity, count)?;
    // What fits is what is written; too small a buffer is told after the count.
    let fits = (list.len() as u64).min(capacity);
    let out = Target::new((out, capacity), fits, "out");
    let mut spans = vec![out.span()?];
    if !count.is_null() {
        spans.push(Target::new((count, 1), 1, "count").span()?);
    }
    check_overlap(&spans)?;
    // SAFETY: checked; the rest is the contract.
    if let Some(count) = unsafe { count.as_mut() } {
        *count = list.len() as u64;
    }
    if capacity == 0 {
        return Ok(());
    }
    check_capacity(capacity, list.len() as u64, "out".into())?;
    // SAFETY: as above.
    unsafe { out.slice() }.copy_from_slice(list);
    Ok(())
}

/// Memory that a call reads or writes: records, one every `period` bytes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    pub(super) start: usize,
    /// Bytes of a record.
    pub(super) record: usize,
    pub(super) period: usize,
    pub(super) count: usize,
    pub(super) written: bool,
    pub(super) name: Name,
}

impl Span {
    /// The memory of one of the caller's structs, or of an array of them.
    pub(super) fn of<T>(first: *const T, bytes: usize, written: bool, name: &'static str) -> Self {
        let (start, record, count) = (first.addr(), bytes, usize::from(bytes > 0));
        Self { start, record, period: record, count, written, name: name.into() }
    }

    /// All bytes from the first record to the last.
    pub(super) fn hull(self) -> Self {
        if self.count == 0 {
            return self;
        }
        let record = self.end() - self.start;
        Self { record, period: record, count: 1, ..self }
    }

    fn end(&self) -> usize {
        self.start + (self.count - 1) * self.period + self.record
    }

    /// True if the two share a byte. Records of unequal period that lie between
    /// each other count as sharing.
    fn meets(&self, other: &Self) -> bool {
        if self.count == 0 || other.count == 0 {
            return false;
        }
        if self.end() <= other.start || other.end() <= self.start {
            return false;
        }
        if self.period != other.period {
            return true;
        }
        let turn = self.period as i128;
        let ahead = (other.start as i128 - self.start as i128).rem_euclid(turn) as usize;
        ahead < self.record || ahead + other.record > self.period
    }
}

/// Refuses outputs that overlap anything else.
pub(super) fn check_overlap(spans: &[Span]) -> Result<()> {
    for (i, a) in spans.iter().enumerate() {
        let clash = |b: &&Span| (a.written || b.written) && a.meets(b);
        if let Some(b) = spans[..i].iter().find(clash) {
            return Err(Fault::new(
                CARVEL_STATUS_OVERLAP,
                format!("{} and {} overlap", b.name, a.name),
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(start: usize, record: usize, period: usize, count: usize, written: bool) -> Span {
        Span { start, record, period, count, written, name: "x".into() }
    }

    #[test]
    fn overlap_agrees_with_counting_bytes() {
        let bytes = |s: &Span| {
            let at = |i| s.start + i * s.period..s.start + i * s.period + s.record;
            (0..s.count).flat_map(at).collect::<std::collections::HashSet<_>>()
        };
        for ahead in 0..70 {
            for (record, count) in [(4, 4), (12, 3), (8, 1), (16, 4), (4, 0)] {
                let a = span(100, 4, 16, 4, true);
                let b = span(60 + ahead, record, 16, count, false);
                let shared = !bytes(&a).is_disjoint(&bytes(&b));
                // Where the ends are ragged the check may be stricter, never laxer.
                assert!(a.meets(&b) >= shared, "{b:?}");
                assert_eq!(a.meets(&b), b.meets(&a), "{b:?}");
                if count == 4 {
                    assert_eq!(a.meets(&b), shared, "{b:?}");
                }
            }
        }
    }

    #[test]
    fn reading_twice_is_no_overlap() {
        let (read, written) = (span(0, 8, 8, 4, false), span(24, 8, 8, 4, true));
        assert!(check_overlap(&[read, read]).is_ok());
        assert_eq!(check_overlap(&[read, written]).unwrap_err().status, CARVEL_STATUS_OVERLAP);
        assert_eq!(check_overlap(&[written, read]).unwrap_err().status, CARVEL_STATUS_OVERLAP);
        assert!(check_overlap(&[read, span(32, 8, 8, 4, true)]).is_ok());
    }

    #[test]
    fn extents_beyond_memory_are_refused() {
        let check = |start, count, size| check_extent(start, count, size, "x".into());
        assert_eq!(check(16, 4, 8).unwrap(), 32);
        for (start, count, size) in
            [(0, u64::MAX, 8), (0, 1 << 61, 8), (0, 1 << 62, 2), (usize::MAX - 8, 2, 8)]
        {
            assert_eq!(check(start, count, size).unwrap_err().status, CARVEL_STATUS_TOO_LARGE);
        }
    }
}
