//! Face-varying values beside seams of a grid, under every mode: whole numbers go in, so
//! that what comes out is exact.

use carvel::hierarchy::{ChannelOutput, FaceVarying, RefinedChannel};
use carvel::scheme::Creasing;
use carvel::{Boundary, Channel, Context, ErrorKind, FaceVaryingMode, Fraction, Mesh};
use carvel::{Output, Prediction, Refiner, Scheme, Task};

use crate::control::Control;

use FaceVaryingMode::{All, Boundaries, Corners, CornersPlus1, CornersPlus2, Smooth};

const MODES: [FaceVaryingMode; 6] = [Smooth, Corners, CornersPlus1, CornersPlus2, Boundaries, All];

/// A grid of 4 by 4 quads whose values are those of the vertices, but for some corners.
#[derive(Clone)]
struct Textured {
    control: Control,
    indices: Vec<u32>,
    scheme: Scheme,
}

fn grid() -> Textured {
    let control = Control::grid(4, 4);
    let indices = control.indices();
    Textured { control, indices, scheme: Scheme::catmull_clark() }
}

impl Textured {
    /// Other values at some vertices of some faces: 30 more, and so on for each island.
    fn island(mut self, faces: &[usize], vertices: &[u32]) -> Self {
        let more = 30 * (1 + self.indices.iter().max().unwrap() / 30);
        for &f in faces {
            for slot in &mut self.indices[4 * f..4 * f + 4] {
                *slot += if vertices.contains(slot) { more } else { 0 };
            }
        }
        self
    }

    fn with(mut self, scheme: Scheme) -> Self {
        self.scheme = scheme;
        self
    }

    fn crease(mut self, ends: [u32; 2], sharpness: f32) -> Self {
        self.control = self.control.crease(ends, sharpness);
        self
    }

    fn sharp(mut self, vertex: u32, sharpness: f32) -> Self {
        self.control = self.control.sharp(vertex, sharpness);
        self
    }

    fn refine(&self, mode: FaceVaryingMode, levels: u32) -> RefinedChannel<f64> {
        refine(&self.control.mesh(), &self.indices, &self.scheme, mode, levels)
    }

    /// Value of the corner of a face at a vertex after a step.
    fn at(&self, mode: FaceVaryingMode, face: usize, vertex: u32) -> f64 {
        let refined = self.refine(mode, 1);
        refined.values[refined.indices[4 * self.corner(face, vertex)] as usize]
    }

    /// Value on the edge that leaves a vertex in a face, after a step.
    fn on_edge(&self, mode: FaceVaryingMode, face: usize, vertex: u32) -> f64 {
        let refined = self.refine(mode, 1);
        refined.values[refined.indices[4 * self.corner(face, vertex) + 1] as usize]
    }

    fn corner(&self, face: usize, vertex: u32) -> usize {
        4 * face + self.control.faces[face].iter().position(|&v| v == vertex).unwrap()
    }
}

/// The value of an index: nothing that any rule would give by chance.
fn x(index: u32) -> f64 {
    f64::from(index * index * 37 % 101) * 64.0
}

fn refine(
    mesh: &Mesh,
    indices: &[u32],
    scheme: &Scheme,
    mode: FaceVaryingMode,
    levels: u32,
) -> RefinedChannel<f64> {
    let values: Vec<f64> = (0..200).map(x).collect();
    let channel = Channel::new(mesh, indices, values.len(), mode).expect("a channel");
    let positions = vec![0.0; 3 * mesh.vertices()];
    let channels = [FaceVarying { channel: &channel, values: &values, width: 1 }];
    let task = Task { channels: &channels, ..Task::new(mesh, scheme, levels, &positions) };
    let mut refined = Refiner::new().refine(&Context::serial(), &task).expect("a refinement");
    refined.channels.remove(0)
}

fn crease(own: u32, ends: [u32; 2]) -> f64 {
    0.75 * x(own) + 0.125 * (x(ends[0]) + x(ends[1]))
}

fn mean(a: u32, b: u32) -> f64 {
    0.5 * (x(a) + x(b))
}

