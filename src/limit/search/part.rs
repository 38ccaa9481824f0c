//! Parts of the surface: what is known of one, and what it is divided into.

use super::cell::{Cell, sample};
use crate::base::{Context, Error, ErrorKind, Result, memory};
use crate::limit::surface::{Derivatives, Piece, Sample, Scratch, Surface};
use crate::limit::tessellate::{Fit, Root, Shape, no_surface, places};
use glam::DVec3;
use std::cell::RefCell;

/// What a part is known by.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "most parts are of the large kind")]
pub(super) enum Form {
    /// The polynomial that it is.
    Exact(Fit),
    /// A polynomial through points of it.
    Sampled(Fit),
    /// Points in whose hull it lies.
    Hull(Vec<DVec3>),
}

/// The surface over a cell.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub(super) root: u32,
    pub(super) cell: Cell,
    pub(super) form: Form,
    /// How far it may be from the hull of its points.
    pub(super) slack: f64,
}

/// A box with sides along the axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Bounds {
    const NONE: Self =
        Self { low: DVec3::splat(f64::INFINITY), high: DVec3::splat(f64::NEG_INFINITY) };

    pub(super) fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The distance of a point, 0 inside.
    pub(super) fn distance(&self, p: DVec3) -> f64 {
        (self.low - p).max(p - self.high).max(DVec3::ZERO).length()
    }
}

impl Part {
    /// Points in whose hull it lies, but for the slack.
    pub(super) fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        let (fit, hull) = match &self.form {
            Form::Exact(fit) | Form::Sampled(fit) => (Some(fit), &[][..]),
            Form::Hull(points) => (None, &points[..]),
        };
        fit.into_iter().flat_map(Fit::all).chain(hull.iter().copied())
    }

    pub(super) fn bounds(&self) -> Bounds {
        let around = |bounds: Bounds, p: DVec3| bounds.with(Bounds { low: p, high: p });
        let Bounds { low, high } = self.points().fold(Bounds::NONE, around);
        let slack = DVec3::splat(self.slack);
        Bounds { low: low - slack, high: high + slack }
    }
}

/// The largest distance of coefficients from where they would be were the surface bilinear.
fn bend(fit: &Fit) -> f64 {
    let far = |[i, j]: [usize; 2]| {
        let [s, t] = [i, j].map(|k| k as f64 / 4.0);
        let (a, b, d) = (fit.at(0, 0), fit.at(4, 0), fit.at(0, 4));
        let flat = match fit.shape {
            Shape::Triangle => a + s * (b - a) + t * (d - a),
            _ => (1.0 - t) * (a + s * (b - a)) + t * (d + s * (fit.at(4, 4) - d)),
        };
        flat.distance(fit.at(i, j))
    };
    places(fit.shape).map(far).fold(0.0, f64::max)
}

/// What a thread remembers of cells around features.
pub(super) type Memory = RefCell<Scratch>;

/// A surface with its positions, of which none exceeds 1.
#[derive(Debug)]
pub(super) struct Field {
    pub(super) surface: std::sync::Arc<Surface>,
    pub(super) positions: Vec<f64>,
    pub(super) roots: Vec<Root>,
    /// Whether the hulls of irregular cells are known.
    pub(super) positive: bool,
}

impl Field {
    pub(super) fn shape(&self, part: &Part) -> Shape {
        self.roots[part.root as usize].shape
    }

    pub(super) fn sample(&self, root: u32, at: [f64; 2]) -> Sample {
        sample(&self.roots[root as usize], at)
    }

    /// The surface over a cell.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] where there is none, and as [`Surface::evaluate`].
    pub(super) fn part(&self, memory: &Memory, root: u32, cell: Cell) -> Result<Part> {
        let inside = self.sample(root, cell.place([0.25; 2]));
        let side = cell.side.abs();
        let new = |form, slack| Part { root, cell, form, slack };
        match self.surface.piece(&inside, side)? {
            Piece::Missing => Err(no_surface(&self.roots[root as usize])),
            Piece::Polynomial => Ok(new(Form::Exact(self.fit(memory, root, cell)?), 0.0)),
            Piece::Irregular if self.positive => {
                let points = self.surface.cell_hull(&inside, side, &self.positions)?;
                Ok(new(Form::Hull(points), 0.0))
            }
            Piece::Regular | Piece::Irregular => {
                let fit = self.fit(memory, root, cell)?;
                Ok(new(Form::Sampled(fit), bend(&fit)))
            }
        }
    }

