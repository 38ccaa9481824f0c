//! Triangles within a tolerance of the limit surface, or short on a screen, small where they
//! have to be.
//!
//! Faces are halved until each cell is fine enough by a measure of its own, then until no side of
//! a cell is cut into more than two by those beside it. A cell's triangles take all points on its
//! sides, so that there are no cracks, and a point that faces share is evaluated once.
//!
//! | module | its one idea |
//! |---|---|
//! | `cell` | parts of a face that halving leads to |
//! | `fit` | the polynomial over a cell |
//! | `measure` | how far its triangles are off, or how long on a screen |
//! | `split` | from faces to cells |
//! | `shared` | points that faces have in common |
//! | `net` | cells beside each other |
//! | `triangles` | what a cell becomes |
//! | `plan` | points and triangles with their numbers |
//! | `normals` | positions and normals |

mod cell;
mod fit;
mod measure;
mod net;
mod normals;
mod plan;
mod shared;
mod split;
mod triangles;

use super::surface::{Sample, Surface};
use crate::base::{Context, Element, Error, ErrorKind, Result, Scalar, memory};
use cell::MOST_LEVELS;
pub(super) use cell::{Root, Shape};
pub(super) use fit::{Fit, places};
use measure::Measure;
use net::Net;
use plan::Plan;
pub(super) use split::no_surface;
use split::{Goal, Leaves};

/// When triangles are small enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fineness {
    /// When no point of the surface is farther from them than this, in units of the positions;
    /// finite and above 0.
    Chord(f64),
    /// When their edges are no longer than this on a screen, in pixels, wherever they may be in
    /// view; finite and above 0.
    Pixels(f64, Screen),
}

/// A view of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screen {
    /// By rows, the matrix that takes (x, y, z, 1) to clip coordinates; a point (x, y, z, w) is
    /// in view if |x| ≤ w, |y| ≤ w and −w ≤ z. Finite.
    pub matrix: [[f64; 4]; 4],
    /// Width and height of the picture in pixels; finite and above 0.
    pub viewport: [f64; 2],
}

/// How a surface is cut into triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TessellateOptions {
    /// When triangles are small enough.
    pub fineness: Fineness,
    /// Halvings of a face's sides at most, 0 to 24. Cells that would have to be halved again
    /// are counted ([`Tessellation::coarse`]). Quads are halved once whatever it says under dual
    /// schemes, and where their diagonals are edges elsewhere.
    pub levels: u32,
    /// The most triangles.
    pub triangles: u64,
    /// Whether faces, or sectors of them, are left out rather than refused that have no surface
    /// somewhere, as beside a boundary under a dual scheme that ends inside
    /// ([`crate::Boundary::None`]).
    pub partial: bool,
}

impl TessellateOptions {
    /// Options with 20 levels and 2³² − 1 triangles at most, nothing left out but holes.
    pub fn new(fineness: Fineness) -> Self {
        Self { fineness, levels: 20, triangles: u64::from(u32::MAX), partial: false }
    }

    fn check(&self) -> Result<()> {
        let refuse = |message| Err(Error::new(ErrorKind::ParameterOutOfRange, message));
        let above = |x: f64| x.is_finite() && x > 0.0;
        let (length, screen) = match &self.fineness {
            Fineness::Chord(tolerance) => (*tolerance, None),
            Fineness::Pixels(pixels, screen) => (*pixels, Some(screen)),
        };
        if !above(length) {
            return refuse(format!("a tolerance of {length}: it must be finite and above 0"));
        }
        if let Some(Screen { matrix, viewport }) = screen {
            if !viewport.iter().all(|&side| above(side)) {
                let [width, height] = viewport;
                let message =
                    format!("a viewport of {width} x {height}: both must be finite and above 0");
                return refuse(message);
            }
            if !matrix.as_flattened().iter().all(|x| x.is_finite()) {
                return refuse("the matrix of a view must be finite".to_owned());
            }
        }
        if self.levels > MOST_LEVELS {
            return refuse(format!("{} levels: they may be 0 to {MOST_LEVELS}", self.levels));
        }
        Ok(())
    }
}

