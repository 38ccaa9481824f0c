//! Creases that are asked for on the command line.

use crate::exit::Failure;
use clap::Args;

/// Options about creases.
#[derive(Debug, Args)]
#[command(next_help_heading = "Creases, for catmull-clark, loop and bilinear")]
pub struct CreaseArgs {
    /// Make creases of the edges whose faces' normals differ by more than so many
    /// degrees, besides those of the file, which keep their sharpness. What refining
    /// leaves of creases is written to OBJ; infinite ones stay so.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    crease_angle: Option<f64>,
    /// The sharpness of creases by angle: each level takes 1 off; 10 and more is
    /// infinite [default: 10].
    #[arg(long, value_name = "S", allow_negative_numbers = true, requires = "crease_angle")]
    crease_sharpness: Option<f32>,
}

impl CreaseArgs {
    /// The angle in degrees, if creases are wanted.
    pub fn angle(&self) -> Option<f64> {
        self.crease_angle
    }

    /// The sharpness of those creases.
    pub fn sharpness(&self) -> f32 {
        self.crease_sharpness.unwrap_or(10.0)
    }

    /// Refuses values that make no sense.
    ///
    /// # Errors
    /// A usage error.
    pub fn check(&self) -> Result<(), Failure> {
        let degrees = self.crease_angle.unwrap_or_default();
        if !(0.0..=180.0).contains(&degrees) {
            let message = format!("--crease-angle {degrees}: degrees from 0 to 180 make sense");
            return Err(Failure::usage(message));
        }
        let sharpness = self.sharpness();
        if sharpness >= 0.0 {
            return Ok(());
        }
        Err(Failure::usage(format!("--crease-sharpness {sharpness} is not a number from 0 up")))
    }
}
