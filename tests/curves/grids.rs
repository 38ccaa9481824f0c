//! Grids: tensor products and bivariate masks, against each other and against the meshes of
//! this library.

use std::ops::{Add, Mul, Sub};

use carvel::analysis::mask::Bivariate;
use carvel::base::Weight;
use carvel::curve::rational::ratio;
use carvel::curve::{CurveSplit, Ends, Factors, Grid, GridMask, Laurent, Mask, Polygon, Rational};
use carvel::{Context, Hierarchy, Mesh, Scheme};

use crate::rng::Rng;
use crate::support::named;

/// Row, column and value of a point.
type Placed = [Rational; PLACED];
const PLACED: usize = 3;

#[derive(Clone, Debug, PartialEq)]
struct Exact(Rational);

impl Add for Exact {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Exact {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Exact {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Weight for Exact {
    fn ratio(num: i64, den: i64) -> Self {
        Self(ratio(num, den))
    }

    fn cos_turn(j: usize, n: usize) -> Self {
        let twelfths = if 12 % n == 0 { j % n * (12 / n) } else { panic!("cos of {j}/{n}") };
        let doubled = [2, 99, 1, 0, -1, 99, -2, 99, -1, 0, 1, 99][twelfths];
        assert_ne!(doubled, 99, "an irrational cosine");
        Self(ratio(doubled, 2))
    }
}

fn random_grid(rows: usize, columns: usize, ends: Ends, seed: u64) -> Grid<Rational> {
    let mut rng = Rng::new(seed);
    let points = (0..rows * columns).map(|_| ratio(rng.integer(1 << 30), 1)).collect();
    Grid { points, columns, width: 1, ends: [ends; 2] }
}

/// Points of row, column and a random value: the first two say where a refined point is.
fn placed_grid(rows: usize, columns: usize, ends: Ends, seed: u64) -> Grid<Rational> {
    let values = random_grid(rows, columns, ends, seed);
    let place = |(i, value): (usize, &Rational)| {
        let at = |k: usize| ratio(k as i64, 1);
        [at(i / columns), at(i % columns), value.clone()]
    };
    let points = values.points.iter().enumerate().flat_map(place).collect();
    Grid { points, width: PLACED, ..values }
}

/// The quads of a grid, wrapped if it is closed.
fn mesh(grid: &Grid<Rational>, closed: bool, triangles: bool) -> Mesh {
    let (rows, columns) = (grid.rows(), grid.columns);
    let cells = |n: usize| if closed { n } else { n - 1 };
    let at = |i: usize, j: usize| ((i % rows) * columns + j % columns) as u32;
    let mut faces = Vec::new();
    for (i, j) in (0..cells(rows)).flat_map(|i| (0..cells(columns)).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        if triangles {
            faces.extend([a, b, c, a, c, d]);
        } else {
            faces.extend([a, b, c, d]);
        }
    }
    let size = if triangles { 3 } else { 4 };
    let sizes = vec![size; faces.len() / size as usize];
    Mesh::from_polygons(rows * columns, &sizes, &faces).expect("a mesh")
}

/// Placed points after some steps of a scheme, exactly, in the order of their places.
fn on_mesh(mesh: Mesh, scheme: Scheme, points: &[Rational], levels: u32) -> Vec<Placed> {
    let hierarchy = Hierarchy::new(&Context::serial(), mesh, scheme, levels).expect("levels");
    let mut values = in_order(points);
    for level in 1..=levels {
        let mut stages: Vec<Vec<Placed>> = vec![values];
        let each = |stage: usize, _: u32, row: &[(u32, Exact)]| {
            if stages.len() == stage + 1 {
                stages.push(Vec::new());
            }
            let from = &stages[stage];
            let value = |k: usize| row.iter().map(|(v, w)| &w.0 * &from[*v as usize][k]).sum();
            let point = std::array::from_fn(value);
            stages[stage + 1].push(point);
        };
        hierarchy.each_row(level, each).expect("rows");
        values = stages.pop().expect("a stage");
    }
    values.sort();
    values
}

fn scheme_of(mask: &Mask) -> Scheme {
    let factors = Factors::of(mask).expect("a mask of the family");
    match factors.split {
        CurveSplit::Dual => Scheme::dual(&factors.passes),
        CurveSplit::Primal => Scheme::primal(&factors.passes),
    }
    .expect("passes in range")
}

const FACTORABLE: [&str; 7] = [
    "chaikin",
    "three-point:1/32",
    "b-spline:4",
    "b-spline:1",
    "b-spline:3",
    "four-point:1/16",
    "dyn-floater-hormann:1/128",
];

fn in_order(points: &[Rational]) -> Vec<Placed> {
    let point = |p: &[Rational]| std::array::from_fn(|k| p[k].clone());
    points.chunks_exact(PLACED).map(point).collect()
}

fn sorted(grid: &Grid<Rational>) -> Vec<Placed> {
    let mut points = in_order(&grid.points);
    points.sort();
    points
}

#[test]
fn closed_grids_are_what_the_mesh_becomes() {
    for (s, name) in FACTORABLE.iter().enumerate() {
        let mask = named(name);
        let grid = placed_grid(4, 5, Ends::Closed, s as u64);
        let refined = grid.refine(&Context::serial(), [&mask, &mask], 2).expect("a grid");
        let expected = on_mesh(mesh(&grid, true, false), scheme_of(&mask), &grid.points, 2);
        assert!(sorted(&refined) == expected, "{name}");
    }
}

#[test]
fn open_grids_are_what_the_mesh_becomes_inside() {
    for (s, name) in FACTORABLE.iter().enumerate() {
        let mask = named(name);
        let (rows, columns) = (13, 12);
        let grid = placed_grid(rows, columns, Ends::Dropped, 50 + s as u64);
        let refined = grid.refine(&Context::serial(), [&mask, &mask], 2).expect("a grid");
        let all = on_mesh(mesh(&grid, false, false), scheme_of(&mask), &grid.points, 2);
        let points = sorted(&refined);
        let missing = points.iter().filter(|point| all.binary_search(point).is_err());
        assert_eq!(missing.count(), 0, "{name}");
        assert!(points.len() > 30, "{name}: {}", points.len());
        let places = points.windows(2).all(|pair| pair[0][..2] != pair[1][..2]);
        assert!(places, "{name}: two points of one place");
    }
}

/// With ends that stay, dual schemes agree up to the boundary itself.
#[test]
fn open_dual_grids_are_what_the_mesh_becomes_everywhere() {
    for name in ["chaikin", "three-point:1/32", "b-spline:4"] {
        let mask = named(name);
        for (rows, columns) in [(2, 2), (2, 5), (4, 3)] {
            let grid = placed_grid(rows, columns, Ends::Kept, 90);
            let refined = grid.refine(&Context::serial(), [&mask, &mask], 3).expect("a grid");
            let expected = on_mesh(mesh(&grid, false, false), scheme_of(&mask), &grid.points, 3);
            assert!(sorted(&refined) == expected, "{name}, {rows} x {columns}");
        }
    }
}

#[test]
fn a_tensor_product_is_a_bivariate_mask() {
    for (a, b) in
        [("chaikin", "four-point"), ("b-spline:3,3", "three-point"), ("odd-point", "b-spline:2,4")]
    {
        let (a, b) = (named(a), named(b));
        let both = GridMask::tensor(&a, &b).expect("a mask");
        for ends in [Ends::Closed, Ends::Dropped] {
            let grid = random_grid(8, 9, ends, 23);
            let tensor = grid.refine(&Context::serial(), [&a, &b], 2).expect("a grid");
            let direct = grid.refine_by(&Context::serial(), &both, 2).expect("a grid");
            assert!(tensor == direct);
        }
    }
}

/// 4096 rules of 64,009 coefficients, which each of them would not be looked for among all.
#[test]
fn a_mask_of_many_rules_takes_no_longer_than_its_coefficients() {
    let mask = named("b-spline:3,64");
    let grid =
        Grid::<f64> { points: vec![1.0; 64], columns: 8, width: 1, ends: [Ends::Dropped; 2] };
    let tensor = GridMask::tensor(&mask, &mask).expect("a grid mask");
    let refined = grid.refine_by(&Context::serial(), &tensor, 1).expect("points");
    assert!(refined.points.iter().all(|x| (x - 1.0).abs() < 1e-14));
    let predicted = tensor.predict([Ends::Dropped; 2], [8, 8], 1).expect("counts");
    assert_eq!(predicted, [refined.columns; 2]);
}

#[test]
fn rows_and_columns_are_curves() {
    let (a, b) = (named("chaikin"), named("four-point"));
    for ends in [Ends::Closed, Ends::Dropped, Ends::Kept] {
        // Values that depend on one direction alone.
        let grid = random_grid(1, 9, ends, 3);
        let line = Polygon::new(grid.points.clone(), 1, ends);
        let expected = line.refine(&Context::serial(), &b, 1).expect("points");
        let points = [&grid.points[..]; 7].concat();
        let all = Grid { points, ..grid };
        let refined = all.refine(&Context::serial(), [&a, &b], 1).expect("a grid");
        assert_eq!(refined.columns, expected.len());
        assert!(refined.points.chunks(refined.columns).all(|row| row == expected.points));
    }
}

/// Loop's regular rule, a three-direction box spline that is no tensor product.
#[test]
fn the_box_spline_is_loops_scheme() {
    let pair = |at: [i64; 2]| Bivariate::new([([0, 0], ratio(1, 1)), (at, ratio(1, 1))]);
    let square = |p: Bivariate| &p * &p;
    let product = &(&square(pair([1, 0])) * &square(pair([0, 1]))) * &square(pair([1, 1]));
    let symbol = product.scaled(&ratio(1, 16));
    let coefficients = (0..5).flat_map(|i| (0..5).map(move |j| [i, j])).map(|at| symbol.at(at));
    let mask = GridMask::new([2, 2], [-2, -2], 5, coefficients.collect()).expect("a mask");
    let grid = placed_grid(5, 6, Ends::Closed, 77);
    let refined = grid.refine_by(&Context::serial(), &mask, 2).expect("a grid");
    let expected = on_mesh(mesh(&grid, true, true), Scheme::loop_triangles(), &grid.points, 2);
    assert!(sorted(&refined) == expected);
    let a = Laurent::sigma(2);
    assert!(symbol.divided_by(&Bivariate::tensor(&a, &a)).is_some());
}
