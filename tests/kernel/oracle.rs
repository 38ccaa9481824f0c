//! Tests of the test oracle itself: what the kernel is judged by must first
//! stand on its own.

use std::collections::{HashMap, HashSet};

use num_rational::BigRational;
use num_traits::{One, Signed};
use proptest::prelude::*;

use crate::support::bases;
use crate::support::compare::{assert_same, canonical_cycle, canonical_faces, same_mesh};
use crate::support::generate::{self, Kind, meshes, tagged_meshes};
use crate::support::golden;
use crate::support::manifold::{assert_manifold, defects};
use crate::support::number::{Number, Point, combine, ratio};
use crate::support::poly::Poly;
use crate::support::reference::{
    Boundary, FaceParent, Rule, Scheme, Step, VertexParent, anchored_defect, corner_weights,
    hierarchy, refine, rows, step,
};
use crate::support::rng::Rng;
use crate::support::tensor::{assert_exactly_same, grid_mesh, random_grid};
use crate::support::tolerance::{FOUR_DIGITS, GOLDEN, ROUNDING};
use crate::support::topology::Topology;
use crate::support::univariate::{self, Curve};

const MODES: [Boundary; 3] = [Boundary::None, Boundary::Edge, Boundary::EdgeCorner];

fn topology<N: Number>(mesh: &Poly<N>) -> Topology {
    Topology::new(mesh.positions.len(), &mesh.faces)
}

/// Vertices, edges, faces.
fn counts<N: Number>(mesh: &Poly<N>) -> [usize; 3] {
    [mesh.positions.len(), topology(mesh).edge_count(), mesh.faces.len()]
}

fn three_point(rule: Rule, boundary: Boundary) -> Scheme {
    Scheme::three_point(1, 32, rule, boundary)
}

// -------------------------------------------------------------------- golden

#[test]
fn reference_reproduces_every_golden_case() {
    let cases = golden::load_all();
    assert!(!cases.is_empty(), "no golden case found");
    for case in cases {
        let made = refine(&case.control, &case.scheme, case.levels);
        assert_same(&made, &case.expected, GOLDEN, &case.name);
    }
}

/// The exact path through the same code, where the cosines are rational.
#[test]
fn exact_arithmetic_reproduces_the_golden_cube() {
    let case = golden::load(&golden::directory().join("cube_three_point_2.json"));
    let made = refine(&case.control.to_exact(), &case.scheme, case.levels).to_doubles();
    assert_same(&made, &case.expected, GOLDEN, &case.name);
}

// ----------------------------------------------------------- corner operator

#[test]
fn corner_operator_has_its_closed_forms() {
    let [nought, half, whole] = [0, 1, 2].map(|p| ratio(p, 2));
    for rule in [Rule::Cosine, Rule::Average] {
        for (n, sides) in [(3, 3), (4, 4), (6, 6)] {
            let centroid = vec![ratio(1, sides); n];
            assert_eq!(corner_weights(n, &nought, rule), centroid);
            let mut identity = vec![nought.clone(); n];
            identity[0] = whole.clone();
            assert_eq!(corner_weights(n, &whole, rule), identity);
        }
    }
    // Doo and Sabin: (n + 5)/4n, (3 + 2cos)/4n.
    let hexagon = corner_weights(6, &half, Rule::Cosine);
    assert_eq!(hexagon, [11, 4, 2, 1, 2, 4].map(|k| ratio(k, 24)));
    for t in [ratio(0, 1), ratio(1, 2), ratio(3, 4), ratio(7, 2), ratio(-1, 3)] {
        let quad = corner_weights(4, &t, Rule::Cosine);
        assert_eq!(quad, corner_weights(4, &t, Rule::Average));
        let [near, far] = [(whole.clone() + &t) / ratio(2, 1), (whole.clone() - &t) / ratio(2, 1)];
        assert_eq!(quad, [&near * &near, &near * &far, &far * &far, &far * &near]);
    }
}