/// A seam down the middle: the right faces have values of their own along 2, 7, 12, 17, 22.
fn halves() -> Textured {
    let right = [2, 3, 6, 7, 10, 11, 14, 15];
    grid().island(&right, &[2, 7, 12, 17, 22])
}

const LEFT: usize = 5;
const RIGHT: usize = 6;

#[track_caller]
fn check(textured: &Textured, (face, vertex): (usize, u32), expected: [f64; 6], what: &str) {
    let found = MODES.map(|mode| textured.at(mode, face, vertex));
    assert_eq!(found, expected, "{what}: face {face} at {vertex}");
}

/// The same under the four modes with curved boundaries, nothing under the others.
#[track_caller]
fn check_curved(textured: &Textured, place: (usize, u32), curved: f64, own: u32, what: &str) {
    let [c, o] = [curved, x(own)];
    check(textured, place, [c, c, c, c, o, o], what);
}

// ------------------------------------------------------------------------------- seams

#[test]
fn seams_are_curves_of_their_own() {
    let halves = halves();
    check_curved(&halves, (LEFT, 12), crease(12, [7, 17]), 12, "left");
    check_curved(&halves, (RIGHT, 12), crease(42, [37, 47]), 42, "right");
    for mode in MODES {
        assert_eq!(halves.on_edge(mode, LEFT, 7), mean(7, 12), "{mode:?}");
        assert_eq!(halves.on_edge(mode, RIGHT, 12), mean(37, 42), "{mode:?}");
    }
}

#[test]
fn values_off_the_seams_are_smooth() {
    let halves = halves();
    let smooth = |own: u32, sides: [u32; 4], corners: [u32; 4]| {
        let sum = |list: [u32; 4]| list.map(x).iter().sum::<f64>();
        (36.0 * x(own) + 6.0 * sum(sides) + sum(corners)) / 64.0
    };
    let left = smooth(6, [1, 5, 7, 11], [0, 2, 10, 12]);
    let right = smooth(8, [3, 37, 9, 13], [32, 4, 42, 14]);
    check(&halves, (0, 6), [left, left, left, left, left, x(6)], "left");
    check(&halves, (3, 8), [right, right, right, right, right, x(8)], "right");
    let edge = (6.0 * (x(6) + x(7)) + x(1) + x(2) + x(11) + x(12)) / 16.0;
    assert_eq!(halves.on_edge(Corners, LEFT, 6), edge);
    assert_eq!(halves.on_edge(Boundaries, LEFT, 6), edge);
    assert_eq!(halves.on_edge(All, LEFT, 6), mean(6, 7));
}

#[test]
fn boundaries_are_curves_but_under_linear_modes() {
    let grid = grid();
    check_curved(&grid, (0, 1), crease(1, [0, 2]), 1, "a side");
    check(&grid, (0, 0), [x(0); 6], "a corner that the boundary mode keeps");
    let edge = grid.with(Scheme::catmull_clark().with_boundary(Boundary::Edge));
    let round = crease(0, [1, 5]);
    check(&edge, (0, 0), [round, x(0), x(0), x(0), x(0), x(0)], "a corner");
    check_curved(&edge, (0, 1), crease(1, [0, 2]), 1, "a side");
}

#[test]
fn ends_of_seams_at_the_boundary_are_corners() {
    let (left, right) = (crease(2, [1, 7]), crease(32, [3, 37]));
    check(&halves(), (1, 2), [left, x(2), x(2), x(2), x(2), x(2)], "left");
    check(&halves(), (2, 2), [right, x(32), x(32), x(32), x(32), x(32)], "right");
}

#[test]
fn ends_of_seams_inside_are_darts() {
    // The seam goes from 2 over 7 to 12, where both sides have the same value.
    let dart = grid().island(&[2, 6], &[2, 7]);
    let rounded = crease(12, [7, 37]);
    for face in [5, 6, 9, 10] {
        check(&dart, (face, 12), [rounded, rounded, rounded, x(12), x(12), x(12)], "the end");
    }
}

#[test]
fn a_value_of_one_face_is_a_corner() {
    // The corner of face 6 at 12 is torn off: one face has it, three have the other value.
    let torn = grid().island(&[6], &[12]);
    let (one, three) = (crease(42, [7, 13]), crease(12, [7, 13]));
    check(&torn, (6, 12), [one, x(42), x(42), x(42), x(42), x(42)], "one");
    check(&torn, (5, 12), [three, three, three, x(12), x(12), x(12)], "three");
}

