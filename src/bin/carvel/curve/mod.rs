//! The command `curve`: polygons and grids, refined.
//!
//! | module | its one idea |
//! |---|---|
//! | `read`, `write` | control and refined polygons as files |
//! | `number` | coordinates as text |
//! | `rule` | what a step does |

mod number;
mod read;
mod rule;
mod write;

use crate::args::{CurveArgs, CurveFormat, CurveNumbers};
use crate::exit::{Doing, Exit, Failure};
use crate::plot::curve::Refined;
use crate::session::Session;
use crate::text::{counted, path_name};
use crate::{atomic, places, plot, report};
use carvel::curve::{CurveScheme, Ends, Grid, Polygon, Rational};
use carvel::{Error, ErrorKind};
use number::Number;
use read::{Control, Polygons};
use serde_json::{Value, json};
use std::time::Instant;

/// What was made.
enum Made<T> {
    /// Polygons, refined one by one.
    Polygons(Vec<Polygon<T>>),
    /// One grid.
    Grid(Grid<T>),
}

/// Points and ends, before and after, of a polygon or one direction of a grid.
type Counts = [(usize, Ends); 2];

/// What is told of a run.
struct Done {
    /// Of each polygon or direction.
    counts: Vec<Counts>,
    width: usize,
    notes: Vec<String>,
    seconds: f64,
}

/// Refines the polygons of a file.
pub fn run(args: &CurveArgs) -> Result<Exit, Failure> {
    let scheme = rule::scheme(args.source())?;
    let format = args.format()?;
    args.input_format()?;
    check(args, &scheme, format)?;
    places::require_parent(&args.output)?;
    let quiet = args.quiet || args.json && places::is_stream(&args.output);
    let session = Session::new(args.threads, args.memory, quiet)?;
    let run = Run { args, scheme: &scheme, format, session: &session };
    let result = match args.precision {
        CurveNumbers::F32 => run.one::<f32>(),
        CurveNumbers::F64 => run.one::<f64>(),
        CurveNumbers::Exact => run.one::<Rational>(),
    };
    session.console.clear();
    let exit = match &result {
        Ok(done) => {
            run.tell(done);
            Exit::Success
        }
        Err(failure) => session.console.failure(failure),
    };
    if args.json {
        let document = report::document(&run.described(&result));
        if places::is_stream(&args.output) {
            session.console.line(document.trim_end());
        } else {
            report::print(&document)?;
        }
    }
    Ok(exit)
}

/// Refuses options that do not go together.
fn check(args: &CurveArgs, scheme: &CurveScheme, format: CurveFormat) -> Result<(), Failure> {
    let picture = matches!(format, CurveFormat::Svg | CurveFormat::Png);
    if args.grid && picture {
        return Err(Failure::usage("pictures show polygons, not grids; write OBJ and preview it"));
    }
    if args.grid && args.limit {
        return Err(Failure::usage("--limit is for polygons, not for grids"));
    }
    if scheme.mask().is_some() {
        return Ok(());
    }
    if args.grid || args.limit {
        let option = if args.grid { "--grid" } else { "--limit" };
        let message = format!("{option} needs a mask, and {} has none", args.scheme);
        return Err(Failure::usage(message));
    }
    if args.precision == CurveNumbers::Exact {
        let message = format!("{} has roots in its rules, and no exact results", args.scheme);
        return Err(Failure::usage(message));
    }
    Ok(())
}

struct Run<'a> {
    args: &'a CurveArgs,
    scheme: &'a CurveScheme,
    format: CurveFormat,
    session: &'a Session,
}

