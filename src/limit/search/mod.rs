//! The point of the limit surface nearest to another, and where a ray meets it.
//!
//! | module | its one idea |
//! |---|---|
//! | `cell` | parts of a face that halving leads to, without end |
//! | `part` | the surface over one, and bounds on it |
//! | `jet` | a polynomial and its derivatives |
//! | `tree` | boxes over all parts |
//! | `queue` | what is still to be looked at |
//! | `minimise` | the least value over a cell |
//! | `nearest` | the nearest point |
//! | `cast` | the first point on a ray |

mod cast;
mod cell;
#[allow(clippy::needless_range_loop, reason = "several arrays share an index")]
mod jet;
mod minimise;
mod nearest;
mod part;
mod queue;
mod tree;

use super::surface::{Sample, Surface};
use super::tessellate::{Root, checked, no_surface, roots};
use crate::base::{Context, Error, ErrorKind, NONE, Result, Scalar, memory};
use cast::{Line, Meeting, cast};
use glam::DVec3;
use nearest::{Near, nearest};
use part::{Field, Memory, Part};
use queue::{Place, Queue};
use std::sync::Arc;
use tree::{Branch, Tree};

/// How much nearer than the point found another may be, of the distance.
const RELATIVE: f64 = 1e-9;
/// The same in units of the largest coordinate of a control point.
const ABSOLUTE: f64 = 1e-12;
/// How often irregular cells are cut in advance.
const CUTS: u32 = 2;
/// Queries that a thread takes at once, and roots.
const SHARE: usize = 32;
/// Visits after which a query asks whether it is to stop.
const PAUSE: u64 = 256;
/// Visits of a query that are exact; then, after every `STEP` more, it is less so.
const PATIENCE: u64 = 1 << 15;
const STEP: u64 = 1 << 10;
/// The largest coordinates of queries in units of the largest of a control point.
const FARTHEST: f64 = 1e100;

/// The point of a surface that is nearest to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// Where it is.
    pub sample: Sample,
    /// Its position, as [`Surface::evaluate`] has it.
    pub point: [f64; 3],
    /// How far it is from the query.
    pub distance: f64,
}

/// A ray, or a segment: the points origin + t·direction with t in a range.
// The layout is that of `carvel_ray`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct Ray {
    /// Where t is 0; finite.
    pub origin: [f64; 3],
    /// Finite and not zero; of any length.
    pub direction: [f64; 3],
    /// The smallest and the largest t. Infinities are allowed, NaN is not; if the first is
    /// above the last there is no hit.
    pub range: [f64; 2],
}

impl Ray {
    /// From an origin on for ever.
    pub fn new(origin: [f64; 3], direction: [f64; 3]) -> Self {
        Self { origin, direction, range: [0.0, f64::INFINITY] }
    }
}

/// The first point of a surface on a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Where it is; [`Surface::evaluate`] has the derivatives there, and so the normal.
    pub sample: Sample,
    /// Its position, as [`Surface::evaluate`] has it.
    pub point: [f64; 3],
    /// Where it is on the ray.
    pub t: f64,
}

/// A limit surface with its positions, made ready for closest points and rays.
///
/// The surface is cut into parts that are polynomials of degree 4 at most, where it is so. Their
/// Bernstein coefficients bound them; what remains, around extraordinary points and edges that
/// are still semi-sharp, is bounded by control points, of which every step makes averages, and is
/// divided when a query comes near. A tree of boxes leads to the parts.
///
/// These bounds are proven, up to rounding, under Catmull–Clark, Loop, Doo–Sabin and B-splines up
/// to degree 4. Other schemes are bounded, where they are no such polynomials, by the polynomial
/// through 25 points and how far it bends; where steps have negative weights, features are, too.
/// Derivatives of such parts are taken twice as uncertain. That is a test and no proof.
///
/// A query that has looked at 32,768 parts, many times what is usual, doubles its tolerances after
/// every 1024 more, and so ends: surfaces without area have whole curves of places with the same
/// point.
///
/// # Example
/// ```
/// use carvel::limit::{Ray, Search, Surface};
/// use carvel::{Context, Mesh, Scheme};
/// use std::sync::Arc;
/// let cube = Arc::new(Mesh::from_polygons(8, &[4; 6], &[
///     0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3,
/// ])?);
/// let context = Context::serial();
/// let surface = Arc::new(Surface::new(&context, &cube, &Scheme::catmull_clark())?);
/// let corners: Vec<f64> = (0..24).map(|i| f64::from(i / 3 >> (i % 3) & 1)).collect();
/// let search = Search::new(&context, &surface, &corners)?;
/// let mut found = [None];
/// search.closest(&context, &[[0.5, 0.5, -1.0]], f64::INFINITY, &mut found)?;
/// let nearest = found[0].expect("a surface has a nearest point");
/// let mut hit = [None];
/// search.intersect(&context, &[Ray::new([0.5, 0.5, -1.0], [0.0, 0.0, 2.0])], &mut hit)?;
/// let hit = hit[0].expect("the ray goes through the middle");
/// assert!((nearest.distance - 2.0 * hit.t).abs() < 1e-12);
/// # Ok::<(), carvel::Error>(())
/// ```
#[derive(Debug)]
pub struct Search {
    field: Field,
    parts: Vec<Part>,
    tree: Tree,
    /// The power of two that positions are multiplied by.
    exponent: i32,
}

