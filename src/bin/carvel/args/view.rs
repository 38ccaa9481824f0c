//! How pictures are drawn.

use crate::exit::{Doing, Failure};
use crate::preview::{self, View, parse_color};
use clap::{Args, ValueEnum};

/// Options of a picture.
#[derive(Debug, Args)]
#[command(next_help_heading = "Picture")]
pub struct ViewArgs {
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1200x900", value_parser = parse_size)]
    size: (u32, u32),
    /// Degrees by which the camera is turned about the up axis.
    #[arg(long, value_name = "DEG", default_value_t = View::default().azimuth,
          allow_negative_numbers = true)]
    azimuth: f32,
    /// Degrees by which the camera stands above the horizon.
    #[arg(long, value_name = "DEG", default_value_t = View::default().elevation,
          allow_negative_numbers = true)]
    elevation: f32,
    /// The background: #rrggbb, #rrggbbaa, white, black, grey or transparent.
    #[arg(long, value_name = "COLOR", default_value = "white",
          value_parser = |text: &str| parse_color(text))]
    background: [u8; 4],
    /// Whether the edges of the polygons are drawn.
    #[arg(long, value_enum, default_value_t, value_name = "EDGES")]
    wireframe: Wireframe,
    /// Normals of the surface, or of the polygons.
    #[arg(long, value_enum, default_value_t, value_name = "NORMALS")]
    shading: Shading,
    /// Reflection lines: so many stripes of light all around, up to 999, which show how smooth
    /// a surface is.
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    stripes: u32,
    /// The axis that points up.
    #[arg(long, value_enum, default_value_t, value_name = "AXIS")]
    up: Up,
}

/// Edges in a picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Wireframe {
    /// Surfaces alone
    #[default]
    None,
    /// Edges over the surface
    Overlay,
    /// Edges alone
    Only,
}

/// Normals in a picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Shading {
    /// The look of a smooth surface
    #[default]
    Smooth,
    /// The look of the polygons
    Flat,
}

/// The axis that points up in a picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Up {
    #[default]
    Y,
    Z,
}

impl ViewArgs {
    /// The view asked for.
    ///
    /// # Errors
    /// A usage error for a value out of range.
    pub fn view(&self) -> Result<View, Failure> {
        let view = View {
            width: self.size.0,
            height: self.size.1,
            azimuth: self.azimuth,
            elevation: self.elevation,
            background: self.background,
            wireframe: match self.wireframe {
                Wireframe::None => preview::Wireframe::None,
                Wireframe::Overlay => preview::Wireframe::Overlay,
                Wireframe::Only => preview::Wireframe::Only,
            },
            shading: match self.shading {
                Shading::Smooth => preview::Shading::Smooth,
                Shading::Flat => preview::Shading::Flat,
            },
            stripes: self.stripes,
            up: match self.up {
                Up::Y => preview::Up::Y,
                Up::Z => preview::Up::Z,
            },
            ..View::default()
        };
        view.check().map_err(|e| Failure::from_error(&e, Doing::Asking))?;
        Ok(view)
    }
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X']);
    let sides = sides.and_then(|(w, h)| Some((w.trim().parse().ok()?, h.trim().parse().ok()?)));
    sides.ok_or_else(|| "a size is width x height in pixels, such as 1200x900".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_numbers() {
        assert_eq!(parse_size("640x480"), Ok((640, 480)));
        for text in ["", "640", "x480", "640x", "640*480", "-1x5", "1x2x3"] {
            assert!(parse_size(text).is_err(), "{text}");
        }
    }
}
