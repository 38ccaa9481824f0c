//! Smooth rules and boundaries: regular masks, valences 2 to 12, faces of any size.

use carvel::scheme::{LoopWeights, TriangleRule};
use carvel::{Boundary, Fraction, Scheme};
use num_rational::BigRational;

use crate::control::{Control, Row, mean, row, sum};
use crate::support::number::ratio;

// ------------------------------------------------------------------ tensor products

const HEIGHT: u32 = 4;
const WIDTH: u32 = 5;

/// The binomial mask of a B-spline, [1, 2, 1]/2 times (1, 2, 1)/4 for each pass.
fn b_spline(passes: u32) -> Vec<BigRational> {
    let mut mask = vec![ratio(1, 2), ratio(1, 1), ratio(1, 2)];
    for _ in 0..passes {
        let at = |i: usize| mask.get(i).cloned().unwrap_or_else(|| ratio(0, 1));
        let before = |i: usize, k: usize| i.checked_sub(k).map_or_else(|| ratio(0, 1), at);
        let new = |i| (at(i) + ratio(2, 1) * before(i, 1) + before(i, 2)) / ratio(4, 1);
        mask = (0..mask.len() + 2).map(new).collect();
    }
    mask
}

/// The weights of point `a` of the refined closed curve of `n` points.
fn curve_row(mask: &[BigRational], a: u32, n: u32) -> Vec<BigRational> {
    let half = mask.len() as i64 / 2;
    let mut row = vec![ratio(0, 1); n as usize];
    for (k, w) in mask.iter().enumerate() {
        let twice = i64::from(a) + k as i64 - half;
        if twice % 2 == 0 {
            row[twice.div_euclid(2).rem_euclid(i64::from(n)) as usize] += w;
        }
    }
    row
}

/// Old points around a new one: itself, or the two that it lies between.
fn around(a: u32, n: u32) -> Vec<u32> {
    if a.is_multiple_of(2) { vec![a / 2] } else { vec![a / 2, (a / 2 + 1) % n] }
}

fn check_tensor_product(scheme: &Scheme, mask: &[BigRational]) {
    let rows = Control::torus(HEIGHT, WIDTH).rows(scheme);
    for (a, b) in (0..2 * HEIGHT).flat_map(|a| (0..2 * WIDTH).map(move |b| (a, b))) {
        let (down, across) = (curve_row(mask, a, HEIGHT), curve_row(mask, b, WIDTH));
        let place = |i: usize, j: usize| (i as u32 * WIDTH + j as u32, &down[i] * &across[j]);
        let all = (0..down.len()).flat_map(|i| (0..across.len()).map(move |j| (i, j)));
        let expected = all.map(|(i, j)| place(i, j));
        let expected = sum(expected.map(|(v, w)| (w, row(1, &[(v, 1)]))));
        let (is, js) = (around(a, HEIGHT), around(b, WIDTH));
        let parent: Vec<u32> =
            is.iter().flat_map(|i| js.iter().map(move |j| i * WIDTH + j)).collect();
        assert_eq!(rows.at(&parent), &expected, "{scheme:?} at {a}, {b}");
    }
}

#[test]
fn the_cubic_mask_is_the_known_one() {
    assert_eq!(b_spline(1), [1, 4, 6, 4, 1].map(|k| ratio(k, 8)));
    assert_eq!(b_spline(2), [1, 6, 15, 20, 15, 6, 1].map(|k| ratio(k, 32)));
}

#[test]
fn regular_quads_are_tensor_products_of_b_splines() {
    check_tensor_product(&Scheme::bilinear(), &b_spline(0));
    check_tensor_product(&Scheme::catmull_clark(), &b_spline(1));
    for degree in [3, 5] {
        let scheme = Scheme::b_spline(degree).unwrap();
        check_tensor_product(&scheme, &b_spline((degree - 1) / 2));
    }
}

/// A pass t is the filter (a/2, 1 − a, a/2) with a = (1 − t)/2: 1/3 for t = 1/3.
#[test]
fn a_pass_is_the_univariate_filter() {
    let scheme = Scheme::primal(&[Fraction::new(1, 3).unwrap()]).unwrap();
    check_tensor_product(&scheme, &[1, 6, 10, 6, 1].map(|k| ratio(k, 12)));
}

// --------------------------------------------------------------------------- irregular

