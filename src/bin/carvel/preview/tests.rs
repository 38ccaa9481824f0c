//! Whole pictures: what must be seen where.

use super::*;
use carvel::ErrorKind;

/// A mesh under construction; faces do not share vertices.
#[derive(Clone, Default)]
struct Soup {
    positions: Vec<[f64; 3]>,
    sizes: Vec<u32>,
    vertices: Vec<u32>,
}

impl Soup {
    fn face(mut self, corners: &[[f64; 3]]) -> Self {
        let first = self.positions.len() as u32;
        self.positions.extend(corners);
        self.sizes.push(corners.len() as u32);
        self.vertices.extend(first..first + corners.len() as u32);
        self
    }

    /// A square in a plane of constant z, whose front [`facing`] sees.
    fn square(self, half: f64, z: f64) -> Self {
        self.face(&[[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]])
    }

    /// The same square seen from its back.
    fn square_turned(self, half: f64, z: f64) -> Self {
        self.face(&[[-half, -half, z], [-half, half, z], [half, half, z], [half, -half, z]])
    }

    /// A wavy square of n×n faces that share vertices.
    fn grid(n: u32) -> Self {
        let at = |i: u32| f64::from(i) / f64::from(n) - 0.5;
        let point = |i, j| [at(i), at(j), 0.1 * libm::sin(9.0 * at(i)) * libm::cos(7.0 * at(j))];
        let index = |i, j| j * (n + 1) + i;
        let quad = |i, j| [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        Self {
            positions: (0..=n).flat_map(|j| (0..=n).map(move |i| point(i, j))).collect(),
            sizes: vec![4; (n * n) as usize],
            vertices: (0..n).flat_map(|j| (0..n).flat_map(move |i| quad(i, j))).collect(),
        }
    }

    fn scaled(mut self, factor: f64) -> Self {
        self.positions.iter_mut().flatten().for_each(|x| *x *= factor);
        self
    }

    fn polygons(&self) -> Polygons<'_> {
        Polygons {
            positions: &self.positions,
            face_sizes: &self.sizes,
            face_vertices: &self.vertices,
        }
    }

    fn render(&self, view: &View) -> Image {
        render(&self.positions, &self.sizes, &self.vertices, view).unwrap()
    }
}

/// A view along −z.
fn facing(width: u32, height: u32) -> View {
    View { width, height, azimuth: 0.0, elevation: 0.0, ..View::default() }
}

fn pixel(image: &Image, x: u32, y: u32) -> [u8; 4] {
    image.rgba().as_chunks().0[(y * image.width() + x) as usize]
}

/// How many pixels are not of the background's colour.
fn covered(image: &Image) -> usize {
    image.rgba().as_chunks::<4>().0.iter().filter(|&&p| p != [255; 4]).count()
}

fn brightness(image: &Image) -> f64 {
    image.rgba().iter().map(|&b| f64::from(b)).sum::<f64>() / image.rgba().len() as f64
}

fn is_front([r, _, b, _]: [u8; 4]) -> bool {
    b > r
}

fn is_back([r, _, b, _]: [u8; 4]) -> bool {
    r > b
}

/// Every style of drawing.
fn styles(view: &View) -> Vec<View> {
    let wires = [Wireframe::None, Wireframe::Overlay, Wireframe::Only];
    let shadings = [Shading::Smooth, Shading::Flat];
    let styles = wires.into_iter().flat_map(|w| shadings.map(|s| (w, s)));
    styles.map(|(wireframe, shading)| View { wireframe, shading, ..view.clone() }).collect()
}

#[test]
fn a_square_fills_the_frame_up_to_its_margin() {
    for (width, height) in [(100, 100), (200, 100), (100, 300)] {
        let image = Soup::default().square(1.0, 0.0).render(&facing(width, height));
        let rest = |x: u32, y: u32| pixel(&image, x, y) == [255; 4];
        let (left, top) = ((width - 90) / 2, (height - 90) / 2);
        assert_eq!(covered(&image), 90 * 90, "{width}x{height}");
        assert!(!rest(left, top) && !rest(left + 89, top + 89));
        assert!(rest(left - 1, top + 45) && rest(left + 45, top - 1));
    }
}