/// Multipliers 1, t, t² of the Fourier modes 0, ±1, the rest.
#[test]
fn cosine_rule_has_its_fourier_multipliers() {
    let t = 0.3;
    for n in 3..12 {
        let weights = corner_weights(n, &t, Rule::Cosine);
        for mode in 0..n {
            let wave = |j: usize| f64::cos_turn(mode * j, n);
            let multiplier: f64 = weights.iter().enumerate().map(|(j, w)| w * wave(j)).sum();
            let expected = match mode {
                0 => 1.0,
                m if m == 1 || m == n - 1 => t,
                _ => t * t,
            };
            assert!((multiplier - expected).abs() < ROUNDING, "n = {n}, mode {mode}");
        }
    }
}

// ------------------------------------------------------------ regular meshes

/// Refines `height` by `width` points both ways and compares every level.
fn check_tensor_product(
    (height, columns): (usize, Curve),
    (width, rows): (usize, Curve),
    scheme: &Scheme,
    levels: usize,
) {
    let mut rng = Rng::new((height * 100 + width) as u64);
    let mut grid = random_grid(height, width, &mut rng);
    let mask = univariate::mask(&scheme.passes);
    let mut curves = (rows, columns);
    let mut mesh = grid_mesh(&grid, rows, columns);
    for level in 1..=levels {
        grid = univariate::tensor_step(&grid, &mask, curves.0, curves.1);
        curves = (curves.0.refined(), curves.1.refined());
        mesh = step(&mesh, scheme).poly;
        let what = format!("{height} x {width} {curves:?}, level {level}, {scheme:?}");
        assert_exactly_same(&mesh, &grid_mesh(&grid, curves.0, curves.1), &what);
    }
}

fn regular_schemes(boundary: Boundary) -> [Scheme; 5] {
    let rule = Rule::Cosine;
    [
        Scheme::doo_sabin(rule, boundary),
        three_point(rule, boundary),
        Scheme::three_point(1, 64, rule, boundary),
        Scheme::quartic(Rule::Average, boundary),
        // Negative weights: the four-point scheme of Dyn, Floater and Hormann.
        Scheme::dual(&[(0, 1), (7, 2)], rule, boundary),
    ]
}

/// Sizes in quads.
fn check_open_grids(schemes: &[Scheme]) {
    for (height, width) in (1..=3).flat_map(|h| (1..=4).map(move |w| (h, w))) {
        for scheme in schemes {
            check_tensor_product((height + 1, Curve::Open), (width + 1, Curve::Open), scheme, 3);
        }
    }
}

#[test]
fn open_grids_are_tensor_products_plain() {
    check_open_grids(&regular_schemes(Boundary::EdgeCorner)[..2]);
}

#[test]
fn open_grids_are_tensor_products_smoothed() {
    check_open_grids(&regular_schemes(Boundary::EdgeCorner)[2..4]);
}

#[test]
fn grids_of_a_four_point_scheme_are_tensor_products() {
    let scheme = &regular_schemes(Boundary::EdgeCorner)[4];
    check_tensor_product((3, Curve::Open), (4, Curve::Open), scheme, 3);
    check_tensor_product((3, Curve::Closed), (4, Curve::Closed), scheme, 3);
}

fn check_closed_grids(schemes: &[Scheme]) {
    for (height, width) in (3..=4).flat_map(|h| (3..=5).map(move |w| (h, w))) {
        for scheme in schemes {
            check_tensor_product((height, Curve::Closed), (width, Curve::Closed), scheme, 3);
        }
    }
}

#[test]
fn closed_grids_are_tensor_products_plain() {
    check_closed_grids(&regular_schemes(Boundary::EdgeCorner)[..2]);
}

#[test]
fn closed_grids_are_tensor_products_smoothed() {
    check_closed_grids(&regular_schemes(Boundary::EdgeCorner)[2..4]);
}

/// No corners, so both anchored modes agree.
#[test]
fn cylinders_are_tensor_products_in_both_anchored_modes() {
    for mode in [Boundary::Edge, Boundary::EdgeCorner] {
        for scheme in regular_schemes(mode) {
            check_tensor_product((2, Curve::Open), (3, Curve::Closed), &scheme, 2);
            check_tensor_product((3, Curve::Open), (4, Curve::Closed), &scheme, 2);
        }
    }
}

