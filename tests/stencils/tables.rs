//! Random tables, and what they mean.

use carvel::base::Scalar;
use carvel::{Context, Records, RecordsMut, StencilTable};
use proptest::prelude::*;

/// Rows as lists of (column, weight in sixteenths).
#[derive(Clone, Debug)]
pub struct Rows {
    pub columns: usize,
    pub rows: Vec<Vec<(u32, i32)>>,
}

impl Rows {
    /// The table; sixteenths are exact in both number types.
    pub fn table<T: Scalar>(&self) -> StencilTable<T> {
        let mut offsets = vec![0];
        offsets.extend(self.rows.iter().scan(0, |end, row| {
            *end += row.len() as u64;
            Some(*end)
        }));
        let entries = || self.rows.iter().flatten();
        let indices = entries().map(|entry| entry.0).collect();
        let weights = entries().map(|entry| T::from_f64(f64::from(entry.1) / 16.0)).collect();
        StencilTable::new(self.columns, &offsets, indices, weights).expect("a table")
    }

    /// Every row's sum, written out.
    pub fn times(&self, values: &[f64], width: usize) -> Vec<f64> {
        let lane = |row: &Vec<(u32, i32)>, lane: usize| {
            let term = |&(i, w): &(u32, i32)| values[i as usize * width + lane] * f64::from(w);
            row.iter().map(term).sum::<f64>() / 16.0
        };
        self.rows.iter().flat_map(|row| (0..width).map(move |k| lane(row, k))).collect()
    }
}

/// A dense copy, repeated columns added up.
pub fn dense<T: Scalar>(table: &StencilTable<T>) -> Vec<Vec<f64>> {
    let row = |row| {
        let mut dense = vec![0.0; table.columns()];
        let (indices, weights) = table.row(row);
        indices.iter().zip(weights).for_each(|(&i, w)| dense[i as usize] += w.to_f64());
        dense
    };
    (0..table.rows()).map(row).collect()
}

/// Up to 40 rows, many of one length beside each other, some empty, some long.
pub fn rows_on(columns: usize) -> impl Strategy<Value = Rows> {
    let entry = (0..columns as u32, -64..64_i32);
    let row = prop_oneof![
        prop::collection::vec(entry.clone(), 0..24),
        prop::collection::vec(entry.clone(), 4),
        prop::collection::vec(entry, 9),
    ];
    prop::collection::vec(row, 0..40).prop_map(move |rows| Rows { columns, rows })
}

pub fn rows() -> impl Strategy<Value = Rows> {
    (1..20_usize).prop_flat_map(rows_on)
}

/// Whole numbers, which all sums keep exact.
pub fn values<T: Scalar>(n: usize, seed: usize) -> Vec<T> {
    (0..n).map(|i| T::from_f64(((i * 37 + seed * 11) % 101) as f64 - 50.0)).collect()
}

/// Numbers with all their digits, of which every order of summation makes others.
pub fn rough<T: Scalar>(n: usize, seed: usize) -> Vec<T> {
    values::<f64>(n, seed).iter().map(|x| T::from_f64((x * 0.7).sin() * 3.0)).collect()
}

/// A table applied to packed values.
pub fn apply<T: Scalar, V: Scalar>(
    context: &Context,
    table: &StencilTable<T>,
    values: &[V],
    width: usize,
) -> Vec<V> {
    let mut out = vec![V::from_f64(f64::NAN); table.rows() * width];
    let into = RecordsMut::packed(&mut out, width);
    table.apply(context, Records::packed(values, width), into).expect("it is applied");
    out
}

/// Values as bits.
pub fn bits<T: Scalar>(values: &[T]) -> Vec<u64> {
    values.iter().map(|x| x.to_f64().to_bits()).collect()
}
