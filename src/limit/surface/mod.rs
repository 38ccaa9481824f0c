//! The limit surface at any point: position, first and second derivatives.
//!
//! | module | its one idea |
//! |---|---|
//! | `cell` | where a point lies, and in which child cell |
//! | `univariate` | one axis of a tensor product |
//! | `digits` | the same for masks that have no formula |
//! | `box_spline` | a regular triangle |
//! | `grid` | which cells are regular |
//! | `vicinity` | what decides the surface of the others, with a name |
//! | `nodes` | a finite graph of all surfaces |
//! | `memo` | how far others have come on the way down |
//! | `lanes` | sums of points |
//! | `evaluation` | the way down |
//! | `regular` | the patches that most samples lie in, by the shortest way |
//! | `batch` | many samples |
//! | `stencils` | the same for values that come again and again |
//! | `pieces` | what the surface is over a part of a face |
//! | `hull` | points in whose hull it is there |

mod batch;
#[allow(clippy::needless_range_loop, reason = "several arrays share an index")]
mod box_spline;
mod cell;
mod digits;
#[allow(clippy::needless_range_loop, reason = "several arrays share an index")]
mod evaluation;
mod grid;
mod hull;
#[allow(clippy::needless_range_loop, reason = "several arrays share an index")]
mod lanes;
#[allow(clippy::needless_range_loop, reason = "several arrays share an index")]
mod memo;
mod nodes;
mod pieces;
#[allow(clippy::needless_range_loop, reason = "several arrays share an index")]
mod regular;
mod stencils;
#[allow(clippy::needless_range_loop, reason = "several arrays share an index")]
mod univariate;
mod vicinity;

use crate::base::{Context, Element, Error, ErrorKind, NONE, Result, Scalar, memory};
use crate::mesh::{Channel, Mesh};
use crate::scheme::{ChannelRules, Method, Scheme};
use cell::Kind;
pub(in crate::limit) use evaluation::Scratch;
use evaluation::{Cell, PARTIALS, Patches, Start};
use nodes::{Builder, Node};
pub(in crate::limit) use pieces::Piece;
use std::sync::{Arc, Mutex, PoisonError};
use univariate::Univariate;

/// A point of a limit surface: a face of the control mesh and coordinates in it.
///
/// On a quad of any scheme but Loop's, u and v are within [0, 1]: corner 0 lies at (0, 0),
/// corner 1 at (1, 0), corner 2 at (1, 1). Any other face has a sector for each corner, with
/// that vertex at (0, 0), the middle of the corner's outgoing edge at (1, 0), and the face's
/// middle at (1, 1), as OpenSubdiv's Ptex faces have. On a triangle of Loop's scheme corner 0
/// lies at (0, 0), corner 1 at (1, 0), corner 2 at (0, 1), and u + v is at most 1.
// The layout is that of `carvel_sample`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct Sample {
    /// The face, in the mesh's order.
    pub face: u32,
    /// The corner of the face whose sector it is; 0 where there are no sectors.
    pub sector: u32,
    /// Along the outgoing edge of corner 0, or of the sector's corner.
    pub u: f64,
    /// Along the other edge at that corner.
    pub v: f64,
}

/// What to evaluate beside the position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Derivatives {
    /// Nothing: one record per sample, the position.
    #[default]
    None,
    /// Three records: position, derivatives by u and by v.
    First,
    /// Six records: the three, then by uu, uv and vv.
    Second,
}

impl Derivatives {
    /// Records per sample: 1, 3 or 6.
    pub fn records(self) -> usize {
        match self {
            Self::None => 1,
            Self::First => 3,
            Self::Second => PARTIALS.len(),
        }
    }
}

/// A control vertex with its weights in the position and the derivatives by u, v, uu, uv, vv.
pub type SurfaceWeight = (u32, [f64; 6]);

/// The first of the cells at a corner.
#[derive(Debug, Clone, Copy)]
struct Root {
    /// Its node, or [`NONE`] where no cell begins.
    node: u32,
    /// Where its control vertices begin.
    start: u32,
}

