//! Every case under every scheme: one-shot and level by level, in both precisions, on
//! one thread and on two.

use std::ops::RangeInclusive;
use std::sync::OnceLock;

use carvel::base::Scalar;
use carvel::mesh::Built;
use carvel::{Boundary, Context, ErrorKind, Hierarchy, Prediction, Refined, Refiner, Result, Task};

use crate::accepted::{meshes, positions};
use crate::case::{Case, Outcome};
use crate::schemes::{Named, all};

const LEVELS: u32 = 2;
/// The cases are shared out among this many tests, to run side by side.
const GROUPS: usize = 4;

/// Two threads with so little work each that both get some of it.
pub fn two_threads() -> &'static Context {
    static CONTEXT: OnceLock<Context> = OnceLock::new();
    CONTEXT.get_or_init(|| Context::builder().threads(2).chunk(64).build().expect("two threads"))
}

/// A case under a scheme.
struct Run<'a> {
    what: String,
    hierarchy: &'a Hierarchy,
}

impl Run<'_> {
    /// Every level is sound and as large as predicted.
    fn check_levels(&self) {
        let (hierarchy, what) = (self.hierarchy, &self.what);
        let plan = Prediction::new(hierarchy.mesh(0), hierarchy.scheme(), LEVELS);
        let plan = plan.unwrap_or_else(|e| panic!("{what}: {e}"));
        for level in 0..=LEVELS {
            let mesh = hierarchy.mesh(level);
            mesh.validate().unwrap_or_else(|e| panic!("{what} level {level}: {e}"));
            let counts = plan.counts(level);
            let expected = [counts.vertices, counts.faces, counts.corners, counts.edges];
            let found = [mesh.vertices(), mesh.faces(), mesh.corners(), mesh.edges()];
            assert_eq!(found.map(|n| n as u64), expected, "{what} level {level}");
            let boundary = mesh.boundary_edges() as u64;
            assert_eq!(boundary, counts.boundary_edges, "{what} level {level}");
        }
    }

    /// Refines to levels, all at once and from the hierarchy, each on its threads:
    /// the two must not differ, nor may their failures.
    fn check_values<T: Scalar>(
        &self,
        positions: &[T],
        levels: RangeInclusive<u32>,
        [at_once, kept]: [&Context; 2],
    ) -> Result<()> {
        for level in levels {
            let refined = self.refine(at_once, level, positions);
            let mut values = vec![T::default(); 3 * self.hierarchy.mesh(level).vertices()];
            let done = self.hierarchy.refine(kept, level, positions, 3, &mut values);
            match (refined, done) {
                (Ok(refined), Ok(())) => self.check_level(level, &refined, &values),
                (Err(error), Err(other)) if error.kind() == other.kind() => return Err(error),
                (refined, done) => panic!("{}: {refined:?} differs from {done:?}", self.what),
            }
        }
        Ok(())
    }

    fn refine<T: Scalar>(&self, context: &Context, n: u32, positions: &[T]) -> Result<Refined<T>> {
        let task = Task::new(self.hierarchy.mesh(0), self.hierarchy.scheme(), n, positions);
        Refiner::new().refine(context, &Task { face_sources: true, ..task })
    }

    /// One-shot refinement gave the hierarchy's level, in sound numbers.
    fn check_level<T: Scalar>(&self, level: u32, refined: &Refined<T>, values: &[T]) {
        let (what, hierarchy) = (&self.what, self.hierarchy);
        let mesh = hierarchy.mesh(level);
        assert!(refined.positions.iter().all(|x| x.is_finite()), "{what} level {level}");
        assert!(mesh.face_sizes().eq(refined.face_sizes.iter().copied()), "{what} level {level}");
        assert_eq!(refined.face_vertices, mesh.corner_vertices(), "{what} level {level}");
        assert_eq!(refined.anchored, mesh.is_anchored(), "{what} level {level}");
        let mut sources = refined.face_sources.iter();
        assert!(sources.all(|&f| (f as usize) < hierarchy.mesh(0).faces()), "{what}: sources");
        assert_eq!(bits(values), bits(&refined.positions), "{what} level {level}");
    }
}

pub fn bits<T: Scalar>(values: &[T]) -> Vec<u64> {
    values.iter().map(|x| x.to_f64().to_bits()).collect()
}

/// What a case says of its coordinates; its topology was taken already.
fn expected<'c>(case: &'c Case, precision: &str) -> &'c Outcome {
    match case.special(precision).unwrap_or_else(|| case.expected("")) {
        Outcome::Error(kind) if kind != "NotFinite" => &Outcome::Ok,
        outcome => outcome,
    }
}

/// A case under a scheme: levels once, values in both precisions.
fn check(case: &Case, built: &Built, named: &Named, boundary: Boundary) {
    let what = format!("{} under {}, {boundary:?}", case.name, named.name);
    let scheme = named.scheme.clone().with_boundary(boundary);
    let made = Hierarchy::new(&Context::serial(), built.mesh.clone(), scheme, LEVELS);
    if (named.refuses)(case, &built.mesh) {
        let kind = made.err().map(|error| error.kind());
        return assert_eq!(kind, Some(ErrorKind::Unsupported), "{what}");
    }
    let hierarchy = &made.unwrap_or_else(|e| panic!("{what}: {e}"));
    let run = Run { what, hierarchy };
    run.check_levels();
    let (serial, threads) = (&Context::serial(), two_threads());
    let double = run.check_values::<f64>(&positions(case, built), 0..=LEVELS, [serial, threads]);
    check_outcome(&run, case, "", double);
    let single =
        run.check_values::<f32>(&positions(case, built), LEVELS..=LEVELS, [threads, serial]);
    check_outcome(&run, case, "f32", single);
}

fn check_outcome(run: &Run<'_>, case: &Case, precision: &str, found: Result<()>) {
    let found = found.err().map(|error| format!("{:?}", error.kind()));
    let may_be = found.is_some() && case.may_fail == found;
    let found = found.map_or(Outcome::Ok, Outcome::Error);
    assert!(may_be || &found == expected(case, precision), "{} {precision}: {found:?}", run.what);
}

fn check_group(group: usize) {
    let (meshes, schemes) = (meshes(), all());
    assert!(meshes.len() >= 60, "meshes are missing: {} found", meshes.len());
    for (case, built) in meshes.iter().skip(group).step_by(GROUPS) {
        for named in schemes.iter().filter(|named| (named.concerns)(case)) {
            for &boundary in Named::boundaries(&built.mesh) {
                check(case, built, named, boundary);
            }
        }
    }
}

#[test]
fn every_scheme_refines_the_cases_of_the_first_quarter() {
    check_group(0);
}

#[test]
fn every_scheme_refines_the_cases_of_the_second_quarter() {
    check_group(1);
}

#[test]
fn every_scheme_refines_the_cases_of_the_third_quarter() {
    check_group(2);
}

#[test]
fn every_scheme_refines_the_cases_of_the_last_quarter() {
    check_group(3);
}
