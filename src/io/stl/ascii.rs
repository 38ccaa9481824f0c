//! Reads text STL. Keywords in either case; any number of solids.

use super::weld::Welder;
use crate::base::Result;
use crate::io::MeshFile;
use crate::io::labels::LabelBuilder;
use crate::io::place::Place;
use crate::io::stream::Stream;
use crate::io::watch::Watch;
use std::io::BufRead;

pub(super) fn read(reader: impl BufRead, name: &str, watch: Watch<'_>) -> Result<MeshFile> {
    let stream = Stream::new(reader, name, watch, false);
    let mut parser = Parser { stream, welder: Welder::default(), solids: LabelBuilder::new() };
    while parser.stream.seek()? {
        parser.solid()?;
    }
    parser.stream.finish()?;
    let (objects, unused) = parser.solids.finish();
    let mut mesh = parser.welder.finish();
    mesh.objects = objects;
    if unused > 0 {
        mesh.notes.push(format!("{unused} solids without facets were dropped"));
    }
    Ok(mesh)
}

struct Parser<'a, R> {
    stream: Stream<'a, R>,
    welder: Welder,
    solids: LabelBuilder,
}

impl<'a, R: BufRead> Parser<'a, R> {
    fn solid(&mut self) -> Result<()> {
        let place = self.keyword(&["solid"])?.0;
        let name = place.text(self.stream.take_line())?;
        self.solids.set(name);
        while let (place, 0) = self.keyword(&["facet", "endsolid"])? {
            self.facet(place)?;
        }
        // The name once more, or nothing.
        self.stream.take_line();
        Ok(())
    }

    fn facet(&mut self, place: Place<'a>) -> Result<()> {
        self.keyword(&["normal"])?;
        self.normal()?;
        self.keyword(&["outer"])?;
        self.keyword(&["loop"])?;
        let (mut triangle, mut places) = ([[0.0; 3]; 3], [place; 3]);
        for (position, place) in triangle.iter_mut().zip(&mut places) {
            *place = self.keyword(&["vertex"])?.0;
            for x in position {
                *x = self.number()?;
            }
        }
        self.keyword(&["endloop"])?;
        self.keyword(&["endfacet"])?;
        self.solids.push_face(self.welder.mesh.face_sizes.len());
        self.welder.triangle(place, triangle, places)
    }

    /// A normal is not kept, so that of a degenerate facet may well be NaN.
    fn normal(&mut self) -> Result<()> {
        for _ in 0..3 {
            if !self.stream.seek()? {
                return Err(self.stream.place().syntax("the file ends within a facet"));
            }
            let place = self.stream.place();
            let word = self.stream.take();
            let text = std::str::from_utf8(word).unwrap_or_default();
            if text.parse::<f64>().is_err() && !text.to_ascii_lowercase().contains("nan") {
                return Err(place.unexpected(word, "a number"));
            }
        }
        Ok(())
    }

    fn number(&mut self) -> Result<f64> {
        let number = self.stream.number()?;
        number.ok_or_else(|| self.stream.place().syntax("the file ends within a facet"))
    }

    /// Takes one of some keywords; which, and where it stands.
    fn keyword(&mut self, wanted: &[&str]) -> Result<(Place<'a>, usize)> {
        let some = self.stream.seek()?;
        let place = self.stream.place();
        let names = wanted.join(" or ");
        if !some {
            return Err(place.syntax(format!("the file ends where {names} is expected")));
        }
        let word = self.stream.take();
        let which = wanted.iter().position(|w| word.eq_ignore_ascii_case(w.as_bytes()));
        which.map(|which| (place, which)).ok_or_else(|| place.unexpected(word, &names))
    }
}