/// What queries look into.
#[derive(Clone, Copy)]
struct Inside<'a> {
    context: &'a Context,
    field: &'a Field,
    parts: &'a [Part],
    tree: &'a Tree,
    memory: &'a Memory,
}

impl Inside<'_> {
    /// The two halves of a branch, or its part.
    fn children(&self, branch: u32) -> impl Iterator<Item = Place> + use<> {
        let [a, b] = self.tree.0[branch as usize].children;
        let first = if b == NONE { Place::First(a) } else { Place::Branch(a) };
        [Some(first), (b != NONE).then_some(Place::Branch(b))].into_iter().flatten()
    }
}

/// Counts what a query looks at.
#[derive(Debug, Default)]
struct Visits(u64);

impl Visits {
    /// Counts one; true where tolerances are to be doubled, so that every query ends.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`], [`ErrorKind::MemoryCeiling`].
    fn add(&mut self, context: &Context, queue: &Queue) -> Result<bool> {
        self.0 += 1;
        if self.0.is_multiple_of(PAUSE) {
            context.check_cancelled()?;
            context.check_memory(queue.bytes().saturating_mul(context.threads() as u64))?;
        }
        Ok(self.0 > PATIENCE && self.0.is_multiple_of(STEP))
    }
}

impl Search {
    /// Cuts a surface into parts. `positions` are three for each control vertex; they are copied.
    ///
    /// Time and memory grow with the faces: about a kilobyte for a regular one, ten for each
    /// extraordinary corner of another, checked against the context's ceiling as they come to be
    /// known.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for other than three positions per vertex;
    /// [`ErrorKind::NotFinite`], naming the vertex; [`ErrorKind::Unsupported`], naming the face,
    /// if the surface is not evaluated all over it, holes excepted, which have none;
    /// [`ErrorKind::TooLarge`], [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`],
    /// [`ErrorKind::Cancelled`].
    pub fn new<T: Scalar>(
        context: &Context,
        surface: &Arc<Surface>,
        positions: &[T],
    ) -> Result<Self> {
        context.report(0.0)?;
        let mut positions = checked(surface, positions)?;
        let largest = positions.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let exponent = if largest > 0.0 { -libm::ilogb(largest) - 1 } else { 0 };
        for x in &mut positions {
            *x = libm::scalbn(*x, exponent);
        }
        let roots = roots(surface)?;
        let complete = surface.complete_nodes()?;
        let has_gaps = |root: &&Root| !surface.is_complete(&complete, root.face, root.sector);
        if let Some(root) = roots.iter().find(has_gaps) {
            return Err(no_surface(root));
        }
        let positive = surface.is_positive();
        let field = Field { surface: Arc::clone(surface), positions, roots, positive };
        let parts = parts(context, &field)?;
        let tree = Tree::new(context, &parts)?;
        Ok(Self { field, parts, tree, exponent })
    }

    /// The surface.
    pub fn surface(&self) -> &Arc<Surface> {
        &self.field.surface
    }

