//! carvel on the same control meshes.

use crate::lineage::Ours;
use crate::{Boundary, Control, PeerMesh, Precision, Result, Scheme};
use carvel::{Context, Mesh, Refiner, Task};

/// carvel's scheme for a peer's; `None` for those that carvel does not have.
pub fn scheme(scheme: Scheme, boundary: Boundary) -> Option<carvel::Scheme> {
    let ours = match scheme {
        Scheme::DooSabin => carvel::Scheme::doo_sabin(),
        _ => return None,
    };
    Some(ours.with_boundary(match boundary {
        Boundary::None => carvel::Boundary::None,
        Boundary::Edge => carvel::Boundary::Edge,
        Boundary::EdgeAndCorner => carvel::Boundary::EdgeAndCorner,
    }))
}

/// carvel's mesh of a soup without tags.
///
/// # Errors
/// What carvel does not take.
pub fn mesh(control: &Control) -> Result<Mesh> {
    Mesh::from_polygons(control.vertices(), &control.sizes, &control.indices)
        .map_err(|error| error.to_string())
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

/// carvel's answer to a task without tags, in its own numbering.
///
/// # Errors
/// What carvel does not take or does not have.
pub fn refine(
    control: &Control,
    scheme: Scheme,
    boundary: Boundary,
    precision: Precision,
    levels: u32,
) -> Result<PeerMesh> {
    let ours = self::scheme(scheme, boundary);
    let ours = ours.ok_or_else(|| format!("carvel does not have {}", scheme.name()))?;
    let mesh = mesh(control)?;
    match precision {
        Precision::Single => {
            let positions: Vec<f32> = control.positions.iter().map(|&x| x as f32).collect();
            run(&Task::new(&mesh, &ours, levels, &positions))
        }
        Precision::Double => run(&Task::new(&mesh, &ours, levels, &control.positions)),
    }
}

fn run<T: carvel::base::Scalar>(task: &Task<T>) -> Result<PeerMesh> {
    let refined = Refiner::new().refine(&Context::serial(), task).map_err(|e| e.to_string())?;
    Ok(PeerMesh {
        sizes: refined.face_sizes,
        indices: refined.face_vertices,
        positions: refined.positions.iter().map(|x| x.to_f64()).collect(),
    })
}