/// Catmull and Clark's rule as their paper has it: Q/n + 2R/n + S(n − 3)/n, with the mean
/// Q of face points and R of midpoints.
fn catmull_clark_vertex(control: &Control, v: u32) -> Row {
    let faces: Vec<&Vec<u32>> = control.faces.iter().filter(|face| face.contains(&v)).collect();
    let n = faces.len() as i64;
    let next = |face: &Vec<u32>| {
        let at = face.iter().position(|&u| u == v).unwrap();
        face[(at + 1) % face.len()]
    };
    let q = faces.iter().map(|face| (ratio(1, n * n), mean(face)));
    let r = faces.iter().map(|face| (ratio(2, n * n), mean(&[v, next(face)])));
    sum(q.chain(r).chain([(ratio(n - 3, n), row(1, &[(v, 1)]))]))
}

#[test]
fn catmull_clark_has_the_weights_of_its_paper() {
    let pillow = Control::new(&[[0, 1, 2], [2, 1, 0]]);
    for control in (3..=12).map(Control::bipyramid).chain([pillow]) {
        let rows = control.rows(&Scheme::catmull_clark());
        for v in [0, 2] {
            assert_eq!(
                rows.at(&[v]),
                &catmull_clark_vertex(&control, v),
                "vertex {v} of {control:?}"
            );
        }
    }
}

fn prism(n: u32) -> Control {
    let side = |i: u32| vec![i, (i + 1) % n, n + (i + 1) % n, n + i];
    let mut faces: Vec<Vec<u32>> = (0..n).map(side).collect();
    faces.extend([(0..n).rev().collect(), (n..2 * n).collect()]);
    Control::new(&faces)
}

#[test]
fn faces_of_any_size_give_their_mean() {
    for n in [3, 5, 6, 9] {
        let control = prism(n);
        let top: Vec<u32> = (n..2 * n).collect();
        let side = [0, 1, n + 1, n];
        for scheme in [Scheme::catmull_clark(), Scheme::bilinear()] {
            let rows = control.rows(&scheme);
            assert_eq!(rows.at(&top), &mean(&top));
            assert_eq!(rows.at(&side), &mean(&side));
        }
        let rows = control.rows(&Scheme::catmull_clark());
        let quarter = || ratio(1, 4);
        let ends = [n, n + 1].map(|v| (quarter(), row(1, &[(v, 1)])));
        let sides = [mean(&top), mean(&side)].map(|face| (quarter(), face));
        assert_eq!(rows.at(&[n, n + 1]), &sum(ends.into_iter().chain(sides)));
        assert_eq!(rows.at(&[0]), &catmull_clark_vertex(&control, 0));
    }
}

/// In a quad split the weights of passes at an old vertex of valence n, an edge and a
/// face of n sides follow from four-sided faces.
#[test]
fn passes_at_irregular_places() {
    let control = prism(5);
    let rows = control.rows(&Scheme::b_spline(3).unwrap());
    // C₀ is the mean of a face; each quad holds vertex, two midpoints, face point.
    let quad = |v: u32, [a, b]: [u32; 2], face: &[u32]| {
        let points = [row(1, &[(v, 1)]), mean(&[v, a]), mean(&[v, b]), mean(face)];
        sum(points.map(|point| (ratio(1, 4), point)))
    };
    let average = |quads: Vec<Row>| {
        let n = quads.len() as i64;
        sum(quads.into_iter().map(|quad| (ratio(1, n), quad)))
    };
    let (top, left, right) = ([5, 6, 7, 8, 9], [4, 0, 5, 9], [0, 1, 6, 5]);
    let at_vertex = vec![quad(5, [6, 9], &top), quad(5, [0, 9], &left), quad(5, [0, 6], &right)];
    assert_eq!(rows.at(&[5]), &average(at_vertex));
    let at_edge = vec![
        quad(5, [6, 9], &top),
        quad(6, [5, 7], &top),
        quad(5, [0, 6], &right),
        quad(6, [5, 1], &right),
    ];
    assert_eq!(rows.at(&[5, 6]), &average(at_edge));
    let corner = |i: u32| quad(5 + i, [5 + (i + 1) % 5, 5 + (i + 4) % 5], &top);
    assert_eq!(rows.at(&top), &average((0..5).map(corner).collect()));
}

