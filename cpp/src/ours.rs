//! carvel on the same control meshes.

use crate::lineage::Ours;
use crate::opensubdiv::Values;
use crate::{
    Boundary, Control, Creasing, FaceVarying, PeerMesh, Place, Precision, Result, Scheme, Task,
    Triangles,
};
use carvel::base::Scalar;
use carvel::limit::{Limits, Sample, Surface};
use carvel::mesh::{BuildOptions, Channel, FaceVaryingMode, NonManifold, build};
use carvel::scheme::TriangleRule;
use carvel::{Attribute, Context, Error, Hierarchy, Mesh, Records, RecordsMut, Refined, Refiner};
use std::sync::Arc;

/// What carvel gave back, in its own numbering.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The last level.
    pub mesh: PeerMesh,
    /// True for its faces that are holes.
    pub holes: Vec<bool>,
    /// Values refined with it.
    pub values: Vec<f64>,
    /// The face-varying channels of the task.
    pub channels: Vec<Varied>,
}

/// A refined face-varying channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Varied {
    /// One index per corner of the last level.
    pub indices: Vec<u32>,
    /// The values, record after record.
    pub values: Vec<f64>,
}

/// carvel's scheme for a task; `None` where carvel does not have it.
pub fn scheme(task: &Task) -> Option<carvel::Scheme> {
    let ours = match task.scheme {
        Scheme::CatmullClark => carvel::Scheme::catmull_clark(),
        Scheme::Loop => carvel::Scheme::loop_triangles(),
        Scheme::Bilinear => carvel::Scheme::bilinear(),
        Scheme::DooSabin => carvel::Scheme::doo_sabin(),
        Scheme::Sqrt3 | Scheme::ModifiedButterfly | Scheme::LabsikGreiner => return None,
    };
    let ours = ours.with_boundary(match task.options.boundary {
        Boundary::None => carvel::Boundary::None,
        Boundary::Edge => carvel::Boundary::Edge,
        Boundary::EdgeAndCorner => carvel::Boundary::EdgeAndCorner,
    });
    let ours = ours.with_creasing(match task.options.creasing {
        Creasing::Uniform => carvel::scheme::Creasing::Uniform,
        Creasing::Chaikin => carvel::scheme::Creasing::Chaikin,
    });
    Some(ours.with_triangle_rule(match task.options.triangles {
        Triangles::CatmullClark => TriangleRule::CatmullClark,
        Triangles::Smooth => TriangleRule::Smooth,
    }))
}

/// carvel's mesh of a soup with its tags. What is no manifold is made sharp, as
/// OpenSubdiv does without being asked.
///
/// # Errors
/// What carvel does not take.
pub fn mesh(control: &Control) -> Result<Mesh> {
    let crease =
        |it: &crate::Crease| carvel::Crease { vertices: it.vertices, sharpness: it.sharpness };
    let sharp = |it: &crate::SharpVertex| carvel::SharpVertex {
        vertex: it.vertex,
        sharpness: it.sharpness,
    };
    let (creases, sharp_vertices): (Vec<_>, Vec<_>) = (
        control.creases.iter().map(crease).collect(),
        control.sharp_vertices.iter().map(sharp).collect(),
    );
    let options = BuildOptions {
        non_manifold: NonManifold::Sharpen,
        creases: &creases,
        sharp_vertices: &sharp_vertices,
        holes: &control.holes,
        ..BuildOptions::default()
    };
    let (sizes, indices) = (&control.sizes, &control.indices);
    build(&Context::serial(), control.vertices(), sizes, indices, &options)
        .map(|built| built.mesh)
        .map_err(|defects| Error::from(defects).to_string())
}

/// carvel's channels of a task, each with its values in the precision asked for.
fn channels<T: Scalar>(task: &Task, mesh: &Mesh) -> Result<Vec<(Channel, Vec<T>, usize)>> {
    let mode = match task.options.face_varying {
        FaceVarying::Smooth => FaceVaryingMode::Smooth,
        FaceVarying::CornersOnly => FaceVaryingMode::Corners,
        FaceVarying::CornersPlus1 => FaceVaryingMode::CornersPlus1,
        FaceVarying::CornersPlus2 => FaceVaryingMode::CornersPlus2,
        FaceVarying::Boundaries => FaceVaryingMode::Boundaries,
        FaceVarying::All => FaceVaryingMode::All,
    };
    let channel = |it: &crate::Channel| {
        let channel = Channel::new(mesh, &it.indices, it.values.len() / it.width, mode);
        let values = it.values.iter().map(|&x| T::from_f64(x)).collect();
        channel.map(|channel| (channel, values, it.width)).map_err(one_line)
    };
    task.control.channels.iter().map(channel).collect()
}

/// The control mesh in carvel's order of faces, and the caller's face for each.
///
/// # Errors
/// What carvel does not take.
pub fn control(control: &Control) -> Result<(Ours, Vec<u32>)> {
    let mesh = mesh(control)?;
    let (sizes, indices) = (mesh.face_sizes().collect(), mesh.corner_vertices().to_vec());
    let sources = (0..mesh.faces()).map(|face| mesh.face_source(face) as u32).collect();
    Ok((Ours::control(mesh.vertices(), sizes, indices), sources))
}

/// carvel's answer to a task.
///
/// # Errors
/// What carvel does not take or does not have.
pub fn refine(task: &Task, levels: u32) -> Result<Answer> {
    carry(task, levels, Values::Vertex, &[], 1)
}

