//! One task on both sides, and every way in which the answers can differ.

use carvel_peers::lineage::match_refinement;
use carvel_peers::{
    Boundary, Comparison, Control, OpenSubdiv, Options, Precision, Scheme, Task, ours,
};

/// What did not agree, to be told all at once.
#[derive(Default)]
pub struct Failures(Vec<String>);

impl Failures {
    /// Compares both answers to a task at a level.
    pub fn compare(&mut self, task: &Task, level: u32, what: &str) {
        if let Err(reason) = agree(task, level) {
            let Task { scheme, precision, options, .. } = task;
            self.0.push(format!(
                "{what}: {scheme:?} {precision:?} level {level} {options:?}: {reason}"
            ));
        }
    }

    /// Compares both precisions at levels 1 to `levels`.
    pub fn levels(
        &mut self,
        control: &Control,
        scheme: Scheme,
        options: Options,
        levels: u32,
        what: &str,
    ) {
        for precision in Precision::ALL {
            let task = Task { control, scheme, precision, options };
            for level in 1..=levels {
                self.compare(&task, level, what);
            }
        }
    }

    /// The same under every boundary rule.
    pub fn boundaries(&mut self, control: &Control, scheme: Scheme, levels: u32, what: &str) {
        for boundary in Boundary::ALL {
            let options = Options { boundary, ..Options::default() };
            self.levels(control, scheme, options, levels, what);
        }
    }

    /// Fails with everything that did not agree.
    pub fn check(self) {
        let some: Vec<_> = self.0.iter().take(40).map(String::as_str).collect();
        assert!(self.0.is_empty(), "{} differ:\n{}", self.0.len(), some.join("\n"));
    }
}

fn agree(task: &Task, level: u32) -> Result<(), String> {
    let ours = ours::refine(task, level)?;
    let refinement = OpenSubdiv.refinement(task, level)?;
    let (laid, at) = match_refinement(task, &refinement, level)?;
    if (&laid.level.sizes, &laid.level.indices) != (&ours.mesh.sizes, &ours.mesh.indices) {
        return Err("carvel does not number as documented".into());
    }
    Comparison::of(&ours.mesh, &refinement.mesh()?, &at).check(task.precision)?;
    let holes = refinement.level(level)?.holes;
    let differs =
        at.faces.iter().zip(&ours.holes).filter(|(g, hole)| holes[**g as usize] != **hole);
    match differs.count() {
        0 => Ok(()),
        n => Err(format!("{n} of {} faces are a hole on one side only", holes.len())),
    }
}
