//! Records that go when the corners that use them do.

use carvel::base::NONE;

/// Which records of an array stay, and under which numbers.
#[derive(Debug)]
pub struct Kept {
    /// The new number of every record, or [`NONE`].
    numbers: Vec<u32>,
}

impl Kept {
    /// Drops the records that corners use which go, and none that stays. Records that no
    /// corner uses stay.
    pub fn of(records: usize, corners: &[u32], stays: impl Fn(usize) -> bool) -> Self {
        // Used by none, by some that go, by some that stay.
        let mut used = vec![0_u8; records];
        for (corner, &record) in corners.iter().enumerate().filter(|(_, r)| **r != NONE) {
            let used = &mut used[record as usize];
            *used = (*used).max(1 + u8::from(stays(corner)));
        }
        let mut left = 0;
        let number = |used: &u8| {
            if *used == 1 {
                return NONE;
            }
            left += 1;
            left - 1
        };
        Self { numbers: used.iter().map(number).collect() }
    }

    /// The new number of a record, if it stays.
    pub fn number(&self, record: u32) -> Option<u32> {
        Some(self.numbers[record as usize]).filter(|&number| number != NONE)
    }

    /// Renumbers corners, all of which stay; [`NONE`] stays as it is.
    pub fn renumber(&self, corners: &mut [u32]) {
        for record in corners.iter_mut().filter(|r| **r != NONE) {
            *record = self.numbers[*record as usize];
        }
    }

    /// Drops values, `width` of which make a record.
    pub fn keep<T: Copy>(&self, values: &mut Vec<T>, width: usize) {
        let mut to = 0;
        for from in (0..self.numbers.len()).filter(|&r| self.numbers[r] != NONE) {
            values.copy_within(from * width..(from + 1) * width, to * width);
            to += 1;
        }
        values.truncate(to * width);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_go_with_their_last_corner() {
        let mut corners = vec![0, 1, 2, NONE, 2, 4];
        let kept = Kept::of(5, &corners, |corner| corner > 2);
        assert_eq!((kept.number(1), kept.number(3), kept.number(4)), (None, Some(1), Some(2)));
        let mut values = vec![0, 0, 1, 1, 2, 2, 3, 3, 4, 4];
        kept.keep(&mut values, 2);
        assert_eq!(values, [2, 2, 3, 3, 4, 4]);
        corners.drain(..3);
        kept.renumber(&mut corners);
        assert_eq!(corners, [NONE, 0, 2]);
    }
}
