//! Pictures: the command `preview`, and `subdivide --preview`.

use crate::args::PreviewArgs;
use crate::exit::{Doing, Exit, Failure};
use crate::input::Input;
use crate::places::check_picture;
use crate::preview::{self, Image, Polygons, View};
use crate::session::Session;
use crate::{atomic, text};
use carvel::Result;
use carvel::io::MeshFile;
use std::path::Path;

/// Draws all inputs side by side.
pub fn run(args: &PreviewArgs) -> Result<Exit, Failure> {
    let view = args.view.view()?;
    check_picture(&args.output)?;
    let session = Session::new(1, None, args.quiet)?;
    let inputs = args.inputs.iter().map(|path| read(&session, path, args));
    let inputs = inputs.collect::<Result<Vec<_>, _>>()?;
    session.console.phase("drawing", &text::path_name(&args.output));
    let meshes: Vec<_> = inputs.iter().map(|input| polygons(&input.file)).collect();
    let png = draw(&meshes, &view).map_err(|e| Failure::from_error(&e, Doing::Working))?;
    session.refuse_if_cancelled()?;
    save(&session, &args.output, &png)?;
    session.console.clear();
    Ok(Exit::Success)
}

fn read(session: &Session, path: &Path, args: &PreviewArgs) -> Result<Input, Failure> {
    let input = Input::read(session, path, args.input_format)?;
    input.require_faces()?;
    for note in &input.file.notes {
        session.console.note(&format!("{}: {note}", input.name));
    }
    Ok(input)
}

/// Draws one mesh.
pub fn draw_file(file: &MeshFile, view: &View) -> Result<Vec<u8>> {
    preview::render(&file.positions, &file.face_sizes, &file.face_vertices, view)?.encode_png()
}

/// Writes a picture.
pub fn save(session: &Session, path: &Path, png: &[u8]) -> Result<(), Failure> {
    let written = session.on_path(path, || atomic::write(path, png));
    written.map_err(|e| Failure::from_error(&e, Doing::Writing))
}

fn draw(meshes: &[Polygons], view: &View) -> Result<Vec<u8>> {
    let images = preview::render_alike(meshes, view)?;
    Image::beside(&images, 0, view.background)?.encode_png()
}

fn polygons(file: &MeshFile) -> Polygons<'_> {
    Polygons {
        positions: &file.positions,
        face_sizes: &file.face_sizes,
        face_vertices: &file.face_vertices,
    }
}
