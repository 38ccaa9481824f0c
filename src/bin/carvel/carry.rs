//! What travels with a mesh through a refinement.
//!
//! Vertex data is refined by the positions' rows; per-face names go from every
//! control face to its descendants; what can do neither is named and left out.

use crate::seams::ByCorner;
use carvel::base::NONE;
use carvel::io::{Labels, MeshFile, VertexAttribute, VertexColors};

/// Data on the vertices of a control mesh, besides the positions.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    what: What,
    /// Values per vertex.
    pub width: usize,
    /// The values, one vertex after the other.
    pub values: Vec<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum What {
    Colors,
    Uvs,
    Normals,
    Attribute(usize),
}

/// All vertex data of a file, and what had to be left out.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Load {
    /// The data that refines.
    pub columns: Vec<Column>,
    /// One line about the data that does not, if there is any.
    pub dropped: Option<String>,
}

impl Load {
    /// Values per vertex, the coordinates among them.
    pub fn width(&self) -> u64 {
        3 + self.columns.iter().map(|c| c.width as u64).sum::<u64>()
    }

    /// Collects the vertex data of a file. `source` gives the file's vertex for
    /// each of the mesh's, if those are not the same; texture coordinates may go another
    /// way.
    pub fn of(file: &MeshFile, source: Option<&[u32]>, with_uvs: bool) -> Self {
        let mut load = Self::default();
        if let Some(colors) = &file.colors {
            load.push(What::Colors, colors.width, colors.values.clone(), source);
        }
        let mut dropped = Vec::new();
        let uvs = uvs(file).filter(|_| with_uvs);
        load.push_corner_data(What::Uvs, uvs, source, &mut dropped);
        load.push_corner_data(What::Normals, normals(file), source, &mut dropped);
        for (i, attribute) in file.attributes.iter().enumerate() {
            load.push(What::Attribute(i), 1, attribute.values.clone(), source);
        }
        load.dropped = (!dropped.is_empty()).then(|| format!("dropped {}", dropped.join(" and ")));
        load
    }

    fn push_corner_data<const N: usize>(
        &mut self,
        what: What,
        data: Option<ByCorner<'_, N>>,
        source: Option<&[u32]>,
        dropped: &mut Vec<String>,
    ) {
        match data.map(|data| data.by_vertex()) {
            None => {}
            Some(Ok(records)) => self.push(what, N, records.into_flattened(), source),
            Some(Err(why)) => dropped.push(match what {
                What::Uvs => format!("the texture coordinates ({why})"),
                _ => format!("the normals ({why})"),
            }),
        }
    }

    fn push(&mut self, what: What, width: usize, values: Vec<f64>, source: Option<&[u32]>) {
        let values = match source {
            None => values,
            Some(source) => {
                let record = |&v: &u32| &values[v as usize * width..][..width];
                source.iter().flat_map(record).copied().collect()
            }
        };
        self.columns.push(Column { what, width, values });
    }
}

fn uvs(file: &MeshFile) -> Option<ByCorner<'_, 2>> {
    by_corner(file, file.face_uvs.as_deref(), &file.uvs)
}

fn normals(file: &MeshFile) -> Option<ByCorner<'_, 3>> {
    by_corner(file, file.face_normals.as_deref(), &file.normals)
}

fn by_corner<'a, const N: usize>(
    file: &'a MeshFile,
    indices: Option<&'a [u32]>,
    records: &'a [[f64; N]],
) -> Option<ByCorner<'a, N>> {
    (!records.is_empty()).then_some(ByCorner {
        vertices: file.positions.len(),
        corners: &file.face_vertices,
        indices,
        records,
    })
}

/// Puts refined vertex data into the file that holds the refined mesh.
///
/// `refined` has the values of each column of the load, in order.
pub fn unload(load: &Load, refined: Vec<Vec<f64>>, control: &MeshFile, file: &mut MeshFile) {
    for (column, values) in load.columns.iter().zip(refined) {
        match column.what {
            What::Colors => file.colors = colors(control, values),
            What::Uvs => {
                file.uvs = values.as_chunks().0.to_vec();
                file.face_uvs = Some(file.face_vertices.clone());
            }
            What::Normals => {
                file.normals = values.as_chunks().0.iter().map(unit).collect();
                file.face_normals = Some(file.face_vertices.clone());
            }
            What::Attribute(i) => {
                let VertexAttribute { name, kind, .. } = &control.attributes[i];
                file.attributes.push(VertexAttribute { name: name.clone(), kind: *kind, values });
            }
        }
    }
}

