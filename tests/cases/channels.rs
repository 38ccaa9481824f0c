//! Face-varying values on the cases: texture coordinates with seams in every mode.

use carvel::base::Scalar;
use carvel::hierarchy::{FaceVarying, RefinedChannel};
use carvel::mesh::{Built, NonManifold};
use carvel::refine::FaceOrigin;
use carvel::{Boundary, Refined, Refiner, Scheme, Task};
use carvel::{Channel, Context, ErrorKind, FaceVaryingMode, Hierarchy, Mesh, Prediction};

use crate::accepted::{built, meshes, positions};
use crate::case::{Case, NONE};
use crate::refined::{bits, two_threads};
use crate::schemes::Named;
use crate::tolerance::ROUNDING;

const LEVELS: u32 = 2;
const MODES: [FaceVaryingMode; 6] = [
    FaceVaryingMode::Smooth,
    FaceVaryingMode::Corners,
    FaceVaryingMode::CornersPlus1,
    FaceVaryingMode::CornersPlus2,
    FaceVaryingMode::Boundaries,
    FaceVaryingMode::All,
];

/// The schemes with rules for seams that can refine a case.
fn schemes(case: &Case) -> Vec<Scheme> {
    let mut schemes = vec![Scheme::catmull_clark(), Scheme::bilinear()];
    if case.is_triangles() {
        schemes.push(Scheme::loop_triangles());
    }
    schemes
}

/// A channel on a mesh with its values, refined with the mesh.
struct Textured<'a> {
    mesh: &'a Mesh,
    channel: &'a Channel,
    scheme: &'a Scheme,
}

impl Textured<'_> {
    fn refine<T: Scalar>(
        &self,
        context: &Context,
        levels: u32,
        values: &[T],
        width: usize,
    ) -> (Refined<T>, RefinedChannel<T>) {
        let zeros = vec![T::default(); 3 * self.mesh.vertices()];
        self.refine_with(context, levels, &zeros, values, width)
    }

    fn refine_with<T: Scalar>(
        &self,
        context: &Context,
        levels: u32,
        positions: &[T],
        values: &[T],
        width: usize,
    ) -> (Refined<T>, RefinedChannel<T>) {
        let channels = [FaceVarying { channel: self.channel, values, width }];
        let task = Task::new(self.mesh, self.scheme, levels, positions);
        let task = Task { channels: &channels, ..task };
        let mut refined = Refiner::new().refine(context, &task).expect("a small refinement");
        let channel = refined.channels.pop().expect("one channel");
        (refined, channel)
    }
}

/// Calls `check` with every textured case under every scheme, boundary rule and mode.
fn each_textured(mut check: impl FnMut(&Case, &Textured, &str)) {
    let mut count = 0;
    for (case, built) in meshes() {
        if case.uvs.is_empty() || case.uv_indices.contains(&NONE) {
            continue;
        }
        count += 1;
        for scheme in schemes(&case) {
            for &boundary in Named::boundaries(&built.mesh) {
                let scheme = scheme.clone().with_boundary(boundary);
                for mode in MODES {
                    let (mesh, uvs) = (&built.mesh, case.uvs.len());
                    let channel = Channel::new(mesh, &case.uv_indices, uvs, mode);
                    let channel = &channel.unwrap_or_else(|e| panic!("{}: {e}", case.name));
                    let what = format!("{} under {scheme:?}, {mode:?}", case.name);
                    check(&case, &Textured { mesh, channel, scheme: &scheme }, &what);
                }
            }
        }
    }
    assert!(count >= 12, "textured cases are missing: {count} found");
}

fn uvs<T: Scalar>(case: &Case) -> Vec<T> {
    case.uvs.as_flattened().iter().map(|&x| T::from_f64(x)).collect()
}

/// The value of every corner, one after the other.
fn by_corner<T: Copy>(channel: &RefinedChannel<T>, width: usize) -> Vec<T> {
    let value = |&i: &u32| &channel.values[i as usize * width..][..width];
    channel.indices.iter().flat_map(value).copied().collect()
}

fn assert_near(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    for (i, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= ROUNDING * scale, "{what}: value {i} is {a}, not {b}");
    }
}

// ----------------------------------------------------------------- sizes and bytes

fn check_bytes<T: Scalar>(case: &Case, textured: &Textured, what: &str) {
    let values = uvs::<T>(case);
    let (_, serial) = textured.refine(&Context::serial(), LEVELS, &values, 2);
    let (_, threads) = textured.refine(two_threads(), LEVELS, &values, 2);
    assert_eq!(serial.indices, threads.indices, "{what}");
    assert_eq!(bits(&serial.values), bits(&threads.values), "{what}");
    let plan = Prediction::of_channel(textured.channel, textured.scheme, LEVELS);
    let plan = *plan.unwrap_or_else(|e| panic!("{what}: {e}")).last();
    let found = [serial.indices.len(), serial.values.len() / 2].map(|n| n as u64);
    assert_eq!(found, [plan.corners, plan.vertices], "{what}");
    assert!(serial.values.iter().all(|x| x.is_finite()), "{what}");
    let mut taken = vec![false; serial.values.len() / 2];
    serial.indices.iter().for_each(|&i| taken[i as usize] = true);
    assert!(taken.iter().all(|&taken| taken), "{what}: a value that no corner takes");
}