#[test]
fn three_values_are_corners_where_the_mode_says_so() {
    let three = halves().island(&[10], &[42]);
    let two_faces = crease(12, [7, 17]);
    check(&three, (LEFT, 12), [two_faces, two_faces, x(12), x(12), x(12), x(12)], "two faces");
    let one_face = crease(42, [37, 13]);
    check(&three, (RIGHT, 12), [one_face, x(42), x(42), x(42), x(42), x(42)], "one face");
}

#[test]
fn values_in_several_pieces_stay() {
    let sectors = grid().island(&[6, 9], &[12]);
    check(&sectors, (5, 12), [x(12); 6], "the first");
    check(&sectors, (6, 12), [x(42); 6], "the second");
}

#[test]
fn seams_at_sharp_vertices_and_edges() {
    let sharp = halves().sharp(12, 10.0);
    check(&sharp, (LEFT, 12), [x(12); 6], "an infinitely sharp vertex");
    // An infinitely sharp edge inside a run cuts it; with `CornersPlus1` both stay.
    let cut = halves().crease([12, 13], 10.0);
    check(&cut, (RIGHT, 12), [x(42); 6], "cut");
    let left = crease(12, [7, 17]);
    check(&cut, (LEFT, 12), [left, left, x(12), x(12), x(12), x(12)], "beside the cut");
    // A crease along the seam changes nothing.
    let along = halves().crease([7, 12], 10.0).crease([12, 17], 10.0);
    check_curved(&along, (LEFT, 12), left, 12, "along");
}

/// A corner rule's part of the way to a crease.
fn part(weight: f64, own: u32, ends: [u32; 2]) -> f64 {
    weight * x(own) + (1.0 - weight) * crease(own, ends)
}

#[test]
fn semi_sharp_edges_inside_a_run_hold_it_back() {
    let half = halves().crease([12, 13], 0.5);
    check_curved(&half, (RIGHT, 12), part(0.5, 42, [37, 47]), 42, "its own run");
    // With `CornersPlus1` and more the other value waits as well.
    let (free, waits) = (crease(12, [7, 17]), part(0.5, 12, [7, 17]));
    check(&half, (LEFT, 12), [free, free, waits, waits, x(12), x(12)], "the other run");
    let lasting = halves().crease([12, 13], 1.5);
    check(&lasting, (RIGHT, 12), [x(42); 6], "as long as it is sharp");
    check(&lasting, (LEFT, 12), [free, free, x(12), x(12), x(12), x(12)], "the other run");
    let both = halves().crease([12, 13], 0.25).crease([11, 12], 0.75);
    check_curved(&both, (RIGHT, 12), part(0.25, 42, [37, 47]), 42, "the right");
    check_curved(&both, (LEFT, 12), part(0.75, 12, [7, 17]), 12, "the left");
    let vertex = halves().sharp(12, 0.25);
    check_curved(&vertex, (RIGHT, 12), part(0.25, 42, [37, 47]), 42, "a sharp vertex");
    let lasting = halves().sharp(12, 1.0);
    check_curved(&lasting, (RIGHT, 12), x(42), 42, "a sharp vertex that lasts");
}

#[test]
fn chaikin_creasing_holds_runs_back_as_well() {
    let scheme = Scheme::catmull_clark().with_creasing(Creasing::Chaikin);
    let both = halves().crease([12, 13], 1.25).crease([11, 12], 0.25).with(scheme);
    // 15/16 + 1/16 − 1: both end; sharpness beyond 1 counts as 1.
    check_curved(&both, (RIGHT, 12), x(42), 42, "the right");
    check_curved(&both, (LEFT, 12), part(0.25, 12, [7, 17]), 12, "the left");
}

