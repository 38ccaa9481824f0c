//! The command `tessellate`.

use crate::args::{Chosen, TessellateArgs};
use crate::carry::{self, Load};
use crate::exit::{Doing, Exit, Failure};
use crate::faults;
use crate::input::{Input, ends_the_run};
use crate::memory;
use crate::picture;
use crate::places::{self, Job, Wish};
use crate::preview::{self, View};
use crate::refine::positions;
use crate::report::{self, Seconds};
use crate::session::Session;
use crate::subdivide::{create, not_manifold, timed};
use crate::tags;
use crate::text::{counted, grouped, path_name};
use crate::texture::Texture;
use crate::topology::Asked;
use carvel::base::Context;
use carvel::io::{self, MeshFile, WriteOptions};
use carvel::limit::{
    Derivatives, Fineness, Sample, Screen, Surface, TessellateOptions, Tessellation, tessellate,
};
use carvel::mesh::Built;
use carvel::scheme::SplitKind;
use carvel::{Boundary, ErrorKind, Result as KernelResult};
use serde_json::{Map, Value, json};
use std::time::Instant;

/// How fine the triangles are that a camera is fitted to, as a part of the bounding box.
const ROUGH: f64 = 0.01;
/// Halvings for that at most.
const ROUGH_LEVELS: u32 = 4;

/// Cuts the surfaces of all inputs into triangles.
pub fn run(args: &TessellateArgs) -> Result<Exit, Failure> {
    args.check()?;
    let view = args.view.view()?;
    let jobs = places::plan(&Wish {
        inputs: &args.inputs,
        output: &args.output,
        format: args.files.format,
        picture: args.preview.as_deref(),
    })?;
    let quiet = args.quiet || args.json && places::is_stream(&args.output);
    let session = Session::new(args.threads, args.memory, quiet)?;
    Run { args, view: &view, session: &session }.all(&jobs)
}

/// A run over several inputs.
struct Run<'a> {
    args: &'a TessellateArgs,
    view: &'a View,
    session: &'a Session,
}

/// What became of an input.
struct Done {
    chosen: Chosen,
    faces: u64,
    vertices: u64,
    triangles: u64,
    /// The tolerance in the file's units, or in pixels.
    limit: f64,
    measure: f64,
    coarse: u64,
    missing: u64,
    seconds: Seconds,
    notes: Vec<String>,
}

