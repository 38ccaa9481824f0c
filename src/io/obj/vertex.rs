//! The numbers of `v`, `vt` and `vn`, and colours that some vertices lack.

use crate::base::Result;
use crate::io::lines::Words;
use crate::io::number::float;
use crate::io::place::Place;
use crate::io::{ColorType, VertexColors};

/// Reads up to `N` numbers, to the end of the line or a comment.
#[inline]
pub(super) fn numbers<const N: usize>(
    place: Place<'_>,
    words: Words<'_>,
) -> Result<([f64; N], usize)> {
    let (mut out, mut n) = ([0.0; N], 0);
    for word in words.take_while(|word| word[0] != b'#') {
        let value = float(place, word)?;
        let Some(slot) = out.get_mut(n) else {
            return Err(place.syntax(format!("more than {N} numbers")));
        };
        *slot = value;
        n += 1;
    }
    Ok((out, n))
}

/// Collects colours; vertices without one become opaque white and are counted.
#[derive(Debug, Default)]
pub(super) struct ColorBuilder {
    width: usize,
    values: Vec<f64>,
    /// Vertices that got a colour or an opacity they did not have.
    pub completed: u64,
}

impl ColorBuilder {
    /// Adds the colour of vertex number `vertex`: 0, 3 or 4 components.
    #[inline]
    pub fn push(&mut self, vertex: usize, color: &[f64]) {
        if color.is_empty() && self.width == 0 {
            return;
        }
        self.widen(vertex, color.len());
        let missing = self.width - color.len();
        self.values.extend_from_slice(color);
        self.values.extend(std::iter::repeat_n(1.0, missing));
        self.completed += u64::from(missing > 0);
    }

    /// Makes room for `width` components in the `vertices` colours so far.
    fn widen(&mut self, vertices: usize, width: usize) {
        if self.width >= width {
            return;
        }
        let old = std::mem::take(&mut self.values);
        self.values = vec![1.0; vertices * width];
        if self.width > 0 {
            let records = self.values.chunks_exact_mut(width).zip(old.chunks_exact(self.width));
            records.for_each(|(new, old)| new[..old.len()].copy_from_slice(old));
        }
        self.completed = vertices as u64;
        self.width = width;
    }

    /// The colours, if any vertex had one.
    pub fn finish(self) -> Option<VertexColors> {
        let Self { width, values, .. } = self;
        (width > 0).then_some(VertexColors { width, values, kind: ColorType::Float })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_completed_with_white() {
        let mut builder = ColorBuilder::default();
        builder.push(0, &[]);
        builder.push(1, &[0.1, 0.2, 0.3]);
        builder.push(2, &[0.4, 0.5, 0.6, 0.7]);
        builder.push(3, &[]);
        assert_eq!(builder.completed, 3);
        let colors = builder.finish().unwrap();
        assert_eq!(colors.width, 4);
        assert_eq!(colors.values[..8], [1.0, 1.0, 1.0, 1.0, 0.1, 0.2, 0.3, 1.0]);
        assert_eq!(colors.values[8..], [0.4, 0.5, 0.6, 0.7, 1.0, 1.0, 1.0, 1.0]);
    }
}