/// Refined colours. Negative weights may lead out of [0, 1]; if the control
/// mesh keeps within, so does the result.
fn colors(control: &MeshFile, mut values: Vec<f64>) -> Option<VertexColors> {
    let VertexColors { width, values: before, kind } = control.colors.as_ref()?;
    if before.iter().all(|c| (0.0..=1.0).contains(c)) {
        for c in &mut values {
            *c = c.clamp(0.0, 1.0);
        }
    }
    Some(VertexColors { width: *width, values, kind: *kind })
}

/// A normal of length 1; one without a direction stays as it is.
fn unit(normal: &[f64; 3]) -> [f64; 3] {
    let largest = normal.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest <= 0.0 {
        return *normal;
    }
    // Scaled first: squares of small or large numbers leave the range.
    let scaled = normal.map(|x| x / largest);
    let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
    scaled.map(|x| x / length)
}

/// Hands the names of control faces down. `faces` gives the control file's face
/// for every refined one.
pub fn inherit(control: &MeshFile, faces: &[u32], file: &mut MeshFile) {
    let of_faces = |labels: &Labels| -> Vec<u32> {
        let name = |&f: &u32| labels.of_face.get(f as usize).copied().unwrap_or(NONE);
        faces.iter().map(name).collect()
    };
    let down = |labels: &Labels| Labels {
        names: labels.names.clone(),
        of_face: if labels.is_empty() { Vec::new() } else { of_faces(labels) },
    };
    file.objects = down(&control.objects);
    file.groups = down(&control.groups);
    file.materials = down(&control.materials);
    file.smoothing = down(&control.smoothing);
    file.material_libraries.clone_from(&control.material_libraries);
}

/// Bytes that one refined vertex, corner and face of a mesh with this load take
/// in memory, besides positions and faces themselves.
pub fn bytes(load: &Load, control: &MeshFile, vertices: u64, corners: u64, faces: u64) -> u64 {
    let width: usize = load.columns.iter().map(|column| column.width).sum();
    let by_corner = |c: &&Column| matches!(c.what, What::Uvs | What::Normals);
    let indices = load.columns.iter().filter(by_corner).count() as u64;
    let labels = [&control.objects, &control.groups, &control.materials, &control.smoothing];
    let labels = labels.iter().filter(|labels| !labels.is_empty()).count() as u64;
    8 * width as u64 * vertices + 4 * indices * corners + 4 * labels * faces
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // what is exact is compared exactly
mod tests {
    use super::*;
    use carvel::io::ColorType;

    fn triangle() -> MeshFile {
        MeshFile {
            positions: vec![[0.0; 3]; 3],
            face_sizes: vec![3],
            face_vertices: vec![0, 1, 2],
            ..MeshFile::default()
        }
    }

    #[test]
    fn copies_of_vertices_carry_their_data() {
        let mut file = triangle();
        file.uvs = vec![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]];
        file.face_uvs = Some(vec![0, 1, 2]);
        let load = Load::of(&file, Some(&[0, 1, 2, 1]), true);
        assert_eq!(load.columns[0].values, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 3.0, 4.0]);
        assert_eq!(load.dropped, None);
    }

    #[test]
    fn what_is_dropped_is_said_in_one_line() {
        let mut file = triangle();
        file.uvs = vec![[0.0; 2]];
        file.normals = vec![[0.0; 3]];
        file.face_normals = Some(vec![0, NONE, 0]);
        let dropped = Load::of(&file, None, true).dropped.unwrap();
        assert_eq!(
            dropped,
            "dropped the texture coordinates (no face uses them) and the normals (1 of 3 corners have none)"
        );
    }

    #[test]
    fn colours_keep_within_the_range_they_were_in() {
        let mut file = triangle();
        let kind = ColorType::Float;
        file.colors = Some(VertexColors { width: 3, values: vec![0.5; 9], kind });
        assert_eq!(colors(&file, vec![-0.1, 0.5, 1.1]).unwrap().values, [0.0, 0.5, 1.0]);
        file.colors = Some(VertexColors { width: 3, values: vec![2.0; 9], kind });
        assert_eq!(colors(&file, vec![-0.1, 0.5, 2.5]).unwrap().values, [-0.1, 0.5, 2.5]);
    }

    #[test]
    fn normals_get_length_one_at_any_scale() {
        for scale in [1e-200, 1.0, 1e200] {
            let n = unit(&[3.0 * scale, 0.0, -4.0 * scale]);
            assert!((n[0] - 0.6).abs() < 1e-15 && (n[2] + 0.8).abs() < 1e-15, "{n:?}");
        }
        assert_eq!(unit(&[0.0; 3]), [0.0; 3]);
    }
}