impl Run<'_> {
    fn one<T: Number>(&self) -> Result<Done, Failure> {
        let start = Instant::now();
        let (args, session) = (self.args, self.session);
        let mut control = read::read::<T>(session, &args.input, args.input_format()?)?;
        let mut notes = self.notes(&mut control);
        let picture = matches!(self.format, CurveFormat::Svg | CurveFormat::Png);
        if picture && control.width > 2 {
            notes.push(format!("drawn are the first two of {} coordinates", control.width));
        }
        if self.format == CurveFormat::Obj && control.width > 3 {
            let message = format!("OBJ has 3 coordinates, the points have {}", control.width);
            return Err(Failure::usage(message));
        }
        session.console.phase("refining", &path_name(&args.input));
        let header = control.header.take();
        let width = control.width;
        let control: Vec<_> = control.list.into_iter().map(|c| self.polygon(c, width)).collect();
        let (made, counts) = if args.grid {
            self.grid(&control)?
        } else {
            let refined = control.iter().enumerate().map(|(i, polygon)| {
                let failed = |e| self.failed(&e, (control.len() > 1).then_some(i));
                self.refined(polygon).map_err(failed)
            });
            let refined = refined.collect::<Result<Vec<_>, _>>()?;
            let counts = control.iter().zip(&refined);
            let counts = counts.map(|(a, b)| [(a.len(), a.ends), (b.len(), b.ends)]).collect();
            (Made::Polygons(refined), counts)
        };
        session.refuse_if_cancelled()?;
        session.console.phase("writing", &path_name(&args.output));
        match (&made, self.format) {
            (Made::Polygons(refined), CurveFormat::Svg) => {
                self.draw(&control, refined, plot::Kind::Svg)?;
            }
            (Made::Polygons(refined), CurveFormat::Png) => {
                self.draw(&control, refined, plot::Kind::Png)?;
            }
            _ => self.write(&made, header.as_deref(), width)?,
        }
        Ok(Done { counts, width, notes, seconds: start.elapsed().as_secs_f64() })
    }

    /// What is to be said of the input, and done with it.
    fn notes<T: Number>(&self, control: &mut Polygons<T>) -> Vec<String> {
        let single = (!self.args.grid).then(|| note_single_places(control)).flatten();
        self.open_up(control).into_iter().chain(single).collect()
    }

    /// Takes the last points of closed polygons off that repeat the first, and says so. Single
    /// numbers may well come again, and so may points of a row of a grid, unless all rows do so.
    fn open_up<T: Number>(&self, control: &mut Polygons<T>) -> Option<String> {
        let width = control.width;
        let repeats = |polygon: &Control<T>| {
            let points = &polygon.points;
            let closed = self.args.ends(polygon.closed) == Ends::Closed;
            closed && points.len() > width && points[..width] == points[points.len() - width..]
        };
        if width == 1 || (self.args.grid && !control.list.iter().all(repeats)) {
            return None;
        }
        let mut repeated = 0;
        for polygon in control.list.iter_mut().filter(|polygon| repeats(polygon)) {
            polygon.points.truncate(polygon.points.len() - width);
            repeated += 1;
        }
        let what = counted(repeated, "closed polygon");
        let note = format!("left out the last point of {what}, which repeats the first");
        (repeated > 0).then_some(note)
    }

    fn polygon<T: Number>(&self, control: Control<T>, width: usize) -> Polygon<T> {
        let ends = self.args.ends(control.closed);
        let mut points = control.points;
        if control.closed && ends != Ends::Closed {
            // A closed line that is to be open ends where it begins.
            points.extend_from_within(..width);
        }
        Polygon::new(points, width, ends)
    }

    fn refined<T: Number>(&self, polygon: &Polygon<T>) -> carvel::Result<Polygon<T>> {
        let context = &self.session.context;
        let refined = self.scheme.refine(context, polygon, self.args.steps)?;
        if !self.args.limit {
            return Ok(refined);
        }
        rule::limit(context, self.scheme, &refined)?.ok_or_else(|| {
            Error::new(ErrorKind::Unsupported, "--limit: the mask is not proved to converge")
        })
    }

    fn grid<T: Number>(&self, rows: &[Polygon<T>]) -> Result<(Made<T>, Vec<Counts>), Failure> {
        let Some(mask) = self.scheme.mask() else {
            return Err(Failure::usage("--grid needs a mask"));
        };
        let (first, others) = rows.split_first().ok_or_else(|| Failure::usage("no rows"))?;
        if let Some(i) = others.iter().position(|row| row.len() != first.len()) {
            let (here, before) = (others[i].len(), first.len());
            let message = format!("row {} has {here} points, the rows before {before}", i + 2);
            let name = path_name(&self.args.input);
            return Err(Failure::new(Exit::Mesh, format!("{name}: {message}")));
        }
        let points = rows.iter().flat_map(|row| row.points.iter().cloned()).collect();
        let ends = [first.ends; 2];
        let grid = Grid { points, columns: first.len(), width: first.width, ends };
        let refined = grid.refine(&self.session.context, [mask, mask], self.args.steps);
        let refined = refined.map_err(|e| self.failed(&e, None))?;
        let counts = vec![
            [(grid.rows(), grid.ends[0]), (refined.rows(), refined.ends[0])],
            [(grid.columns, grid.ends[1]), (refined.columns, refined.ends[1])],
        ];
        Ok((Made::Grid(refined), counts))
    }

    /// An error of the library, with the polygon that it is about.
    fn failed(&self, error: &Error, polygon: Option<usize>) -> Failure {
        let mut failure = Failure::from_error(error, Doing::Working);
        if error.kind() == ErrorKind::LengthMismatch {
            failure.exit = Exit::Mesh;
        }
        if error.kind() != ErrorKind::Cancelled {
            let place = polygon.map_or(String::new(), |i| format!("polygon {}: ", i + 1));
            let name = path_name(&self.args.input);
            failure.message = format!("{name}: {place}{}", failure.message);
        }
        failure
    }

    fn write<T: Number>(
        &self,
        made: &Made<T>,
        header: Option<&str>,
        width: usize,
    ) -> Result<(), Failure> {
        let output = &self.args.output;
        let written = self.session.on_path(output, || {
            atomic::write_with(output, |sink| {
                let out = &mut write::Out::new(sink, &self.session.context);
                match (made, self.format) {
                    (Made::Polygons(list), CurveFormat::Obj) => write::obj_lines(out, list)?,
                    (Made::Grid(grid), CurveFormat::Obj) => write::obj_faces(out, grid)?,
                    (Made::Polygons(list), _) => {
                        write::csv(out, header, list.iter().map(|p| &p.points[..]), width)?;
                    }
                    (Made::Grid(grid), _) => {
                        let rows = grid.points.chunks_exact(grid.columns * width);
                        write::csv(out, header, rows, width)?;
                    }
                }
                out.flush()
            })
        });
        written.map_err(|e| Failure::from_error(&e, Doing::Writing))
    }

    fn draw<T: Number>(
        &self,
        control: &[Polygon<T>],
        refined: &[Polygon<T>],
        kind: plot::Kind,
    ) -> Result<(), Failure> {
        let shown = control.iter().zip(refined).map(|(control, refined)| {
            let limit = rule::limit(&self.session.context, self.scheme, control);
            let limit = limit.map_err(|e| self.failed(&e, None))?;
            Ok(Refined {
                control: in_the_plane(control),
                curve: in_the_plane(refined),
                limit: limit.map_or(Vec::new(), |limit| in_the_plane(&limit)),
            })
        });
        let shown = shown.collect::<Result<Vec<_>, Failure>>()?;
        let figure = plot::curve::figure(String::new(), &shown);
        plot::save(self.session, &self.args.output, kind, &figure)
    }

    fn tell(&self, done: &Done) {
        let input = path_name(&self.args.input);
        for note in &done.notes {
            self.session.console.note(&format!("{input}: {note}"));
        }
        if self.args.json {
            return;
        }
        let points = |side: usize| {
            let counts = done.counts.iter().map(|count| count[side].0 as u64);
            let total = if self.args.grid { counts.product() } else { counts.sum() };
            counted(total, "point")
        };
        let (before, after) = (points(0), points(1));
        let steps = counted(u64::from(self.args.steps), "step");
        let seconds = done.seconds;
        let summary = format!("{input}: {before} -> {after} ({steps}) in {seconds:.2} s");
        self.session.console.summary(&summary);
    }

    fn described(&self, result: &Result<Done, Failure>) -> Value {
        let args = self.args;
        let scheme = match self.scheme.mask() {
            Some(mask) => json!({
                "mask": mask.coefficients().iter().map(ToString::to_string).collect::<Vec<_>>(),
                "arity": mask.arity(),
                "offset": mask.offset(),
            }),
            None => json!({ "name": args.scheme }),
        };
        let mut report = json!({
            "input": args.input.display().to_string(),
            "output": args.output.display().to_string(),
            "format": self.format.name(),
            "scheme": scheme,
            "steps": args.steps,
            "limit": args.limit,
            "precision": args.precision.name(),
            "threads": self.session.context.threads(),
        });
        match result {
            Ok(done) => {
                let side = |(points, ends): (usize, Ends)| json!({ "points": points, "ends": ends.name() });
                let counts = done.counts.iter().map(|[control, refined]| {
                    json!({ "control": side(*control), "refined": side(*refined) })
                });
                let key = if args.grid { "directions" } else { "polygons" };
                report[key] = counts.collect();
                report["dimension"] = json!(done.width);
                report["seconds"] = json!(done.seconds);
                report["notes"] = json!(done.notes);
            }
            Err(failure) => report["error"] = report::error(failure),
        }
        report
    }
}