    /// For each point the point of the surface that is nearest to it, or `None` if it is farther
    /// away than `reach`, which may be infinite, or if there is no surface.
    ///
    /// No other point of the surface is nearer by more than a 10⁻⁹ of the distance, or 10⁻¹² of
    /// the largest coordinate of a control point (and 10⁻¹⁵ of the query's); by so little it may be
    /// beyond the reach as well, which is its distance then. Where the kind of bounds that hold for
    /// the scheme are proven ([`Search`]), so is that; parts are halved 50 times at most. Among
    /// points equally near one is chosen, always the same. The result does not depend on the number
    /// of threads.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for an output of another length than the points;
    /// [`ErrorKind::NotFinite`] for a coordinate that is not finite;
    /// [`ErrorKind::ParameterOutOfRange`] for a point 10¹⁰⁰ times as far from the origin as any
    /// control point is, both naming the query, and for a reach that is negative or NaN;
    /// [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`]. What is in `out` then is
    /// unspecified.
    pub fn closest(
        &self,
        context: &Context,
        points: &[[f64; 3]],
        reach: f64,
        out: &mut [Option<Closest>],
    ) -> Result<()> {
        check_lengths("points", points.len(), out.len())?;
        if reach.is_nan() || reach < 0.0 {
            let message = format!("a reach of {reach}: it must be 0 at least");
            return Err(Error::new(ErrorKind::ParameterOutOfRange, message));
        }
        let scaled_reach = libm::scalbn(reach, self.exponent);
        let found = self.each(context, points, |inside, i, &point, queue| {
            let p = self.scaled("point", i, point)?;
            nearest(inside, p, scaled_reach, queue)
        })?;
        let places = |near: &Near| (near.root, near.at);
        self.finish(context, &found, places, out, |i, _, sample, point| {
            let p = DVec3::from(points[i].map(|x| libm::scalbn(x, self.exponent)));
            // The point is evaluated anew, and a little off.
            let distance = libm::scalbn(point.distance(p), -self.exponent);
            Closest { sample, point: self.unscaled(point), distance: distance.min(reach) }
        })
    }

    /// For each ray the first point of the surface on it, or `None`. The surface has two sides.
    ///
    /// Points within 10⁻¹² to 4·10⁻¹² of the largest coordinate of a control point (and 10⁻¹⁵ of
    /// the origin's) from the ray are on it. So faces leave no gaps between them, and a ray that is
    /// tangent to the surface meets it, at a place that is uncertain by the square root of that.
    /// Where a ray runs within the surface its first point there is found. A hit is the first but
    /// for others nearer by less than 10⁻¹¹ of that; at an angle to the surface below 0.1 radians,
    /// by 10⁻¹² over the angle, which is how long the ray is on it. Where bounds are proven ([`Search`]) no hit is
    /// missed. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for an output of another length than the rays;
    /// [`ErrorKind::NotFinite`] for a coordinate that is not finite, or a range with NaN;
    /// [`ErrorKind::ParameterOutOfRange`] for a direction of zero, or an origin 10¹⁰⁰ times as far
    /// away as any control point, all naming the ray;
    /// [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`]. What is in `out` then is
    /// unspecified.
    pub fn intersect(
        &self,
        context: &Context,
        rays: &[Ray],
        out: &mut [Option<Hit>],
    ) -> Result<()> {
        check_lengths("rays", rays.len(), out.len())?;
        let found = self.each(context, rays, |inside, i, ray, queue| {
            let scaled = self.line(i, ray)?;
            // Scaled, both ends may be one.
            if ray.range[0] > ray.range[1] {
                return Ok(None);
            }
            cast(inside, scaled.line, queue)
        })?;
        let places = |meeting: &Meeting| (meeting.root, meeting.at);
        self.finish(context, &found, places, out, |i, meeting, sample, point| {
            let t = self.line(i, &rays[i]).map_or(f64::NAN, |scaled| scaled.t(meeting.z));
            let [first, last] = rays[i].range;
            Hit { sample, point: self.unscaled(point), t: t.clamp(first, last) }
        })
    }

