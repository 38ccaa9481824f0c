//! The kernel's weights in exact arithmetic: no tolerance hides a wrong one.

use std::collections::HashMap;

use carvel::Hierarchy;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use crate::support::bases;
use crate::support::cases::{MODES, RULES, TAME, all_schemes, rounding};
use crate::support::exact::{Exact, Row, apply_exactly, apply_naively, stages};
use crate::support::generate::{self, Kind};
use crate::support::kernel;
use crate::support::number::{Point, ratio};
use crate::support::poly::Poly;
use crate::support::reference::{Boundary, Rule, Scheme};
use crate::support::rng::Rng;
use crate::support::tensor::{assert_exactly_same, grid_mesh, mesh_of_values, random_grid};
use crate::support::tolerance::ROW;
use crate::support::topology::Topology;
use crate::support::univariate::{self, Curve};

/// Meshes whose faces the cosine rule knows exactly: of 3, 4 and 6 sides, with
/// their mirror images too.
fn cosine_meshes() -> Vec<Poly<f64>> {
    vec![
        bases::cube(),
        bases::tetrahedron(),
        bases::prism(6),
        bases::torus(3, 4),
        bases::grid(1, 1),
        bases::grid(3, 2),
        bases::frame(),
        bases::annulus(3, 2),
        bases::half_fan(2),
    ]
}

fn tagged(seed: u64, kind: Kind) -> Poly<f64> {
    let mut mesh = generate::seeded(seed, kind);
    mesh.tags = generate::random_tags(&mesh, &mut Rng::new(seed));
    mesh
}

/// Pairs of a mesh and a scheme that exact arithmetic can follow for two levels.
fn exact_cases() -> Vec<(Poly<f64>, Scheme)> {
    let average = |s: &Scheme| s.rule == Rule::Average;
    let (average, cosine): (Vec<_>, Vec<_>) = all_schemes().into_iter().partition(average);
    let meshes: Vec<_> = (0..4).map(|seed| tagged(seed, Kind::Any)).collect();
    let pairs = |meshes: Vec<Poly<f64>>, schemes: Vec<Scheme>| {
        let with_all = move |mesh: Poly<f64>| {
            let schemes = schemes.clone().into_iter();
            schemes.map(move |s| (mesh.clone(), s)).collect::<Vec<_>>()
        };
        meshes.into_iter().flat_map(with_all).collect::<Vec<_>>()
    };
    [pairs(meshes, average), pairs(cosine_meshes(), cosine)].concat()
}

// ----------------------------------------------------------------------- rows

#[test]
fn rows_sum_to_one_exactly() {
    for (mesh, scheme) in exact_cases() {
        let hierarchy = kernel::hierarchy(&mesh, &scheme, 2);
        // Faces of the second level may have sizes without an exact cosine.
        let levels = if scheme.rule == Rule::Average { 2 } else { 1 };
        for level in 1..=levels {
            for row in stages::<Exact>(&hierarchy, level).iter().flatten() {
                let sum: BigRational = row.iter().map(|(_, w)| &w.0).sum();
                assert!(sum.is_one(), "{scheme:?}, level {level}: {sum}");
            }
        }
    }
}

fn assert_close(exact: &Row<Exact>, double: &Row<f64>, what: &str) {
    assert_eq!(exact.len(), double.len(), "{what}: entries");
    for ((v, w), (u, x)) in exact.iter().zip(double) {
        assert_eq!(v, u, "{what}: vertices");
        let w = w.0.to_f64().expect("a weight in the range of doubles");
        // Weights beyond 1 have as much larger roundings.
        let apart = (w - x).abs() / w.abs().max(1.0);
        assert!(apart <= ROW, "{what}: {x} for {w}");
    }
}

#[test]
fn rows_in_doubles_are_the_exact_ones() {
    for (mesh, scheme) in exact_cases() {
        let hierarchy = kernel::hierarchy(&mesh, &scheme, 1);
        let (exact, double) = (stages::<Exact>(&hierarchy, 1), stages::<f64>(&hierarchy, 1));
        assert_eq!(exact.len(), 1 + scheme.passes.len());
        let what = format!("{scheme:?}");
        for (exact, double) in exact.iter().flatten().zip(double.iter().flatten()) {
            assert_close(exact, double, &what);
        }
    }
}

