//! Properties of refinement on random manifold meshes.

use std::sync::LazyLock;

use carvel::base::Scalar;
use carvel::mesh::Survey;
use carvel::refine::Counts;
use carvel::{Attribute, Context, Hierarchy, Mesh, Prediction, Refined, Refiner, Task};
use proptest::prelude::*;

use crate::support::cases::{anchoring_schemes, config, is_tame, rounding, schemes};
use crate::support::compare::assert_same;
use crate::support::generate::{self, Kind, meshes, tagged_meshes};
use crate::support::kernel::{self, Soup, assert_same_bytes, bits};
use crate::support::number::Point;
use crate::support::poly::Poly;
use crate::support::reference::{self, Boundary, Scheme};
use crate::support::rng::Rng;
use crate::support::tolerance::GOLDEN_SINGLE;
use crate::support::topology::Topology;

fn topology(mesh: &Poly<f64>) -> Topology {
    Topology::new(mesh.positions.len(), &mesh.faces)
}

fn refine(mesh: &Poly<f64>, scheme: &Scheme, levels: u32) -> Poly<f64> {
    kernel::poly_of(&kernel::refine::<f64>(mesh, scheme, levels))
}

fn random_values<T: Scalar>(n: usize, seed: u64) -> Vec<T> {
    let mut rng = Rng::new(seed);
    (0..n).map(|_| T::from_f64(rng.signed())).collect()
}

// -------------------------------------------------------------------- oracle

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn kernel_agrees_with_the_oracle(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
    ) {
        for (level, made) in reference::hierarchy(&control, &scheme, 2).iter().enumerate() {
            let levels = level as u32 + 1;
            let double = kernel::refine::<f64>(&control, &scheme, levels);
            prop_assert_eq!(double.anchored, made.poly.anchored);
            assert_same(&kernel::poly_of(&double), &made.poly, rounding(&scheme), "f64");
            if is_tame(&scheme) {
                let single = kernel::refine::<f32>(&control, &scheme, levels);
                assert_same(&kernel::poly_of(&single), &made.poly, GOLDEN_SINGLE, "f32");
            }
        }
    }

    /// A mesh that is anchored already goes on as if it had never been read back.
    #[test]
    fn kernel_continues_the_oracle(control in tagged_meshes(Kind::Open), scheme in schemes()) {
        let steps = reference::hierarchy(&control, &scheme, 2);
        let made = refine(&steps[0].poly, &scheme, 1);
        assert_same(&made, &steps[1].poly, rounding(&scheme), "the second step");
    }
}

/// The random schemes above are a sample; here is every one of them, once.
#[test]
fn every_scheme_agrees_with_the_oracle_on_one_mesh() {
    let mut control = generate::seeded(5, Kind::Open);
    control.tags = generate::random_tags(&control, &mut Rng::new(5));
    for scheme in crate::support::cases::all_schemes() {
        let expected = reference::refine(&control, &scheme, 2);
        let what = format!("{scheme:?}");
        assert_same(&refine(&control, &scheme, 2), &expected, rounding(&scheme), &what);
    }
}

// -------------------------------------------------------- counts, invariants

fn check_counts(hierarchy: &Hierarchy, plan: &Prediction) {
    for level in 0..=hierarchy.last_level() {
        let mesh = hierarchy.mesh(level);
        // What a mesh counts of itself, and what follows from its faces alone.
        assert_eq!(plan.counts(level), &Counts::of(mesh), "level {level}");
        let topo = Topology::new(mesh.vertices(), &kernel::faces(mesh));
        let counts = plan.counts(level);
        assert_eq!(counts.vertices, mesh.vertices() as u64);
        assert_eq!(counts.faces, topo.face_count() as u64);
        assert_eq!(counts.corners, topo.corner_count() as u64);
        assert_eq!(counts.edges, topo.edge_count() as u64);
        assert_eq!(counts.boundary_edges, topo.boundary_edges().len() as u64);
        check_irregular(mesh, counts);
    }
}