#[test]
fn univariate_masks_are_those_of_the_table() {
    let check = |passes: &[BigRational], mask: &[i64], over: i64| {
        let expected: Vec<_> = mask.iter().map(|&k| ratio(k, over)).collect();
        assert_eq!(univariate::mask(passes), expected);
    };
    check(&[], &[1, 3, 3, 1], 4);
    check(&[ratio(1, 2)], &[1, 9, 22, 22, 9, 1], 32);
    check(&[ratio(0, 1)], &[1, 5, 10, 10, 5, 1], 16);
    check(&[ratio(0, 1), ratio(7, 2)], &[-5, -7, 35, 105, 105, 35, -7, -5], 128);
}

/// 484; 198 twice; 81; 22 twice; 9 twice; 1: over 1024.
#[test]
fn regular_stencil_is_that_of_the_paper() {
    let torus = bases::torus(5, 5).to_exact();
    let scheme = three_point(Rule::Cosine, Boundary::EdgeCorner);
    let made = step(&torus, &scheme);
    let rows = rows(&torus, &scheme);
    // Corner 0 of face (2, 2) looks towards (3, 3).
    let parent = VertexParent::Corner { face: 12, position: 0 };
    let child = made.vertices.iter().position(|&p| p == parent).expect("every corner has a child");
    let along = |i: usize| [0, 1, 22, 9, 0][i];
    for (v, weight) in rows[child].iter().enumerate() {
        assert_eq!(*weight, ratio(along(v / 5) * along(v % 5), 1024), "vertex {v}");
    }
}

#[test]
fn counts_are_those_of_the_specification() {
    let scheme = three_point(Rule::Average, Boundary::EdgeCorner);
    let levels = |mesh: &Poly<f64>, n| (0..=n).map(|i| counts(&refine(mesh, &scheme, i))).collect();
    let torus: Vec<_> = levels(&bases::torus(4, 4), 3);
    assert_eq!(torus, [[16, 32, 16], [64, 128, 64], [256, 512, 256], [1024, 2048, 1024]]);
    let cube: Vec<_> = levels(&bases::cube(), 2);
    assert_eq!(cube, [[8, 12, 6], [24, 48, 26], [96, 192, 98]]);
}

// --------------------------------------------------------- extraordinary faces

/// The faces within `rings` of one face, in `none`, are all that the next
/// children around it need.
fn crop(mesh: &Poly<f64>, rings: usize) -> Poly<f64> {
    let mut kept = HashSet::from([0]);
    for _ in 0..rings {
        let near: HashSet<usize> = kept.iter().flat_map(|&f| mesh.faces[f].clone()).collect();
        let touches = |f: &usize| mesh.faces[*f].iter().any(|v| near.contains(v));
        kept = (0..mesh.faces.len()).filter(touches).collect();
    }
    let mut order: Vec<usize> = kept.into_iter().collect();
    order.sort_unstable();
    let faces = order.iter().map(|&f| mesh.faces[f].clone()).collect();
    drop_unused(&Poly::new(mesh.positions.clone(), faces))
}

fn drop_unused(mesh: &Poly<f64>) -> Poly<f64> {
    let mut number = HashMap::new();
    let mut positions = Vec::new();
    let mut rename = |v: usize| {
        *number.entry(v).or_insert_with(|| {
            positions.push(mesh.positions[v]);
            positions.len() - 1
        })
    };
    let faces = mesh.faces.iter().map(|f| f.iter().map(|&v| rename(v)).collect()).collect();
    Poly::new(positions, faces)
}