/// The limit surface of a control mesh under a scheme.
///
/// Where the control points around a cell form a regular grid the surface is evaluated in
/// closed form: B-splines, the quartic box spline, or a product of the mask's matrices along the
/// binary digits of a coordinate. Elsewhere steps of the scheme's own rows lead to such a cell.
/// Those steps are found once, for all cells whose surroundings look alike.
///
/// # Example
/// ```
/// use carvel::limit::{Derivatives, Sample, Surface};
/// use carvel::{Context, Mesh, Scheme};
/// use std::sync::Arc;
/// let cube = Arc::new(Mesh::from_polygons(8, &[4; 6], &[
///     0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3,
/// ])?);
/// let context = Context::serial();
/// let surface = Surface::new(&context, &cube, &Scheme::catmull_clark())?;
/// let corners: Vec<f64> = (0..24).map(|i| f64::from(i / 3 >> (i % 3) & 1)).collect();
/// let middle = Sample { face: 0, sector: 0, u: 0.5, v: 0.5 };
/// let mut point = [0.0; 3];
/// surface.evaluate(&context, &[middle], &corners, 3, Derivatives::None, &mut point)?;
/// assert!((point[0] - 0.5).abs() < 1e-15 && (point[1] - 0.5).abs() < 1e-15);
/// # Ok::<(), carvel::Error>(())
/// ```
#[derive(Debug)]
pub struct Surface {
    mesh: Arc<Mesh>,
    method: Method,
    univariate: Option<Univariate>,
    window: [i32; 2],
    nodes: Vec<Node>,
    /// For each corner.
    roots: Vec<Root>,
    /// Control vertices of cells, or values of a channel.
    points: Vec<u32>,
    /// How many of these there are in all.
    columns: usize,
    /// Faces without a surface.
    holes: Vec<u32>,
}

impl Surface {
    /// Finds the cells of a surface: time and memory grow with the corners of the mesh, and with
    /// the number of ways in which its irregular parts look different.
    ///
    /// # Errors
    /// As [`Scheme::check`]; [`ErrorKind::Unsupported`] for a mesh that is not manifold or is
    /// anchored with a boundary, and for a scheme that does not converge on regular grids;
    /// [`ErrorKind::TooLarge`], [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`],
    /// [`ErrorKind::Cancelled`].
    pub fn new(context: &Context, mesh: &Arc<Mesh>, scheme: &Scheme) -> Result<Self> {
        scheme.check(mesh)?;
        let unsupported = |message| Err(Error::new(ErrorKind::Unsupported, message));
        if !mesh.is_manifold() {
            return unsupported("the surface of a mesh that is not manifold is not evaluated");
        }
        if mesh.is_anchored() && !mesh.is_closed() && scheme.method() == Method::Dual {
            return unsupported("the surface of a refined mesh with a boundary is not evaluated");
        }
        let univariate = Univariate::new(scheme)?;
        let window = nodes::window(scheme);
        context.check_memory(bytes(mesh, scheme, window))?;
        let mut builder = Builder::new(scheme);
        let mut roots = memory::filled(Root { node: NONE, start: 0 }, mesh.corners())?;
        let (mut points, mut cell) = (Vec::new(), Vec::new());
        for corner in 0..mesh.corners() as u32 {
            let first = mesh.layout.face_around(corner).start == corner;
            let kind = Kind::at(scheme, mesh, corner);
            if matches!(kind, Kind::Quad | Kind::Triangle) && !first {
                continue;
            }
            if corner % 1024 == 0 {
                context.check_cancelled()?;
            }
            let node = builder.root(mesh, corner, &mut cell)?;
            let start = u32::try_from(points.len()).map_err(|_| {
                Error::new(ErrorKind::TooLarge, "control points of cells exceed 32-bit sizes")
            })?;
            roots[corner as usize] = Root { node, start };
            memory::extend(&mut points, cell.iter().copied())?;
        }
        let nodes = builder.finish(context)?;
        let holes = scheme.holes(mesh)?;
        let (mesh, method) = (Arc::clone(mesh), scheme.method());
        let columns = mesh.vertices();
        Ok(Self { mesh, method, univariate, window, nodes, roots, points, columns, holes })
    }

