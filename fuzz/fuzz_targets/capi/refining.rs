//! Refiners, and what they are given.

use crate::memory::{FILL, Number, Pointer, Room, View, bytes_of, zeroed};
use crate::{Run, is_decided_early};
use carvel::capi::*;
use std::ptr::{null, null_mut};

/// A channel of a call, or none, with its values and the room for what comes.
struct Seams<T> {
    count: u64,
    /// Values after the refinement, as predicted.
    refined: u64,
    given: View,
    written: View,
    values: Room<T>,
    room: Room<T>,
    indices: Box<[u32]>,
    input: [ChannelInput<T>; 1],
    output: [ChannelOutput<T>; 1],
}

impl<T: Number> Seams<T> {
    fn new(run: &mut Run, scheme: *const carvel_scheme, levels: u32, corners: u64) -> Self {
        let channel = run.pick(|run| &run.channels);
        let mut sizes = [0; 2];
        let mut known = !channel.is_null() && run.bytes.byte() & 1 == 0;
        for (size, level) in sizes.iter_mut().zip([0, levels]) {
            // SAFETY: objects that live, or NULL.
            let status = unsafe {
                carvel_predict_channel(channel, scheme, level, &raw mut *size, run.error)
            };
            known &= run.answer(status);
        }
        let wrong = |run: &mut Run| u64::from(run.rarely());
        let width = run.bytes.below(4) as u64;
        let (more, fewer) = (wrong(run), 2 * wrong(run));
        let given = run.view::<T>(sizes[0] + more, width);
        let written = run.view::<T>((sizes[1] + 1).saturating_sub(fewer), width);
        let indices = vec![FILL; (corners + 1).saturating_sub(2 * wrong(run)) as usize];
        let (values, room) = (run.room::<T>(&[given]), run.room::<T>(&[written]));
        let (input, output) = ([zeroed()], [zeroed()]);
        let indices = indices.into_boxed_slice();
        let (count, refined) = (known.into(), sizes[1]);
        let mut seams =
            Self { count, refined, given, written, values, room, indices, input, output };
        seams.input[0] = ChannelInput { channel, values: seams.values.input(&given) };
        seams
    }

    fn inputs(&self) -> &[ChannelInput<T>] {
        &self.input
    }

    fn outputs(&mut self) -> &[ChannelOutput<T>] {
        let (data, count) = (self.indices.as_mut_ptr(), self.indices.len() as u64);
        let values = self.room.output(&self.written);
        self.output[0] = ChannelOutput { indices: carvel_indices { data, count }, values };
        &self.output
    }

    /// Nothing was written that should not be, and every index is that of a value.
    fn check(&self, status: carvel_status) {
        let untouched = self.count == 0 || is_decided_early(status);
        let written = if untouched { &[][..] } else { std::slice::from_ref(&self.written) };
        self.room.check_beside(written, self.refined);
        self.values.check_beside(&[], self.given.count);
        if untouched {
            assert!(self.indices.iter().all(|&index| index == FILL));
        }
    }
}

