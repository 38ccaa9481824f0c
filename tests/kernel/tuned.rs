//! The tuned rule of three-point(1/32) around faces that are no quads.

use carvel::hierarchy::StencilTask;
use carvel::{
    Boundary, Context, CornerRule, ErrorKind, Extraordinary, Fraction, Hierarchy, Mesh, Records,
    RecordsMut, Scheme,
};
use num_rational::BigRational;
use num_traits::{One, Signed};
use proptest::prelude::*;

use crate::support::bases;
use crate::support::cases::config;
use crate::support::exact::{Exact, Row, stages};
use crate::support::generate::{Kind, meshes};
use crate::support::kernel::{self, bits};
use crate::support::poly::Poly;
use crate::support::tolerance::ROUNDING;

pub fn tuned() -> Scheme {
    let paper = Scheme::three_point(Fraction::new(1, 32).expect("a fraction")).expect("in range");
    paper.with_extraordinary(Extraordinary::Tuned).expect("the paper's scheme")
}

fn plain() -> Scheme {
    tuned().with_extraordinary(Extraordinary::Default).expect("the default")
}

fn hierarchy(mesh: Mesh, scheme: Scheme, levels: u32) -> Hierarchy {
    Hierarchy::new(&Context::serial(), mesh, scheme, levels).expect("a small hierarchy")
}

/// The rows of a step on the parent's vertices.
fn rows(of: &Hierarchy, level: u32) -> Vec<Row<Exact>> {
    let mut stages = stages::<Exact>(of, level);
    assert_eq!(stages.len(), 1, "a step with the rule is one stage");
    stages.remove(0)
}

/// For each corner the sizes of the faces around its vertex, if that is interior of valence 4;
/// with `mirrored` a face with a boundary edge counts as one of 0 sides.
fn sizes_around(mesh: &Mesh, mirrored: bool) -> Vec<Option<[usize; 4]>> {
    let faces = kernel::faces(mesh);
    let size = |face: usize| {
        let mut corners = mesh.face_corners(face);
        let open = corners.any(|c| mesh.corner_twins()[c] == carvel::base::NONE);
        if mirrored && open { 0 } else { faces[face].len() }
    };
    let mut corners = Vec::new();
    for (face, vertices) in faces.iter().enumerate() {
        corners.extend((0..vertices.len()).map(|place| (face, place)));
    }
    let at = |(face, place): (usize, usize), by: usize| {
        let cycle: &Vec<usize> = &faces[face];
        cycle[(place + by) % cycle.len()]
    };
    let mut leaving = std::collections::HashMap::new();
    for &corner in &corners {
        leaving.insert((at(corner, 0), at(corner, 1)), corner);
    }
    let around = |&corner: &(usize, usize)| {
        let mut sizes = vec![size(corner.0)];
        let mut now = corner;
        loop {
            // Across the edge that arrives.
            let before = at(now, faces[now.0].len() - 1);
            now = *leaving.get(&(at(now, 0), before))?;
            if now == corner {
                return sizes.try_into().ok();
            }
            sizes.push(size(now.0));
        }
    };
    corners.iter().map(around).collect()
}

/// True for the children that the rule is for.
fn is_tuned(sizes: Option<[usize; 4]>) -> bool {
    let has_rule = |n: &usize| (3..=32).contains(n) && *n != 4;
    sizes.is_some_and(|sizes| {
        sizes.iter().filter(|&&n| n != 4).count() == 1 && sizes.iter().any(has_rule)
    })
}

/// Faces of all sizes that have a rule and of some that have none.
fn controls() -> Vec<Poly<f64>> {
    let prisms = [3, 5, 6, 7, 31, 32, 33].map(bases::prism);
    let others = [bases::bipyramid(11), bases::dodecahedron(), bases::tetrahedron()];
    prisms.into_iter().chain(others).collect()
}

#[test]
fn other_schemes_are_refused_by_name() {
    let half = Fraction::HALF;
    for (scheme, name) in [
        (Scheme::doo_sabin(), "a corner split without passes"),
        (Scheme::quartic(), "a corner split and the pass 0"),
        (Scheme::three_point(Fraction::new(1, 64).unwrap()).unwrap(), "and the pass 3/4"),
        (Scheme::dual(&[half, half]).unwrap(), "and the passes 1/2, 1/2"),
        (Scheme::primal(&[half]).unwrap(), "a quad split and the pass 1/2"),
        (Scheme::catmull_clark(), "Catmull-Clark"),
        (Scheme::loop_triangles(), "Loop"),
    ] {
        let error = scheme.clone().with_extraordinary(Extraordinary::Tuned).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        let told = error.to_string();
        assert!(told.contains("w = 1/32") && told.ends_with(name), "{told}");
        assert_eq!(scheme.clone().with_extraordinary(Extraordinary::Default).unwrap(), scheme);
    }
    assert_eq!(tuned().extraordinary(), Extraordinary::Tuned);
    let same = Scheme::dual(&[half]).unwrap().with_extraordinary(Extraordinary::Tuned);
    assert_eq!(same.unwrap(), tuned());
}

