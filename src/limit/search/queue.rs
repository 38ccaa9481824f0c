//! What a query has still to look at, the most promising first.

use super::part::{Form, Part};
use crate::base::{Error, ErrorKind, Result, memory};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Something with parts of the surface in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Branch(u32),
    /// One that the search began with.
    First(u32),
    /// One that the query made.
    Made(u32),
}

#[derive(Debug, Clone, Copy)]
struct Entry {
    bound: f64,
    /// Between equal bounds the latest goes first: it is the smallest.
    number: u64,
    place: Place,
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound).then(self.number.cmp(&other.number))
    }
}

/// The queue of a thread.
#[derive(Debug, Default)]
pub(super) struct Queue {
    heap: BinaryHeap<Entry>,
    made: Vec<Part>,
    /// Those of them that were taken.
    free: Vec<u32>,
    count: u64,
}

impl Queue {
    /// Forgets the query before.
    pub(super) fn clear(&mut self) {
        self.heap.clear();
        self.made.clear();
        self.free.clear();
    }

    pub(super) fn push(&mut self, bound: f64, place: Place) -> Result<()> {
        let refused = |_| Error::new(ErrorKind::OutOfResources, "a queue could not grow");
        self.heap.try_reserve(1).map_err(refused)?;
        self.count += 1;
        self.heap.push(Entry { bound, number: self.count, place });
        Ok(())
    }

    pub(super) fn push_part(&mut self, bound: f64, part: Part) -> Result<()> {
        let at = if let Some(at) = self.free.pop() {
            self.made[at as usize] = part;
            at
        } else {
            memory::extend(&mut self.made, [part])?;
            self.made.len() as u32 - 1
        };
        self.push(bound, Place::Made(at))
    }

    /// A part that the query made, which nobody looks at again.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfResources`].
    pub(super) fn take(&mut self, part: u32) -> Result<Part> {
        memory::extend(&mut self.free, [part])?;
        let part = &mut self.made[part as usize];
        Ok(Part { form: std::mem::replace(&mut part.form, Form::Hull(Vec::new())), ..*part })
    }

    /// About how much memory it has, but for the points of hulls.
    pub(super) fn bytes(&self) -> u64 {
        let Self { heap, made, free, .. } = self;
        let bytes = heap.capacity() * size_of::<Entry>() + made.capacity() * size_of::<Part>();
        (bytes + free.capacity() * size_of::<u32>()) as u64
    }

    /// The smallest bound with its place.
    pub(super) fn pop(&mut self) -> Option<(f64, Place)> {
        self.heap.pop().map(|entry| (entry.bound, entry.place))
    }
}