impl Run<'_> {
    fn all(&self, jobs: &[Job]) -> Result<Exit, Failure> {
        let mut exit = Exit::Success;
        let mut reports = Vec::new();
        for job in jobs {
            let result = self.one(job);
            reports.push(self.report(job, &result));
            if let Err(failure) = &result {
                let code = self.session.console.failure(failure);
                exit = if exit == Exit::Success { code } else { exit };
                if ends_the_run(failure) {
                    break;
                }
            }
        }
        self.session.console.clear();
        if self.args.json {
            report::print_all(self.session, jobs, reports)?;
        }
        Ok(exit)
    }

    fn one(&self, job: &Job) -> Result<Done, Failure> {
        let start = Instant::now();
        let mut seconds = Seconds::default();
        let mut input = timed(&mut seconds.read, || {
            Input::read(self.session, &job.input, self.args.files.input_format)
        })?;
        input.require_faces()?;
        // Those of the surface take their place.
        (input.file.normals, input.file.face_normals) = (Vec::new(), None);
        let of_work = |e: carvel::Error| faults::of_work(&input, &e);
        let chosen = self.args.scheme.choose(input.file.scheme)?;
        self.session.console.phase("building", &input.name);
        let asked = Asked {
            anchored: false,
            non_manifold: self.args.non_manifold,
            creases: &self.args.creases,
        };
        let built = timed(&mut seconds.build, || asked.build_for(self.session, &input, &chosen))?;
        self.session.console.phase("tessellating", &input.name);
        let context = &self.session.context;
        let work = Work { control: &input.file, built: &built, chosen: &chosen };
        let (cut, limit) =
            timed(&mut seconds.refine, || self.cut(context, &work)).map_err(of_work)?;
        let (mut made, surface) = cut;
        let filled = timed(&mut seconds.refine, || work.file(context, &surface, &mut made));
        let (file, lost) = filled.map_err(of_work)?;
        drop(surface);
        let mut notes = input.file.notes.clone();
        notes.extend(not_manifold(&input.file, &built));
        notes.extend(lost);
        if !chosen.has_features() {
            notes.extend(tags::ignored(&input.file, &chosen.name));
        }
        notes.extend(self.shortcomings(&made));
        notes.extend(io::losses(&file, job.format));
        self.write(job, &file, &mut seconds)?;
        for note in &notes {
            self.session.console.note(&format!("{}: {note}", path_name(&job.input)));
        }
        seconds.total = start.elapsed();
        let done = Done {
            faces: built.mesh.faces() as u64,
            vertices: file.positions.len() as u64,
            triangles: file.face_sizes.len() as u64,
            limit,
            measure: made.measure,
            coarse: made.coarse,
            missing: made.missing,
            chosen,
            seconds,
            notes,
        };
        if !self.args.json {
            self.session.console.summary(&self.summary(job, &done));
        }
        Ok(done)
    }

    /// The triangles with the surface that they are of, and the limit that they keep.
    fn cut(&self, context: &Context, work: &Work) -> KernelResult<((Tessellation, Surface), f64)> {
        let scheme = &work.chosen.scheme;
        let mesh = std::sync::Arc::new(work.built.mesh.clone());
        let surface = Surface::new(context, &mesh, scheme)?;
        let points = positions(work.control, work.built);
        let points = points.as_flattened();
        // Under a dual scheme that ends inside there is nothing along the boundary.
        let partial = scheme.split() == SplitKind::Corner && scheme.boundary() == Boundary::None;
        let options = |fineness, levels| {
            let all = TessellateOptions::new(fineness);
            TessellateOptions { levels, triangles: self.args.max_triangles, partial, ..all }
        };
        let (fineness, limit) = match (self.args.tolerance, self.args.relative, self.args.pixels) {
            (Some(tolerance), ..) => (Fineness::Chord(tolerance), tolerance),
            (_, Some(part), _) => {
                let tolerance = diagonal(points, part);
                (Fineness::Chord(tolerance), tolerance)
            }
            (.., pixels) => {
                let rough = Fineness::Chord(diagonal(points, ROUGH));
                // It is no result: --max-triangles is not for it.
                let all = TessellateOptions::new(rough);
                let rough = TessellateOptions { levels: ROUGH_LEVELS, partial, ..all };
                let rough = tessellate(context, &surface, points, &rough)?;
                let sizes = vec![3; rough.triangles.len()];
                let corners = rough.triangles.as_flattened();
                let matrix = preview::matrix(&rough.positions, &sizes, corners, self.view)?;
                let viewport = [self.view.width, self.view.height].map(f64::from);
                let pixels = pixels.unwrap_or(1.0);
                (Fineness::Pixels(pixels, Screen { matrix, viewport }), pixels)
            }
        };
        let options = options(fineness, self.args.max_levels);
        Ok(((tessellate(context, &surface, points, &options)?, surface), limit))
    }

    /// What the result is not.
    fn shortcomings(&self, made: &Tessellation) -> Vec<String> {
        let coarse = (made.coarse > 0).then(|| {
            let levels = self.args.max_levels;
            let cells = counted(made.coarse, "cell");
            format!("{cells} coarser than asked for: --max-levels {levels}")
        });
        let missing = (made.missing > 0).then(|| {
            let ending = if made.missing == 1 { "face or sector" } else { "faces or sectors" };
            let count = grouped(made.missing);
            format!("left out {count} {ending}: the surface ends before the boundary")
        });
        coarse.into_iter().chain(missing).collect()
    }

    /// Writes mesh and picture, the picture being drawn first.
    fn write(&self, job: &Job, file: &MeshFile, seconds: &mut Seconds) -> Result<(), Failure> {
        let session = self.session;
        let mut drawn = None;
        if job.picture.is_some() {
            session.console.phase("drawing", &path_name(&job.output));
            let png = timed(&mut seconds.preview, || picture::draw_file(file, self.view));
            drawn = Some(png.map_err(|e| Failure::from_error(&e, Doing::Working))?);
        }
        session.refuse_if_cancelled()?;
        create(job)?;
        session.console.phase("writing", &path_name(&job.output));
        let hook = session.bytes_hook();
        let options = WriteOptions {
            format: Some(job.format),
            precision: self.args.precision.into(),
            encoding: self.args.files.encoding(),
            progress: Some(&hook),
        };
        let write = || session.on_path(&job.output, || io::write(&job.output, file, &options));
        timed(&mut seconds.write, write).map_err(|e| Failure::from_error(&e, Doing::Writing))?;
        if let (Some(png), Some(path)) = (drawn, &job.picture) {
            timed(&mut seconds.preview, || picture::save(session, path, &png))?;
        }
        Ok(())
    }

    fn summary(&self, job: &Job, done: &Done) -> String {
        let faces = counted(done.faces, "face");
        let triangles = counted(done.triangles, "triangle");
        let seconds = done.seconds.total.as_secs_f64();
        let (measure, name) = (done.measure, &done.chosen.name);
        let within = match self.args.pixels {
            Some(_) => format!("edges of {measure:.3} pixels at most"),
            None => format!("within {measure:.3e}"),
        };
        let input = path_name(&job.input);
        format!("{input}: {faces} -> {triangles} ({within}, {name}) in {seconds:.2} s")
    }

    fn report(&self, job: &Job, result: &Result<Done, Failure>) -> Value {
        let mut report = report::opening(job);
        let mut insert = |key: &str, value: Value| drop(report.insert(key.to_owned(), value));
        insert("threads", json!(self.session.context.threads()));
        match result {
            Err(failure) => insert("error", report::error(failure)),
            Ok(done) => describe(&mut report, done, self.args.pixels.is_some()),
        }
        Value::Object(report)
    }
}

