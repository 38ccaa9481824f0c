//! `carvel_hierarchy`: all levels, kept.

use super::buffer::{Target, check_overlap, check_pointer, output};
use super::guard::call;
use super::mesh::Shared;
use super::object::{destroy_function, look, object};
use super::refiner::Precision;
use super::status::{Result, carvel_status};
use super::values::{CARVEL_INTERPOLATION_VERTEX, ConstValues, Values, interpolation};
use super::versioned::write;
use super::{carvel_context, carvel_counts, carvel_error, carvel_mesh, carvel_scheme};
use crate::base::Context;
use crate::hierarchy::{Hierarchy, Interpolation, Prediction};
use crate::refine::{FaceOrigin, VertexOrigin};
use std::sync::Arc;

object!(carvel_hierarchy, Hierarchy);

pub const CARVEL_ORIGIN_FACE: u32 = 1;
pub const CARVEL_ORIGIN_EDGE: u32 = 2;
pub const CARVEL_ORIGIN_VERTEX: u32 = 3;
pub const CARVEL_ORIGIN_CORNER: u32 = 4;
pub const CARVEL_ORIGIN_EDGE_START: u32 = 5;
pub const CARVEL_ORIGIN_EDGE_END: u32 = 6;

#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct carvel_origin {
    pub kind: u32,
    pub index: u32,
}

impl From<VertexOrigin> for carvel_origin {
    fn from(origin: VertexOrigin) -> Self {
        let (kind, index) = match origin {
            VertexOrigin::Corner(c) => (CARVEL_ORIGIN_CORNER, c),
            VertexOrigin::EdgeEnd { corner, at_end: false } => (CARVEL_ORIGIN_EDGE_START, corner),
            VertexOrigin::EdgeEnd { corner, at_end: true } => (CARVEL_ORIGIN_EDGE_END, corner),
            VertexOrigin::Vertex(v) => (CARVEL_ORIGIN_VERTEX, v),
            VertexOrigin::Edge(c) => (CARVEL_ORIGIN_EDGE, c),
            VertexOrigin::Face(f) => (CARVEL_ORIGIN_FACE, f),
        };
        Self { kind, index }
    }
}

impl From<FaceOrigin> for carvel_origin {
    fn from(origin: FaceOrigin) -> Self {
        let (kind, index) = match origin {
            FaceOrigin::Face(f) => (CARVEL_ORIGIN_FACE, f),
            FaceOrigin::Edge(c) => (CARVEL_ORIGIN_EDGE, c),
            FaceOrigin::Vertex(v) => (CARVEL_ORIGIN_VERTEX, v),
            FaceOrigin::Corner(c) => (CARVEL_ORIGIN_CORNER, c),
        };
        Self { kind, index }
    }
}

/// # Safety
/// The header's contract.
unsafe fn refine<T: Precision>(
    hierarchy: *const carvel_hierarchy,
    context: *const carvel_context,
    (level, kind): (u32, i32),
    (values, out): (*const ConstValues<T>, *const Values<T>),
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the caller's contract.
    unsafe {
        call(error, |call| {
            let hierarchy = call.object(hierarchy)?;
            let context = call.context(context)?;
            let kind = interpolation(kind)?;
            check_pointer(values, "values")?;
            check_pointer(out, "out")?;
            refine_values(hierarchy, &context, (level, kind), (values.read(), out.read()))
        })
    }
}

/// # Safety
/// The header's contract.
unsafe fn refine_values<T: Precision>(
    hierarchy: &Hierarchy,
    context: &Context,
    (level, kind): (u32, Interpolation),
    (values, out): (ConstValues<T>, Values<T>),
) -> Result<()> {
    hierarchy.scheme().check_interpolation(kind)?;
    let refined = hierarchy.shared_mesh(level)?.vertices() as u64;
    let from = values.check(hierarchy.mesh(0).vertices() as u64, "values".into())?;
    let to = out.check(refined, from.width, "out".into())?;
    check_overlap(&[from.read_span(), to.write_span()])?;
    let copies = from.copy_bytes::<T>() + out.copy_bytes(refined);
    if copies > 0 {
        // The refinement itself checks what it needs for values without gaps.
        let plan = Prediction::new(hierarchy.mesh(0), hierarchy.scheme(), level)?;
        let plan = plan.level_by_level();
        let scratch = plan.refiner_bytes(from.width as u64, T::BYTES, false);
        context.check_memory(scratch.saturating_add(copies))?;
    }
    // SAFETY: the caller's contract; overlap has been checked.
    let (from, width, mut to) = unsafe { (from.read()?, from.width, to.sink()?) };
    hierarchy.interpolate(context, level, kind, from.values(), width, to.values())?;
    // SAFETY: as above.
    unsafe { to.finish() };
    Ok(())
}

/// Fills a caller's array with the origins of a level.
///
/// # Safety
/// The header's contract.
unsafe fn origins<O: Into<carvel_origin>>(
    error: *mut carvel_error,
    hierarchy: *const carvel_hierarchy,
    (out, capacity): (*mut carvel_origin, u64),
    list: impl FnOnce(&Hierarchy) -> crate::Result<Vec<O>>,
) -> carvel_status {
    // SAFETY: the caller's contract.
    unsafe {
        call(error, |call| {
            let list = list(call.object(hierarchy)?)?;
            let out = output((out, capacity), list.len() as u64, "out")?;
            for (slot, origin) in out.iter_mut().zip(list) {
                *slot = origin.into();
            }
            Ok(())
        })
    }
}

