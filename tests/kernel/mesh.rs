//! Building meshes: what is refused and why, what is repaired, what is kept.

use std::time::{Duration, Instant};

use carvel::base::NONE;
use carvel::mesh::{BuildOptions, Built, Defect, Defects, NonManifold, Survey, build};
use carvel::{Context, Element, Error, ErrorKind, Mesh};
use proptest::prelude::*;

use crate::support::bases;
use crate::support::cases::{MODES, config};
use crate::support::generate::{self, Kind, meshes};
use crate::support::kernel::{self, Soup};
use crate::support::poly::Poly;
use crate::support::reference::{Boundary, Rule, Scheme, anchored_defect};
use crate::support::rng::Rng;
use crate::support::topology::Topology;

use Element::{Edge, Face, Vertex};

const CUT: BuildOptions = BuildOptions {
    non_manifold: NonManifold::Cut,
    anchored: false,
    corner_tags: &[],
    creases: &[],
    sharp_vertices: &[],
    holes: &[],
};

fn refusal(vertices: usize, faces: &[&[usize]]) -> Error {
    let options = BuildOptions::default();
    Soup::new(vertices, faces).build(&options).expect_err("a bad mesh").into()
}

fn defects(vertices: usize, faces: &[&[usize]], options: &BuildOptions) -> Vec<Defect> {
    match Soup::new(vertices, faces).build(options).expect_err("a bad mesh") {
        Defects::Soup(list) => list,
        Defects::Call(error) => panic!("{error}"),
    }
}

// ------------------------------------------------------------------ rejections

#[track_caller]
fn assert_refused(vertices: usize, faces: &[&[usize]], kind: ErrorKind, elements: &[Element]) {
    let error = refusal(vertices, faces);
    assert_eq!((error.kind(), error.elements()), (kind, elements), "{error}");
    let text = error.to_string();
    assert!(!text.is_empty() && !text.contains('\n'), "one line: {text}");
    // The short way in says the same.
    let soup = Soup::new(vertices, faces);
    let short = Mesh::from_polygons(vertices, &soup.sizes, &soup.indices);
    assert_eq!(short.expect_err("a bad mesh").to_string(), text);
}

#[test]
fn bad_faces_are_refused() {
    use ErrorKind::{FaceTooSmall, IndexOutOfRange, RepeatedVertex};
    assert_refused(4, &[&[0, 1, 2], &[0, 2, 4]], IndexOutOfRange, &[Vertex(4), Face(1)]);
    let largest = NONE as usize;
    assert_refused(4, &[&[0, 1, largest]], IndexOutOfRange, &[Vertex(largest as u64), Face(0)]);
    assert_refused(0, &[&[0, 1, 2]], IndexOutOfRange, &[Vertex(0), Face(0)]);
    assert_refused(4, &[&[0, 1, 2], &[1, 2]], FaceTooSmall, &[Face(1)]);
    assert_refused(4, &[&[3]], FaceTooSmall, &[Face(0)]);
    assert_refused(4, &[&[], &[0, 1, 2]], FaceTooSmall, &[Face(0)]);
    assert_refused(4, &[&[0, 1, 1]], RepeatedVertex, &[Vertex(1), Face(0)]);
    assert_refused(4, &[&[0, 1, 2, 0]], RepeatedVertex, &[Vertex(0), Face(0)]);
    // A large face is searched in another way.
    let mut large: Vec<usize> = (0..40).collect();
    large[33] = 5;
    assert_refused(40, &[&[0, 1, 2], &large], RepeatedVertex, &[Vertex(5), Face(1)]);
}

#[test]
fn bad_edges_are_refused() {
    use ErrorKind::{InconsistentOrientation, NonManifoldEdge};
    let same_way: &[&[usize]] = &[&[0, 1, 2], &[0, 1, 3]];
    assert_refused(4, same_way, InconsistentOrientation, &[Edge(0, 1), Face(0), Face(1)]);
    let three: &[&[usize]] = &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]];
    assert_refused(5, three, NonManifoldEdge, &[Edge(0, 1), Face(0), Face(1), Face(2)]);
    // Two pairs that would each be sound.
    let four: &[&[usize]] = &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4], &[1, 0, 5]];
    assert_refused(6, four, NonManifoldEdge, &[Edge(0, 1), Face(0), Face(1), Face(2), Face(3)]);
    // The same face twice.
    let twice: &[&[usize]] = &[&[0, 1, 2], &[0, 1, 2]];
    assert_refused(3, twice, InconsistentOrientation, &[Edge(0, 1), Face(0), Face(1)]);
}

