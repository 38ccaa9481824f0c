//! The command `info`.

use crate::args::InfoArgs;
use crate::exit::{Exit, Failure};
use crate::faults::Fault;
use crate::input::{Input, ends_the_run};
use crate::report;
use crate::session::Session;
use crate::tags;
use crate::text::{counted, grouped, path_name};
use carvel::io::{MeshFile, SchemeTags};
use carvel::mesh::{BuildOptions, Built, Defect, Defects, NonManifold, Survey, build};
use carvel::{Channel, FaceVaryingMode, Mesh};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Defects that are printed; the rest is counted.
const SHOWN: usize = 20;

/// Describes all inputs.
pub fn run(args: &InfoArgs) -> Result<Exit, Failure> {
    let session = Session::new(0, None, true)?;
    let mut exit = Exit::Success;
    let mut reports = Vec::new();
    for path in &args.inputs {
        let result = Input::read(&session, path, args.input_format)
            .and_then(|input| Description::of(&session, input));
        let code = match &result {
            Ok(description) if description.faults.is_empty() => Exit::Success,
            Ok(_) => Exit::Mesh,
            Err(failure) => session.console.failure(failure),
        };
        exit = if exit == Exit::Success { code } else { exit };
        match &result {
            _ if args.json => reports.push(json_of(&path_name(path), &result)),
            Ok(description) => report::print(&description.text()).map(drop)?,
            Err(_) => {}
        }
        if result.is_err_and(|failure| ends_the_run(&failure)) {
            break;
        }
    }
    if args.json {
        let one = args.inputs.len() == 1;
        let whole = if one { reports.remove(0) } else { Value::Array(reports) };
        report::print(&report::document(&whole))?;
    }
    Ok(exit)
}

/// All that is known about a file.
struct Description {
    input: Input,
    /// Edges, boundary edges and figures of the mesh, cut open if it has to be.
    topology: Option<Topology>,
    faults: Vec<Fault>,
}

struct Topology {
    edges: usize,
    boundary_edges: usize,
    /// The figures are those of the mesh after it was cut open.
    cut: bool,
    /// Edges across which texture coordinates are not continuous, if every face has some.
    seams: Option<usize>,
    /// Edges that are not manifold, and vertices that are not while their edges are.
    kept: (usize, usize),
    survey: Survey,
}

impl Description {
    fn of(session: &Session, input: Input) -> Result<Self, Failure> {
        if input.file.face_sizes.is_empty() {
            let message = input.no_faces().to_owned();
            let faults = vec![Fault { kind: None, line: None, message }];
            return Ok(Self { input, topology: None, faults });
        }
        let (topology, faults) = match attempt(session, &input, NonManifold::Error) {
            Ok(built) => {
                let faults = bad_tag(session, &input).into_iter().collect();
                (Some(Topology::of(&input, &built, (0, 0))), faults)
            }
            Err(Defects::Call(error)) => return Err(crate::faults::of_work(&input, &error)),
            Err(Defects::Soup(defects)) => {
                let faults = defects.iter().map(|d| Fault::of_defect(&input, d)).collect();
                let cut = attempt(session, &input, NonManifold::Cut).ok();
                (cut.map(|built| Topology::of(&input, &built, kept(&defects))), faults)
            }
        };
        Ok(Self { input, topology, faults })
    }

