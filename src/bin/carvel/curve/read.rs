//! Control polygons from CSV and OBJ.

use super::number::{Number, Wrong};
use crate::args::PolygonFormat;
use crate::exit::{Doing, Exit, Failure};
use crate::session::Session;
use crate::text::{one_line, path_name};
use carvel::{Error, ErrorKind};
use std::fs::File;
use std::io::{Read, stdin};
use std::path::Path;

/// What a file holds.
#[derive(Debug)]
pub struct Polygons<T> {
    /// The polygons.
    pub list: Vec<Control<T>>,
    /// Coordinates of a point.
    pub width: usize,
    /// The first line of a CSV file, if it holds names.
    pub header: Option<String>,
}

/// One control polygon.
#[derive(Debug, Clone, PartialEq)]
pub struct Control<T> {
    /// All coordinates.
    pub points: Vec<T>,
    /// True if its file says that the first point follows the last.
    pub closed: bool,
}

/// Reads a file; - is the standard input.
///
/// # Errors
/// An input error naming the line, one of values for a coordinate that is not finite.
pub fn read<T: Number>(
    session: &Session,
    path: &Path,
    format: PolygonFormat,
) -> Result<Polygons<T>, Failure> {
    let name = path_name(path);
    session.console.phase("reading", &name);
    let failed = |e: &Error| Failure::from_error(e, Doing::Reading);
    let bytes = session.on_path(path, || bytes(session, path, &name)).map_err(|e| failed(&e))?;
    // Lists grow by doubling.
    let values = (fields_at_most(&bytes) * 2 * size_of::<T>()) as u64;
    session.context.check_memory(bytes.len() as u64 + values).map_err(|e| failed(&e))?;
    let text = String::from_utf8(bytes)
        .map_err(|_| Failure::new(Exit::Input, format!("{name}: not a text in UTF-8")))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let polygons = match format {
        PolygonFormat::Csv => csv(text),
        PolygonFormat::Obj => obj(text),
    };
    let polygons = polygons.map_err(|Mistake { exit, line, message }| {
        Failure::new(exit, format!("{name}: line {line}: {message}"))
    })?;
    if polygons.list.is_empty() {
        let missing = match format {
            PolygonFormat::Csv => "the file holds no points",
            PolygonFormat::Obj => "the file holds no lines (l)",
        };
        return Err(Failure::new(Exit::Mesh, format!("{name}: {missing}")));
    }
    Ok(polygons)
}

/// The bytes of a file, as long as they are below the ceiling and nobody wants to stop.
fn bytes(session: &Session, path: &Path, name: &str) -> carvel::Result<Vec<u8>> {
    const BLOCK: u64 = 1 << 20;
    let failed = |e| Error::io(name, e);
    let (mut input, total): (Box<dyn Read>, _) = if path.as_os_str() == "-" {
        (Box::new(stdin().lock()), None)
    } else {
        let file = File::open(path).map_err(failed)?;
        let size = file.metadata().ok().filter(std::fs::Metadata::is_file).map(|m| m.len());
        (Box::new(file), size)
    };
    let go_on = session.bytes_hook();
    let mut bytes = Vec::new();
    loop {
        session.context.check_memory((bytes.len() as u64).max(total.unwrap_or(0)))?;
        if !go_on(bytes.len() as u64, total) {
            return Err(Error::new(ErrorKind::Cancelled, "cancelled"));
        }
        if input.by_ref().take(BLOCK).read_to_end(&mut bytes).map_err(failed)? == 0 {
            return Ok(bytes);
        }
    }
}

/// No less than the fields of a text.
fn fields_at_most(text: &[u8]) -> usize {
    let is_mark = |c: &u8| c.is_ascii_whitespace() || matches!(c, b',' | b';');
    text.iter().filter(|c| is_mark(c)).count() + 1
}

/// A mistake in a line, counted from 1.
#[derive(Debug, PartialEq)]
struct Mistake {
    exit: Exit,
    line: usize,
    message: String,
}

fn mistake<T>(line: usize, message: impl Into<String>) -> Result<T, Mistake> {
    Err(Mistake { exit: Exit::Input, line, message: message.into() })
}

fn coordinate<T: Number>(field: &str, line: usize) -> Result<T, Mistake> {
    T::read(field).map_err(|wrong| {
        let shown: String = field.chars().take(40).collect();
        let shown = one_line(&shown);
        match wrong {
            Wrong::Text => {
                Mistake { exit: Exit::Input, line, message: format!("'{shown}' is not a number") }
            }
            Wrong::Value => Mistake {
                exit: Exit::Values,
                line,
                message: format!("the coordinate {shown} is not finite, or too large"),
            },
        }
    })
}