/// Arrays for a sparse matrix.
struct Matrix<'a> {
    offsets: &'a mut [u64],
    /// Not written if empty.
    entries: Option<(&'a mut [u32], &'a mut [f64])>,
}

impl Matrix<'_> {
    fn fill(mut self, hierarchy: &Hierarchy, level: u32, stage: usize) -> Result<()> {
        let mut at = 0;
        self.offsets[0] = 0;
        Ok(hierarchy.each_row_of::<f64>(level, stage, |vertex, row| {
            if let Some((indices, weights)) = &mut self.entries {
                for (i, (index, weight)) in (at..).zip(row) {
                    indices[i] = *index;
                    weights[i] = *weight;
                }
            }
            at += row.len();
            self.offsets[vertex as usize + 1] = at as u64;
        })?)
    }
}

/// The number of entries of a stage.
fn count_entries(hierarchy: &Hierarchy, level: u32, stage: u32) -> Result<u64> {
    let mut entries = 0;
    hierarchy.each_row_of::<f64>(level, stage as usize, |_, row| entries += row.len() as u64)?;
    Ok(entries)
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_hierarchy_create(
    context: *const carvel_context,
    mesh: *const carvel_mesh,
    scheme: *const carvel_scheme,
    levels: u32,
    out: *mut *mut carvel_hierarchy,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let context = call.context(context)?;
                let (mesh, scheme) = (call.object(mesh)?, call.object(scheme)?);
                Ok(Hierarchy::new(&context, Arc::clone(&mesh.mesh), scheme.clone(), levels)?)
            })
        })
    }
}

destroy_function!(carvel_hierarchy_destroy, carvel_hierarchy);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_hierarchy_last_level(hierarchy: *const carvel_hierarchy) -> u32 {
    // SAFETY: the header's contract.
    unsafe { look(hierarchy) }.map_or(0, |handle| handle.value.last_level())
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_hierarchy_counts(
    hierarchy: *const carvel_hierarchy,
    level: u32,
    counts: *mut carvel_counts,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let mesh = call.object(hierarchy)?.shared_mesh(level)?;
            write(counts, &carvel_counts::of_mesh(&mesh, level))
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_hierarchy_mesh(
    hierarchy: *const carvel_hierarchy,
    level: u32,
    out: *mut *mut carvel_mesh,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| Ok(Shared::level(call.object(hierarchy)?.shared_mesh(level)?)))
        })
    }
}

/// The functions that exist for each number type.
macro_rules! twins {
    ($number:ty, $refine:ident, $interpolate:ident) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $refine(
            hierarchy: *const carvel_hierarchy,
            context: *const carvel_context,
            level: u32,
            values: *const ConstValues<$number>,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            let what = (level, CARVEL_INTERPOLATION_VERTEX);
            // SAFETY: the header's contract.
            unsafe { refine(hierarchy, context, what, (values, out), error) }
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $interpolate(
            hierarchy: *const carvel_hierarchy,
            context: *const carvel_context,
            level: u32,
            interpolation: i32,
            values: *const ConstValues<$number>,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe { refine(hierarchy, context, (level, interpolation), (values, out), error) }
        }
    };
}

twins!(f32, carvel_hierarchy_refine_f32, carvel_hierarchy_interpolate_f32);
twins!(f64, carvel_hierarchy_refine_f64, carvel_hierarchy_interpolate_f64);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_hierarchy_vertex_origins(
    hierarchy: *const carvel_hierarchy,
    level: u32,
    out: *mut carvel_origin,
    capacity: u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { origins(error, hierarchy, (out, capacity), |h| h.vertex_origins(level)) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_hierarchy_face_origins(
    hierarchy: *const carvel_hierarchy,
    level: u32,
    out: *mut carvel_origin,
    capacity: u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { origins(error, hierarchy, (out, capacity), |h| h.face_origins(level)) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_hierarchy_rows(
    hierarchy: *const carvel_hierarchy,
    level: u32,
    stage: u32,
    offsets: *mut u64,
    offset_capacity: u64,
    indices: *mut u32,
    weights: *mut f64,
    capacity: u64,
    count: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let hierarchy = call.object(hierarchy)?;
            let rows = hierarchy.shared_mesh(level)?.vertices() as u64;
            let entries = count_entries(hierarchy, level, stage)?;
            let wanted = if capacity == 0 { 0 } else { entries };
            let offsets = Target::new((offsets, offset_capacity), rows + 1, "offsets");
            let indices = Target::new((indices, capacity), wanted, "indices");
            let weights = Target::new((weights, capacity), wanted, "weights");
            let mut spans = vec![offsets.span()?, indices.span()?, weights.span()?];
            if !count.is_null() {
                spans.push(Target::new((count, 1), 1, "count").span()?);
            }
            check_overlap(&spans)?;
            if let Some(count) = count.as_mut() {
                *count = entries;
            }
            let entries = (capacity > 0).then(|| (indices.slice(), weights.slice()));
            Matrix { offsets: offsets.slice(), entries }.fill(hierarchy, level, stage as usize)
        })
    }
}
