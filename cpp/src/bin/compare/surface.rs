//! Points of the limit surface at random, with and without first derivatives.

use carvel::base::Scalar;
use carvel::limit::{Derivatives, Sample, Surface};
use carvel::{Context, Mesh};
use carvel_peers::{
    Control, OpenSubdiv, Patches, Peer, Place, Precision, Scheme, Task, heap, ours, shapes,
};

use crate::cases::{self, Case};
use crate::part::Emit;
use crate::regime::Regime;
use crate::row::Row;
use crate::sides::Side;
use crate::turns::{self, Taken};

/// Samples of a call.
const SAMPLES: usize = 1_000_000;
/// Levels that OpenSubdiv isolates features: beyond, its surface is another by 2⁻⁴ of a face.
const ISOLATION: u32 = 4;

/// All rows.
pub fn run(runs: u32, emit: Emit) -> Result<(), String> {
    for case in [
        Case::new(Scheme::CatmullClark, "torus", &cases::torus(), ISOLATION),
        Case::new(Scheme::CatmullClark, "cow", &cases::cow()?, ISOLATION),
        Case::new(Scheme::CatmullClark, "cube", &shapes::cube(), ISOLATION),
        Case::new(Scheme::Loop, "triangles", &cases::triangles(), ISOLATION),
        Case::new(Scheme::Loop, "icosahedron", &shapes::icosahedron(), ISOLATION),
    ] {
        let about = |reason| format!("{} on {}: {reason}", case.name(), case.mesh);
        let single: Vec<f32> = case.control.positions.iter().map(|&x| x as f32).collect();
        let double = &case.control.positions[..];
        let mut add = |rows: Result<Vec<Row>, String>| match rows {
            Ok(rows) => rows.into_iter().for_each(|row| emit(Ok(row))),
            Err(reason) => emit(Err(about(reason))),
        };
        add(rows(&case, Precision::Single, &single, Derivatives::First, runs));
        add(rows(&case, Precision::Double, double, Derivatives::First, runs));
        add(rows(&case, Precision::Double, double, Derivatives::None, runs));
    }
    Ok(())
}

/// Both ways of OpenSubdiv beside one call of ours.
fn rows<T: Scalar>(
    case: &Case,
    precision: Precision,
    positions: &[T],
    derivatives: Derivatives,
    runs: u32,
) -> Result<Vec<Row>, String> {
    let task = Task::new(&case.control, case.scheme, precision);
    let (surface, faces) = ours::surface(&task)?;
    let places = places(&case.control, surface.mesh(), &surface, &faces);
    let samples = ours::samples(&faces, &places);
    let out = vec![T::default(); 3 * derivatives.records() * samples.len()];
    let context = Context::serial();
    let mut ours =
        Evaluate { surface: &surface, context, samples: &samples, positions, derivatives, out };
    let records = derivatives.records() as u8;
    let mut far = Theirs { patches: Patches::far(&task, case.level)?, records };
    let mut bfr = Theirs { patches: Patches::bfr(&task, case.level)?, records };
    ours.call()?;
    let mut differences = Vec::new();
    for theirs in [&mut far, &mut bfr] {
        theirs.patches.place(&places)?;
        theirs.call()?;
        differences.push(difference(&ours.out, &theirs.patches.values()?, usize::from(records)));
    }
    let sides: &mut [&mut dyn Side] = &mut [&mut ours, &mut far, &mut bfr];
    let taken = turns::warmed(sides, runs, heap::cpu_seconds)?;
    let number = if precision == Precision::Single { "f32" } else { "f64" };
    let row = |way: usize| {
        let [mine, theirs]: [&Taken; 2] = [&taken[0], &taken[1 + way]];
        Row {
            peer: OpenSubdiv.name().into(),
            peer_version: OpenSubdiv.version(),
            regime: Regime::ReUsed.name().into(),
            task: ["surface", "surface-derivatives"][usize::from(records > 1)].into(),
            unit: "sample".into(),
            ours_call: format!("evaluate {number}, {records} records"),
            peer_call: ["PatchTable", "Bfr"][way].into(),
            max_difference: Some(differences[way]),
            same_counts: true,
            same_faces: true,
            ..Row::new(case, SAMPLES as u64, mine, theirs)
        }
    };
    Ok((0..2).map(row).collect())
}

/// Faces at random and points in them, always the same.
fn places(control: &Control, mesh: &Mesh, surface: &Surface, faces: &[u32]) -> Vec<Place> {
    let mut state = 1_u64;
    // 24 bits are numbers of single precision: both sides evaluate the same points.
    let mut bits = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        state >> 40
    };
    let triangles = control.is_triangles() && surface.sectors(0) == 1;
    let mut place = || {
        let mut below = |n: usize| ((bits() * n as u64) >> 24) as u32;
        let face = below(mesh.faces());
        let sectors = surface.sectors(faces[face as usize] as usize);
        let sector = below(sectors);
        let [mut u, mut v] = [bits(), bits()].map(|bits| bits as f64 / f64::from(1 << 24));
        if triangles && u + v > 1.0 {
            [u, v] = [1.0 - u, 1.0 - v];
        }
        Place { face, sector, uv: [u, v] }
    };
    (0..SAMPLES).map(|_| place()).collect()
}

/// The largest difference of positions, relative to the largest coordinate.
fn difference<T: Scalar>(ours: &[T], theirs: &[f64], records: usize) -> f64 {
    let (mut most, mut size) = (0.0_f64, 0.0_f64);
    for (a, b) in ours.chunks(3 * records).zip(theirs.chunks(3 * records)) {
        for (a, b) in a[..3].iter().zip(b) {
            most = most.max((a.to_f64() - b).abs());
            size = size.max(b.abs());
        }
    }
    most / size
}

/// carvel's surface at samples.
struct Evaluate<'a, T> {
    surface: &'a Surface,
    context: Context,
    samples: &'a [Sample],
    positions: &'a [T],
    derivatives: Derivatives,
    out: Vec<T>,
}

impl<T: Scalar> Side for Evaluate<'_, T> {
    fn call(&mut self) -> Result<(), String> {
        let (values, out) = (self.positions, &mut self.out);
        self.surface
            .evaluate(&self.context, self.samples, values, 3, self.derivatives, out)
            .map_err(|e| e.to_string())
    }
}

/// OpenSubdiv's patches, which hold the positions already, at the same samples.
struct Theirs {
    patches: Patches,
    records: u8,
}

impl Side for Theirs {
    fn call(&mut self) -> Result<(), String> {
        self.patches.evaluate(self.records)
    }
}
