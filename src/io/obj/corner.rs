//! Face corners: `v`, `v/vt`, `v//vn`, `v/vt/vn`, counted from 1 or backwards.

use crate::base::NONE;
use crate::io::number::integer;

/// A corner as written; 0 never means "absent".
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Corner {
    pub vertex: i64,
    pub uv: Option<i64>,
    pub normal: Option<i64>,
}

/// Parses a corner; `None` if the word is none.
#[inline]
pub(super) fn parse(word: &[u8]) -> Option<Corner> {
    let mut parts = word.split(|&b| b == b'/');
    let vertex = integer(parts.next()?)?;
    let mut optional = || match parts.next() {
        None | Some([]) => Some(None),
        Some(digits) => integer(digits).map(Some),
    };
    let corner = Corner { vertex, uv: optional()?, normal: optional()? };
    parts.next().is_none().then_some(corner)
}

/// Turns a written index into one from 0, given the elements so far; `None` if
/// no file could have that element. Elements to come may be named.
#[inline]
#[expect(clippy::cast_possible_wrap, reason = "counts are below 2^32")]
pub(super) fn resolve(written: i64, count: usize) -> Option<u32> {
    let index = if written < 0 { written + count as i64 } else { written - 1 };
    u32::try_from(index).ok().filter(|&index| index != NONE)
}

/// One index per corner, stored only from the first corner that has one.
#[derive(Debug, Default)]
pub(super) struct OptionalIndices {
    values: Vec<u32>,
    used: bool,
}

impl OptionalIndices {
    /// Adds the index of corner number `corner`.
    #[inline]
    pub fn push(&mut self, corner: usize, index: Option<u32>) {
        if index.is_some() && !self.used {
            self.used = true;
            self.values = vec![NONE; corner];
        }
        if self.used {
            self.values.push(index.unwrap_or(NONE));
        }
    }

    /// The first corner whose index is not below `count`.
    pub fn first_beyond(&self, count: usize) -> Option<usize> {
        self.values.iter().position(|&index| index != NONE && index as usize >= count)
    }

    /// The index of a corner.
    pub fn get(&self, corner: usize) -> u32 {
        self.values[corner]
    }

    /// The indices, if any corner has one.
    pub fn finish(self) -> Option<Vec<u32>> {
        self.used.then_some(self.values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_spellings_of_a_corner() {
        let corner = |vertex, uv, normal| Some(Corner { vertex, uv, normal });
        assert_eq!(parse(b"3"), corner(3, None, None));
        assert_eq!(parse(b"3/4"), corner(3, Some(4), None));
        assert_eq!(parse(b"3//-5"), corner(3, None, Some(-5)));
        assert_eq!(parse(b"-1/4/5"), corner(-1, Some(4), Some(5)));
        assert_eq!(parse(b"3/"), corner(3, None, None));
        assert_eq!(parse(b"3//"), corner(3, None, None));
        for bad in ["", "/", "/1", "1/2/3/4", "1.5", "a", "1/b", "1//c"] {
            assert_eq!(parse(bad.as_bytes()), None, "{bad}");
        }
    }

    #[test]
    fn indices_count_from_one_or_backwards() {
        assert_eq!(resolve(1, 0), Some(0));
        assert_eq!(resolve(-1, 4), Some(3));
        assert_eq!(resolve(-5, 4), None);
        assert_eq!(resolve(0, 4), None);
        assert_eq!(resolve(i64::MAX, 4), None);
        assert_eq!(resolve(-i64::MAX, 4), None);
        assert_eq!(resolve(i64::from(NONE) + 1, 4), None);
    }
}
