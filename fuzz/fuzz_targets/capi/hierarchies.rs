//! Hierarchies: their levels, and values on them.

use crate::memory::{Buffer, Number, zeroed};
use crate::{Run, is_decided_early};
use carvel::capi::*;
use std::ptr::null_mut;

impl Run<'_> {
    pub fn hierarchy(&mut self) {
        let (mesh, scheme) = (self.pick(|run| &run.meshes), self.pick(|run| &run.schemes));
        let (context, levels) = (self.context_or_null(), self.bytes.below(3) as u32);
        // SAFETY: valid pointers or NULL.
        let made = self.create(|out, error| unsafe {
            carvel_hierarchy_create(context, mesh, scheme, levels, out, error)
        });
        if let Some(hierarchy) = made {
            // SAFETY: the context lives, or is NULL.
            assert_eq!(unsafe { carvel_context_is_cancelled(context) }, 0);
            self.hierarchies.push(hierarchy);
        }
    }

    pub fn look_at_hierarchy(&mut self) {
        let hierarchy = self.pick(|run| &run.hierarchies);
        let level = self.number(4) as u32;
        // SAFETY: valid pointers or NULL.
        let mesh = self
            .create(|out, error| unsafe { carvel_hierarchy_mesh(hierarchy, level, out, error) });
        let Some(mesh) = mesh else { return };
        let counts = self.counts(mesh).expect("counts of a mesh");
        // SAFETY: the hierarchy lives; buffers have their capacities, or are refused.
        let vertices = self.fill(counts.vertices, |out, capacity, error| unsafe {
            carvel_hierarchy_vertex_origins(hierarchy, level, out, capacity, error)
        });
        // SAFETY: as above.
        let faces = self.fill(counts.faces, |out, capacity, error| unsafe {
            carvel_hierarchy_face_origins(hierarchy, level, out, capacity, error)
        });
        for origins in [vertices, faces].into_iter().flatten() {
            assert!(level > 0);
            assert!(origins.iter().all(|origin: &carvel_origin| (1..=6).contains(&origin.kind)));
        }
        self.rows(hierarchy, level, counts.vertices);
        if counts.faces < 2000 && self.bytes.byte() & 1 == 0 {
            // It outlives the hierarchy.
            self.keep_mesh(mesh);
        } else {
            // SAFETY: it is destroyed once.
            unsafe { carvel_mesh_destroy(mesh) };
        }
    }

    fn rows(&mut self, hierarchy: *const carvel_hierarchy, level: u32, vertices: u64) {
        let (stage, mut entries) = (self.number(3) as u32, 0);
        // SAFETY: valid pointers; the buffer has its capacity, or is refused.
        let offsets = self.fill(vertices + 1, |out: *mut u64, capacity, error| unsafe {
            let (indices, weights, count) = (null_mut(), null_mut(), &raw mut entries);
            carvel_hierarchy_rows(
                hierarchy, level, stage, out, capacity, indices, weights, 0, count, error,
            )
        });
        let Some(offsets) = offsets else { return };
        assert_eq!(offsets.last(), Some(&entries));
        let capacity = entries + 2 - (self.bytes.below(4) as u64).min(entries + 1);
        let mut room = [
            Buffer::of::<u64>(vertices + 1),
            Buffer::of::<u32>(capacity),
            Buffer::of::<f64>(capacity),
        ];
        let [out, indices, weights] = room.each_mut();
        let (out, indices, weights) = (out.start(), indices.start(), weights.start());
        let error = self.error();
        // SAFETY: as above.
        let status = unsafe {
            carvel_hierarchy_rows(
                hierarchy,
                level,
                stage,
                out,
                vertices + 1,
                indices,
                weights,
                capacity,
                null_mut(),
                error,
            )
        };
        let done = self.answer(status);
        assert!(!done || capacity >= entries);
        let written = if done { [vertices + 1, entries] } else { [0, 0] };
        room[0].check_beyond::<u64>(written[0]);
        room[1].check_beyond::<u32>(written[1]);
        room[2].check_beyond::<f64>(written[1]);
        assert!(!done || room[0].entries::<u64>(vertices + 1) == offsets);
    }

    pub fn refine_level<T: Number>(&mut self) {
        let hierarchy = self.pick(|run| &run.hierarchies);
        let (context, level) = (self.context_or_null(), self.number(3) as u32);
        let mut sizes = [zeroed::<carvel_counts>(); 2];
        for (counts, level) in sizes.iter_mut().zip([0, level]) {
            counts.struct_size = size_of::<carvel_counts>() as u32;
            // SAFETY: valid pointers or NULL.
            let status =
                unsafe { carvel_hierarchy_counts(hierarchy, level, &raw mut *counts, self.error) };
            self.answer(status);
        }
        let width = self.bytes.below(7) as u64;
        let needed = sizes[1].vertices;
        let views = [self.view::<T>(sizes[0].vertices, width), self.view::<T>(needed, width)];
        let values = self.room::<T>(&views[..1]);
        let mut out = self.room::<T>(&views[1..]);
        let (input, output) = (values.input(&views[0]), out.output(&views[1]));
        let kind = self.number(3) as i32;
        let error = self.error();
        // SAFETY: every buffer has its capacity, or is refused.
        let status = unsafe {
            let (input, output) = (&raw const input, &raw const output);
            match kind {
                0 => T::REFINE_LEVEL(hierarchy, context, level, input, output, error),
                _ => T::INTERPOLATE(hierarchy, context, level, kind, input, output, error),
            }
        };
        let done = self.answer(status);
        // SAFETY: the context lives, or is NULL.
        assert!(!done || unsafe { carvel_context_is_cancelled(context) } == 0);
        out.check_beside(if is_decided_early(status) { &[] } else { &views[1..] }, needed);
    }
}