/// How much the first face shrinks in a step, after many.
fn subdominant(n: usize, passes: &[(i64, i64)], rule: Rule) -> f64 {
    let scheme = Scheme::dual(passes, rule, Boundary::None);
    // The innermost loop of an annulus, filled: a planar ring around an n-gon.
    let mut mesh = bases::annulus(n, 5);
    mesh.faces.insert(0, (0..n).collect());
    for p in &mut mesh.positions {
        p[2] = 0.0;
    }
    let radius = |mesh: &Poly<f64>| {
        let p = mesh.positions[mesh.faces[0][0]];
        p[0].hypot(p[1])
    };
    let mut ratio = 0.0;
    for _ in 0..14 {
        let before = radius(&mesh);
        mesh = crop(&step(&mesh, &scheme).poly, 4);
        ratio = radius(&mesh) / before;
    }
    ratio
}

#[test]
fn subdominant_eigenvalues_are_those_of_the_table() {
    let sizes = [3, 4, 5, 6, 8];
    let check = |passes: &[(i64, i64)], rule, expected: [f64; 5]| {
        for (n, lambda) in sizes.into_iter().zip(expected) {
            let found = subdominant(n, passes, rule);
            assert!((found - lambda).abs() < FOUR_DIGITS, "{n}: {found}, expected {lambda}");
        }
    };
    check(&[], Rule::Cosine, [0.5; 5]);
    check(&[], Rule::Average, [0.375, 0.5, 0.5773, 0.625, 0.6768]);
    check(&[(1, 2)], Rule::Cosine, [0.4317, 0.5, 0.5384, 0.5614, 0.5857]);
    check(&[(1, 2)], Rule::Average, [0.3868, 0.5, 0.5792, 0.6322, 0.6932]);
}

// ------------------------------------------------------------ exact invariants

/// A small random mesh on integer points, exact.
fn exact_mesh(seed: u64, kind: Kind) -> Poly<BigRational> {
    let recipe = generate::Recipe { seed, kind, components: 1, edits: 4, isolated: 1 };
    let mut mesh = generate::mesh(&recipe);
    generate::scatter(&mut mesh, &mut Rng::new(seed));
    mesh.tags = generate::random_tags(&mesh, &mut Rng::new(seed));
    mesh.to_exact()
}

fn exact_schemes() -> Vec<Scheme> {
    let mut schemes = vec![Scheme::primal(&[(0, 1), (3, 1)], Rule::Average)];
    for mode in MODES {
        schemes.push(Scheme::dual(&[(1, 2), (-1, 3)], Rule::Average, mode));
    }
    schemes
}

#[test]
fn constants_are_reproduced_exactly() {
    for seed in 0..6 {
        let constant = exact_mesh(seed, Kind::Any).map(|_| [1, 5, -2].map(|p| ratio(p, 3)));
        for scheme in exact_schemes() {
            let made = refine(&constant, &scheme, 2);
            assert!(made.positions.iter().all(|p| *p == constant.positions[0]), "seed {seed}");
        }
    }
}

#[test]
fn affine_maps_commute_with_steps_exactly() {
    let map = |p: &Point<BigRational>| -> Point<BigRational> {
        let [x, y, z] = p.clone();
        [&x + &y + &y + BigRational::one(), ratio(3, 7) * &z - &x, z + x + y * ratio(1, 2)]
    };
    for seed in 0..4 {
        let mesh = exact_mesh(seed, Kind::Any);
        for scheme in exact_schemes() {
            let image = step(&mesh.map(map), &scheme).poly;
            assert!(image == step(&mesh, &scheme).poly.map(map), "seed {seed}");
        }
    }
}

#[test]
fn rows_sum_to_one_and_make_the_step() {
    for seed in 0..4 {
        let mesh = exact_mesh(seed, Kind::Any);
        for scheme in exact_schemes() {
            let made = step(&mesh, &scheme).poly;
            for (row, p) in rows(&mesh, &scheme).into_iter().zip(made.positions) {
                assert!(row.iter().sum::<BigRational>().is_one());
                assert_eq!(combine(row.into_iter().zip(&mesh.positions)), p);
            }
        }
    }
}

#[test]
fn weights_are_non_negative_for_t_in_the_unit_interval() {
    for seed in 0..4 {
        let mesh = exact_mesh(seed, Kind::Closed);
        for passes in [&[(1, 2)][..], &[(0, 1), (1, 1)]] {
            let scheme = Scheme::dual(passes, Rule::Average, Boundary::EdgeCorner);
            let negative = |row: &Vec<BigRational>| row.iter().any(Signed::is_negative);
            assert!(!rows(&mesh, &scheme).iter().any(negative), "seed {seed}");
        }
    }
}