#[test]
fn a_lopsided_mesh_stands_in_the_middle() {
    let view = View { elevation: 60.0, azimuth: 20.0, ..facing(120, 90) };
    let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 2.0]];
    let image = Soup::default().face(&corners).render(&view);
    let drawn = |x, y| pixel(&image, x, y) != [255; 4];
    let columns: Vec<_> = (0..120).filter(|&x| (0..90).any(|y| drawn(x, y))).collect();
    let rows: Vec<_> = (0..90).filter(|&y| (0..120).any(|x| drawn(x, y))).collect();
    assert!((columns[0] + columns[columns.len() - 1]).abs_diff(119) <= 1, "{columns:?}");
    assert!((rows[0] + rows[rows.len() - 1]).abs_diff(89) <= 1, "{rows:?}");
    assert!(columns.len().abs_diff(108) <= 1 || rows.len().abs_diff(81) <= 1);
}

#[test]
fn a_triangle_covers_half_of_its_square() {
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]];
    let view = View { supersample: 1, ..facing(100, 100) };
    let image = Soup::default().face(&corners).render(&view);
    assert!(covered(&image).abs_diff(90 * 90 / 2) <= 90 / 2);
    assert!(is_front(pixel(&image, 20, 80)) && pixel(&image, 80, 20) == [255; 4]);
}

#[test]
fn the_nearer_of_two_squares_is_seen_in_any_order() {
    let near_last = Soup::default().square(1.0, -0.2).square_turned(0.5, 0.2);
    let near_first = Soup::default().square_turned(0.5, 0.2).square(1.0, -0.2);
    for mesh in [near_last, near_first] {
        for view in styles(&facing(100, 100)) {
            let image = mesh.render(&view);
            if view.wireframe != Wireframe::Only {
                assert!(is_back(pixel(&image, 45, 52)) && is_front(pixel(&image, 10, 52)));
            }
        }
    }
}

#[test]
fn the_camera_turns_towards_x_and_rises() {
    // A cube's sides, of which one alone is turned inside out.
    let side = |axis: usize, sign: f64| {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| {
            let mut p = [0.0; 3];
            (p[axis], p[u], p[v]) = (sign, a * sign, b);
            p
        })
    };
    let cube = |marked: (usize, f64)| {
        (0..6).map(|i| (i / 2, if i % 2 == 0 { 1.0 } else { -1.0 })).fold(
            Soup::default(),
            |mesh, (axis, sign)| {
                let mut corners = side(axis, sign);
                if (axis, sign) == marked {
                    corners.reverse();
                }
                mesh.face(&corners)
            },
        )
    };
    let looks = [
        (Up::Y, 0.0, 0.0, (2, 1.0)),
        (Up::Y, 90.0, 0.0, (0, 1.0)),
        (Up::Y, 180.0 + 360e3, 0.0, (2, -1.0)),
        (Up::Y, 0.0, 90.0, (1, 1.0)),
        (Up::Z, 0.0, 0.0, (1, -1.0)),
        (Up::Z, 90.0, 0.0, (0, 1.0)),
        (Up::Z, 0.0, -90.0, (2, -1.0)),
    ];
    for (up, azimuth, elevation, seen) in looks {
        let view = View { azimuth, elevation, up, ..facing(60, 60) };
        for marked in (0..6).map(|i| (i / 2, if i % 2 == 0 { 1.0 } else { -1.0 })) {
            let middle = pixel(&cube(marked).render(&view), 30, 30);
            assert_eq!(is_back(middle), marked == seen, "{up:?} {azimuth} {elevation} {marked:?}");
        }
    }
}

#[test]
fn light_falls_from_above() {
    let view = facing(60, 60);
    let tilted = |dz: f64| {
        let corners = [[-1.0, -1.0, dz], [1.0, -1.0, dz], [1.0, 1.0, -dz], [-1.0, 1.0, -dz]];
        u32::from(pixel(&Soup::default().face(&corners).render(&view), 30, 30)[1])
    };
    assert!(tilted(0.7) > tilted(0.0) && tilted(0.0) > tilted(-0.7));
}

