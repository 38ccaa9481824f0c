//! Rust crates beside carvel: where it stands among what a Rust program would take instead.

use carvel::Context;
use carvel_peers::{Boundary, Comparison, Control, PeerMesh, Scheme, heap};
use opensubdiv_rs::far::{
    PrimvarRefiner, TopologyDescriptor, TopologyRefiner, TopologyRefinerFactory, UniformOptions,
};
use opensubdiv_rs::sdc;
use std::collections::BTreeSet;
use std::num::NonZeroU8;
use subdiv_kernels::{BoundaryInterpolation, RefinementResult, SchemeOptions, UniformRefine};

use crate::buffers::Buffers;
use crate::cases::{self, Case};
use crate::matched::mesh;
use crate::part::Emit;
use crate::regime::Regime;
use crate::row::Row;
use crate::sides::{Fresh, Given, ReUsed, Side};
use crate::turns;

const PORT: &str = "opensubdiv-rs";
const KERNELS: &str = "subdiv-kernels";

/// What is not in the table because a crate does not have it.
const MISSING: [&str; 2] = [
    "opensubdiv-rs 0.5: Catmull-Clark, Loop, bilinear; no dual scheme, no interpolating one, one \
     thread, results in vectors of its own",
    "subdiv-kernels 0.1: Catmull-Clark, Loop, Doo-Sabin, sqrt3; no bilinear scheme, no smoothing \
     passes, no holes, weights in f32 for f64 data too, results in vectors of its own",
];

/// All rows of a regime, after what the crates lack.
pub fn run(regime: Regime, runs: u32, emit: Emit) -> Result<(), String> {
    if regime == Regime::Default {
        for line in MISSING {
            emit(Err(line.into()));
        }
    }
    let (cow, torus, triangles) = (cases::cow()?, cases::torus(), cases::triangles());
    for (scheme, name, control, level) in [
        (Scheme::CatmullClark, "cow", &cow, 5),
        (Scheme::CatmullClark, "torus", &torus, 2),
        (Scheme::Bilinear, "torus", &torus, 2),
        (Scheme::DooSabin, "torus", &torus, 2),
        (Scheme::Loop, "triangles", &triangles, 2),
    ] {
        let case = Case::new(scheme, name, control, level);
        for (name, start) in crates(scheme) {
            let about = |reason| format!("{} on {} with {name}: {reason}", case.name(), case.mesh);
            let row = start(&case).and_then(|theirs| row(&case, name, theirs, regime, runs));
            emit(row.map_err(about));
        }
    }
    Ok(())
}

type Start = fn(&Case) -> Result<Box<dyn Crate>, String>;

/// The crates that have a scheme.
fn crates(scheme: Scheme) -> Vec<(&'static str, Start)> {
    let port: (_, Start) = (PORT, |case| Ok(Box::new(Port::new(case)?)));
    let kernels: (_, Start) = (KERNELS, |case| Ok(Box::new(Kernels::new(case)?)));
    match scheme {
        Scheme::CatmullClark | Scheme::Loop => vec![port, kernels],
        Scheme::Bilinear => vec![port],
        Scheme::DooSabin => vec![kernels],
        _ => vec![],
    }
}

/// A crate's ordinary call, whose result can be copied.
trait Crate: Side {
    fn version(&self) -> &'static str;
    fn mesh(&self) -> Result<PeerMesh, String>;
}

fn row(
    case: &Case,
    name: &str,
    mut theirs: Box<dyn Crate>,
    regime: Regime,
    runs: u32,
) -> Result<Row, String> {
    let given: Given = case.given(Boundary::default())?;
    let ours = mesh(&given.answer(&Context::serial())?);
    theirs.prepare()?;
    theirs.call()?;
    let comparison = Comparison::through_adjacency(&ours, &theirs.mesh()?);
    theirs.clear();
    let faces = ours.sizes.len() as u64;
    drop(ours);
    let version = theirs.version().into();
    let fresh = regime != Regime::ReUsed;
    let (context, buffers) = (Context::serial(), Buffers::new(true));
    let taken = if fresh {
        turns::fresh(&mut [&mut Fresh::new(&given), &mut Trimmed(theirs)], runs)?
    } else {
        let mut ours = ReUsed::new(&given, &context, &buffers);
        turns::warmed(&mut [&mut ours, &mut *theirs], runs, heap::cpu_seconds)?
    };
    Ok(Row {
        peer: name.into(),
        peer_version: version,
        regime: regime.name().into(),
        ours_call: if fresh { "refine" } else { "refine_into" }.into(),
        peer_call: case.scheme.name().into(),
        ..Row::new(case, faces, &taken[0], &taken[1]).compared(&comparison)
    })
}

/// A crate's call from memory that nobody has touched.
struct Trimmed(Box<dyn Crate>);

impl Side for Trimmed {
    fn prepare(&mut self) -> Result<(), String> {
        self.0.prepare()?;
        heap::trim();
        Ok(())
    }

    fn call(&mut self) -> Result<(), String> {
        self.0.call()
    }

    fn clear(&mut self) {
        self.0.clear();
    }
}

fn points(control: &Control) -> Vec<[f32; 3]> {
    let (points, _) = control.positions.as_chunks::<3>();
    points.iter().map(|point| point.map(|x| x as f32)).collect()
}

fn doubles(points: &[[f32; 3]]) -> Vec<f64> {
    points.as_flattened().iter().map(|&x| f64::from(x)).collect()
}