// ------------------------------------------------------------- boundary curves

/// What one step must make of each boundary loop: the closed curve of a loop
/// without corners, else the open curves between its corners.
fn expected_loops(mesh: &Poly<BigRational>, scheme: &Scheme) -> Vec<Vec<BigRational>> {
    let topo = topology(mesh);
    let mask = univariate::mask(&scheme.passes);
    let is_corner = |v: usize| match (mesh.anchored, scheme.boundary) {
        (true, _) => topo.is_single_face(v),
        (false, Boundary::EdgeCorner) => topo.is_single_face(v) || mesh.tags.contains(&v),
        (false, _) => mesh.tags.contains(&v),
    };
    let values = |vertices: &[usize]| -> Vec<BigRational> {
        vertices.iter().map(|&v| mesh.positions[v][0].clone()).collect()
    };
    let open = if mesh.anchored { Curve::Anchored } else { Curve::Open };
    let refine_loop = |cycle: Vec<usize>| -> Vec<BigRational> {
        let corners: Vec<usize> = (0..cycle.len()).filter(|&i| is_corner(cycle[i])).collect();
        if corners.is_empty() {
            return univariate::step(&values(&cycle), &mask, Curve::Closed);
        }
        let mut out = Vec::new();
        for (k, &from) in corners.iter().enumerate() {
            let to = if k + 1 < corners.len() { corners[k + 1] } else { corners[0] + cycle.len() };
            let piece: Vec<usize> = (from..=to).map(|i| cycle[i % cycle.len()]).collect();
            let made = univariate::step(&values(&piece), &mask, open);
            out.extend_from_slice(&made[..made.len() - 1]);
        }
        out
    };
    topo.boundary_loops().into_iter().map(refine_loop).collect()
}

fn rotated(mut cycle: Vec<BigRational>) -> Vec<BigRational> {
    let first = (0..cycle.len()).min_by_key(|&i| cycle[i].clone()).unwrap_or(0);
    cycle.rotate_left(first);
    cycle
}

fn sorted_loops(loops: Vec<Vec<BigRational>>) -> Vec<Vec<BigRational>> {
    let mut loops: Vec<_> = loops.into_iter().map(rotated).collect();
    loops.sort();
    loops
}

#[test]
fn boundary_curves_are_univariate() {
    for seed in 0..12 {
        for mode in [Boundary::Edge, Boundary::EdgeCorner] {
            let scheme = Scheme::dual(&[(1, 2), (0, 1)], Rule::Average, mode);
            // One coordinate is enough, and cheaper.
            let flat = |p: &Point<BigRational>| [p[0].clone(), ratio(0, 1), ratio(0, 1)];
            let mut mesh = exact_mesh(seed, Kind::Open).map(flat);
            for level in 1..=2 {
                let expected = sorted_loops(expected_loops(&mesh, &scheme));
                mesh = step(&mesh, &scheme).poly;
                let loops = topology(&mesh).boundary_loops();
                let value = |v: usize| mesh.positions[v][0].clone();
                let found = loops.into_iter().map(|l| l.into_iter().map(value).collect());
                let found = sorted_loops(found.collect());
                assert!(found == expected, "seed {seed}, {mode:?}, level {level}");
            }
        }
    }
}

// ------------------------------------------------------------ random topology

/// The vertex of the control mesh that a child vertex belongs to.
fn origin(control: &Poly<f64>, parent: VertexParent) -> usize {
    match parent {
        VertexParent::Corner { face, position } => control.faces[face][position],
        VertexParent::Beta { at, .. } => at,
        VertexParent::Kappa(v) | VertexParent::Isolated(v) => v,
        other => panic!("{other:?} is no parent in a dual step"),
    }
}