fn describe(report: &mut Map<String, Value>, done: &Done, on_screen: bool) {
    let mut insert = |key: &str, value: Value| drop(report.insert(key.to_owned(), value));
    insert("scheme", report::scheme(&done.chosen));
    insert(if on_screen { "pixels" } else { "tolerance" }, json!(done.limit));
    insert(if on_screen { "longest_edge" } else { "bound" }, json!(done.measure));
    insert("faces", json!(done.faces));
    insert("vertices", json!(done.vertices));
    insert("triangles", json!(done.triangles));
    insert("coarse_cells", json!(done.coarse));
    insert("left_out", json!(done.missing));
    insert("seconds", done.seconds.json());
    insert("bytes", json!({ "peak": memory::peak() }));
    insert("notes", json!(done.notes));
}

/// A control mesh with its scheme.
struct Work<'a> {
    control: &'a MeshFile,
    built: &'a Built,
    chosen: &'a Chosen,
}

impl Work<'_> {
    /// The triangles, which are moved there, with all that the control mesh hands down, and what
    /// it could not.
    fn file(
        &self,
        context: &Context,
        surface: &Surface,
        made: &mut Tessellation,
    ) -> KernelResult<(MeshFile, Vec<String>)> {
        let Self { control, built, chosen } = *self;
        let features = chosen.has_features();
        let texture = if features { Texture::of(control, &built.mesh, chosen.uv)? } else { None };
        let load = Load::of(control, built.vertex_source.as_deref(), texture.is_none());
        context.check_memory(file_bytes(made, load.width()))?;
        let mut notes: Vec<String> = load.dropped.iter().cloned().collect();
        let on_surface = |texture: &Texture| match texture.on_surface(
            context,
            &built.mesh,
            &chosen.scheme,
            made,
        ) {
            Err(error) if error.kind() == ErrorKind::Unsupported => {
                notes.push(format!("dropped the texture coordinates ({error})"));
                Ok(None)
            }
            refined => refined.map(Some),
        };
        let refined = texture.as_ref().map(on_surface).transpose()?.flatten();
        let samples = first_places(made)?;
        let mut file = MeshFile {
            face_sizes: memory::zeroed(3, made.triangles.len() as u64)?,
            positions: std::mem::take(&mut made.positions),
            face_vertices: std::mem::take(&mut made.triangles).into_flattened(),
            ..MeshFile::default()
        };
        let columns = load.columns.iter().map(|column| {
            let mut values = memory::zeroed(0.0, (samples.len() * column.width) as u64)?;
            let (width, none) = (column.width, Derivatives::None);
            surface.evaluate(context, &samples, &column.values, width, none, &mut values)?;
            Ok(values)
        });
        let columns = columns.collect::<KernelResult<Vec<_>>>()?;
        let source = |&face: &u32| built.mesh.face_source(face as usize) as u32;
        let faces: Vec<u32> = made.faces.iter().map(source).collect();
        carry::inherit(control, &faces, &mut file);
        carry::unload(&load, columns, control, &mut file);
        if let (Some(texture), Some(refined)) = (&texture, refined) {
            texture.unload(refined, &faces, &mut file);
        }
        notes.extend(texture.and_then(|texture| texture.note));
        normals(made, samples.len(), &mut file)?;
        Ok((file, notes))
    }
}