/// Polygons whose points are all at one place, where all schemes leave them. Single numbers are a
/// constant function.
fn note_single_places<T: Number>(control: &Polygons<T>) -> Option<String> {
    let width = control.width;
    let points = control.list.iter().map(|polygon| polygon.points.chunks_exact(width.max(1)));
    let is_single = |mut points: std::slice::ChunksExact<T>| {
        let first = points.next();
        first.is_some() && points.all(|point| Some(point) == first)
    };
    let count = points.filter(|points| is_single(points.clone())).count();
    let which = counted(count as u64, "polygon");
    let note = format!("in {which} all points are at one place, and so is what is refined");
    (width > 1 && count > 0).then_some(note)
}

/// Points in the plane; of one coordinate by their place. A closed polygon comes back.
fn in_the_plane<T: Number>(polygon: &Polygon<T>) -> Vec<[f64; 2]> {
    let closed = (polygon.ends == Ends::Closed).then_some(0);
    let all = (0..polygon.len()).chain(closed);
    let steps = polygon.len().saturating_sub(1).max(1) as f64;
    all.map(|i| match polygon.point(i) {
        [y] => [i as f64 / steps, y.to_f64()],
        [x, y, ..] => [x.to_f64(), y.to_f64()],
        [] => [0.0; 2],
    })
    .collect()
}