/// The rule takes its children and no others; all rows sum to 1 exactly, and none has negative
/// weights but those that mirror images take part in.
#[test]
fn rows_differ_where_the_rule_applies_and_nowhere_else() {
    let closed = [bases::prism(5), bases::prism(12), bases::prism(33), bases::dodecahedron()];
    let closed = closed.into_iter().map(|control| (control, Boundary::Edge));
    let open = [holed(4), bases::half_fan(5)].into_iter();
    let open = open.flat_map(|c| [Boundary::None, Boundary::Edge].map(|b| (c.clone(), b)));
    for (control, boundary) in closed.chain(open) {
        let [by_rule, by_default] = [tuned(), plain()].map(|scheme| {
            let scheme = scheme.with_rule(CornerRule::Average).with_boundary(boundary);
            hierarchy(kernel::mesh(&control), scheme, 3)
        });
        let mirrored = boundary != Boundary::None;
        for level in 1..=3 {
            let parent = by_rule.mesh(level - 1);
            let wanted = sizes_around(parent, mirrored);
            let mut wanted: Vec<bool> = wanted.into_iter().map(is_tuned).collect();
            // What a split adds beside corners.
            wanted.resize(by_rule.mesh(level).vertices(), false);
            let stages = stages::<Exact>(&by_default, level);
            for (v, row) in rows(&by_rule, level).iter().enumerate() {
                let what = format!("level {level}, vertex {v} of {}", wanted.len());
                let sum: BigRational = row.iter().map(|(_, w)| &w.0).sum();
                assert!(sum.is_one(), "{what}: {sum}");
                let allowed = mirrored && !parent.is_closed() && !wanted[v];
                assert!(allowed || row.iter().all(|(_, w)| !w.0.is_negative()), "{what}");
                let same = composed(&stages, v) == sorted(row);
                assert_eq!(same, level == 1 || !wanted[v], "{what}");
            }
        }
    }
}

fn sorted(row: &Row<Exact>) -> Vec<(u32, BigRational)> {
    let mut row: Vec<_> = row.iter().map(|(v, w)| (*v, w.0.clone())).collect();
    row.sort_by_key(|entry| entry.0);
    row
}

/// A row of the pass on rows of the split.
fn composed(stages: &[Vec<Row<Exact>>], vertex: usize) -> Vec<(u32, BigRational)> {
    let mut sum = std::collections::BTreeMap::<u32, BigRational>::new();
    for (middle, outer) in &stages[1][vertex] {
        for (v, inner) in &stages[0][*middle as usize] {
            let entry = sum.entry(*v).or_insert_with(|| BigRational::from_integer(0.into()));
            *entry += &outer.0 * &inner.0;
        }
    }
    sum.into_iter().collect()
}

/// What is written and read again goes on as if it had not been, if it is marked anchored; not
/// marked it is a control mesh, and its first step is the default.
#[test]
fn a_mark_tells_a_level_from_a_control_mesh() {
    for control in [bases::prism(5), bases::bipyramid(7)] {
        let whole = hierarchy(kernel::mesh(&control), tuned(), 3);
        let default = hierarchy(kernel::mesh(&control), plain(), 3);
        let xyz = kernel::coordinates::<f64>(&control);
        let before = kernel::refine_values(&whole, 2, &xyz, 3);
        let soup = kernel::Soup::new(whole.mesh(2).vertices(), &kernel::faces(whole.mesh(2)));
        let once = |marked: bool, scheme: Scheme| {
            kernel::refine_mesh(&soup.mesh(marked), &scheme, 1, &before).positions
        };
        let all = kernel::refine_values(&whole, 3, &xyz, 3);
        assert_eq!(bits(&once(true, tuned())), bits(&all));
        assert_eq!(bits(&once(false, plain())), bits(&once(true, plain())));
        assert_eq!(bits(&once(false, tuned())), bits(&once(false, plain())));
        assert_ne!(bits(&once(false, tuned())), bits(&all));
        let first = |h: &Hierarchy| kernel::refine_values(h, 1, &xyz, 3);
        assert_eq!(bits(&first(&whole)), bits(&first(&default)));
    }
}

