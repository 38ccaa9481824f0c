//! One step of a curve: the inner loop.
//!
//! New points far from the ends are made block by block: for each rule the weighted sums of a
//! block of old coordinates, which lie side by side and so fill vector registers, then each sum
//! to its place among the points of the other rules. Near the ends points are made one by one.

use std::ops::Range;

use super::coordinate::Coordinate;
use super::ends::{Ends, Extent};
use super::lattice::Lattice;
use super::rules::Rules;
use crate::base::{Context, Result};

/// Coordinates of a block: sums, and the old coordinates they come from, stay in the
/// innermost cache.
const BLOCK: usize = 768;
/// Points of more coordinates than this fill registers one by one.
const WIDEST: usize = 64;

/// The points that a step starts from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source<'a, T> {
    pub points: &'a [T],
    pub width: usize,
    pub ends: Ends,
}

/// Writes the points of `extent` to `out`, which has their exact size, anchors included.
pub(crate) fn step<T: Coordinate>(
    context: &Context,
    rules: &Rules<T>,
    source: &Source<T>,
    extent: &Extent,
    out: &mut [T],
) -> Result<()> {
    let &Source { points, width, .. } = source;
    let anchors = if extent.ends == Ends::Anchored { width } else { 0 };
    let made = anchors..out.len() - anchors;
    apply(context, rules, source, extent, &mut out[made])?;
    // Ends that stay are the same to the last bit.
    if matches!(extent.ends, Ends::Anchored | Ends::Kept) {
        let last = out.len() - width;
        out[..width].clone_from_slice(&points[..width]);
        out[last..].clone_from_slice(&points[points.len() - width..]);
    }
    Ok(())
}

/// Writes what the rules make, without anchors.
pub(crate) fn apply<T: Coordinate>(
    context: &Context,
    rules: &Rules<T>,
    source: &Source<T>,
    extent: &Extent,
    out: &mut [T],
) -> Result<()> {
    let &Source { points, width, ends } = source;
    let lattice = Lattice::new(points, width, ends, rules, extent)?;
    context.fill(out, width, |first, part| {
        let first = extent.first + first as i64;
        make(&lattice, rules, first..first + (part.len() / width) as i64, part);
    })
}

/// Makes some consecutive new points.
fn make<T: Coordinate>(lattice: &Lattice<T>, rules: &Rules<T>, wanted: Range<i64>, out: &mut [T]) {
    let (m, width) = (rules.arity(), lattice.width);
    let low = rules.reaches().map(|(low, _)| low).min().unwrap_or(0);
    let high = rules.reaches().map(|(_, high)| high).max().unwrap_or(0);
    // Old points t whose new points, all m of them, need nothing beyond the ends.
    let first = (wanted.start.div_euclid(m) + 1).max(-low);
    let end = wanted.end.div_euclid(m).min(lattice.n - high).max(first);
    let inner = if first * m < wanted.end && width <= WIDEST {
        first * m..end * m
    } else {
        wanted.end..wanted.end
    };
    let place = |i: i64| (i - wanted.start) as usize * width;
    for i in (wanted.start..inner.start).chain(inner.end..wanted.end) {
        make_one(lattice, rules, i, &mut out[place(i)..][..width]);
    }
    if inner.is_empty() {
        return;
    }
    let out = &mut out[place(inner.start)..place(inner.end)];
    match width {
        1 => make_inner(lattice, rules, first, out, scatter_fixed::<T, 1>),
        2 => make_inner(lattice, rules, first, out, scatter_fixed::<T, 2>),
        3 => make_inner(lattice, rules, first, out, scatter_fixed::<T, 3>),
        4 => make_inner(lattice, rules, first, out, scatter_fixed::<T, 4>),
        _ => make_inner(lattice, rules, first, out, scatter_any),
    }
}

fn make_one<T: Coordinate>(lattice: &Lattice<T>, rules: &Rules<T>, i: i64, out: &mut [T]) {
    let (t, residue) = (i.div_euclid(rules.arity()), i.rem_euclid(rules.arity()));
    let mut terms = rules.rule(residue as usize).iter().map(|(w, shift)| (w, t + shift));
    if let Some(first) = terms.next() {
        lattice.combine(first, terms, out);
    }
}

/// Puts the sums of a residue to their places; then come arity, width and where to.
type Scatter<T> = fn(&[T], usize, usize, usize, &mut [T]);

/// Makes the new points of old points from `first` on, all within the polygon.
fn make_inner<T: Coordinate>(
    lattice: &Lattice<T>,
    rules: &Rules<T>,
    first: i64,
    out: &mut [T],
    scatter: Scatter<T>,
) {
    let (m, width) = (rules.arity() as usize, lattice.width);
    let block = BLOCK / width;
    let mut sums = Vec::with_capacity(BLOCK);
    for (b, out) in out.chunks_mut(block * m * width).enumerate() {
        let t = first + (b * block) as i64;
        let count = out.len() / m;
        for residue in 0..m {
            let from = |shift: i64| &lattice.points[(t + shift) as usize * width..][..count];
            add_up(rules.rule(residue), from, &mut sums);
            scatter(&sums, residue, m, width, out);
        }
    }
}

/// The weighted sums of old coordinates, each list of them `from` a shift.
#[inline(always)]
fn add_up<'a, T: Coordinate>(rule: &[(T, i64)], from: impl Fn(i64) -> &'a [T], sums: &mut Vec<T>) {
    sums.clear();
    match rule {
        [(w, s)] => sums.extend(from(*s).iter().map(|x| T::product(w, x))),
        [(v, r), (w, s)] => {
            let pairs = from(*r).iter().zip(from(*s));
            sums.extend(pairs.map(|(x, y)| two((v, x), (w, y))));
        }
        [(u, q), (v, r), (w, s), others @ ..] => {
            let triples = from(*q).iter().zip(from(*r)).zip(from(*s));
            sums.extend(triples.map(|((x, y), z)| {
                let mut sum = two((u, x), (v, y));
                sum.add_product(w, z);
                sum
            }));
            for (w, s) in others {
                sums.iter_mut().zip(from(*s)).for_each(|(sum, x)| sum.add_product(w, x));
            }
        }
        [] => {}
    }
}

#[inline(always)]
fn two<T: Coordinate>((v, x): (&T, &T), (w, y): (&T, &T)) -> T {
    let mut sum = T::product(v, x);
    sum.add_product(w, y);
    sum
}

/// Puts each sum to its place; the width is known when this is compiled.
fn scatter_fixed<T: Coordinate, const WIDTH: usize>(
    sums: &[T],
    residue: usize,
    arity: usize,
    _: usize,
    out: &mut [T],
) {
    let (sums, _) = sums.as_chunks::<WIDTH>();
    let (points, _) = out.as_chunks_mut::<WIDTH>();
    for (point, sum) in points.iter_mut().skip(residue).step_by(arity).zip(sums) {
        point.clone_from_slice(sum);
    }
}

fn scatter_any<T: Coordinate>(
    sums: &[T],
    residue: usize,
    arity: usize,
    width: usize,
    out: &mut [T],
) {
    let points = out.chunks_exact_mut(width).skip(residue).step_by(arity);
    for (point, sum) in points.zip(sums.chunks_exact(width)) {
        point.clone_from_slice(sum);
    }
}