    /// The surface of face-varying values, such as texture coordinates: samples are as on the
    /// surface of the mesh, values those of the channel, continuous but across seams. The same
    /// as refining the channel for ever.
    ///
    /// # Errors
    /// As [`Surface::new`]; [`ErrorKind::LengthMismatch`] for a channel of another mesh;
    /// [`ErrorKind::Unsupported`] for a scheme without rules for such values, and where values of a
    /// vertex depend on semi-sharp edges beyond a seam
    /// ([`crate::FaceVaryingMode::CornersPlus1`] and [`crate::FaceVaryingMode::CornersPlus2`], or Chaikin's rule),
    /// naming the vertex.
    ///
    /// # Example
    /// ```
    /// use carvel::limit::{Derivatives, Sample, Surface};
    /// use carvel::{Channel, Context, FaceVaryingMode, Mesh, Scheme};
    /// // Two quads with a seam between them.
    /// let mesh = Mesh::from_polygons(6, &[4, 4], &[0, 1, 4, 3, 1, 2, 5, 4])?;
    /// let indices = [0, 1, 2, 3, 4, 5, 6, 7];
    /// let channel = Channel::new(&mesh, &indices, 8, FaceVaryingMode::Boundaries)?;
    /// let (context, scheme) = (Context::serial(), Scheme::catmull_clark());
    /// let surface = Surface::of_channel(&context, &mesh, &channel, &scheme)?;
    /// let uvs = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 5.0, 0.0, 6.0, 0.0, 6.0, 1.0, 5.0, 1.0];
    /// let on_seam = Sample { face: 1, sector: 0, u: 0.0, v: 0.5 };
    /// let mut uv = [0.0; 2];
    /// surface.evaluate(&context, &[on_seam], &uvs, 2, Derivatives::None, &mut uv)?;
    /// assert_eq!(uv, [5.0, 0.5]);
    /// # Ok::<(), carvel::Error>(())
    /// ```
    pub fn of_channel(
        context: &Context,
        mesh: &Mesh,
        channel: &Channel,
        scheme: &Scheme,
    ) -> Result<Self> {
        channel.check_mesh(mesh)?;
        scheme.check(mesh)?;
        let rules = ChannelRules::new(scheme, channel.mode());
        let (cut, values, scheme) = rules.as_mesh(mesh, channel)?;
        let mut surface = Self::new(context, &Arc::new(cut), &scheme)?;
        surface.points.iter_mut().for_each(|point| *point = values[*point as usize]);
        surface.columns = channel.values();
        Ok(surface)
    }

    /// The control mesh; that of a channel is cut along the seams.
    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// The records that it is evaluated from: control vertices, or values of a channel.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Sectors of a face: 1, or one for each corner.
    ///
    /// # Panics
    /// If `face` is not below [`Mesh::faces`].
    pub fn sectors(&self, face: usize) -> usize {
        self.sectors_of(self.mesh.face_corners(face).len())
    }

    /// The same of a face with so many sides.
    fn sectors_of(&self, sides: usize) -> usize {
        match sides {
            4 => 1,
            3 if self.method == Method::Loop => 1,
            sides => sides,
        }
    }

