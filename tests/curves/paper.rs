//! The founding paper's scheme and the errata, by computation.

use carvel::analysis::mask::{Analysis, Bivariate, Certificate, Effort, grid_contractivity};
use carvel::curve::rational::ratio;
use carvel::curve::{
    CurveSplit, Ends, Factors, GridMask, Laurent, LimitStencil, Mask, Polygon, Rational, Tap,
    limit_stencil,
};
use carvel::{Context, Fraction, Mesh, Refiner, Scheme, Task};

use crate::support::{list, named, q};

fn stencil(name: &str, x: &str, derivative: usize) -> LimitStencil {
    limit_stencil(&Context::serial(), &named(name), &q(x), derivative).expect("a stencil")
}

#[track_caller]
fn is(name: &str, x: &str, derivative: usize, first: i64, numerators: &[i64], over: i64) {
    let weights = numerators.iter().map(|&n| ratio(n, over)).collect();
    assert_eq!(stencil(name, x, derivative), LimitStencil { first, weights });
}

#[test]
fn the_scheme_is_c2_by_a_norm_of_three_quarters() {
    let mask = named("three-point:1/32");
    let analysis = Analysis::of(&Context::serial(), &mask, Effort::default()).expect("done");
    assert_eq!(analysis.continuity, Some(2));
    let proof = analysis.contractivity.expect("a proof");
    assert_eq!((proof.continuity, proof.power, proof.norm), (2, 1, q("3/4")));
    assert_eq!(analysis.support, q("5"));
    // 2 − log₂(3/4), the radius being 3/16 exactly.
    assert_eq!(analysis.holder.radius.exact, Some(q("3/16")));
    assert_eq!(analysis.holder.radius.certificate, Certificate::Norm);
    let exponent = 2.0 - 0.75_f64.log2();
    let [low, high] = [analysis.holder.low, analysis.holder.high];
    assert!(low < exponent && exponent < high && high - low < 1e-13, "{low} {high}");
    assert_eq!((analysis.degrees.generation, analysis.degrees.reproduction), (2, 1));
}

/// At a vertex of the dual scheme, −½ on the scale of φ, and at the middle of an edge.
#[test]
fn limit_and_derivative_stencils() {
    is("three-point:1/32", "-1/2", 0, -2, &[1, 252, 1030, 252, 1], 1536);
    is("three-point:1/32", "0", 0, -1, &[1, 23, 23, 1], 48);
    is("three-point:1/32", "-1/2", 1, -2, &[-1, -78, 0, 78, 1], 160);
    is("three-point:1/32", "0", 1, -1, &[-1, -7, 7, 1], 10);
    is("chaikin", "-1/2", 0, -1, &[1, 6, 1], 8);
    is("chaikin", "0", 0, 0, &[1, 1], 2);
    is("three-point:1/16", "-1/2", 0, -2, &[1, 76, 230, 76, 1], 384);
    is("b-spline:3", "0", 0, -1, &[1, 4, 1], 6);
    is("b-spline:3", "0", 1, -1, &[-1, 0, 1], 2);
    is("b-spline:3", "0", 2, -1, &[1, -2, 1], 1);
    is("b-spline:3", "1/2", 0, -1, &[1, 23, 23, 1], 48);
    // A third is no dyadic number: x goes to 2/3 and back.
    is("b-spline:3", "1/3", 0, -1, &[8, 93, 60, 1], 162);
    is("b-spline:3", "22/3", 0, 6, &[8, 93, 60, 1], 162);
}

#[test]
fn limits_of_a_polygon_are_its_stencils() {
    let mask = named("three-point:1/32");
    let control = Polygon::new(list("0 5 -3 8 1 7 2"), 1, Ends::Closed);
    let limit = control.limit(&Context::serial(), &mask, 0).expect("points");
    let expected =
        (q("0") + q("252") * q("5") - q("1030") * q("3") + q("252") * q("8") + q("1")) / q("1536");
    assert_eq!(limit.points[2], expected);
    // A refined polygon has the same limit, with points over the old ones' places.
    let slope = control.limit(&Context::serial(), &mask, 1).expect("derivatives");
    let expected = (q("78") * (q("8") - q("5")) + q("1") - q("0")) / q("160");
    assert_eq!(slope.points[2], expected);
    let kept = Polygon::new(list("0 5 -3"), 1, Ends::Kept);
    let kept = kept.limit(&Context::serial(), &mask, 0).expect("points");
    assert_eq!((&kept.points[0], &kept.points[2]), (&q("0"), &q("-3")));
}

// -------------------------------------------------------------------- errata

/// Equation 4 are the rules 9/32, 22/32, 1/32 of points j−1, j, j+1 and mirrored.
fn equation_4(taps: &[Tap], weights: &str) {
    let shifts: Vec<_> = taps.iter().map(|tap| tap.shift).collect();
    assert_eq!(shifts, [-1, 0, 1]);
    let found: Vec<_> = taps.iter().map(|tap| tap.weight.clone()).collect();
    assert_eq!(found, list(weights));
}

