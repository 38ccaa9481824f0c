//! What is no table, no list and no array of records.

use carvel::{Context, ErrorKind, Records, RecordsMut, StencilTable};

type Kind = Result<(), ErrorKind>;

fn table() -> StencilTable<f64> {
    StencilTable::new(3, &[0, 2, 3], vec![0, 1, 2], vec![0.5, 0.5, 1.0]).expect("a table")
}

#[test]
fn arrays_that_are_no_table() {
    let kind = |columns, offsets: &[u64], indices: &[u32], weights: &[f32]| -> Kind {
        let made = StencilTable::new(columns, offsets, indices.to_vec(), weights.to_vec());
        made.map(drop).map_err(|e| e.kind())
    };
    assert_eq!(kind(0, &[0], &[], &[]), Ok(()));
    assert_eq!(kind(1, &[0, 2], &[0, 0], &[0.5, 0.5]), Ok(()));
    let lengths: [(&[u64], &[u32], &[f32]); 7] = [
        (&[], &[], &[]),
        (&[0, 1], &[0], &[]),
        (&[0, 1], &[], &[1.0]),
        (&[1, 1], &[0], &[1.0]),
        (&[0, 2], &[0], &[1.0]),
        (&[0, 2, 1, 2], &[0, 0], &[1.0, 1.0]),
        (&[0, 1 << 40, 1], &[0], &[1.0]),
    ];
    for (offsets, indices, weights) in lengths {
        assert_eq!(
            kind(1, offsets, indices, weights),
            Err(ErrorKind::LengthMismatch),
            "{offsets:?}"
        );
    }
    assert_eq!(kind(1, &[0, 1], &[1], &[1.0]), Err(ErrorKind::IndexOutOfRange));
    assert_eq!(kind(0, &[0, 1], &[0], &[1.0]), Err(ErrorKind::IndexOutOfRange));
    for weight in [f32::NAN, f32::INFINITY] {
        assert_eq!(kind(1, &[0, 1], &[0], &[weight]), Err(ErrorKind::NotFinite));
    }
    assert_eq!(kind(u32::MAX as usize, &[0], &[], &[]), Err(ErrorKind::TooLarge));
    assert_eq!(kind(usize::MAX, &[0], &[], &[]), Err(ErrorKind::TooLarge));
}

/// The kinds that every operation on values answers for some records.
fn kinds(input: (usize, usize, usize), output: (usize, usize, usize)) -> [Kind; 3] {
    let (table, context) = (table(), Context::serial());
    let (values, mut out) = (vec![1.0; input.0], vec![1.0; output.0]);
    let dependents = table.dependents(&context).expect("small");
    let mut call = |which| {
        let records = Records { values: &values[..], width: input.1, stride: input.2 };
        let into = RecordsMut { values: &mut out[..], width: output.1, stride: output.2 };
        match which {
            0 => table.apply(&context, records, into),
            1 => table.apply_add(&context, records, into),
            _ => table.update(&context, &dependents, &[1], records, into),
        }
        .map_err(|e| e.kind())
    };
    [0, 1, 2].map(&mut call)
}

#[test]
fn records_that_do_not_fit() {
    assert_eq!(kinds((9, 3, 3), (6, 3, 3)), [Ok(()); 3]);
    // Behind the last record a gap may be there or not.
    assert_eq!(kinds((14, 4, 5), (9, 4, 5)), [Ok(()); 3]);
    assert_eq!(kinds((15, 4, 5), (10, 4, 5)), [Ok(()); 3]);
    let length = [Err(ErrorKind::LengthMismatch); 3];
    for (input, output) in [
        ((8, 3, 3), (6, 3, 3)),
        ((10, 3, 3), (6, 3, 3)),
        ((9, 3, 3), (5, 3, 3)),
        ((9, 3, 3), (7, 3, 3)),
        ((0, 3, 3), (6, 3, 3)),
        ((13, 4, 5), (9, 4, 5)),
        ((9, 3, usize::MAX), (6, 3, 3)),
    ] {
        assert_eq!(kinds(input, output), length, "{input:?} {output:?}");
    }
    let range = [Err(ErrorKind::ParameterOutOfRange); 3];
    for (input, output) in [
        ((0, 0, 0), (0, 0, 0)),
        ((9, 3, 2), (6, 3, 3)),
        ((9, 3, 3), (6, 3, 0)),
        ((9, 3, 3), (4, 2, 2)),
        ((9, 1 << 17, 1 << 17), (6, 1 << 17, 1 << 17)),
    ] {
        assert_eq!(kinds(input, output), range, "{input:?} {output:?}");
    }
}

#[test]
fn lists_and_tables_that_do_not_fit() {
    let (table, context) = (table(), Context::serial());
    let kind = |error: carvel::Error| error.kind();
    let select = |rows: &[u32]| table.select(&context, rows).map(drop).map_err(kind);
    assert_eq!(select(&[]), Ok(()));
    assert_eq!(select(&[0, 2]), Err(ErrorKind::IndexOutOfRange));
    let dependents = table.dependents(&context).expect("small");
    assert_eq!(dependents.of(&[3]).map_err(kind), Err(ErrorKind::IndexOutOfRange));
    assert_eq!(dependents.of(&[u32::MAX]).map_err(kind), Err(ErrorKind::IndexOutOfRange));
    assert_eq!(
        table.compose(&context, &table).map(drop).map_err(kind),
        Err(ErrorKind::LengthMismatch)
    );

    let other = StencilTable::new(3, &[0, 2], vec![0, 1], vec![0.5, 0.5]).expect("a table");
    let (values, mut out) = ([0.0; 3], [0.0]);
    let (records, into) = (Records::packed(&values, 1), RecordsMut::packed(&mut out, 1));
    let refused = other.update(&context, &dependents, &[0], records, into);
    assert_eq!(refused.map_err(kind), Err(ErrorKind::LengthMismatch));
}

/// Products that leave the number type are an error and no weight.
#[test]
fn weights_that_overflow() {
    let huge = StencilTable::new(1, &[0, 1], vec![0], vec![1e300]).expect("a table");
    let refused = huge.compose(&Context::serial(), &huge).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::Overflow);
}
