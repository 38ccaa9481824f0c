//! Samples one after the other, and what the next ones read asked for ahead.

use super::evaluation::{Scratch, Start, not_finite};
use super::lanes::ZERO;
use super::nodes::Node;
use super::regular::{Control, Patch, Remembered, WIDTH, write};
use super::univariate::Univariate;
use super::{Sample, Surface, named};
use crate::base::simd::{fetch_ahead, with_widest};
use crate::base::{Error, NONE, Result, Scalar, memory};

/// Samples whose reading is asked for together.
const AHEAD: usize = 32;

/// A sample that failed, by its place, and how.
pub(super) type Failed = (usize, Error);

/// The regular patches that have a way of their own.
#[derive(Clone, Copy)]
enum Quick {
    Bicubic,
    Quartic,
}

/// A sample on its way.
#[derive(Clone, Copy)]
struct Way {
    start: Start,
    /// The place it has come to, and where there; [`NONE`] if none is needed.
    place: u32,
    at: [f64; 2],
}

const NO_WAY: Way = Way { start: Start::NOWHERE, place: NONE, at: [0.0; 2] };

impl Surface {
    /// Evaluates samples in order; one that fails ends it.
    pub(super) fn batch<T: Scalar, const R: usize>(
        &self,
        samples: &[Sample],
        values: &[T],
        width: usize,
        scratch: &mut Scratch,
        out: &mut [T],
    ) -> std::result::Result<(), Failed> {
        let points = if width == WIDTH { values.as_chunks::<WIDTH>().0 } else { &[] };
        let record = R * width;
        let mut ways = [NO_WAY; AHEAD];
        let groups = samples.chunks(AHEAD).zip(out.chunks_mut(AHEAD * record));
        for (group, (samples, out)) in groups.enumerate() {
            let ways = &mut ways[..samples.len()];
            let mut failed = self.start_all(samples, ways);
            let started = failed.as_ref().map_or(ways.len(), |failed| failed.0);
            let age = scratch.memo.age();
            if !points.is_empty() {
                let ways = &mut ways[..started];
                failed = self.go::<T, R>(ways, points, scratch).or(failed);
            }
            let ready = failed.as_ref().map_or(ways.len(), |failed| failed.0);
            let name = |(i, error): Failed| (group * AHEAD + i, named(error, &samples[i]));
            for (i, (way, out)) in
                ways[..ready].iter().zip(out.chunks_exact_mut(record)).enumerate()
            {
                let done = match self.quick::<T, R>(way, points, age, scratch, out) {
                    Some(true) => Ok(()),
                    Some(false) => Err(not_finite()),
                    None => self.any(&way.start, values, width, scratch, out),
                };
                done.map_err(|error| name((i, error)))?;
            }
            if let Some(failed) = failed {
                return Err(name(failed));
            }
        }
        Ok(())
    }

    /// Where samples begin, up to one that is refused.
    fn start_all(&self, samples: &[Sample], ways: &mut [Way]) -> Option<Failed> {
        let mut failed = None;
        for (i, (way, sample)) in ways.iter_mut().zip(samples).enumerate() {
            if let Err(error) = self.place(sample, &mut way.start) {
                failed = Some((i, error));
                break;
            }
            way.place = NONE;
            fetch_ahead(&self.roots, way.start.corner as usize);
        }
        let started = failed.as_ref().map_or(ways.len(), |failed| failed.0);
        for way in &mut ways[..started] {
            let root = self.roots[way.start.corner as usize];
            (way.start.node, way.start.points) = (root.node, root.start);
        }
        failed
    }

