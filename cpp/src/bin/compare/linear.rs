//! Large results beside a small one: the time and the memory of a face stay what they are.

use carvel::{Context, Refined, Refiner};
use carvel_peers::{Boundary, Scheme, shapes};
use std::time::Instant;

use crate::args::Args;
use crate::cases::Case;
use crate::part::Emit;
use crate::regime::Regime;
use crate::row::Row;
use crate::sides::{Fresh, Given, Side};
use crate::{memory, turns};

const LEVEL: u32 = 3;

/// Toruses that have about 1, 10, 50 and 100 million faces at the level.
const SIZES: [[u32; 2]; 4] = [[125, 125], [625, 250], [1250, 625], [1250, 1250]];

/// The most memory that the refused request may have.
const CEILING: u64 = 16 << 30;

/// All rows, and how a request is refused that cannot fit.
pub fn run(args: &Args, emit: Emit) -> Result<(), String> {
    let sizes = if args.large { &SIZES[..] } else { &SIZES[..3] };
    for scheme in [Scheme::CatmullClark, Scheme::DooSabin] {
        let case = |&[a, b]: &[u32; 2]| Case::new(scheme, "torus", &shapes::torus(a, b), LEVEL);
        let cases: Vec<_> = sizes.iter().map(case).collect();
        match rows(&cases, args.runs) {
            Ok(rows) => rows.into_iter().for_each(|row| emit(Ok(row))),
            Err(reason) => emit(Err(format!("{} on toruses: {reason}", scheme.name()))),
        }
        let last = case(&SIZES[2]).given(Boundary::default())?;
        emit(Err(format!("{}: {}", scheme.name(), refused(&last)?)));
    }
    Ok(())
}

fn rows(cases: &[Case], runs: u32) -> Result<Vec<Row>, String> {
    let given = |case: &Case| case.given(Boundary::default());
    let given: Vec<_> = cases.iter().map(given).collect::<Result<_, _>>()?;
    let mut faces = Vec::new();
    for given in &given {
        faces.push(checked(&given.answer(&Context::serial())?)?);
    }
    let mut sides: Vec<_> = given.iter().map(Fresh::new).collect();
    let mut sides: Vec<_> = sides.iter_mut().map(|side| side as &mut dyn Side).collect();
    let taken = turns::fresh(&mut sides, runs)?;
    // Bytes and times of the smallest are per face too.
    let scale = |i: usize| faces[0] as f64 / faces[i] as f64;
    let row = |i: usize| {
        let row = Row::new(&cases[i], faces[i], &taken[i], &taken[0]);
        Row {
            regime: Regime::Default.name().into(),
            peer_ns_per_face: row.peer_ns_per_face / scale(i),
            peer_cpu_ns_per_face: row.peer_cpu_ns_per_face / scale(i),
            peer_bytes_per_face: row.peer_bytes_per_face / scale(i),
            ratio: row.ratio / scale(i),
            ours_call: "refine".into(),
            peer_call: "refine, 1 M faces".into(),
            ..row.beside_carvel("carvel, 1 M faces")
        }
    };
    Ok((1..cases.len()).map(row).collect())
}

/// The number of faces, all of which are quads, four at every vertex, as on any torus.
fn checked(refined: &Refined<f32>) -> Result<u64, String> {
    let mut around = vec![0_u8; refined.positions.len() / 3];
    for &v in &refined.face_vertices {
        around[v as usize] = around[v as usize].saturating_add(1);
    }
    if refined.face_sizes.iter().all(|&n| n == 4) && around.iter().all(|&n| n == 4) {
        return Ok(refined.face_sizes.len() as u64);
    }
    Err("the answer is no torus of quads".into())
}

/// What is said to a request of 16 times as many faces, and how soon.
fn refused(given: &Given) -> Result<String, String> {
    let ceiling = memory::available()?.min(CEILING);
    let context = Context::builder().memory_ceiling(ceiling).build().map_err(|e| e.to_string())?;
    let level = LEVEL + 2;
    let task = carvel::Task::new(&given.mesh, &given.scheme, level, &given.positions);
    let start = Instant::now();
    let answer = Refiner::new().refine(&context, &task);
    let ms = 1e3 * start.elapsed().as_secs_f64();
    match answer {
        Err(error) => Ok(format!("level {level} is refused after {ms:.2} ms: {error}")),
        Ok(_) => Err(format!("level {level} is not refused at a ceiling of {ceiling} bytes")),
    }
}
