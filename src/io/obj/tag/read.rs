//! Reads `t` statements.

use super::settle::last_of_each;
use super::{BOUNDARIES, CREASINGS, FACE_VARYING, TRIANGLES};
use crate::base::{Crease, Element, Error, ErrorKind, NONE, Result, SharpVertex};
use crate::io::lines::Words;
use crate::io::number::{float, integer};
use crate::io::place::{Place, quote};
use crate::io::{MeshFile, SchemeTags};

/// The tags of a file so far, each with its line: a tag may come before what it names.
#[derive(Debug, Default)]
pub(in crate::io::obj) struct Tags {
    creases: Vec<Crease>,
    crease_lines: Vec<u32>,
    sharp_vertices: Vec<SharpVertex>,
    sharp_lines: Vec<u32>,
    holes: Vec<u32>,
    hole_lines: Vec<u32>,
    scheme: SchemeTags,
}

/// The values of a statement, sorted by kind as its counts say.
struct Values<'w> {
    place: Place<'w>,
    integers: Vec<&'w [u8]>,
    numbers: Vec<&'w [u8]>,
    words: Vec<&'w [u8]>,
}

impl Tags {
    /// Reads what follows the `t`; false if the tag is none that is known.
    pub fn statement(&mut self, place: Place<'_>, mut words: Words<'_>) -> Result<bool> {
        let read = match words.next() {
            Some(b"crease") => Self::creases,
            Some(b"corner") => Self::corners,
            Some(b"hole") => Self::holes,
            Some(b"interpolateboundary") => Self::boundary,
            Some(b"facevaryinginterpolateboundary") => Self::face_varying,
            Some(b"creasemethod") => Self::creasing,
            Some(b"smoothtriangles") => Self::triangles,
            _ => return Ok(false),
        };
        read(self, &Values::new(place, words)?).map(|()| true)
    }

    fn creases(&mut self, values: &Values<'_>) -> Result<()> {
        let (vertices, sharpness) = (values.indices("vertex")?, values.sharpnesses()?);
        values.no_words()?;
        let edges = edges(&vertices, sharpness.len()).ok_or_else(|| {
            values.mismatch("a crease takes two vertices an edge, and one sharpness or one an edge")
        })?;
        for (i, edge) in edges.into_iter().enumerate() {
            if edge[0] == edge[1] {
                let reason = format!("a crease from vertex {} to itself", edge[0]);
                return Err(values.place.error(ErrorKind::InvalidTag, reason));
            }
            self.creases.push(Crease { vertices: edge, sharpness: at(&sharpness, i) });
            self.crease_lines.push(values.place.line_number());
        }
        Ok(())
    }

    fn corners(&mut self, values: &Values<'_>) -> Result<()> {
        let (vertices, sharpness) = (values.indices("vertex")?, values.sharpnesses()?);
        values.no_words()?;
        if vertices.is_empty() || ![1, vertices.len()].contains(&sharpness.len()) {
            return Err(values.mismatch("corners take one sharpness or one a vertex"));
        }
        for (i, vertex) in vertices.into_iter().enumerate() {
            self.sharp_vertices.push(SharpVertex { vertex, sharpness: at(&sharpness, i) });
            self.sharp_lines.push(values.place.line_number());
        }
        Ok(())
    }

    fn holes(&mut self, values: &Values<'_>) -> Result<()> {
        let faces = values.indices("face")?;
        values.no_words()?;
        if faces.is_empty() || !values.numbers.is_empty() {
            return Err(values.mismatch("holes take faces alone"));
        }
        self.hole_lines.extend(faces.iter().map(|_| values.place.line_number()));
        self.holes.extend(faces);
        Ok(())
    }

    fn boundary(&mut self, values: &Values<'_>) -> Result<()> {
        self.scheme.boundary = Some(values.choice(&BOUNDARIES)?);
        Ok(())
    }

    fn face_varying(&mut self, values: &Values<'_>) -> Result<()> {
        self.scheme.face_varying = Some(values.choice(&FACE_VARYING)?);
        Ok(())
    }

    fn creasing(&mut self, values: &Values<'_>) -> Result<()> {
        self.scheme.creasing = Some(values.word(&CREASINGS)?);
        Ok(())
    }

    fn triangles(&mut self, values: &Values<'_>) -> Result<()> {
        self.scheme.triangles = Some(values.word(&TRIANGLES)?);
        Ok(())
    }