/// Lines with their numbers, comments taken off.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let bare = |line: &'_ str| line.find('#').map_or(line.len(), |at| at);
    (1..).zip(text.lines()).map(move |(n, line)| (n, &line[..bare(line)]))
}

/// The fields of a line, set apart by commas, semicolons, tabs or blanks.
fn fields(line: &str) -> Vec<&str> {
    let marks = [',', ';', '\t'];
    match marks.into_iter().find(|&mark| line.contains(mark)) {
        Some(mark) => line.split(mark).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}

/// True for what nobody means as a number, in no precision: a header's field.
fn is_word(field: &str) -> bool {
    let starts_number = |c: char| c.is_ascii_digit() || "+-.".contains(c);
    !field.starts_with(starts_number) && <f64 as Number>::read(field) == Err(Wrong::Text)
}

/// A point in each line; an empty line, but none with a comment, ends a polygon. A first line
/// without any number is a header.
fn csv<T: Number>(text: &str) -> Result<Polygons<T>, Mistake> {
    let mut found = Polygons { list: Vec::new(), width: 0, header: None };
    let mut open = false;
    for ((n, line), whole) in lines(text).zip(text.lines()) {
        if line.trim().is_empty() {
            open &= !whole.trim().is_empty();
            continue;
        }
        let fields = fields(line);
        if found.width == 0 {
            if found.header.is_none() && fields.iter().all(|field| is_word(field)) {
                found.header = Some(line.trim().to_owned());
                continue;
            }
            found.width = fields.len();
        }
        if fields.len() != found.width {
            let (here, before) = (fields.len(), found.width);
            return mistake(n, format!("{here} coordinates, after points of {before}"));
        }
        if !open {
            found.list.push(Control { points: Vec::new(), closed: false });
            open = true;
        }
        for field in fields {
            let value = coordinate(field, n)?;
            if let Some(polygon) = found.list.last_mut() {
                polygon.points.push(value);
            }
        }
    }
    Ok(found)
}

/// Vertices (v) and lines (l); two lines that end in a vertex of no other are one.
fn obj<T: Number>(text: &str) -> Result<Polygons<T>, Mistake> {
    let mut vertices: Vec<[T; 3]> = Vec::new();
    let mut chains: Vec<Vec<usize>> = Vec::new();
    for (n, line) in lines(text) {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let fields: Vec<_> = words.collect();
                let [x, y, z, ..] = fields[..] else {
                    return mistake(n, "a vertex has three coordinates");
                };
                vertices.push([coordinate(x, n)?, coordinate(y, n)?, coordinate(z, n)?]);
            }
            Some("l") => {
                let chain = words.map(|word| index(word, vertices.len(), n));
                let chain = chain.collect::<Result<Vec<_>, _>>()?;
                if chain.len() < 2 {
                    return mistake(n, "a line has two vertices at least");
                }
                chains.push(chain);
            }
            _ => {}
        }
    }
    let control = |chain: Vec<usize>| {
        let closed = chain.len() > 2 && chain.first() == chain.last();
        let used = &chain[..chain.len() - usize::from(closed)];
        let points = used.iter().flat_map(|&v| vertices[v].clone()).collect();
        Control { points, closed }
    };
    let list = joined(&chains, vertices.len()).into_iter().map(control).collect();
    Ok(Polygons { list, width: 3, header: None })
}

/// A vertex of a line: `3`, `-1`, `3/1`.
fn index(word: &str, vertices: usize, line: usize) -> Result<usize, Mistake> {
    let number = word.split('/').next().and_then(|word| word.parse::<i64>().ok());
    let number = match number {
        None => return mistake(line, format!("'{}' is not a vertex", one_line(word))),
        Some(n) if n < 0 => n + vertices as i64,
        Some(n) => n - 1,
    };
    let found = usize::try_from(number).ok().filter(|&v| v < vertices);
    found.map_or_else(|| mistake(line, format!("there is no vertex {} yet", one_line(word))), Ok)
}