/// Irregular faces come first and are as many as predicted.
fn check_irregular(mesh: &Mesh, counts: &Counts) {
    let sizes: Vec<u32> = mesh.face_sizes().collect();
    let (irregular, regular) = sizes.split_at(counts.irregular_faces as usize);
    assert_eq!(irregular.iter().map(|&n| u64::from(n)).sum::<u64>(), counts.irregular_corners);
    let all_triangles = irregular.is_empty() && regular.iter().all(|&n| n == 3);
    assert!(all_triangles || regular.iter().all(|&n| n == 4));
    assert!(!irregular.contains(&4));
}

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn counts_are_as_predicted_and_every_level_is_valid(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
    ) {
        let hierarchy = kernel::hierarchy(&control, &scheme, 2);
        let plan = Prediction::new(hierarchy.mesh(0), hierarchy.scheme(), 2).expect("small");
        check_counts(&hierarchy, &plan);
        for level in 0..=2 {
            hierarchy.mesh(level).validate().expect("a valid level");
        }
        let refined = kernel::refine::<f64>(&control, &scheme, 2);
        prop_assert_eq!(refined.face_sizes.len() as u64, plan.last().faces);
        prop_assert_eq!(refined.face_vertices.len() as u64, plan.last().corners);
        prop_assert_eq!(refined.positions.len() as u64, 3 * plan.last().vertices);
    }

    #[test]
    fn the_shape_of_the_surface_is_kept(
        control in meshes(Kind::Any),
        scheme in anchoring_schemes(),
    ) {
        let hierarchy = kernel::hierarchy(&control, &scheme, 3);
        let topo = topology(&control);
        for level in 0..=3 {
            let survey = Survey::of(hierarchy.mesh(level));
            prop_assert_eq!(survey.euler_characteristic, topo.euler_characteristic());
            prop_assert_eq!(survey.components, topo.components().len());
            prop_assert_eq!(survey.boundary_loops, topo.boundary_loops().len());
        }
    }
}

// ------------------------------------------------------------------- geometry

fn largest(mesh: &Poly<f64>) -> f64 {
    mesh.positions.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()))
}

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn affine_maps_commute_with_refinement(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
        seed: u64,
    ) {
        let mut rng = Rng::new(seed);
        let rows: [[f64; 4]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| rng.signed()));
        let row = |r: &[f64; 4], p: &Point<f64>| r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
        let map = |p: &Point<f64>| rows.each_ref().map(|r| row(r, p));
        let image = refine(&control.map(map), &scheme, 2);
        let expected = refine(&control, &scheme, 2).map(map);
        // What is compared must not shrink below what was rounded.
        let scale = (largest(&control) / largest(&expected)).max(1.0);
        assert_same(&image, &expected, 10.0 * scale * rounding(&scheme), "the image");
    }

    #[test]
    fn constants_are_reproduced(control in tagged_meshes(Kind::Any), scheme in schemes()) {
        let point = [1.0, -2.5, 0.3];
        let made = refine(&control.map(|_| point), &scheme, 3);
        for p in made.positions {
            for (x, expected) in p.iter().zip(point) {
                prop_assert!((x - expected).abs() <= rounding(&scheme) * expected.abs());
            }
        }
    }

    #[test]
    fn planes_stay_planes(control in tagged_meshes(Kind::Any), scheme in schemes()) {
        // An oblique plane, and one that sums of zeros must hit exactly.
        let oblique = |p: &Point<f64>| [p[0], p[1], 0.5 * p[0] - 0.25 * p[1] + 2.0];
        let made = refine(&control.map(oblique), &scheme, 2);
        let limit = 10.0 * rounding(&scheme) * largest(&made);
        prop_assert!(made.positions.iter().all(|p| (oblique(p)[2] - p[2]).abs() <= limit));
        let flat = refine(&control.map(|p| [p[0], p[1], 0.0]), &scheme, 2);
        prop_assert!(flat.positions.iter().all(|p| p[2] == 0.0));
    }
}

// ------------------------------------------------------------------- boundary

/// The positions along every boundary loop, bit for bit, from a fixed start.
fn boundary_curves(mesh: &Poly<f64>) -> Vec<Vec<[u64; 3]>> {
    let bits = |&v: &usize| mesh.positions[v].map(f64::to_bits);
    let curve = |cycle: Vec<usize>| {
        let mut curve: Vec<_> = cycle.iter().map(bits).collect();
        let first = (0..curve.len()).min_by_key(|&i| curve[i]).unwrap_or(0);
        curve.rotate_left(first);
        curve
    };
    let mut curves: Vec<_> = topology(mesh).boundary_loops().into_iter().map(curve).collect();
    curves.sort();
    curves
}

