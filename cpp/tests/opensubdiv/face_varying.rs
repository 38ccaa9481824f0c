//! Face-varying channels with seams, in all six modes: the value at every corner of
//! every refined face, and which corners share one.

use carvel_peers::lineage::match_refinement;
use carvel_peers::normalise::{Correspondence, tolerance};
use carvel_peers::ours::Varied;
use carvel_peers::{
    Boundary, Channel, Control, FaceVarying, OpenSubdiv, Options, PeerMesh, Precision, Refinement,
    Scheme, Task, Values, ours, shapes,
};
use std::collections::HashMap;

/// Cuts the values along the given edges: corners of one vertex share a value as long as
/// a way from face to face leads from one to the other that crosses no seam.
fn seamed(mut control: Control, seams: &[[u32; 2]]) -> Control {
    let faces: Vec<_> = control.faces().map(<[u32]>::to_vec).collect();
    let mut indices: Vec<u32> = (0..control.indices.len() as u32).collect();
    let is_seam = |a: u32, b: u32| seams.contains(&[a, b]) || seams.contains(&[b, a]);
    let mut first = 0;
    let mut at: HashMap<(u32, u32), Vec<(usize, usize)>> = HashMap::new();
    for face in &faces {
        for (i, &a) in face.iter().enumerate() {
            let j = (i + 1) % face.len();
            let b = face[j];
            let (low, high) = if a < b { (first + i, first + j) } else { (first + j, first + i) };
            at.entry((a.min(b), a.max(b))).or_default().push((low, high));
        }
        first += face.len();
    }
    for (_, sides) in at.iter().filter(|((a, b), _)| !is_seam(*a, *b)) {
        for pair in sides.windows(2) {
            join(&mut indices, pair[0].0, pair[1].0);
            join(&mut indices, pair[0].1, pair[1].1);
        }
    }
    control.channels.push(numbered(&indices));
    control
}

fn join(indices: &mut [u32], a: usize, b: usize) {
    let (from, to) = (indices[a], indices[b]);
    for index in indices {
        if *index == from {
            *index = to;
        }
    }
}

/// Values of no pattern, one for each index that occurs.
fn numbered(raw: &[u32]) -> Channel {
    let mut numbers = HashMap::new();
    let number = |index: &u32| {
        let next = numbers.len() as u32;
        *numbers.entry(*index).or_insert(next)
    };
    let indices: Vec<_> = raw.iter().map(number).collect();
    let value = |i: usize| f64::from((0.5 + 3.1 * i as f64).sin() as f32);
    Channel { indices, values: (0..2 * numbers.len()).map(value).collect(), width: 2 }
}

/// Lets both sides of a seam share one value at an end of an edge.
fn joined(mut control: Control, [end, other]: [u32; 2]) -> Control {
    let sides: Vec<usize> = {
        let first = corners(&control.sizes);
        let faces = first.iter().zip(&control.sizes);
        let faces = faces.map(|(&first, &size)| first..first + size as usize);
        let at = |face: std::ops::Range<usize>, v: u32| {
            face.into_iter().find(|&c| control.indices[c] == v)
        };
        faces.filter_map(|face| at(face.clone(), other).and_then(|_| at(face, end))).collect()
    };
    let channel = control.channels.last_mut().expect("a channel");
    let mut indices = channel.indices.clone();
    join(&mut indices, sides[0], sides[1]);
    *channel = numbered(&indices);
    control
}

fn corners(mesh: &[u32]) -> Vec<usize> {
    let mut first = 0;
    mesh.iter()
        .map(|&size| {
            first += size as usize;
            first - size as usize
        })
        .collect()
}

/// Both sides' index at every corner.
fn pairs(
    ours: &PeerMesh,
    mine: &Varied,
    theirs: &PeerMesh,
    their_indices: &[u32],
    at: &Correspondence,
) -> Vec<(u32, u32)> {
    let (first, their_first) = (corners(&ours.sizes), corners(&theirs.sizes));
    let mut all = Vec::new();
    for (f, &g) in at.faces.iter().enumerate() {
        let size = ours.sizes[f] as usize;
        let (c, d) = (first[f], their_first[g as usize]);
        for i in 0..size {
            let w = at.vertices[ours.indices[c + i] as usize];
            let j = theirs.indices[d..d + size].iter().position(|&it| it == w).expect("the vertex");
            all.push((mine.indices[c + i], their_indices[d + j]));
        }
    }
    all
}

fn differs(
    mine: &Varied,
    theirs: &[f64],
    pairs: &[(u32, u32)],
    precision: Precision,
) -> Option<String> {
    let (mut there, mut back) = (HashMap::new(), HashMap::new());
    for &(a, b) in pairs {
        if *there.entry(a).or_insert(b) != b || *back.entry(b).or_insert(a) != a {
            return Some(format!("value {a} is shared otherwise than their {b}"));
        }
        for k in 0..2 {
            let (x, y) = (mine.values[2 * a as usize + k], theirs[2 * b as usize + k]);
            // Relative to the range of the values, which is two.
            if (x - y).abs() / 2.0 > tolerance(precision) {
                return Some(format!("value {a} is {x}, with them {y}"));
            }
        }
    }
    None
}