#[test]
fn wireframes_have_the_edges_of_polygons_and_no_diagonals() {
    let pentagon: Vec<_> = (0..5)
        .map(|i| f64::from(i) * std::f64::consts::TAU / 5.0)
        .map(|a| [libm::sin(a), libm::cos(a), 0.0])
        .collect();
    for mesh in [Soup::default().square(1.0, 0.0), Soup::default().face(&pentagon)] {
        let view = View { wireframe: Wireframe::Only, ..facing(100, 100) };
        let image = mesh.render(&view);
        let inner = (0..100).flat_map(|y| (0..100).map(move |x| (x, y)));
        let inner =
            inner.filter(|&(x, y): &(i32, i32)| (x - 50).pow(2) + (y - 50).pow(2) < 33 * 33);
        assert!(inner.clone().count() > 3000);
        for (x, y) in inner {
            assert_eq!(pixel(&image, x as u32, y as u32), [255; 4], "{x} {y}");
        }
        let outline = covered(&image);
        assert!((2 * 90 * 3 / 2..90 * 4 * 3).contains(&outline), "{outline}");
    }
    let square = Soup::default().square(1.0, 0.0);
    let image = square.render(&View { wireframe: Wireframe::Only, ..facing(100, 100) });
    for i in 5..95 {
        for (x, y) in [(i, 4), (i, 95), (4, i), (95, i)] {
            assert!(pixel(&image, x, y)[0] < 250, "{x} {y}");
        }
    }
}

#[test]
fn lines_behind_a_surface_are_hidden() {
    let mesh = Soup::default().square(1.0, 0.0).square(0.5, -0.3);
    for wireframe in [Wireframe::Only, Wireframe::Overlay] {
        let view = View { wireframe, ..facing(100, 100) };
        let image = mesh.render(&view);
        let middle = pixel(&image, 50, 50);
        assert!((10..90).all(|x| pixel(&image, x, 50) == middle), "{wireframe:?}");
        let open = Soup::default().square(1.0, 0.0).square(0.5, 0.3).render(&view);
        assert!((10..90).any(|x| pixel(&open, x, 50) != pixel(&open, 50, 50)));
    }
}

#[test]
fn overlaid_lines_darken_and_fine_ones_fade() {
    let view = facing(120, 120);
    let lined = View { wireframe: Wireframe::Overlay, ..view.clone() };
    let loss = |n| {
        let mesh = Soup::grid(n);
        brightness(&mesh.render(&view)) - brightness(&mesh.render(&lined))
    };
    assert!(loss(8) > 5.0, "{}", loss(8));
    assert!(loss(200).abs() < 0.2, "{}", loss(200));
}

#[test]
fn lines_are_light_on_a_dark_background() {
    let view =
        View { wireframe: Wireframe::Only, background: [10, 10, 10, 255], ..facing(100, 100) };
    let image = Soup::default().square(1.0, 0.0).render(&view);
    let lightest = image.rgba().as_chunks::<4>().0.iter().map(|p| p[0]).max();
    assert!(lightest > Some(100));
    assert_eq!(pixel(&image, 50, 50), [10, 10, 10, 255]);
}

#[test]
fn a_transparent_background_is_blended_without_a_fringe() {
    let view = View { background: parse_color("#ff000000").unwrap(), ..facing(101, 101) };
    let corners = [[-1.0, -1.0, 0.0], [1.0, -0.9, 0.0], [0.1, 1.0, 0.0]];
    let image = Soup::default().face(&corners).render(&view);
    let solid = pixel(&image, 50, 60);
    let pixels = image.rgba().as_chunks::<4>().0;
    assert_eq!((pixels[0], solid[3]), ([255, 0, 0, 0], 255));
    let partial: Vec<_> = pixels.iter().filter(|p| (1..255).contains(&p[3])).collect();
    assert!(partial.len() > 50);
    assert!(partial.iter().all(|p| (0..3).all(|c| p[c].abs_diff(solid[c]) <= 2)));
}