/// Values around 12 at level 1, and its value at level 2, left and right.
fn second(textured: &Textured, mode: FaceVaryingMode) -> [([f64; 3], f64); 2] {
    let (first, second) = (textured.refine(mode, 1), textured.refine(mode, 2));
    [[5, 9], [6, 10]].map(|faces| {
        let [upper, lower] = faces.map(|face| textured.corner(face, 12));
        let value = |corner: usize| first.values[first.indices[corner] as usize];
        // The seam's edge leaves 12 in one of the faces and comes to it in the other.
        let near = |corner: usize, other: u32| {
            let face = corner / 4;
            let next = textured.control.faces[face][(corner + 1) % 4];
            value(4 * corner + if next == other { 1 } else { 3 })
        };
        let values = [value(4 * upper), near(upper, 7), near(lower, 17)];
        (values, second.values[second.indices[16 * upper] as usize])
    })
}

#[track_caller]
fn check_second(textured: &Textured, mode: FaceVaryingMode, weights: [f64; 2]) {
    for (([own, a, b], found), weight) in second(textured, mode).into_iter().zip(weights) {
        let curve = 0.75 * own + 0.125 * (a + b);
        assert_eq!(found, weight * own + (1.0 - weight) * curve, "{mode:?}");
    }
}

#[test]
fn each_step_takes_one_off_inside_a_run() {
    for mode in [Smooth, Corners] {
        check_second(&halves(), mode, [0.0, 0.0]);
        check_second(&halves().crease([12, 13], 0.5), mode, [0.0, 0.0]);
        check_second(&halves().crease([12, 13], 1.5), mode, [0.0, 0.5]);
        check_second(&halves().crease([12, 13], 2.5), mode, [0.0, 1.0]);
        check_second(&halves().sharp(12, 1.5), mode, [0.5, 0.5]);
        check_second(&halves().crease([12, 13], 1.5).crease([11, 12], 0.5), mode, [0.0, 0.5]);
    }
    for mode in [CornersPlus1, CornersPlus2] {
        check_second(&halves().crease([12, 13], 0.5), mode, [0.0, 0.0]);
        check_second(&halves().crease([12, 13], 1.5), mode, [0.5, 0.5]);
        check_second(&halves().crease([12, 13], 2.5), mode, [1.0, 1.0]);
        check_second(&halves().sharp(12, 1.5), mode, [0.5, 0.5]);
    }
    for mode in [Boundaries, All] {
        check_second(&halves(), mode, [1.0, 1.0]);
    }
}

// ------------------------------------------------------------------------------ schemes

#[test]
fn triangles_have_the_same_seams() {
    let mut cut = grid().with(Scheme::loop_triangles());
    cut.control = Control::grid(4, 4).cut();
    cut.indices = cut.control.indices();
    // The right half has values of its own along the seam.
    for (c, slot) in cut.indices.iter_mut().enumerate() {
        let right = (c / 6) % 4 > 1;
        *slot += if right && *slot % 5 == 2 { 30 } else { 0 };
    }
    for mode in [Smooth, Corners, CornersPlus1, CornersPlus2] {
        let refined = cut.refine(mode, 1);
        let value = |face: usize, vertex: u32| {
            let at = cut.control.faces[face].iter().position(|&v| v == vertex).unwrap();
            refined.values[refined.indices[12 * face + 3 * at] as usize]
        };
        // Faces 10 and 11 are halves of the quad left of 7 and 12, 12 and 13 of the right.
        assert_eq!(value(10, 12), crease(12, [7, 17]), "{mode:?}");
        assert_eq!(value(13, 12), crease(42, [37, 47]), "{mode:?}");
    }
    assert!(cut.refine(All, 1).values[..30].iter().all(|v| (0..200).any(|i| x(i) == *v)));
}

#[test]
fn bilinear_refinement_is_linear_in_every_mode() {
    let halves = halves().with(Scheme::bilinear());
    check(&halves, (LEFT, 12), [x(12); 6], "a seam");
    check(&halves, (0, 6), [x(6); 6], "no seam");
    assert_eq!(halves.on_edge(Smooth, LEFT, 6), mean(6, 7));
    let center = halves.refine(Smooth, 1);
    let found = center.values[center.indices[4 * 4 * RIGHT + 2] as usize];
    assert_eq!(found, (x(37) + x(8) + x(13) + x(42)) / 4.0);
}

