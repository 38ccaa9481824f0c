//! What a picture shows, from where and how.

use carvel::{Error, ErrorKind, Result};

/// The largest width or height of a picture, in pixels.
pub const MAX_SIDE: u32 = 16384;

/// Finer ones would be below the steps in which normals are kept.
const MOST_STRIPES: u32 = 999;

/// Whether and how the polygons' edges are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wireframe {
    /// Surfaces alone.
    #[default]
    None,
    /// Dark edges over the shaded surface.
    Overlay,
    /// Edges alone; those behind a surface are hidden.
    Only,
}

/// Where the normals come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Shading {
    /// Normals averaged at the vertices: the look of a smooth surface.
    #[default]
    Smooth,
    /// One normal per face: the look of the polygons.
    Flat,
}

/// The axis that points up in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Up {
    /// Y up; at azimuth 0 the camera stands on +Z.
    #[default]
    Y,
    /// Z up; at azimuth 0 the camera stands on −Y.
    Z,
}

/// A picture's size, camera and style.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Width in pixels, 1 to 16384.
    pub width: u32,
    /// Height in pixels, 1 to 16384.
    pub height: u32,
    /// Turn of the camera about the up axis in degrees; with Y up it moves from
    /// +Z towards +X.
    pub azimuth: f32,
    /// Height of the camera above the horizon in degrees; 90 looks straight
    /// down.
    pub elevation: f32,
    /// Red, green, blue (sRGB) and opacity of the background.
    pub background: [u8; 4],
    /// Edges.
    pub wireframe: Wireframe,
    /// Normals.
    pub shading: Shading,
    /// Stripes of light around the object whose reflections are drawn, up to 999; 0 for none.
    pub stripes: u32,
    /// Samples per pixel and axis, 1 to 4.
    pub supersample: u32,
    /// The up axis.
    pub up: Up,
}

impl Default for View {
    /// A white 1200×900 picture, three quarters from the side that faces −Z.
    fn default() -> Self {
        Self {
            width: 1200,
            height: 900,
            azimuth: 215.0,
            elevation: 15.0,
            background: [255; 4],
            wireframe: Wireframe::None,
            shading: Shading::Smooth,
            stripes: 0,
            supersample: 3,
            up: Up::Y,
        }
    }
}

impl View {
    /// Refuses sizes, angles and sample counts outside their ranges.
    ///
    /// # Errors
    /// `ParameterOutOfRange`, naming the parameter.
    pub fn check(&self) -> Result<()> {
        let side = 1..=MAX_SIDE;
        if !side.contains(&self.width) || !side.contains(&self.height) {
            return refuse(format!(
                "a picture of {}x{} pixels: each side must be 1 to {MAX_SIDE}",
                self.width, self.height
            ));
        }
        if !(1..=4).contains(&self.supersample) {
            return refuse(format!("supersampling of {}: must be 1 to 4", self.supersample));
        }
        if self.stripes > MOST_STRIPES {
            return refuse(format!("{} stripes: must be 0 to {MOST_STRIPES}", self.stripes));
        }
        for (name, angle) in [("azimuth", self.azimuth), ("elevation", self.elevation)] {
            if !angle.is_finite() {
                return refuse(format!("{name} of {angle}: must be a finite number of degrees"));
            }
        }
        Ok(())
    }
}

fn refuse(message: String) -> Result<()> {
    Err(Error::new(ErrorKind::ParameterOutOfRange, message))
}
