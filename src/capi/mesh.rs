//! `carvel_mesh`: the topology of a mesh, checked.

use super::buffer::{list, output};
use super::carvel_error;
use super::guard::{Call, call};
use super::object::{destroy_function, look, object};
use super::status::{Fault, Result, carvel_status};
use super::versioned::{check, init_function, initial, versioned, write};
use crate::mesh::{Built, Mesh, Survey};
use crate::refine::Counts;
use std::collections::BTreeMap;
use std::sync::Arc;

object!(carvel_mesh, Shared);

/// A mesh and where its vertices came from.
pub(super) struct Shared {
    pub(super) mesh: Arc<Mesh>,
    /// The caller's vertex of each vertex, where policy `cut` made copies.
    vertex_sources: Option<Vec<u32>>,
}

impl From<Built> for Shared {
    fn from(Built { mesh, vertex_source }: Built) -> Self {
        Self { mesh: mesh.into(), vertex_sources: vertex_source }
    }
}

impl Shared {
    /// A mesh whose vertices and faces are their own sources.
    pub(super) fn level(mesh: Arc<Mesh>) -> Self {
        Self { mesh, vertex_sources: None }
    }
}

versioned! {
    pub struct carvel_counts {
        pub struct_size: u32,
        pub level: u32,
        pub vertices: u64,
        pub faces: u64,
        pub corners: u64,
        pub edges: u64,
        pub boundary_edges: u64,
        pub irregular_faces: u64,
    }
}

impl carvel_counts {
    pub(super) fn of_mesh(mesh: &Mesh, level: u32) -> Self {
        Self {
            level,
            vertices: mesh.vertices() as u64,
            faces: mesh.faces() as u64,
            corners: mesh.corners() as u64,
            edges: mesh.edges() as u64,
            boundary_edges: mesh.boundary_edges() as u64,
            irregular_faces: mesh.irregular_faces() as u64,
            ..initial()
        }
    }

    pub(super) fn of_level(counts: &Counts, level: u32) -> Self {
        Self {
            level,
            vertices: counts.vertices,
            faces: counts.faces,
            corners: counts.corners,
            edges: counts.edges,
            boundary_edges: counts.boundary_edges,
            irregular_faces: counts.irregular_faces,
            ..initial()
        }
    }
}

versioned! {
    pub struct carvel_survey {
        pub struct_size: u32,
        pub anchored: i32,
        pub components: u64,
        pub boundary_loops: u64,
        pub isolated_vertices: u64,
        pub euler_characteristic: i64,
        pub corner_tags: u64,
        pub bytes: u64,
        pub creases: u64,
        pub sharp_vertices: u64,
        pub holes: u64,
    }
}

impl carvel_survey {
    fn of(mesh: &Mesh) -> Result<Self> {
        let survey = Survey::try_of(mesh)?;
        Ok(Self {
            anchored: i32::from(mesh.is_anchored()),
            components: survey.components as u64,
            boundary_loops: survey.boundary_loops as u64,
            isolated_vertices: survey.isolated_vertices as u64,
            euler_characteristic: survey.euler_characteristic,
            corner_tags: mesh.corner_tags().len() as u64,
            bytes: mesh.bytes(),
            creases: mesh.creases().len() as u64,
            sharp_vertices: mesh.sharp_vertices().len() as u64,
            holes: mesh.holes().len() as u64,
            ..initial()
        })
    }
}

pub const CARVEL_HISTOGRAM_FACE_SIZES: i32 = 1;
pub const CARVEL_HISTOGRAM_INTERIOR_VALENCES: i32 = 2;
pub const CARVEL_HISTOGRAM_BOUNDARY_VALENCES: i32 = 3;

#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct carvel_histogram_entry {
    pub value: u64,
    pub count: u64,
}

fn histogram(mesh: &Mesh, which: i32) -> Result<Vec<carvel_histogram_entry>> {
    type Pick = fn(Survey) -> BTreeMap<usize, usize>;
    let pick: Pick = match which {
        CARVEL_HISTOGRAM_FACE_SIZES => |survey| survey.face_sizes,
        CARVEL_HISTOGRAM_INTERIOR_VALENCES => |survey| survey.interior_valences,
        CARVEL_HISTOGRAM_BOUNDARY_VALENCES => |survey| survey.boundary_valences,
        other => return Err(Fault::out_of_range(format!("there is no histogram {other}"))),
    };
    let entry =
        |(value, count)| carvel_histogram_entry { value: value as u64, count: count as u64 };
    Ok(pick(Survey::try_of(mesh)?).into_iter().map(entry).collect())
}

/// Fills the offsets of faces from their sizes, the total last.
pub(super) fn write_offsets(sizes: impl Iterator<Item = u32>, out: &mut [u32]) {
    let mut corners = 0;
    out[0] = 0;
    for (slot, size) in out[1..].iter_mut().zip(sizes) {
        corners += size;
        *slot = corners;
    }
}

/// Writes what an iterator gives.
fn write_all<T>(items: impl Iterator<Item = T>, out: &mut [T]) {
    for (slot, item) in out.iter_mut().zip(items) {
        *slot = item;
    }
}

