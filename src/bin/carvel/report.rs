//! What programs get to read: JSON, and text on the standard output.

use crate::args::Chosen;
use crate::exit::{Doing, Exit, Failure};
use crate::memory;
use crate::places::{self, Job};
use crate::session::Session;
use carvel::{Error, Prediction};
use serde_json::{Map, Value, json};
use std::io::{Write, stdout};
use std::time::Duration;

/// The time that each part of the work took.
#[derive(Debug, Clone, Copy, Default)]
pub struct Seconds {
    /// Reading the input.
    pub read: Duration,
    /// Building its topology.
    pub build: Duration,
    /// Refining.
    pub refine: Duration,
    /// Writing the output.
    pub write: Duration,
    /// Drawing and writing the picture.
    pub preview: Duration,
    /// All of it.
    pub total: Duration,
}

impl Seconds {
    /// For programs.
    pub fn json(&self) -> Value {
        json!({
            "read": self.read.as_secs_f64(),
            "build": self.build.as_secs_f64(),
            "refine": self.refine.as_secs_f64(),
            "write": self.write.as_secs_f64(),
            "preview": self.preview.as_secs_f64(),
            "total": self.total.as_secs_f64(),
        })
    }
}

/// Counts of one level; edges are unknown where no topology was built.
#[derive(Debug, Clone, Copy)]
pub struct Level {
    /// Vertices.
    pub vertices: u64,
    /// Faces.
    pub faces: u64,
    /// Corners.
    pub corners: u64,
    /// Edges, and how many of them lie on a boundary.
    pub edges: Option<(u64, u64)>,
}

impl Level {
    /// The levels of a prediction.
    pub fn all(plan: &Prediction) -> Vec<Self> {
        let level = |c: &carvel::refine::Counts| Self {
            vertices: c.vertices,
            faces: c.faces,
            corners: c.corners,
            edges: Some((c.edges, c.boundary_edges)),
        };
        plan.levels().iter().map(level).collect()
    }

    fn json(&self, level: usize) -> Value {
        json!({
            "level": level,
            "vertices": self.vertices,
            "edges": self.edges.map(|e| e.0),
            "faces": self.faces,
            "corners": self.corners,
            "boundary_edges": self.edges.map(|e| e.1),
        })
    }
}

/// What became of one input.
#[derive(Debug, Clone)]
pub struct Done {
    /// The scheme, with what the file asked of it.
    pub chosen: Chosen,
    /// All levels, the control mesh first.
    pub levels: Vec<Level>,
    /// Times.
    pub seconds: Seconds,
    /// Bytes of scratch memory of the kernel, if it ran.
    pub scratch: Option<u64>,
    /// Seconds that the kernel was predicted to take, if it ran.
    pub predicted: Option<f64>,
    /// Whether the result is anchored.
    pub anchored: bool,
    /// Faces that were left out as holes.
    pub holes: u64,
    /// What the user was told.
    pub notes: Vec<String>,
}

/// What is the same for all inputs of a run.
#[derive(Debug, Clone, Copy)]
pub struct Settings<'a> {
    /// The scheme.
    pub chosen: &'a Chosen,
    /// The number of steps.
    pub levels: u32,
    /// Threads at work.
    pub threads: usize,
    /// The name of the number type.
    pub precision: &'static str,
}

/// What every report begins with.
pub fn opening(job: &Job) -> Map<String, Value> {
    let mut report = Map::new();
    report.insert("input".to_owned(), json!(job.input.display().to_string()));
    report.insert("output".to_owned(), json!(job.output.display().to_string()));
    report.insert("format".to_owned(), json!(job.format.name()));
    if let Some(picture) = &job.picture {
        report.insert("preview".to_owned(), json!(picture.display().to_string()));
    }
    report
}

/// The report of a run on one input.
pub fn subdivision(settings: &Settings, job: &Job, result: &Result<Done, Failure>) -> Value {
    let mut report = opening(job);
    report.insert("scheme".to_owned(), scheme(settings.chosen));
    report.insert("levels".to_owned(), json!(settings.levels));
    report.insert("precision".to_owned(), json!(settings.precision));
    report.insert("threads".to_owned(), json!(settings.threads));
    match result {
        Ok(done) => describe(&mut report, done),
        Err(failure) => {
            report.insert("error".to_owned(), error(failure));
        }
    }
    Value::Object(report)
}

fn describe(report: &mut Map<String, Value>, done: &Done) {
    let counts = done.levels.iter().enumerate().map(|(i, level)| level.json(i));
    report.insert("counts".to_owned(), counts.collect());
    report.insert("anchored".to_owned(), json!(done.anchored));
    report.insert("holes_left_out".to_owned(), json!(done.holes));
    report.insert("seconds".to_owned(), done.seconds.json());
    report.insert("predicted_seconds".to_owned(), json!(done.predicted));
    report.insert("bytes".to_owned(), json!({ "scratch": done.scratch, "peak": memory::peak() }));
    report.insert("notes".to_owned(), json!(done.notes));
}

/// A scheme with its options.
pub fn scheme(chosen: &Chosen) -> Value {
    let passes: Vec<_> = chosen.scheme.passes().iter().map(ToString::to_string).collect();
    let mut scheme = Map::new();
    scheme.insert("name".to_owned(), json!(chosen.name));
    scheme.insert("split".to_owned(), json!(chosen.split()));
    scheme.insert("passes".to_owned(), json!(passes));
    for (option, word) in &chosen.options {
        scheme.insert((*option).to_owned(), json!(word));
    }
    Value::Object(scheme)
}

/// A failure for programs.
pub fn error(failure: &Failure) -> Value {
    json!({
        "exit_code": failure.exit as u8,
        "kind": failure.kind.map(|kind| format!("{kind:?}")),
        "message": failure.message,
    })
}

/// JSON as text.
pub fn document(value: &Value) -> String {
    format!("{value:#}\n")
}

/// Prints the reports of all jobs where no mesh or picture went.
pub fn print_all(session: &Session, jobs: &[Job], mut reports: Vec<Value>) -> Result<(), Failure> {
    let whole = if jobs.len() == 1 { reports.remove(0) } else { Value::Array(reports) };
    let document = document(&whole);
    let taken = |job: &Job| {
        places::is_stream(&job.output) || job.picture.as_deref().is_some_and(places::is_stream)
    };
    if jobs.iter().any(taken) {
        session.console.line(document.trim_end());
        return Ok(());
    }
    print(&document).map(drop)
}

/// Prints text on the standard output. A reader that went away is no error.
pub fn print(text: &str) -> Result<Exit, Failure> {
    let mut out = stdout().lock();
    let result = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    match result.map_err(|e| Failure::from_error(&Error::io("standard output", e), Doing::Writing))
    {
        Err(failure) if !failure.silent => Err(failure),
        _ => Ok(Exit::Success),
    }
}