/// opensubdiv-rs: levels refined, and positions level by level.
struct Port {
    sizes: Vec<usize>,
    indices: Vec<u32>,
    positions: Vec<[f32; 3]>,
    scheme: sdc::SchemeType,
    level: usize,
    refiner: Option<TopologyRefiner>,
    result: Vec<[f32; 3]>,
}

impl Port {
    fn new(case: &Case) -> Result<Self, String> {
        Ok(Self {
            sizes: case.control.sizes.iter().map(|&n| n as usize).collect(),
            indices: case.control.indices.clone(),
            positions: points(&case.control),
            scheme: match case.scheme {
                Scheme::CatmullClark => sdc::SchemeType::Catmark,
                Scheme::Loop => sdc::SchemeType::Loop,
                Scheme::Bilinear => sdc::SchemeType::Bilinear,
                _ => return Err("the crate does not have it".into()),
            },
            level: case.level as usize,
            refiner: None,
            result: vec![],
        })
    }
}

impl Side for Port {
    fn prepare(&mut self) -> Result<(), String> {
        let mesh = TopologyDescriptor::new(self.positions.len(), &self.sizes, &self.indices);
        let options = sdc::Options {
            vtx_boundary_interpolation: sdc::VtxBoundaryInterpolation::EdgeAndCorner,
            ..sdc::Options::default()
        };
        let refiner = TopologyRefinerFactory::create(mesh, self.scheme, options);
        self.refiner = Some(refiner.map_err(|e| e.to_string())?);
        Ok(())
    }

    fn call(&mut self) -> Result<(), String> {
        let refiner = self.refiner.as_mut().ok_or("not prepared")?;
        refiner.refine_uniform(UniformOptions::new(self.level));
        let primvars = PrimvarRefiner::new(refiner);
        let mut values = vec![];
        for level in 1..=self.level {
            let mut next = vec![[0.0; 3]; refiner.level(level).num_vertices()];
            let last = if level == 1 { &self.positions } else { &values };
            primvars.interpolate(level, last, &mut next);
            values = next;
        }
        self.result = values;
        Ok(())
    }

    fn clear(&mut self) {
        self.refiner = None;
        self.result = vec![];
    }
}

impl Crate for Port {
    fn version(&self) -> &'static str {
        "0.5.0"
    }

    fn mesh(&self) -> Result<PeerMesh, String> {
        let level = self.refiner.as_ref().ok_or("no result")?.level(self.level);
        let mut mesh = PeerMesh { positions: doubles(&self.result), ..PeerMesh::default() };
        for face in 0..level.num_faces() {
            let vertices = level.face_vertices(face);
            mesh.sizes.push(vertices.len() as u32);
            mesh.indices.extend_from_slice(vertices);
        }
        Ok(mesh)
    }
}

/// subdiv-kernels: topology and a table for each level, and positions through the tables.
struct Kernels {
    refiner: subdiv_kernels::Refiner,
    levels: NonZeroU8,
    positions: Vec<[f32; 3]>,
    result: Option<(RefinementResult, Vec<[f32; 3]>)>,
}

impl Kernels {
    fn new(case: &Case) -> Result<Self, String> {
        let control = &case.control;
        let mut edges = BTreeSet::new();
        for face in control.faces() {
            let next = face.iter().cycle().skip(1);
            edges.extend(face.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]));
        }
        let mesh = subdiv_kernels::Mesh {
            vertex_count: control.vertices() as u32,
            face_vertex_counts: control.sizes.clone(),
            face_vertex_indices: control.indices.clone(),
            edge_creases: vec![0.0; edges.len()],
            edge_vertices: edges.into_iter().collect(),
            vertex_corners: vec![0.0; control.vertices()],
        };
        let scheme = match case.scheme {
            Scheme::CatmullClark => subdiv_kernels::Scheme::CatmullClark,
            Scheme::Loop => subdiv_kernels::Scheme::Loop,
            Scheme::DooSabin => subdiv_kernels::Scheme::DooSabin,
            _ => return Err("the crate does not have it".into()),
        };
        let options = SchemeOptions {
            boundary_interpolation: BoundaryInterpolation::EdgesAndCorners,
            ..SchemeOptions::default()
        };
        let refiner = subdiv_kernels::Refiner::new(mesh, scheme, options);
        let levels = u8::try_from(case.level).ok().and_then(NonZeroU8::new);
        Ok(Self {
            refiner: refiner.map_err(|e| e.to_string())?,
            levels: levels.ok_or("levels are 1 to 255")?,
            positions: points(control),
            result: None,
        })
    }
}

impl Side for Kernels {
    fn call(&mut self) -> Result<(), String> {
        let request = UniformRefine::from(self.levels);
        let refined = self.refiner.refine_uniform(&request).map_err(|e| e.to_string())?;
        let positions = refined.interpolate(&self.positions);
        self.result = Some((refined, positions));
        Ok(())
    }

    fn clear(&mut self) {
        self.result = None;
    }
}

impl Crate for Kernels {
    fn version(&self) -> &'static str {
        "0.1.0"
    }

    fn mesh(&self) -> Result<PeerMesh, String> {
        let (refined, positions) = self.result.as_ref().ok_or("no result")?;
        Ok(PeerMesh {
            sizes: refined.topology.face_vertex_counts.clone(),
            indices: refined.topology.face_vertex_indices.clone(),
            positions: doubles(positions),
        })
    }
}