/// Chains that meet in a vertex where no third one ends become one: programs write each
/// edge as a line of its own. In the order of their first parts.
fn joined(chains: &[Vec<usize>], vertices: usize) -> Vec<Vec<usize>> {
    const NONE: usize = usize::MAX;
    // The chain ends at each vertex, up to three.
    let mut ends = vec![[NONE; 3]; vertices];
    for (c, chain) in chains.iter().enumerate() {
        for &v in [chain.first(), chain.last()].into_iter().flatten() {
            if let Some(place) = ends[v].iter_mut().find(|place| **place == NONE) {
                *place = c;
            }
        }
    }
    let other = |v: usize, c: usize| match ends[v] {
        [a, b, NONE] if a != b && b != NONE => Some(if a == c { b } else { a }),
        _ => None,
    };
    let mut used = vec![false; chains.len()];
    let mut all = Vec::new();
    for start in 0..chains.len() {
        if used[start] {
            continue;
        }
        used[start] = true;
        let mut chain = chains[start].clone();
        for _ in 0..2 {
            let mut last = start;
            // From its end on; then from its beginning, turned round and back again.
            while let Some(next) = other(chain[chain.len() - 1], last).filter(|&c| !used[c]) {
                used[next] = true;
                let end = chain[chain.len() - 1];
                let part = &chains[next];
                if part[0] == end {
                    chain.extend_from_slice(&part[1..]);
                } else {
                    chain.extend(part[..part.len() - 1].iter().rev());
                }
                last = next;
            }
            chain.reverse();
        }
        all.push(chain);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str) -> Vec<Vec<f64>> {
        csv::<f64>(text).unwrap().list.into_iter().map(|control| control.points).collect()
    }

    #[test]
    fn csv_takes_all_usual_marks_headers_and_comments() {
        for text in ["0,1\n2,3\n", "0;1\n2;3", "x\ty\n0\t1\n2\t3", "# c\n 0   1 # d\r\n#\n2 3"] {
            assert_eq!(points(text), [[0.0, 1.0, 2.0, 3.0]], "{text}");
        }
        assert_eq!(points("0,1\n\n\n2,3\n4,5"), [vec![0.0, 1.0], vec![2.0, 3.0, 4.0, 5.0]]);
        assert_eq!(csv::<f64>("x,y\n1/2,1e2").unwrap().header.as_deref(), Some("x,y"));
        assert_eq!(points("x\n1/2\n1e2"), [[0.5, 100.0]]);
        assert!(points("# nothing\n\n").is_empty());
    }

    #[test]
    fn csv_names_the_line_of_a_mistake() {
        for (text, line, exit) in [
            ("1,2\n3", 2, Exit::Input),
            ("1,2\n3,", 2, Exit::Input),
            ("1,2\nx,y", 2, Exit::Input),
            ("a\nb\n1", 2, Exit::Input),
            ("1\nnan", 2, Exit::Values),
            ("\n1\n\n1e999", 4, Exit::Values),
        ] {
            let found = csv::<f64>(text).unwrap_err();
            assert_eq!((found.line, found.exit), (line, exit), "{text}: {}", found.message);
        }
        assert_eq!(csv::<f32>("1e39").unwrap_err().exit, Exit::Values);
    }

    #[test]
    fn lines_of_an_obj_are_chains_of_edges() {
        let v = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\n";
        let chains = |lines: &str| {
            let found = obj::<f64>(&format!("{v}{lines}")).unwrap();
            let first =
                |c: Control<f64>| (c.points.chunks(3).map(|p| p[0]).collect::<Vec<_>>(), c.closed);
            found.list.into_iter().map(first).collect::<Vec<_>>()
        };
        assert_eq!(chains("l 1 2 -1"), [(vec![0.0, 1.0, 3.0], false)]);
        assert_eq!(chains("l 1 2 3 1"), [(vec![0.0, 1.0, 2.0], true)]);
        assert_eq!(chains("l 2 3\nl 2 1\nl 4/4 3"), [(vec![0.0, 1.0, 2.0, 3.0], false)]);
        assert_eq!(chains("l 2 3\nl 1 2\nl 1 3"), [(vec![1.0, 2.0, 0.0], true)]);
        // Three that meet stay apart.
        assert_eq!(chains("l 1 2\nl 3 2\nl 2 4").len(), 3);
        assert_eq!(chains("l 1 2\nl 1 2"), [(vec![0.0, 1.0], true)]);
    }

    #[test]
    fn an_obj_names_the_line_of_a_mistake() {
        for (text, line) in [
            ("v 0 0", 1),
            ("v 0 0 0\nl 1 2", 2),
            ("v 0 0 0\nv 1 0 0\nl 1 0", 3),
            ("v 0 0 0\nl 1", 2),
            ("v 0 0 0\nl x 1", 2),
        ] {
            assert_eq!(obj::<f64>(text).unwrap_err().line, line, "{text}");
        }
    }
}