#[test]
fn smooth_shading_varies_within_a_face_and_flat_does_not() {
    let view = facing(90, 90);
    let mesh = Soup::grid(5);
    let inside = |shading| {
        let image = mesh.render(&View { shading, ..view.clone() });
        let mut places = (0..100).map(|i| (40 + i % 10, 40 + i / 10));
        places.any(|(x, y)| pixel(&image, x, y) != pixel(&image, 45, 45))
    };
    assert!(inside(Shading::Smooth));
    assert!(!inside(Shading::Flat));
}

/// A quarter of a cylinder turns its normals by a right angle, the rays by two.
#[test]
fn stripes_are_reflected_as_often_as_normals_turn() {
    let mut arch = Soup::default();
    let at = |i: u32, z: f64| {
        let angle = std::f64::consts::FRAC_PI_2 * (f64::from(i) / 64.0 - 0.5);
        [z, angle.sin(), angle.cos()]
    };
    for i in 0..64 {
        arch = arch.face(&[at(i, 0.0), at(i, 1.0), at(i + 1, 1.0), at(i + 1, 0.0)]);
    }
    let view = View { shading: Shading::Flat, ..facing(200, 640) };
    let sum =
        |image: &Image, y| pixel(image, 100, y)[..3].iter().map(|&x| u32::from(x)).sum::<u32>();
    let plain = arch.render(&view);
    for stripes in [0, 12, 24] {
        let image = arch.render(&View { stripes, ..view.clone() });
        let dark = |y: u32| 10 * sum(&image, y) < 6 * sum(&plain, y);
        let changes = (1..640).filter(|&y| dark(y) != dark(y - 1)).count() as u32;
        assert!(changes.abs_diff(stripes) <= 1, "{stripes} stripes: {changes} changes");
    }
}

#[test]
fn a_flipped_face_in_a_smooth_surface_is_lit_like_its_surroundings() {
    let mut plane = Soup::grid(3);
    plane.positions.iter_mut().for_each(|p| p[2] = -0.5 * p[1]);
    let (mut one, mut all) = (plane.clone(), plane);
    one.vertices[4 * 4..5 * 4].reverse();
    all.vertices.as_chunks_mut::<4>().0.iter_mut().for_each(|face| face.reverse());
    let view = facing(60, 60);
    let (flipped, expected) =
        (pixel(&one.render(&view), 30, 30), pixel(&all.render(&view), 30, 30));
    assert!(is_back(expected));
    assert!((0..4).all(|c| flipped[c].abs_diff(expected[c]) <= 1), "{flipped:?} {expected:?}");
}

#[test]
fn faces_whose_vertex_normals_cancel_are_lit_as_if_alone() {
    let alone = Soup::default().square(1.0, 0.0);
    let mut doubled = alone.clone();
    doubled.sizes.push(4);
    doubled.vertices.extend([3, 2, 1, 0]);
    let view = facing(50, 50);
    assert_eq!(alone.render(&view), doubled.render(&view));
}

#[test]
fn meshes_without_anything_to_see_give_the_background() {
    let point = [0.25, -3.0, 7.0];
    let line: Vec<_> = (0..9).map(|i| [f64::from(i), 2.0 * f64::from(i), 0.0]).collect();
    let nothing = [
        Soup::default(),
        Soup { positions: vec![point], ..Soup::default() },
        Soup { positions: vec![point], sizes: vec![1], vertices: vec![0] },
        Soup { positions: vec![point], sizes: vec![4], vertices: vec![0; 4] },
        Soup { positions: vec![point; 7], sizes: vec![0, 2], vertices: vec![1, 5] },
        Soup::default().face(&line),
        Soup::default().face(&[[0.0; 3]; 5]),
    ];
    for (i, mesh) in nothing.iter().enumerate() {
        for view in styles(&View { width: 40, height: 30, ..View::default() }) {
            let image = mesh.render(&view);
            if view.wireframe == Wireframe::None {
                assert_eq!(covered(&image), 0, "{i}");
            }
        }
    }
}

