//! A tree of boxes over the parts that a search begins with.

use super::part::{Bounds, Part};
use crate::base::{Context, NONE, Result, memory};

/// A box with two others in it, or one part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Branch {
    pub(super) bounds: Bounds,
    /// Branches, or a part and [`NONE`].
    pub(super) children: [u32; 2],
}

/// Boxes, the outermost first.
#[derive(Debug, Default)]
pub(super) struct Tree(pub(super) Vec<Branch>);

impl Tree {
    /// Halves by the middle of the longest side of their box, over and over.
    ///
    /// # Errors
    /// [`crate::ErrorKind::OutOfResources`], [`crate::ErrorKind::Cancelled`].
    pub(super) fn new(context: &Context, parts: &[Part]) -> Result<Self> {
        let mut tree = Self::default();
        let boxes = memory::collect(parts.iter().map(Part::bounds))?;
        let mut order: Vec<u32> = memory::collect(0..parts.len() as u32)?;
        let around = |of: &[u32]| {
            let first = boxes[of[0] as usize];
            of[1..].iter().fold(first, |sum, &i| sum.with(boxes[i as usize]))
        };
        if parts.is_empty() {
            return Ok(tree);
        }
        let mut open = memory::collect([(0, 0, parts.len())])?;
        let root = Branch { bounds: around(&order), children: [0, NONE] };
        memory::extend(&mut tree.0, [root])?;
        while let Some((branch, start, end)) = open.pop() {
            let of = &mut order[start..end];
            if let [part] = *of {
                tree.0[branch].children = [part, NONE];
                continue;
            }
            if of.len() > 1024 {
                context.check_cancelled()?;
            }
            let Bounds { low, high } = tree.0[branch].bounds;
            let axis = (high - low).max_position();
            let place = |i: u32| {
                let Bounds { low, high } = boxes[i as usize];
                low[axis] + high[axis]
            };
            let middle = of.len() / 2;
            // Numbers decide between equals, so that there is one order.
            of.select_nth_unstable_by(middle, |&a, &b| {
                place(a).total_cmp(&place(b)).then(a.cmp(&b))
            });
            let first = tree.0.len() as u32;
            tree.0[branch].children = [first, first + 1];
            let (low, high) = of.split_at(middle);
            let halves =
                [low, high].map(|half| Branch { bounds: around(half), children: [0, NONE] });
            memory::extend(&mut tree.0, halves)?;
            let middle = start + middle;
            let first = first as usize;
            memory::extend(&mut open, [(first, start, middle), (first + 1, middle, end)])?;
        }
        Ok(tree)
    }
}
