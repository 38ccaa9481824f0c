//! Makes a mesh of loose triangles.

use crate::base::Result;
use crate::io::MeshFile;
use crate::io::place::Place;
use std::collections::HashMap;

/// The mesh so far, and its vertices by coordinates.
#[derive(Debug, Default)]
pub(super) struct Welder {
    pub mesh: MeshFile,
    index: HashMap<[u64; 3], u32>,
}

impl Welder {
    /// Adds a triangle that starts at `face`, its vertices at `vertices`.
    pub fn triangle(
        &mut self,
        face: Place<'_>,
        triangle: [[f64; 3]; 3],
        vertices: [Place<'_>; 3],
    ) -> Result<()> {
        for (position, place) in triangle.into_iter().zip(vertices) {
            let vertex = self.vertex(position, place)?;
            self.mesh.face_vertices.push(vertex);
        }
        face.check_count(self.mesh.face_vertices.len(), "face corners")?;
        self.mesh.face_sizes.push(3);
        if face.line_number() > 0 {
            self.mesh.face_lines.push(face.line_number());
        }
        Ok(())
    }

    fn vertex(&mut self, position: [f64; 3], place: Place<'_>) -> Result<u32> {
        let mesh = &mut self.mesh;
        let new = mesh.positions.len();
        place.check_count(new, "vertices")?;
        // Adding zero makes -0 the same as 0.
        let key = position.map(|x| (x + 0.0).to_bits());
        let vertex = *self.index.entry(key).or_insert(new as u32);
        if vertex as usize == new {
            mesh.positions.push(position);
            if place.line_number() > 0 {
                mesh.vertex_lines.push(place.line_number());
            }
        }
        Ok(vertex)
    }

    /// The mesh, with what was done to it in the notes.
    pub fn finish(mut self) -> MeshFile {
        let (faces, vertices) = (self.mesh.face_sizes.len(), self.mesh.positions.len());
        if faces > 0 {
            let note = format!("{faces} facet normals were dropped");
            self.mesh.notes.push(note);
            let note = format!("{} triangle corners were welded to {vertices} vertices", 3 * faces);
            self.mesh.notes.push(note);
        }
        self.mesh
    }
}
