//! Meshes, their channels, what they tell, and what they will cost.

use crate::Run;
use crate::memory::zeroed;
use crate::soup::{Bytes, Soup};
use carvel::capi::*;
use std::ptr::{null, null_mut};

type Fill =
    unsafe extern "C" fn(*const carvel_mesh, *mut u32, u64, *mut carvel_error) -> carvel_status;
type FillFloats =
    unsafe extern "C" fn(*const carvel_mesh, *mut f32, u64, *mut carvel_error) -> carvel_status;

/// Creases, sharp vertices and holes; some name nothing, or say nothing sensible.
struct Marks {
    ends: Box<[u32]>,
    vertices: Box<[u32]>,
    holes: Box<[u32]>,
    sharpness: Box<[f32]>,
}

impl Marks {
    fn new(bytes: &mut Bytes, indices: &[u32], faces: usize) -> Self {
        const SHARPNESS: [f32; 8] = [10.0, 0.0, 0.3, 1.0, 2.5, 3.7, 1e30, 10.0];
        // Most schemes refuse sharp features.
        let most = if bytes.byte() & 3 == 0 && !indices.is_empty() { 4 } else { 1 };
        let (creases, vertices) = (bytes.below(most), bytes.below(most));
        let at = |bytes: &mut Bytes| bytes.below(indices.len().min(255));
        let edge = |bytes: &mut Bytes| {
            let corner = at(bytes);
            [indices[corner], indices[(corner + 1) % indices.len()]]
        };
        let sharpness = |bytes: &mut Bytes| match bytes.byte() {
            254 => f32::NAN,
            255 => -1.0,
            byte => SHARPNESS[usize::from(byte) % 8],
        };
        Self {
            ends: (0..creases).flat_map(|_| edge(bytes)).collect(),
            vertices: (0..vertices).map(|_| indices[at(bytes)]).collect(),
            holes: (0..bytes.below(3)).map(|_| bytes.below(faces + 1) as u32).collect(),
            sharpness: (0..creases.max(vertices)).map(|_| sharpness(bytes)).collect(),
        }
    }
}