/// With t ≠ 0 the four places of a quad differ: (1 + t)/2 and (1 − t)/2 each way.
#[test]
fn a_pass_knows_the_places_of_a_quad() {
    let scheme = Scheme::primal(&[Fraction::HALF]).unwrap();
    let rows = Control::torus(5, 5).rows(&scheme);
    // The filter (1, 6, 1)/8 of [1, 2, 1]/2 is [1, 8, 14, 8, 1]/16.
    assert_eq!(rows.at(&[12])[&12], ratio(14 * 14, 256));
    assert_eq!(rows.at(&[12])[&13], ratio(14, 256));
    assert_eq!(rows.at(&[12, 13])[&12], ratio(14 * 8, 256));
    assert_eq!(rows.at(&[12, 13])[&17], ratio(8, 256));
    assert_eq!(rows.at(&[12, 13, 18, 17])[&12], ratio(64, 256));
    let prism = prism(5).rows(&scheme);
    // C_½ of the quads is (9, 3, 1, 3)/16; 9/16 + 2·3/32 + 1/80 of the pentagon's at 5.
    let own = |side: i64| ratio(9, 16) + ratio(3, 16) + ratio(1, 16 * side);
    let expected = (own(5) + own(4) + own(4)) / ratio(3, 1);
    assert_eq!(prism.at(&[5])[&5], expected);
}

// -------------------------------------------------------------------------------- Loop

#[test]
fn regular_triangles_have_the_box_spline() {
    let rows = Control::torus(6, 7).cut().rows(&Scheme::loop_triangles());
    // Vertex (2, 3) is 17; its neighbours right, up, across and back.
    let ring = [(18, 1), (16, 1), (24, 1), (10, 1), (25, 1), (9, 1)];
    let own: Vec<_> = ring.into_iter().chain([(17, 10)]).collect();
    assert_eq!(rows.at(&[17]), &row(16, &own));
    assert_eq!(rows.at(&[17, 18]), &row(8, &[(17, 3), (18, 3), (25, 1), (10, 1)]));
    assert_eq!(rows.at(&[17, 25]), &row(8, &[(17, 3), (25, 3), (18, 1), (24, 1)]));
}

/// The row of a tip of a bipyramid for β = num/den.
fn tip(n: u32, (num, den): (i64, i64)) -> Row {
    let ring = (0..n).map(|i| (2 + i, num));
    row(den, &ring.chain([(0, den - i64::from(n) * num)]).collect::<Vec<_>>())
}

#[test]
fn loop_has_its_own_weights() {
    // (5/8 − (3/8 + cos(2π/n)/4)²)/n where the cosine is a fraction: −1, −1/2, 0, 1/2.
    for (n, beta) in [(3, (3, 16)), (4, (31, 256)), (6, (1, 16))] {
        let rows = Control::bipyramid(n).rows(&Scheme::loop_triangles());
        assert_eq!(rows.at(&[0]), &tip(n, beta), "{n}");
    }
    let ring = Control::bipyramid(4).rows(&Scheme::loop_triangles());
    assert_eq!(ring.at(&[0, 2]), &row(8, &[(0, 3), (2, 3), (3, 1), (5, 1)]));
    let pillow = Control::new(&[[0, 1, 2], [2, 1, 0]]).rows(&Scheme::loop_triangles());
    assert_eq!(pillow.at(&[0]), &row(128, &[(0, 50), (1, 39), (2, 39)]));
}

#[test]
fn warren_has_simpler_weights() {
    let warren = Scheme::loop_triangles().with_loop_weights(LoopWeights::Warren);
    for n in 3..=12 {
        let beta = if n == 3 { (3, 16) } else { (3, 8 * i64::from(n)) };
        assert_eq!(Control::bipyramid(n).rows(&warren).at(&[0]), &tip(n, beta), "{n}");
    }
}

/// Between the valences with exact cosines: in doubles.
#[test]
fn loop_weights_of_any_valence() {
    for n in 3..=30_u32 {
        let hierarchy = Control::bipyramid(n).hierarchy(&Scheme::loop_triangles(), 1);
        let inner = 0.375 + (std::f64::consts::TAU / f64::from(n)).cos() / 4.0;
        let beta = (0.625 - inner * inner) / f64::from(n);
        let mut found = Vec::new();
        let each = |v: u32, row: &[(u32, f64)]| {
            if v == 0 {
                found.extend_from_slice(row);
            }
        };
        hierarchy.each_row_of(1, 0, each).unwrap();
        assert_eq!(found.len(), n as usize + 1);
        for (v, w) in found {
            let expected = if v == 0 { 1.0 - f64::from(n) * beta } else { beta };
            assert!((w - expected).abs() < 1e-15, "{n}: {w} at {v}");
        }
    }
}