/// A grid whose middle vertex has been cut off: an octagon among quads, and no other face
/// than quads at the boundary.
fn holed(n: usize) -> Poly<f64> {
    let mut grid = bases::grid(n, n);
    let middle = (n / 2) * (n + 1) + n / 2;
    let at = [middle - n - 2, middle - n - 1, middle - n, middle + 1].into_iter();
    let ring: Vec<usize> =
        at.chain([middle + n + 2, middle + n + 1, middle + n, middle - 1]).rev().collect();
    grid.faces.retain(|face| !face.contains(&middle));
    grid.faces.push(ring);
    let last = grid.positions.len() - 1;
    grid.positions.swap_remove(middle);
    let moved = |v: &mut usize| *v = if *v == last { middle } else { *v };
    grid.faces.iter_mut().flatten().for_each(moved);
    grid
}

/// Open meshes have the rule inside, under every boundary rule, and the boundary does not ask.
#[test]
fn open_meshes_have_the_rule_inside() {
    let control = holed(6);
    for boundary in [Boundary::None, Boundary::Edge, Boundary::EdgeAndCorner] {
        let at = |scheme: Scheme| {
            let h = hierarchy(kernel::mesh(&control), scheme.with_boundary(boundary), 3);
            let xyz = kernel::coordinates::<f64>(&control);
            let heights = |xyz: &[f64]| -> Vec<f64> {
                xyz.chunks(3).flat_map(|p| [p[0], p[1], p[0] * p[0] - p[1] * p[0]]).collect()
            };
            (kernel::refine_values(&h, 3, &heights(&xyz), 3), h)
        };
        let ((by_rule, h), (by_default, _)) = (at(tuned()), at(plain()));
        assert_ne!(bits(&by_rule), bits(&by_default), "{boundary:?}");
        assert!(sizes_around(h.mesh(1), false).into_iter().any(is_tuned), "{boundary:?}");
        let rim: Vec<usize> = (0..h.mesh(3).corners())
            .filter(|&c| h.mesh(3).corner_twins()[c] == carvel::base::NONE)
            .map(|c| h.mesh(3).corner_vertices()[c] as usize)
            .collect();
        assert!(!rim.is_empty());
        for v in rim {
            assert_eq!(bits(&by_rule[3 * v..3 * v + 3]), bits(&by_default[3 * v..3 * v + 3]));
        }
    }
}

fn check_stencils(of: &Hierarchy, levels: u32, xyz: &[f64]) {
    let context = Context::builder().threads(2).chunk(1).build().expect("threads");
    let table = of.stencils::<f64>(&context, &StencilTask::level(levels)).expect("a table");
    let mut made = vec![0.0; 3 * of.mesh(levels).vertices()];
    let into = RecordsMut::packed(&mut made, 3);
    table.apply(&context, Records::packed(xyz, 3), into).expect("values of the right length");
    let wanted = kernel::refine_values(of, levels, xyz, 3);
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= ROUNDING;
    assert!(made.iter().zip(&wanted).all(close));
    // Some rows are the same as among all.
    let some: Vec<u32> = (0..of.mesh(levels).vertices() as u32).step_by(7).collect();
    let task = StencilTask { vertices: Some(&some), ..StencilTask::level(levels) };
    let part = of.stencils::<f64>(&Context::serial(), &task).expect("a table");
    for (place, &v) in some.iter().enumerate() {
        assert_eq!(part.row(place), table.row(v as usize), "vertex {v}");
        let sum: f64 = part.row(place).1.iter().sum();
        assert!((sum - 1.0).abs() <= ROUNDING && part.row(place).1.iter().all(|&w| w >= 0.0));
    }
}

#[test]
fn stencils_are_what_refinement_does() {
    for control in controls().into_iter().chain([holed(6)]) {
        let of = hierarchy(kernel::mesh(&control), tuned(), 3);
        check_stencils(&of, 3, &kernel::coordinates(&control));
    }
}

proptest! {
    #![proptest_config(config(32))]

    /// Threads and stages of memory do not show, on any mesh.
    #[test]
    fn threads_do_not_show(control in meshes(Kind::Any)) {
        let of = hierarchy(kernel::mesh(&control), tuned(), 3);
        let xyz = kernel::coordinates::<f32>(&control);
        let serial = kernel::refine_values(&of, 3, &xyz, 3);
        let threads = Context::builder().threads(3).chunk(1).build().expect("threads");
        let mut parallel = vec![0.0_f32; serial.len()];
        of.refine(&threads, 3, &xyz, 3, &mut parallel).expect("values of the right length");
        prop_assert_eq!(bits(&serial), bits(&parallel));
        let refined = kernel::refine_mesh(of.mesh(0), &tuned(), 3, &xyz);
        prop_assert_eq!(bits(&refined.positions), bits(&serial));
        check_stencils(&of, 2, &kernel::coordinates(&control));
    }
}
