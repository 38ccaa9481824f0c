//! One row: answers first, then times and memory.

use carvel_peers::lineage::match_refinement;
use carvel_peers::normalise::{Border, border};
use carvel_peers::{
    Boundary, Comparison, OpenSubdiv, Peer, PeerMesh, Precision, Scheme, Task, heap, ours,
};

use crate::cases::Case;
use crate::memory::Watch;
use crate::regime::Regime;
use crate::row::Row;
use crate::sides::{Fresh, Given, ReUsed, Side, Theirs};

/// What a side's calls took.
#[derive(Default)]
struct Taken {
    seconds: Vec<f64>,
    bytes: Vec<f64>,
}

/// Measures a case against a peer.
pub fn row(case: &Case, peer: &dyn Peer, regime: Regime, runs: u32) -> Result<Row, String> {
    let task = Task::new(&case.control, case.scheme, Precision::Single);
    let mut ours_task = task;
    ours_task.options.boundary = boundary(peer, case.scheme);
    let (comparison, faces) = compare(case, peer, &task, &ours_task)?;
    let scheme = ours::scheme(&ours_task);
    let given = Given {
        mesh: ours::mesh(&case.control)?,
        scheme: scheme.ok_or_else(|| format!("carvel does not have {}", case.scheme.name()))?,
        level: case.level,
        positions: case.control.positions.iter().map(|&x| x as f32).collect(),
    };
    let fresh = regime != Regime::ReUsed;
    let run = peer.start(&task)?;
    let mut theirs = Theirs { run, level: case.level, fresh };
    let (ours, theirs) = if fresh {
        alternate(&mut Fresh::new(&given), &mut theirs, runs)?
    } else {
        warmed(&mut ReUsed::new(&given), &mut theirs, runs)?
    };
    let per_face = |value: f64| value / faces as f64;
    let [ours_time, peer_time] = [&ours, &theirs].map(|it| median(&it.seconds));
    let [ours_bytes, peer_bytes] = [&ours, &theirs].map(|it| median(&it.bytes));
    Ok(Row {
        scheme: case.scheme.name().into(),
        mesh: case.mesh.clone(),
        level: case.level,
        peer: peer.name().into(),
        peer_version: peer.version(),
        regime: regime.name().into(),
        threads: 1,
        runs,
        faces,
        ours_ns_per_face: per_face(1e9 * ours_time),
        peer_ns_per_face: per_face(1e9 * peer_time),
        ratio: peer_time / ours_time,
        ours_spread: spread(&ours.seconds),
        peer_spread: spread(&theirs.seconds),
        ours_bytes_per_face: per_face(ours_bytes),
        peer_bytes_per_face: per_face(peer_bytes),
        max_difference: Some(comparison.max_difference).filter(|it| it.is_finite()),
        same_counts: comparison.same_counts,
        same_faces: comparison.same_faces,
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
    task: &Task,
    ours_task: &Task,
) -> Result<(Comparison, u64), String> {
    let ours = ours::refine(ours_task, case.level)?.mesh;
    let faces = ours.sizes.len() as u64;
    if peer.name() == OpenSubdiv.name() {
        return Ok((through_parents(task, case.level, &ours)?, faces));
    }
    let theirs = peer.refine(task, case.level)?;
    Ok((Comparison::through_adjacency(&ours, &theirs), faces))
}

/// OpenSubdiv's answer, matched level by level. Our faces are also held to the
/// documented numbering.
fn through_parents(task: &Task, level: u32, ours: &PeerMesh) -> Result<Comparison, String> {
    let refinement = OpenSubdiv.refinement(task, level)?;
    let (laid, at) = match_refinement(task, &refinement, level)?;
    let mut comparison = Comparison::of(ours, &refinement.mesh()?, &at);
    comparison.same_faces &= laid.level.indices == ours.indices;
    Ok(comparison)
}

/// Both sides in turn, each from memory that nobody has touched.
fn alternate(
    ours: &mut dyn Side,
    theirs: &mut dyn Side,
    runs: u32,
) -> Result<(Taken, Taken), String> {
    let (mut first, mut second) = (Taken::default(), Taken::default());
    for _ in 0..runs {
        watched(ours, &mut first)?;
        ours.clear();
        watched(theirs, &mut second)?;
        theirs.clear();
    }
    Ok((first, second))
}

/// Both sides in turn, after a call of each that touches the memory; what it touched is
/// the peak, since later calls touch no more.
fn warmed(ours: &mut dyn Side, theirs: &mut dyn Side, runs: u32) -> Result<(Taken, Taken), String> {
    let (mut first, mut second) = (Taken::default(), Taken::default());
    heap::trim();
    watched(ours, &mut first)?;
    heap::trim();
    watched(theirs, &mut second)?;
    theirs.clear();
    first.seconds.clear();
    second.seconds.clear();
    for _ in 0..runs {
        timed(ours, &mut first)?;
        timed(theirs, &mut second)?;
        theirs.clear();
    }
    Ok((first, second))
}

fn watched(side: &mut dyn Side, taken: &mut Taken) -> Result<(), String> {
    side.prepare()?;
    let watch = Watch::start()?;
    clocked(side, taken)?;
    taken.bytes.push(watch.peak()? as f64);
    Ok(())
}

fn timed(side: &mut dyn Side, taken: &mut Taken) -> Result<(), String> {
    side.prepare()?;
    clocked(side, taken)
}

fn clocked(side: &mut dyn Side, taken: &mut Taken) -> Result<(), String> {
    let start = heap::cpu_seconds();
    side.call()?;
    taken.seconds.push(heap::cpu_seconds() - start);
    Ok(())
}

fn sorted(values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values
}

fn median(values: &[f64]) -> f64 {
    let values = sorted(values);
    let n = values.len();
    if n == 0 { f64::NAN } else { f64::midpoint(values[(n - 1) / 2], values[n / 2]) }
}

/// Half the range of the middle half, relative to the median.
fn spread(values: &[f64]) -> f64 {
    let (sorted, n) = (sorted(values), values.len());
    let range = sorted.get(n - 1 - n / 4).zip(sorted.get(n / 4));
    range.map_or(f64::NAN, |(high, low)| (high - low) / 2.0 / median(values))
}