/// Fills a caller's array with something of a mesh.
///
/// # Safety
/// As the header says for its array functions.
unsafe fn fill<T: Copy>(
    error: *mut carvel_error,
    mesh: *const carvel_mesh,
    (out, capacity): (*mut T, u64),
    (name, needed): (&'static str, impl FnOnce(&Mesh) -> usize),
    write: impl FnOnce(&Shared, &mut [T]),
) -> carvel_status {
    let body = |call: &mut Call| {
        // SAFETY: the header's contract.
        let shared = unsafe { call.object(mesh)? };
        let needed = needed(&shared.mesh) as u64;
        // SAFETY: the header's contract.
        write(shared, unsafe { output((out, capacity), needed, name)? });
        Ok(())
    };
    // SAFETY: the header's contract.
    unsafe { call(error, body) }
}

destroy_function!(carvel_mesh_destroy, carvel_mesh);

init_function!(carvel_counts_init, carvel_counts);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mesh_counts(
    mesh: *const carvel_mesh,
    counts: *mut carvel_counts,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| write(counts, &carvel_counts::of_mesh(&call.object(mesh)?.mesh, 0)))
    }
}

init_function!(carvel_survey_init, carvel_survey);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mesh_survey(
    mesh: *const carvel_mesh,
    survey: *mut carvel_survey,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let mesh = call.object(mesh)?;
            check(survey)?;
            write(survey, &carvel_survey::of(&mesh.mesh)?)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mesh_histogram(
    mesh: *const carvel_mesh,
    which: i32,
    out: *mut carvel_histogram_entry,
    capacity: u64,
    count: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let mesh = call.object(mesh)?;
            list(&histogram(&mesh.mesh, which)?, out, capacity, count)
        })
    }
}

/// The functions that fill a caller's array with something of a mesh: name, type of
/// entries, their number, and what writes them.
macro_rules! arrays {
    ($($name:ident: $entry:ty, $needed:expr, $write:expr;)*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            mesh: *const carvel_mesh,
            out: *mut $entry,
            capacity: u64,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe { fill(error, mesh, (out, capacity), (stringify!($name), $needed), $write) }
        }
    )*};
}

arrays! {
    carvel_mesh_face_sizes: u32, Mesh::faces,
        |shared, out| write_all(shared.mesh.face_sizes(), out);
    carvel_mesh_face_offsets: u32, |mesh| mesh.faces() + 1,
        |shared, out| write_offsets(shared.mesh.face_sizes(), out);
    carvel_mesh_face_vertices: u32, Mesh::corners,
        |shared, out| out.copy_from_slice(shared.mesh.corner_vertices());
    carvel_mesh_edges: u32, |mesh| 2 * mesh.edges(),
        |shared, out| write_all(shared.mesh.edge_vertices().flatten(), out);
    carvel_mesh_corner_edges: u32, Mesh::corners,
        |shared, out| shared.mesh.write_corner_edges(out);
    carvel_mesh_corner_twins: u32, Mesh::corners,
        |shared, out| out.copy_from_slice(shared.mesh.corner_twins());
    carvel_mesh_valences: u32, Mesh::vertices,
        |shared, out| write_all((0..).map(|v| shared.mesh.valence(v) as u32), out);
    carvel_mesh_boundary_flags: u8, Mesh::vertices,
        |shared, out| write_all((0..).map(|v| u8::from(shared.mesh.is_boundary_vertex(v))), out);
    carvel_mesh_face_sources: u32, Mesh::faces,
        |shared, out| write_all((0..).map(|f| shared.mesh.face_source(f) as u32), out);
    carvel_mesh_vertex_sources: u32, Mesh::vertices,
        |shared, out| match &shared.vertex_sources {
            Some(sources) => out.copy_from_slice(sources),
            None => write_all(0.., out),
        };
    carvel_mesh_corner_tags: u32, |mesh| mesh.corner_tags().len(),
        |shared, out| out.copy_from_slice(shared.mesh.corner_tags());
    carvel_mesh_crease_vertices: u32, |mesh| 2 * mesh.creases().len(),
        |shared, out| write_all(shared.mesh.creases().flat_map(|crease| crease.vertices), out);
    carvel_mesh_crease_sharpness: f32, |mesh| mesh.creases().len(),
        |shared, out| write_all(shared.mesh.creases().map(|crease| crease.sharpness), out);
    carvel_mesh_sharp_vertices: u32, |mesh| mesh.sharp_vertices().len(),
        |shared, out| write_all(shared.mesh.sharp_vertices().map(|tag| tag.vertex), out);
    carvel_mesh_vertex_sharpness: f32, |mesh| mesh.sharp_vertices().len(),
        |shared, out| write_all(shared.mesh.sharp_vertices().map(|tag| tag.sharpness), out);
    carvel_mesh_holes: u32, |mesh| mesh.holes().len(),
        |shared, out| out.copy_from_slice(shared.mesh.holes());
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mesh_is_manifold(mesh: *const carvel_mesh) -> i32 {
    // SAFETY: the header's contract.
    unsafe { look(mesh) }.map_or(0, |handle| handle.value.mesh.is_manifold().into())
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mesh_validate(
    mesh: *const carvel_mesh,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { call(error, |call| Ok(call.object(mesh)?.mesh.validate()?)) }
}
