//! Samples in groups: what they read is asked for ahead, and weights are made for some at once.

use super::cell::{IDENTITY, Kind};
use super::evaluation::{Scratch, Start, not_finite};
use super::lanes::{Block, ZERO};
use super::memo::Memo;
use super::nodes::Node;
use super::regular::{Bicubic, GROUP, Gathered, Lane, Quartic, WIDTH, Weights, changed, write};
use super::univariate::Univariate;
use super::{Sample, Surface, named};
use crate::base::simd::{Quad, QuadLoop, fetch_ahead, with_quads};
use crate::base::{Error, NONE, Result, Scalar, memory};
use crate::scheme::Method;

/// Samples whose reading is asked for together.
const AHEAD: usize = 32;

/// A sample that failed, by its place, and how.
pub(super) type Failed = (usize, Error);

/// What was done to samples up to one that failed.
type Step = std::result::Result<(), Failed>;

/// A sample on its way.
#[derive(Clone, Copy)]
struct Way {
    corner: u32,
    node: u32,
    /// Where the control vertices of a regular cell begin.
    points: u32,
    /// The place it has come to; [`NONE`] if none is needed.
    place: u32,
}

const NO_WAY: Way = Way { corner: 0, node: 0, points: 0, place: NONE };

/// Where the samples of a group are in their cells.
type Places = [[Lane; 2]; AHEAD / GROUP];

/// One of them.
fn place(places: &Places, i: usize) -> [f64; 2] {
    let [s, t] = &places[i / GROUP];
    [s[i % GROUP], t[i % GROUP]]
}

fn set_place(places: &mut Places, i: usize, at: [f64; 2]) {
    let [s, t] = &mut places[i / GROUP];
    (s[i % GROUP], t[i % GROUP]) = (at[0], at[1]);
}

/// Asks for so many elements ahead, of which one may be as large as what comes at once, or less.
#[inline(always)]
fn ask_bytes<T>(list: &[T], first: usize, count: usize) {
    const LINE: usize = 64;
    for element in (first..first + count).step_by((LINE / size_of::<T>()).max(1)) {
        fetch_ahead(list, element);
    }
}

impl Surface {
    /// Evaluates samples in order; one that fails ends it.
    pub(super) fn batch<T: Scalar, const R: usize>(
        &self,
        samples: &[Sample],
        values: &[T],
        width: usize,
        scratch: &mut Scratch,
        out: &mut [T],
    ) -> Step {
        let (points, _) = values.as_chunks::<WIDTH>();
        match (&self.univariate, self.method) {
            _ if width != WIDTH => self.all::<T, R>(samples, (values, width), scratch, out),
            (Some(Univariate::Spline(3)), _) => {
                self.groups::<T, Bicubic, 16, R>(samples, points, scratch, out)
            }
            (None, Method::Loop) => {
                self.groups::<T, Quartic<R>, 12, R>(samples, points, scratch, out)
            }
            _ => self.all::<T, R>(samples, (values, width), scratch, out),
        }
    }

    /// Samples without a way of their own.
    fn all<T: Scalar, const R: usize>(
        &self,
        samples: &[Sample],
        (values, width): (&[T], usize),
        scratch: &mut Scratch,
        out: &mut [T],
    ) -> Step {
        for (i, (sample, out)) in samples.iter().zip(out.chunks_exact_mut(R * width)).enumerate() {
            let start = self.start(sample);
            let done = start.and_then(|start| self.any(&start, values, width, scratch, out));
            done.map_err(|error| (i, named(error, sample)))?;
        }
        Ok(())
    }

