//! Two threads beside one, on the wall's clock.

use carvel::{Context, Refined};
use carvel_peers::{Boundary, Scheme};
use std::hint::black_box;
use std::sync::LazyLock;
use std::time::Instant;

use crate::buffers::Buffers;
use crate::cases::{self, Case};
use crate::part::Emit;
use crate::per_frame::{Apply, Make};
use crate::regime::Regime;
use crate::row::Row;
use crate::sides::{ReUsed, Side};
use crate::turns;

const THREADS: usize = 2;

/// The one that the other stands beside.
const PEER: &str = "carvel, 1 thread";

/// All rows: refinements to a million faces and more, and a table of half a million rows.
pub fn run(runs: u32, emit: Emit) -> Result<(), String> {
    let context = |n| Context::builder().threads(n).build().map_err(|e| e.to_string());
    let contexts = [context(THREADS)?, context(1)?];
    let (torus, triangles) = (cases::torus(), cases::triangles());
    for case in [
        Case::new(Scheme::CatmullClark, "torus", &torus, 3),
        Case::new(Scheme::DooSabin, "torus", &torus, 3),
        Case::three_point("torus", &torus, 3),
        Case::new(Scheme::Loop, "triangles", &triangles, 3),
    ] {
        let about =
            |reason| format!("{} on {}, {THREADS} threads: {reason}", case.name(), case.mesh);
        emit(refinement(&case, &contexts, runs).map_err(about));
    }
    let case = Case::new(Scheme::CatmullClark, "torus", &torus, 2);
    let about = |reason| format!("stencils on {}, {THREADS} threads: {reason}", case.mesh);
    emit(application(&case, &contexts, runs).map_err(about));
    Ok(())
}

fn seconds() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

fn refinement(case: &Case, contexts: &[Context; 2], runs: u32) -> Result<Row, String> {
    let given = case.given(Boundary::default())?;
    let [two, one] = contexts;
    let refined = given.answer(two)?;
    let faces = refined.face_sizes.len() as u64;
    if !same_bytes(&refined, &given.answer(one)?) {
        return Err("the bytes differ".into());
    }
    drop(refined);
    let buffers = [Buffers::new(true), Buffers::new(true)];
    let (mut ours, mut peer) =
        (ReUsed::new(&given, two, &buffers[0]), ReUsed::new(&given, one, &buffers[1]));
    let taken = turns::warmed(&mut [&mut ours, &mut peer], runs, seconds)?;
    Ok(Row {
        regime: Regime::ReUsed.name().into(),
        threads: THREADS as u32,
        ours_call: "refine_into".into(),
        peer_call: "refine_into".into(),
        ..Row::new(case, faces, &taken[0], &taken[1]).beside_carvel(PEER)
    })
}

fn same_bytes(a: &Refined<f32>, b: &Refined<f32>) -> bool {
    a.face_sizes == b.face_sizes
        && a.face_vertices == b.face_vertices
        && same_bits(&a.positions, &b.positions)
}

fn same_bits(a: &[f32], b: &[f32]) -> bool {
    let bits = |x: &f32| x.to_bits();
    a.iter().map(bits).eq(b.iter().map(bits))
}

fn application(case: &Case, contexts: &[Context; 2], runs: u32) -> Result<Row, String> {
    let positions = case.given(Boundary::default())?.positions;
    let mut make = Make::new(case)?;
    make.call()?;
    let table = make.table.take().ok_or("no table was made")?;
    drop(make);
    let (mut ours, mut peer) = (
        Apply::new(&table, &positions, &contexts[0]),
        Apply::new(&table, &positions, &contexts[1]),
    );
    ours.call()?;
    peer.call()?;
    if !same_bits(&ours.out, &peer.out) {
        return Err("the bytes differ".into());
    }
    let bytes = table.bytes() + 4 * (positions.len() + ours.out.len()) as u64;
    let mut copy = Copy::new(bytes as usize / 2);
    let taken = turns::warmed(&mut [&mut ours, &mut peer, &mut copy], runs, seconds)?;
    let rows = table.rows() as u64;
    let table_bytes = Some(table.bytes() as f64 / rows as f64);
    let speed = |seconds: f64| Some(1e-9 * bytes as f64 / seconds);
    Ok(Row {
        regime: Regime::ReUsed.name().into(),
        threads: THREADS as u32,
        task: "stencil-apply".into(),
        unit: "vertex".into(),
        ours_call: "apply".into(),
        peer_call: "apply".into(),
        ours_table_bytes: table_bytes,
        peer_table_bytes: table_bytes,
        ours_gb_per_s: speed(taken[0].time()),
        copy_gb_per_s: speed(taken[2].time()),
        ..Row::new(case, rows, &taken[0], &taken[1]).beside_carvel(PEER)
    })
}

/// Half of the bytes that something reads and writes, copied to another place.
struct Copy {
    from: Vec<u8>,
    to: Vec<u8>,
}

impl Copy {
    fn new(bytes: usize) -> Self {
        Self { from: vec![1; bytes], to: vec![0; bytes] }
    }
}

impl Side for Copy {
    fn call(&mut self) -> Result<(), String> {
        let len = self.from.len().div_ceil(THREADS);
        std::thread::scope(|scope| {
            for (from, to) in self.from.chunks(len).zip(self.to.chunks_mut(len)) {
                scope.spawn(|| to.copy_from_slice(from));
            }
        });
        black_box(&mut self.to);
        Ok(())
    }
}
