//! Meshes with regular parts, whose rows are copied: the same as refinement everywhere,
//! beside boundaries, creases, extraordinary vertices and faces that are no quads too.

use carvel::mesh::{BuildOptions, build};
use carvel::{Context, Crease, Hierarchy, Interpolation, Mesh, Scheme, SharpVertex};
use carvel::{StencilTable, StencilTask};

use crate::tables::{apply, rough};

/// `n` by `m` quads; those that `cut` names are two triangles.
fn grid(n: u32, m: u32, cut: impl Fn(u32) -> bool, tags: (&[Crease], &[SharpVertex])) -> Mesh {
    let at = |i: u32, j: u32| i * (m + 1) + j;
    let (mut sizes, mut faces) = (Vec::new(), Vec::new());
    for face in 0..n * m {
        let (i, j) = (face / m, face % m);
        let mut quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        // Faces begin anywhere.
        quad.rotate_left((face * 7 % 4) as usize);
        if cut(face) {
            sizes.extend([3, 3]);
            faces.extend([quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]]);
        } else {
            sizes.push(4);
            faces.extend(quad);
        }
    }
    let options =
        BuildOptions { creases: tags.0, sharp_vertices: tags.1, ..BuildOptions::default() };
    let vertices = ((n + 1) * (m + 1)) as usize;
    build(&Context::serial(), vertices, &sizes, &faces, &options).expect("a grid").mesh
}

fn meshes() -> Vec<Mesh> {
    let crease = |a: u32, b: u32, sharpness| Crease { vertices: [a, b], sharpness };
    // 9 vertices stand in a row.
    let creases = [crease(40, 49, 1.5), crease(49, 58, 10.0), crease(58, 59, 0.5)];
    let sharp = [SharpVertex { vertex: 22, sharpness: 2.25 }];
    vec![
        grid(9, 8, |_| false, (&[], &[])),
        grid(9, 8, |face| face == 30, (&[], &[])),
        grid(9, 8, |_| false, (&creases, &sharp)),
        grid(12, 8, |face| face % 41 == 40, (&creases, &sharp)),
    ]
}

fn schemes() -> [Scheme; 3] {
    let smooth = carvel::TriangleRule::Smooth;
    [
        Scheme::catmull_clark(),
        Scheme::catmull_clark()
            .with_triangle_rule(smooth)
            .with_boundary(carvel::Boundary::Edge)
            .with_creasing(carvel::Creasing::Chaikin),
        Scheme::bilinear(),
    ]
}

const LEVELS: u32 = 4;

#[test]
fn copied_rows_are_those_of_refinement() {
    let context = Context::serial();
    for (mesh, scheme) in meshes().into_iter().flat_map(|m| schemes().map(|s| (m.clone(), s))) {
        let hierarchy = Hierarchy::new(&context, mesh, scheme, LEVELS).expect("small");
        for interpolation in [Interpolation::Vertex, Interpolation::Varying] {
            let mut control = rough::<f64>(3 * hierarchy.mesh(0).vertices(), 1);
            for from in 0..=1 {
                for to in from..=LEVELS {
                    let task = StencilTask { from, interpolation, ..StencilTask::level(to) };
                    check(&hierarchy, &task, &control);
                }
                control =
                    step(&hierarchy, 1, interpolation, &rough(3 * hierarchy.mesh(0).vertices(), 1));
            }
        }
    }
}

/// `values` are those of the level that the task begins at.
fn check(hierarchy: &Hierarchy, task: &StencilTask, values: &[f64]) {
    let context = Context::serial();
    let table: StencilTable<f64> = hierarchy.stencils(&context, task).expect("small");
    let found = apply(&context, &table, values, 3);
    let expected = (task.from..task.to).fold(values.to_vec(), |values, level| {
        // Step by step on the meshes themselves, by the scheme's rows one by one.
        step(hierarchy, level + 1, task.interpolation, &values)
    });
    assert_eq!(found.len(), expected.len());
    for (i, (x, y)) in found.iter().zip(&expected).enumerate() {
        assert!((x - y).abs() < 1e-13, "{task:?}: value {i}: {x}, not {y}");
    }
    for row in 0..table.rows() {
        let mut once = table.row(row).0.to_vec();
        once.sort_unstable();
        assert!(once.is_sorted_by(|a, b| a < b), "{task:?}: row {row} repeats a column");
        assert!(table.row(row).1.iter().all(|&w| w != 0.0), "{task:?}: row {row} has zeros");
    }
    let picks: Vec<u32> = (0..table.rows() as u32).rev().step_by(3).collect();
    let some = StencilTask { vertices: Some(&picks), ..*task };
    let some: StencilTable<f64> = hierarchy.stencils(&context, &some).expect("small");
    assert_eq!(some, table.select(&context, &picks).expect("rows"), "{task:?}");
}

fn step(of: &Hierarchy, level: u32, interpolation: Interpolation, values: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; 3 * of.mesh(level).vertices()];
    if interpolation == Interpolation::Vertex {
        let row = |vertex: u32, row: &[(u32, f64)]| {
            for &(v, w) in row {
                for axis in 0..3 {
                    out[3 * vertex as usize + axis] += w * values[3 * v as usize + axis];
                }
            }
        };
        of.each_row_of(level, 0, row).expect("a level that was built");
        return out;
    }
    // Varying rows see no tags, and a bilinear step is what they are.
    let mesh = of.shared_mesh(level - 1).expect("a level that was built");
    let linear = Hierarchy::new(&Context::serial(), mesh, Scheme::bilinear(), 1).expect("small");
    linear.refine(&Context::serial(), 1, values, 3, &mut out).expect("small");
    out
}