/// Triangles on a limit surface.
///
/// A *place* is a vertex as a point of one face or sector: inside a face a vertex has one, on an
/// edge one for each side. So normals may differ across a crease, and values may across a seam:
/// [`Surface::evaluate`] of `places` gives vertex data, or face-varying values by the surface of
/// a [`crate::Channel`]'s mesh.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Tessellation {
    /// Points of the surface.
    pub positions: Vec<[f64; 3]>,
    /// Three vertices of each triangle, counter-clockwise as the faces are; those of a face
    /// stand together, in the order of the faces.
    pub triangles: Vec<[u32; 3]>,
    /// The control face of each triangle, in the mesh's order.
    pub faces: Vec<u32>,
    /// Faces and coordinates of places. A vertex is evaluated at its first one.
    pub places: Vec<Sample>,
    /// The vertex of each place.
    pub place_vertices: Vec<u32>,
    /// Three places of each triangle, all in its face and sector.
    pub triangle_places: Vec<[u32; 3]>,
    /// Unit normals at places, the same for all places of a vertex unless they differ by more
    /// than a thousandth of a radian, as they do at creases and under schemes that are not
    /// smooth. At features, where the surface has no derivatives, they are those of points next to
    /// them, where that has none either those of the triangles, and zero where these have none.
    pub normals: Vec<[f64; 3]>,
    /// The bound on the distance by which all cells were found fine, or the length of the longest
    /// edge in pixels, of what is in view.
    pub measure: f64,
    /// Cells that [`TessellateOptions::levels`] left coarser than asked for.
    pub coarse: u64,
    /// Faces, or sectors of them, without a surface that were left out; holes are not among them.
    pub missing: u64,
}

/// Cuts a limit surface into triangles that are as small as their own part of it asks for.
///
/// Under [`Fineness::Chord`] no point of the surface is farther from the triangles than the
/// tolerance. That is proven, up to rounding, wherever the surface is a polynomial of degree 4
/// at most: by second derivatives or by the hull of Bernstein coefficients, which bound all of a
/// cell (B-splines up to degree 4, Catmull–Clark, Loop, Doo–Sabin; everywhere but in cells that
/// hold an extraordinary vertex, the end of a crease or an edge that is still semi-sharp). Other
/// cells are judged by 25 points of theirs, or 15 of a triangle, with a safety factor of 2: that
/// is a test and no proof. They become smaller until they pass; around an extraordinary vertex
/// the cells of each level are a fixed number, so that curvature without bound costs little.
/// Distance counts parameters too: it is measured between points of equal coordinates unless a
/// cell is flat.
///
/// Under [`Fineness::Pixels`] cells are judged by all edges that they may get, in front of the
/// viewer, unless their hull lies beyond a side of the view: those stay coarse. Cells that are
/// halved only because of finer neighbours are not judged again, and may have edges that are
/// longer; [`Tessellation::measure`] tells. The distance from the surface is not looked at.
///
/// Edges match bit for bit, between faces and between sectors: the triangles of a closed mesh
/// are closed, with its Euler characteristic. As a mesh of their own ([`crate::Mesh`]) they are
/// manifold if the control mesh is, unless two triangles of Loop's scheme share two edges.
/// Holes are left out. The result is the same at any number of threads.
///
/// Time and memory grow with the triangles: about 150 bytes for each, checked against the
/// context's ceiling as they come to be known.
///
/// # Errors
/// [`ErrorKind::ParameterOutOfRange`] for options out of range, [`ErrorKind::LengthMismatch`] for
/// other than three positions per vertex, [`ErrorKind::NotFinite`], naming the vertex,
/// [`ErrorKind::Unsupported`] where the surface is not evaluated, naming the face;
/// [`ErrorKind::TooLarge`] for more triangles than may be,
/// [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`].
///
/// # Example
/// ```
/// use carvel::limit::{Fineness, Surface, TessellateOptions, tessellate};
/// use carvel::{Context, Mesh, Scheme};
/// use std::sync::Arc;
/// let cube = Arc::new(Mesh::from_polygons(8, &[4; 6], &[
///     0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3,
/// ])?);
/// let context = Context::serial();
/// let surface = Surface::new(&context, &cube, &Scheme::catmull_clark())?;
/// let corners: Vec<f64> = (0..24).map(|i| f64::from(i / 3 >> (i % 3) & 1)).collect();
/// let options = TessellateOptions::new(Fineness::Chord(1e-2));
/// let made = tessellate(&context, &surface, &corners, &options)?;
/// let indices = made.triangles.as_flattened();
/// let mesh = Mesh::from_polygons(made.positions.len(), &vec![3; made.triangles.len()], indices)?;
/// assert!(mesh.is_closed() && made.measure <= 1e-2 && made.coarse == 0);
/// # Ok::<(), carvel::Error>(())
/// ```
pub fn tessellate<T: Scalar>(
    context: &Context,
    surface: &Surface,
    positions: &[T],
    options: &TessellateOptions,
) -> Result<Tessellation> {
    options.check()?;
    context.report(0.0)?;
    let mut positions = checked(surface, positions)?;
    let scale = exponent(&positions);
    scale_by(&mut positions, -scale);
    let roots = roots(surface)?;
    let goal = goal(options, scale);
    let Leaves { cells, largest, coarse, missing } =
        split::split(context, surface, &positions, &roots, &goal)?;
    let net = Net::new(context, surface.mesh(), &roots, cells)?;
    let plan = Plan::new(context, net, options.triangles)?;
    context.report(0.5)?;
    let mut made = plan.places(context)?;
    (made.coarse, made.missing) = (coarse, missing);
    let evaluated = normals::evaluate(context, surface, &made.places, &positions)?;
    for (&v, [position, _]) in made.place_vertices.iter().zip(&evaluated).rev() {
        made.positions[v as usize] = *position;
    }
    made.normals = memory::collect(evaluated.into_iter().map(|[_, normal]| normal))?;
    context.report(0.9)?;
    plan.triangles(context, &mut made)?;
    normals::settle(&mut made)?;
    made.measure = match &goal.measure {
        Measure::Chord => libm::scalbn(largest, scale),
        Measure::Screen { matrix, half } => {
            measure::longest_in_view((matrix, *half), &made.positions, &made.triangles)
        }
    };
    scale_by(made.positions.as_flattened_mut(), scale);
    Ok(made)
}

