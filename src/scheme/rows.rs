//! The rows of any step, for consumers who take them one by one.

use super::{DualRows, PrimalRows, Scheme};
use crate::base::Weight;
use crate::refine::Split;

/// Receives the row of one new vertex, entry by entry.
///
/// A vertex may come more than once; its weights add up.
pub trait RowSink<W> {
    /// Adds `weight` times a vertex.
    fn add(&mut self, vertex: u32, weight: W);
}

impl<W, F: FnMut(u32, W)> RowSink<W> for F {
    fn add(&mut self, vertex: u32, weight: W) {
        self(vertex, weight);
    }
}

/// The rows of one step of a scheme on one mesh, in a number type of choice.
#[derive(Debug)]
pub(crate) enum SchemeRows<'a, W> {
    /// After a corner split.
    Dual(DualRows<'a, W>),
    /// After a quad or triangle split.
    Primal(PrimalRows<'a, W>),
}

impl<'a, W: Weight> SchemeRows<'a, W> {
    pub(crate) fn new(scheme: &'a Scheme, split: &'a Split<'a>) -> Self {
        match split {
            Split::Corner(split) => Self::Dual(DualRows::new(scheme, split)),
            Split::Primal(split) => Self::Primal(PrimalRows::new(scheme, split)),
        }
    }

    /// The row of a child vertex after the split, on the parent's vertices.
    pub(crate) fn split_row(&mut self, vertex: u32, sink: &mut impl RowSink<W>) {
        match self {
            Self::Dual(rows) => rows.split_row(vertex, sink),
            Self::Primal(rows) => rows.split_row(vertex, sink),
        }
    }

    /// The row of a child vertex that has one of its own instead of split and passes, on the
    /// parent's vertices. False, and nothing sent, for all others.
    pub(crate) fn tuned_row(&mut self, vertex: u32, sink: &mut impl RowSink<W>) -> bool {
        match self {
            Self::Dual(rows) => rows.tuned_row(vertex, sink),
            Self::Primal(_) => false,
        }
    }

    /// The row of a child vertex in a pass, on the child vertices.
    pub(crate) fn pass_row(&mut self, pass: usize, vertex: u32, sink: &mut impl RowSink<W>) {
        match self {
            Self::Dual(rows) => rows.pass_row(pass, vertex, sink),
            Self::Primal(rows) => rows.pass_row(pass, vertex, sink),
        }
    }
}