/// Item 1: z⁻² and not z⁻³ gives equation 4; z₁⁻²z₂⁻² in two variables.
#[test]
fn the_symbol_begins_at_minus_two() {
    let factors = &Laurent::sigma(2).power(3) * &Laurent::from_integers(0, &[1, 6, 1], 32);
    let with = |k: i64| {
        let symbol = factors.shifted(k);
        Mask::new(2, symbol.lowest(), symbol.coefficients().to_vec()).expect("a mask")
    };
    equation_4(&with(-2).taps(0), "9/32 22/32 1/32");
    equation_4(&with(-2).taps(1), "1/32 22/32 9/32");
    // As printed the two rules change places, and one of them moves on by a point.
    equation_4(&with(-3).taps(0), "1/32 22/32 9/32");
    let moved: Vec<_> = with(-3).taps(1).iter().map(|tap| tap.shift).collect();
    assert_eq!(moved, [0, 1, 2]);
    let grid = GridMask::tensor(&with(-2), &with(-2)).expect("a mask");
    let symbol = Bivariate::symbol(&grid);
    let unshifted = Bivariate::tensor(&factors, &factors);
    let shift = Bivariate::new([([-2, -2], ratio(1, 1))]);
    assert_eq!(symbol, &shift * &unshifted);
    assert_eq!(symbol.divided_by(&unshifted), Some(shift));
    let proof = grid_contractivity(&Context::serial(), &grid, 4, 4).expect("done").expect("C^k");
    assert_eq!((proof.continuity, proof.power, proof.norm), (2, 1, q("3/4")));
}

/// Item 2: the nine weights are the tensor square of (9, 22, 1)/32, row by row.
#[test]
fn the_nine_weights_are_a_tensor_square() {
    let square = [9, 22, 1].map(|a| [9, 22, 1].map(|b| a * b)).concat();
    assert_eq!(square, [81, 198, 9, 198, 484, 22, 9, 22, 1]);
    assert_eq!(square.iter().sum::<i32>(), 1024);
    // And they are the rule of even rows and columns of the bivariate mask of equation 4.
    let mask = named("three-point:1/32");
    let mask = Mask::new(2, -2, mask.coefficients().to_vec()).expect("a mask");
    let symbol = Bivariate::symbol(&GridMask::tensor(&mask, &mask).expect("a mask"));
    let places = [2, 0, -2].map(|i| [2, 0, -2].map(|j| [i, j])).concat();
    let weights: Vec<_> = places.into_iter().map(|at| symbol.at(at)).collect();
    assert_eq!(weights, square.iter().map(|&n| ratio(n.into(), 1024)).collect::<Vec<_>>());
}

/// Item 3: [1 : 10 : 5]/16 is the rule of the quartic B-spline, w = 1/16.
#[test]
fn the_ten_belongs_to_the_quartic_b_spline() {
    assert_eq!(named("three-point:1/16"), named("b-spline:4"));
    equation_4(&named("three-point:1/16").taps(0), "1/16 10/16 5/16");
    equation_4(&named("three-point:1/32").taps(0), "1/32 22/32 9/32");
}

/// Item 4: vertex, two edge midpoints and centroid, and their mean.
#[test]
fn the_words_are_the_quadratic_scheme() {
    // A face's corners in order, each as weights of the four.
    let corners = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| ratio(i64::from(i == j), 1)));
    let sum = |of: &mut dyn Iterator<Item = &Rational>| of.sum::<Rational>();
    let mean = |list: &[usize]| {
        let weight = |k: usize| sum(&mut list.iter().map(|&i| &corners[i][k]));
        [0, 1, 2, 3].map(|k| weight(k) / ratio(list.len() as i64, 1))
    };
    let parts = [mean(&[0]), mean(&[0, 1]), mean(&[0, 3]), mean(&[0, 1, 2, 3])];
    let words = [0, 1, 2, 3].map(|k| sum(&mut parts.iter().map(|part| &part[k])) / ratio(4, 1));
    assert_eq!(words, [9, 3, 1, 3].map(|n| ratio(n, 16)));
    // Corner by corner Chaikin's 3/4 and 1/4, once in either direction.
    let chaikin = named("chaikin");
    let taps: Vec<_> = chaikin.taps(0).into_iter().map(|tap| tap.weight).collect();
    let product = |i: usize, j: usize| &taps[i] * &taps[j];
    assert_eq!(words, [product(0, 0), product(0, 1), product(1, 1), product(1, 0)]);
    let analysis = Analysis::of(&Context::serial(), &chaikin, Effort::default()).expect("done");
    assert_eq!((analysis.continuity, analysis.holder.high), (Some(1), 2.0));
    // The pass of one half is what is missing.
    let half = Fraction::new(1, 2).expect("a fraction");
    let split = |passes| Factors { split: CurveSplit::Dual, passes };
    assert_eq!(Factors::of(&chaikin).expect("factors"), split(vec![]));
    assert_eq!(Factors::of(&named("three-point:1/32")).expect("factors"), split(vec![half]));
}

/// The number of faces after some steps.
fn faces(vertices: usize, quads: &[u32], steps: u32) -> usize {
    let mesh = Mesh::from_polygons(vertices, &vec![4; quads.len() / 4], quads).expect("a mesh");
    let scheme = Scheme::three_point(Fraction::new(1, 32).expect("w")).expect("a scheme");
    let positions = vec![0.0; 3 * vertices];
    let task = Task::new(&mesh, &scheme, steps, &positions);
    Refiner::new().refine(&Context::serial(), &task).expect("refined").face_sizes.len()
}

/// Item 5: faces of the torus of the figures, and of a cube.
#[test]
fn faces_of_the_figures() {
    let at = |i: u32, j: u32| 4 * (i % 4) + j % 4;
    let quad = |i, j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    let torus: Vec<u32> = (0..16).flat_map(|k| quad(k / 4, k % 4)).collect();
    assert_eq!([0, 1, 2, 3].map(|steps| faces(16, &torus, steps)), [16, 64, 256, 1024]);
    let cube = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3];
    assert_eq!([1, 2].map(|steps| faces(8, &cube, steps)), [26, 98]);
}