/// The power of two by which coordinates are divided, exactly, so that squares of their differences
/// stay in range.
fn exponent(positions: &[f64]) -> i32 {
    let largest = positions.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest > 0.0 { libm::ilogb(largest) } else { 0 }
}

fn scale_by(coordinates: &mut [f64], exponent: i32) {
    for x in coordinates {
        *x = libm::scalbn(*x, exponent);
    }
}

/// Positions in double precision.
pub(super) fn checked<T: Scalar>(surface: &Surface, positions: &[T]) -> Result<Vec<f64>> {
    let vertices = surface.columns();
    if positions.len() != 3 * vertices {
        let message = format!("{} numbers for {vertices} positions", positions.len());
        return Err(Error::new(ErrorKind::LengthMismatch, message));
    }
    if let Some(at) = positions.iter().position(|x| !Scalar::is_finite(*x)) {
        let message = format!("the position of vertex {} is not finite", at / 3);
        return Err(Error::new(ErrorKind::NotFinite, message)
            .with_elements([Element::Vertex(at as u64 / 3)]));
    }
    memory::collect(positions.iter().map(|x| x.to_f64()))
}

/// The faces and sectors with a surface.
pub(super) fn roots(surface: &Surface) -> Result<Vec<Root>> {
    let faces = 0..surface.mesh().faces() as u32;
    let faces = faces.filter(|face| surface.holes().binary_search(face).is_err());
    let sectors = |face: u32| (0..surface.sectors(face as usize) as u32).map(move |s| (face, s));
    memory::collect(faces.flat_map(sectors).map(|(face, s)| Root::new(surface, face, s)))
}

/// What is asked for of coordinates divided by a power of two.
fn goal(options: &TessellateOptions, scale: i32) -> Goal {
    let (measure, limit) = match options.fineness {
        Fineness::Chord(tolerance) => (Measure::Chord, libm::scalbn(tolerance, -scale)),
        Fineness::Pixels(pixels, Screen { mut matrix, viewport }) => {
            let of_points = matrix.iter_mut().flat_map(|row| &mut row[..3]);
            of_points.for_each(|x| *x = libm::scalbn(*x, scale));
            let half = viewport.map(|side| side / 2.0);
            (Measure::Screen { matrix, half }, pixels)
        }
    };
    let TessellateOptions { levels, triangles, partial, .. } = *options;
    Goal { measure, limit, levels, cells: triangles, bytes: plan::CELL, partial }
}
