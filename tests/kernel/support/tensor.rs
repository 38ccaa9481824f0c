//! Grids as meshes whose positions name their vertices, compared exactly.

use num_rational::BigRational;
use num_traits::Zero;

use super::compare::canonical_faces;
use super::number::ratio;
use super::poly::Poly;
use super::rng::Rng;
use super::univariate::{Curve, Grid, grid_faces};

/// Everything in one coordinate, so that a value names its vertex.
pub fn grid_mesh(grid: &Grid, rows: Curve, columns: Curve) -> Poly<BigRational> {
    let values: Vec<_> = grid.iter().flatten().cloned().collect();
    mesh_of_values(&values, grid_faces(grid.len(), grid[0].len(), rows, columns))
}

/// Vertices with one value each.
pub fn mesh_of_values(values: &[BigRational], faces: Vec<Vec<usize>>) -> Poly<BigRational> {
    let nought = BigRational::zero;
    Poly::new(values.iter().map(|x| [x.clone(), nought(), nought()]).collect(), faces)
}

pub fn random_grid(height: usize, width: usize, rng: &mut Rng) -> Grid {
    let mut row = || (0..width).map(|_| ratio(rng.integer(1_000_000), 1)).collect();
    (0..height).map(|_| row()).collect()
}

/// Rank of each vertex by its first coordinate; all must differ.
fn ranks(mesh: &Poly<BigRational>) -> Vec<usize> {
    let mut order: Vec<usize> = (0..mesh.positions.len()).collect();
    order.sort_by(|&a, &b| mesh.positions[a][0].cmp(&mesh.positions[b][0]));
    let mut rank = vec![0; order.len()];
    for (i, &v) in order.iter().enumerate() {
        rank[v] = i;
    }
    let twins = |w: &[usize]| mesh.positions[w[0]][0] == mesh.positions[w[1]][0];
    assert!(!order.windows(2).any(twins), "two vertices share a value: choose another seed");
    rank
}

/// Panics unless two meshes are the same up to numbering, exactly.
pub fn assert_exactly_same(actual: &Poly<BigRational>, expected: &Poly<BigRational>, what: &str) {
    let values = |mesh: &Poly<BigRational>| {
        let mut x: Vec<_> = mesh.positions.iter().map(|p| p[0].clone()).collect();
        x.sort();
        x
    };
    assert!(values(actual) == values(expected), "{what}: positions differ");
    let (a, b) = (ranks(actual), ranks(expected));
    let named = canonical_faces(&actual.faces, |v| a[v]);
    assert!(named == canonical_faces(&expected.faces, |v| b[v]), "{what}: faces differ");
}
