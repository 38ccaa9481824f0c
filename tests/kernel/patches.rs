//! Several levels in one step, patch by patch, against one level after the other: the
//! same faces under the same numbers and the same bits everywhere.

use carvel::base::Scalar;
use carvel::{
    Attribute, Context, CornerRule, Fraction, Hierarchy, LoopWeights, Prediction, Refined, Refiner,
    Scheme, SplitKind, Task,
};
use proptest::prelude::*;

use crate::support::bases;
use crate::support::cases::config;
use crate::support::generate::{Kind, meshes};
use crate::support::kernel::{self, bits};
use crate::support::poly::Poly;
use crate::support::rng::Rng;
use crate::tuned::tuned;

/// Every face a fan of triangles around a new vertex.
fn poked(mesh: &Poly<f64>) -> Poly<f64> {
    let mut it = Poly::new(mesh.positions.clone(), Vec::new());
    for face in &mesh.faces {
        let centre = it.positions.len();
        let sum = |k: usize| face.iter().map(|&v| mesh.positions[v][k]).sum::<f64>();
        it.positions.push([0, 1, 2].map(|k| sum(k) / face.len() as f64 + 0.1));
        let next = face.iter().cycle().skip(1);
        it.faces.extend(face.iter().zip(next).map(|(&a, &b)| vec![a, b, centre]));
    }
    it
}

fn values<T: Scalar>(n: usize) -> Vec<T> {
    let mut rng = Rng::new(n as u64);
    (0..n).map(|_| T::from_f64(rng.signed())).collect()
}

/// The fewest levels of which some are done in patches, and a number more.
fn levels(control: &Poly<f64>, scheme: &Scheme, more: u32) -> u32 {
    let mesh = kernel::mesh(control);
    let patches = |&levels: &u32| {
        Prediction::new(&mesh, scheme, levels).expect("a small mesh").patch_depth() > 0
    };
    (2..9).find(patches).expect("a closed mesh") + more
}

fn refined<T: Scalar>(
    context: &Context,
    hierarchy: &Hierarchy,
    (positions, wide): (&[T], &[T]),
) -> Refined<T> {
    let varying = Attribute::varying(&wide[..positions.len() / 3], 1);
    let attributes = &[Attribute::vertex(wide, 5), varying];
    let attributes =
        &attributes[..if hierarchy.scheme().split() == SplitKind::Corner { 1 } else { 2 }];
    let task = Task {
        mesh: hierarchy.mesh(0),
        scheme: hierarchy.scheme(),
        levels: hierarchy.last_level(),
        positions,
        attributes,
        channels: &[],
        face_sources: true,
    };
    Refiner::new().refine(context, &task).expect("a small refinement")
}

/// Refines at once and level by level; the first difference is a failure.
fn check<T: Scalar>(control: &Poly<f64>, scheme: &Scheme, levels: u32) {
    let mesh = kernel::mesh(control);
    let serial = Context::serial();
    let hierarchy = Hierarchy::new(&serial, mesh, scheme.clone(), levels).unwrap();
    let (positions, wide) =
        (kernel::coordinates::<T>(control), values(5 * control.positions.len()));
    let plan = Prediction::new(hierarchy.mesh(0), scheme, levels).unwrap();
    assert!(plan.patch_depth() > 0, "nothing to compare");
    let whole = refined(&serial, &hierarchy, (&positions, &wide));
    let last = hierarchy.mesh(levels);
    assert_eq!(whole.face_vertices, last.corner_vertices());
    assert!(whole.face_sizes.iter().copied().eq(last.face_sizes()));
    assert_eq!(
        bits(&whole.positions),
        bits(&kernel::refine_values(&hierarchy, levels, &positions, 3))
    );
    let expected = kernel::refine_values(&hierarchy, levels, &wide, 5);
    assert_eq!(bits(&whole.attributes[0]), bits(&expected));
    if let Some(varying) = whole.attributes.get(1) {
        let mut linear = vec![T::default(); last.vertices()];
        let (n, rows) = (control.positions.len(), carvel::Interpolation::Varying);
        hierarchy.interpolate(&serial, levels, rows, &wide[..n], 1, &mut linear).unwrap();
        assert_eq!(bits(varying), bits(&linear));
    }
    let mut sources: Vec<u32> = (0..hierarchy.mesh(0).faces() as u32).collect();
    for level in 1..=levels {
        let origins = hierarchy.face_origins(level).unwrap();
        let parent = hierarchy.mesh(level - 1);
        sources = origins.iter().map(|o| sources[o.representative(parent) as usize]).collect();
    }
    assert_eq!(whole.face_sources, sources);
    let threads = Context::builder().threads(3).chunk(1).build().unwrap();
    assert_eq!(refined(&threads, &hierarchy, (&positions, &wide)), whole);
}