    /// Evaluates samples from values of the control vertices, `width` per vertex. `out` gets, for
    /// each sample, [`Derivatives::records`] records of `width` values. All is computed in double
    /// precision; the bytes do not depend on the number of threads. Derivatives at a sharp edge
    /// or a knot are those of the sample's own face, from the side of larger coordinates.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for slices of the wrong length. For the first sample
    /// concerned, naming its face: [`ErrorKind::ParameterOutOfRange`] for a face, sector or
    /// coordinates out of range or NaN; [`ErrorKind::NotFinite`] for a value that the sample
    /// depends on, and for one that the result's number type does not hold;
    /// [`ErrorKind::Unsupported`] in a hole, where the surface of a dual scheme ends
    /// before the boundary or is not regular beside it, for derivatives that the scheme does not
    /// have, or exactly at an extraordinary vertex or an irregular boundary.
    /// [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`]. What is in `out` then is
    /// unspecified.
    pub fn evaluate<T: Scalar>(
        &self,
        context: &Context,
        samples: &[Sample],
        values: &[T],
        width: usize,
        derivatives: Derivatives,
        out: &mut [T],
    ) -> Result<()> {
        let record = width.saturating_mul(derivatives.records());
        self.check_lengths(samples, values, width, record, out)?;
        if width == 0 {
            return Ok(());
        }
        let failed: Mutex<Option<(usize, Error)>> = Mutex::new(None);
        let fail = |i: usize, error: Error| {
            let mut first = failed.lock().unwrap_or_else(PoisonError::into_inner);
            if first.as_ref().is_none_or(|&(before, _)| i < before) {
                *first = Some((i, error));
            }
        };
        // What a thread remembers is handed on to its next part.
        let pool: Mutex<Vec<Scratch>> = Mutex::default();
        let pool = || pool.lock().unwrap_or_else(PoisonError::into_inner);
        context.fill(out, record, |first, part| {
            let mut scratch = pool().pop().unwrap_or_default();
            let samples = &samples[first..][..part.len() / record];
            let done = match derivatives {
                Derivatives::None => self.batch::<T, 1>(samples, values, width, &mut scratch, part),
                Derivatives::First => {
                    self.batch::<T, 3>(samples, values, width, &mut scratch, part)
                }
                Derivatives::Second => {
                    self.batch::<T, 6>(samples, values, width, &mut scratch, part)
                }
            };
            if let Err((i, error)) = done {
                return fail(first + i, error);
            }
            let mut pool = pool();
            match memory::extend(&mut pool, [scratch]) {
                Ok(()) => {}
                Err(error) => fail(first, error),
            }
        })?;
        let failed = failed.into_inner().unwrap_or_else(PoisonError::into_inner);
        failed.map_or(Ok(()), |(_, error)| Err(error))
    }

    fn check_lengths<T>(
        &self,
        samples: &[Sample],
        values: &[T],
        width: usize,
        record: usize,
        out: &[T],
    ) -> Result<()> {
        for (what, len, count, width) in [
            ("values", values.len(), self.columns, width),
            ("output", out.len(), samples.len(), record),
        ] {
            if Some(len) != count.checked_mul(width) {
                let message = format!("{len} {what} for {count} records of {width}");
                return Err(Error::new(ErrorKind::LengthMismatch, message));
            }
        }
        Ok(())
    }