// ------------------------------------------------------------------------ triangle rule

/// A side weighs 1/4, or 47/100 if it is a triangle; both ends share the rest.
#[test]
fn smooth_triangles_have_their_own_edges() {
    let smooth = Scheme::catmull_clark().with_triangle_rule(TriangleRule::Smooth);
    let roof = Control::new(&[
        vec![0, 1, 2, 3],
        vec![1, 0, 4],
        vec![2, 1, 4],
        vec![3, 2, 4],
        vec![0, 3, 4],
    ]);
    let rows = roof.rows(&smooth);
    let edge = |ends: [u32; 2], hundredths: i64, sides: [&[u32]; 2]| {
        let ends = ends.map(|v| (ratio(50 - hundredths, 100), row(1, &[(v, 1)])));
        let sides = sides.map(|side| (ratio(hundredths, 100), mean(side)));
        sum(ends.into_iter().chain(sides))
    };
    assert_eq!(rows.at(&[0, 1]), &edge([0, 1], 36, [&[0, 1, 2, 3], &[0, 1, 4]]));
    assert_eq!(rows.at(&[1, 4]), &edge([1, 4], 47, [&[0, 1, 4], &[1, 2, 4]]));
    assert_eq!(rows.at(&[4]), &catmull_clark_vertex(&roof, 4));
    assert_eq!(rows.at(&[0, 1, 4]), &mean(&[0, 1, 4]));
    let plain = roof.rows(&Scheme::catmull_clark());
    assert_eq!(plain.at(&[0, 1]), &edge([0, 1], 25, [&[0, 1, 2, 3], &[0, 1, 4]]));
    let quads = Control::grid(2, 2).rows(&smooth);
    assert_eq!(quads.at(&[1, 4]), &edge([1, 4], 25, [&[0, 1, 4, 3], &[1, 2, 5, 4]]));
}

// --------------------------------------------------------------------------- boundaries

#[test]
fn boundaries_are_cubic_curves() {
    let grid = Control::grid(3, 3);
    for (control, scheme) in
        [(grid.clone(), Scheme::catmull_clark()), (grid.cut(), Scheme::loop_triangles())]
    {
        for boundary in [Boundary::None, Boundary::Edge, Boundary::EdgeAndCorner] {
            let rows = control.rows(&scheme.clone().with_boundary(boundary));
            assert_eq!(rows.at(&[1]), &row(8, &[(0, 1), (1, 6), (2, 1)]), "{boundary:?}");
            assert_eq!(rows.at(&[11]), &row(8, &[(7, 1), (11, 6), (15, 1)]), "{boundary:?}");
            assert_eq!(rows.at(&[1, 2]), &mean(&[1, 2]), "{boundary:?}");
            let corner = match boundary {
                Boundary::EdgeAndCorner => row(1, &[(3, 1)]),
                _ => row(8, &[(2, 1), (3, 6), (7, 1)]),
            };
            assert_eq!(rows.at(&[3]), &corner, "{boundary:?}");
        }
    }
}

#[test]
fn tagged_boundary_vertices_stay() {
    let control = Control { corners: vec![1], ..Control::grid(2, 2) };
    let rows = control.rows(&Scheme::catmull_clark().with_boundary(Boundary::Edge));
    assert_eq!(rows.at(&[1]), &row(1, &[(1, 1)]));
    assert_eq!(rows.at(&[5]), &row(8, &[(2, 1), (5, 6), (8, 1)]));
}

/// The univariate filter of the midpoints: (1, 14, 1)/16 for t = 1/2, a = 1/4.
#[test]
fn passes_filter_along_the_boundary() {
    let scheme = Scheme::primal(&[Fraction::HALF]).unwrap();
    for boundary in [Boundary::None, Boundary::EdgeAndCorner] {
        let rows = Control::grid(3, 3).rows(&scheme.clone().with_boundary(boundary));
        assert_eq!(rows.at(&[1]), &row(16, &[(0, 1), (1, 14), (2, 1)]));
        assert_eq!(rows.at(&[1, 2]), &mean(&[1, 2]));
        assert_eq!(rows.at(&[3]), &row(1, &[(3, 1)]));
    }
    let isolated = Control { vertices: 10, ..Control::grid(2, 2) };
    assert_eq!(isolated.rows(&scheme).at(&[9]), &row(1, &[(9, 1)]));
    assert_eq!(isolated.rows(&Scheme::catmull_clark()).at(&[9]), &row(1, &[(9, 1)]));
}
