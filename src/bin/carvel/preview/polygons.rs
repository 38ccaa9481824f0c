//! The mesh as it comes in: borrowed positions and faces, checked once.

use carvel::{Element, Error, ErrorKind, Result};

/// A borrowed polygon mesh; see [`render`](super::render) for the layout.
#[derive(Debug, Clone, Copy)]
pub struct Polygons<'a> {
    /// One point per vertex.
    pub positions: &'a [[f64; 3]],
    /// The number of vertices of each face.
    pub face_sizes: &'a [u32],
    /// The vertices of all faces, one face after the other.
    pub face_vertices: &'a [u32],
}

/// A mesh whose indices exist and whose used coordinates are finite.
pub struct Checked<'a> {
    mesh: Polygons<'a>,
    used: Vec<bool>,
}

impl<'a> Polygons<'a> {
    /// Checks lengths, indices and coordinates.
    ///
    /// # Errors
    /// `LengthMismatch`, `IndexOutOfRange` or `NotFinite`.
    pub fn check(&self) -> Result<Checked<'a>> {
        let corners = self.face_sizes.iter().map(|&n| u64::from(n)).sum::<u64>();
        if corners != self.face_vertices.len() as u64 {
            return Err(Error::new(
                ErrorKind::LengthMismatch,
                format!(
                    "faces of {corners} corners in all with {} vertex numbers",
                    self.face_vertices.len()
                ),
            ));
        }
        let mut used = vec![false; self.positions.len()];
        for &v in self.face_vertices {
            *used.get_mut(v as usize).ok_or_else(|| missing(v, self.positions.len()))? = true;
        }
        let checked = Checked { mesh: *self, used };
        let bad = checked.used_vertices().find(|(_, p)| p.iter().any(|x| !x.is_finite()));
        bad.map_or(Ok(()), |(v, _)| Err(not_finite(v)))?;
        Ok(checked)
    }
}

fn missing(vertex: u32, count: usize) -> Error {
    Error::new(
        ErrorKind::IndexOutOfRange,
        format!("a face names vertex {vertex}, but there are {count}"),
    )
    .with_elements([Element::Vertex(u64::from(vertex))])
}

fn not_finite(vertex: usize) -> Error {
    Error::new(ErrorKind::NotFinite, format!("vertex {vertex} has a coordinate that is not finite"))
        .with_elements([Element::Vertex(vertex as u64)])
}

impl<'a> Checked<'a> {
    /// All positions, those of unused vertices too.
    pub fn positions(&self) -> &'a [[f64; 3]] {
        self.mesh.positions
    }

    /// The vertices that occur in a face, with their positions.
    pub fn used_vertices(&self) -> impl Iterator<Item = (usize, [f64; 3])> {
        let positions = self.mesh.positions.iter().copied().enumerate();
        positions.zip(&self.used).filter_map(|(v, &used)| used.then_some(v))
    }

    /// The faces of three vertices and more.
    pub fn faces(&self) -> impl Iterator<Item = &'a [u32]> + use<'a> {
        let mut rest = self.mesh.face_vertices;
        let faces = self.mesh.face_sizes.iter().map(move |&n| {
            let (face, tail) = rest.split_at(n as usize);
            rest = tail;
            face
        });
        faces.filter(|face| face.len() >= 3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];

    fn kind(positions: &[[f64; 3]], face_sizes: &[u32], face_vertices: &[u32]) -> ErrorKind {
        let mesh = Polygons { positions, face_sizes, face_vertices };
        mesh.check().err().expect("a refusal").kind()
    }

    #[test]
    fn refuses_what_is_no_mesh() {
        assert_eq!(kind(&SQUARE, &[4], &[0, 1, 2]), ErrorKind::LengthMismatch);
        assert_eq!(kind(&SQUARE, &[3], &[0, 1, 2, 3]), ErrorKind::LengthMismatch);
        assert_eq!(kind(&SQUARE, &[u32::MAX; 9], &[0]), ErrorKind::LengthMismatch);
        assert_eq!(kind(&SQUARE, &[3], &[0, 1, 4]), ErrorKind::IndexOutOfRange);
        assert_eq!(kind(&[], &[3], &[0, 0, 0]), ErrorKind::IndexOutOfRange);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let positions = [[0.; 3], [1.; 3], [0., 0., bad]];
            assert_eq!(kind(&positions, &[3], &[0, 1, 2]), ErrorKind::NotFinite);
        }
    }

    #[test]
    fn unused_vertices_do_not_matter() {
        let positions = [[f64::NAN; 3], [1.; 3], [0.; 3], [2.; 3]];
        let mesh = Polygons { positions: &positions, face_sizes: &[3], face_vertices: &[1, 2, 3] };
        assert_eq!(
            mesh.check().unwrap().used_vertices().map(|(v, _)| v).collect::<Vec<_>>(),
            [1, 2, 3]
        );
    }

    #[test]
    fn small_faces_are_passed_over() {
        let mesh = Polygons {
            positions: &SQUARE,
            face_sizes: &[0, 2, 3, 1, 4],
            face_vertices: &[0, 1, 1, 2, 3, 0, 0, 1, 2, 3],
        };
        let faces: Vec<_> = mesh.check().unwrap().faces().collect();
        assert_eq!(faces, [&[1, 2, 3][..], &[0, 1, 2, 3]]);
    }
}
