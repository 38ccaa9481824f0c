//! Vertices of faces that are no quads under a scheme with one pass, level by level.
//!
//! Such a vertex has four children: in the face, in the quads of the two edges and in that of
//! the vertex. These *rings* follow from those of the level before around the same face and
//! from nothing else: the four children are the quad of the vertex in the next level, and those
//! at two corners next to each other hold the quad of the edge between them. Terms are added in
//! the order in which rows are sent (`scheme/dual_rows.rs`), so that the bits are those of one
//! level after the other.

use super::kernel::{QuadWeights, Value, quad_children, widen};
use crate::base::{Context, Fraction, Result, Scalar, memory};
use crate::mesh::Mesh;
use crate::refine::Tiles;
use crate::scheme::{CornerWeights, Scheme, TunedWeights};

/// The children of a vertex, counter-clockwise from the one in the face.
type Ring<L> = [L; 4];

/// The rings around all faces that are no quads.
pub(super) struct TileRings<T: Scalar> {
    /// By level, from the first on, and by corner.
    levels: Vec<Vec<Ring<T::Lanes>>>,
}

impl<T: Scalar> TileRings<T> {
    /// Follows the rings through all levels of the tiles, from the values of the first, which
    /// are those of the parent's corners.
    pub(super) fn new<const W: usize>(
        context: &Context,
        tiles: &Tiles,
        scheme: &Scheme,
        first: &[Value<T, W>],
    ) -> Result<Self> {
        let mesh = tiles.parent();
        let ring = |corner: u32| {
            let mut at = corner;
            std::array::from_fn(|_| {
                let value = widen::<T, W>(&first[at as usize]);
                at = mesh.ccw(at);
                value
            })
        };
        let mut levels = memory::reserved(tiles.depth() as usize)?;
        levels.push(memory::collect((0..tiles.sectors()).map(ring))?);
        for level in 1..tiles.depth() as usize {
            levels.push(next_level::<T>(context, mesh, scheme, &levels[level - 1])?);
        }
        Ok(Self { levels })
    }

    /// The children that a corner's vertex of the level before has in a level.
    #[inline]
    pub(super) fn at(&self, level: u32, corner: u32) -> Ring<T::Lanes> {
        self.levels[level as usize - 1][corner as usize]
    }

    /// Those of the last level.
    pub(super) fn last(&self) -> &[Ring<T::Lanes>] {
        self.levels.last().map_or(&[], Vec::as_slice)
    }
}

/// What the split makes at a corner: its own child, the quad of the edge that leaves it, from
/// the next vertex of the face on, and the quad of its vertex, from the vertex on.
#[derive(Clone, Copy)]
struct Split<L> {
    own: L,
    edge: [L; 4],
    vertex: [L; 4],
}

fn next_level<T: Scalar>(
    context: &Context,
    mesh: &Mesh,
    scheme: &Scheme,
    rings: &[Ring<T::Lanes>],
) -> Result<Vec<Ring<T::Lanes>>> {
    let zero = T::lanes([T::default(); 4]);
    let nothing = Split { own: zero, edge: [zero; 4], vertex: [zero; 4] };
    let mut splits = memory::filled(nothing, rings.len())?;
    let quads = QuadWeights::<T>::new(scheme);
    context.fill(&mut splits, 1, |first, part| {
        let mut weights = CornerWeights::<f64>::new(scheme.rule(), Fraction::HALF);
        for (corner, slot) in (first as u32..).zip(part) {
            let (own, next) = (rings[corner as usize], rings[mesh.next(corner) as usize]);
            let face = around(mesh, corner);
            let weights = weights.of(face.clone().count()).iter().map(|&w| T::from_f64(w));
            *slot = Split {
                own: face.zip(weights).fold(zero, |sum, (c, w)| sum + rings[c as usize][0] * w),
                edge: quad_children::<T>(quads, [next[0], own[0], own[3], next[1]]),
                vertex: quad_children::<T>(quads, own),
            };
        }
    })?;
    let mut next = memory::filled([zero; 4], rings.len())?;
    let t = scheme.passes()[0];
    context.fill(&mut next, 1, |first, part| {
        let mut weights = CornerWeights::<f64>::new(scheme.rule(), t);
        let mut tuned = scheme.tunes(mesh).then(TunedWeights::new);
        for (corner, slot) in (first as u32..).zip(part) {
            let own = tuned.as_mut().and_then(|tuned| tuned_ring::<T>(mesh, rings, corner, tuned));
            *slot = own.unwrap_or_else(|| smoothed::<T>(mesh, &splits, corner, &mut weights));
        }
    })?;
    Ok(next)
}

