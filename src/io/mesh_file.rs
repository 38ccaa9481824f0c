//! A polygon mesh as a file holds it.

use super::Labels;
use super::tags::{self, SchemeTags};
use crate::base::{Crease, Element, Error, ErrorKind, NONE, Result, SharpVertex};

/// A polygon mesh as a file holds it: indices checked against the arrays,
/// nothing about manifoldness.
///
/// A *corner* is one entry of [`face_vertices`](Self::face_vertices). All
/// fields are plain data; [`check`](Self::check) tells whether they agree, and
/// the writers call it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshFile {
    /// Vertex positions, in the file's order.
    pub positions: Vec<[f64; 3]>,
    /// Corners per face, at least 3.
    pub face_sizes: Vec<u32>,
    /// The corners' vertices, face after face.
    pub face_vertices: Vec<u32>,
    /// The line on which each face starts; empty for binary files.
    pub face_lines: Vec<u32>,
    /// The line on which each vertex stands; empty for binary files.
    pub vertex_lines: Vec<u32>,
    /// Vertex colours.
    pub colors: Option<VertexColors>,
    /// Texture coordinates.
    pub uvs: Vec<[f64; 2]>,
    /// Per corner an index into `uvs`, or [`NONE`].
    pub face_uvs: Option<Vec<u32>>,
    /// Normals.
    pub normals: Vec<[f64; 3]>,
    /// Per corner an index into `normals`, or [`NONE`].
    pub face_normals: Option<Vec<u32>>,
    /// OBJ objects (`o`); the solids of a text STL.
    pub objects: Labels,
    /// OBJ groups (`g`); several groups at once are one name with blanks.
    pub groups: Labels,
    /// OBJ materials (`usemtl`).
    pub materials: Labels,
    /// OBJ smoothing groups (`s`); off is no name.
    pub smoothing: Labels,
    /// OBJ material libraries, one `mtllib` line each.
    pub material_libraries: Vec<String>,
    /// Sharp edges, in any order. Whether the mesh has such edges is not checked here.
    pub creases: Vec<Crease>,
    /// Sharp vertices, in any order.
    pub sharp_vertices: Vec<SharpVertex>,
    /// The faces that are holes, in any order.
    pub holes: Vec<u32>,
    /// What the file asks of the scheme.
    pub scheme: SchemeTags,
    /// Further vertex attributes of a PLY file.
    pub attributes: Vec<VertexAttribute>,
    /// One line for each thing that was in the file and could not be kept.
    pub notes: Vec<String>,
}

/// A colour per vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexColors {
    /// Components: 3, or 4 with opacity.
    pub width: usize,
    /// `width` values per vertex. Bytes are scaled to [0, 1], others are as in
    /// the file.
    pub values: Vec<f64>,
    /// The type that the file had and that is written back.
    pub kind: ColorType,
}

/// How colours are stored in files that know types.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ColorType {
    /// Bytes, 255 for 1; written rounded and clamped.
    U8,
    /// Numbers of the precision that the file is written in.
    Float,
}

impl ColorType {
    /// A component as a byte, rounded and clamped.
    #[expect(clippy::cast_sign_loss, reason = "saturating is what is meant")]
    pub(super) fn byte(value: f64) -> u8 {
        (value * 255.0).round() as u8
    }
}

/// A further number per vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexAttribute {
    /// The name in the file: one word.
    pub name: String,
    /// The type in the file, in which it is written back.
    pub kind: NumberType,
    /// One value per vertex; integers are rounded and clamped on writing.
    pub values: Vec<f64>,
}

/// The number types of PLY.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NumberType {
    /// `char`
    I8,
    /// `uchar`
    U8,
    /// `short`
    I16,
    /// `ushort`
    U16,
    /// `int`
    I32,
    /// `uint`
    U32,
    /// `float`
    F32,
    /// `double`
    F64,
}