#[test]
fn other_schemes_refuse_channels() {
    let grid = grid();
    let (mesh, values) = (grid.control.mesh(), [0.0; 200]);
    let channel = Channel::new(&mesh, &grid.indices, 200, Corners).unwrap();
    let positions = vec![0.0; 75];
    let channels = [FaceVarying { channel: &channel, values: &values, width: 1 }];
    let passes = Scheme::primal(&[Fraction::HALF]).unwrap();
    for scheme in [Scheme::doo_sabin(), Scheme::quartic(), passes] {
        let task = Task { channels: &channels, ..Task::new(&mesh, &scheme, 1, &positions) };
        let error = Refiner::new().refine(&Context::serial(), &task).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported, "{error}");
        assert!(error.to_string().contains("face-varying values belong to"), "{error}");
        let none = Task { levels: 0, ..task };
        let copied = Refiner::new().refine(&Context::serial(), &none).unwrap();
        assert_eq!(copied.channels[0].indices, grid.indices);
    }
}

#[test]
fn channels_and_outputs_of_other_sizes_are_refused() {
    let grid = grid();
    let (mesh, other) = (grid.control.mesh(), Control::grid(2, 8).mesh());
    let triangles = Control::grid(4, 2).cut().mesh();
    let few = Channel::new(&mesh, &grid.indices[1..], 25, Corners).unwrap_err();
    assert_eq!(few.kind(), ErrorKind::LengthMismatch);
    let beyond = Channel::new(&mesh, &grid.indices, 24, Corners).unwrap_err();
    assert_eq!(beyond.kind(), ErrorKind::IndexOutOfRange);
    assert!(beyond.to_string().contains("face 15 names value 24 of 24"), "{beyond}");
    let channel = Channel::new(&mesh, &grid.indices, 25, Corners).unwrap();
    let scheme = Scheme::catmull_clark();
    let refused = |mesh: &Mesh, values: &[f64]| {
        let positions = vec![0.0; 3 * mesh.vertices()];
        let channels = [FaceVarying { channel: &channel, values, width: 1 }];
        let task = Task { channels: &channels, ..Task::new(mesh, &scheme, 1, &positions) };
        Refiner::new().refine(&Context::serial(), &task).err().map(|error| error.kind())
    };
    assert_eq!(refused(&mesh, &[0.0; 25]), None);
    assert_eq!(refused(&mesh, &[0.0; 24]), Some(ErrorKind::LengthMismatch));
    assert_eq!(refused(&mesh, &[f64::NAN; 25]), Some(ErrorKind::NotFinite));
    assert_eq!(refused(&triangles, &[0.0; 25]), Some(ErrorKind::LengthMismatch));
    // As many faces and corners, but other vertices.
    assert_eq!(refused(&other, &[0.0; 25]), Some(ErrorKind::LengthMismatch));
    let plan = *Prediction::of_channel(&channel, &scheme, 1).unwrap().last();
    let into = |indices: u64, values: u64| {
        let positions = [0.0; 75];
        let channels = [FaceVarying { channel: &channel, values: &[0.0; 25], width: 1 }];
        let task = Task { channels: &channels, ..Task::new(&mesh, &scheme, 1, &positions) };
        let (mut indices, mut values) = (vec![0; indices as usize], vec![0.0; values as usize]);
        let mut places = vec![0.0; 3 * 81];
        let mut output = Output::new(&mut places);
        output.channels = vec![ChannelOutput { indices: &mut indices, values: &mut values }];
        let done = Refiner::new().refine_into(&Context::serial(), &task, output);
        done.err().map(|error| error.kind())
    };
    assert_eq!(into(plan.corners, plan.vertices), None);
    assert_eq!(into(plan.corners - 1, plan.vertices), Some(ErrorKind::LengthMismatch));
    assert_eq!(into(plan.corners, plan.vertices + 1), Some(ErrorKind::LengthMismatch));
}

#[test]
fn seams_are_counted() {
    let count = |textured: &Textured| {
        let mesh = textured.control.mesh();
        Channel::new(&mesh, &textured.indices, 200, Corners).unwrap().seam_edges(&mesh)
    };
    assert_eq!(count(&grid()), 0);
    assert_eq!(count(&halves()), 4);
    assert_eq!(count(&grid().island(&[6], &[12])), 2);
}