#[test]
fn weights_are_not_negative_on_closed_meshes() {
    for passes in TAME {
        for rule in RULES {
            let scheme = Scheme::dual(passes, rule, Boundary::EdgeCorner);
            for seed in 0..6 {
                let mesh = generate::seeded(seed, Kind::Closed);
                let hierarchy = kernel::hierarchy(&mesh, &scheme, 2);
                for level in 1..=2 {
                    let all = stages::<f64>(&hierarchy, level);
                    let mut weights = all.iter().flatten().flatten().map(|(_, w)| w);
                    assert!(weights.all(|&w| w >= 0.0), "{scheme:?}, seed {seed}");
                }
            }
        }
    }
}

// ------------------------------------------------------------ the paper's mask

/// The row of a child on the control vertices, stages multiplied.
fn composed(stages: &[Vec<Row<Exact>>], child: u32) -> HashMap<u32, BigRational> {
    let mut row = HashMap::from([(child, BigRational::one())]);
    for stage in stages.iter().rev() {
        let mut before: HashMap<u32, BigRational> = HashMap::new();
        for (v, w) in row {
            for (u, x) in &stage[v as usize] {
                *before.entry(*u).or_insert_with(|| ratio(0, 1)) += &w * &x.0;
            }
        }
        row = before;
    }
    row
}

/// The nine vertices around corner `c`, by the specification's list.
fn stencil(topo: &Topology, c: usize) -> Vec<(usize, i64)> {
    let (next, prev, vert) = (&topo.next, &topo.prev, &topo.vert);
    let twin = |c: usize| topo.twin[c].expect("a closed mesh");
    let ccw = |c: usize| twin(prev[c]);
    // The corners of the vertex: in its own face, beside it, across from it.
    let [own, left, far, right] = [c, ccw(c), ccw(ccw(c)), ccw(ccw(ccw(c)))];
    let opposite = |c: usize| vert[next[next[c]]];
    vec![
        (vert[own], 484),
        (vert[next[own]], 198),
        (vert[prev[own]], 198),
        (opposite(own), 81),
        (vert[next[far]], 22),
        (vert[prev[far]], 22),
        (opposite(left), 9),
        (opposite(right), 9),
        (opposite(far), 1),
    ]
}

#[test]
fn regular_stencil_is_that_of_the_paper() {
    for rule in RULES {
        let scheme = Scheme::three_point(1, 32, rule, Boundary::EdgeCorner);
        let hierarchy = kernel::hierarchy(&bases::torus(5, 6), &scheme, 1);
        let stages = stages::<Exact>(&hierarchy, 1);
        let mesh = hierarchy.mesh(0);
        let topo = Topology::new(mesh.vertices(), &kernel::faces(mesh));
        for c in 0..topo.corner_count() {
            let named = |(v, w): (usize, i64)| (v as u32, ratio(w, 1024));
            let expected: HashMap<_, _> = stencil(&topo, c).into_iter().map(named).collect();
            assert_eq!(composed(&stages, c as u32), expected, "corner {c}");
        }
    }
}

// ------------------------------------------------------------- tensor products

fn tensor_schemes() -> Vec<Scheme> {
    let mode = Boundary::EdgeCorner;
    vec![
        Scheme::doo_sabin(Rule::Cosine, mode),
        Scheme::three_point(1, 32, Rule::Cosine, mode),
        Scheme::quartic(Rule::Average, mode),
        Scheme::dual(&[(0, 1), (7, 2)], Rule::Cosine, mode),
    ]
}

