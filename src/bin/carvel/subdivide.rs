//! The command `subdivide`.

use crate::args::{Chosen, NumberType, SubdivideArgs};
use crate::carry;
use crate::exit::{Doing, Exit, Failure};
use crate::faults;
use crate::input::{Input, ends_the_run};
use crate::picture;
use crate::places::{self, Job, Wish};
use crate::precise::Precise;
use crate::preview::View;
use crate::refine::{Engine, Outcome, Work, predict};
use crate::report::{self, Done, Level, Seconds, Settings};
use crate::session::Session;
use crate::text::counted;
use carvel::io::{self, MeshFile, WriteOptions};
use carvel::mesh::{BuildOptions, Built, build};
use serde_json::Value;
use std::fs;
use std::time::{Duration, Instant};

/// Refines all inputs.
pub fn run(args: &SubdivideArgs) -> Result<Exit, Failure> {
    let chosen = args.scheme.choose()?;
    let view = args.view.view()?;
    let jobs = places::plan(&Wish {
        inputs: &args.inputs,
        output: &args.output,
        format: args.files.format,
        picture: args.preview.as_deref(),
    })?;
    let session = Session::new(args.threads, args.memory, args.quiet)?;
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
    levels: Vec<Level>,
    anchored: bool,
    scratch: Option<u64>,
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
        self.print(jobs, reports)?;
        Ok(exit)
    }

    fn report(&self, job: &Job, result: &Result<Done, Failure>) -> Value {
        let settings = Settings {
            chosen: self.chosen,
            levels: self.args.levels,
            threads: self.session.context.threads(),
            precision: self.args.precision.name(),
        };
        report::subdivision(&settings, job, result)
    }

    /// Prints the reports where no mesh or picture went.
    fn print(&self, jobs: &[Job], mut reports: Vec<Value>) -> Result<(), Failure> {
        if !self.args.json {
            return Ok(());
        }
        let whole = if jobs.len() == 1 { reports.remove(0) } else { Value::Array(reports) };
        let document = report::document(&whole);
        let taken = |job: &Job| {
            places::is_stream(&job.output) || job.picture.as_deref().is_some_and(places::is_stream)
        };
        if jobs.iter().any(taken) {
            self.session.console.line(document.trim_end());
            return Ok(());
        }
        report::print(&document).map(drop)
    }

    /// Does one job.
    fn one(&mut self, job: &Job) -> Result<Done, Failure> {
        let start = Instant::now();
        let mut seconds = Seconds::default();
        let input = timed(&mut seconds.read, || {
            Input::read(self.session, &job.input, self.args.files.input_format)
        })?;
        input.require_faces()?;
        let made = match self.args.levels {
            0 => self.convert(input, &mut seconds)?,
            _ => self.refine(&input, &mut seconds)?,
        };
        self.write(job, &made.file, &mut seconds)?;
        seconds.total = start.elapsed();
        let notes = self.tell(job, &made);
        let Made { levels, anchored, scratch, .. } = made;
        let done = Done { levels, seconds, scratch, anchored, notes };
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
            timed(&mut seconds.build, || self.build(&input)).ok()
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
        Ok(Made { file, levels: vec![level], anchored, scratch: None, notes })
    }

    fn refine(&mut self, input: &Input, seconds: &mut Seconds) -> Result<Made, Failure> {
        let of_work = |e: carvel::Error| faults::of_work(input, &e);
        self.session.console.phase("building", &input.name);
        let built = timed(&mut seconds.build, || self.build(input))?;
        let (scheme, levels) = (&self.chosen.scheme, self.args.levels);
        let plan = predict(&built.mesh, scheme, levels).map_err(of_work)?;
        self.session.console.phase("refining", &input.name);
        let work = Work { control: &input.file, built: &built, scheme, levels, plan: &plan };
        let outcome = timed(&mut seconds.refine, || self.engine.run(&self.session.context, &work));
        let Outcome { file, dropped, anchored, scratch } = outcome.map_err(of_work)?;
        let mut notes = input.file.notes.clone();
        notes.extend(cut(&input.file, &built));
        notes.extend(dropped);
        notes.extend(carry::ignored_tags(&input.file));
        Ok(Made { file, levels: Level::all(&plan), anchored, scratch: Some(scratch), notes })
    }

    fn build(&self, input: &Input) -> Result<Built, Failure> {
        let file = &input.file;
        let options = BuildOptions {
            non_manifold: self.args.non_manifold.into(),
            anchored: self.args.anchored,
            ..BuildOptions::default()
        };
        let (sizes, vertices) = (&file.face_sizes, &file.face_vertices);
        build(&self.session.context, file.positions.len(), sizes, vertices, &options)
            .map_err(|defects| faults::failure(input, &defects))
    }

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
        let faces = |level: Option<&Level>| counted(level.map_or(0, |l| l.faces), "face");
        let input = crate::text::path_name(&job.input);
        let seconds = done.seconds.total.as_secs_f64();
        if self.args.levels == 0 {
            let (faces, format) = (faces(done.levels.first()), job.format);
            return format!("{input}: {faces} converted to {format} in {seconds:.2} s");
        }
        let (before, after) = (faces(done.levels.first()), faces(done.levels.last()));
        let levels = counted(u64::from(self.args.levels), "level");
        let scheme = self.chosen.name;
        format!("{input}: {before} -> {after} ({levels}, {scheme}) in {seconds:.2} s")
    }
}

/// What policy `cut` did, if it did anything.
fn cut(file: &MeshFile, built: &Built) -> Option<String> {
    let copies = built.mesh.vertices() - file.positions.len();
    (copies > 0).then(|| match copies {
        1 => "not manifold, cut open: 1 copy of a vertex was made".to_owned(),
        n => format!("not manifold, cut open: {n} copies of vertices were made"),
    })
}

/// Creates the directories of a job.
fn create(job: &Job) -> Result<(), Failure> {
    job.directories.iter().try_for_each(|directory| {
        fs::create_dir_all(directory).map_err(|e| {
            let name = crate::text::one_line(&directory.display().to_string());
            Failure::from_error(&carvel::Error::io(name, e), Doing::Writing)
        })
    })
}

/// Adds the time that work takes.
fn timed<R>(sum: &mut Duration, work: impl FnOnce() -> R) -> R {
    let start = Instant::now();
    let result = work();
    *sum += start.elapsed();
    result
}