/// One face in each boundary loop, corners tagged.
fn polygons_of_boundary(mesh: &Poly<f64>, corners: impl Fn(usize) -> bool) -> Poly<f64> {
    let faces = topology(mesh).boundary_loops();
    let tags = faces.iter().flatten().copied().filter(|&v| corners(v)).collect();
    Poly { tags, ..Poly::new(mesh.positions.clone(), faces) }
}

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn boundary_does_not_see_the_interior(
        control in tagged_meshes(Kind::Open),
        scheme in anchoring_schemes(),
        seed: u64,
    ) {
        let topo = topology(&control);
        let mut rng = Rng::new(seed);
        let mut moved = control.clone();
        for v in (0..moved.positions.len()).filter(|&v| !topo.is_boundary(v)) {
            moved.positions[v] = std::array::from_fn(|_| 10.0 * rng.signed());
        }
        let (a, b) = (refine(&control, &scheme, 2), refine(&moved, &scheme, 2));
        prop_assert_eq!(&a.faces, &b.faces);
        let after = topology(&a);
        for v in (0..a.positions.len()).filter(|&v| after.is_boundary(v)) {
            prop_assert_eq!(a.positions[v].map(f64::to_bits), b.positions[v].map(f64::to_bits));
        }
    }

    /// Any mesh has the boundary of a lone face in the same loop.
    #[test]
    fn boundary_is_that_of_its_polygon(
        control in tagged_meshes(Kind::Open),
        scheme in anchoring_schemes(),
    ) {
        let topo = topology(&control);
        let single = |v| scheme.boundary == Boundary::EdgeCorner && topo.is_single_face(v);
        let polygons = polygons_of_boundary(&control, |v| control.tags.contains(&v) || single(v));
        let edge = Scheme { boundary: Boundary::Edge, ..scheme.clone() };
        let expected = boundary_curves(&refine(&polygons, &edge, 2));
        prop_assert_eq!(boundary_curves(&refine(&control, &scheme, 2)), expected);
    }
}

// ------------------------------------------------------------------ numbering

/// What a caller would write to a file and read back.
fn read_back<T>(refined: &Refined<T>) -> Mesh {
    let faces = kernel::faces_of(refined);
    let vertices = refined.positions.len() / 3;
    Soup::new(vertices, &faces).mesh(refined.anchored)
}

/// Step by step on the meshes of a hierarchy gives the same bytes; through faces
/// read back it gives the same surface, numbered otherwise.
fn check_step_by_step<T: Scalar>(control: &Poly<f64>, scheme: &Scheme, levels: u32) {
    let rule = kernel::scheme(scheme);
    let hierarchy = kernel::hierarchy(control, scheme, levels);
    let mut step = kernel::refine::<T>(control, scheme, 1);
    for level in 2..=levels {
        let whole = kernel::refine::<T>(control, scheme, level);
        let again = kernel::refine_mesh(&read_back(&step), &rule, 1, &step.positions);
        let precision = if T::BYTES == 4 { f64::from(f32::EPSILON) } else { f64::EPSILON };
        let tolerance = rounding(scheme) * precision / f64::EPSILON;
        let (again, expected) = (kernel::poly_of(&again), kernel::poly_of(&whole));
        assert_same(&again, &expected, tolerance, "read back");
        step = kernel::refine_mesh(hierarchy.mesh(level - 1), &rule, 1, &step.positions);
        // Sources count from the mesh that the step started from.
        step.face_sources.clone_from(&whole.face_sources);
        assert_same_bytes(&step, &whole, &format!("level {level} step by step"));
    }
}

proptest! {
    #![proptest_config(config(96))]

    #[test]
    fn relabelling_only_renumbers_the_result(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
        seed: u64,
    ) {
        let other = generate::relabel(&control, &mut Rng::new(seed));
        let (a, b) = (refine(&control, &scheme, 2), refine(&other, &scheme, 2));
        assert_same(&a, &b, rounding(&scheme), "relabelled");
    }

    #[test]
    fn many_steps_are_one_step_many_times(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
    ) {
        check_step_by_step::<f64>(&control, &scheme, 3);
        check_step_by_step::<f32>(&control, &scheme, 2);
    }
}

// -------------------------------------------------------------------- threads