/// A cube beside a vertex without faces.
fn lone_vertex() -> Poly<f64> {
    let mut lone = bases::cube();
    lone.positions.insert(3, [7.0, 8.0, 9.0]);
    let shift = |v: &mut usize| *v += usize::from(*v >= 3);
    lone.faces.iter_mut().flatten().for_each(shift);
    lone
}

fn quad_schemes() -> [Scheme; 2] {
    [Scheme::catmull_clark(), Scheme::bilinear()]
}

#[test]
fn quads_of_all_valences() {
    for control in [bases::torus(16, 16), bases::torus(3, 90), bases::cube(), bases::tetrahedron()]
    {
        for scheme in quad_schemes() {
            check::<f32>(&control, &scheme, levels(&control, &scheme, 0));
            check::<f64>(&control, &scheme, levels(&control, &scheme, 1));
        }
    }
}

#[test]
fn hubs_pillows_and_lone_vertices() {
    for control in [
        bases::bipyramid(40),
        bases::bipyramid(3),
        bases::prism(31),
        bases::pillow(5),
        lone_vertex(),
    ] {
        let scheme = Scheme::catmull_clark();
        check::<f32>(&control, &scheme, levels(&control, &scheme, 0));
    }
}

#[test]
fn triangles_of_all_valences() {
    for control in [bases::octahedron(), bases::bipyramid(40), poked(&bases::torus(5, 9))] {
        for weights in [LoopWeights::Loop, LoopWeights::Warren] {
            let scheme = Scheme::loop_triangles().with_loop_weights(weights);
            check::<f32>(&control, &scheme, levels(&control, &scheme, 0));
        }
        let scheme = Scheme::loop_triangles();
        check::<f64>(&control, &scheme, levels(&control, &scheme, 1));
    }
}

#[test]
fn patches_as_deep_as_they_get() {
    check::<f32>(&bases::torus(16, 16), &Scheme::catmull_clark(), 5);
    check::<f32>(&poked(&bases::torus(8, 8)), &Scheme::loop_triangles(), 5);
}

/// Linear values are means of nothing but ends: zeros keep their signs, and what is large
/// does not overflow on the way.
#[test]
fn linear_values_are_left_alone() {
    for (control, scheme) in [
        (bases::torus(16, 16), Scheme::catmull_clark()),
        (poked(&bases::torus(8, 8)), Scheme::loop_triangles()),
    ] {
        let mesh = kernel::mesh(&control);
        let positions = kernel::coordinates::<f32>(&control);
        let large = |v: usize| if v.is_multiple_of(3) { -0.0 } else { f32::MAX / 5.0 };
        let values: Vec<f32> = (0..mesh.vertices()).map(large).collect();
        let attributes = &[Attribute::varying(&values, 1)];
        let task = Task { attributes, ..Task::new(&mesh, &scheme, 2, &positions) };
        let whole = Refiner::new().refine(&Context::serial(), &task).expect("finite values");
        let hierarchy =
            Hierarchy::new(&Context::serial(), mesh.clone(), scheme.clone(), 2).unwrap();
        let mut linear = vec![0.0_f32; hierarchy.mesh(2).vertices()];
        let varying = carvel::Interpolation::Varying;
        hierarchy.interpolate(&Context::serial(), 2, varying, &values, 1, &mut linear).unwrap();
        assert_eq!(bits(&whole.attributes[0]), bits(&linear));
    }
}

