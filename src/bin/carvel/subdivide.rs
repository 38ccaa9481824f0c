//! The command `subdivide`.

use crate::args::{Chosen, NumberType, SubdivideArgs};
use crate::exit::{Doing, Exit, Failure};
use crate::faults;
use crate::input::{Input, ends_the_run};
use crate::limit::Wanted;
use crate::picture;
use crate::places::{self, Job, Wish};
use crate::precise::Precise;
use crate::preview::View;
use crate::refine::{Engine, Outcome, Work, predict};
use crate::report::{self, Done, Level, Seconds, Settings};
use crate::session::Session;
use crate::tags;
use crate::text::counted;
use crate::topology::Asked;
use carvel::io::{self, Format, MeshFile, SchemeTags, WriteOptions};
use carvel::mesh::{BuildOptions, Built};
use serde_json::Value;
use std::fs;
use std::time::{Duration, Instant};

/// Refines all inputs.
pub fn run(args: &SubdivideArgs) -> Result<Exit, Failure> {
    args.check()?;
    let chosen = args.scheme.choose(SchemeTags::default())?;
    let view = args.view.view()?;
    let jobs = places::plan(&Wish {
        inputs: &args.inputs,
        output: &args.output,
        format: args.files.format,
        picture: args.preview.as_deref(),
    })?;
    let quiet = args.quiet || args.json && places::is_stream(&args.output);
    let session = Session::new(args.threads, args.memory, quiet)?;
    let engine = Engine::new(args.precision);
    Run { args, chosen: &chosen, view: &view, session: &session, engine }.all(&jobs)
}

/// A run over several inputs.
struct Run<'a> {
    args: &'a SubdivideArgs,
    chosen: &'a Chosen,
    view: &'a View,
    session: &'a Session,
    engine: Engine,
}

/// What refining, or converting, made of an input.
struct Made {
    file: MeshFile,
    chosen: Chosen,
    levels: Vec<Level>,
    anchored: bool,
    scratch: Option<u64>,
    predicted: Option<f64>,
    holes: u64,
    notes: Vec<String>,
}

