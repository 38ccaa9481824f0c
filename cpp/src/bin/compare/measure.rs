//! One row of one-shot refinement: answers first, then times and memory.

use carvel::Context;
use carvel_peers::normalise::{Border, border};
use carvel_peers::{Boundary, Comparison, OpenSubdiv, Peer, Precision, Scheme, Task, heap, ours};

use crate::buffers::{BareWrite, Buffers};
use crate::cases::Case;
use crate::matched::{Matched, mesh};
use crate::regime::Regime;
use crate::row::Row;
use crate::sides::{Fresh, Given, ReUsed, Side, Theirs};
use crate::turns;

/// Measures a case against a peer.
pub fn row(case: &Case, peer: &dyn Peer, regime: Regime, runs: u32) -> Result<Row, String> {
    let task = Task::new(&case.control, case.scheme, Precision::Single);
    let boundary = boundary(peer, case.scheme);
    let given = case.given(boundary)?;
    let (comparison, faces) = compare(case, peer, &given, boundary)?;
    let fresh = regime != Regime::ReUsed;
    let mut theirs = Theirs { run: peer.start(&task)?, level: case.level, fresh };
    let context = Context::serial();
    let buffers = Buffers::new(true);
    let taken = if fresh {
        turns::fresh(&mut [&mut Fresh::new(&given), &mut theirs], runs)?
    } else {
        let mut ours = ReUsed::new(&given, &context, &buffers);
        let sides: &mut [&mut dyn Side] = &mut [&mut ours, &mut theirs, &mut BareWrite(&buffers)];
        turns::warmed(sides, runs, heap::cpu_seconds)?
    };
    Ok(Row {
        peer: peer.name().into(),
        peer_version: peer.version(),
        regime: regime.name().into(),
        ours_per_write: taken.get(2).map(|write| taken[0].time() / write.time()),
        ours_call: if fresh { "refine" } else { "refine_into" }.into(),
        peer_call: case.scheme.name().into(),
        ..Row::new(case, faces, &taken[0], &taken[1]).compared(&comparison)
    })
}

/// Our rule at a border for the peer's own; our default where it has none of ours, and
/// then the row shows the difference.
fn boundary(peer: &dyn Peer, scheme: Scheme) -> Boundary {
    if peer.name() == OpenSubdiv.name() {
        return Boundary::default();
    }
    match border(peer.name(), scheme) {
        Border::Is(boundary) => boundary,
        Border::Other(_) => Boundary::default(),
    }
}

/// Compares the answers; also the number of faces of ours.
fn compare(
    case: &Case,
    peer: &dyn Peer,
    given: &Given,
    boundary: Boundary,
) -> Result<(Comparison, u64), String> {
    let mut task = Task::new(&case.control, case.scheme, Precision::Single);
    let ours = mesh(&given.answer(&Context::serial())?);
    let faces = ours.sizes.len() as u64;
    if peer.name() == OpenSubdiv.name() {
        return Ok((Matched::new(&task, case.level, ours)?.compare(), faces));
    }
    let theirs = peer.refine(&task, case.level)?;
    if !case.three_point {
        return Ok((Comparison::through_adjacency(&ours, &theirs), faces));
    }
    // Another surface on the same faces: those of our own answer to the peer's scheme,
    // which is compared in the place of ours.
    task.options.boundary = boundary;
    let same = ours::refine(&task, case.level)?.mesh;
    let mut comparison = Comparison::through_adjacency(&same, &theirs);
    comparison.same_faces &= (&same.sizes, &same.indices) == (&ours.sizes, &ours.indices);
    comparison.same_counts &= same.vertices() == ours.vertices();
    comparison.max_difference = f64::INFINITY;
    Ok((comparison, faces))
}