impl MeshFile {
    /// The faces as slices of vertex indices, in order.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let mut rest = &self.face_vertices[..];
        self.face_sizes.iter().map(move |&size| {
            // A mesh that fails `check` gives short faces, not a panic.
            let (face, after) = rest.split_at(rest.len().min(size as usize));
            rest = after;
            face
        })
    }

    /// Tells whether the arrays agree in length, indices and finiteness, as
    /// those of a mesh that was read do.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`], [`ErrorKind::FaceTooSmall`],
    /// [`ErrorKind::IndexOutOfRange`], [`ErrorKind::NotFinite`],
    /// [`ErrorKind::TooLarge`] for more than 2³²−1 vertices or faces,
    /// [`ErrorKind::InvalidTag`] for a negative sharpness or a crease from a vertex to
    /// itself, and [`ErrorKind::InvalidText`] for a name that cannot stand in a file.
    pub fn check(&self) -> Result<()> {
        self.check_sizes()?;
        self.check_lengths()?;
        self.check_indices()?;
        self.check_numbers()?;
        tags::check(self)?;
        self.check_names()
    }

    fn check_sizes(&self) -> Result<()> {
        for (what, n) in [("vertices", self.positions.len()), ("faces", self.face_sizes.len())] {
            if n >= NONE as usize {
                let reason = format!("{n} {what}: more than a 32-bit index can name");
                return Err(Error::new(ErrorKind::TooLarge, reason));
            }
        }
        let small = self.face_sizes.iter().position(|&size| size < 3);
        small.map_or(Ok(()), |face| {
            let reason = format!("face {face} has {} vertices", self.face_sizes[face]);
            let element = Element::Face(face as u64);
            Err(Error::new(ErrorKind::FaceTooSmall, reason).with_elements([element]))
        })
    }

    fn check_lengths(&self) -> Result<()> {
        let (vertices, faces) = (self.positions.len(), self.face_sizes.len());
        let corners: u64 = self.face_sizes.iter().map(|&size| u64::from(size)).sum();
        let corners = usize::try_from(corners).unwrap_or(usize::MAX);
        same_length("face_vertices", self.face_vertices.len(), corners)?;
        for (what, indices) in [("face_uvs", &self.face_uvs), ("face_normals", &self.face_normals)]
        {
            same_length(what, indices.as_ref().map_or(corners, Vec::len), corners)?;
        }
        for (what, labels) in self.labels() {
            if !labels.is_empty() {
                same_length(what, labels.of_face.len(), faces)?;
            }
        }
        if let Some(colors) = &self.colors {
            if !matches!(colors.width, 3 | 4) {
                let reason = format!("colours of {} components: 3 or 4 are known", colors.width);
                return Err(Error::new(ErrorKind::LengthMismatch, reason));
            }
            same_length("colors", colors.values.len(), vertices.saturating_mul(colors.width))?;
        }
        self.attributes.iter().try_for_each(|a| same_length(&a.name, a.values.len(), vertices))
    }

    fn check_indices(&self) -> Result<()> {
        in_range("vertex", &self.face_vertices, self.positions.len(), false)?;
        in_range("uv", self.face_uvs.as_deref().unwrap_or(&[]), self.uvs.len(), true)?;
        let face_normals = self.face_normals.as_deref().unwrap_or(&[]);
        in_range("normal", face_normals, self.normals.len(), true)?;
        self.labels()
            .into_iter()
            .try_for_each(|(what, l)| in_range(what, &l.of_face, l.names.len(), true))
    }

    fn check_numbers(&self) -> Result<()> {
        finite("position", self.positions.as_flattened(), 3)?;
        finite("uv", self.uvs.as_flattened(), 2)?;
        finite("normal", self.normals.as_flattened(), 3)?;
        if let Some(colors) = &self.colors {
            finite("colour", &colors.values, colors.width)?;
        }
        self.attributes.iter().try_for_each(|a| finite(&a.name, &a.values, 1))
    }

    /// A name with a line end in it would become something else in the file.
    fn check_names(&self) -> Result<()> {
        let labels = self.labels().into_iter().flat_map(|(_, labels)| &labels.names);
        for name in labels.chain(&self.material_libraries) {
            let padded = name.trim_ascii().len() != name.len();
            if name.is_empty() || padded || has_control(name) {
                return Err(bad_name(name));
            }
        }
        let one_word = |name: &str| !name.is_empty() && name.bytes().all(|b| b.is_ascii_graphic());
        match self.attributes.iter().find(|a| !one_word(&a.name)) {
            Some(attribute) => Err(bad_name(&attribute.name)),
            None => Ok(()),
        }
    }

    /// The four kinds of per-face names, with what they are called.
    pub(super) fn labels(&self) -> [(&'static str, &Labels); 4] {
        [
            ("objects", &self.objects),
            ("groups", &self.groups),
            ("materials", &self.materials),
            ("smoothing", &self.smoothing),
        ]
    }

    /// The texture coordinates, if there is one per vertex and every corner
    /// uses its vertex's.
    pub(super) fn vertex_uvs(&self) -> Option<&[[f64; 2]]> {
        let same = self.uvs.len() == self.positions.len()
            && self.face_uvs.as_ref() == Some(&self.face_vertices);
        same.then_some(&self.uvs)
    }

    /// The normals, likewise.
    pub(super) fn vertex_normals(&self) -> Option<&[[f64; 3]]> {
        let same = self.normals.len() == self.positions.len()
            && self.face_normals.as_ref() == Some(&self.face_vertices);
        same.then_some(&self.normals)
    }
}

fn has_control(name: &str) -> bool {
    name.chars().any(|c| c.is_control() && c != '\t')
}

pub(super) fn bad_name(name: &str) -> Error {
    let shown = super::place::quote(name.as_bytes());
    Error::new(ErrorKind::InvalidText, format!("{shown} is not a name that a mesh file can hold"))
}

fn same_length(what: &str, len: usize, wanted: usize) -> Result<()> {
    if len == wanted {
        return Ok(());
    }
    let reason = format!("{what} has {len} entries, the mesh asks for {wanted}");
    Err(Error::new(ErrorKind::LengthMismatch, reason))
}

fn in_range(what: &str, indices: &[u32], count: usize, optional: bool) -> Result<()> {
    let bad = indices.iter().find(|&&i| i as usize >= count && !(optional && i == NONE));
    bad.map_or(Ok(()), |index| {
        let reason = format!("{what} {index} is named, there are {count}");
        Err(Error::new(ErrorKind::IndexOutOfRange, reason))
    })
}

fn finite(what: &str, values: &[f64], width: usize) -> Result<()> {
    let bad = values.iter().position(|v| !v.is_finite());
    bad.map_or(Ok(()), |at| {
        let record = at / width;
        let reason = format!("{what} {record} holds {}, which is not a finite number", values[at]);
        Err(Error::new(ErrorKind::NotFinite, reason))
    })
}