#[test]
fn vertices_with_several_fans_are_refused() {
    let bow_tie: &[&[usize]] = &[&[0, 1, 2], &[0, 3, 4]];
    assert_refused(5, bow_tie, ErrorKind::NonManifoldVertex, &[Vertex(0)]);
    // Two closed fans: two pillows that touch.
    let pillows: &[&[usize]] = &[&[0, 1, 2], &[2, 1, 0], &[2, 3, 4], &[4, 3, 2]];
    assert_refused(5, pillows, ErrorKind::NonManifoldVertex, &[Vertex(2)]);
}

/// The mesh puts quads last; errors speak of the caller's faces all the same.
#[test]
fn errors_name_faces_in_the_callers_order() {
    let faces: &[&[usize]] =
        &[&[0, 1, 2, 3], &[4, 5, 6], &[7, 8, 9, 10], &[5, 4, 11], &[4, 5, 7], &[8, 7, 0]];
    let error = refusal(12, faces);
    assert_eq!(error.elements(), [Edge(4, 5), Face(1), Face(3), Face(4)]);
}

#[test]
fn sizes_must_fit() {
    let kind = |vertices, sizes: &[u32], indices: &[u32]| {
        Mesh::from_polygons(vertices, sizes, indices).expect_err("bad sizes").kind()
    };
    assert_eq!(kind(4, &[3], &[0, 1, 2, 3]), ErrorKind::LengthMismatch);
    assert_eq!(kind(4, &[3, 3], &[0, 1, 2]), ErrorKind::LengthMismatch);
    assert_eq!(kind(4, &[u32::MAX; 3], &[0, 1, 2]), ErrorKind::LengthMismatch);
    assert_eq!(kind(4, &[], &[0]), ErrorKind::LengthMismatch);
    assert_eq!(kind(NONE as usize, &[3], &[0, 1, 2]), ErrorKind::TooLarge);
    assert_eq!(kind(usize::MAX, &[], &[]), ErrorKind::TooLarge);
}

#[test]
fn all_defects_are_listed_at_once() {
    let faces: &[&[usize]] = &[
        &[0, 1, 2],
        &[3, 4],
        &[0, 1, 3],
        &[4, 5, 5],
        &[6, 7, 99],
        &[6, 7, 8],
        &[7, 6, 9],
        &[6, 7, 10],
    ];
    let list = defects(11, faces, &BuildOptions::default());
    let expected = [
        Defect::FaceTooSmall { face: 1, size: 2 },
        Defect::RepeatedVertex { face: 3, vertex: 5 },
        Defect::IndexOutOfRange { face: 4, vertex: 99, vertices: 11 },
        Defect::InconsistentOrientation { edge: (0, 1), faces: vec![0, 2] },
        Defect::NonManifoldEdge { edge: (6, 7), faces: vec![5, 6, 7] },
    ];
    assert_eq!(list, expected);
    assert!(refusal(11, faces).to_string().contains("4 more"), "{}", refusal(11, faces));
}

#[test]
fn edges_and_vertices_are_listed_together() {
    let faces: &[&[usize]] =
        &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4], &[5, 6, 7], &[5, 8, 9], &[10, 11, 12], &[12, 13, 14]];
    let expected = [
        Defect::NonManifoldEdge { edge: (0, 1), faces: vec![0, 1, 2] },
        Defect::NonManifoldVertex { vertex: 5 },
        Defect::NonManifoldVertex { vertex: 12 },
    ];
    assert_eq!(defects(15, faces, &BuildOptions::default()), expected);
}

// ------------------------------------------------------------------ policy cut

fn cut(vertices: usize, faces: &[Vec<usize>]) -> Built {
    Soup::new(vertices, faces).build(&CUT).expect("a cut mesh")
}

/// The faces of a built mesh in the caller's order.
fn in_callers_order(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut faces = vec![Vec::new(); mesh.faces()];
    for (f, cycle) in kernel::faces(mesh).into_iter().enumerate() {
        faces[mesh.face_source(f)] = cycle;
    }
    faces
}

