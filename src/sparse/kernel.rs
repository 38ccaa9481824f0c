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

/// The sum of a row.
///
/// Four entries at a time: written out for every length, as for the sixteen entries of a
/// regular Catmull-Clark row, the compiler checks all indices first, runs out of registers
/// and needs a third more time.
#[inline(always)]
pub(super) fn row_sum<T: Scalar, V: Scalar, S: Sum<V, N>, const N: usize>(
    indices: &[u32],
    weights: &[T],
    zero: [V; N],
    values: &[S],
) -> [V; N] {
    let mut sum = S::load(zero);
    let (indices, last) = indices.as_chunks::<4>();
    let (weights, last_weights) = weights.as_chunks::<4>();
    for (i, w) in indices.iter().zip(weights) {
        for k in 0..4 {
            sum = sum.plus(values[i[k] as usize], V::from_f64(w[k].to_f64()));
        }
    }
    for (&i, w) in last.iter().zip(last_weights) {
        sum = sum.plus(values[i as usize], V::from_f64(w.to_f64()));
    }
    sum.lanes()
}
