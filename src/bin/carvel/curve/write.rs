//! Refined polygons and grids as CSV and OBJ.

use super::number::Number;
use carvel::curve::{Ends, Grid, Polygon};
use carvel::{Context, Error, ErrorKind, Result};
use std::io::Write;

/// Bytes that are handed on at once.
const PIECE: usize = 1 << 16;

/// Text on its way to a file.
pub struct Out<'a> {
    sink: &'a mut dyn Write,
    context: &'a Context,
    text: String,
}

impl<'a> Out<'a> {
    /// Text for a file.
    pub fn new(sink: &'a mut dyn Write, context: &'a Context) -> Self {
        Self { sink, context, text: String::new() }
    }

    fn line(&mut self, line: &str) -> Result<()> {
        self.text.push_str(line);
        self.text.push('\n');
        if self.text.len() > PIECE { self.flush() } else { Ok(()) }
    }

    /// Hands on what is left.
    ///
    /// # Errors
    /// Those of the file; [`ErrorKind::Cancelled`].
    pub fn flush(&mut self) -> Result<()> {
        if self.context.is_cancelled() {
            return Err(Error::new(ErrorKind::Cancelled, "cancelled"));
        }
        let written = self.sink.write_all(self.text.as_bytes());
        self.text.clear();
        written.map_err(|e| Error::io("polygons", e))
    }
}

fn joined<T: Number>(point: &[T], mark: &str) -> String {
    point.iter().map(Number::text).collect::<Vec<_>>().join(mark)
}

/// Rows of points, an empty line between them.
///
/// # Errors
/// Those of the file.
pub fn csv<'p, T: Number>(
    out: &mut Out,
    header: Option<&str>,
    rows: impl IntoIterator<Item = &'p [T]>,
    width: usize,
) -> Result<()> {
    header.map_or(Ok(()), |header| out.line(header))?;
    for (i, row) in rows.into_iter().enumerate() {
        if i > 0 {
            out.line("")?;
        }
        row.chunks_exact(width).try_for_each(|point| out.line(&joined(point, ",")))?;
    }
    Ok(())
}

/// The vertices of an OBJ file: three coordinates, 0 where there are fewer.
fn vertices<T: Number>(out: &mut Out, points: &[T], width: usize) -> Result<()> {
    for point in points.chunks_exact(width) {
        let mut all = [0.0; 3];
        all.iter_mut().zip(point).for_each(|(out, x)| *out = x.to_f64());
        if let Some(x) = all.iter().find(|x| !x.is_finite()) {
            let message = format!("a coordinate of a point is {x} as a number of OBJ");
            return Err(Error::new(ErrorKind::Overflow, message));
        }
        // Fractions are none of OBJ's numbers; single precision stays as short as it is.
        let text: Vec<_> = point
            .iter()
            .zip(all)
            .map(|(x, value)| match x.text() {
                text if text.contains('/') => value.text(),
                text => text,
            })
            .collect();
        let text = text.join(" ");
        out.line(&format!("v {text}{}", " 0".repeat(3_usize.saturating_sub(width))))?;
    }
    Ok(())
}

/// Polygons as lines.
///
/// # Errors
/// Those of the file.
pub fn obj_lines<T: Number>(out: &mut Out, polygons: &[Polygon<T>]) -> Result<()> {
    polygons.iter().try_for_each(|polygon| vertices(out, &polygon.points, polygon.width))?;
    let mut first = 1;
    for polygon in polygons {
        let closed = (polygon.ends == Ends::Closed).then_some(first);
        let all = (first..first + polygon.len()).chain(closed);
        let all: Vec<_> = all.map(|v| v.to_string()).collect();
        out.line(&format!("l {}", all.join(" ")))?;
        first += polygon.len();
    }
    Ok(())
}

/// A grid as quads.
///
/// # Errors
/// Those of the file.
pub fn obj_faces<T: Number>(out: &mut Out, grid: &Grid<T>) -> Result<()> {
    vertices(out, &grid.points, grid.width)?;
    let size = [grid.rows(), grid.columns];
    let faces = |k: usize| size[k] - usize::from(grid.ends[k] != Ends::Closed);
    let at = |row: usize, column: usize| (row % size[0]) * size[1] + column % size[1] + 1;
    for row in 0..faces(0) {
        for column in 0..faces(1) {
            let [a, b] = [at(row, column), at(row, column + 1)];
            let [c, d] = [at(row + 1, column + 1), at(row + 1, column)];
            out.line(&format!("f {a} {b} {c} {d}"))?;
        }
    }
    Ok(())
}