/// Sides that have a partner: edges with two sides, which run opposite ways.
fn paired_sides(faces: &[Vec<usize>]) -> usize {
    let side = |f: &Vec<usize>, i: usize| (f[i], f[(i + 1) % f.len()]);
    let all: Vec<_> = faces.iter().flat_map(|f| (0..f.len()).map(move |i| side(f, i))).collect();
    let paired = |&&(a, b): &&(usize, usize)| {
        let uses = |side: (usize, usize)| all.iter().filter(|&&s| s == side).count();
        uses((a, b)) == 1 && uses((b, a)) == 1
    };
    all.iter().filter(paired).count()
}

/// Everything that policy `cut` promises.
fn check_cut(vertices: usize, faces: &[Vec<usize>]) -> Mesh {
    let Built { mesh, vertex_source } = cut(vertices, faces);
    mesh.validate().expect("a valid mesh");
    let source = vertex_source.unwrap_or_else(|| (0..vertices as u32).collect());
    assert_eq!(source.len(), mesh.vertices());
    assert!(source[..vertices].iter().copied().eq(0..vertices as u32), "old vertices stay");
    assert!(source[vertices..].is_sorted(), "copies come by vertex");
    let rename = |f: &Vec<usize>| f.iter().map(|&v| source[v] as usize).collect();
    let renamed: Vec<Vec<usize>> = in_callers_order(&mesh).iter().map(rename).collect();
    assert_eq!(renamed, faces, "the map leads back to every face");
    // Nothing is torn but what had to be.
    assert_eq!(mesh.corners() - mesh.boundary_edges(), paired_sides(faces));
    check_cut_again(&mesh);
    mesh
}

/// Nothing is left to cut. Read back from its faces, a mesh may only have fewer
/// slits: two sides of a cut edge between the same two vertices close again.
fn check_cut_again(mesh: &Mesh) {
    let again = cut(mesh.vertices(), &kernel::faces(mesh));
    assert!(again.vertex_source.is_none(), "nothing is left to cut");
    assert_eq!(again.mesh.corner_vertices(), mesh.corner_vertices());
    let twins = again.mesh.corner_twins().iter().zip(mesh.corner_twins());
    assert!(twins.clone().all(|(after, before)| after == before || *before == NONE));
}

/// Two copies of a cube, `shared` vertices of the second being those of the first.
fn two_cubes(shared: &[(usize, usize)]) -> (usize, Vec<Vec<usize>>) {
    let cube = bases::cube();
    let mut number: Vec<usize> = (8..16).collect();
    for &(second, first) in shared {
        number[second] = first;
    }
    let mut used: Vec<usize> = (0..8).chain(number.iter().copied()).collect();
    used.sort_unstable();
    used.dedup();
    let rank = |v: usize| used.binary_search(&v).expect("a used vertex");
    let second = cube.faces.iter().map(|f| f.iter().map(|&v| rank(number[v])).collect());
    (used.len(), cube.faces.iter().cloned().chain(second).collect())
}

#[test]
fn cubes_that_share_an_edge_are_cut_apart() {
    // The edge runs opposite ways in the two, as it does in space.
    let (vertices, faces) = two_cubes(&[(0, 1), (1, 0)]);
    let kind = Error::from(
        Soup::new(vertices, &faces).build(&BuildOptions::default()).expect_err("four faces"),
    )
    .kind();
    assert_eq!(kind, ErrorKind::NonManifoldEdge);
    let mesh = check_cut(vertices, &faces);
    let survey = Survey::of(&mesh);
    // Each cube opens along its edge: a loop of two sides each, both ends copied.
    assert_eq!((survey.components, mesh.boundary_edges(), mesh.vertices()), (2, 4, 16));
}

#[test]
fn cubes_that_share_a_vertex_are_cut_apart() {
    let (vertices, faces) = two_cubes(&[(0, 3)]);
    let mesh = check_cut(vertices, &faces);
    assert_eq!(Survey::of(&mesh).components, 2);
    assert_eq!((mesh.vertices(), mesh.boundary_edges()), (16, 0));
    let source = cut(vertices, &faces).vertex_source.expect("one copy");
    assert_eq!(source[15..], [3], "the copy is the last and comes from vertex 3");
}