    /// Goes down to regular cells, up to a sample for which that fails, and asks for the
    /// points there.
    fn go<T: Scalar, const R: usize>(
        &self,
        ways: &mut [Way],
        values: &[[T; WIDTH]],
        scratch: &mut Scratch,
    ) -> Option<Failed> {
        for way in ways.iter().filter(|way| self.is_regular(way.start.node)) {
            // One of 16 and more lies in two or three of the processor's lines.
            fetch_ahead(&self.points, way.start.points as usize);
            fetch_ahead(&self.points, way.start.points as usize + 11);
        }
        for (i, way) in ways.iter_mut().enumerate() {
            let start = &way.start;
            match self.nodes[start.node as usize] {
                Node::Split { .. } => {
                    let cell = || self.cell(start, values.as_flattened(), WIDTH);
                    match self.patches().arrive(cell, start, WIDTH, R == 1, scratch) {
                        Ok((place, Some(at))) => (way.place, way.at) = (place, at),
                        Ok((_, None)) => continue,
                        Err(error) => return Some((i, error)),
                    }
                    scratch.memo.ask_ahead(scratch.memo.place(way.place), 1);
                }
                Node::Grid(_) | Node::Triangle => {
                    for &v in self.points[start.points as usize..].iter().take(16) {
                        fetch_ahead(values, v as usize);
                    }
                }
                Node::Refused(_) => {}
            }
        }
        None
    }

    fn is_regular(&self, node: u32) -> bool {
        matches!(self.nodes[node as usize], Node::Grid(_) | Node::Triangle)
    }

    /// Evaluates a sample anywhere.
    #[cold]
    fn any<T: Scalar>(
        &self,
        start: &Start,
        values: &[T],
        width: usize,
        scratch: &mut Scratch,
        out: &mut [T],
    ) -> Result<()> {
        let mut results = std::mem::take(&mut scratch.results);
        memory::resize(&mut results, out.len())?;
        let cell = self.cell(start, values, width);
        let done = self.patches().evaluate(&cell, start, scratch, &mut results);
        out.iter_mut().zip(&results).for_each(|(x, &y)| *x = T::from_f64(y));
        scratch.results = results;
        done?;
        if out.iter().all(|x| x.is_finite()) { Ok(()) } else { Err(not_finite()) }
    }

    /// The patch of a node, if it has a way of its own.
    fn quick_patch(&self, node: u32) -> Option<Quick> {
        match self.nodes[node as usize] {
            Node::Grid(extent) => (extent == [self.window; 2]
                && matches!(self.univariate, Some(Univariate::Spline(3))))
            .then_some(Quick::Bicubic),
            Node::Triangle => Some(Quick::Quartic),
            _ => None,
        }
    }

    /// Evaluates a sample in a regular patch that has a way of its own; whether all is finite, or
    /// nothing if it is in no such patch, or the places have been forgotten since.
    #[inline(always)]
    fn quick<T: Scalar, const R: usize>(
        &self,
        way: &Way,
        values: &[[T; WIDTH]],
        age: u64,
        scratch: &Scratch,
        out: &mut [T],
    ) -> Option<bool> {
        let mut sums = [ZERO; R];
        if way.place == NONE {
            let (at, jacobian) = (&way.start.at, &way.start.jacobian);
            let patch = self.quick_patch(way.start.node).filter(|_| !values.is_empty())?;
            let points = &self.points[way.start.points as usize..];
            match patch {
                Quick::Bicubic => {
                    let points = Control::<_, 16> { vertices: points.first_chunk()?, values };
                    with_widest(Patch { points, at, jacobian, sums: &mut sums });
                }
                Quick::Quartic => {
                    let points = Control::<_, 12> { vertices: points.first_chunk()?, values };
                    with_widest(Patch { points, at, jacobian, sums: &mut sums });
                }
            }
            return Some(write(&sums, out));
        }
        if scratch.memo.age() != age {
            return None;
        }
        let place = scratch.memo.place(way.place);
        let (points, origin) = scratch.memo.points(place, 1);
        let (at, jacobian, origin) = (&way.at, &place.jacobian, origin[0]);
        match self.quick_patch(place.node)? {
            Quick::Bicubic => {
                let points = Remembered::<16> { points: points.first_chunk()?, origin };
                with_widest(Patch { points, at, jacobian, sums: &mut sums });
            }
            Quick::Quartic => {
                let points = Remembered::<12> { points: points.first_chunk()?, origin };
                with_widest(Patch { points, at, jacobian, sums: &mut sums });
            }
        }
        Some(write(&sums, out))
    }
}
