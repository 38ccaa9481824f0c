//! Control meshes as flat arrays, and the options that OpenSubdiv made common.

use crate::bridge::ffi;

/// An edge by its two vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crease {
    /// The edge's ends.
    pub vertices: [u32; 2],
    /// From 0; 10 and more is infinite.
    pub sharpness: f32,
}

/// A sharp vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SharpVertex {
    /// The vertex.
    pub vertex: u32,
    /// From 0; 10 and more is infinite.
    pub sharpness: f32,
}

/// A face-varying channel: values of its own topology, one per corner by index.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// One index per corner.
    pub indices: Vec<u32>,
    /// The values, record after record.
    pub values: Vec<f64>,
    /// Values per record.
    pub width: usize,
}

/// A polygon soup with tags.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Control {
    /// Corners per face.
    pub sizes: Vec<u32>,
    /// The corners' vertices, face after face.
    pub indices: Vec<u32>,
    /// xyz per vertex.
    pub positions: Vec<f64>,
    /// Sharp edges.
    pub creases: Vec<Crease>,
    /// Sharp vertices.
    pub sharp_vertices: Vec<SharpVertex>,
    /// Faces that are holes.
    pub holes: Vec<u32>,
    /// Face-varying channels.
    pub channels: Vec<Channel>,
}

impl Control {
    /// A soup from faces as lists.
    pub fn new<F: AsRef<[u32]>>(
        positions: &[[f64; 3]],
        faces: impl IntoIterator<Item = F>,
    ) -> Self {
        let mut it = Self { positions: positions.concat(), ..Self::default() };
        for face in faces {
            it.sizes.push(face.as_ref().len() as u32);
            it.indices.extend_from_slice(face.as_ref());
        }
        it
    }

    /// The number of vertices.
    pub fn vertices(&self) -> usize {
        self.positions.len() / 3
    }

    /// The faces as slices, in order.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        faces(&self.sizes, &self.indices)
    }

    /// True if all faces are triangles.
    pub fn is_triangles(&self) -> bool {
        self.sizes.iter().all(|&size| size == 3)
    }

    /// The same with every coordinate rounded to single precision, so that runs in both
    /// precisions start from the same numbers.
    #[must_use]
    pub fn rounded(mut self) -> Self {
        for x in &mut self.positions {
            *x = f64::from(*x as f32);
        }
        self
    }

    /// The same with creases of one sharpness along edges.
    #[must_use]
    pub fn creased(mut self, edges: &[[u32; 2]], sharpness: f32) -> Self {
        self.creases.extend(edges.iter().map(|&vertices| Crease { vertices, sharpness }));
        self
    }

    /// The same with sharp vertices.
    #[must_use]
    pub fn cornered(mut self, vertices: &[u32], sharpness: f32) -> Self {
        let sharp = |&vertex: &u32| SharpVertex { vertex, sharpness };
        self.sharp_vertices.extend(vertices.iter().map(sharp));
        self
    }

    /// The same with holes.
    #[must_use]
    pub fn holed(mut self, faces: &[u32]) -> Self {
        self.holes.extend_from_slice(faces);
        self
    }

    pub(crate) fn soup(&self) -> ffi::Soup<'_> {
        ffi::Soup { sizes: &self.sizes, indices: &self.indices, positions: &self.positions }
    }
}

/// Faces as slices of concatenated indices.
pub(crate) fn faces<'a>(sizes: &'a [u32], mut rest: &'a [u32]) -> impl Iterator<Item = &'a [u32]> {
    sizes.iter().map(move |&size| {
        let (face, after) = rest.split_at(size as usize);
        rest = after;
        face
    })
}

/// What happens along a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// Faces at the boundary are holes.
    None = 0,
    /// Boundary edges are sharp.
    Edge = 1,
    /// Boundary edges are sharp and so are vertices with one face.
    #[default]
    EdgeAndCorner = 2,
}

impl Boundary {
    /// All.
    pub const ALL: [Self; 3] = [Self::None, Self::Edge, Self::EdgeAndCorner];
}

/// How semi-sharp creases wear off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Creasing {
    /// By one per level.
    #[default]
    Uniform = 0,
    /// By Chaikin's rule between neighbouring creases.
    Chaikin = 1,
}

impl Creasing {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Uniform, Self::Chaikin];
}

/// Catmull–Clark's rule for edges of triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Triangles {
    /// As for other faces.
    #[default]
    CatmullClark = 0,
    /// Weights that smooth triangles better.
    Smooth = 1,
}

/// How face-varying data is kept linear along seams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FaceVarying {
    /// Smooth everywhere (OpenSubdiv: none).
    Smooth = 0,
    /// Corners are sharp.
    #[default]
    CornersOnly = 1,
    /// As before, and where more than two regions meet.
    CornersPlus1 = 2,
    /// As before, and at darts and concave corners.
    CornersPlus2 = 3,
    /// All boundaries of regions are sharp.
    Boundaries = 4,
    /// Linear everywhere.
    All = 5,
}

impl FaceVarying {
    /// All modes.
    pub const ALL: [Self; 6] = [
        Self::Smooth,
        Self::CornersOnly,
        Self::CornersPlus1,
        Self::CornersPlus2,
        Self::Boundaries,
        Self::All,
    ];
}

/// Options of a refinement. Only OpenSubdiv has them; others refuse all but the default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    /// Along the boundary.
    pub boundary: Boundary,
    /// How creases wear off.
    pub creasing: Creasing,
    /// Catmull–Clark on triangles.
    pub triangles: Triangles,
    /// Face-varying data.
    pub face_varying: FaceVarying,
}
