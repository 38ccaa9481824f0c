//! An order of faces for the cache, where the caller's order has none.
//!
//! Refinement walks the faces in order and gathers from their neighbours. If the
//! faces of a large mesh come in random order, every one of these is a miss: a
//! step from half a million such faces took six times as long as from the same
//! faces in order. They are then put in breadth-first order, once, when the
//! mesh is built; [`Mesh::face_source`](super::Mesh::face_source) tells it.

use super::Layout;
use crate::base::{NONE, Result, memory};

/// Meshes with fewer corners fit the cache in any order.
const SMALL: usize = 1 << 17;
/// A twin further away than this is a miss.
const FAR: u32 = 1 << 15;

/// The faces in breadth-first order, irregular ones first, if the given order is
/// scattered: entry i is the face that comes at place i.
pub(super) fn breadth_first(layout: &Layout, twin: &[u32]) -> Result<Option<Vec<u32>>> {
    if !is_scattered(twin) {
        return Ok(None);
    }
    let faces = layout.faces();
    let mut order = memory::reserved(faces as usize)?;
    let mut seen = memory::filled(false, faces as usize)?;
    for seed in 0..faces {
        let mut next = order.len();
        visit(seed, &mut seen, &mut order);
        while next < order.len() {
            for corner in layout.face(order[next]) {
                match twin[corner as usize] {
                    NONE => {}
                    twin => visit(layout.face_of(twin), &mut seen, &mut order),
                }
            }
            next += 1;
        }
    }
    // Regular faces keep the order in which they were met.
    let (irregular, all) = (layout.irregular_faces(), || order.iter().copied());
    let first = all().filter(|&face| face < irregular);
    memory::collect(first.chain(all().filter(|&face| face >= irregular))).map(Some)
}

fn visit(face: u32, seen: &mut [bool], order: &mut Vec<u32>) {
    if !std::mem::replace(&mut seen[face as usize], true) {
        order.push(face);
    }
}

/// True if most neighbours of a large mesh are far away.
fn is_scattered(twin: &[u32]) -> bool {
    let far = |(c, &twin): (u32, &u32)| twin != NONE && twin.abs_diff(c) > FAR;
    twin.len() >= SMALL && (0..).zip(twin).filter(|&pair| far(pair)).count() > twin.len() / 2
}

/// The arrays of a mesh in a new order of faces.
pub(super) struct Reordered {
    pub(super) layout: Layout,
    pub(super) vert: Vec<u32>,
    pub(super) twin: Vec<u32>,
}

/// Puts the faces in an order; irregular ones come first in it.
pub(super) fn reorder(
    layout: &Layout,
    vert: &[u32],
    twin: &[u32],
    order: &[u32],
) -> Result<Reordered> {
    let irregular = order[..layout.irregular_faces() as usize].iter();
    let sizes = irregular.map(|&f| layout.face(f).len() as u32);
    let regular = layout.faces() - layout.irregular_faces();
    let new = Layout::new(sizes, layout.side(), regular)?;
    let mut moved = memory::zeroed(vert.len())?;
    for (corner, old) in (0..).zip(order.iter().flat_map(|&f| layout.face(f))) {
        moved[old as usize] = corner;
    }
    let corners = || order.iter().flat_map(|&f| layout.face(f)).map(|c| c as usize);
    let twins = corners().map(|c| match twin[c] {
        NONE => NONE,
        twin => moved[twin as usize],
    });
    let vert = memory::collect(corners().map(|c| vert[c]))?;
    Ok(Reordered { layout: new, vert, twin: memory::collect(twins)? })
}
