//! Creases where a control mesh bends, found from its positions.
//!
//! A face's normal is Newell's: for the vertices pᵢ the sum of (pᵢ − p₀) × (pᵢ₊₁ − p₀),
//! which is twice the vector of the area and defined for faces that are not plane. Not for
//! meshes whose faces are turned against one another: those have no two faces at an edge.

use super::values;
use crate::base::{Context, Crease, Error, ErrorKind, NONE, Result, Scalar, memory};
use crate::mesh::Mesh;

/// Creases on the edges whose two faces' normals differ by more than an angle.
///
/// Costs one normal for each face. Faces without area have no normal and make no crease;
/// neither does the boundary, which is sharp in any case.
///
/// # Errors
/// [`ErrorKind::ParameterOutOfRange`] unless `degrees` is within 0 and 180 and `sharpness`
/// not negative, [`ErrorKind::LengthMismatch`] unless there are 3 values per vertex,
/// [`ErrorKind::NotFinite`], [`ErrorKind::OutOfResources`].
///
/// # Example
/// ```
/// use carvel::{Mesh, hierarchy::creases_by_angle};
/// let cube = Mesh::from_polygons(8, &[4; 6], &[
///     0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3,
/// ])?;
/// let positions: Vec<f64> =
///     (0..8).flat_map(|v| [v & 1, v >> 1 & 1, v >> 2].map(f64::from)).collect();
/// assert_eq!(creases_by_angle(&cube, &positions, 80.0, 2.0)?.len(), 12);
/// # Ok::<(), carvel::Error>(())
/// ```
pub fn creases_by_angle<T: Scalar>(
    mesh: &Mesh,
    positions: &[T],
    degrees: f64,
    sharpness: f32,
) -> Result<Vec<Crease>> {
    check_parameters(degrees, sharpness)?;
    values::check(&Context::serial(), "positions", positions, 3, mesh.vertices())?;
    let faces = 0..mesh.faces() as u32;
    let normals = memory::collect(faces.map(|face| newell(mesh, positions, face)))?;
    let normal = |corner: u32| normals[mesh.layout.face_of(corner) as usize];
    let inner = (0..mesh.layout.corners()).filter(|&c| mesh.twin[c as usize] != NONE);
    let bent = inner.filter(|&c| {
        let twin = mesh.twin[c as usize];
        c < twin && angle(normal(c), normal(twin)) > degrees
    });
    memory::collect(bent.map(|c| {
        let vertices = [mesh.vert[c as usize], mesh.vert[mesh.next(c) as usize]];
        Crease { vertices, sharpness }
    }))
}

fn check_parameters(degrees: f64, sharpness: f32) -> Result<()> {
    let message = if !(0.0..=180.0).contains(&degrees) {
        format!("a crease angle of {degrees} degrees: 0 to 180 make sense")
    } else if sharpness >= 0.0 {
        return Ok(());
    } else {
        format!("sharpness {sharpness:?} is not a number from 0 up")
    };
    Err(Error::new(ErrorKind::ParameterOutOfRange, message))
}

/// The normal of a face, scaled so that its largest edge or diagonal is about 1: numbers
/// of any size have squares then.
fn newell<T: Scalar>(mesh: &Mesh, positions: &[T], face: u32) -> [f64; 3] {
    let vertices = mesh.layout.face(face).map(|c| mesh.vert[c as usize]);
    let point = |v: u32| {
        let at = 3 * v as usize;
        [at, at + 1, at + 2].map(|i| positions[i].to_f64())
    };
    let first = point(mesh.vert[mesh.layout.face(face).start as usize]);
    // Halved first: a difference of finite numbers may be infinite.
    let arm = |v: u32| {
        let p = point(v);
        [0, 1, 2].map(|k| 0.5 * p[k] - 0.5 * first[k])
    };
    let longest = |m: f64, v: u32| arm(v).iter().fold(m, |m, x| m.max(x.abs()));
    let size = vertices.clone().fold(0.0, longest);
    if size <= 0.0 {
        return [0.0; 3];
    }
    let arms = vertices.map(|v| arm(v).map(|x| x / size));
    let mut sum = [0.0; 3];
    arms.reduce(|a, b| {
        let area = cross(a, b);
        sum = [0, 1, 2].map(|k| sum[k] + area[k]);
        b
    });
    sum
}