/// Contexts that must not matter, the plainest first.
static CONTEXTS: LazyLock<Vec<(String, Context)>> = LazyLock::new(|| {
    let plain = |threads| Context::builder().threads(threads);
    let named = |n: usize| {
        let single = (format!("{n} threads, chunks of one"), plain(n).chunk(1));
        let usual = (format!("{n} threads"), plain(n));
        [usual, single].map(|(name, builder)| (name, builder.build().expect("threads")))
    };
    [1, 2, 7].into_iter().flat_map(named).collect()
});

fn check_threads<T: Scalar>(control: &Poly<f64>, scheme: &Scheme, levels: u32) {
    let (mesh, scheme) = (kernel::mesh(control), kernel::scheme(scheme));
    let positions = kernel::coordinates::<T>(control);
    let values = random_values::<T>(5 * mesh.vertices(), 3);
    let attributes = &[Attribute::vertex(&values, 5)];
    let task = Task {
        mesh: &mesh,
        scheme: &scheme,
        levels,
        positions: &positions,
        attributes,
        channels: &[],
        face_sources: true,
    };
    let mut expected: Option<(Refined<T>, Hierarchy)> = None;
    for (name, context) in CONTEXTS.iter() {
        let refined = Refiner::new().refine(context, &task).expect("a refinement");
        let hierarchy = Hierarchy::new(context, mesh.clone(), scheme.clone(), levels);
        let hierarchy = hierarchy.expect("a hierarchy");
        check_hierarchy(context, &hierarchy, &positions, &refined, name);
        let Some((one, levels_of_one)) = &expected else {
            expected = Some((refined, hierarchy));
            continue;
        };
        assert_same_bytes(&refined, one, name);
        for level in 0..=levels {
            assert!(hierarchy.mesh(level) == levels_of_one.mesh(level), "{name}: level {level}");
        }
    }
}

/// The hierarchy's last level is the refiner's result, byte for byte.
fn check_hierarchy<T: Scalar>(
    context: &Context,
    hierarchy: &Hierarchy,
    positions: &[T],
    refined: &Refined<T>,
    what: &str,
) {
    let level = hierarchy.last_level();
    let mesh = hierarchy.mesh(level);
    assert_eq!(mesh.corner_vertices(), refined.face_vertices, "{what}: faces");
    assert!(mesh.face_sizes().eq(refined.face_sizes.iter().copied()), "{what}: face sizes");
    let mut out = vec![T::default(); 3 * mesh.vertices()];
    hierarchy.refine(context, level, positions, 3, &mut out).expect("values");
    assert_eq!(bits(&out), bits(&refined.positions), "{what}: positions");
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn threads_and_chunks_do_not_matter(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
        levels in 1..=2_u32,
    ) {
        check_threads::<f64>(&control, &scheme, levels);
        check_threads::<f32>(&control, &scheme, levels);
    }

    /// Building sorts in parallel; its result is the same for all that.
    #[test]
    fn threads_do_not_matter_to_building(control in tagged_meshes(Kind::Any)) {
        let soup = Soup::new(control.positions.len(), &control.faces);
        let build = |context: &Context| {
            let options = carvel::mesh::BuildOptions::default();
            carvel::mesh::build(context, soup.vertices, &soup.sizes, &soup.indices, &options)
                .expect("a manifold mesh")
                .mesh
        };
        let expected = build(&CONTEXTS[0].1);
        prop_assert!(CONTEXTS.iter().all(|(_, context)| build(context) == expected));
    }
}

// ----------------------------------------------------------------- attributes

/// Lanes `first..first + 3` of records, as positions; lanes beyond are zero.
fn three_lanes<T: Scalar>(values: &[T], width: usize, first: usize) -> Vec<T> {
    let lane = |record: &[T], i: usize| record.get(i).copied().unwrap_or_default();
    let three = |record: &[T]| [0, 1, 2].map(|i| lane(record, first + i));
    values.chunks(width).flat_map(three).collect()
}