impl Run<'_> {
    pub fn mesh(&mut self) {
        let soup = Soup::new(&mut self.bytes);
        let sizes: Box<[u32]> = soup.sizes.clone().into();
        let offsets: Box<[u32]> = std::iter::once(0)
            .chain(soup.sizes.iter().scan(0_u32, |sum, &size| {
                *sum = sum.wrapping_add(size);
                Some(*sum)
            }))
            .collect();
        let indices: Box<[u32]> = soup.indices.clone().into();
        let tags: Box<[u32]> = soup.tags.clone().into();
        let marks = Marks::new(&mut self.bytes, &indices, sizes.len());
        let layout = self.bytes.below(8);
        let odd = |pointer: *const u32, run: &mut Self| match (run.rarely(), run.bytes.byte()) {
            (false, _) => pointer,
            (_, 0..128) => null(),
            _ => pointer.wrapping_byte_add(1),
        };
        let absurd_or = |count: u64, run: &mut Self| {
            if run.rarely() { run.bytes.word() | 1 << 32 } else { count }
        };
        let absurd = self.rarely().then(|| self.bytes.word() | 1 << 32);
        let desc = carvel_mesh_desc {
            struct_size: self.size_of::<carvel_mesh_desc>(),
            face_size: if layout == 7 { self.number(6) as u32 } else { 0 },
            vertex_count: soup.vertices as u64,
            face_count: absurd.unwrap_or(sizes.len() as u64),
            face_sizes: if layout < 4 { odd(sizes.as_ptr(), self) } else { null() },
            face_offsets: if matches!(layout, 3..7) { odd(offsets.as_ptr(), self) } else { null() },
            face_vertices: odd(indices.as_ptr(), self),
            face_vertex_count: indices.len() as u64,
            non_manifold: if self.rarely() { self.number(8) as i32 } else { soup.cut.into() },
            anchored: if self.rarely() { -1 } else { soup.anchored.into() },
            corner_tags: odd(tags.as_ptr(), self),
            corner_tag_count: tags.len() as u64,
            crease_vertices: odd(marks.ends.as_ptr(), self),
            crease_sharpness: marks.sharpness.as_ptr(),
            crease_count: absurd_or(marks.ends.len() as u64 / 2, self),
            sharp_vertices: odd(marks.vertices.as_ptr(), self),
            vertex_sharpness: marks.sharpness.as_ptr(),
            sharp_vertex_count: absurd_or(marks.vertices.len() as u64, self),
            holes: odd(marks.holes.as_ptr(), self),
            hole_count: absurd_or(marks.holes.len() as u64, self),
        };
        let context = self.context_or_null();
        // SAFETY: arrays are as long as their counts say, or the count is absurd.
        let made = self.create(|out, error| unsafe {
            carvel_mesh_create(context, &raw const desc, out, error)
        });
        if let Some(mesh) = made {
            // SAFETY: the context lives, or is NULL.
            assert_eq!(unsafe { carvel_context_is_cancelled(context) }, 0);
            self.keep_mesh(mesh);
        }
    }

    pub fn keep_mesh(&mut self, mesh: *mut carvel_mesh) {
        // SAFETY: the mesh lives.
        assert_eq!(unsafe { carvel_mesh_validate(mesh, self.error) }, 0);
        self.meshes.push(mesh);
        if self.meshes.len() > 4 {
            let old = self.meshes.remove(0);
            // SAFETY: nothing uses it any more.
            unsafe { carvel_mesh_destroy(old) };
        }
    }

    pub fn counts(&mut self, mesh: *const carvel_mesh) -> Option<carvel_counts> {
        let mut counts = zeroed::<carvel_counts>();
        // SAFETY: valid pointers or NULL.
        let status = unsafe {
            carvel_counts_init(&raw mut counts, size_of::<carvel_counts>() as u32);
            carvel_mesh_counts(mesh, &raw mut counts, self.error)
        };
        self.answer(status).then_some(counts)
    }

    pub fn look_at_mesh(&mut self) {
        let mesh = self.pick(|run| &run.meshes);
        let Some(counts) = self.counts(mesh) else { return };
        // SAFETY: the mesh lives.
        let survey = self.ask(|out, error| unsafe { carvel_mesh_survey(mesh, out, error) });
        let arrays: [(Fill, u64); 9] = [
            (carvel_mesh_face_sizes, counts.faces),
            (carvel_mesh_face_offsets, counts.faces + 1),
            (carvel_mesh_face_vertices, counts.corners),
            (carvel_mesh_edges, 2 * counts.edges),
            (carvel_mesh_corner_edges, counts.corners),
            (carvel_mesh_corner_twins, counts.corners),
            (carvel_mesh_valences, counts.vertices),
            (carvel_mesh_face_sources, counts.faces),
            (carvel_mesh_vertex_sources, counts.vertices),
        ];
        let tags = survey.map(|survey: carvel_survey| -> [(Fill, u64); 4] {
            [
                (carvel_mesh_corner_tags, survey.corner_tags),
                (carvel_mesh_crease_vertices, 2 * survey.creases),
                (carvel_mesh_sharp_vertices, survey.sharp_vertices),
                (carvel_mesh_holes, survey.holes),
            ]
        });
        for (array, needed) in arrays.into_iter().chain(tags.into_iter().flatten()) {
            // SAFETY: the buffer has its capacity, or is refused.
            self.fill(needed, |out, capacity, error| unsafe { array(mesh, out, capacity, error) });
        }
        // SAFETY: as above.
        let flags = self.fill(counts.vertices, |out: *mut u8, capacity, error| unsafe {
            carvel_mesh_boundary_flags(mesh, out, capacity, error)
        });
        assert!(flags.is_none_or(|flags| flags.iter().all(|&flag| flag <= 1)));
        if let Some(survey) = survey {
            self.look_at_sharpness(mesh, carvel_mesh_crease_sharpness, survey.creases);
            self.look_at_sharpness(mesh, carvel_mesh_vertex_sharpness, survey.sharp_vertices);
        }
        // SAFETY: the mesh lives.
        assert!(matches!(unsafe { carvel_mesh_is_manifold(mesh) }, 0 | 1));
    }

    fn look_at_sharpness(&mut self, mesh: *const carvel_mesh, array: FillFloats, needed: u64) {
        // SAFETY: the buffer has its capacity, or is refused.
        let sharpness = self.fill(needed, |out: *mut f32, capacity, error| unsafe {
            array(mesh, out, capacity, error)
        });
        let is_sharp = |s: &f32| *s > 0.0 && *s <= 10.0;
        assert!(sharpness.is_none_or(|list| list.iter().all(is_sharp)));
    }

    /// A channel that fits some mesh, mostly.
    pub fn channel(&mut self) {
        let mesh = self.pick(|run| &run.meshes);
        let corners = self.counts(mesh).map_or(3, |counts| counts.corners);
        let values = 1 + self.bytes.below(40) as u32;
        let wrong = u64::from(self.rarely());
        let index = |_| self.bytes.below(values as usize) as u32;
        let indices: Box<[u32]> = (0..corners.saturating_sub(wrong)).map(index).collect();
        let desc = carvel_channel_desc {
            struct_size: self.size_of::<carvel_channel_desc>(),
            mode: self.number(6) as i32,
            indices: if self.rarely() { null() } else { indices.as_ptr() },
            index_count: indices.len() as u64,
            value_count: u64::from(values) - u64::from(self.rarely()),
        };
        // SAFETY: the indices are as many as said, or there is no pointer.
        let made = self.create(|out, error| unsafe {
            carvel_channel_create(mesh, &raw const desc, out, error)
        });
        if let (Some(channel), Some(counts)) = (made, self.counts(mesh)) {
            // SAFETY: the channel lives.
            assert!(unsafe { carvel_channel_seam_edges(channel) } <= counts.edges);
            self.channels.push(channel);
        }
    }

    pub fn predict(&mut self) {
        let (mesh, scheme) = (self.pick(|run| &run.meshes), self.pick(|run| &run.schemes));
        let level = self.number(70) as u32;
        let (width, size) = (self.number(9) as u32, self.number(9) as u32);
        // SAFETY: valid pointers or NULL.
        self.ask(|out: *mut carvel_counts, error| unsafe {
            carvel_predict_counts(mesh, scheme, level, out, error)
        });
        // SAFETY: as above.
        self.ask(|out: *mut carvel_bytes, error| unsafe {
            carvel_predict_bytes(mesh, scheme, level, width, size, out, error)
        });
        let (channel, before) = (self.pick(|run| &run.channels), 77);
        let mut values = before;
        // SAFETY: as above.
        let status =
            unsafe { carvel_predict_channel(channel, scheme, level, &raw mut values, self.error) };
        assert!(self.answer(status) || values == before);
    }

    pub fn list_histogram(&mut self) {
        let (mesh, which) = (self.pick(|run| &run.meshes), self.number(5) as i32);
        let mut needed = 0;
        // SAFETY: a mesh that lives, or NULL.
        let status = unsafe {
            carvel_mesh_histogram(mesh, which, null_mut(), 0, &raw mut needed, self.error)
        };
        if self.answer(status) {
            // SAFETY: as above; the buffer has its capacity.
            self.list(needed, |out, capacity, count, error| unsafe {
                carvel_mesh_histogram(mesh, which, out, capacity, count, error)
            });
        }
    }
}