    /// Runs queries, some at a time, and keeps their order.
    fn each<Q: Sync, F: Send>(
        &self,
        context: &Context,
        queries: &[Q],
        work: impl Fn(Inside<'_>, usize, &Q, &mut Queue) -> Result<Option<F>> + Sync + Send,
    ) -> Result<Vec<Option<F>>> {
        context.report(0.0)?;
        let room = (queries.len() * size_of::<Option<F>>()) as u64;
        context.check_memory(room)?;
        let shares = memory::collect(queries.chunks(SHARE).enumerate())?;
        let found = context.map(shares, |(share, queries)| {
            let mut queue = Queue::default();
            let Self { field, parts, tree, .. } = self;
            let inside = Inside { context, field, parts, tree, memory: &Memory::default() };
            let mut found = memory::reserved(queries.len())?;
            for (i, query) in (share * SHARE..).zip(queries) {
                found.push(work(inside, i, query, &mut queue)?);
            }
            Ok::<_, Error>(found)
        })?;
        let mut all = memory::reserved(queries.len())?;
        for found in found {
            memory::extend(&mut all, found?)?;
        }
        Ok(all)
    }

    /// Evaluates what was found, and writes it.
    fn finish<F, R>(
        &self,
        context: &Context,
        found: &[Option<F>],
        place: impl Fn(&F) -> (u32, [f64; 2]),
        out: &mut [Option<R>],
        result: impl Fn(usize, &F, Sample, DVec3) -> R,
    ) -> Result<()> {
        let sample = |found: &F| {
            let (root, at) = place(found);
            self.field.sample(root, at)
        };
        let samples = memory::collect(found.iter().flatten().map(sample))?;
        let mut points = memory::filled([0.0; 3], samples.len())?;
        self.field.evaluate(context, &samples, &mut points)?;
        let mut evaluated = samples.iter().zip(&points);
        for (i, (out, found)) in out.iter_mut().zip(found).enumerate() {
            *out = found.as_ref().and_then(|found| {
                let (&sample, &point) = evaluated.next()?;
                Some(result(i, found, sample, DVec3::from(point)))
            });
        }
        Ok(())
    }

    /// A query's point in units of the largest coordinate.
    fn scaled(&self, what: &str, i: usize, point: [f64; 3]) -> Result<DVec3> {
        if !point.iter().all(|x| x.is_finite()) {
            let message = format!("{what} {i} has a coordinate that is not finite");
            return Err(Error::new(ErrorKind::NotFinite, message));
        }
        let scaled = DVec3::from(point.map(|x| libm::scalbn(x, self.exponent)));
        if scaled.abs().max_element() > FARTHEST {
            let message = format!("{what} {i} is too far from the surface");
            return Err(Error::new(ErrorKind::ParameterOutOfRange, message));
        }
        Ok(scaled)
    }

    fn unscaled(&self, point: DVec3) -> [f64; 3] {
        point.to_array().map(|x| libm::scalbn(x, -self.exponent))
    }

    /// A ray in units of the largest coordinate.
    fn line(&self, i: usize, ray: &Ray) -> Result<Scaled> {
        let origin = self.scaled("the origin of ray", i, ray.origin)?;
        let refuse = |kind, what: &str| Err(Error::new(kind, format!("ray {i} has {what}")));
        if !ray.direction.iter().all(|x| x.is_finite()) {
            return refuse(ErrorKind::NotFinite, "a direction that is not finite");
        }
        if ray.range.iter().any(|x| x.is_nan()) {
            return refuse(ErrorKind::NotFinite, "a range that is not a number");
        }
        let largest = ray.direction.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if largest == 0.0 {
            return refuse(ErrorKind::ParameterOutOfRange, "a direction of zero");
        }
        let exponent = -libm::ilogb(largest);
        let direction = DVec3::from(ray.direction.map(|x| libm::scalbn(x, exponent)));
        let length = direction.length();
        // From t to lengths, and back.
        let exponent = self.exponent.saturating_sub(exponent);
        let range = ray.range.map(|t| scale(t, exponent, length));
        Ok(Scaled { line: Line::new(origin, direction / length, range), length, exponent })
    }
}

/// A ray, and what its lengths are.
struct Scaled {
    line: Line,
    length: f64,
    exponent: i32,
}

impl Scaled {
    fn t(&self, z: f64) -> f64 {
        libm::scalbn(z / self.length, -self.exponent)
    }
}

/// A range's end in units of length.
fn scale(t: f64, exponent: i32, length: f64) -> f64 {
    libm::scalbn(t, exponent) * length
}

fn check_lengths(what: &str, queries: usize, out: usize) -> Result<()> {
    if queries == out {
        return Ok(());
    }
    let message = format!("room for {out} results of {queries} {what}");
    Err(Error::new(ErrorKind::LengthMismatch, message))
}

/// The parts of all faces.
fn parts(context: &Context, field: &Field) -> Result<Vec<Part>> {
    const BATCH: usize = 4096;
    let mut parts = Vec::new();
    let all = memory::collect(0..field.roots.len() as u32)?;
    for batch in all.chunks(BATCH) {
        let made = context.map(memory::collect(batch.chunks(SHARE))?, |roots| {
            let (mut made, memory) = (Vec::new(), Memory::default());
            for &root in roots {
                field.first_parts(&memory, root, CUTS, &mut made)?;
            }
            Ok::<_, Error>(made)
        })?;
        for made in made {
            memory::extend(&mut parts, made?)?;
        }
        let each = size_of::<Part>() + 2 * size_of::<Branch>();
        let done = f64::from(batch[batch.len() - 1] + 1) / all.len() as f64;
        context.check_memory((parts.len() as f64 / done * each as f64) as u64)?;
        context.report(0.8 * done)?;
    }
    if u32::try_from(parts.len() * 2).is_err() {
        return Err(Error::new(ErrorKind::TooLarge, "more parts than 32 bits number"));
    }
    Ok(parts)
}