/// Every child face lies on the face, edge or vertex it is said to come from.
fn check_lineage(control: &Poly<f64>, made: &Step<f64>) {
    let distinct: HashSet<_> = made.vertices.iter().collect();
    assert_eq!(distinct.len(), made.poly.positions.len());
    let distinct: HashSet<_> = made.faces.iter().collect();
    assert_eq!(distinct.len(), made.poly.faces.len());
    for (cycle, &parent) in made.poly.faces.iter().zip(&made.faces) {
        let origins: Vec<_> = cycle.iter().map(|&v| origin(control, made.vertices[v])).collect();
        match parent {
            FaceParent::Face(f) => assert_eq!(origins, control.faces[f]),
            FaceParent::Vertex(v) => assert!(origins.iter().all(|&o| o == v)),
            FaceParent::Edge(a, b) => {
                let start = origins[0];
                let other = a + b - start;
                assert_eq!(origins, [start, other, other, start]);
            }
            FaceParent::Corner { .. } => panic!("a dual step makes no corner quads"),
        }
    }
}

/// Counts of a first step: V′ = H + 2B + K, F′ = F + E + V.
fn check_first_counts(control: &Poly<f64>, made: &Step<f64>, boundary: Boundary) {
    let topo = topology(control);
    let corner = |v: &usize| {
        let single = topo.is_single_face(*v) && boundary == Boundary::EdgeCorner;
        single || (topo.is_boundary(*v) && control.tags.contains(v))
    };
    let vertices = 0..control.positions.len();
    let corners = vertices.clone().filter(corner).count();
    let faceless =
        |&v: &usize| topo.is_isolated(v) || topo.is_interior(v) && topo.fans[v].len() == 2;
    let with_face = vertices.len() - vertices.clone().filter(faceless).count();
    let rim = 2 * topo.boundary_edges().len() + corners;
    assert_eq!(made.poly.positions.len(), control.corner_count() + rim + topo.isolated().len());
    assert_eq!(made.poly.faces.len(), control.faces.len() + topo.edge_count() + with_face);
}

/// Counts of a step from an anchored mesh: V′ = H, F′ = F + interior edges +
/// interior vertices with at least 3 faces.
fn check_later_counts(control: &Poly<f64>, made: &Step<f64>) {
    let topo = topology(control);
    let inner = |&v: &usize| topo.is_interior(v) && topo.fans[v].len() >= 3;
    let with_face = (0..control.positions.len()).filter(inner).count();
    let faces = control.faces.len() + topo.interior_edges().len() + with_face;
    assert_eq!(made.poly.positions.len(), control.corner_count() + topo.isolated().len());
    assert_eq!(made.poly.faces.len(), faces);
}

