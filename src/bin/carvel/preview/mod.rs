//! Pictures of meshes: a small software renderer for `carvel preview`.
//!
//! A z-buffered rasteriser with supersampling, made for one job: showing a
//! control mesh or a refined surface on any machine, without a GPU. It draws
//! polygons as they are (edges of the wireframe are the polygons' own, never
//! those of a triangulation), shades both sides and tints the back so that
//! flipped faces are seen. It has no shadows, textures or transparency of
//! surfaces; for those, write the mesh to a file and use a real renderer.
//!
//! Cost: one pass over vertices and faces plus the samples covered, on the
//! calling thread. Samples are kept for a band of rows at a time, so memory is
//! about 40 bytes per vertex, 4 per pixel of the result and 50 MB. The same
//! input gives the same bytes on every run: trigonometry and powers come from
//! `libm`, coverage is decided in integers.

// Pixels, samples and fixed-point coordinates are bounded by `MAX_SIDE` before
// any of them is computed; conversions between their types cannot go wrong.

mod camera;
mod color;
mod image;
mod lines;
mod material;
mod polygons;
mod raster;
mod resolve;
mod scene;
#[cfg(test)]
mod tests;
mod triangulate;
mod view;

pub use color::parse_color;
pub use image::Image;
pub use polygons::Polygons;
pub use view::{Shading, Up, View, Wireframe};

use camera::Camera;
use carvel::Result;
use polygons::Checked;
use raster::{BAND_SAMPLES, Band};
use resolve::Resolver;
use scene::Scene;

/// Draws a polygon mesh so that it fills the picture.
///
/// Face `i` has `face_sizes[i]` vertices, listed one face after the other in
/// `face_vertices`, counter-clockwise seen from outside. Vertices that no face
/// uses are ignored; faces of fewer than three vertices, and faces collapsed to
/// a line or a point, leave nothing to fill and are no error.
///
/// # Errors
/// `ParameterOutOfRange` for a [`View`] outside its ranges, `LengthMismatch`,
/// `IndexOutOfRange` or `NotFinite` for a mesh that is not one, and
/// `OutOfResources` if there is no memory for the picture.
pub fn render(
    positions: &[[f64; 3]],
    face_sizes: &[u32],
    face_vertices: &[u32],
    view: &View,
) -> Result<Image> {
    let polygons = Polygons { positions, face_sizes, face_vertices };
    let checked = polygons.check()?;
    let camera = Camera::fit(std::slice::from_ref(&checked), view)?;
    draw(&checked, &camera, view, BAND_SAMPLES)
}

/// Draws several meshes, each in its own picture, all with one camera.
///
/// The camera is fitted to all meshes together: sizes and positions can be
/// compared across the pictures, as when one control mesh is refined by
/// several schemes.
///
/// # Errors
/// As for [`render`].
pub fn render_alike(meshes: &[Polygons<'_>], view: &View) -> Result<Vec<Image>> {
    let checked = meshes.iter().map(Polygons::check).collect::<Result<Vec<_>>>()?;
    let camera = Camera::fit(&checked, view)?;
    checked.iter().map(|mesh| draw(mesh, &camera, view, BAND_SAMPLES)).collect()
}

/// By rows, the matrix from (x, y, z, 1) to clip coordinates of the camera with which [`render`]
/// draws a mesh: x to the right, y upwards, from −w to w across the picture, and z always 0.
///
/// # Errors
/// As for [`render`].
pub fn matrix(
    positions: &[[f64; 3]],
    face_sizes: &[u32],
    face_vertices: &[u32],
    view: &View,
) -> Result<[[f64; 4]; 4]> {
    let polygons = Polygons { positions, face_sizes, face_vertices };
    Ok(Camera::fit(&[polygons.check()?], view)?.matrix(view))
}

/// Draws a checked mesh in bands of about so many samples.
fn draw(mesh: &Checked<'_>, camera: &Camera, view: &View, band_samples: usize) -> Result<Image> {
    let scene = Scene::new(mesh, camera, view.shading);
    let mut image = Image::blank(view.width, view.height, view.background)?;
    let mut band = Band::new(view, band_samples)?;
    let resolver = Resolver::new(view, camera.sky());
    let mut top = 0;
    while top < view.height {
        let rows = band.start(top);
        scene.fill(&mut band);
        if view.wireframe != Wireframe::None {
            lines::draw(&scene, camera, view, &mut band);
        }
        resolver.resolve(&band, top, rows, &mut image);
        top += rows;
    }
    Ok(image)
}