impl Run<'_> {
    pub fn refiner(&mut self) {
        // SAFETY: a place to write to, or none.
        let made = self.create(|out, error| unsafe { carvel_refiner_create(out, error) });
        self.refiners.extend(made);
    }

    /// How records for a number of vertices lie in memory.
    pub fn view<T: Number>(&mut self, count: u64, width: u64) -> View {
        let size = size_of::<T>() as u64;
        let gap = self.bytes.below(4) as u64 * size;
        let stride = if self.rarely() {
            match self.number(64) {
                // One that would be followed must be refused, or lead nowhere.
                absurd if absurd > 1 << 12 => absurd | 1 << 62,
                stride => stride,
            }
        } else if gap == 0 && self.bytes.byte() & 1 == 0 {
            0
        } else {
            width * size + gap
        };
        let pointer = match (self.rarely(), self.bytes.byte()) {
            (true, 0..60) => Pointer::Null,
            (true, 60..120) => Pointer::Misaligned,
            _ => Pointer::Right,
        };
        View { first: 0, count, width, stride, pointer }
    }

    /// Memory of the exact size for records, with something in it.
    pub fn room<T: Number>(&mut self, views: &[View]) -> Room<T> {
        let size = views.iter().map(View::end::<T>).max().unwrap_or(0);
        let mut memory = vec![T::default(); size].into_boxed_slice();
        for value in &mut memory {
            *value = T::number(if self.bytes.is_empty() { 1 } else { self.bytes.byte() });
        }
        let before = memory.iter().map(|value| value.bits()).collect();
        Room { memory, before }
    }

    pub fn refine<T: Number>(&mut self) {
        let refiner = self.pick(|run| &run.refiners);
        let (mesh, scheme) = (self.pick(|run| &run.meshes), self.pick(|run| &run.schemes));
        let (context, levels) = (self.context_or_null(), self.bytes.below(3) as u32);
        let mut last = zeroed::<carvel_counts>();
        last.struct_size = size_of::<carvel_counts>() as u32;
        // SAFETY: valid pointers or NULL.
        let status =
            unsafe { carvel_predict_counts(mesh, scheme, levels, &raw mut last, self.error) };
        let Some(counts) = self.counts(mesh).filter(|_| status == 0) else { return };
        let wrong = |run: &mut Self| if run.rarely() { run.bytes.below(4) as u64 } else { 0 };
        let (more, narrower) = (wrong(self), wrong(self) % 2);
        let given_view = self.view::<T>(counts.vertices + more, 3 - narrower);
        let positions = self.room::<T>(&[given_view]);
        let width = self.bytes.below(10) as u64;
        let attribute_view = self.view::<T>(counts.vertices, width);
        let attributes = self.room::<T>(&[attribute_view]);
        let attribute_count = self.bytes.below(2) as u64;
        let inputs = [attributes.input(&attribute_view)];
        let kinds = [self.number(3) as i32];
        let mut seams = Seams::new(self, scheme, levels, last.corners);
        let input = RefineInput::<T> {
            struct_size: self.size_of::<RefineInput<T>>(),
            levels,
            mesh,
            scheme,
            positions: positions.input(&given_view),
            attributes: if self.rarely() { null() } else { inputs.as_ptr() },
            attribute_count,
            interpolations: if self.bytes.byte() & 1 == 0 { null() } else { kinds.as_ptr() },
            channels: seams.inputs().as_ptr(),
            channel_count: seams.count,
        };
        let fewer = wrong(self) / 2;
        let mut views = [
            self.view::<T>((last.vertices + 1).saturating_sub(2 * fewer), 3),
            self.view::<T>(last.vertices, width),
        ];
        // Records of both between each other, or, a place too near, into each other.
        let interleaved = width > 0 && self.bytes.byte() & 3 == 0;
        let mut too_near = false;
        let mut rooms = if interleaved {
            too_near = self.rarely();
            views[1].first = if too_near { 2 } else { 3 };
            let stride = (3 + width + self.bytes.below(3) as u64) * size_of::<T>() as u64;
            views.iter_mut().for_each(|view| view.stride = stride);
            vec![self.room::<T>(&views)]
        } else {
            vec![self.room::<T>(&views[..1]), self.room::<T>(&views[1..])]
        };
        let point_values = rooms[0].output(&views[0]);
        let outputs = [rooms.last_mut().expect("a room").output(&views[1])];
        let needed = [last.faces, last.faces + 1, last.corners, last.faces];
        let mut indices = needed.map(|n| {
            let n = (n + 1).saturating_sub(wrong(self));
            vec![FILL; n as usize].into_boxed_slice()
        });
        let (given, absent) = (self.bytes.byte(), self.rarely());
        let mut index = 0;
        let [face_sizes, face_offsets, face_vertices, face_sources] =
            indices.each_mut().map(|list| {
                index += 1;
                let wanted = given >> index & 1 != 0;
                let data = if wanted { list.as_mut_ptr() } else { null_mut() };
                // Without a pointer there is nothing to count.
                carvel_indices { data, count: if wanted || absent { list.len() as u64 } else { 0 } }
            });
        // Outputs that overlap each other must be refused.
        let overlap = self.rarely();
        let mut output = RefineOutput::<T> {
            struct_size: self.size_of::<RefineOutput<T>>(),
            anchored: -1,
            face_sizes,
            face_offsets,
            face_vertices: if overlap { face_sizes } else { face_vertices },
            face_sources,
            positions: point_values,
            attributes: outputs.as_ptr(),
            attribute_count,
            channels: seams.outputs().as_ptr(),
            channel_count: seams.count,
        };
        let before = output;
        let error = self.error();
        // SAFETY: every buffer has its capacity, or is refused.
        let status =
            unsafe { T::REFINE(refiner, context, &raw const input, &raw mut output, error) };
        let done = self.answer(status);
        // SAFETY: the context lives, or is NULL.
        assert!(!done || unsafe { carvel_context_is_cancelled(context) } == 0);
        assert!(status != CARVEL_STATUS_OVERLAP || overlap || too_near);
        seams.check(status);
        let whole = output.struct_size as usize == size_of::<RefineOutput<T>>();
        let same = RefineOutput { anchored: output.anchored, ..before };
        assert!(bytes_of(&output) == bytes_of(&same) && (done || output.anchored == -1));
        if done {
            assert!(matches!(output.anchored, 0 | 1));
            assert!(!(overlap && whole) || face_sizes.data.is_null() || last.faces == 0);
            assert!(!(too_near && whole && attribute_count == 1) || last.vertices == 0);
        }
        for (list, (index, needed)) in indices.iter().zip(needed.into_iter().enumerate()) {
            let wanted = given >> (index + 1) & 1 != 0;
            let written = if is_decided_early(status) || !wanted { 0 } else { needed };
            let beyond = list.get(written as usize..).unwrap_or_default();
            assert!(beyond.iter().all(|&x| x == FILL));
        }
        let count = if attribute_count == 1 { 2 } else { 1 };
        let written = if is_decided_early(status) { &[] } else { &views[..count] };
        match &rooms[..] {
            [both] => both.check_beside(written, last.vertices),
            [points, others] => {
                points.check_beside(written.get(..1).unwrap_or_default(), last.vertices);
                others.check_beside(written.get(1..).unwrap_or_default(), last.vertices);
            }
            _ => unreachable!("one room or two"),
        }
        if done && interleaved && whole {
            self.check_interleaved(&input, &rooms[0], &views[..count], last.vertices);
        }
    }

    /// The same values as in arrays of their own, by a refiner of its own.
    fn check_interleaved<T: Number>(
        &mut self,
        input: &RefineInput<T>,
        room: &Room<T>,
        views: &[View],
        count: u64,
    ) {
        let tight = |width| View { first: 0, count, width, stride: 0, pointer: Pointer::Right };
        let mut rooms: Vec<Room<T>> =
            views.iter().map(|view| self.room(&[tight(view.width)])).collect();
        let mut outputs = rooms.iter_mut().zip(views).map(|(r, v)| r.output(&tight(v.width)));
        let mut output = zeroed::<RefineOutput<T>>();
        output.struct_size = size_of::<RefineOutput<T>>() as u32;
        let input = &RefineInput { channel_count: 0, ..*input };
        output.positions = outputs.next().expect("positions");
        let outputs: Vec<Values<T>> = outputs.collect();
        (output.attributes, output.attribute_count) = (outputs.as_ptr(), outputs.len() as u64);
        let mut refiner = null_mut();
        // SAFETY: buffers have their capacities; the input was good just now.
        let status = unsafe {
            assert_eq!(carvel_refiner_create(&raw mut refiner, self.error), 0);
            let status = T::REFINE(refiner, null(), input, &raw mut output, self.error);
            carvel_refiner_destroy(refiner);
            status
        };
        assert!(self.answer(status));
        for (tight, view) in rooms.iter().zip(views) {
            let width = view.width as usize;
            for (record, at) in tight.memory.chunks(width).zip(view.places::<T>(count)) {
                let bits = |values: &[T]| values.iter().map(|v| v.bits()).collect::<Vec<_>>();
                assert_eq!(bits(record), bits(&room.memory[at..at + width]));
            }
        }
    }
}