#[test]
fn awkward_faces_are_drawn_without_failing() {
    let star: Vec<_> = (0..11)
        .map(|i| f64::from(i * 4) * std::f64::consts::TAU / 11.0)
        .map(|a| [libm::sin(a), libm::cos(a), libm::sin(3.0 * a)])
        .collect();
    let spike = [[0.0; 3], [1e-300, 0.0, 0.0], [1.0, 1e-12, 0.0], [0.0, 1e308, 1.0]];
    let edge_on = [[0.0; 3], [0.0, 0.0, 5.0], [0.0, 1.0, 5.0], [0.0, 1.0, 0.0]];
    let extremes = [[f64::MAX; 3], [f64::MIN; 3], [f64::MAX, f64::MIN, 0.0]];
    let tiny = [[5e-324, 0.0, 0.0], [0.0, 5e-324, 0.0], [0.0, 0.0, 5e-324]];
    for corners in [&star[..], &spike, &edge_on, &extremes, &tiny] {
        for view in styles(&View { supersample: 2, ..facing(64, 48) }) {
            let mesh = Soup::default().face(corners);
            assert_eq!(mesh.render(&view).rgba().len(), 4 * 64 * 48);
        }
    }
    let seen =
        |corners: &[[f64; 3]]| covered(&Soup::default().face(corners).render(&facing(64, 48)));
    assert!(seen(&extremes) > 100 && seen(&tiny) > 100);
}

#[test]
fn size_and_place_of_the_mesh_do_not_matter() {
    let mesh = Soup::grid(6);
    let view = View { width: 80, height: 60, wireframe: Wireframe::Overlay, ..View::default() };
    let image = mesh.render(&view);
    for exponent in [-1000, -60, 3, 1000] {
        let scaled = mesh.clone().scaled(libm::exp2(f64::from(exponent)));
        assert_eq!(scaled.render(&view), image, "2^{exponent}");
    }
    let mut moved = mesh.clone();
    moved.positions.iter_mut().flatten().for_each(|x| *x += 4096.0);
    let near = |(a, b): (&u8, &u8)| a.abs_diff(*b) <= 2;
    assert!(moved.render(&view).rgba().iter().zip(image.rgba()).all(near));
}

#[test]
fn the_same_mesh_gives_the_same_bytes_in_bands_of_any_size() {
    let mesh = Soup::grid(12);
    for view in styles(&View { width: 97, height: 61, ..View::default() }) {
        let bytes = mesh.render(&view).encode_png().unwrap();
        assert_eq!(mesh.render(&view).encode_png().unwrap(), bytes);
        let checked = mesh.polygons().check().unwrap();
        let camera = Camera::fit(std::slice::from_ref(&checked), &view).unwrap();
        for samples in [1, 10_000] {
            let image = draw(&checked, &camera, &view, samples).unwrap();
            assert_eq!(image.encode_png().unwrap(), bytes, "{samples} {view:?}");
        }
    }
}

#[test]
fn pictures_made_alike_share_one_camera() {
    let (large, small) = (Soup::default().square(1.0, 0.0), Soup::default().square(0.5, 0.0));
    let view = facing(100, 100);
    let images = render_alike(&[small.polygons(), large.polygons()], &view).unwrap();
    assert_eq!(images.iter().map(covered).collect::<Vec<_>>(), [46 * 46, 90 * 90]);
    assert_eq!(images[1], large.render(&view));
    assert!(render_alike(&[], &view).unwrap().is_empty());
}

#[test]
fn views_outside_their_ranges_are_refused() {
    let good = facing(10, 10);
    let bad = [
        View { width: 0, ..good.clone() },
        View { height: 0, ..good.clone() },
        View { width: 16385, ..good.clone() },
        View { height: u32::MAX, ..good.clone() },
        View { supersample: 0, ..good.clone() },
        View { supersample: 5, ..good.clone() },
        View { azimuth: f32::NAN, ..good.clone() },
        View { elevation: f32::INFINITY, ..good.clone() },
    ];
    for view in bad {
        let err = render(&[], &[], &[], &view).unwrap_err();
        assert_eq!(err.kind(), ErrorKind::ParameterOutOfRange, "{view:?}");
    }
    let longest = View { width: 16384, height: 1, supersample: 4, ..good };
    assert_eq!(Soup::grid(2).render(&longest).width(), 16384);
}