/// carvel's answer to a task, with values of any width on vertices.
///
/// # Errors
/// As [`refine`].
pub fn carry(
    task: &Task,
    levels: u32,
    kind: Values,
    values: &[f64],
    width: usize,
) -> Result<Answer> {
    let positions = &task.control.positions;
    let given = Given { task, levels, kind, width };
    match task.precision {
        Precision::Single => given.run(&singles(positions), &singles(values)),
        Precision::Double => given.run(positions, values),
    }
}

fn singles(values: &[f64]) -> Vec<f32> {
    values.iter().map(|&x| x as f32).collect()
}

fn doubles<T: Scalar>(values: &[T]) -> Vec<f64> {
    values.iter().map(|x| x.to_f64()).collect()
}

struct Given<'a> {
    task: &'a Task<'a>,
    levels: u32,
    kind: Values,
    width: usize,
}

impl Given<'_> {
    fn run<T: Scalar>(&self, positions: &[T], values: &[T]) -> Result<Answer> {
        let ours = scheme(self.task);
        let ours = ours.ok_or_else(|| format!("carvel lacks {}", self.task.scheme.name()))?;
        let mesh = mesh(self.task.control)?;
        let attributes: Vec<_> = match (values, self.kind) {
            ([], _) => Vec::new(),
            (_, Values::Varying) => vec![Attribute::varying(values, self.width)],
            _ => vec![Attribute::vertex(values, self.width)],
        };
        let channels = channels::<T>(self.task, &mesh)?;
        let channels: Vec<_> = channels
            .iter()
            .map(|(channel, values, width)| carvel::hierarchy::FaceVarying {
                channel,
                values,
                width: *width,
            })
            .collect();
        let mut task = carvel::Task::new(&mesh, &ours, self.levels, positions);
        task.attributes = &attributes;
        task.channels = &channels;
        task.face_sources = true;
        let refined = Refiner::new().refine(&Context::serial(), &task).map_err(one_line)?;
        let holes = ours.holes(&mesh).map_err(one_line)?;
        Ok(answer(&refined, &holes))
    }
}

/// carvel's surface of a task, and the face of its mesh for each of the caller's.
///
/// # Errors
/// What carvel does not take or does not have.
pub fn surface(task: &Task) -> Result<(Surface, Vec<u32>)> {
    let scheme = scheme(task).ok_or_else(|| format!("carvel lacks {}", task.scheme.name()))?;
    let mesh = Arc::new(mesh(task.control)?);
    let mut faces = vec![0; mesh.faces()];
    (0..mesh.faces()).for_each(|face| faces[mesh.face_source(face)] = face as u32);
    let surface = Surface::new(&Context::serial(), &mesh, &scheme).map_err(one_line)?;
    Ok((surface, faces))
}

/// Places as carvel takes them.
pub fn samples(faces: &[u32], places: &[Place]) -> Vec<Sample> {
    let sample = |place: &Place| {
        let &Place { face, sector, uv: [u, v] } = place;
        Sample { face: faces[face as usize], sector, u, v }
    };
    places.iter().map(sample).collect()
}

/// Limits of a level's vertices in double precision, in carvel's numbering.
pub struct VertexLimits {
    /// xyz each.
    pub points: Vec<f64>,
    /// xyz each, of length 1.
    pub normals: Vec<f64>,
    /// Whether there are tangents.
    pub planes: Vec<bool>,
}

/// The limits of a level's vertices.
///
/// # Errors
/// What carvel does not take or does not have.
pub fn limits(task: &Task, level: u32) -> Result<VertexLimits> {
    let scheme = scheme(task).ok_or_else(|| format!("carvel lacks {}", task.scheme.name()))?;
    let context = Context::serial();
    let hierarchy = Hierarchy::new(&context, mesh(task.control)?, scheme.clone(), level);
    let hierarchy = hierarchy.map_err(one_line)?;
    let mesh = hierarchy.shared_mesh(level).map_err(one_line)?;
    let mut refined = vec![0.0; 3 * mesh.vertices()];
    hierarchy
        .refine(&context, level, &task.control.positions, 3, &mut refined)
        .map_err(one_line)?;
    let limits = Limits::<f64>::new(&context, &mesh, &scheme).map_err(one_line)?;
    let [mut points, mut normals] = [(); 2].map(|()| vec![0.0; refined.len()]);
    let (values, out) = (Records::packed(&refined, 3), RecordsMut::packed(&mut points, 3));
    limits.position().apply(&context, values, out).map_err(one_line)?;
    limits.normals(&context, &refined, &mut normals).map_err(one_line)?;
    let plane = |v: usize| limits.tangents().iter().all(|table| !table.row(v).0.is_empty());
    let planes = (0..mesh.vertices()).map(plane).collect();
    Ok(VertexLimits { points, normals, planes })
}

#[expect(clippy::needless_pass_by_value, reason = "map_err gives it away")]
fn one_line(error: Error) -> String {
    error.to_string()
}

fn answer<T: Scalar>(refined: &Refined<T>, holes: &[u32]) -> Answer {
    let is_hole = |source: &u32| holes.binary_search(source).is_ok();
    Answer {
        mesh: PeerMesh {
            sizes: refined.face_sizes.clone(),
            indices: refined.face_vertices.clone(),
            positions: doubles(&refined.positions),
        },
        holes: refined.face_sources.iter().map(is_hole).collect(),
        channels: refined
            .channels
            .iter()
            .map(|it| Varied { indices: it.indices.clone(), values: doubles(&it.values) })
            .collect(),
        values: refined.attributes.first().map(|it| doubles(it)).unwrap_or_default(),
    }
}
