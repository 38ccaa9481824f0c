//! What the operators compute.

use carvel::base::Scalar;
use carvel::{Context, Records, RecordsMut, StencilTable};
use proptest::prelude::*;

use crate::tables::{Rows, apply, bits, dense, rough, rows, rows_on, values};

fn serial() -> Context {
    Context::serial()
}

/// Records at a stride, with a mark between them.
fn spread<V: Scalar>(packed: &[V], width: usize, stride: usize) -> Vec<V> {
    let mark = V::from_f64(777.0);
    let record = |record: &[V]| {
        let gap = std::iter::repeat_n(mark, stride - width);
        record.iter().copied().chain(gap).collect::<Vec<_>>()
    };
    packed.chunks(width).flat_map(record).collect()
}

fn applied<T: Scalar, V: Scalar>(rows: &Rows, width: usize, strides: [usize; 2], add: bool) {
    let table = rows.table::<T>();
    let packed = values::<V>(table.columns() * width, 1);
    let doubles: Vec<f64> = packed.iter().map(|x| x.to_f64()).collect();
    let before = values::<V>(table.rows() * width, 2);
    let mut expected = rows.times(&doubles, width);
    if add {
        expected.iter_mut().zip(&before).for_each(|(sum, x)| *sum += x.to_f64());
    }
    let expected: Vec<V> = expected.into_iter().map(V::from_f64).collect();
    let input = spread(&packed, width, strides[0]);
    let mut out = spread(&before, width, strides[1]);
    let records = Records { values: &input, width, stride: strides[0] };
    let into = RecordsMut { values: &mut out, width, stride: strides[1] };
    let done = if add {
        table.apply_add(&serial(), records, into)
    } else {
        table.apply(&serial(), records, into)
    };
    done.expect("it is applied");
    assert_eq!(out, spread(&expected, width, strides[1]));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(128) })]

    #[test]
    fn any_width_and_stride_in_either_number_type(
        rows in rows(),
        width in 1..11_usize,
        gaps in [0..4_usize, 0..4],
        add in any::<bool>(),
    ) {
        let strides = gaps.map(|gap| width + gap);
        applied::<f64, f64>(&rows, width, strides, add);
        applied::<f32, f32>(&rows, width, strides, add);
        applied::<f32, f64>(&rows, width, strides, add);
        applied::<f64, f32>(&rows, width, strides, add);
    }

    #[test]
    fn the_transpose_is_the_transpose(rows in rows(), width in 1..6_usize) {
        let table = rows.table::<f64>();
        let turned = table.transpose(&serial()).expect("small");
        let (a, b) = (dense(&table), dense(&turned));
        for (i, row) in a.iter().enumerate() {
            for (j, weight) in row.iter().enumerate() {
                prop_assert_eq!(*weight, b[j][i]);
            }
        }
        prop_assert!((0..turned.rows()).all(|row| turned.row(row).0.is_sorted()));

        // ⟨Ax, y⟩ = ⟨x, Aᵀy⟩, exactly.
        let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
        let (x, y) = (values(table.columns() * width, 3), values(table.rows() * width, 4));
        let mut back = vec![f64::NAN; x.len()];
        let into = RecordsMut::packed(&mut back, width);
        table.apply_transpose(&serial(), Records::packed(&y, width), into).expect("small");
        prop_assert_eq!(dot(&apply(&serial(), &table, &x, width), &y), dot(&x, &back));
        prop_assert_eq!(apply(&serial(), &turned, &y, width), back);
    }

    #[test]
    fn composition_is_one_after_the_other_and_associative(
        (a, b, c) in (1..12_usize, rows()).prop_flat_map(|(n, mut a)| {
            a.rows.resize(n, Vec::new());
            (Just(a), rows_on(n))
        }).prop_flat_map(|(a, mut b)| {
            b.rows.push(vec![(0, 5)]);
            let n = b.rows.len();
            (Just(a), Just(b), rows_on(n))
        }),
    ) {
        let [a, b, c] = [a, b, c].map(|rows| rows.table::<f64>());
        let then = |a: &StencilTable<f64>, b| a.compose(&serial(), b).expect("they fit");
        let (ab, bc) = (then(&a, &b), then(&b, &c));
        let x = values::<f64>(a.columns() * 3, 5);
        prop_assert_eq!(
            apply(&serial(), &ab, &x, 3),
            apply(&serial(), &b, &apply(&serial(), &a, &x, 3), 3)
        );
        prop_assert_eq!(dense(&then(&ab, &c)), dense(&then(&a, &bc)));
        prop_assert!(ab.weights().iter().all(|&w| w != 0.0));
        for row in 0..ab.rows() {
            let mut once = ab.row(row).0.to_vec();
            once.sort_unstable();
            prop_assert!(once.is_sorted_by(|a, b| a < b), "row {} repeats a column", row);
        }
    }

    #[test]
    fn selected_rows_are_those_asked_for(rows in rows(), picks in prop::collection::vec(any::<u32>(), 0..20)) {
        let table = rows.table::<f32>();
        let picks: Vec<u32> = match table.rows() as u32 {
            0 => Vec::new(),
            n => picks.iter().map(|pick| pick % n).collect(),
        };
        let some = table.select(&serial(), &picks).expect("rows that exist");
        prop_assert_eq!(some.rows(), picks.len());
        for (row, &pick) in picks.iter().enumerate() {
            prop_assert_eq!(some.row(row), table.row(pick as usize));
        }
    }

    #[test]
    fn an_update_gives_the_bits_of_a_full_application(
        rows in rows(),
        width in 1..6_usize,
        changed in prop::collection::vec(any::<u32>(), 0..4),
    ) {
        let table = rows.table::<f32>();
        let changed: Vec<u32> = changed.iter().map(|i| i % table.columns() as u32).collect();
        let mut x = rough::<f32>(table.columns() * width, 6);
        let mut out = apply(&serial(), &table, &x, width);
        let fresh = rough::<f32>(x.len(), 7);
        for &i in &changed {
            let record = i as usize * width..(i as usize + 1) * width;
            x[record.clone()].copy_from_slice(&fresh[record]);
        }
        let dependents = table.dependents(&serial()).expect("small");
        let touched = dependents.of(&changed).expect("columns that exist");
        for row in 0..table.rows() as u32 {
            let depends = rows.rows[row as usize].iter().any(|(i, _)| changed.contains(i));
            prop_assert_eq!(touched.contains(&row), depends, "row {}", row);
            if !touched.contains(&row) {
                // Nobody must write here, so what stands here must stay.
                out[row as usize * width..][..width].fill(777.0);
            }
        }
        let into = RecordsMut::packed(&mut out, width);
        table.update(&serial(), &dependents, &changed, Records::packed(&x, width), into).expect("small");
        let mut expected = apply(&serial(), &table, &x, width);
        for row in (0..table.rows() as u32).filter(|row| !touched.contains(row)) {
            expected[row as usize * width..][..width].fill(777.0);
        }
        prop_assert_eq!(bits(&out), bits(&expected));
    }
}
