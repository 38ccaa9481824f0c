//! Per-face names: objects, groups, materials, smoothing groups.

use crate::base::NONE;
use std::collections::HashMap;

/// A name per face, or none.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Labels {
    /// The distinct names, in order of first use.
    pub names: Vec<String>,
    /// Per face an index into `names`, or [`NONE`]. Empty if no face is named.
    pub of_face: Vec<u32>,
}

impl Labels {
    /// True if no face has a name.
    pub fn is_empty(&self) -> bool {
        self.of_face.is_empty()
    }

    /// The name of a face, if it has one.
    pub fn get(&self, face: usize) -> Option<&str> {
        let index = *self.of_face.get(face)?;
        self.names.get(index as usize).map(String::as_str)
    }
}

/// Builds [`Labels`] from statements that hold for all faces after them.
#[derive(Debug, Default)]
pub(super) struct LabelBuilder {
    labels: Labels,
    index: HashMap<String, u32>,
    current: u32,
    /// A name that no face has used yet; it gets a number only when one does.
    pending: Option<String>,
    unused: u64,
}

impl LabelBuilder {
    pub fn new() -> Self {
        Self { current: NONE, ..Self::default() }
    }

    /// All faces from here on carry `name`, or none if it is empty.
    pub fn set(&mut self, name: &str) {
        self.unused += u64::from(self.pending.take().is_some());
        if name.is_empty() {
            self.current = NONE;
        } else if let Some(&known) = self.index.get(name) {
            self.current = known;
        } else {
            self.pending = Some(name.to_owned());
        }
    }

    /// Labels face number `face`; the faces come in order.
    pub fn push_face(&mut self, face: usize) {
        if let Some(name) = self.pending.take() {
            self.current = self.labels.names.len() as u32;
            self.labels.names.push(name.clone());
            self.index.insert(name, self.current);
        }
        if self.current != NONE && self.labels.of_face.is_empty() {
            self.labels.of_face = vec![NONE; face];
        }
        if !self.labels.names.is_empty() {
            self.labels.of_face.push(self.current);
        }
    }

    /// The labels and the number of new names that no face followed.
    pub fn finish(self) -> (Labels, u64) {
        (self.labels, self.unused + u64::from(self.pending.is_some()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_before_the_first_name_have_none() {
        let mut builder = LabelBuilder::new();
        builder.push_face(0);
        builder.set("never used");
        builder.set("a");
        builder.push_face(1);
        builder.set("");
        builder.push_face(2);
        builder.set("a");
        builder.push_face(3);
        let (labels, unused) = builder.finish();
        assert_eq!(labels.names, ["a"]);
        assert_eq!(labels.of_face, [NONE, 0, NONE, 0]);
        assert_eq!(labels.get(1), Some("a"));
        assert_eq!(labels.get(2), None);
        assert_eq!(unused, 1);
    }
}
