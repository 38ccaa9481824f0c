//! `carvel_mesh_desc`: a polygon soup with its tags, and the mesh that is made of it.

use super::buffer::input;
use super::guard::call;
use super::status::{
    CARVEL_STATUS_LENGTH_MISMATCH, CARVEL_STATUS_TOO_LARGE, Fault, Result, carvel_status,
};
use super::versioned::{init_function, read, versioned};
use super::{carvel_context, carvel_error, carvel_mesh};
use crate::base::{Context, Crease, NONE, SharpVertex, memory};
use crate::mesh::{BuildOptions, Built, NonManifold, build};
use std::borrow::Cow;

pub const CARVEL_NON_MANIFOLD_REFUSE: i32 = 0;
pub const CARVEL_NON_MANIFOLD_CUT: i32 = 1;
pub const CARVEL_NON_MANIFOLD_SHARPEN: i32 = 2;

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
        pub crease_vertices: *const u32,
        pub crease_sharpness: *const f32,
        pub crease_count: u64,
        pub sharp_vertices: *const u32,
        pub vertex_sharpness: *const f32,
        pub sharp_vertex_count: u64,
        pub holes: *const u32,
        pub hole_count: u64,
    }
}

/// The tags of a description, as the kernel takes them.
struct Tags<'a> {
    corners: &'a [u32],
    creases: Vec<Crease>,
    sharp_vertices: Vec<SharpVertex>,
    holes: &'a [u32],
}

impl carvel_mesh_desc {
    /// Builds the mesh described.
    ///
    /// # Safety
    /// The pointers lead to as many entries as the counts say.
    unsafe fn build(&self, context: &Context) -> Result<Built> {
        self.check_counts()?;
        // What is copied here; what the rest takes is checked when it begins.
        context.check_memory(self.copied_bytes())?;
        // SAFETY: the caller's contract.
        let sizes = unsafe { self.sizes()? };
        // SAFETY: the caller's contract.
        let indices =
            unsafe { input(self.face_vertices, self.face_vertex_count, "face_vertices")? };
        // SAFETY: the caller's contract.
        let tags = unsafe { self.tags()? };
        let options = BuildOptions {
            non_manifold: non_manifold(self.non_manifold)?,
            anchored: flag(self.anchored, "anchored")?,
            corner_tags: tags.corners,
            creases: &tags.creases,
            sharp_vertices: &tags.sharp_vertices,
            holes: tags.holes,
        };
        Ok(build(context, self.vertex_count as usize, &sizes, indices, &options)?)
    }

    /// Bytes of the sizes, where they come as something else, and of the tags that
    /// come as several arrays. No count is beyond 32 bits.
    fn copied_bytes(&self) -> u64 {
        let sizes = if self.face_sizes.is_null() { 4 * self.face_count } else { 0 };
        let creases = size_of::<Crease>() as u64 * self.crease_count;
        sizes + creases + size_of::<SharpVertex>() as u64 * self.sharp_vertex_count
    }

    /// # Safety
    /// As [`Self::build`].
    unsafe fn tags<'a>(&self) -> Result<Tags<'a>> {
        // SAFETY: the caller's contract.
        unsafe {
            Ok(Tags {
                corners: input(self.corner_tags, self.corner_tag_count, "corner_tags")?,
                creases: self.creases()?,
                sharp_vertices: self.sharp_vertices()?,
                holes: input(self.holes, self.hole_count, "holes")?,
            })
        }
    }

    /// # Safety
    /// As [`Self::build`].
    unsafe fn creases(&self) -> Result<Vec<Crease>> {
        let (count, sharpness) = (self.crease_count, self.crease_sharpness);
        // SAFETY: the caller's contract.
        let ends = unsafe { input(self.crease_vertices, 2 * count, "crease_vertices")? };
        // SAFETY: the caller's contract.
        let sharpness = unsafe { input(sharpness, count, "crease_sharpness")? };
        let pairs = ends.chunks_exact(2).zip(sharpness);
        let crease =
            |(ends, &sharpness): (&[u32], _)| Crease { vertices: [ends[0], ends[1]], sharpness };
        Ok(memory::collect(pairs.map(crease))?)
    }

    /// # Safety
    /// As [`Self::build`].
    unsafe fn sharp_vertices(&self) -> Result<Vec<SharpVertex>> {
        let (count, sharpness) = (self.sharp_vertex_count, self.vertex_sharpness);
        // SAFETY: the caller's contract.
        let vertices = unsafe { input(self.sharp_vertices, count, "sharp_vertices")? };
        // SAFETY: the caller's contract.
        let sharpness = unsafe { input(sharpness, count, "vertex_sharpness")? };
        let pairs = vertices.iter().zip(sharpness);
        let tag = |(&vertex, &sharpness)| SharpVertex { vertex, sharpness };
        Ok(memory::collect(pairs.map(tag))?)
    }

    /// No array is longer than what indices can name.
    fn check_counts(&self) -> Result<()> {
        let counts = [
            ("vertex_count", self.vertex_count),
            ("face_count", self.face_count),
            ("face_vertex_count", self.face_vertex_count),
            ("corner_tag_count", self.corner_tag_count),
            ("crease_count", self.crease_count),
            ("sharp_vertex_count", self.sharp_vertex_count),
            ("hole_count", self.hole_count),
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
        CARVEL_NON_MANIFOLD_SHARPEN => Ok(NonManifold::Sharpen),
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
                Ok(read(desc)?.build(&context)?.into())
            })
        })
    }
}
