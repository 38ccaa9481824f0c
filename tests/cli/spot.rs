//! The cow's author published its Catmull–Clark surface; ours is the same.

use super::bench::{Bench, COW, faces_by_vertex};
use carvel::io::MeshFile;

/// Level 2, by Keenan Crane.
const PUBLISHED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/spot/spot_quadrangulated.obj");

/// The published file has six digits, from a control mesh with six digits.
const PRINTED: f64 = 7e-6;

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
}

/// For every vertex of one mesh the nearest of the other.
fn nearest(of: &MeshFile, among: &MeshFile) -> Vec<u32> {
    let nearest = |p: &[f64; 3]| {
        let away = |q: &[f64; 3]| distance(*p, *q);
        let all = (0..).zip(&among.positions);
        let (best, at) = all.min_by(|a, b| away(a.1).total_cmp(&away(b.1))).unwrap();
        assert!(away(at) < PRINTED, "{p:?} is {} off", away(at));
        best
    };
    of.positions.iter().map(nearest).collect()
}

#[test]
fn the_published_surface_is_level_two() {
    let bench = Bench::new();
    bench.run(&format!("subdivide {COW} -o out.obj --scheme catmull-clark --levels 2")).ok();
    let ours = bench.mesh("out.obj");
    let mut theirs = bench.mesh(PUBLISHED);
    assert_eq!(theirs.face_sizes.len(), 2928);
    let numbers = nearest(&theirs, &ours);
    let mut once = numbers.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), ours.positions.len(), "every vertex has its own");
    for v in &mut theirs.face_vertices {
        *v = numbers[*v as usize];
    }
    assert_eq!(faces_by_vertex(&ours), faces_by_vertex(&theirs));
    // Their texture coordinates follow another rule, but have the same seams.
    assert_eq!(ours.uvs.len(), theirs.uvs.len());
}