    /// Moves the tags into the mesh, whose elements are all known now.
    pub fn finish(mut self, name: &str, mesh: &mut MeshFile) -> Result<()> {
        self.check(name, mesh.positions.len(), mesh.face_sizes.len())?;
        let ends = |crease: &Crease| {
            let [a, b] = crease.vertices;
            [a.min(b), a.max(b)]
        };
        let same = |a: f32, b: f32| a.to_bits() == b.to_bits();
        let agree = |a: &Crease, b: &Crease| same(a.sharpness, b.sharpness);
        let creases = last_of_each(&mut self.creases, ends, agree);
        let agree = |a: &SharpVertex, b: &SharpVertex| same(a.sharpness, b.sharpness);
        let vertices = last_of_each(&mut self.sharp_vertices, |sharp| sharp.vertex, agree);
        last_of_each(&mut self.holes, |&face| face, |_, _| true);
        for (n, what) in [(creases, "creases"), (vertices, "corner tags")] {
            if n > 0 {
                mesh.notes.push(format!("{n} {what} were replaced by later ones"));
            }
        }
        (mesh.creases, mesh.sharp_vertices) = (self.creases, self.sharp_vertices);
        (mesh.holes, mesh.scheme) = (self.holes, self.scheme);
        Ok(())
    }

    fn check(&self, name: &str, vertices: usize, faces: usize) -> Result<()> {
        let place = |line: u32| Place::line(name, u64::from(line));
        for (crease, &line) in self.creases.iter().zip(&self.crease_lines) {
            for vertex in crease.vertices {
                place(line).in_tag("vertex", vertex, vertices)?;
            }
        }
        for (sharp, &line) in self.sharp_vertices.iter().zip(&self.sharp_lines) {
            place(line).in_tag("vertex", sharp.vertex, vertices)?;
        }
        let mut holes = self.holes.iter().zip(&self.hole_lines);
        holes.try_for_each(|(&face, &line)| place(line).in_tag("face", face, faces))
    }
}

impl<'w> Values<'w> {
    fn new(place: Place<'w>, mut words: Words<'w>) -> Result<Self> {
        let header = words.next().unwrap_or_default();
        let Some(counts) = counts(header) else {
            return Err(place.unexpected(header, "a triple of counts such as 2/1/0"));
        };
        let mut rest: Vec<&[u8]> = words.take_while(|word| word[0] != b'#').collect();
        let promised = counts.iter().fold(0_usize, |sum, &n| sum.saturating_add(n));
        if rest.len() != promised {
            let (shown, found) = (quote(header), rest.len());
            let reason = format!("a tag of {shown} takes {promised} values, {found} follow");
            return Err(place.syntax(reason));
        }
        let words = rest.split_off(counts[0] + counts[1]);
        let numbers = rest.split_off(counts[0]);
        Ok(Self { place, integers: rest, numbers, words })
    }

    fn indices(&self, what: &str) -> Result<Vec<u32>> {
        self.integers.iter().map(|word| self.index(word, what)).collect()
    }

    fn index(&self, word: &[u8], what: &str) -> Result<u32> {
        let Some(written) = integer(word) else {
            return Err(self.place.unexpected(word, &format!("a {what} of a tag")));
        };
        let index = u32::try_from(written).ok().filter(|&index| index != NONE);
        index.ok_or_else(|| {
            let reason = format!("a tag names {what} {written}: tags count from 0");
            self.place.error(ErrorKind::IndexOutOfRange, reason)
        })
    }

    fn sharpnesses(&self) -> Result<Vec<f32>> {
        self.numbers.iter().map(|word| sharpness(self.place, word)).collect()
    }

    fn no_words(&self) -> Result<()> {
        if self.words.is_empty() { Ok(()) } else { Err(self.mismatch("this tag takes no words")) }
    }

    /// One integer that is a place in a list.
    fn choice<T: Copy>(&self, all: &[T]) -> Result<T> {
        let ([word], [], []) = (&self.integers[..], &self.numbers[..], &self.words[..]) else {
            return Err(self.mismatch("this tag takes one integer"));
        };
        let choice = integer(word).and_then(|i| all.get(usize::try_from(i).ok()?));
        choice.copied().ok_or_else(|| {
            self.place.unexpected(word, &format!("a number from 0 to {}", all.len() - 1))
        })
    }