#[test]
fn a_moebius_strip_is_refused_and_cut_open() {
    let n = 5;
    let twisted = vec![n - 1, n, 0, 2 * n - 1];
    let quad = |i: usize| vec![i, i + 1, n + i + 1, n + i];
    let faces: Vec<_> = (0..n - 1).map(quad).chain([twisted]).collect();
    let refused = Soup::new(2 * n, &faces).build(&BuildOptions::default()).expect_err("one-sided");
    assert_eq!(Error::from(refused).kind(), ErrorKind::InconsistentOrientation);
    let survey = Survey::of(&check_cut(2 * n, &faces));
    assert_eq!((survey.components, survey.euler_characteristic), (1, 1), "a strip");
}

#[test]
fn three_pages_of_a_book_are_cut_apart() {
    let faces = [vec![0, 1, 2], vec![1, 0, 3], vec![0, 1, 4]];
    let mesh = check_cut(5, &faces);
    assert_eq!((mesh.vertices(), mesh.boundary_edges()), (9, 9));
}

#[test]
fn cut_cannot_repair_faces() {
    let list = defects(4, &[&[0, 1], &[0, 1, 2]], &CUT);
    assert_eq!(list, [Defect::FaceTooSmall { face: 0, size: 2 }]);
}

/// Any faces over few vertices: hardly ever manifold.
fn random_soups() -> impl Strategy<Value = (usize, Vec<Vec<usize>>)> {
    (4..12_usize, 0..16_usize, any::<u64>()).prop_map(|(vertices, faces, seed)| {
        let mut rng = Rng::new(seed);
        let mut face = || {
            let size = rng.between(3, vertices.min(6));
            rng.permutation(vertices)[..size].to_vec()
        };
        (vertices, (0..faces).map(|_| face()).collect())
    })
}

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn cut_repairs_any_soup_of_sound_faces((vertices, faces) in random_soups()) {
        check_cut(vertices, &faces);
        // The same repair with the work spread as far as it goes.
        let context = Context::builder().threads(2).chunk(1).build().expect("threads");
        let soup = Soup::new(vertices, &faces);
        let spread = build(&context, vertices, &soup.sizes, &soup.indices, &CUT).expect("cut");
        let serial = cut(vertices, &faces);
        prop_assert!(spread.mesh == serial.mesh && spread.vertex_source == serial.vertex_source);
    }

    /// What is accepted is a manifold, and what is a manifold is accepted.
    #[test]
    fn acceptance_is_the_brute_force_check((vertices, faces) in random_soups()) {
        let sound = crate::support::manifold::defects(vertices, &faces).is_empty();
        let built = Soup::new(vertices, &faces).build(&BuildOptions::default());
        prop_assert_eq!(built.is_ok(), sound);
    }
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn cut_leaves_manifolds_alone(control in meshes(Kind::Any)) {
        let built = cut(control.positions.len(), &control.faces);
        prop_assert!(built.vertex_source.is_none());
        prop_assert!(built.mesh == kernel::mesh(&control));
    }

    #[test]
    fn surveys_count_what_is_there(control in meshes(Kind::Any)) {
        let topo = Topology::new(control.positions.len(), &control.faces);
        let survey = Survey::of(&kernel::mesh(&control));
        prop_assert_eq!(survey.components, topo.components().len());
        prop_assert_eq!(survey.boundary_loops, topo.boundary_loops().len());
        prop_assert_eq!(survey.isolated_vertices, topo.isolated().len());
        prop_assert_eq!(survey.euler_characteristic, topo.euler_characteristic());
        let total = |histogram: &std::collections::BTreeMap<usize, usize>| -> usize {
            histogram.iter().map(|(size, n)| size * n).sum()
        };
        prop_assert_eq!(total(&survey.face_sizes), control.corner_count());
        let valences = total(&survey.interior_valences) + total(&survey.boundary_valences);
        prop_assert_eq!(valences, control.corner_count());
    }

    /// The flag is accepted exactly where the specification's clauses hold.
    #[test]
    fn anchored_is_accepted_where_the_oracle_says_so(mut control in meshes(Kind::Open)) {
        control.anchored = true;
        let options = BuildOptions { anchored: true, ..BuildOptions::default() };
        let built = Soup::new(control.positions.len(), &control.faces).build(&options);
        prop_assert_eq!(built.is_ok(), anchored_defect(&control).is_none());
    }
}

// ---------------------------------------------------------------- what is kept

