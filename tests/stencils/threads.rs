//! Threads, limits and cancelling: nothing changes a bit, and everything is asked.

use carvel::{Context, ErrorKind, Fraction, Hierarchy, Mesh, Records, RecordsMut};
use carvel::{Scheme, StencilTable, StencilTask};

use crate::tables::{apply, bits, rough};

/// A torus of quads.
fn torus(n: u32, m: u32) -> Mesh {
    let at = |i: u32, j: u32| (i % n) * m + j % m;
    let quad = |i, j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    let faces: Vec<u32> = (0..n).flat_map(|i| (0..m).flat_map(move |j| quad(i, j))).collect();
    Mesh::from_polygons((n * m) as usize, &vec![4; (n * m) as usize], &faces).expect("a torus")
}

fn schemes() -> [Scheme; 3] {
    let half = Fraction::new(1, 32).expect("a fraction");
    [Scheme::catmull_clark(), Scheme::three_point(half).expect("w"), Scheme::doo_sabin()]
}

fn hierarchy(scheme: Scheme) -> Hierarchy {
    Hierarchy::new(&Context::serial(), torus(7, 5), scheme, 1).expect("small")
}

/// Three threads and chunks of a few rows.
fn threads() -> Context {
    Context::builder().threads(3).chunk(7).build().expect("threads")
}

#[test]
fn threads_change_no_bit() {
    let (one, three) = (Context::serial(), threads());
    for scheme in schemes() {
        let hierarchy = hierarchy(scheme);
        let made = |context| hierarchy.stencils::<f32>(context, &StencilTask::level(2));
        let (table, other) = (made(&one).expect("small"), made(&three).expect("small"));
        assert_eq!(table, other);
        assert_eq!(table.transpose(&one).expect("small"), other.transpose(&three).expect("small"));
        let rows: Vec<u32> = (0..table.rows() as u32).rev().collect();
        assert_eq!(
            table.select(&one, &rows).expect("rows"),
            table.select(&three, &rows).expect("rows")
        );
        let step =
            |context| hierarchy.stencils::<f32>(context, &StencilTask::step(2)).expect("small");
        let first = hierarchy.stencils::<f32>(&one, &StencilTask::step(1)).expect("small");
        let (a, b) = (first.compose(&one, &step(&one)), first.compose(&three, &step(&three)));
        assert_eq!(a.expect("they fit"), b.expect("they fit"));
        values_agree(&table, [&one, &three]);
    }
}

/// A table says what its hierarchy does, under dual schemes as under primal ones.
#[test]
fn tables_refine_as_hierarchies_do() {
    let context = Context::serial();
    for scheme in schemes() {
        let hierarchy = hierarchy(scheme);
        let table = hierarchy.stencils::<f64>(&context, &StencilTask::level(1)).expect("small");
        let values = rough::<f64>(3 * table.columns(), 1);
        let mut expected = vec![0.0; 3 * table.rows()];
        hierarchy.refine(&context, 1, &values, 3, &mut expected).expect("values");
        let largest = expected.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for (a, b) in apply(&context, &table, &values, 3).iter().zip(&expected) {
            assert!((a - b).abs() <= 1e-14 * largest, "{a}, by the hierarchy {b}");
        }
    }
}

fn values_agree(table: &StencilTable<f32>, contexts: [&Context; 2]) {
    for width in [1, 2, 3, 4, 7] {
        let x = rough::<f32>(table.columns() * width, 1);
        let y = rough::<f32>(table.rows() * width, 2);
        let dependents = table.dependents(contexts[0]).expect("small");
        let all = contexts.map(|context| {
            let forth = apply(context, table, &x, width);
            let (mut back, mut some) = (x.clone(), y.clone());
            let into = RecordsMut::packed(&mut back, width);
            table.apply_transpose(context, Records::packed(&y, width), into).expect("small");
            let into = RecordsMut::packed(&mut some, width);
            let changed = [3, 0, 11, 3];
            table
                .update(context, &dependents, &changed, Records::packed(&x, width), into)
                .expect("small");
            [bits(&forth), bits(&back), bits(&some)]
        });
        assert_eq!(all[0], all[1], "width {width}");
    }
}

#[test]
fn a_cancelled_context_stops_everything() {
    let context = threads();
    let hierarchy = hierarchy(Scheme::catmull_clark());
    let table: StencilTable<f64> =
        hierarchy.stencils(&context, &StencilTask::level(2)).expect("small");
    context.cancel();
    let mut out = vec![0.0; table.rows()];
    let x = vec![0.0; table.columns()];
    let kinds = [
        hierarchy.stencils::<f64>(&context, &StencilTask::level(2)).err(),
        table.apply(&context, Records::packed(&x, 1), RecordsMut::packed(&mut out, 1)).err(),
        table.transpose(&context).err(),
        table.select(&context, &[1]).err(),
        table.dependents(&context).err(),
    ];
    for (i, error) in kinds.into_iter().enumerate() {
        assert_eq!(error.map(|e| e.kind()), Some(ErrorKind::Cancelled), "call {i}");
    }
    context.reset();
    assert!(table.transpose(&context).is_ok());
}

#[test]
fn the_memory_ceiling_holds() {
    let tight = Context::builder().memory_ceiling(100).build().expect("a context");
    let hierarchy = hierarchy(Scheme::catmull_clark());
    let table: StencilTable<f64> =
        hierarchy.stencils(&Context::serial(), &StencilTask::level(1)).expect("small");
    let kinds = [
        hierarchy.stencils::<f64>(&tight, &StencilTask::level(1)).err(),
        table.transpose(&tight).err(),
        table.dependents(&tight).err(),
    ];
    for (i, error) in kinds.into_iter().enumerate() {
        assert_eq!(error.map(|e| e.kind()), Some(ErrorKind::MemoryCeiling), "call {i}");
    }
}
