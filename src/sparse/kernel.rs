//! The inner loop: rows of a table on up to four lanes of every record.

use crate::base::Scalar;

/// Up to four lanes of a record, in the form that sums are made in.
pub(super) trait Sum<V, const N: usize>: Copy + Send + Sync {
    fn load(lanes: [V; N]) -> Self;
    fn plus(self, value: Self, weight: V) -> Self;
    fn lanes(self) -> [V; N];
}

/// One or two lanes stay what they are.
#[derive(Clone, Copy)]
pub(super) struct Few<V, const N: usize>([V; N]);

impl<V: Scalar, const N: usize> Sum<V, N> for Few<V, N> {
    #[inline(always)]
    fn load(lanes: [V; N]) -> Self {
        Self(lanes)
    }

    #[inline(always)]
    fn plus(self, value: Self, weight: V) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + value.0[i] * weight))
    }

    #[inline(always)]
    fn lanes(self) -> [V; N] {
        self.0
    }
}

/// Three or four lanes fill a vector register.
#[derive(Clone, Copy)]
pub(super) struct Four<V: Scalar>(V::Lanes);

impl<V: Scalar, const N: usize> Sum<V, N> for Four<V> {
    #[inline(always)]
    fn load(lanes: [V; N]) -> Self {
        let mut four = [V::default(); 4];
        four[..N].copy_from_slice(&lanes);
        Self(V::lanes(four))
    }

    #[inline(always)]
    fn plus(self, value: Self, weight: V) -> Self {
        Self(self.0 + value.0 * weight)
    }

    #[inline(always)]
    fn lanes(self) -> [V; N] {
        let four = V::unlaned(self.0);
        std::array::from_fn(|i| four[i])
    }
}

/// Rows of one length: their entries, one after the other, and the values they speak of.
pub(super) struct Run<'r, T, S> {
    pub(super) len: usize,
    pub(super) indices: &'r [u32],
    pub(super) weights: &'r [T],
    pub(super) values: &'r [S],
}

/// The lengths that are worth a loop of their own, and the loop for all others.
macro_rules! by_length {
    ($run:expr, $zero:expr, $slots:expr, $write:expr, $($len:literal)*) => {
        match $run.len {
            $($len => $run.fixed::<V, N, $len, O>($zero, $slots, $write),)*
            _ => $run.any($zero, $slots, $write),
        }
    };
}

impl<T: Scalar, S> Run<'_, T, S> {
    /// Sums every row and hands it over with the next slot.
    #[inline(always)]
    pub(super) fn each<V: Scalar, const N: usize, O>(
        &self,
        slots: &mut impl Iterator<Item = O>,
        write: &impl Fn(O, [V; N]),
    ) where
        S: Sum<V, N>,
    {
        let zero = S::load([V::default(); N]);
        by_length!(self, zero, slots, write, 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
    }

    #[inline(always)]
    fn fixed<V: Scalar, const N: usize, const L: usize, O>(
        &self,
        zero: S,
        slots: &mut impl Iterator<Item = O>,
        write: &impl Fn(O, [V; N]),
    ) where
        S: Sum<V, N>,
    {
        let (indices, weights) = (self.indices.as_chunks::<L>().0, self.weights.as_chunks::<L>().0);
        for (indices, weights) in indices.iter().zip(weights) {
            let mut sum = zero;
            for (&i, w) in indices.iter().zip(weights) {
                sum = sum.plus(self.values[i as usize], V::from_f64(w.to_f64()));
            }
            let Some(slot) = slots.next() else { return };
            write(slot, sum.lanes());
        }
    }

    fn any<V: Scalar, const N: usize, O>(
        &self,
        zero: S,
        slots: &mut impl Iterator<Item = O>,
        write: &impl Fn(O, [V; N]),
    ) where
        S: Sum<V, N>,
    {
        if self.len == 0 {
            return slots.for_each(|slot| write(slot, zero.lanes()));
        }
        let indices = self.indices.chunks_exact(self.len);
        for (indices, weights) in indices.zip(self.weights.chunks_exact(self.len)) {
            let mut sum = zero;
            for (&i, w) in indices.iter().zip(weights) {
                sum = sum.plus(self.values[i as usize], V::from_f64(w.to_f64()));
            }
            let Some(slot) = slots.next() else { return };
            write(slot, sum.lanes());
        }
    }
}