    /// The control vertices that a sample depends on, ascending, with their weights; weights of
    /// derivatives not asked for are 0.
    ///
    /// # Errors
    /// As [`Surface::evaluate`].
    pub fn weights(&self, sample: &Sample, derivatives: Derivatives) -> Result<Vec<SurfaceWeight>> {
        let in_face = |error| named(error, sample);
        let start = self.start(sample).map_err(in_face)?;
        let points = self.cell_points(start.corner);
        let n = points.len();
        let mut identity: Vec<f64> = memory::zeroed(n * n)?;
        (0..n).for_each(|i| identity[i * n + i] = 1.0);
        let places: Vec<u32> = memory::collect(0..n as u32)?;
        let cell = Cell { vertices: &places, values: &identity, width: n };
        let records = derivatives.records();
        let mut rows: Vec<f64> = memory::zeroed(n * records)?;
        let mut scratch = Scratch::default();
        self.patches().evaluate(&cell, &start, &mut scratch, &mut rows).map_err(in_face)?;
        let mut weights: Vec<SurfaceWeight> =
            memory::collect(points.iter().enumerate().map(|(i, &v)| {
                let mut of = [0.0; 6];
                (0..records).for_each(|k| of[k] = rows[k * n + i]);
                (v, of)
            }))?;
        weights.sort_by_key(|weight| weight.0);
        // A vertex may be several points of a cell.
        weights.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1.iter_mut().zip(next.1).for_each(|(sum, w)| *sum += w);
            }
            same
        });
        weights.retain(|(_, of)| of.iter().any(|&w| w != 0.0));
        Ok(weights)
    }

    /// The first cell of a sample.
    fn cell<'a, T>(&'a self, start: &Start, values: &'a [T], width: usize) -> Cell<'a, T> {
        Cell { vertices: self.cell_points(start.corner), values, width }
    }

    /// Evaluates one sample into `sums`, as [`Surface::evaluate`] does without its checks.
    pub(in crate::limit) fn one<T: Scalar>(
        &self,
        sample: &Sample,
        values: &[T],
        width: usize,
        scratch: &mut Scratch,
        sums: &mut [f64],
    ) -> Result<()> {
        let in_face = |error| named(error, sample);
        let start = self.start(sample).map_err(in_face)?;
        let cell = self.cell(&start, values, width);
        self.patches().evaluate(&cell, &start, scratch, sums).map_err(in_face)
    }

    fn patches(&self) -> Patches<'_> {
        Patches { nodes: &self.nodes, univariate: self.univariate.as_ref(), window: self.window }
    }

    /// The control vertices of the cell of a corner.
    fn cell_points(&self, corner: u32) -> &[u32] {
        let start = self.roots[corner as usize].start as usize;
        let later = self.roots[corner as usize + 1..].iter().find(|root| root.node != NONE);
        &self.points[start..later.map_or(self.points.len(), |root| root.start as usize)]
    }

    /// Where the evaluation of a sample starts.
    fn start(&self, sample: &Sample) -> Result<Start> {
        let (corner, sectors) = self.corner(sample, self.mesh.faces())?;
        let at = [sample.u, sample.v];
        let (corner, at, map) = match self.method {
            Method::Dual if sectors == 1 => {
                let (place, map) = cell::quarter(at);
                (corner + place as u32, map.apply(at), map)
            }
            _ => (corner, at, cell::IDENTITY),
        };
        let root = self.roots[corner as usize];
        Ok(Start { corner, node: root.node, at, jacobian: map.linear })
    }

    /// The corner of a sample's sector, and how many sectors its face has. The number of faces is
    /// counted once for many samples.
    #[inline(always)]
    fn corner(&self, sample: &Sample, faces: usize) -> Result<(u32, usize)> {
        let &Sample { face, sector, u, v } = sample;
        let is_loop = self.method == Method::Loop;
        let within = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
        if face as usize >= faces || !within || (is_loop && u + v > 1.0) {
            return Err(self.outside(sample));
        }
        let corners = self.mesh.layout.face(face);
        let sectors = self.sectors_of(corners.len());
        if sector as usize >= sectors {
            return Err(self.outside(sample));
        }
        if !self.holes.is_empty() && self.holes.binary_search(&face).is_ok() {
            return Err(Error::new(ErrorKind::Unsupported, "the face is a hole"));
        }
        Ok((corners.start + sector, sectors))
    }

    /// What is wrong with a sample that lies nowhere.
    #[cold]
    fn outside(&self, &Sample { face, sector, u, v }: &Sample) -> Error {
        let faces = self.mesh.faces();
        let sectors = if (face as usize) < faces { self.sectors(face as usize) } else { 0 };
        let message = if face as usize >= faces {
            format!("face {face} of {faces}")
        } else if sector as usize >= sectors {
            format!("sector {sector} of {sectors}")
        } else {
            format!("({u}, {v}) is not in the face")
        };
        Error::new(ErrorKind::ParameterOutOfRange, message)
    }
}

/// About the memory of a surface, were all its cells regular.
fn bytes(mesh: &Mesh, scheme: &Scheme, [lowest, highest]: [i32; 2]) -> u64 {
    let corners = mesh.corners() as u64;
    let (cells, points) = match scheme.method() {
        Method::Dual => (corners, u64::from(highest.abs_diff(lowest) + 1).pow(2)),
        Method::Loop => (mesh.faces() as u64, 12),
        _ => (mesh.faces() as u64, u64::from(highest.abs_diff(lowest) + 1).pow(2)),
    };
    size_of::<Root>() as u64 * corners + size_of::<u32>() as u64 * cells * points
}

/// An error with the face of a sample.
fn named(error: Error, sample: &Sample) -> Error {
    let place = format!("face {}, ({}, {})", sample.face, sample.u, sample.v);
    error.in_context(place).with_elements([Element::Face(u64::from(sample.face))])
}
