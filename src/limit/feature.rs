//! Where a surface is not regular, and a mesh that shows it.

use crate::base::{Context, Crease, Error, ErrorKind, Result, SharpVertex};
use crate::mesh::{BuildOptions, Mesh, build};
use crate::refine::Pieces;
use crate::scheme::{Boundary, Scheme, SplitKind};
use std::f64::consts::TAU;
use std::fmt;

/// The sharpness of what stays sharp for ever.
const FOR_EVER: f32 = 10.0;
/// The most faces that are analysed where turns make small blocks of the matrix, and elsewhere.
const MOST: [usize; 2] = [512, 48];
/// The most smoothing passes: each reaches a ring of faces farther.
const MOST_PASSES: usize = 8;

/// A vertex of a control mesh with everything regular around it. Under a dual scheme it
/// becomes a face of as many sides; a face of n sides becomes the same under every scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Feature {
    /// Inside the mesh; a face with so many sides behaves alike.
    Interior {
        /// Faces around the vertex, 3 at least.
        valence: usize,
    },
    /// On the boundary.
    Boundary {
        /// Faces at the vertex, 1 at least.
        faces: usize,
    },
    /// On the boundary and interpolated.
    Corner {
        /// Faces at the vertex, 1 at least.
        faces: usize,
    },
    /// Two infinitely sharp edges meet.
    Crease {
        /// Faces on either side, 1 at least.
        faces: [usize; 2],
    },
    /// An infinitely sharp edge ends.
    Dart {
        /// Faces around the vertex, 3 at least.
        valence: usize,
    },
}

impl Feature {
    /// Faces around the vertex.
    pub fn faces(self) -> usize {
        match self {
            Self::Interior { valence } | Self::Dart { valence } => valence,
            Self::Boundary { faces } | Self::Corner { faces } => faces,
            Self::Crease { faces: [one, other] } => one.saturating_add(other),
        }
    }

    /// True if a turn by one face leads to the same mesh.
    pub(super) fn is_symmetric(self) -> bool {
        matches!(self, Self::Interior { .. })
    }

    fn is_closed(self) -> bool {
        !matches!(self, Self::Boundary { .. } | Self::Corner { .. })
    }

    /// The vertices of a model in the plane: rays at equal angles, in all a full turn inside
    /// the mesh, half a turn on the boundary, a quarter at a corner.
    pub(super) fn plane(self, rings: u32) -> Vec<[f64; 2]> {
        let plan = Plan { sectors: self.faces() as u32, rings, closed: self.is_closed() };
        let whole = match self {
            Self::Corner { .. } => TAU / 4.0,
            Self::Boundary { .. } => TAU / 2.0,
            _ => TAU,
        };
        let ray = |sector: u32| {
            let angle = whole * f64::from(sector) / f64::from(plan.sectors);
            [libm::cos(angle), libm::sin(angle)]
        };
        let mut points = vec![[0.0; 2]; plan.vertices()];
        for sector in 0..plan.sectors {
            let [along, across] = [ray(sector), ray(sector + 1)];
            for (i, j) in (0..=rings).flat_map(|i| (0..=rings).map(move |j| (i, j))) {
                let at = |k: usize| f64::from(i) * along[k] + f64::from(j) * across[k];
                points[plan.vertex(sector, i, j) as usize] = [at(0), at(1)];
            }
        }
        points
    }

    fn check(self, scheme: &Scheme) -> Result<()> {
        let least = if self.is_closed() { 3 } else { 1 };
        let most = MOST[usize::from(!self.is_symmetric())];
        let sides = if let Self::Crease { faces } = self { faces.contains(&0) } else { false };
        let error = |kind, message| Err(Error::new(kind, message));
        if !(least..=most).contains(&self.faces()) || sides {
            let message = format!("{self}: analysed are {least} to {most} faces around a vertex");
            return error(ErrorKind::ParameterOutOfRange, message);
        }
        if scheme.passes().len() > MOST_PASSES {
            let message = format!("analysed are schemes of up to {MOST_PASSES} passes");
            return error(ErrorKind::ParameterOutOfRange, message);
        }
        if !self.is_closed() && scheme.creases() && scheme.boundary() == Boundary::None {
            let message = format!("{self}: without a boundary rule faces there are holes");
            return error(ErrorKind::Unsupported, message);
        }
        let dual = scheme.split() == SplitKind::Corner;
        if matches!(self, Self::Corner { faces: 2.. }) && !dual && !scheme.creases() {
            let message = format!("{self}: the scheme interpolates vertices of one face alone");
            return error(ErrorKind::Unsupported, message);
        }
        Ok(())
    }