    fn text(&self) -> String {
        let mut text = format!("{}\n", self.input.name);
        let mut line = |name: &str, value: String| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {name:<18}{value}");
        };
        line("format", self.input.format.to_string());
        line("vertices", grouped(self.input.file.positions.len() as u64));
        line("faces", grouped(self.input.file.face_sizes.len() as u64));
        line("corners", grouped(self.input.file.face_vertices.len() as u64));
        if let Some(topology) = &self.topology {
            topology.lines(&mut line);
        }
        line("face sizes", histogram(&self.face_sizes()));
        if let Some((low, high)) = self.bounds() {
            line("bounding box", format!("{} to {}", point(low), point(high)));
        }
        line("attributes", or_none(&self.attributes()));
        line("tags", or_none(&self.tags()));
        for note in &self.input.file.notes {
            line("note", note.clone());
        }
        for fault in self.faults.iter().take(SHOWN) {
            line("defect", fault.located());
        }
        match self.faults.len() {
            0 => line("defects", "none".to_owned()),
            n if n > SHOWN => line("defects", format!("{} in all", grouped(n as u64))),
            _ => {}
        }
        text
    }

    fn json(&self) -> Value {
        let file = &self.input.file;
        json!({
            "input": self.input.name,
            "format": self.input.format.name(),
            "vertices": file.positions.len(),
            "faces": file.face_sizes.len(),
            "corners": file.face_vertices.len(),
            "topology": self.topology.as_ref().map(Topology::json),
            "face_sizes": self.face_sizes(),
            "bounding_box": self.bounds(),
            "attributes": self.attributes(),
            "creases": file.creases.len(),
            "sharp_vertices": file.sharp_vertices.len(),
            "holes": file.holes.len(),
            "notes": file.notes,
            "defects": self.faults.iter().map(Fault::json).collect::<Vec<_>>(),
        })
    }

    /// Sharp features and holes; what is infinitely sharp is told apart.
    fn tags(&self) -> Vec<String> {
        let file = &self.input.file;
        let creases = file.creases.iter().map(|crease| crease.sharpness);
        let vertices = file.sharp_vertices.iter().map(|tag| tag.sharpness);
        let mut found = Vec::new();
        found.extend(sharp("crease", "creases", creases));
        found.extend(sharp("sharp vertex", "sharp vertices", vertices));
        let holes = file.holes.len() as u64;
        found.extend((holes > 0).then(|| counted(holes, "hole")));
        if file.scheme != SchemeTags::default() {
            found.push("some of the scheme".to_owned());
        }
        found
    }

    fn face_sizes(&self) -> BTreeMap<usize, usize> {
        let mut sizes = BTreeMap::new();
        for &size in &self.input.file.face_sizes {
            *sizes.entry(size as usize).or_default() += 1;
        }
        sizes
    }

    /// The least and the largest coordinates.
    fn bounds(&self) -> Option<([f64; 3], [f64; 3])> {
        let positions = &self.input.file.positions;
        let first = *positions.first()?;
        Some(positions.iter().fold((first, first), |(mut low, mut high), p| {
            for i in 0..3 {
                low[i] = low[i].min(p[i]);
                high[i] = high[i].max(p[i]);
            }
            (low, high)
        }))
    }

    /// The data besides positions and faces.
    fn attributes(&self) -> Vec<String> {
        let file = &self.input.file;
        let mut found = Vec::new();
        if let Some(colors) = &file.colors {
            found.push(format!("vertex colours of {} components", colors.width));
        }
        for (what, n) in [("texture coordinate", file.uvs.len()), ("normal", file.normals.len())] {
            found.extend((n > 0).then(|| counted(n as u64, what)));
        }
        let named = [
            ("object", &file.objects),
            ("group", &file.groups),
            ("material", &file.materials),
            ("smoothing group", &file.smoothing),
        ];
        for (what, labels) in named {
            found.extend((!labels.is_empty()).then(|| counted(labels.names.len() as u64, what)));
        }
        found.extend(file.attributes.iter().map(|a| format!("vertex attribute {}", a.name)));
        found
    }
}

impl Topology {
    /// Of the mesh as it is, or cut open where some parts are not manifold.
    fn of(input: &Input, built: &Built, kept: (usize, usize)) -> Self {
        let mesh = &built.mesh;
        Self {
            edges: mesh.edges(),
            boundary_edges: mesh.boundary_edges(),
            cut: kept != (0, 0),
            seams: seams(&input.file, mesh),
            kept,
            survey: Survey::of(mesh),
        }
    }

    fn lines(&self, line: &mut impl FnMut(&str, String)) {
        let survey = &self.survey;
        if self.cut {
            line("topology", "as cut open by --non-manifold cut".to_owned());
        }
        let rim = grouped(self.boundary_edges as u64);
        line("edges", format!("{} ({rim} on boundaries)", grouped(self.edges as u64)));
        if let Some(seams) = self.seams {
            line("seams", counted(seams as u64, "edge"));
        }
        if self.kept != (0, 0) {
            let (edges, vertices) = self.kept;
            let and = if vertices == 1 { "vertex" } else { "vertices" };
            let edges = counted(edges as u64, "edge");
            let kept = format!(
                "{edges} and {} {and}, sharp under --non-manifold sharpen",
                grouped(vertices as u64)
            );
            line("not manifold", kept);
        }
        line("Euler number", survey.euler_characteristic.to_string());
        line("components", grouped(survey.components as u64));
        line("boundary loops", grouped(survey.boundary_loops as u64));
        line("isolated vertices", grouped(survey.isolated_vertices as u64));
        line("inner valences", histogram(&survey.interior_valences));
        if !survey.boundary_valences.is_empty() {
            line("faces at boundary", histogram(&survey.boundary_valences));
        }
    }