/// A record of any width is refined lane by lane, as positions are.
fn check_width<T: Scalar>(hierarchy: &Hierarchy, width: usize, tolerance: f64) {
    let (mesh, level) = (hierarchy.mesh(0), hierarchy.last_level());
    let values = random_values::<T>(width * mesh.vertices(), width as u64);
    let positions = random_values::<T>(3 * mesh.vertices(), 0);
    let attributes = &[Attribute::vertex(&values, width)];
    let scheme = hierarchy.scheme();
    let task = Task {
        mesh,
        scheme,
        levels: level,
        positions: &positions,
        attributes,
        channels: &[],
        face_sources: false,
    };
    let refined = Refiner::new().refine(&Context::serial(), &task).expect("a refinement");
    let made = &refined.attributes[0];
    assert_eq!(bits(made), bits(&kernel::refine_values(hierarchy, level, &values, width)));
    for first in (0..width).step_by(3) {
        let lanes = three_lanes(&values, width, first);
        let expected = kernel::refine_values(hierarchy, level, &lanes, 3);
        assert_lanes(&three_lanes(made, width, first), &expected, tolerance);
        // Three lanes alone are bound to be the same bytes.
        assert!(width != 3 || bits(made) == bits(&expected));
    }
}

fn assert_lanes<T: Scalar>(made: &[T], expected: &[T], tolerance: f64) {
    let scale = expected.iter().fold(1.0, |m: f64, x| m.max(x.to_f64().abs()));
    for (a, b) in made.iter().zip(expected) {
        let apart = (a.to_f64() - b.to_f64()).abs();
        assert!(apart <= tolerance * scale, "{a:?} and {b:?} are {apart} apart");
    }
}

proptest! {
    #![proptest_config(config(40))]

    #[test]
    fn attributes_follow_the_rows_of_positions(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
    ) {
        let hierarchy = kernel::hierarchy(&control, &scheme, 2);
        for width in 1..=9 {
            check_width::<f64>(&hierarchy, width, rounding(&scheme));
        }
        if is_tame(&scheme) {
            check_width::<f32>(&hierarchy, 7, GOLDEN_SINGLE);
        }
    }
}

// ------------------------------------------------------------- re-used memory

/// A task with its own data.
struct Job {
    mesh: Mesh,
    scheme: carvel::Scheme,
    levels: u32,
    positions: Vec<f64>,
    values: Vec<f64>,
    width: usize,
}

impl Job {
    fn new(control: &Poly<f64>, scheme: &Scheme, levels: u32, width: usize) -> Self {
        Self {
            mesh: kernel::mesh(control),
            scheme: kernel::scheme(scheme),
            levels,
            positions: kernel::coordinates(control),
            values: random_values(width * control.positions.len(), 9),
            width,
        }
    }

    fn run(&self, refiner: &mut Refiner<f64>) -> Refined<f64> {
        let task = Task {
            mesh: &self.mesh,
            scheme: &self.scheme,
            levels: self.levels,
            positions: &self.positions,
            attributes: &[Attribute::vertex(&self.values, self.width)],
            channels: &[],
            face_sources: true,
        };
        refiner.refine(&Context::serial(), &task).expect("a refinement")
    }
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn a_used_refiner_forgets_what_it_did(
        controls in proptest::collection::vec((tagged_meshes(Kind::Any), schemes()), 3),
        seed: u64,
    ) {
        let mut rng = Rng::new(seed);
        let job = |(control, scheme): &(Poly<f64>, Scheme)| {
            Job::new(control, scheme, rng.between(0, 3) as u32, rng.between(1, 6))
        };
        let jobs: Vec<Job> = controls.iter().map(job).collect();
        let fresh: Vec<_> = jobs.iter().map(|job| job.run(&mut Refiner::new())).collect();
        let mut refiner = Refiner::new();
        for i in [0, 0, 1, 2, 0, 1, 2, 2, 1] {
            assert_same_bytes(&jobs[i].run(&mut refiner), &fresh[i], "a refiner used before");
        }
    }
}

// -------------------------------------------------------------------- lineage

proptest! {
    #![proptest_config(config(96))]

    #[test]
    fn face_sources_are_composed_origins(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
    ) {
        let hierarchy = kernel::hierarchy(&control, &scheme, 3);
        let mut sources: Vec<u32> = (0..hierarchy.mesh(0).faces() as u32).collect();
        for level in 1..=3 {
            let origins = hierarchy.face_origins(level).expect("a level that was built");
            let parent = hierarchy.mesh(level - 1);
            let source = |o: &carvel::refine::FaceOrigin| {
                sources[o.representative(parent) as usize]
            };
            sources = origins.iter().map(source).collect();
            let refined = kernel::refine::<f64>(&control, &scheme, level);
            prop_assert_eq!(&refined.face_sources, &sources);
        }
    }
}
