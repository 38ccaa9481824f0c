//! `carvel_mesh`: the topology of a mesh, checked.

use super::buffer::{input, list, output};
use super::guard::{Call, call};
use super::object::{destroy_function, object};
use super::status::{
    CARVEL_STATUS_LENGTH_MISMATCH, CARVEL_STATUS_TOO_LARGE, Fault, Result, carvel_status,
};
use super::versioned::{check, init_function, initial, read, versioned, write};
use super::{carvel_context, carvel_error};
use crate::base::{Context, NONE, memory};
use crate::mesh::{BuildOptions, Built, Mesh, NonManifold, Survey, build};
use crate::refine::Counts;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

object!(carvel_mesh, Shared);

/// A mesh and where its vertices came from.
pub(super) struct Shared {
    pub(super) mesh: Arc<Mesh>,
    /// The caller's vertex of each vertex, where policy `cut` made copies.
    vertex_sources: Option<Vec<u32>>,
}

impl Shared {
    /// A mesh whose vertices and faces are their own sources.
    pub(super) fn level(mesh: Arc<Mesh>) -> Self {
        Self { mesh, vertex_sources: None }
    }
}

pub const CARVEL_NON_MANIFOLD_REFUSE: i32 = 0;
pub const CARVEL_NON_MANIFOLD_CUT: i32 = 1;

versioned! {
    pub struct carvel_mesh_desc {
        pub struct_size: u32,
        pub face_size: u32,
        pub vertex_count: u64,
        pub face_count: u64,
        pub face_sizes: *const u32,
        pub face_offsets: *const u32,
        pub face_vertices: *const u32,
        pub face_vertex_count: u64,
        pub non_manifold: i32,
        pub anchored: i32,
        pub corner_tags: *const u32,
        pub corner_tag_count: u64,
    }
}

impl carvel_mesh_desc {
    /// Builds the mesh described.
    ///
    /// # Safety
    /// The pointers lead to as many entries as the counts say.
    unsafe fn build(&self, context: &Context) -> Result<Shared> {
        self.check_counts()?;
        if self.face_sizes.is_null() {
            // Sizes are made here; what the rest takes is checked when it begins.
            context.check_memory(4 * self.face_count)?;
        }
        // SAFETY: the caller's contract.
        let sizes = unsafe { self.sizes()? };
        // SAFETY: the caller's contract.
        let indices =
            unsafe { input(self.face_vertices, self.face_vertex_count, "face_vertices")? };
        // SAFETY: the caller's contract.
        let tags = unsafe { input(self.corner_tags, self.corner_tag_count, "corner_tags")? };
        let options = BuildOptions {
            non_manifold: non_manifold(self.non_manifold)?,
            anchored: flag(self.anchored, "anchored")?,
            corner_tags: tags,
            ..BuildOptions::default()
        };
        let vertices = self.vertex_count as usize;
        let Built { mesh, vertex_source } = build(context, vertices, &sizes, indices, &options)?;
        Ok(Shared { mesh: mesh.into(), vertex_sources: vertex_source })
    }

    /// No array is longer than what indices can name.
    fn check_counts(&self) -> Result<()> {
        let counts = [
            ("vertex_count", self.vertex_count),
            ("face_count", self.face_count),
            ("face_vertex_count", self.face_vertex_count),
            ("corner_tag_count", self.corner_tag_count),
        ];
        match counts.iter().find(|(_, count)| *count >= u64::from(NONE)) {
            Some((name, count)) => Err(Fault::new(
                CARVEL_STATUS_TOO_LARGE,
                format!("{name}: {count} does not fit 32-bit indices"),
            )),
            None => Ok(()),
        }
    }

    /// The size of every face, from whichever layout is given.
    ///
    /// # Safety
    /// As [`Self::build`].
    unsafe fn sizes<'a>(&self) -> Result<Cow<'a, [u32]>> {
        let given = [self.face_size != 0, !self.face_sizes.is_null(), !self.face_offsets.is_null()];
        match given {
            // SAFETY: the caller's contract.
            [false, true, false] => unsafe {
                Ok(input(self.face_sizes, self.face_count, "face_sizes")?.into())
            },
            // SAFETY: the caller's contract.
            [false, false, true] => unsafe {
                let offsets = input(self.face_offsets, self.face_count + 1, "face_offsets")?;
                Ok(self.sizes_from(offsets)?.into())
            },
            [true, false, false] => Ok(self.equal_sizes()?.into()),
            [false, false, false] if self.face_count == 0 => Ok([].as_slice().into()),
            _ => Err(Fault::out_of_range(
                "exactly one of face_sizes, face_offsets and face_size must be given",
            )),
        }
    }

    fn equal_sizes(&self) -> Result<Vec<u32>> {
        self.check_corners(self.face_count * u64::from(self.face_size))?;
        Ok(memory::filled(self.face_size, self.face_count as usize)?)
    }

    fn sizes_from(&self, offsets: &[u32]) -> Result<Vec<u32>> {
        let falling = offsets.windows(2).position(|pair| pair[0] > pair[1]);
        if let (1.., _) | (_, Some(_)) = (offsets[0], falling) {
            let at = falling.map_or(0, |face| face + 1);
            let offset = offsets[at];
            return Err(Fault::out_of_range(format!(
                "face_offsets[{at}] is {offset}: offsets start at 0 and never fall"
            )));
        }
        self.check_corners(u64::from(offsets[offsets.len() - 1]))?;
        Ok(memory::collect(offsets.windows(2).map(|pair| pair[1] - pair[0]))?)
    }

    fn check_corners(&self, corners: u64) -> Result<()> {
        if corners == self.face_vertex_count {
            return Ok(());
        }
        Err(Fault::new(
            CARVEL_STATUS_LENGTH_MISMATCH,
            format!(
                "the faces have {corners} corners, but face_vertex_count is {}",
                self.face_vertex_count
            ),
        ))
    }
}

fn non_manifold(policy: i32) -> Result<NonManifold> {
    match policy {
        CARVEL_NON_MANIFOLD_REFUSE => Ok(NonManifold::Error),
        CARVEL_NON_MANIFOLD_CUT => Ok(NonManifold::Cut),
        other => Err(Fault::out_of_range(format!("there is no non-manifold policy {other}"))),
    }
}

fn flag(value: i32, name: &str) -> Result<bool> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Fault::out_of_range(format!("{name} is {other}, not 0 or 1"))),
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

init_function!(carvel_mesh_desc_init, carvel_mesh_desc);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mesh_create(
    context: *const carvel_context,
    desc: *const carvel_mesh_desc,
    out: *mut *mut carvel_mesh,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let context = call.context(context)?;
                read(desc)?.build(&context)
            })
        })
    }
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
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mesh_validate(
    mesh: *const carvel_mesh,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { call(error, |call| Ok(call.object(mesh)?.mesh.validate()?)) }
}