#[test]
fn values_are_as_many_as_predicted_and_the_same_on_any_threads() {
    each_textured(|case, textured, what| {
        check_bytes::<f64>(case, textured, what);
        check_bytes::<f32>(case, textured, what);
    });
}

/// Level 0 gives back what came in, whether a corner takes it or not.
#[test]
fn no_step_is_a_copy() {
    each_textured(|case, textured, what| {
        let values = uvs::<f64>(case);
        let (_, channel) = textured.refine(&Context::serial(), 0, &values, 2);
        assert_eq!(channel.values, values, "{what}");
        assert_eq!(channel.indices, taken(case, textured.mesh), "{what}");
    });
}

// --------------------------------------------------------------------------- seams

/// The value that each corner of the mesh takes, in the mesh's order of faces.
fn taken(case: &Case, mesh: &Mesh) -> Vec<u32> {
    let first = |face: usize| case.sizes[..face].iter().map(|&n| n as usize).sum::<usize>();
    let of = |f: usize| {
        let face = mesh.face_source(f);
        case.uv_indices[first(face)..][..case.sizes[face] as usize].to_vec()
    };
    (0..mesh.faces()).flat_map(of).collect()
}

/// For each corner of level 1 the values of its parents, which are at a vertex or at both
/// ends of an edge; none for the middle of a face.
fn parents(case: &Case, hierarchy: &Hierarchy) -> Vec<Vec<u32>> {
    let mesh = hierarchy.mesh(0);
    let taken = taken(case, mesh);
    let face_of = |c: usize| {
        let face = (0..mesh.faces()).find(|&f| mesh.face_corners(f).contains(&c));
        mesh.face_corners(face.expect("a corner of a face"))
    };
    let edge = |c: usize| {
        let face = face_of(c);
        let next = if c + 1 == face.end { face.start } else { c + 1 };
        let mut ends = vec![taken[c], taken[next]];
        ends.sort_unstable();
        ends
    };
    let before = |c: usize| {
        let face = face_of(c);
        if c == face.start { face.end - 1 } else { c - 1 }
    };
    let mut keys = Vec::new();
    let origins = hierarchy.face_origins(1).expect("a level that was built");
    for (child, origin) in origins.into_iter().enumerate() {
        match origin {
            FaceOrigin::Corner(c) => {
                let c = c as usize;
                keys.extend([vec![taken[c]], edge(c)]);
                if hierarchy.mesh(1).face_corners(child).len() == 4 {
                    keys.push(Vec::new());
                }
                keys.push(edge(before(c)));
            }
            FaceOrigin::Face(f) => {
                keys.extend(mesh.face_corners(f as usize).map(|c| edge(before(c))));
            }
            other => panic!("{other:?} of a primal split"),
        }
    }
    keys
}

/// Two corners of one vertex share a value exactly if all their parents do.
#[test]
fn seams_stay_where_they_are() {
    each_textured(|case, textured, what| {
        let context = Context::serial();
        let (mesh, scheme) = (textured.mesh.clone(), textured.scheme.clone());
        let hierarchy = Hierarchy::new(&context, mesh, scheme, 1).expect("a small mesh");
        let keys = parents(case, &hierarchy);
        let (_, channel) = textured.refine(&context, 1, &uvs::<f64>(case), 2);
        let vertices = hierarchy.mesh(1).corner_vertices();
        for (a, b) in (0..keys.len()).flat_map(|a| (0..a).map(move |b| (a, b))) {
            let shared = vertices[a] == vertices[b] && keys[a] == keys[b];
            let found = channel.indices[a] == channel.indices[b];
            assert_eq!(found, shared, "{what}: corners {a} and {b}");
        }
    });
}

// --------------------------------------------------------------------------- values

/// The rules at level 1 can be read off the mesh of level 1 where nothing is semi-sharp.
#[test]
fn two_levels_at_once_are_one_level_twice() {
    each_textured(|case, textured, what| {
        if case.is_sharp() {
            return;
        }
        let (context, values) = (Context::serial(), uvs::<f64>(case));
        let (_, at_once) = textured.refine(&context, 2, &values, 2);
        let (refined, once) = textured.refine(&context, 1, &values, 2);
        let vertices = refined.positions.len() / 3;
        let mesh = Mesh::from_polygons(vertices, &refined.face_sizes, &refined.face_vertices);
        let mesh = mesh.unwrap_or_else(|e| panic!("{what}: {e}"));
        let (count, mode) = (once.values.len() / 2, textured.channel.mode());
        let channel = Channel::new(&mesh, &once.indices, count, mode).expect("a channel");
        let again = Textured { mesh: &mesh, channel: &channel, scheme: textured.scheme };
        let (_, twice) = again.refine(&context, 1, &once.values, 2);
        assert_near(&by_corner(&twice, 2), &by_corner(&at_once, 2), what);
    });
}