    /// A mesh around vertex 0 that is regular `rings` faces far.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for more or fewer faces or passes than are analysed,
    /// [`ErrorKind::Unsupported`] if the scheme has no such feature.
    pub(super) fn model(self, scheme: &Scheme, rings: u32) -> Result<Mesh> {
        self.check(scheme)?;
        let plan = Plan { sectors: self.faces() as u32, rings, closed: self.is_closed() };
        let (sizes, indices) = match scheme.pieces() {
            Pieces::Quads => plan.quads(),
            Pieces::Triangles => plan.triangles(),
        };
        let ray = |sector: u32| {
            (0..rings).map(move |i| Crease {
                vertices: [plan.vertex(sector, i, 0), plan.vertex(sector, i + 1, 0)],
                sharpness: FOR_EVER,
            })
        };
        let creases: Vec<Crease> = match self {
            Self::Crease { faces } => ray(0).chain(ray(faces[0] as u32)).collect(),
            Self::Dart { .. } => ray(0).collect(),
            _ => Vec::new(),
        };
        let corner = matches!(self, Self::Corner { .. });
        let heeds_sharpness = scheme.creases();
        let sharp = [SharpVertex { vertex: 0, sharpness: FOR_EVER }];
        let options = BuildOptions {
            creases: &creases,
            // Who does not know sharp vertices knows corner tags.
            corner_tags: if corner && !heeds_sharpness { &[0] } else { &[] },
            sharp_vertices: if corner && heeds_sharpness { &sharp } else { &[] },
            ..BuildOptions::default()
        };
        let built = build(&Context::serial(), plan.vertices(), &sizes, &indices, &options);
        Ok(built.map_err(Error::from)?.mesh)
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Interior { valence } => write!(f, "interior, valence {valence}"),
            Self::Boundary { faces } => write!(f, "boundary, {faces} faces"),
            Self::Corner { faces } => write!(f, "corner, {faces} faces"),
            Self::Crease { faces: [a, b] } => write!(f, "crease between {a} and {b} faces"),
            Self::Dart { valence } => write!(f, "dart, valence {valence}"),
        }
    }
}

/// Sectors around vertex 0; in each a grid between two rays, of which the first is its own.
#[derive(Clone, Copy)]
struct Plan {
    sectors: u32,
    rings: u32,
    closed: bool,
}

impl Plan {
    fn vertices(self) -> usize {
        let rays = u32::from(!self.closed) * self.rings;
        (1 + self.sectors * self.rings * (self.rings + 1) + rays) as usize
    }

    /// The vertex i steps along the first ray of a sector and j along the other.
    fn vertex(self, sector: u32, i: u32, j: u32) -> u32 {
        let (rings, each) = (self.rings, self.rings * (self.rings + 1));
        match (i, j) {
            (0, 0) => 0,
            // Another sector's first ray, or the last ray of all.
            (0, j) if sector + 1 < self.sectors => self.vertex(sector + 1, j, 0),
            (0, j) if self.closed => self.vertex(0, j, 0),
            (0, j) => self.sectors * each + j,
            (i, j) if sector < self.sectors => 1 + sector * each + (i - 1) * (rings + 1) + j,
            (i, _) => self.sectors * each + i,
        }
    }

    fn cells(self) -> impl Iterator<Item = (u32, u32, u32)> {
        let across = move |s| (0..self.rings).map(move |i| (s, i));
        let along = move |(s, i)| (0..self.rings).map(move |j| (s, i, j));
        (0..self.sectors).flat_map(across).flat_map(along)
    }

    fn quads(self) -> (Vec<u32>, Vec<u32>) {
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
        let face = |(s, i, j)| corners.map(|(x, y)| self.vertex(s, i + x, j + y));
        let indices: Vec<u32> = self.cells().flat_map(face).collect();
        (vec![4; indices.len() / 4], indices)
    }

    fn triangles(self) -> (Vec<u32>, Vec<u32>) {
        let mut indices = Vec::new();
        for (s, i, j) in self.cells().filter(|(_, i, j)| i + j < self.rings) {
            let at = |x, y| self.vertex(s, i + x, j + y);
            indices.extend([at(0, 0), at(1, 0), at(0, 1)]);
            if i + j + 1 < self.rings {
                indices.extend([at(1, 0), at(1, 1), at(0, 1)]);
            }
        }
        (vec![3; indices.len() / 3], indices)
    }
}