    /// The four parts of a part.
    ///
    /// # Errors
    /// As [`Self::part`].
    pub(super) fn children(&self, memory: &Memory, part: &Part) -> Result<[Part; 4]> {
        let (root, cells) = (part.root, part.cell.children(self.shape(part)));
        if let Form::Exact(fit) = &part.form {
            let mut fits = fit.children().into_iter();
            return each(cells, |cell| {
                let fit = fits.next();
                let fit =
                    fit.ok_or_else(|| Error::new(ErrorKind::BrokenInvariant, "a part is missing"))?;
                Ok(Part { root, cell, form: Form::Exact(fit), slack: 0.0 })
            });
        }
        each(cells, |cell| self.part(memory, root, cell))
    }

    fn fit(&self, memory: &Memory, root: u32, cell: Cell) -> Result<Fit> {
        let shape = self.roots[root as usize].shape;
        let mut points = [[0.0; 3]; 25];
        let mut count = 0;
        for (point, place) in points.iter_mut().zip(places(shape)) {
            let at = cell.place(place.map(|k| k as f64 / 4.0));
            *point = self.at(memory, root, at)?.to_array();
            count += 1;
        }
        Ok(Fit::new(shape, &points[..count]))
    }

    /// The points of samples.
    pub(super) fn evaluate(
        &self,
        context: &Context,
        samples: &[Sample],
        points: &mut [[f64; 3]],
    ) -> Result<()> {
        let out = points.as_flattened_mut();
        self.surface.evaluate(context, samples, &self.positions, 3, Derivatives::None, out)
    }

    /// The point with coordinates in a face or sector.
    fn at(&self, memory: &Memory, root: u32, at: [f64; 2]) -> Result<DVec3> {
        let busy = |_| Error::new(ErrorKind::BrokenInvariant, "a memory is used twice at once");
        let mut scratch = memory.try_borrow_mut().map_err(busy)?;
        let mut point = [0.0; 3];
        self.surface.one(&self.sample(root, at), &self.positions, 3, &mut scratch, &mut point)?;
        Ok(DVec3::from(point))
    }

    /// The point of a part with coordinates in its cell.
    pub(super) fn point(&self, memory: &Memory, part: &Part, at: [f64; 2]) -> Result<DVec3> {
        self.at(memory, part.root, part.cell.place(at))
    }

    /// The parts that a search begins with: irregular cells cut so often, others whole.
    pub(super) fn first_parts(
        &self,
        memory: &Memory,
        root: u32,
        cuts: u32,
        out: &mut Vec<Part>,
    ) -> Result<()> {
        let shape = self.roots[root as usize].shape;
        let quarters = shape == Shape::Quad && self.surface.has_quarters();
        let cells = Cell::WHOLE.children(shape);
        let cells = if quarters { &cells[..] } else { &[Cell::WHOLE] };
        let mut open = Vec::new();
        for &cell in cells {
            memory::extend(&mut open, [(self.part(memory, root, cell)?, cuts)])?;
        }
        while let Some((part, cuts)) = open.pop() {
            if cuts == 0 || matches!(part.form, Form::Exact(_)) {
                memory::extend(out, [part])?;
            } else {
                memory::extend(
                    &mut open,
                    self.children(memory, &part)?.map(|part| (part, cuts - 1)),
                )?;
            }
        }
        Ok(())
    }
}

/// What becomes of four cells, if of all.
fn each(cells: [Cell; 4], mut of: impl FnMut(Cell) -> Result<Part>) -> Result<[Part; 4]> {
    let [a, b, c, d] = cells;
    Ok([of(a)?, of(b)?, of(c)?, of(d)?])
}