#[test]
fn isolated_vertices_and_components_survive() {
    let mut control = bases::cube();
    generate::join(&mut control, &bases::grid(2, 1), [5.0, 0.0, 0.0]);
    control.positions.insert(0, [7.0, 8.0, 9.0]);
    control.faces.iter_mut().flatten().for_each(|v| *v += 1);
    control.positions.push([-1.0, 0.5, 0.25]);
    for boundary in MODES {
        let scheme = Scheme::three_point(1, 32, Rule::Cosine, boundary);
        let hierarchy = kernel::hierarchy(&control, &scheme, 2);
        let refined = kernel::refine::<f64>(&control, &scheme, 2);
        let made = kernel::poly_of(&refined);
        let survey = Survey::of(hierarchy.mesh(2));
        assert_eq!((survey.components, survey.isolated_vertices), (2, 2));
        // They come last, in their order, where they were.
        let last = made.positions.len() - 2;
        assert_eq!(made.positions[last..], [[7.0, 8.0, 9.0], [-1.0, 0.5, 0.25]]);
    }
}

#[test]
fn mixed_faces_come_irregular_first() {
    let faces: [&[usize]; 4] = [&[0, 1, 2, 3], &[3, 2, 4], &[4, 2, 5, 6, 7], &[8, 9, 10, 11]];
    let mesh = Soup::new(12, &faces).mesh(false);
    assert!(mesh.face_sizes().eq([3, 5, 4, 4]));
    assert_eq!(mesh.irregular_faces(), 2);
    let sources: Vec<_> = (0..4).map(|f| mesh.face_source(f)).collect();
    assert_eq!(sources, [1, 2, 0, 3]);
    for (f, source) in sources.into_iter().enumerate() {
        assert!(mesh.face_vertices(f).iter().map(|&v| v as usize).eq(faces[source].to_vec()));
    }
    // Triangles alone are regular, and stay where they are.
    let mesh = kernel::mesh(&bases::octahedron());
    assert_eq!(mesh.irregular_faces(), 0);
    assert!((0..8).all(|f| mesh.face_source(f) == f));
}

#[test]
fn surveys_of_known_meshes() {
    let survey = |mesh: &Poly<f64>| Survey::of(&kernel::mesh(mesh));
    let cube = survey(&bases::cube());
    assert_eq!((cube.components, cube.boundary_loops, cube.euler_characteristic), (1, 0, 2));
    assert_eq!(cube.face_sizes, [(4, 6)].into());
    assert_eq!(cube.interior_valences, [(3, 8)].into());
    assert!(cube.boundary_valences.is_empty());
    let torus = survey(&bases::torus(4, 4));
    assert_eq!((torus.euler_characteristic, torus.boundary_loops), (0, 0));
    let frame = survey(&bases::frame());
    assert_eq!((frame.euler_characteristic, frame.boundary_loops), (0, 2));
    assert_eq!(frame.boundary_valences, [(1, 4), (2, 8), (3, 4)].into());
    let prism = survey(&bases::prism(5));
    assert_eq!(prism.face_sizes, [(4, 5), (5, 2)].into());
    let nothing = Survey::of(&Soup::new::<Vec<usize>>(3, &[]).mesh(false));
    assert_eq!((nothing.components, nothing.isolated_vertices), (0, 3));
    assert_eq!(nothing.euler_characteristic, 0);
}

// ----------------------------------------------------------- anchored and tags

fn refused_by(mesh: &Poly<f64>, options: &BuildOptions) -> Error {
    let soup = Soup::new(mesh.positions.len(), &mesh.faces);
    soup.build(options).expect_err("a refused mesh").into()
}

