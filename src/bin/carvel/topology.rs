//! The control mesh of an input as options, tags and angles ask for it.

use crate::args::{Chosen, CreaseArgs, Policy};
use crate::exit::Failure;
use crate::faults;
use crate::input::Input;
use crate::refine::positions;
use crate::session::Session;
use crate::tags;
use carvel::mesh::{BuildOptions, Built, build};

/// What the command line asks of a control mesh.
#[derive(Debug, Clone, Copy)]
pub struct Asked<'a> {
    /// It is the result of an earlier run with a boundary.
    pub anchored: bool,
    /// What to do where it is not manifold.
    pub non_manifold: Policy,
    /// Creases besides those of the file.
    pub creases: &'a CreaseArgs,
}

impl Asked<'_> {
    /// The mesh for a scheme, with the creases that it knows.
    pub fn build_for(
        &self,
        session: &Session,
        input: &Input,
        chosen: &Chosen,
    ) -> Result<Built, Failure> {
        let file = &input.file;
        if !chosen.has_features() {
            let options = BuildOptions { anchored: self.anchored, ..Default::default() };
            return self.build(session, input, &options);
        }
        let built = self.build(session, input, &tags::build_options(file, &file.creases))?;
        let Some(degrees) = self.creases.angle() else { return Ok(built) };
        // Angles are known once it is known which faces meet.
        let (points, sharpness) = (positions(file, &built), self.creases.sharpness());
        let creases = tags::with_creases_by_angle(file, &built, &points, degrees, sharpness);
        let creases = creases.map_err(|e| faults::of_work(input, &e))?;
        self.build(session, input, &tags::build_options(file, &creases))
    }

    /// The mesh with some options.
    pub fn build(
        &self,
        session: &Session,
        input: &Input,
        options: &BuildOptions,
    ) -> Result<Built, Failure> {
        let file = &input.file;
        let options = BuildOptions { non_manifold: self.non_manifold.into(), ..*options };
        let (sizes, vertices) = (&file.face_sizes, &file.face_vertices);
        build(&session.context, file.positions.len(), sizes, vertices, &options)
            .map_err(|defects| faults::failure(input, &defects))
    }
}