fn depth(control: &Poly<f64>, scheme: &Scheme, levels: u32) -> u32 {
    let mesh = kernel::mesh(control);
    Prediction::new(&mesh, scheme, levels).expect("a small mesh").patch_depth()
}

/// 1 − 16w is the pass.
fn three_point(w: (i64, i64)) -> Scheme {
    Scheme::three_point(Fraction::new(w.0, w.1).expect("a fraction")).expect("a weight in range")
}

/// One without a pass, the paper's and tuned, one with centroids for a pass, and one in between.
fn dual_schemes() -> [Scheme; 5] {
    let between = three_point((1, 100));
    [Scheme::doo_sabin(), three_point((1, 32)), tuned(), Scheme::quartic(), between]
}

/// The middles of a cube's edges: triangles and quads around vertices of valence 4.
fn cuboctahedron() -> Poly<f64> {
    let cube = bases::cube();
    let mut edges = Vec::new();
    let mut middle = |a: usize, b: usize| {
        let edge = [a.min(b), a.max(b)];
        edges.iter().position(|&e| e == edge).unwrap_or_else(|| {
            edges.push(edge);
            edges.len() - 1
        })
    };
    let mut faces: Vec<Vec<usize>> = Vec::new();
    for face in &cube.faces {
        let next = face.iter().cycle().skip(1);
        faces.push(face.iter().zip(next).map(|(&a, &b)| middle(a, b)).collect());
    }
    for v in 0..8 {
        // Around a vertex: from one face to the face across its incoming edge.
        let mut around = Vec::new();
        let start = cube.faces.iter().position(|f| f.contains(&v)).expect("a face");
        let mut at = start;
        loop {
            let face = &cube.faces[at];
            let place = face.iter().position(|&w| w == v).expect("the vertex");
            let before = face[(place + face.len() - 1) % face.len()];
            around.push(middle(v, face[(place + 1) % face.len()]));
            let across = |f: &Vec<usize>| {
                f.iter().zip(f.iter().cycle().skip(1)).any(|(&a, &b)| (a, b) == (v, before))
            };
            at = cube.faces.iter().position(across).expect("a closed mesh");
            if at == start {
                break;
            }
        }
        faces.push(around);
    }
    let mean = |[a, b]: &[usize; 2]| {
        [0, 1, 2].map(|k| f64::midpoint(cube.positions[*a][k], cube.positions[*b][k]))
    };
    Poly::new(edges.iter().map(mean).collect(), faces)
}

#[test]
fn tiles_of_all_depths() {
    for scheme in [Scheme::doo_sabin(), three_point((1, 32))] {
        for levels in 3..=5 {
            assert_eq!(depth(&bases::torus(8, 8), &scheme, levels), levels - 1);
            check::<f32>(&bases::torus(8, 8), &scheme, levels);
            check::<f64>(&bases::torus(3, 22), &scheme, levels);
        }
    }
}

#[test]
fn tiles_around_faces_that_are_no_quads() {
    for control in [
        bases::cube(),
        bases::bipyramid(3),
        bases::bipyramid(11),
        bases::prism(11),
        bases::prism(32),
        bases::prism(33),
        bases::pillow(8),
        lone_vertex(),
    ] {
        for scheme in [Scheme::doo_sabin(), three_point((1, 32)), tuned()] {
            let fewest = levels(&control, &scheme, 0);
            let deepest = fewest + if control.faces.len() <= 8 { 2 } else { 1 };
            for levels in fewest..=deepest {
                assert_eq!(depth(&control, &scheme, levels), 2 + levels - fewest);
                check::<f32>(&control, &scheme, levels);
            }
        }
    }
    for scheme in dual_schemes() {
        let average = scheme.with_rule(CornerRule::Average);
        for control in [bases::tetrahedron(), bases::dodecahedron()] {
            check::<f64>(&control, &average, levels(&control, &average, 0));
        }
    }
}