fn compare(task: &Task, level: u32) -> Result<(), String> {
    let ours = ours::refine(task, level)?;
    let refinement: Refinement = OpenSubdiv.refinement(task, level)?;
    let (_, at) = match_refinement(task, &refinement, level)?;
    let theirs = refinement.mesh()?;
    for (channel, mine) in (0..).zip(&ours.channels) {
        let kind = Values::FaceVarying { channel };
        let values = &task.control.channels[channel as usize].values;
        let values = refinement.interpolate(kind, values, 2)?;
        let pairs = pairs(&ours.mesh, mine, &theirs, &refinement.channel_indices(channel)?, &at);
        if let Some(reason) = differs(mine, &values, &pairs, task.precision) {
            return Err(format!("channel {channel}: {reason}"));
        }
    }
    Ok(())
}

fn in_all_modes(control: &Control, scheme: Scheme, what: &str, failures: &mut Vec<String>) {
    for face_varying in FaceVarying::ALL {
        for boundary in Boundary::ALL {
            for precision in Precision::ALL {
                let options = Options { face_varying, boundary, ..Options::default() };
                let task = Task { control, scheme, precision, options };
                for level in [1, 3] {
                    if let Err(reason) = compare(&task, level) {
                        failures.push(format!(
                            "{what}: {scheme:?} {precision:?} level {level} {options:?}: {reason}"
                        ));
                    }
                }
            }
        }
    }
}

/// Seams of every kind on a closed and on an open mesh; two channels at once.
fn cases() -> Vec<(Control, &'static str)> {
    let grid = || shapes::grid(4, 4);
    vec![
        (seamed(grid(), &[]), "no seam"),
        (seamed(grid(), &[[10, 11], [11, 12], [12, 13], [13, 14]]), "across"),
        (seamed(grid(), &[[10, 11], [11, 12]]), "ends inside"),
        (seamed(grid(), &[[2, 7], [7, 12], [12, 11], [11, 10]]), "an angle: concave and convex"),
        (seamed(grid(), &[[12, 7], [12, 13], [12, 17], [12, 11]]), "four ends meet"),
        (
            seamed(grid(), &[[2, 7], [7, 12], [12, 17], [17, 22], [10, 11], [11, 12]]),
            "three regions meet",
        ),
        (seamed(grid(), &[[6, 7], [7, 12], [12, 11], [11, 6]]), "one face cut out"),
        (
            seamed(seamed(grid(), &[[10, 11], [11, 12]]), &[[2, 7], [7, 12], [12, 13], [13, 14]]),
            "two channels",
        ),
        (seamed(grid().creased(&[[7, 12], [12, 17]], 1.5), &[[11, 12], [12, 13]]), "with a crease"),
        (seamed(grid().cornered(&[12], 2.5), &[[11, 12], [12, 13]]), "with a sharp vertex"),
        (seamed(grid().creased(&[[2, 7], [7, 12]], 1.5), &[[11, 12], [12, 13]]), "a crease above"),
        (seamed(grid().creased(&[[12, 17], [17, 22]], 1.5), &[[11, 12], [12, 13]]), "one below"),
        (joined(seamed(grid(), &[[2, 7], [7, 12]]), [2, 7]), "ends inside and on the boundary"),
        (joined(seamed(grid(), &[[12, 7], [12, 13], [12, 17]]), [12, 7]), "two pieces, a corner"),
        (joined(seamed(grid(), &[[12, 7], [12, 13], [12, 17]]), [12, 13]), "two pieces, a half"),
        (seamed(shapes::prism(5), &[[0, 5], [5, 6], [6, 7]]), "closed, a face that is no quad"),
        (
            seamed(shapes::cube(), &[[0, 1], [1, 3], [3, 2], [2, 0], [0, 4], [4, 5]]),
            "unfolded cube",
        ),
    ]
}

#[test]
fn all_modes_on_quads() {
    let mut failures = Vec::new();
    for (control, what) in cases() {
        let control = control.rounded();
        in_all_modes(&control, Scheme::CatmullClark, what, &mut failures);
        in_all_modes(&control, Scheme::Bilinear, what, &mut failures);
    }
    assert!(
        failures.is_empty(),
        "{} differ:\n{}",
        failures.len(),
        failures[..failures.len().min(30)].join("\n")
    );
}

#[test]
fn all_modes_on_triangles() {
    let mut failures = Vec::new();
    let grid = || shapes::triangulated(&shapes::grid(4, 4));
    for (control, what) in [
        (seamed(grid(), &[[10, 11], [11, 12]]), "ends inside"),
        (seamed(grid(), &[[10, 11], [11, 12], [12, 13], [13, 14]]), "across"),
        (seamed(grid(), &[[2, 7], [7, 12], [12, 11], [11, 10]]), "an angle"),
        (joined(seamed(grid(), &[[12, 7], [12, 13], [12, 17]]), [12, 7]), "two pieces"),
        (joined(seamed(grid(), &[[12, 7], [12, 13], [12, 17]]), [12, 17]), "two others"),
        (seamed(shapes::icosahedron(), &[[0, 1], [1, 2], [2, 3]]), "icosahedron"),
    ] {
        in_all_modes(&control.rounded(), Scheme::Loop, what, &mut failures);
    }
    assert!(
        failures.is_empty(),
        "{} differ:\n{}",
        failures.len(),
        failures[..failures.len().min(30)].join("\n")
    );
}
