//! The command `stencils`.

use crate::args::{Chosen, MatrixFormat, NumberType, StencilArgs};
use crate::exit::{Doing, Exit, Failure};
use crate::input::Input;
use crate::matrix::{self, Entry};
use crate::session::Session;
use crate::text::{counted, path_name};
use crate::topology::Asked;
use crate::{atomic, faults, places, report, tags};
use carvel::mesh::Built;
use carvel::{Context, Hierarchy, Interpolation, Result as Made, StencilTable, StencilTask};
use serde_json::{Value, json};
use std::time::Instant;

/// What became of the matrix.
struct Done {
    chosen: Chosen,
    rows: usize,
    columns: usize,
    entries: usize,
    notes: Vec<String>,
    seconds: f64,
}

/// Makes one matrix.
pub fn run(args: &StencilArgs) -> Result<Exit, Failure> {
    let format = args.check()?;
    places::require_parent(&args.output)?;
    let quiet = args.quiet || args.json && places::is_stream(&args.output);
    let session = Session::new(args.threads, args.memory, quiet)?;
    let result = match args.precision {
        NumberType::F32 => make::<f32>(args, format, &session),
        NumberType::F64 => make::<f64>(args, format, &session),
    };
    session.console.clear();
    let exit = match &result {
        Ok(done) => {
            tell(args, &session, done);
            Exit::Success
        }
        Err(failure) => session.console.failure(failure),
    };
    if args.json {
        let document = report::document(&described(args, format, &session, &result));
        if places::is_stream(&args.output) {
            session.console.line(document.trim_end());
        } else {
            report::print(&document)?;
        }
    }
    Ok(exit)
}

fn make<T: Entry>(
    args: &StencilArgs,
    format: MatrixFormat,
    session: &Session,
) -> Result<Done, Failure> {
    let start = Instant::now();
    let input = Input::read(session, &args.input, args.input_format)?;
    input.require_faces()?;
    let chosen = args.scheme.choose(input.file.scheme)?;
    session.console.phase("building", &input.name);
    let asked =
        Asked { anchored: args.anchored, non_manifold: args.non_manifold, creases: &args.creases };
    let built = asked.build_for(session, &input, &chosen)?;
    let mut notes = input.file.notes.clone();
    if !chosen.has_features() {
        notes.extend(tags::ignored(&input.file, &chosen.name));
    }
    session.console.phase("weighing", &input.name);
    let table = table::<T>(args, &session.context, &chosen, built, input.file.positions.len());
    let table = table.map_err(|e| faults::of_work(&input, &e))?;
    session.refuse_if_cancelled()?;
    session.console.phase("writing", &path_name(&args.output));
    let written = session.on_path(&args.output, || {
        atomic::write_with(&args.output, |mut out| matrix::write(&table, format, &mut out))
    });
    written.map_err(|e| Failure::from_error(&e, Doing::Writing))?;
    Ok(Done {
        chosen,
        rows: table.rows(),
        columns: table.columns(),
        entries: table.entries(),
        notes,
        seconds: start.elapsed().as_secs_f64(),
    })
}

fn table<T: Entry>(
    args: &StencilArgs,
    context: &Context,
    chosen: &Chosen,
    built: Built,
    vertices: usize,
) -> Made<StencilTable<T>> {
    let Built { mesh, vertex_source, .. } = built;
    let before = args.levels.saturating_sub(1);
    let hierarchy = Hierarchy::new(context, mesh, chosen.scheme.clone(), before)?;
    let task = StencilTask {
        from: if args.step { before } else { 0 },
        to: args.levels,
        interpolation: if args.varying { Interpolation::Varying } else { Interpolation::Vertex },
        vertices: args.vertices.as_deref(),
    };
    let table = hierarchy.stencils(context, &task)?;
    // Where the mesh was cut open, copies of a vertex go back to one column.
    match vertex_source {
        Some(source) if task.from == 0 => {
            let offsets: Vec<u64> = (0..=source.len() as u64).collect();
            let ones = vec![T::from_f64(1.0); source.len()];
            StencilTable::new(vertices, &offsets, source, ones)?.compose(context, &table)
        }
        _ => Ok(table),
    }
}

fn tell(args: &StencilArgs, session: &Session, done: &Done) {
    let input = path_name(&args.input);
    for note in &done.notes {
        session.console.note(&format!("{input}: {note}"));
    }
    if !args.json {
        let (rows, weights) =
            (counted(done.rows as u64, "row"), counted(done.entries as u64, "weight"));
        let (columns, scheme) = (counted(done.columns as u64, "column"), &done.chosen.name);
        let seconds = done.seconds;
        session.console.summary(&format!(
            "{input}: {rows} on {columns}, {weights} ({scheme}) in {seconds:.2} s"
        ));
    }
}

fn described(
    args: &StencilArgs,
    format: MatrixFormat,
    session: &Session,
    result: &Result<Done, Failure>,
) -> Value {
    let mut report = json!({
        "input": args.input.display().to_string(),
        "output": args.output.display().to_string(),
        "format": format.name(),
        "levels": args.levels,
        "step": args.step,
        "interpolation": if args.varying { "varying" } else { "vertex" },
        "precision": args.precision.name(),
        "threads": session.context.threads(),
    });
    match result {
        Ok(done) => {
            report["scheme"] = report::scheme(&done.chosen);
            report["rows"] = json!(done.rows);
            report["columns"] = json!(done.columns);
            report["entries"] = json!(done.entries);
            report["seconds"] = json!(done.seconds);
            report["notes"] = json!(done.notes);
        }
        Err(failure) => report["error"] = report::error(failure),
    }
    report
}