/// The corners of a face from one of them on, as rows are sent.
fn around(mesh: &Mesh, corner: u32) -> impl Iterator<Item = u32> + Clone {
    let face = mesh.layout.face(mesh.layout.face_of(corner));
    (corner..face.end).chain(face.start..corner)
}

/// The four children of a vertex by the tuned rule, if its face has one.
fn tuned_ring<T: Scalar>(
    mesh: &Mesh,
    rings: &[Ring<T::Lanes>],
    corner: u32,
    tuned: &mut TunedWeights<f64>,
) -> Option<Ring<T::Lanes>> {
    let face = around(mesh, corner);
    let rows = tuned.of(face.clone().count())?;
    let at = |corner: u32| rings[corner as usize];
    let [_, before, across, after] = at(corner);
    // The vertices around, as they are sent.
    let outside = [before, at(mesh.prev(corner))[3], across, at(mesh.next(corner))[1], after];
    let zero = T::lanes([T::default(); 4]);
    Some(std::array::from_fn(|child| {
        let values = outside.into_iter().chain(face.clone().map(|c| at(c)[0]));
        let weights = rows[child].iter().map(|&w| T::from_f64(w));
        values.zip(weights).fold(zero, |sum, (x, w)| sum + x * w)
    }))
}

/// The pass at the four children of a vertex: the face of each, what its two edges and its
/// vertex become.
fn smoothed<T: Scalar>(
    mesh: &Mesh,
    splits: &[Split<T::Lanes>],
    corner: u32,
    weights: &mut CornerWeights<f64>,
) -> Ring<T::Lanes> {
    // Each child is in four faces.
    let share = |&w: &f64| T::from_f64(0.25 * w);
    let at = |corner: u32| splits[corner as usize];
    let (before, here, after) = (at(mesh.prev(corner)), at(corner), at(mesh.next(corner)));
    // The edge's quad before the corner and after it, the vertex's, and the face's own.
    let (p, e, v) = (before.edge, here.edge, here.vertex);
    let [own, previous, next] = [here.own, before.own, after.own];
    let of_quads: [T; 4] = std::array::from_fn(|i| share(&weights.of(4)[i]));
    let add = |sum: T::Lanes, quad: &[T::Lanes; 4]| {
        quad.iter().zip(of_quads).fold(sum, |sum, (&x, w)| sum + x * w)
    };
    let sum = |quads: &[[T::Lanes; 4]], start: T::Lanes| quads.iter().fold(start, add);
    let zero = T::lanes([T::default(); 4]);
    let face = around(mesh, corner);
    let of_face = weights.of(face.clone().count()).iter().map(share);
    let in_face = face.zip(of_face).fold(zero, |sum, (c, w)| sum + at(c).own * w);
    [
        sum(
            &[[own, e[1], e[0], next], [own, p[0], v[0], e[1]], [own, previous, p[1], p[0]]],
            in_face,
        ),
        sum(
            &[p, [p[0], own, previous, p[1]], [p[0], v[0], e[1], own], [p[0], p[3], v[1], v[0]]],
            zero,
        ),
        sum(
            &[v, [v[0], p[0], p[3], v[1]], [v[0], e[1], own, p[0]], [v[0], v[3], e[2], e[1]]],
            zero,
        ),
        sum(
            &[
                [e[1], e[2], e[3], e[0]],
                [e[1], v[0], v[3], e[2]],
                [e[1], own, p[0], v[0]],
                [e[1], e[0], next, own],
            ],
            zero,
        ),
    ]
}