/// The angle between two vectors in degrees; 0 if one has no direction.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let sine = cross(a, b).iter().map(|x| x * x).sum::<f64>().sqrt();
    let cosine = a.iter().zip(b).map(|(x, y)| x * y).sum();
    libm::atan2(sine, cosine).to_degrees()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: [u32; 24] =
        [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3];

    fn cube() -> Mesh {
        Mesh::from_polygons(8, &[4; 6], &CUBE).unwrap()
    }

    fn corners(scale: f64) -> Vec<f64> {
        (0..8).flat_map(|v| [v & 1, v >> 1 & 1, v >> 2].map(|x| scale * f64::from(x))).collect()
    }

    fn found(mesh: &Mesh, positions: &[f64], degrees: f64) -> usize {
        creases_by_angle(mesh, positions, degrees, 2.0).unwrap().len()
    }

    #[test]
    fn a_cube_bends_by_a_right_angle_at_any_scale() {
        for scale in [1e-300, 1e-3, 1.0, 1e150, 1e308] {
            for (degrees, creases) in [(0.0, 12), (80.0, 12), (89.999, 12), (90.001, 0), (91.0, 0)]
            {
                assert_eq!(found(&cube(), &corners(scale), degrees), creases, "{scale} {degrees}");
            }
        }
        let single: Vec<f32> = corners(1.0).iter().map(|&x| x as f32).collect();
        let creases = creases_by_angle(&cube(), &single, 80.0, 2.5).unwrap();
        assert_eq!(creases.len(), 12);
        assert!(creases.iter().all(|crease| crease.sharpness.to_bits() == 2.5_f32.to_bits()));
    }

    #[test]
    fn the_corners_of_large_faces_count_as_one_face() {
        // A hexagonal prism: 60 degrees between its sides, 90 at its ends.
        let ring = |z: f64| {
            (0..6).flat_map(move |i| {
                let turn = f64::from(i) * std::f64::consts::FRAC_PI_3;
                [turn.cos(), turn.sin(), z]
            })
        };
        let positions: Vec<f64> = ring(0.0).chain(ring(1.0)).collect();
        let mut faces: Vec<u32> = vec![5, 4, 3, 2, 1, 0, 6, 7, 8, 9, 10, 11];
        faces.extend((0..6).flat_map(|i| [i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6]));
        let prism = Mesh::from_polygons(12, &[6, 6, 4, 4, 4, 4, 4, 4], &faces).unwrap();
        assert_eq!(found(&prism, &positions, 59.0), 18);
        assert_eq!(found(&prism, &positions, 61.0), 12);
        assert_eq!(found(&prism, &positions, 91.0), 0);
    }

    #[test]
    fn boundaries_and_faces_without_area_make_none() {
        let strip = Mesh::from_polygons(6, &[4, 4], &[0, 1, 4, 3, 1, 2, 5, 4]).unwrap();
        let mut positions =
            vec![0., 0., 0., 1., 0., 0., 1., 0., 1., 0., 1., 0., 1., 1., 0., 1., 1., 1.];
        let creases = creases_by_angle(&strip, &positions, 45.0, 1.0).unwrap();
        assert_eq!(creases.len(), 1);
        assert_eq!(creases[0].vertices, [1, 4]);
        // The second quad shrinks to the common edge.
        positions[6..9].copy_from_slice(&[1., 0., 0.]);
        positions[15..18].copy_from_slice(&[1., 1., 0.]);
        assert_eq!(found(&strip, &positions, 0.0), 0);
    }

    #[test]
    fn what_is_no_number_is_refused() {
        let kind = |positions: &[f64], degrees, sharpness| {
            creases_by_angle(&cube(), positions, degrees, sharpness).unwrap_err().kind()
        };
        let good = corners(1.0);
        for degrees in [f64::NAN, -1.0, 181.0, f64::INFINITY] {
            assert_eq!(kind(&good, degrees, 1.0), ErrorKind::ParameterOutOfRange);
        }
        for sharpness in [f32::NAN, -0.5] {
            assert_eq!(kind(&good, 30.0, sharpness), ErrorKind::ParameterOutOfRange);
        }
        assert_eq!(kind(&good[3..], 30.0, 1.0), ErrorKind::LengthMismatch);
        let mut bad = good;
        bad[4] = f64::NAN;
        assert_eq!(kind(&bad, 30.0, 1.0), ErrorKind::NotFinite);
    }
}
