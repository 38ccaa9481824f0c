//! The rows of a whole step: split and passes multiplied out.

use super::{RowSink, Scheme, SchemeRows};
use crate::base::Weight;
use crate::refine::Split;
use std::collections::{BTreeMap, HashMap};

/// Vertices of the parent mesh with weights.
pub(crate) type ComposedRow<W> = BTreeMap<u32, W>;

/// Rows of a step with all its passes, each made once. For few vertices: all are kept.
#[derive(Debug)]
pub(crate) struct ComposedRows<'a, W> {
    rows: SchemeRows<'a, W>,
    passes: usize,
    /// By the number of passes and vertex.
    known: HashMap<(usize, u32), ComposedRow<W>>,
}

impl<'a, W: Weight> ComposedRows<'a, W> {
    pub(crate) fn new(scheme: &'a Scheme, split: &'a Split<'a>) -> Self {
        let passes = scheme.passes().len();
        Self { rows: SchemeRows::new(scheme, split), passes, known: HashMap::new() }
    }

    /// The row of a child vertex on the parent's vertices.
    pub(crate) fn row(&mut self, vertex: u32) -> ComposedRow<W> {
        self.after(self.passes, vertex)
    }

    /// Drops what is kept.
    pub(crate) fn forget(&mut self) {
        self.known.clear();
    }

    fn after(&mut self, passes: usize, vertex: u32) -> ComposedRow<W> {
        if let Some(row) = self.known.get(&(passes, vertex)) {
            return row.clone();
        }
        let mut row = Sum(BTreeMap::new());
        let tuned = passes == self.passes && self.rows.tuned_row(vertex, &mut row);
        match passes.checked_sub(1) {
            _ if tuned => {}
            None => self.rows.split_row(vertex, &mut row),
            Some(before) => {
                let mut entries = Vec::new();
                let mut sink = |v: u32, weight: W| entries.push((v, weight));
                self.rows.pass_row(before, vertex, &mut sink);
                for (v, outer) in entries {
                    for (v, inner) in self.after(before, v) {
                        row.add(v, outer.clone() * inner);
                    }
                }
            }
        }
        self.known.insert((passes, vertex), row.0.clone());
        row.0
    }
}

/// A row in which each vertex comes once.
struct Sum<W>(ComposedRow<W>);

impl<W: Weight> RowSink<W> for Sum<W> {
    fn add(&mut self, vertex: u32, weight: W) {
        let sum = match self.0.remove(&vertex) {
            Some(before) => before + weight,
            None => weight,
        };
        self.0.insert(vertex, sum);
    }
}
