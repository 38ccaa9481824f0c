//! A mesh as the camera sees it: projected vertices, normals, faces to fill.

use super::camera::{Camera, Point};
use super::polygons::Checked;
use super::raster::{Band, Corner};
use super::triangulate::{Triangulator, centroid};
use super::view::Shading;
use glam::Vec3;

/// Everything that is the same for every band.
pub struct Scene<'a> {
    mesh: &'a Checked<'a>,
    /// Vertices in view coordinates and on the screen.
    places: Vec<Vec3>,
    points: Vec<Point>,
    /// Vertex normals, not scaled to length 1; `None` for flat shading.
    normals: Option<Vec<Vec3>>,
    camera: &'a Camera,
}

impl<'a> Scene<'a> {
    /// Projects a mesh and finds its vertex normals.
    pub fn new(mesh: &'a Checked<'a>, camera: &'a Camera, shading: Shading) -> Self {
        let places: Vec<Vec3> = mesh.positions().iter().map(|&p| camera.to_view(p)).collect();
        let points = places.iter().map(|&p| camera.project(p)).collect();
        let normals = (shading == Shading::Smooth).then(|| vertex_normals(mesh, &places));
        Self { mesh, places, points, normals, camera }
    }

    /// The faces of three vertices and more.
    pub fn faces(&self) -> impl Iterator<Item = &'a [u32]> + use<'a> {
        self.mesh.faces()
    }

    /// A vertex on the screen.
    pub fn point(&self, vertex: u32) -> Point {
        self.points[vertex as usize]
    }

    /// The unit normal of a face, facing the viewer if it has none.
    pub fn face_normal(&self, face: &[u32]) -> Vec3 {
        area_vector(face, &self.places).try_normalize().unwrap_or(Vec3::Z)
    }

    /// Draws all faces into a band.
    pub fn fill(&self, band: &mut Band) {
        let mut filler = Filler::default();
        for face in self.faces() {
            if band.touches(face.iter().map(|&v| self.point(v))) {
                filler.fill(self, face, band);
            }
        }
    }

    /// The normal at a corner of a face: the vertex's, unless it has none,
    /// turned to the side on which the face is counter-clockwise.
    fn corner_normal(&self, vertex: u32, face_normal: Vec3) -> Vec3 {
        let smooth = self.normals.as_ref().and_then(|n| n[vertex as usize].try_normalize());
        match smooth {
            Some(normal) if normal.dot(face_normal) < 0.0 => -normal,
            Some(normal) => normal,
            None => face_normal,
        }
    }
}

/// Room to take a face apart.
#[derive(Default)]
struct Filler {
    places: Vec<Vec3>,
    corners: Vec<Corner>,
    triangulator: Triangulator,
}

impl Filler {
    fn fill(&mut self, scene: &Scene<'_>, face: &[u32], band: &mut Band) {
        let normal = scene.face_normal(face);
        self.places.clear();
        self.places.extend(face.iter().map(|&v| scene.places[v as usize]));
        self.corners.clear();
        self.corners.extend(
            face.iter()
                .map(|&v| Corner { point: scene.point(v), normal: scene.corner_normal(v, normal) }),
        );
        if face.len() > 4 {
            self.add_centroid(scene.camera, normal);
        }
        for triangle in self.triangulator.cut(&self.places, normal) {
            band.triangle(triangle.map(|k| self.corners[k]));
        }
    }

    fn add_centroid(&mut self, camera: &Camera, face_normal: Vec3) {
        let sum = self.corners.iter().map(|c| c.normal).sum::<Vec3>();
        let normal = sum.try_normalize().unwrap_or(face_normal);
        let point = camera.project(centroid(&self.places));
        self.corners.push(Corner { point, normal });
    }
}

/// Normals at the vertices: sums of the faces' area vectors.
fn vertex_normals(mesh: &Checked<'_>, places: &[Vec3]) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; places.len()];
    for face in mesh.faces() {
        let area = area_vector(face, places);
        for &v in face {
            normals[v as usize] += area;
        }
    }
    normals
}

/// The normal of a face, as long as twice its area, by Newell's sum relative to
/// its first vertex.
fn area_vector(face: &[u32], places: &[Vec3]) -> Vec3 {
    let place = |v: u32| places[v as usize];
    if let &[a, b, c, d] = face {
        return (place(c) - place(a)).cross(place(d) - place(b));
    }
    let origin = place(face[0]);
    let spokes = face[1..].windows(2);
    spokes.map(|e| (place(e[0]) - origin).cross(place(e[1]) - origin)).sum()
}