    fn json(&self) -> Value {
        let survey = &self.survey;
        json!({
            "cut": self.cut,
            "edges": self.edges,
            "boundary_edges": self.boundary_edges,
            "seam_edges": self.seams,
            "non_manifold_edges": self.kept.0,
            "non_manifold_vertices": self.kept.1,
            "euler_characteristic": survey.euler_characteristic,
            "components": survey.components,
            "boundary_loops": survey.boundary_loops,
            "isolated_vertices": survey.isolated_vertices,
            "interior_valences": survey.interior_valences,
            "boundary_valences": survey.boundary_valences,
        })
    }
}

/// Edges and vertices among defects that policy `sharpen` keeps.
fn kept(defects: &[Defect]) -> (usize, usize) {
    use Defect as D;
    let edge =
        |d: &&Defect| matches!(d, D::NonManifoldEdge { .. } | D::InconsistentOrientation { .. });
    let vertex = |d: &&Defect| matches!(d, D::NonManifoldVertex { .. });
    (defects.iter().filter(edge).count(), defects.iter().filter(vertex).count())
}

/// Edges across which texture coordinates are not continuous, if all corners have some.
fn seams(file: &MeshFile, mesh: &Mesh) -> Option<usize> {
    let indices = file.face_uvs.as_ref()?;
    let channel = Channel::new(mesh, indices, file.uvs.len(), FaceVaryingMode::default()).ok()?;
    Some(channel.seam_edges(mesh))
}

/// `3 creases (1 infinite)`, if there are any.
fn sharp(one: &str, many: &str, sharpness: impl Iterator<Item = f32>) -> Option<String> {
    let (mut all, mut infinite) = (0, 0);
    for sharpness in sharpness {
        all += 1;
        infinite += u64::from(sharpness >= 10.0);
    }
    let what = if all == 1 { one } else { many };
    let endless = format!(" ({} infinite)", grouped(infinite));
    let endless = if infinite > 0 { endless } else { String::new() };
    (all > 0).then(|| format!("{} {what}{endless}", grouped(all)))
}

/// The first tag of a manifold mesh that names nothing.
fn bad_tag(session: &Session, input: &Input) -> Option<Fault> {
    let options = tags::build_options(&input.file, &input.file.creases);
    match attempt_with(session, input, &options) {
        Err(Defects::Call(error)) => Some(Fault::of_error(input, &error)),
        _ => None,
    }
}

fn attempt(session: &Session, input: &Input, policy: NonManifold) -> Result<Built, Defects> {
    let options = BuildOptions { non_manifold: policy, ..BuildOptions::default() };
    attempt_with(session, input, &options)
}

fn attempt_with(
    session: &Session,
    input: &Input,
    options: &BuildOptions,
) -> Result<Built, Defects> {
    let file = &input.file;
    let (sizes, vertices) = (&file.face_sizes, &file.face_vertices);
    build(&session.context, file.positions.len(), sizes, vertices, options)
}

fn json_of(name: &str, result: &Result<Description, Failure>) -> Value {
    match result {
        Ok(description) => description.json(),
        Err(failure) => json!({ "input": name, "error": report::error(failure) }),
    }
}

/// `4 of 3, 160 of 4`: how many there are of each size.
fn histogram(counts: &BTreeMap<usize, usize>) -> String {
    let entries = counts.iter().map(|(size, n)| format!("{} of {size}", grouped(*n as u64)));
    or_none(&entries.collect::<Vec<_>>())
}

fn or_none(list: &[String]) -> String {
    if list.is_empty() { "none".to_owned() } else { list.join(", ") }
}

fn point(p: [f64; 3]) -> String {
    format!("({}, {}, {})", p[0], p[1], p[2])
}