    /// One word of a list.
    fn word<T: Copy>(&self, all: &[(&str, T); 2]) -> Result<T> {
        let ([], [], [word]) = (&self.integers[..], &self.numbers[..], &self.words[..]) else {
            return Err(self.mismatch("this tag takes one word"));
        };
        let known = all.iter().find(|(name, _)| name.as_bytes() == *word);
        known.map(|&(_, value)| value).ok_or_else(|| {
            let [(first, _), (second, _)] = all;
            self.place.unexpected(word, &format!("{first} or {second}"))
        })
    }

    #[cold]
    fn mismatch(&self, rule: &str) -> Error {
        let [i, f, s] = [&self.integers, &self.numbers, &self.words].map(Vec::len);
        self.place.syntax(format!("a tag of '{i}/{f}/{s}': {rule}"))
    }
}

impl Place<'_> {
    /// Refuses an index of a tag that is not below the count.
    fn in_tag(self, what: &str, index: u32, count: usize) -> Result<()> {
        if (index as usize) < count {
            return Ok(());
        }
        let element = match what {
            "face" => Element::Face(u64::from(index)),
            _ => Element::Vertex(u64::from(index)),
        };
        let reason =
            format!("a tag names {what} {index}, but the file has {count} (tags count from 0)");
        Err(self.error(ErrorKind::IndexOutOfRange, reason).with_elements([element]))
    }
}

/// The three counts of `i/f/s`.
fn counts(word: &[u8]) -> Option<[usize; 3]> {
    let mut parts = word.split(|&b| b == b'/').map(|digits| integer(digits)?.try_into().ok());
    let counts = [parts.next()??, parts.next()??, parts.next()??];
    parts.next().is_none().then_some(counts)
}

/// The edges that the vertices stand for, if the number of sharpnesses fits: pairs,
/// or else a chain.
fn edges(vertices: &[u32], sharpnesses: usize) -> Option<Vec<[u32; 2]>> {
    let n = vertices.len();
    if n >= 2 && n.is_multiple_of(2) && [1, n / 2].contains(&sharpnesses) {
        return Some(vertices.as_chunks().0.to_vec());
    }
    let is_chain = n >= 2 && (sharpnesses == n - 1 || sharpnesses == 1);
    is_chain.then(|| vertices.windows(2).map(|pair| [pair[0], pair[1]]).collect())
}

/// The sharpness of an edge or vertex: its own, or the one for all.
fn at(sharpnesses: &[f32], i: usize) -> f32 {
    sharpnesses[if sharpnesses.len() == 1 { 0 } else { i }]
}

fn sharpness(place: Place<'_>, word: &[u8]) -> Result<f32> {
    let wide = float(place, word)?;
    if wide < 0.0 {
        let reason = format!("the sharpness {} is negative", quote(word));
        return Err(place.error(ErrorKind::InvalidTag, reason));
    }
    // Not by way of a double, which would round twice.
    let single = std::str::from_utf8(word).ok().and_then(|text| text.parse::<f32>().ok());
    single.filter(|value| value.is_finite()).ok_or_else(|| {
        let reason = format!("the sharpness {} is too large for single precision", quote(word));
        place.error(ErrorKind::Overflow, reason)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_three_whole_numbers() {
        assert_eq!(counts(b"2/1/0"), Some([2, 1, 0]));
        for bad in ["", "2", "2/1", "2/1/0/0", "-1/1/0", "2//0", "a/1/0"] {
            assert_eq!(counts(bad.as_bytes()), None, "{bad}");
        }
    }

    #[test]
    fn vertices_are_pairs_or_a_chain() {
        let two = Some(vec![[0, 1], [2, 3]]);
        assert_eq!(edges(&[0, 1, 2, 3], 1), two);
        assert_eq!(edges(&[0, 1, 2, 3], 2), two);
        assert_eq!(edges(&[0, 1, 2, 3], 3), Some(vec![[0, 1], [1, 2], [2, 3]]));
        assert_eq!(edges(&[0, 1, 2], 1), Some(vec![[0, 1], [1, 2]]));
        assert_eq!(edges(&[0, 1, 2], 2), Some(vec![[0, 1], [1, 2]]));
        for (vertices, sharpnesses) in [(0, 1), (1, 1), (1, 0), (2, 0), (2, 2), (4, 4), (3, 3)] {
            assert_eq!(edges(&vec![7; vertices], sharpnesses), None, "{vertices}/{sharpnesses}");
        }
    }
}