fn check_anchored(mesh: &Poly<f64>) {
    assert!(mesh.anchored);
    assert_eq!(anchored_defect(mesh), None);
    let topo = topology(mesh);
    for v in 0..mesh.positions.len() {
        let faces = topo.fans[v].len();
        assert!(!topo.is_boundary(v) || faces <= 2, "boundary vertex {v} has {faces} faces");
        assert!(!topo.is_interior(v) || faces == 3 || faces == 4, "vertex {v} has {faces} faces");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn steps_keep_counts_topology_and_lineage(control in tagged_meshes(Kind::Any)) {
        let scheme = Scheme::doo_sabin(Rule::Cosine, Boundary::EdgeCorner);
        for boundary in MODES {
            let steps = hierarchy(&control, &Scheme { boundary, ..scheme.clone() }, 2);
            for made in &steps {
                assert_manifold(made.poly.positions.len(), &made.poly.faces);
            }
            check_lineage(&control, &steps[0]);
            check_lineage(&steps[0].poly, &steps[1]);
            if boundary != Boundary::None {
                check_first_counts(&control, &steps[0], boundary);
                check_later_counts(&steps[0].poly, &steps[1]);
                for made in &steps {
                    check_anchored(&made.poly);
                }
                let euler = |mesh: &Poly<f64>| topology(mesh).euler_characteristic();
                prop_assert_eq!(euler(&control), euler(&steps[1].poly));
            }
        }
    }

    #[test]
    fn relabelling_only_renumbers_the_result(control in tagged_meshes(Kind::Any), seed: u64) {
        let other = generate::relabel(&control, &mut Rng::new(seed));
        for boundary in MODES {
            let scheme = three_point(Rule::Cosine, boundary);
            let (a, b) = (step(&control, &scheme).poly, step(&other, &scheme).poly);
            assert_same(&a, &b, ROUNDING, "relabelled");
        }
    }

    #[test]
    fn closed_and_open_meshes_are_what_they_say(
        closed in meshes(Kind::Closed),
        open in meshes(Kind::Open),
    ) {
        prop_assert!(topology(&closed).boundary_edges().is_empty());
        let topo = topology(&open);
        let has_rim = |&f: &usize| topo.corners_of(f).iter().any(|&c| topo.is_boundary_edge(c));
        prop_assert!(topo.components().iter().all(|faces| faces.iter().any(has_rim)));
    }

    #[test]
    fn comparison_finds_the_renumbering(mesh in meshes(Kind::Any), seed: u64) {
        let other = generate::relabel(&mesh, &mut Rng::new(seed));
        let matched = same_mesh(&other, &mesh, 0.0).map_err(TestCaseError::fail)?;
        for (v, w) in matched.into_iter().enumerate() {
            let bits = |p: &Point<f64>| p.map(f64::to_bits);
            prop_assert_eq!(bits(&other.positions[v]), bits(&mesh.positions[w]));
        }
    }

    /// Without positions only the connectivity can tell the vertices apart.
    #[test]
    fn comparison_copes_with_collapsed_meshes(mesh in meshes(Kind::Any), seed: u64) {
        let flat = mesh.map(|_| [1.0, 2.0, 3.0]);
        let other = generate::relabel(&flat, &mut Rng::new(seed));
        let matched = same_mesh(&other, &flat, ROUNDING).map_err(TestCaseError::fail)?;
        let named = canonical_faces(&other.faces, |v| matched[v]);
        prop_assert_eq!(named, canonical_faces(&flat.faces, |v| v));
    }
}

// ------------------------------------------------------------------ generators

/// The features that a property test expects to meet.
fn features(mesh: &Poly<f64>) -> Vec<&'static str> {
    let topo = topology(mesh);
    let loops = topo.boundary_loops().len();
    let components = topo.components().len();
    let largest = mesh.faces.iter().map(Vec::len).max().unwrap_or(0);
    let fan = |v: &usize| topo.fans[*v].len();
    let vertices = || 0..mesh.positions.len();
    let has = [
        ("closed", loops == 0),
        ("open", loops > 0),
        ("several components", components > 2),
        ("several loops on one component", components == 1 && loops > 1),
        ("a handle", components == 1 && loops == 0 && topo.euler_characteristic() <= 0),
        ("a large face", largest >= 12),
        ("a single face", mesh.faces.len() == 1),
        ("high valence", vertices().any(|v| topo.is_interior(v) && fan(&v) >= 25)),
        ("a crowded boundary vertex", vertices().any(|v| topo.is_boundary(v) && fan(&v) >= 20)),
        ("valence two", vertices().any(|v| topo.is_interior(v) && fan(&v) == 2)),
        ("isolated vertices", !topo.isolated().is_empty()),
        ("single-face vertices", vertices().any(|v| topo.is_single_face(v))),
    ];
    has.into_iter().filter_map(|(name, yes)| yes.then_some(name)).collect()
}

#[test]
fn generator_meets_every_feature() {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    for seed in 0..400 {
        for feature in features(&generate::seeded(seed, Kind::Any)) {
            *seen.entry(feature).or_default() += 1;
        }
    }
    assert_eq!(seen.len(), 12, "some feature never occurs: {seen:?}");
    assert!(seen.values().all(|&n| n >= 2), "some feature is rare: {seen:?}");
}

#[test]
fn generator_depends_on_its_recipe_alone() {
    for seed in 0..20 {
        assert_eq!(generate::seeded(seed, Kind::Any), generate::seeded(seed, Kind::Any));
    }
}