    /// Samples of a primal scheme, of which most are in a kind of regular patches, some at a time.
    fn groups<T: Scalar, W: Weights<N, R>, const N: usize, const R: usize>(
        &self,
        samples: &[Sample],
        values: &[[T; WIDTH]],
        scratch: &mut Scratch,
        out: &mut [T],
    ) -> Step {
        const { assert!(AHEAD == u32::BITS as usize) };
        let record = R * WIDTH;
        let (mut ways, mut places) = ([NO_WAY; AHEAD], [[[0.0; GROUP]; 2]; AHEAD / GROUP]);
        let (mut weights, mut sums) = (W::NONE, [[ZERO; R]; GROUP]);
        let all = samples;
        let groups = samples.chunks(AHEAD).zip(out.chunks_mut(AHEAD * record));
        for (group, (samples, out)) in groups.enumerate() {
            ask_bytes(all, (group + 1) * AHEAD, AHEAD);
            ask_bytes(out, AHEAD * record, AHEAD * record);
            let name = |(i, error): Failed| (group * AHEAD + i, named(error, &samples[i]));
            let (age, mut ready, mut failed) = (scratch.memo.age(), samples.len(), None);
            let mut after = |done: Step| {
                if let Err(first) = done {
                    (ready, failed) = (first.0, Some(first));
                }
                ready
            };
            let mut n = after(self.start_all(samples, &mut ways, &mut places));
            n = after(self.enter_all(&mut ways[..n], &places, W::IS_TRIANGLE, values, scratch));
            let memo = &mut scratch.memo;
            if memo.age() == age {
                after(self.arrive_all::<T, N, R>(&mut ways[..n], &mut places, values, memo));
            }
            let mut left = u32::MAX;
            // Otherwise places have been forgotten.
            if scratch.memo.age() == age {
                let out = &mut out[..ready * record];
                let infinite;
                (left, infinite) = with_quads(Run {
                    surface: self,
                    ways: &ways[..ready],
                    values,
                    memo: &scratch.memo,
                    places: &places,
                    weights: &mut weights,
                    sums: &mut sums,
                    out,
                });
                if let Some(i) = infinite {
                    (ready, failed) = (i, Some((i, not_finite())));
                }
            }
            for i in (0..ready).filter(|&i| left >> i & 1 != 0) {
                let out = &mut out[i * record..][..record];
                let done = self
                    .start(&samples[i])
                    .and_then(|start| self.any(&start, values.as_flattened(), WIDTH, scratch, out));
                done.map_err(|error| name((i, error)))?;
            }
            if let Some(failed) = failed {
                return Err(name(failed));
            }
        }
        Ok(())
    }

    /// Where samples begin.
    fn start_all(&self, samples: &[Sample], ways: &mut [Way], places: &mut Places) -> Step {
        let (mut done, mut started, faces) = (Ok(()), samples.len(), self.mesh.faces());
        for (i, (way, sample)) in ways.iter_mut().zip(samples).enumerate() {
            match self.corner(sample, faces) {
                Ok((corner, _)) => {
                    way.corner = corner;
                    set_place(places, i, [sample.u, sample.v]);
                    fetch_ahead(&self.roots, corner as usize);
                }
                Err(error) => {
                    (started, done) = (i, Err((i, error)));
                    break;
                }
            }
        }
        for way in &mut ways[..started] {
            let root = self.roots[way.corner as usize];
            (way.node, way.points, way.place) = (root.node, root.start, NONE);
            // Points of a regular cell, 12 and more, lie in two or three of the processor's lines.
            fetch_ahead(&self.points, root.start as usize);
            fetch_ahead(&self.points, root.start as usize + 11);
        }
        done
    }

    /// The places that hold the parts of their cells that they lie in, unless those are regular.
    fn enter_all<T: Scalar>(
        &self,
        ways: &mut [Way],
        places: &Places,
        is_triangle: bool,
        values: &[[T; WIDTH]],
        scratch: &mut Scratch,
    ) -> Step {
        let age = scratch.memo.age();
        for (i, way) in ways.iter_mut().enumerate() {
            if !matches!(self.nodes[way.node as usize], Node::Split { .. }) {
                continue;
            }
            let at = place(places, i);
            let root = match scratch.memo.find(way.corner) {
                Some(root) => root,
                None => self.remember(way, at, values, scratch).map_err(|e| (i, e))?,
            };
            let memo = &mut scratch.memo;
            // A folded triangle is a sector, all of whose parts lead to one place.
            let (part, inside) = Kind::part_of(is_triangle, at);
            way.place = if let Some(place) = memo.part(root, part) {
                place
            } else {
                let place = self.patches().enter(root, part, inside, WIDTH, memo);
                place.map_err(|error| (i, error))?
            };
            if memo.age() != age {
                break;
            }
            memo.ask_place(way.place);
        }
        Ok(())
    }

    #[cold]
    fn remember<T: Scalar>(
        &self,
        way: &Way,
        at: [f64; 2],
        values: &[[T; WIDTH]],
        scratch: &mut Scratch,
    ) -> Result<u32> {
        let &Way { corner, node, .. } = way;
        let start = Start { corner, node, at, jacobian: IDENTITY.linear };
        let cell = self.cell(&start, values.as_flattened(), WIDTH);
        self.patches().root(&cell, &start, scratch)
    }