/// The parent is the first split of a mesh from outside, of triangles alone or not.
#[test]
fn tiles_of_the_first_split() {
    for control in [bases::several(&bases::octahedron(), 10), bases::several(&cuboctahedron(), 6)] {
        for scheme in [Scheme::doo_sabin(), three_point((1, 32)), tuned()] {
            for levels in 3..=5 {
                assert_eq!(depth(&control, &scheme, levels), levels - 1);
                check::<f32>(&control, &scheme, levels);
            }
        }
    }
}

/// Weighed before they are added, values near the limit stay in range on the way.
#[test]
fn tiles_of_large_values() {
    let mesh = kernel::mesh(&bases::cube());
    let positions = vec![f32::MAX / 1.01; 24];
    for scheme in dual_schemes() {
        let task = Task::new(&mesh, &scheme, 6, &positions);
        let refined = Refiner::new().refine(&Context::serial(), &task).expect("no overflow");
        assert!(refined.positions.iter().all(|x| x.is_finite()));
    }
}

/// No tiles where the mesh has a boundary, or the one before the parent other valences than 4,
/// and none with more passes than one.
#[test]
fn tiles_are_for_splits_of_closed_meshes() {
    let (open, uneven) = (bases::grid(16, 16), poked(&bases::torus(8, 8)));
    for scheme in dual_schemes() {
        assert_eq!([2, 3, 4, 5].map(|levels| depth(&open, &scheme, levels)), [0; 4]);
        assert_eq!([2, 3, 4, 5].map(|levels| depth(&uneven, &scheme, levels)), [0, 0, 2, 3]);
    }
    let twice = Scheme::dual(&[Fraction::ZERO; 2]).expect("passes in range");
    assert_eq!([2, 3, 4, 5].map(|levels| depth(&uneven, &twice, levels)), [0; 4]);
}

/// What a refiner keeps from a call does not show in the next, whatever either did.
#[test]
fn a_refiner_goes_from_tiles_to_levels_and_back() {
    let (serial, mut refiner) = (Context::serial(), Refiner::new());
    let controls = [bases::torus(16, 16), bases::cube(), bases::several(&bases::octahedron(), 12)];
    let schemes = [Scheme::doo_sabin(), Scheme::catmull_clark(), Scheme::quartic()];
    for levels in [5, 2, 4, 1, 3] {
        for (control, scheme) in
            controls.iter().zip(&schemes).chain(controls[1..].iter().zip(&schemes))
        {
            let (mesh, positions) = (kernel::mesh(control), kernel::coordinates::<f32>(control));
            let task = Task { face_sources: true, ..Task::new(&mesh, scheme, levels, &positions) };
            let fresh = Refiner::new().refine(&serial, &task).expect("a small refinement");
            assert_eq!(refiner.refine(&serial, &task).expect("the same"), fresh);
        }
    }
}

proptest! {
    #![proptest_config(config(6))]

    #[test]
    fn random_closed_meshes(control in meshes(Kind::Closed)) {
        let scheme = Scheme::catmull_clark();
        check::<f32>(&control, &scheme, levels(&control, &scheme, 0));
        check::<f64>(&control, &scheme, levels(&control, &scheme, 0));
        for scheme in dual_schemes() {
            check::<f32>(&control, &scheme, levels(&control, &scheme, 0));
        }
        let (control, scheme) = (poked(&control), Scheme::loop_triangles());
        check::<f32>(&control, &scheme, levels(&control, &scheme, 0));
    }
}
