//! Around extraordinary vertices: the values of the vertex and of its neighbours at every
//! level, which follow from those of the level before and from nothing else.

use super::kernel::{Value, widen};
use super::primal_kernel::{face_mean, mix_edge, mix_vertex, weights};
use crate::base::{Context, Result, Scalar, memory};
use crate::refine::{PatchFans, Patches, Pieces};
use crate::scheme::SmoothMasks;

/// What surrounds the extraordinary vertices at one level.
struct Level<L> {
    /// By vertex.
    own: Vec<L>,
    /// By slot: the end of the outgoing edge, and across the face.
    near: Vec<L>,
    across: Vec<L>,
}

/// The extraordinary vertices and their neighbours, level by level.
pub(super) struct FanValues<T: Scalar> {
    /// By level and vertex, by level and slot.
    own: Vec<Vec<T::Lanes>>,
    near: Vec<Vec<T::Lanes>>,
}

impl<T: Scalar> FanValues<T> {
    /// Follows the vertices through all levels of the patches.
    pub(super) fn new<const W: usize>(
        context: &Context,
        patches: &Patches,
        masks: &SmoothMasks<f64>,
        values: &[Value<T, W>],
    ) -> Result<Self> {
        let depth = patches.depth() as usize;
        let (mut own, mut near) = (memory::reserved(depth)?, memory::reserved(depth)?);
        if masks.is_linear() || patches.fans.vertices().is_empty() {
            return Ok(Self { own, near });
        }
        let mut level = gather::<T, W>(patches, values)?;
        for _ in 0..depth {
            level = refine::<T>(context, patches, masks, &level)?;
            own.push(memory::copied(&level.own)?);
            near.push(memory::copied(&level.near)?);
        }
        Ok(Self { own, near })
    }

    /// The value of a vertex, by its place among the extraordinary ones, after a level's step.
    #[inline]
    pub(super) fn own(&self, level: usize, vertex: usize) -> T::Lanes {
        self.own[level][vertex]
    }

    /// The value of the neighbour of a slot after a level's step.
    #[inline]
    pub(super) fn near(&self, level: usize, slot: usize) -> T::Lanes {
        self.near[level][slot]
    }
}

/// What surrounds the vertices in the parent.
fn gather<T: Scalar, const W: usize>(
    patches: &Patches,
    values: &[Value<T, W>],
) -> Result<Level<T::Lanes>> {
    let (fans, mesh) = (&patches.fans, patches.parent());
    let value = |vertex: u32| widen::<T, W>(&values[vertex as usize]);
    let corner = |corner: u32| value(mesh.vert[corner as usize]);
    let across = |&c: &u32| corner(mesh.next(mesh.next(c)));
    let quads = patches.pieces() == Pieces::Quads;
    Ok(Level {
        own: memory::collect(fans.vertices().iter().map(|&v| value(v)))?,
        near: memory::collect(fans.corners().iter().map(|&c| corner(mesh.next(c))))?,
        across: memory::collect(fans.corners().iter().filter(|_| quads).map(across))?,
    })
}

/// One step around the vertices.
fn refine<T: Scalar>(
    context: &Context,
    patches: &Patches,
    masks: &SmoothMasks<f64>,
    level: &Level<T::Lanes>,
) -> Result<Level<T::Lanes>> {
    let fans = &patches.fans;
    let zero = T::lanes([T::default(); 4]);
    let edge = masks.edge(0);
    let edge = [edge.end, edge.beside].map(T::from_f64);
    let mut across = memory::filled(zero, level.across.len())?;
    context.fill(&mut across, 1, |first, part| {
        for (slot, out) in (first..).zip(part) {
            let (own, next) = (level.own[fans.owner(slot)], fans.turn(slot, 1));
            let quad = [own, level.near[slot], level.across[slot], level.near[next]];
            *out = face_mean::<T, _>(quad);
        }
    })?;
    // The sides of an edge: faces of quads, the vertices opposite in triangles.
    let sides = |slot: usize| match patches.pieces() {
        Pieces::Quads => [across[fans.back(slot)], across[slot]],
        Pieces::Triangles => [level.near[fans.back(slot)], level.near[fans.turn(slot, 1)]],
    };
    let mut near = memory::filled(zero, level.near.len())?;
    context.fill(&mut near, 1, |first, part| {
        for (slot, out) in (first..).zip(part) {
            let ends = [level.own[fans.owner(slot)], level.near[slot]];
            *out = mix_edge(edge, ends, sides(slot));
        }
    })?;
    let mut own = memory::filled(zero, level.own.len())?;
    context.fill(&mut own, 1, |first, part| {
        let mut masks = masks.clone();
        for (vertex, out) in (first..).zip(part) {
            *out = vertex_value::<T>(fans, &mut masks, vertex, level, &across);
        }
    })?;
    Ok(Level { own, near, across })
}

/// The new value of an extraordinary vertex: neighbours and faces are added up from the
/// start of the fan on, as [`super::primal_kernel::VertexKernel`] does.
fn vertex_value<T: Scalar>(
    fans: &PatchFans,
    masks: &mut SmoothMasks<f64>,
    vertex: usize,
    level: &Level<T::Lanes>,
    across: &[T::Lanes],
) -> T::Lanes {
    let slots = fans.slots_of(vertex);
    let weights = weights::<T>(&masks.vertex(slots.len()));
    let zero = T::lanes([T::default(); 4]);
    let near = level.near[slots.clone()].iter().fold(zero, |sum, &x| sum + x);
    let faces = across.get(slots).unwrap_or(&[]).iter().fold(zero, |sum, &x| sum + x);
    mix_vertex(weights, level.own[vertex], near, faces)
}
