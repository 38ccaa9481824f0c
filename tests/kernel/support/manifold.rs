//! A brute-force check that a face list is an orientable manifold.
//!
//! It shares nothing with [`super::topology`]: it looks at the link of every
//! vertex, not at twins.

use std::collections::{HashMap, HashSet};

/// Everything that is wrong with a face list, in words; empty for a manifold.
pub fn defects(vertices: usize, faces: &[Vec<usize>]) -> Vec<String> {
    let mut found: Vec<_> =
        faces.iter().enumerate().filter_map(|(f, cycle)| face_defect(vertices, f, cycle)).collect();
    // The checks below index by vertex and mean little on broken faces.
    if found.is_empty() {
        found = edge_defects(faces);
    }
    if found.is_empty() {
        found = link_defects(vertices, faces);
    }
    found
}

/// Panics, with the defects, on a face list that is not manifold.
pub fn assert_manifold(vertices: usize, faces: &[Vec<usize>]) {
    let found = defects(vertices, faces);
    assert!(found.is_empty(), "not a manifold: {}\nfaces: {faces:?}", found.join("; "));
}

fn face_defect(vertices: usize, f: usize, cycle: &[usize]) -> Option<String> {
    let distinct: HashSet<_> = cycle.iter().collect();
    if cycle.len() < 3 {
        Some(format!("face {f} has {} vertices", cycle.len()))
    } else if let Some(v) = cycle.iter().find(|&&v| v >= vertices) {
        Some(format!("face {f} uses vertex {v} of {vertices}"))
    } else if distinct.len() < cycle.len() {
        Some(format!("face {f} repeats a vertex: {cycle:?}"))
    } else {
        None
    }
}

fn sides(cycle: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    cycle.iter().enumerate().map(|(i, &a)| (a, cycle[(i + 1) % cycle.len()]))
}

fn edge_defects(faces: &[Vec<usize>]) -> Vec<String> {
    let mut directed: HashMap<(usize, usize), usize> = HashMap::new();
    for (a, b) in faces.iter().flat_map(|cycle| sides(cycle)) {
        *directed.entry((a, b)).or_default() += 1;
    }
    // With every direction used at most once, no edge has three faces.
    let twice = directed.iter().filter(|&(_, &uses)| uses > 1);
    let mut found: Vec<_> =
        twice.map(|((a, b), uses)| format!("edge {a} -> {b} is used {uses} times")).collect();
    found.sort();
    found
}

/// Each face at `v` is an arc of the link of `v`, from the vertex after `v` to
/// the one before; a disk's link is one path or one cycle. No vertex of it has
/// two arcs out or in once the edges are sound, so connected is enough.
fn link_defects(vertices: usize, faces: &[Vec<usize>]) -> Vec<String> {
    let mut links: Vec<HashMap<usize, usize>> = vec![HashMap::new(); vertices];
    for cycle in faces {
        for i in 0..cycle.len() {
            let n = cycle.len();
            links[cycle[i]].insert(cycle[(i + 1) % n], cycle[(i + n - 1) % n]);
        }
    }
    let broken = links.iter().enumerate().filter(|(_, link)| !is_one_chain(link));
    broken.map(|(v, _)| format!("vertex {v} has several fans")).collect()
}

/// Whether arcs `from -> to` form one path or one cycle.
fn is_one_chain(arcs: &HashMap<usize, usize>) -> bool {
    let Some(&any) = arcs.keys().next() else { return true };
    let heads: HashSet<_> = arcs.values().collect();
    // A path starts where no arc arrives; a cycle anywhere.
    let start = arcs.keys().find(|a| !heads.contains(a)).copied().unwrap_or(any);
    let mut at = start;
    let mut walked = 0;
    while let Some(&to) = arcs.get(&at) {
        walked += 1;
        at = to;
        if at == start {
            break;
        }
    }
    walked == arcs.len()
}