    /// From there down to regular cells, whose points are asked for.
    fn arrive_all<T: Scalar, const N: usize, const R: usize>(
        &self,
        ways: &mut [Way],
        places: &mut Places,
        values: &[[T; WIDTH]],
        memo: &mut Memo,
    ) -> Step {
        let (patches, age) = (self.patches(), memo.age());
        for (i, way) in ways.iter_mut().enumerate() {
            if way.place != NONE {
                let at = patches.arrive(way.place, place(places, i), WIDTH, R == 1, memo);
                let (place, at) = at.map_err(|error| (i, error))?;
                if memo.age() != age {
                    break;
                }
                way.place = NONE;
                if let Some(at) = at {
                    way.place = place;
                    set_place(places, i, at);
                    memo.ask_points::<N>(place);
                }
            } else if self.is_regular(way.node) {
                for &v in self.points[way.points as usize..].iter().take(N) {
                    fetch_ahead(values, v as usize);
                }
            }
        }
        Ok(())
    }

    fn is_regular(&self, node: u32) -> bool {
        matches!(self.nodes[node as usize], Node::Grid(_) | Node::Triangle)
    }

    /// Evaluates a sample anywhere.
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

    /// Whether a cell is one of those that most samples come to.
    #[inline(always)]
    fn is_usual(&self, node: u32) -> bool {
        match &self.nodes[node as usize] {
            Node::Grid(extent) => *extent == [self.window; 2],
            Node::Triangle => true,
            _ => false,
        }
    }
}

/// Those samples that are in regular patches of a kind.
struct Run<'a, T, W, const N: usize, const R: usize> {
    surface: &'a Surface,
    ways: &'a [Way],
    values: &'a [[T; WIDTH]],
    memo: &'a Memo,
    places: &'a Places,
    weights: &'a mut W,
    sums: &'a mut [[Block; R]; GROUP],
    out: &'a mut [T],
}

impl<T: Scalar, W: Weights<N, R>, const N: usize, const R: usize> Run<'_, T, W, N, R> {
    /// The position and derivatives of a sample; nothing if it is in no such patch.
    #[inline(always)]
    fn sums<Q: Quad>(&self, which: usize, way: &Way) -> Option<[Q; R]> {
        let (node, jacobian, sums);
        if way.place == NONE {
            (node, jacobian) = (way.node, &IDENTITY.linear);
            if !self.surface.is_usual(node) {
                return None;
            }
            let vertices = self.surface.points[way.points as usize..].first_chunk()?;
            sums = self.weights.sums(which, &Gathered { vertices, values: self.values });
        } else {
            let place = self.memo.place(way.place);
            (node, jacobian) = (place.node, &place.jacobian);
            if !self.surface.is_usual(node) {
                return None;
            }
            let (points, origin) = self.memo.points(place, 1);
            let mut about: [Q; R] = self.weights.sums(which, points.first_chunk::<N>()?);
            about[0] = about[0] + Q::new(origin[0]);
            sums = about;
        }
        Some(changed(jacobian, sums))
    }
}

impl<T: Scalar, W: Weights<N, R>, const N: usize, const R: usize> QuadLoop for Run<'_, T, W, N, R> {
    /// Which are left, by bits, and the first, if any, whose result is not finite.
    type Output = (u32, Option<usize>);

    #[inline(always)]
    fn run<Q: Quad>(mut self) -> Self::Output {
        let mut left = 0;
        let out = std::mem::take(&mut self.out);
        let groups = self.ways.chunks(GROUP).zip(out.chunks_mut(GROUP * R * WIDTH));
        for (group, (ways, out)) in groups.enumerate() {
            self.weights.fill::<Q>(&self.places[group % (AHEAD / GROUP)], ways.len());
            for (which, way) in ways.iter().enumerate() {
                match self.sums::<Q>(which, way) {
                    Some(sums) => {
                        for (kept, sum) in self.sums[which].iter_mut().zip(sums) {
                            *kept = sum.numbers();
                        }
                    }
                    None => left |= 1 << (group * GROUP + which),
                }
            }
            let records = self.sums.iter().zip(out.chunks_exact_mut(R * WIDTH));
            for (which, (sums, out)) in records.enumerate() {
                let i = group * GROUP + which;
                if left >> i & 1 == 0 && !write(sums, out) {
                    return (left, Some(i));
                }
            }
        }
        (left, None)
    }
}