// ------------------------------------------------------------- planted defects

#[test]
fn manifold_check_finds_planted_defects() {
    let says = |faces: &[&[usize]], what: &str| {
        let faces: Vec<_> = faces.iter().map(|f| f.to_vec()).collect();
        let found = defects(6, &faces).join("; ");
        assert!(found.contains(what), "{faces:?}: {found}");
    };
    says(&[&[0, 1]], "has 2 vertices");
    says(&[&[0, 1, 6]], "uses vertex 6");
    says(&[&[0, 1, 2, 1]], "repeats");
    says(&[&[0, 1, 2], &[0, 1, 3]], "edge 0 -> 1 is used 2 times");
    says(&[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]], "edge 0 -> 1");
    says(&[&[0, 1, 2], &[0, 3, 4]], "vertex 0 has several fans");
    // Two closed fans at one vertex.
    says(&[&[0, 1, 2], &[0, 2, 1], &[0, 3, 4], &[0, 4, 3]], "vertex 0 has several fans");
    assert!(defects(6, &[vec![0, 1, 2], vec![1, 0, 3]]).is_empty());
}

#[test]
fn comparison_says_what_differs() {
    let cube = bases::cube();
    let says = |edit: &dyn Fn(&mut Poly<f64>), what: &str| {
        let mut other = cube.clone();
        edit(&mut other);
        let found = same_mesh(&other, &cube, ROUNDING).expect_err(what);
        assert!(found.contains(what), "{found}");
    };
    says(&|m| m.positions[3][0] += 1e-6, "the first is 3");
    says(&|m| m.positions[3][0] = f64::NAN, "the first is 3");
    says(&|m| m.faces[2].reverse(), "face 2");
    says(&|m| m.positions.push([0.0; 3]), "9 vertices");
    says(&|m| m.positions[1] = m.positions[0], "both lie on expected vertex 0");
}

/// Same counts, same places, other connectivity.
#[test]
fn comparison_tells_collapsed_meshes_apart() {
    let mut one = bases::bipyramid(5);
    let mut other = bases::pyramid(4);
    // Seven vertices, ten triangles each, by poking.
    let apex = other.positions.len();
    other.positions.push([0.0; 3]);
    let base = other.faces.pop().expect("a pyramid has a base");
    other.faces.extend((0..4).map(|i| vec![base[i], base[(i + 1) % 4], apex]));
    let side = other.faces.remove(0);
    other.positions.push([0.0; 3]);
    other.faces.extend((0..3).map(|i| vec![side[i], side[(i + 1) % 3], apex + 1]));
    for p in one.positions.iter_mut().chain(&mut other.positions) {
        *p = [0.0; 3];
    }
    assert_eq!(counts(&one), counts(&other));
    let found = same_mesh(&other, &one, ROUNDING).expect_err("they differ");
    assert!(found.contains("fits nowhere"), "{found}");
}

#[test]
fn comparison_is_fast_enough_for_large_meshes() {
    let mesh = bases::torus(320, 320);
    let other = generate::relabel(&mesh, &mut Rng::new(1));
    assert_same(&other, &mesh, ROUNDING, "a torus of 102400 vertices");
}

#[test]
fn anchored_conditions_are_checked() {
    let anchored = |mut mesh: Poly<f64>| {
        mesh.anchored = true;
        anchored_defect(&mesh)
    };
    assert_eq!(anchored(bases::grid(3, 3)), None);
    assert_eq!(anchored(bases::annulus(5, 2)), None);
    assert!(anchored(bases::half_fan(3)).is_some(), "three faces at a boundary vertex");
    assert!(anchored(bases::polygon(3)).is_some(), "a triangle has no room for a corner");
    assert!(anchored(bases::grid(1, 1)).is_some(), "four boundary edges on one face");
    assert!(anchored(bases::grid(1, 3)).is_some(), "opposite boundary edges on one face");
}

#[test]
fn canonical_cycles_start_at_their_smallest_vertex() {
    assert_eq!(canonical_cycle(vec![4, 2, 9]), [2, 9, 4]);
}
