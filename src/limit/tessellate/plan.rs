//! Points and triangles of all cells, counted and numbered.

use super::cell::{Cell, Point};
use super::net::Net;
use super::shared::Shared;
use super::{Tessellation, split, triangles};
use crate::base::{Context, Error, ErrorKind, NONE, Result, memory};
use crate::limit::surface::Sample;
use glam::DVec3;

/// Bytes of a place while it is evaluated, its vertex among them.
const PLACE: u64 = (size_of::<Point>() + size_of::<Sample>() + 4 + 4 + 3 * 24 + 72) as u64;
/// Triangles that 32 bits number, [`NONE`] apart.
const MOST_TRIANGLES: u64 = NONE as u64 - 1;
/// Bytes of a triangle.
const TRIANGLE: u64 = (12 + 12 + 4) as u64;
/// Bytes of a cell with its vertex and its two triangles; borders add some.
pub(super) const CELL: u64 = size_of::<Cell>() as u64 + PLACE + 2 * TRIANGLE;

/// Cells with all that is to be numbered.
pub(super) struct Plan<'a> {
    net: Net<'a>,
    /// For each root, which sides of its cells are cut.
    cuts: Vec<Vec<[bool; 4]>>,
    /// The first place and the first triangle of each root, and the ends.
    starts: Vec<[u32; 2]>,
}

impl<'a> Plan<'a> {
    /// Counts what cells become.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`], [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`],
    /// [`ErrorKind::Cancelled`].
    pub(super) fn new(context: &Context, mut net: Net<'a>, most: u64) -> Result<Self> {
        let found = net.each(|i| {
            let shape = net.roots[i].shape;
            let is_new = |at: &Point| net.points[i].binary_search(at).is_err();
            let (mut cuts, mut further) = (memory::reserved(net.cells[i].len())?, Vec::new());
            let mut count = 0;
            net.each_cell(i, |_, cell| {
                let cut = net.cuts(i, cell);
                cuts.push(cut);
                count += triangles::count(shape, cut) as u64;
                let points = triangles::further(shape, cell, cut);
                memory::extend(&mut further, points.into_iter().filter(is_new))
            })?;
            Ok((cuts, further, count))
        })?;
        let (mut cuts, mut starts) = (Vec::new(), Vec::new());
        let mut sums = [0, 0];
        let start = |[places, triangles]: [u64; 2]| {
            let fits = |n: u64| u32::try_from(n).ok().filter(|&n| n != NONE);
            let too_large = || Error::new(ErrorKind::TooLarge, "more points than 32 bits number");
            if triangles > most {
                return Err(split::too_many(most));
            }
            Ok([
                fits(places).ok_or_else(too_large)?,
                fits(triangles).ok_or_else(|| split::too_many(MOST_TRIANGLES))?,
            ])
        };
        for (i, (cut, further, count)) in found.into_iter().enumerate() {
            memory::extend(&mut starts, [start(sums)?])?;
            memory::extend(&mut cuts, [cut])?;
            memory::extend(&mut net.points[i], further)?;
            net.points[i].sort_unstable();
            net.points[i].dedup();
            sums = [sums[0] + net.points[i].len() as u64, sums[1] + count];
        }
        memory::extend(&mut starts, [start(sums)?])?;
        context.check_memory(PLACE * sums[0] + TRIANGLE * sums[1])?;
        Ok(Self { net, cuts, starts })
    }

    /// Numbers places and vertices, these by their first places; vertices have no positions yet.
    pub(super) fn places(&self, context: &Context) -> Result<Tessellation> {
        context.check_cancelled()?;
        let Net { points, roots, .. } = &self.net;
        let mut made = Tessellation::default();
        let mut border: Vec<(Shared, u32)> = Vec::new();
        for (i, points) in points.iter().enumerate() {
            let first = self.starts[i][0];
            memory::extend(&mut made.places, points.iter().map(|&at| roots[i].sample(at)))?;
            let shared = (first..).zip(points);
            let shared = shared.filter_map(|(place, &at)| Some((self.net.shared(i, at)?, place)));
            memory::extend(&mut border, shared)?;
        }
        border.sort_unstable();
        // The first place of a vertex, while vertices have no numbers.
        made.place_vertices = memory::filled(NONE, made.places.len())?;
        for same in border.chunk_by(|a, b| a.0 == b.0) {
            for &(_, place) in &same[1..] {
                made.place_vertices[place as usize] = same[0].1;
            }
        }
        let mut vertices = 0;
        for place in 0..made.places.len() {
            made.place_vertices[place] = match made.place_vertices[place] {
                NONE => {
                    vertices += 1;
                    vertices - 1
                }
                first => made.place_vertices[first as usize],
            };
        }
        made.positions = memory::filled([0.0; 3], vertices as usize)?;
        Ok(made)
    }

    /// Cuts cells into triangles.
    pub(super) fn triangles(&self, context: &Context, made: &mut Tessellation) -> Result<()> {
        context.check_cancelled()?;
        let found = self.net.each(|i| self.triangles_of(i, made))?;
        let count = self.starts.last().map_or(0, |start| start[1] as usize);
        made.triangle_places = memory::reserved(count)?;
        made.faces = memory::reserved(count)?;
        for (triangles, root) in found.iter().zip(self.net.roots) {
            memory::extend(&mut made.faces, std::iter::repeat_n(root.face, triangles.len()))?;
            memory::extend(&mut made.triangle_places, triangles.iter().copied())?;
        }
        let vertices = |places: &[u32; 3]| places.map(|place| made.place_vertices[place as usize]);
        made.triangles = memory::collect(made.triangle_places.iter().map(vertices))?;
        Ok(())
    }

    /// The triangles of a root, by their places.
    fn triangles_of(&self, i: usize, made: &Tessellation) -> Result<Vec<[u32; 3]>> {
        let Net { roots, points, .. } = &self.net;
        let ([first, start], [_, end]) = (self.starts[i], self.starts[i + 1]);
        let mut triangles = memory::reserved((end - start) as usize)?;
        let place = |at: Point| first + points[i].partition_point(|&other| other < at) as u32;
        let position = |at: Point| {
            DVec3::from(made.positions[made.place_vertices[place(at) as usize] as usize])
        };
        let is_on_edge = |at: Point| self.net.shared(i, at).is_some_and(Shared::is_on_edge);
        let first_diagonal = |[a, b, c, d]: [Point; 4]| {
            // An edge between points on the control mesh's edges might be there on its other
            // sides too.
            let outer = [[a, c], [b, d]].map(|ends| ends.iter().all(|&at| is_on_edge(at)));
            let length = |a: Point, b: Point| position(a).distance_squared(position(b));
            if outer[0] == outer[1] { length(a, c) <= length(b, d) } else { outer[1] }
        };
        let mut cuts = self.cuts[i].iter();
        self.net.each_cell(i, |_, cell| {
            let cuts = cuts.next().copied().unwrap_or_default();
            triangles::triangles(roots[i].shape, cell, cuts, first_diagonal, |corners| {
                triangles.push(corners.map(place));
            });
            Ok(())
        })?;
        Ok(triangles)
    }
}