#[test]
fn constants_stay_and_affine_maps_commute() {
    let map = |uv: &[f64]| [2.0 * uv[0] - uv[1] + 0.5, 0.25 * uv[0] + uv[1] - 3.0, 7.0];
    each_textured(|case, textured, what| {
        let (context, values) = (Context::serial(), uvs::<f64>(case));
        let (_, plain) = textured.refine(&context, LEVELS, &values, 2);
        let mapped: Vec<f64> = values.chunks(2).flat_map(map).collect();
        let (_, moved) = textured.refine(&context, LEVELS, &mapped, 3);
        let expected: Vec<f64> = plain.values.chunks(2).flat_map(map).collect();
        assert_eq!(plain.indices, moved.indices, "{what}");
        assert_near(&moved.values, &expected, what);
    });
}

/// Modes under which a channel without seams follows the vertices of a mesh.
fn smooth_modes(mesh: &Mesh) -> &'static [FaceVaryingMode] {
    if mesh.is_closed() { &MODES[..5] } else { &MODES[..4] }
}

fn check_positions(case: &Case, built: &Built, scheme: &Scheme) {
    let (mesh, places) = (&built.mesh, positions::<f64>(case, built));
    // The mesh's own order of corners is not the caller's.
    let source = |v: u32| built.vertex_source.as_ref().map_or(v, |source| source[v as usize]);
    let mut indices = case.indices.clone();
    let mut offsets = vec![0];
    offsets.extend(case.sizes.iter().scan(0, |sum, &n| {
        *sum += n as usize;
        Some(*sum)
    }));
    for f in 0..mesh.faces() {
        for (slot, &v) in
            indices[offsets[mesh.face_source(f)]..].iter_mut().zip(mesh.face_vertices(f))
        {
            assert_eq!(*slot, source(v), "{}", case.name);
            *slot = v;
        }
    }
    for &mode in smooth_modes(mesh) {
        let what = format!("{} under {scheme:?}, {mode:?}", case.name);
        let channel = Channel::new(mesh, &indices, mesh.vertices(), mode).expect("a channel");
        assert_eq!(channel.seam_edges(mesh), 0, "{what}");
        let textured = Textured { mesh, channel: &channel, scheme };
        let context = Context::serial();
        let (refined, values) = textured.refine_with(&context, LEVELS, &places, &places, 3);
        let expected = refined.face_vertices.iter();
        let expected = expected.flat_map(|&v| &refined.positions[3 * v as usize..][..3]);
        let expected: Vec<f64> = expected.copied().collect();
        assert_eq!(bits(&by_corner(&values, 3)), bits(&expected), "{what}");
    }
}

#[test]
fn positions_without_seams_are_refined_as_positions() {
    for (case, built) in meshes() {
        // Coordinates that some scheme cannot refine are another test's.
        if case.name.starts_with("numbers/") || case.name.starts_with("refused/infinity") {
            continue;
        }
        if positions::<f64>(&case, &built).iter().any(|x| !x.is_finite()) {
            continue;
        }
        for scheme in schemes(&case) {
            check_positions(&case, &built, &scheme.with_boundary(Boundary::EdgeAndCorner));
        }
    }
}

// ---------------------------------------------------------------------------- errors

#[test]
fn channels_that_do_not_fit_are_refused() {
    let case = crate::cases().into_iter().find(|case| case.name == "uv/missing");
    let case = case.expect("a case with corners that have no value");
    let mesh = built(&case, NonManifold::Error).expect("a sound mesh").mesh;
    let mode = FaceVaryingMode::default();
    let missing = Channel::new(&mesh, &case.uv_indices, case.uvs.len(), mode).unwrap_err();
    assert_eq!(missing.kind(), ErrorKind::IndexOutOfRange);
    let corner = case.uv_indices.iter().position(|&i| i == NONE).expect("a corner without");
    let ends = case.sizes.iter().scan(0, |sum, &n| {
        *sum += n as usize;
        Some(*sum)
    });
    let face = ends.take_while(|&end| end <= corner).count();
    assert!(missing.to_string().starts_with(&format!("face {face} names")), "{missing}");
    let short = Channel::new(&mesh, &case.uv_indices[1..], case.uvs.len(), mode).unwrap_err();
    assert_eq!(short.kind(), ErrorKind::LengthMismatch);
}