impl Run<'_> {
    fn all(&mut self, jobs: &[Job]) -> Result<Exit, Failure> {
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

    fn report(&self, job: &Job, result: &Result<Done, Failure>) -> Value {
        let settings = Settings {
            chosen: result.as_ref().map_or(self.chosen, |done| &done.chosen),
            levels: self.args.levels,
            threads: self.session.context.threads(),
            precision: self.args.precision.name(),
        };
        report::subdivision(&settings, job, result)
    }

    /// Does one job.
    fn one(&mut self, job: &Job) -> Result<Done, Failure> {
        let start = Instant::now();
        let mut seconds = Seconds::default();
        let input = timed(&mut seconds.read, || {
            Input::read(self.session, &job.input, self.args.files.input_format)
        })?;
        input.require_faces()?;
        let mut made = match self.args.levels {
            0 => self.convert(input, &mut seconds)?,
            _ => self.refine(&input, &mut seconds)?,
        };
        if job.format == Format::Obj && made.chosen.has_features() {
            // So that a refinement can go on from the file, whoever asked for its modes.
            let asked = self.args.scheme.asked();
            let file = &mut made.file.scheme;
            file.boundary = asked.boundary.or(file.boundary);
            file.creasing = asked.creasing.or(file.creasing);
            file.triangles = asked.triangles.or(file.triangles);
            file.face_varying = asked.face_varying.or(file.face_varying);
        }
        self.write(job, &made.file, &mut seconds)?;
        seconds.total = start.elapsed();
        let notes = self.tell(job, &made);
        let Made { chosen, levels, anchored, scratch, predicted, holes, .. } = made;
        let done = Done { chosen, levels, seconds, scratch, predicted, anchored, holes, notes };
        if !self.args.json {
            self.session.console.summary(&self.summary(job, &done));
        }
        Ok(done)
    }

    /// Level 0: everything as it is, whether or not it is a surface.
    fn convert(&self, input: Input, seconds: &mut Seconds) -> Result<Made, Failure> {
        if self.args.precision == NumberType::F32 {
            let positions = input.file.positions.as_flattened();
            f32::narrow(positions, 3).map_err(|e| faults::of_work(&input, &e))?;
        }
        // The topology is wanted for its counts only; what has none is converted too.
        let built = if self.args.json {
            let options = BuildOptions { anchored: self.args.anchored, ..Default::default() };
            timed(&mut seconds.build, || self.asked().build(self.session, &input, &options)).ok()
        } else {
            None
        };
        let edges = built.map(|b| (b.mesh.edges() as u64, b.mesh.boundary_edges() as u64));
        let mut file = input.file;
        let level = Level {
            vertices: file.positions.len() as u64,
            faces: file.face_sizes.len() as u64,
            corners: file.face_vertices.len() as u64,
            edges,
        };
        let notes = std::mem::take(&mut file.notes);
        let anchored = self.args.anchored;
        let chosen = self.chosen.clone();
        let (levels, scratch, predicted) = (vec![level], None, None);
        Ok(Made { file, chosen, levels, anchored, scratch, predicted, holes: 0, notes })
    }

    /// What is asked of control meshes.
    fn asked(&self) -> Asked<'_> {
        let SubdivideArgs { anchored, non_manifold, creases, .. } = self.args;
        Asked { anchored: *anchored, non_manifold: *non_manifold, creases }
    }

    fn refine(&mut self, input: &Input, seconds: &mut Seconds) -> Result<Made, Failure> {
        let of_work = |e: carvel::Error| faults::of_work(input, &e);
        let chosen = self.args.scheme.choose(input.file.scheme)?;
        self.session.console.phase("building", &input.name);
        let built =
            timed(&mut seconds.build, || self.asked().build_for(self.session, input, &chosen))?;
        let levels = self.args.levels;
        let plan = predict(&built.mesh, &chosen.scheme, levels).map_err(of_work)?;
        self.session.console.phase("refining", &input.name);
        let (control, keep_holes) = (&input.file, self.args.keep_holes);
        let limit = Wanted { positions: self.args.limit, normals: self.args.normals };
        let (built, plan) = (&built, &plan);
        let work = Work { control, built, chosen: &chosen, levels, plan, keep_holes, limit };
        let outcome = timed(&mut seconds.refine, || self.engine.run(&self.session.context, &work));
        let outcome = outcome.map_err(of_work)?;
        let Outcome { file, notes: lost, holes, anchored, scratch, predicted } = outcome;
        if file.face_sizes.is_empty() {
            let message = format!("{}: all faces are holes (--keep-holes keeps them)", input.name);
            return Err(Failure::new(Exit::Mesh, message));
        }
        let mut notes = input.file.notes.clone();
        notes.extend(not_manifold(&input.file, built));
        notes.extend(lost);
        notes.extend(left_out(holes));
        if !chosen.has_features() {
            notes.extend(tags::ignored(&input.file, &chosen.name));
        }
        let (levels, scratch, predicted) = (Level::all(plan), Some(scratch), Some(predicted));
        Ok(Made { file, chosen, levels, anchored, scratch, predicted, holes, notes })
    }

    /// Builds the mesh with the tags that mean something to the scheme.
    /// Tells what was lost, one line each. (A failure has its one line alone.)
    fn tell(&self, job: &Job, made: &Made) -> Vec<String> {
        let mut notes = made.notes.clone();
        notes.extend(io::losses(&made.file, job.format));
        let name = crate::text::path_name(&job.input);
        for note in &notes {
            self.session.console.note(&format!("{name}: {note}"));
        }
        notes
    }

    /// Writes mesh and picture. The picture is drawn first: if that fails,
    /// nothing is written.
    fn write(&self, job: &Job, file: &MeshFile, seconds: &mut Seconds) -> Result<(), Failure> {
        let name = crate::text::path_name(&job.output);
        let mut drawn = None;
        if job.picture.is_some() {
            self.session.console.phase("drawing", &name);
            let png = timed(&mut seconds.preview, || picture::draw_file(file, self.view));
            drawn = Some(png.map_err(|e| Failure::from_error(&e, Doing::Working))?);
        }
        self.session.refuse_if_cancelled()?;
        create(job)?;
        self.session.console.phase("writing", &name);
        timed(&mut seconds.write, || self.write_mesh(job, file))?;
        if let (Some(png), Some(path)) = (drawn, &job.picture) {
            timed(&mut seconds.preview, || picture::save(self.session, path, &png))?;
        }
        Ok(())
    }

    fn write_mesh(&self, job: &Job, file: &MeshFile) -> Result<(), Failure> {
        let hook = self.session.bytes_hook();
        let options = WriteOptions {
            format: Some(job.format),
            precision: self.args.precision.into(),
            encoding: self.args.files.encoding(),
            progress: Some(&hook),
        };
        let written = self.session.on_path(&job.output, || io::write(&job.output, file, &options));
        written.map_err(|e| Failure::from_error(&e, Doing::Writing))
    }

    fn summary(&self, job: &Job, done: &Done) -> String {
        let faces = |level: Option<&Level>, holes| {
            counted(level.map_or(0, |level| level.faces - holes), "face")
        };
        let input = crate::text::path_name(&job.input);
        let seconds = done.seconds.total.as_secs_f64();
        if self.args.levels == 0 {
            let (faces, format) = (faces(done.levels.first(), 0), job.format);
            return format!("{input}: {faces} converted to {format} in {seconds:.2} s");
        }
        let (before, after) =
            (faces(done.levels.first(), 0), faces(done.levels.last(), done.holes));
        let levels = counted(u64::from(self.args.levels), "level");
        let scheme = &self.chosen.name;
        format!("{input}: {before} -> {after} ({levels}, {scheme}) in {seconds:.2} s")
    }
}

/// What the policy did with a mesh that is not manifold.
pub fn not_manifold(file: &MeshFile, built: &Built) -> Option<String> {
    if !built.mesh.is_manifold() {
        return Some("not manifold, kept as it is: infinitely sharp there".to_owned());
    }
    let copies = built.mesh.vertices() - file.positions.len();
    (copies > 0).then(|| match copies {
        1 => "not manifold, cut open: 1 copy of a vertex was made".to_owned(),
        n => format!("not manifold, cut open: {n} copies of vertices were made"),
    })
}

/// How many faces are holes.
fn left_out(holes: u64) -> Option<String> {
    let what = if holes == 1 { "which is a hole" } else { "which are holes" };
    let faces = counted(holes, "face");
    (holes > 0).then(|| format!("left out {faces}, {what} (--keep-holes keeps them)"))
}

/// Creates the directories of a job.
pub fn create(job: &Job) -> Result<(), Failure> {
    job.directories.iter().try_for_each(|directory| {
        fs::create_dir_all(directory).map_err(|e| {
            let name = crate::text::one_line(&directory.display().to_string());
            Failure::from_error(&carvel::Error::io(name, e), Doing::Writing)
        })
    })
}

/// Adds the time that work takes.
pub fn timed<R>(sum: &mut Duration, work: impl FnOnce() -> R) -> R {
    let start = Instant::now();
    let result = work();
    *sum += start.elapsed();
    result
}