/// Refines `height` by `width` points both ways and compares every level.
fn check_tensor_product(
    (height, columns): (usize, Curve),
    (width, rows): (usize, Curve),
    scheme: &Scheme,
) {
    let mut grid = random_grid(height, width, &mut Rng::new((height * 100 + width) as u64));
    let mask = univariate::mask(&scheme.passes);
    let mut curves = (rows, columns);
    let control = grid_mesh(&grid, rows, columns);
    let hierarchy = kernel::hierarchy(&control, scheme, 3);
    let mut values: Vec<_> = grid.iter().flatten().cloned().collect();
    for level in 1..=3 {
        grid = univariate::tensor_step(&grid, &mask, curves.0, curves.1);
        curves = (curves.0.refined(), curves.1.refined());
        values = apply_exactly(&stages(&hierarchy, level), &values);
        let made = mesh_of_values(&values, kernel::faces(hierarchy.mesh(level)));
        let what = format!("{height} x {width} {curves:?}, level {level}, {scheme:?}");
        assert_exactly_same(&made, &grid_mesh(&grid, curves.0, curves.1), &what);
    }
}

fn check_open_grids(scheme: &Scheme) {
    for (height, width) in (2..=5).flat_map(|h| (2..=5).map(move |w| (h, w))) {
        check_tensor_product((height, Curve::Open), (width, Curve::Open), scheme);
    }
}

#[test]
fn open_grids_are_tensor_products_under_doo_sabin() {
    check_open_grids(&tensor_schemes()[0]);
}

#[test]
fn open_grids_are_tensor_products_under_three_point() {
    check_open_grids(&tensor_schemes()[1]);
}

#[test]
fn open_grids_are_tensor_products_under_quartic() {
    check_open_grids(&tensor_schemes()[2]);
}

#[test]
fn open_grids_are_tensor_products_with_two_passes() {
    let scheme = &tensor_schemes()[3];
    for size in [(2, 2), (2, 4), (3, 3), (5, 3)] {
        check_tensor_product((size.0, Curve::Open), (size.1, Curve::Open), scheme);
    }
}

#[test]
fn tori_and_cylinders_are_tensor_products() {
    for scheme in tensor_schemes() {
        for (height, width) in [(3, 3), (3, 5), (4, 4)] {
            check_tensor_product((height, Curve::Closed), (width, Curve::Closed), &scheme);
        }
        check_tensor_product((2, Curve::Open), (3, Curve::Closed), &scheme);
        check_tensor_product((4, Curve::Open), (4, Curve::Closed), &scheme);
    }
}

// ------------------------------------------------------------------- fast path

fn assert_near(made: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(made.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    for (v, (a, b)) in made.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= tolerance * scale, "{what}: vertex {v}: {a}, by rows {b}");
    }
}

/// Each coordinate by naive application of the rows, level by level.
fn by_rows(hierarchy: &Hierarchy, level: u32, positions: &[Point<f64>], k: usize) -> Vec<f64> {
    let first = positions.iter().map(|p| p[k]).collect();
    (1..=level).fold(first, |x: Vec<f64>, level| apply_naively(&stages(hierarchy, level), &x))
}

fn check_fast_path(mesh: &Poly<f64>, scheme: &Scheme) {
    let hierarchy = kernel::hierarchy(mesh, scheme, 2);
    let refined = kernel::refine::<f64>(mesh, scheme, 2);
    for k in 0..3 {
        let made: Vec<f64> = refined.positions.iter().skip(k).step_by(3).copied().collect();
        let expected = by_rows(&hierarchy, 2, &mesh.positions, k);
        assert_near(&made, &expected, rounding(scheme), &format!("{scheme:?}"));
    }
}

#[test]
fn refiner_agrees_with_its_rows_on_random_meshes() {
    for (i, scheme) in all_schemes().iter().enumerate() {
        for seed in 0..3 {
            check_fast_path(&tagged(3 * i as u64 + seed, Kind::Any), scheme);
        }
    }
}

/// Where nearly all quads are regular, and where boundaries are near.
#[test]
fn refiner_agrees_with_its_rows_on_grids() {
    for passes in TAME {
        for mode in MODES {
            let scheme = Scheme::dual(passes, Rule::Cosine, mode);
            for mesh in [bases::torus(6, 5), bases::grid(6, 6), bases::annulus(6, 5)] {
                check_fast_path(&mesh, &scheme);
            }
        }
    }
}
