//! Words of a text whose line breaks mean little, with the line of each.

use super::lines::{Lines, Words};
use super::number;
use super::place::Place;
use super::watch::Watch;
use crate::base::Result;
use std::io::BufRead;

/// A stream of words. [`seek`](Self::seek) goes to the next, [`take`](Self::take)
/// takes it.
pub(super) struct Stream<'a, R> {
    lines: Lines<'a, R>,
    at: usize,
    end: usize,
    comments: bool,
}

impl<'a, R: BufRead> Stream<'a, R> {
    /// With `comments`, everything from a `#` to the end of its line is skipped.
    pub fn new(reader: R, name: &'a str, watch: Watch<'a>, comments: bool) -> Self {
        Self { lines: Lines::new(reader, name, watch), at: 0, end: 0, comments }
    }

    /// Goes to the next word, on whatever line; false at the end of the file.
    #[inline]
    pub fn seek(&mut self) -> Result<bool> {
        while !self.on_word() {
            if !self.lines.advance()? {
                return Ok(false);
            }
            let text = self.lines.text();
            let hash = self.comments.then(|| text.iter().position(|&b| b == b'#')).flatten();
            self.at = 0;
            self.end = hash.unwrap_or(text.len());
        }
        Ok(true)
    }

    /// True if the current line has another word.
    #[inline]
    pub fn on_word(&self) -> bool {
        !Words::new(self.left()).is_empty()
    }

    /// The next word of the current line; empty if there is none.
    #[inline]
    pub fn take(&mut self) -> &[u8] {
        let end = self.end;
        let mut words = Words::new(&self.lines.text()[self.at..end]);
        let word = words.next().unwrap_or_default();
        self.at = end - words.len();
        word
    }

    /// The rest of the current line without blanks at its ends.
    pub fn take_line(&mut self) -> &[u8] {
        let at = std::mem::replace(&mut self.at, self.end);
        self.lines.text()[at..self.end].trim_ascii()
    }

    /// The number of words left on the current line.
    pub fn words_left(&self) -> usize {
        Words::new(self.left()).count()
    }

    /// The next word as a number; `None` at the end of the file.
    #[inline]
    pub fn number(&mut self) -> Result<Option<f64>> {
        if !self.seek()? {
            return Ok(None);
        }
        let place = self.place();
        number::float(place, self.take()).map(Some)
    }

    /// The current line.
    pub fn place(&self) -> Place<'a> {
        self.lines.place()
    }

    /// Reports the end to the progress hook.
    pub fn finish(&mut self) -> Result<()> {
        self.lines.finish()
    }

    fn left(&self) -> &[u8] {
        &self.lines.text()[self.at..self.end]
    }
}
