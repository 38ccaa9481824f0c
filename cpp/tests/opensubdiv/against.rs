//! One task on both sides, and every way in which the answers can differ.

use carvel_peers::lineage::match_refinement;
use carvel_peers::{
    Boundary, Comparison, Control, Creasing, OpenSubdiv, Options, Precision, Scheme, Task,
    Triangles, ours, shapes,
};

/// What did not agree, to be told all at once.
#[derive(Default)]
pub struct Failures(Vec<String>);

impl Failures {
    /// Compares both answers to a task at a level.
    pub fn compare(&mut self, task: &Task, level: u32, what: &str) {
        if let Err(reason) = agree(task, task, level) {
            let Task { scheme, precision, options, .. } = task;
            self.0.push(format!(
                "{what}: {scheme:?} {precision:?} level {level} {options:?}: {reason}"
            ));
        }
    }

    /// Compares both precisions at levels 1 to `levels`, or deeper if
    /// `CARVEL_PEER_LEVELS` says so.
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
            for level in 1..=levels.max(asked()) {
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

/// The least number of levels that the environment asks for.
fn asked() -> u32 {
    let levels = std::env::var("CARVEL_PEER_LEVELS").ok();
    levels.map_or(0, |levels| levels.parse().expect("CARVEL_PEER_LEVELS is a number"))
}

/// Our answer to the first task against theirs to the second.
fn agree(mine: &Task, theirs: &Task, level: u32) -> Result<(), String> {
    let ours = ours::refine(mine, level)?;
    let refinement = OpenSubdiv.refinement(theirs, level)?;
    let (laid, at) = match_refinement(theirs, &refinement, level)?;
    if (&laid.level.sizes, &laid.level.indices) != (&ours.mesh.sizes, &ours.mesh.indices) {
        return Err("carvel does not number as documented".into());
    }
    Comparison::of(&ours.mesh, &refinement.mesh()?, &at).check(mine.precision)?;
    let holes = refinement.level(level)?.holes;
    let differs =
        at.faces.iter().zip(&ours.holes).filter(|(g, hole)| holes[**g as usize] != **hole);
    match differs.count() {
        0 => Ok(()),
        n => Err(format!("{n} of {} faces are a hole on one side only", holes.len())),
    }
}

/// Every option and tag, set on one side only, is seen: an agreement means something.
#[test]
fn a_difference_is_seen() {
    let plain = shapes::grid(4, 4).rounded();
    let line = plain.clone().creased(&[[6, 11], [11, 16]], 1.3).creased(&[[16, 21]], 3.0);
    let solid = shapes::icosahedron().rounded();
    let seen = |mine: &Task, theirs: &Task, what: &str| {
        assert!(agree(mine, theirs, 2).is_err(), "{what} is not seen");
        assert!(agree(theirs, theirs, 2).is_ok() && agree(mine, mine, 2).is_ok(), "{what}");
    };
    let task = |control| Task::new(control, Scheme::CatmullClark, Precision::Single);
    let with = |control, options| Task { options, ..task(control) };
    for boundary in [Boundary::None, Boundary::Edge] {
        let options = Options { boundary, ..Options::default() };
        seen(&task(&plain), &with(&plain, options), "a boundary rule");
    }
    let chaikin = Options { creasing: Creasing::Chaikin, ..Options::default() };
    seen(&task(&line), &with(&line, chaikin), "Chaikin creasing");
    let smooth = Options { triangles: Triangles::Smooth, ..Options::default() };
    seen(&task(&solid), &with(&solid, smooth), "the triangle rule");
    seen(&task(&plain), &task(&line), "a crease");
    let (sharp, holed) = (plain.clone().cornered(&[12], 0.3), plain.clone().holed(&[6]));
    seen(&task(&plain), &task(&sharp), "a sharp vertex");
    seen(&task(&plain), &task(&holed), "a hole");
    let mut moved = plain.clone();
    moved.positions[36] += 1e-3;
    seen(&task(&plain), &task(&moved), "a vertex moved by a thousandth");
}