/// Bytes of triangles and of the file that is made of them, which has values of some width at
/// vertices, positions among them.
fn file_bytes(made: &Tessellation, width: u64) -> u64 {
    let count = |n: usize| n as u64;
    let (point, index) = (size_of::<[f64; 3]>() as u64, size_of::<u32>() as u64);
    let sample = size_of::<Sample>() as u64;
    // A column is there twice as it is put into the file.
    let of_vertex = point + sample + 16 * width;
    // With texture coordinates, their numbers and order.
    let of_place = sample + index + 2 * point + 16 + 16 + 2 * index;
    // Vertices, places, face; then size, normals, the columns' indices, labels.
    let of_triangle = 7 * index + 9 * index;
    count(made.positions.len()) * of_vertex
        + count(made.places.len()) * of_place
        + count(made.triangles.len()) * of_triangle
}

/// The first place of each vertex.
fn first_places(made: &Tessellation) -> KernelResult<Vec<Sample>> {
    let unset = Sample { face: 0, sector: 0, u: 0.0, v: 0.0 };
    let mut samples = memory::zeroed(unset, made.positions.len() as u64)?;
    for (&v, &place) in made.place_vertices.iter().zip(&made.places).rev() {
        samples[v as usize] = place;
    }
    Ok(samples)
}

/// One normal for each of so many vertices, unless some have several.
fn normals(made: &mut Tessellation, vertices: usize, file: &mut MeshFile) -> KernelResult<()> {
    let mut first = memory::zeroed([0.0; 3], vertices as u64)?;
    let of_places = || made.place_vertices.iter().zip(&made.normals);
    for (&v, &normal) in of_places().rev() {
        first[v as usize] = normal;
    }
    let same = |a: [f64; 3], b: [f64; 3]| a.map(f64::to_bits) == b.map(f64::to_bits);
    if of_places().all(|(&v, &normal)| same(first[v as usize], normal)) {
        (file.normals, file.face_normals) = (first, Some(file.face_vertices.clone()));
    } else {
        file.normals = std::mem::take(&mut made.normals);
        file.face_normals = Some(std::mem::take(&mut made.triangle_places).into_flattened());
    }
    Ok(())
}

/// A part of the diagonal of a bounding box; of 1 if it has none, or if it is beyond all numbers.
fn diagonal(positions: &[f64], part: f64) -> f64 {
    let extent = |k: usize| {
        let along = || positions.iter().skip(k).step_by(3);
        let (low, high) = (along().copied().reduce(f64::min), along().copied().reduce(f64::max));
        low.zip(high).map_or(0.0, |(low, high)| part * high - part * low)
    };
    let length = libm::hypot(libm::hypot(extent(0), extent(1)), extent(2));
    if length > 0.0 && length.is_finite() { length } else { part }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagonal_is_that_of_the_box() {
        assert!((diagonal(&[1.0, 2.0, 3.0, 4.0, 6.0, 15.0], 0.5) - 6.5).abs() < 1e-12);
        assert!((diagonal(&[1.0, 2.0, 3.0], 0.5) - 0.5).abs() < 1e-12);
        let wide = diagonal(&[-1.5e308, 0.0, 0.0, 1.5e308, 0.0, 0.0], 1e-3);
        assert!((wide / 3e305 - 1.0).abs() < 1e-12);
    }
}
