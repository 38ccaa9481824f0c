//! Rows that are copied from face to face: the same as refinement everywhere, beside
//! boundaries, creases, extraordinary vertices and faces that are no quads too, and the same
//! entries as one step's table after the other.

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

/// A torus of quads, of which `seed` makes some pairs hexagons, some two and some four
/// triangles: valences from 3 to 9. Without `quads` there are triangles only.
fn mixed(n: u32, m: u32, seed: u32, quads: bool) -> Mesh {
    let at = |i: u32, j: u32| i % n * m + j % m;
    let kind = |face: u32| (face + seed).wrapping_mul(2_654_435_761) >> 13 & 7;
    let (mut sizes, mut faces, mut vertices) = (Vec::new(), Vec::new(), n * m);
    let mut add = |face: &[u32]| {
        sizes.push(face.len() as u32);
        faces.extend(face);
    };
    for i in 0..n {
        let mut j = 0;
        while j < m {
            let face = i * m + j;
            let mut quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let hexagon = quads && kind(face) == 0 && j + 1 < m;
            quad.rotate_left((face * 7 % 4) as usize * usize::from(!hexagon));
            let [a, b, c, d] = quad;
            match kind(face) {
                0 if hexagon => {
                    j += 1;
                    add(&[a, b, c, at(i + 1, j + 1), at(i, j + 1), d]);
                }
                1 | 2 => {
                    for (a, b) in [(a, b), (b, c), (c, d), (d, a)] {
                        add(&[a, b, vertices]);
                    }
                    vertices += 1;
                }
                3 | 4 if quads => add(&quad),
                5.. if quads && n > 4 => add(&quad),
                _ => {
                    add(&[a, b, c]);
                    add(&[a, c, d]);
                }
            }
            j += 1;
        }
    }
    let options = BuildOptions::default();
    let built = build(&Context::serial(), vertices as usize, &sizes, &faces, &options);
    built.expect("a torus").mesh
}

/// A cube, a tetrahedron and a tube that is three faces around: rings that meet themselves.
fn small() -> [Mesh; 3] {
    let cube = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3];
    let tetrahedron = [0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2];
    let tube = (0..15).flat_map(|face| {
        let (i, j) = (face / 3, face % 3);
        let at = |i: u32, j: u32| i % 5 * 3 + j % 3;
        [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    });
    let mesh = |n, sizes: &[u32], faces: &[u32]| Mesh::from_polygons(n, sizes, faces);
    [
        mesh(8, &[4; 6], &cube).expect("a cube"),
        mesh(4, &[3; 4], &tetrahedron).expect("a tetrahedron"),
        mesh(15, &[4; 15], &tube.collect::<Vec<_>>()).expect("a tube"),
    ]
}

/// An octahedron with one face, the first, cut into three: all corners of those are split into
/// triangles whose middle meets a vertex twice.
fn dented() -> Mesh {
    let faces = [
        [6, 0, 2],
        [6, 2, 4],
        [6, 4, 0],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    Mesh::from_polygons(7, &[3; 10], faces.as_flattened()).expect("a closed mesh")
}

const LEVELS: u32 = 4;

#[test]
fn rows_of_faces_alike_are_those_of_refinement() {
    let context = Context::serial();
    let quads = (0..3).map(|seed| mixed(7, 5, seed, true)).chain(small());
    let [_, tetrahedron, _] = small();
    let triangles = (0..2).map(|seed| mixed(5, 6, seed, false)).chain([dented(), tetrahedron]);
    let of = |scheme: Scheme| move |mesh| (mesh, scheme.clone());
    let [plain, tuned, linear] = schemes();
    let cases = quads.map(of(plain)).chain(triangles.map(of(Scheme::loop_triangles())));
    let others = [(mixed(7, 5, 9, true), tuned), (mixed(7, 5, 8, true), linear)];
    for (mesh, scheme) in cases.chain(others) {
        let hierarchy = Hierarchy::new(&context, mesh, scheme, 3).expect("small");
        let mut control = rough::<f64>(3 * hierarchy.mesh(0).vertices(), 1);
        for from in 0..=1 {
            for to in from..=3 {
                let task = StencilTask { from, ..StencilTask::level(to) };
                check(&hierarchy, &task, &control);
                check_product(&hierarchy, &task);
            }
            control = step(
                &hierarchy,
                1,
                Interpolation::Vertex,
                &rough(3 * hierarchy.mesh(0).vertices(), 1),
            );
        }
    }
}

/// A single step has no pattern of patterns: their product is another way to the same table.
fn check_product(hierarchy: &Hierarchy, task: &StencilTask) {
    let context = Context::serial();
    let table: StencilTable<f64> = hierarchy.stencils(&context, task).expect("small");
    let make = |from: u32, to: u32| {
        let task = StencilTask { from, to, ..*task };
        hierarchy.stencils::<f64>(&context, &task).expect("small")
    };
    let product = (task.from..task.to).fold(make(task.from, task.from), |product, level| {
        product.compose(&context, &make(level, level + 1)).expect("tables that fit")
    });
    for row in 0..table.rows() {
        let sorted = |table: &StencilTable<f64>| {
            let (columns, weights) = table.row(row);
            let mut row: Vec<_> = columns.iter().copied().zip(weights.iter().copied()).collect();
            row.sort_unstable_by_key(|entry| entry.0);
            row
        };
        let (found, expected) = (sorted(&table), sorted(&product));
        let columns = |row: &[(u32, f64)]| row.iter().map(|entry| entry.0).collect::<Vec<_>>();
        assert_eq!(columns(&found), columns(&expected), "{task:?}: row {row}");
        for (a, b) in found.iter().zip(&expected) {
            assert!((a.1 - b.1).abs() <= 4e-15 * b.1.abs(), "{task:?}: row {row}: {a:?}, {b:?}");
        }
    }
}

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

/// Large enough that arrays are asked for by huge pages elsewhere.
#[test]
fn copied_rows_take_no_more_than_their_entries() {
    let mesh = grid(40, 40, |_| false, (&[], &[]));
    let context = Context::serial();
    let hierarchy = Hierarchy::new(&context, mesh, Scheme::catmull_clark(), 2).unwrap();
    let table: StencilTable<f64> = hierarchy.stencils(&context, &StencilTask::level(3)).unwrap();
    let bytes = 4 * (table.rows() as u64 + 1) + 12 * table.entries() as u64;
    assert!(bytes > 4 << 20, "{bytes}");
    assert_eq!(table.bytes(), bytes);
}