#[test]
fn anchored_meshes_have_their_shape() {
    let options = BuildOptions { anchored: true, ..BuildOptions::default() };
    for mesh in [bases::grid(2, 2), bases::annulus(5, 2), bases::cube(), bases::annulus(3, 1)] {
        let soup = Soup::new(mesh.positions.len(), &mesh.faces);
        let accepted = soup.build(&options).is_ok();
        let sound = anchored_defect(&Poly { anchored: true, ..mesh.clone() }).is_none();
        assert_eq!(accepted, sound, "{:?}", mesh.faces);
    }
    assert!(Soup::new(9, &bases::grid(2, 2).faces).build(&options).is_ok());
    let refused = |mesh: &Poly<f64>| {
        let error = refused_by(mesh, &options);
        assert_eq!(error.kind(), ErrorKind::NotAnchored, "{error}");
        error.elements().to_vec()
    };
    // Three faces at a boundary vertex: where a corner of a grid is missing.
    let mut notched = bases::grid(4, 4);
    notched.faces.remove(0);
    assert_eq!(refused(&notched), [Vertex(6)]);
    // More than two boundary edges on a face.
    assert_eq!(refused(&bases::polygon(4)), [Face(0)]);
    assert_eq!(refused(&bases::polygon(6)), [Face(0)]);
    // Two that meet, but on a triangle.
    assert_eq!(refused(&bases::half_fan(2)), [Face(0)]);
    // Two that do not meet: the middle of a strip, closed so that no end is worse.
    assert_eq!(refused(&bases::annulus(5, 1)), [Face(0)]);
}

/// The refusal names the caller's face, though quads come last in the mesh.
#[test]
fn anchored_refusals_name_the_callers_face() {
    let mut mesh = bases::grid(2, 2);
    generate::join(&mut mesh, &bases::half_fan(2), [5.0, 0.0, 0.0]);
    let options = BuildOptions { anchored: true, ..BuildOptions::default() };
    assert_eq!(refused_by(&mesh, &options).elements(), [Face(4)]);
}

#[test]
fn tags_must_name_boundary_vertices() {
    let mut grid = bases::grid(2, 2);
    grid.positions.push([0.0; 3]);
    let refused = |tags: &[u32], anchored| {
        let options = BuildOptions { corner_tags: tags, anchored, ..BuildOptions::default() };
        let error = refused_by(&grid, &options);
        assert_eq!(error.kind(), ErrorKind::InvalidTag, "{error}");
        error.elements().to_vec()
    };
    assert_eq!(refused(&[0, 10], false), [Vertex(10)], "no such vertex");
    assert_eq!(refused(&[NONE], false), [Vertex(u64::from(NONE))], "no such vertex");
    assert_eq!(refused(&[1, 4], false), [Vertex(4)], "an interior vertex");
    assert_eq!(refused(&[9], false), [Vertex(9)], "an isolated vertex");
    assert_eq!(refused(&[1], true), [Vertex(1)], "an anchored mesh carries no tags");
}

#[test]
fn tags_are_sorted_and_follow_copies() {
    let tags = [7, 1, 7, 3];
    let options = BuildOptions { corner_tags: &tags, ..BuildOptions::default() };
    let grid = bases::grid(2, 2);
    let mesh = Soup::new(9, &grid.faces).build(&options).expect("a grid").mesh;
    assert_eq!(mesh.corner_tags(), [1, 3, 7]);
    let bow_tie: [&[usize]; 2] = [&[0, 1, 2], &[0, 3, 4]];
    let options = BuildOptions { corner_tags: &[0], ..CUT };
    let built = Soup::new(5, &bow_tie).build(&options).expect("cut apart");
    assert_eq!(built.mesh.corner_tags(), [0, 5]);
}

// --------------------------------------------------------------- extreme shapes

/// Generous: unoptimised builds on busy machines pass with room to spare, a
/// quadratic search for every corner of every level does not.
const REASONABLE: Duration = Duration::from_secs(30);

fn check_extreme(mesh: &Poly<f64>, boundary: Boundary) {
    let begun = Instant::now();
    let scheme = Scheme::doo_sabin(Rule::Average, boundary);
    let hierarchy = kernel::hierarchy(mesh, &scheme, 2);
    hierarchy.mesh(2).validate().expect("a valid mesh");
    let refined = kernel::refine::<f32>(mesh, &scheme, 1);
    assert_eq!(refined.positions.len(), 3 * hierarchy.mesh(1).vertices());
    let took = begun.elapsed();
    assert!(took < REASONABLE, "{} faces took {took:?}", mesh.faces.len());
}

#[test]
fn hubs_of_five_thousand_faces_are_refined() {
    check_extreme(&bases::bipyramid(5000), Boundary::EdgeCorner);
    check_extreme(&bases::half_fan(5000), Boundary::EdgeCorner);
}

#[test]
fn faces_of_two_thousand_sides_are_refined() {
    check_extreme(&bases::pyramid(2000), Boundary::EdgeCorner);
    check_extreme(&bases::polygon(2000), Boundary::None);
}
