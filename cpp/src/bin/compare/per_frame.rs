//! New positions on a topology that is ready, as every frame of an animation needs them.

use carvel::{Context, Hierarchy, Records, RecordsMut, StencilTable, StencilTask};
use carvel_peers::{
    Boundary, Comparison, OpenSubdiv, Peer, Precision, Scheme, Stencils, Task, heap,
};

use crate::buffers::Buffers;
use crate::cases::{self, Case};
use crate::matched::{Matched, mesh};
use crate::part::Emit;
use crate::regime::Regime;
use crate::row::Row;
use crate::sides::{ReUsed, Side};
use crate::turns::{self, Taken};

/// A table applied is a short call: so many more are timed.
const FRAMES: u32 = 5;

/// All rows.
pub fn run(runs: u32, emit: Emit) -> Result<(), String> {
    for case in [
        Case::new(Scheme::CatmullClark, "cow", &cases::cow()?, 4),
        Case::new(Scheme::CatmullClark, "torus", &cases::torus(), 3),
        Case::new(Scheme::Loop, "triangles", &cases::triangles(), 3),
    ] {
        match rows(&case, runs) {
            Ok(rows) => rows.into_iter().for_each(|row| emit(Ok(row))),
            Err(reason) => emit(Err(format!("{} on {}: {reason}", case.name(), case.mesh))),
        }
    }
    Ok(())
}

fn rows(case: &Case, runs: u32) -> Result<Vec<Row>, String> {
    let task = Task::new(&case.control, case.scheme, Precision::Single);
    let given = case.given(Boundary::default())?;
    let context = Context::serial();
    let mut make = Make::new(case)?;
    make.call()?;
    let table = make.table.take().ok_or("no table was made")?;
    let buffers = Buffers::new(false);
    let mut refine = ReUsed::new(&given, &context, &buffers);
    let mut apply = Apply::new(&table, &given.positions, &context);
    let mut levels = Update(Stencils::by_levels(&task, case.level)?);
    let mut update = Update(Stencils::of_level(&task, case.level)?);
    for side in [&mut apply as &mut dyn Side, &mut refine, &mut levels, &mut update] {
        side.call()?;
    }
    let matched = Matched::new(&task, case.level, mesh(&given.answer(&context)?))?;
    let theirs = [&levels, &update];
    let compared = compared(matched, [&apply.out, &buffers.borrow().positions], theirs)?;
    let bytes = [table.bytes() as f64, update.0.bytes() as f64];
    let frame = Frame { case, rows: table.rows() as u64, bytes };

    let sides: &mut [&mut dyn Side] = &mut [&mut apply, &mut refine, &mut levels, &mut update];
    let taken = turns::warmed(sides, FRAMES * runs, heap::cpu_seconds)?;
    let mut rows = Vec::new();
    for (i, comparison) in compared.iter().enumerate() {
        let (ours, peer) = (i / 2, i % 2);
        let calls = [["apply", "refine_into"][ours], ["PrimvarRefiner", "UpdateValues"][peer]];
        let tables = [ours == 0, peer == 1];
        let task = if tables == [true; 2] { "stencil-apply" } else { "positions" };
        rows.push(frame.row(task, calls, tables, comparison, [&taken[ours], &taken[2 + peer]]));
    }
    let taken = turns::warmed(&mut [&mut make, &mut Create(update.0)], runs, heap::cpu_seconds)?;
    let calls = ["stencils", "StencilTableFactory"];
    // What was compared is what these tables make.
    rows.push(frame.row("stencil-create", calls, [true; 2], &compared[1], [&taken[0], &taken[1]]));
    Ok(rows)
}

/// Each of ours with each of theirs.
fn compared(
    mut matched: Matched,
    ours: [&Vec<f32>; 2],
    theirs: [&Update; 2],
) -> Result<Vec<Comparison>, String> {
    let pairs = ours.into_iter().flat_map(|ours| theirs.map(|theirs| (ours, theirs)));
    let one = |(ours, theirs): (&Vec<f32>, &Update)| {
        Ok(matched.compare_positions(ours, theirs.0.positions()?))
    };
    pairs.map(one).collect()
}

/// What the rows of a case have in common.
struct Frame<'a> {
    case: &'a Case,
    rows: u64,
    /// Of our table and of theirs.
    bytes: [f64; 2],
}

impl Frame<'_> {
    /// A row; `tables` says which of the calls have one.
    fn row(
        &self,
        task: &str,
        calls: [&str; 2],
        tables: [bool; 2],
        comparison: &Comparison,
        taken: [&Taken; 2],
    ) -> Row {
        let bytes = |side: usize| tables[side].then(|| self.bytes[side] / self.rows as f64);
        Row {
            peer: OpenSubdiv.name().into(),
            peer_version: OpenSubdiv.version(),
            regime: Regime::ReUsed.name().into(),
            task: task.into(),
            unit: "vertex".into(),
            ours_call: calls[0].into(),
            peer_call: calls[1].into(),
            ours_table_bytes: bytes(0),
            peer_table_bytes: bytes(1),
            ..Row::new(self.case, self.rows, taken[0], taken[1]).compared(comparison)
        }
    }
}

/// carvel's composed table of a level, made from a hierarchy.
pub struct Make {
    hierarchy: Hierarchy,
    level: u32,
    /// The table, once made.
    pub table: Option<StencilTable<f32>>,
}

impl Make {
    /// Builds the levels before the last, which is all that rows need.
    pub fn new(case: &Case) -> Result<Self, String> {
        let given = case.given(Boundary::default())?;
        let before = case.level - 1;
        let hierarchy = Hierarchy::new(&Context::serial(), given.mesh, given.scheme, before);
        let hierarchy = hierarchy.map_err(|e| e.to_string())?;
        Ok(Self { hierarchy, level: case.level, table: None })
    }
}

impl Side for Make {
    fn call(&mut self) -> Result<(), String> {
        let table = self.hierarchy.stencils(&Context::serial(), &StencilTask::level(self.level));
        self.table = Some(table.map_err(|e| e.to_string())?);
        Ok(())
    }

    fn clear(&mut self) {
        self.table = None;
    }
}

/// carvel's table applied.
pub struct Apply<'a> {
    table: &'a StencilTable<f32>,
    positions: &'a [f32],
    context: &'a Context,
    /// xyz of every row.
    pub out: Vec<f32>,
}

impl<'a> Apply<'a> {
    /// With room for every row.
    pub fn new(table: &'a StencilTable<f32>, positions: &'a [f32], context: &'a Context) -> Self {
        Self { table, positions, context, out: vec![0.0; 3 * table.rows()] }
    }
}

impl Side for Apply<'_> {
    fn call(&mut self) -> Result<(), String> {
        let (values, out) = (Records::packed(self.positions, 3), &mut self.out);
        let applied = self.table.apply(self.context, values, RecordsMut::packed(out, 3));
        applied.map_err(|e| e.to_string())
    }
}

/// OpenSubdiv's rows computed, by its table or level by level.
struct Update(Stencils);

impl Side for Update {
    fn call(&mut self) -> Result<(), String> {
        self.0.update()
    }
}

/// OpenSubdiv's table of a level, made from a refiner.
struct Create(Stencils);

impl Side for Create {
    fn prepare(&mut self) -> Result<(), String> {
        self.0.clear();
        Ok(())
    }

    fn call(&mut self) -> Result<(), String> {
        self.0.create()
    }

    fn clear(&mut self) {
        self.0.clear();
    }
}
