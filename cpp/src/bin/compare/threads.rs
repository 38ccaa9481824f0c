//! Two threads beside one, on the wall's clock.
//!
//! Where the system puts threads that wake is not ours to say, and some systems, above all in
//! virtual machines, keep those that sleep often on one processor while another is free. So
//! all is measured twice, as the system has it and with each thread held on a processor of its
//! own, beside what two bare threads gain there.

use carvel::{Context, Refined};
use carvel_peers::{Boundary, Scheme};
use std::hint::black_box;
use std::sync::LazyLock;
use std::thread::ScopedJoinHandle;
use std::time::Instant;

use crate::buffers::Buffers;
use crate::cases::{self, Case};
use crate::part::Emit;
use crate::per_frame::{Apply, Make};
use crate::processors;
use crate::regime::Regime;
use crate::row::Row;
use crate::sides::{ReUsed, Side};
use crate::turns::{self, Taken};

const THREADS: usize = 2;

/// The one that the other stands beside.
const PEER: &str = "carvel, 1 thread";

/// Calls of one side that follow each other. A processor that had nothing to do while the other
/// side ran is slow for the first.
const CALLS: u32 = 5;

/// Both contexts, and where the threads of the first are.
struct Setting<'a> {
    contexts: &'a [Context; 2],
    /// A processor for each, or wherever the system puts them.
    held: Option<&'a [usize]>,
    runs: u32,
}

impl Setting<'_> {
    /// A call's name for the table.
    fn call(&self, name: &str) -> String {
        format!("{name}{}", if self.held.is_some() { ", held" } else { "" })
    }

    /// Sides in turns, each some calls long, of which the median counts.
    fn taken(&self, sides: &mut [&mut dyn Side]) -> Result<Vec<Taken>, String> {
        turns::several(sides, self.runs, CALLS, seconds)
    }
}

/// All rows: refinements to a million faces and more, and a table of half a million rows.
pub fn run(runs: u32, emit: Emit) -> Result<(), String> {
    let processors = match processors::allowed(THREADS) {
        Ok(processors) => processors,
        Err(reason) => {
            emit(Err(format!("SKIPPED: {reason}")));
            return Ok(());
        }
    };
    let [free, held] = processors::gain(&processors, runs, seconds)?;
    emit(Err(format!(
        "two bare threads count {free:.2} times as fast as one where the system puts them, \
         {held:.2} times each held on a processor of its own"
    )));
    let context = |n| Context::builder().threads(n).build().map_err(|e| e.to_string());
    let contexts = &[context(THREADS)?, context(1)?];
    rows(&Setting { contexts, held: None, runs }, emit);
    processors::hold_ours(&processors)?;
    rows(&Setting { contexts, held: Some(&processors), runs }, emit);
    Ok(())
}

fn rows(setting: &Setting, emit: Emit) {
    let (torus, triangles) = (cases::torus(), cases::triangles());
    for case in [
        Case::new(Scheme::CatmullClark, "torus", &torus, 3),
        Case::new(Scheme::DooSabin, "torus", &torus, 3),
        Case::three_point("torus", &torus, 3),
        Case::new(Scheme::Loop, "triangles", &triangles, 3),
    ] {
        let about =
            |reason| format!("{} on {}, {THREADS} threads: {reason}", case.name(), case.mesh);
        emit(refinement(&case, setting).map_err(about));
    }
    let case = Case::new(Scheme::CatmullClark, "torus", &torus, 2);
    let about = |reason| format!("stencils on {}, {THREADS} threads: {reason}", case.mesh);
    emit(application(&case, setting).map_err(about));
}

fn seconds() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

fn refinement(case: &Case, setting: &Setting) -> Result<Row, String> {
    let given = case.given(Boundary::default())?;
    let [two, one] = setting.contexts;
    let refined = given.answer(two)?;
    let faces = refined.face_sizes.len() as u64;
    if !same_bytes(&refined, &given.answer(one)?) {
        return Err("the bytes differ".into());
    }
    drop(refined);
    let buffers = [Buffers::new(true), Buffers::new(true)];
    let (mut ours, mut peer) =
        (ReUsed::new(&given, two, &buffers[0]), ReUsed::new(&given, one, &buffers[1]));
    let taken = setting.taken(&mut [&mut ours, &mut peer])?;
    Ok(Row {
        regime: Regime::ReUsed.name().into(),
        threads: THREADS as u32,
        ours_call: setting.call("refine_into"),
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

fn application(case: &Case, setting: &Setting) -> Result<Row, String> {
    let positions = case.given(Boundary::default())?.positions;
    let mut make = Make::new(case)?;
    make.call()?;
    let table = make.table.take().ok_or("no table was made")?;
    drop(make);
    let (mut ours, mut peer) = (
        Apply::new(&table, &positions, &setting.contexts[0]),
        Apply::new(&table, &positions, &setting.contexts[1]),
    );
    ours.call()?;
    peer.call()?;
    if !same_bits(&ours.out, &peer.out) {
        return Err("the bytes differ".into());
    }
    let bytes = table.bytes() + 4 * (positions.len() + ours.out.len()) as u64;
    let mut copy = Copy::new(bytes as usize / 2, setting.held);
    let taken = setting.taken(&mut [&mut ours, &mut peer, &mut copy])?;
    let rows = table.rows() as u64;
    let table_bytes = Some(table.bytes() as f64 / rows as f64);
    let speed = |seconds: f64| Some(1e-9 * bytes as f64 / seconds);
    Ok(Row {
        regime: Regime::ReUsed.name().into(),
        threads: THREADS as u32,
        task: "stencil-apply".into(),
        unit: "vertex".into(),
        ours_call: setting.call("apply"),
        peer_call: "apply".into(),
        ours_table_bytes: table_bytes,
        peer_table_bytes: table_bytes,
        ours_gb_per_s: speed(taken[0].time()),
        copy_gb_per_s: speed(taken[2].time()),
        ..Row::new(case, rows, &taken[0], &taken[1]).beside_carvel(PEER)
    })
}

/// Half of the bytes that something reads and writes, copied to another place.
struct Copy<'a> {
    from: Vec<u8>,
    to: Vec<u8>,
    held: Option<&'a [usize]>,
}

impl<'a> Copy<'a> {
    fn new(bytes: usize, held: Option<&'a [usize]>) -> Self {
        Self { from: vec![1; bytes], to: vec![0; bytes], held }
    }
}

impl Side for Copy<'_> {
    fn call(&mut self) -> Result<(), String> {
        let (held, len) = (self.held, self.from.len().div_ceil(THREADS));
        let parts = self.from.chunks(len).zip(self.to.chunks_mut(len)).enumerate();
        let copied = std::thread::scope(|scope| {
            let mut threads = Vec::new();
            for (i, (from, to)) in parts {
                threads.push(scope.spawn(move || {
                    held.map_or(Ok(()), |it| processors::hold(None, it[i]))?;
                    to.copy_from_slice(from);
                    Ok(())
                }));
            }
            let end = |thread: ScopedJoinHandle<_>| {
                thread.join().map_err(|_| "a copying thread panicked")?
            };
            threads.into_iter().try_for_each(end)
        });
        black_box(&mut self.to);
        copied
    }
}
