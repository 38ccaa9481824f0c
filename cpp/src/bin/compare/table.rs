//! The tables, at most 124 columns wide.

use crate::part::Part;
use crate::row::Row;

/// Prints what the columns are.
pub fn print_head(part: Part) {
    println!("\n{}", about(part));
    if one_shot(part) {
        println!(
            "{:<13} {:<9} {:>2} {:<14} {:<7} {:>9} {:>3} {:>4} {:>6} {:>11} {:>11} {:>6} {:>5} {:>5} {:>5}",
            "scheme",
            "mesh",
            "L",
            "peer",
            "regime",
            "faces",
            "cnt",
            "same",
            "diff",
            "ours ns",
            "peer ns",
            "ratio",
            "write",
            "ours",
            "peer"
        );
        println!("{:>105} {:>5} {:>11}", "", "times", "bytes bytes");
        return;
    }
    println!(
        "{:<13} {:<9} {:>2} {:>10} {:>6} {:>11} {:>11} {:>6} {:>5} {:>5} ours / peer",
        "scheme", "mesh", "L", "count", "diff", "ours ns", "peer ns", "ratio", "bytes", "bytes"
    );
}

/// Faces and positions from a control mesh, beside other libraries.
fn one_shot(part: Part) -> bool {
    matches!(part, Part::Refine | Part::Orientation)
}

fn about(part: Part) -> &'static str {
    match part {
        Part::Refine => {
            "carvel beside its peers: one thread, single precision, medians (± half the middle half)\n\
             ns and bytes are per face of the result; diff is relative to the bounding box\n\
             write: our time over that of writing the same bytes; (D-S): the peer runs Doo-Sabin,\n\
             another surface by design on the same faces, so there is no diff\n"
        }
        Part::PerFrame => {
            "New positions on a topology that is ready, and making the table for it, per vertex;\n\
             bytes are those of the stencil tables\n"
        }
        Part::Surface => {
            "Points of the limit surface at 1 M random places, one thread, per sample; L is how deep\n\
             OpenSubdiv isolates features before it approximates, which is all of diff\n"
        }
        Part::Threads => {
            "carvel on two threads (ours) beside one (peer), wall time, re-used memory; the same bytes;\n\
             medians of turns of five calls in a row; cpu: processor time of two threads and of one;\n\
             held: each thread on a processor of its own, otherwise where the system puts it;\n\
             f: per face, v: per vertex, beside the speed of copying as many bytes on two threads\n"
        }
        Part::Linear => {
            "carvel on large results (ours) beside 1 M faces (peer), one thread, fresh memory, per face\n"
        }
        Part::Orientation => {
            "carvel beside Rust crates: one thread, single precision, medians (± half the middle half)\n\
             ns and bytes are per face of the result; diff is relative to the bounding box\n"
        }
    }
}

/// Prints one row.
pub fn print_row(part: Part, row: &Row) {
    let time = |ns: f64, spread: f64| format!("{ns:.1} ±{:.0}%", 100.0 * spread);
    let (ours, peer) =
        (time(row.ours_ns_per_face, row.ours_spread), time(row.peer_ns_per_face, row.peer_spread));
    let difference = row.max_difference.map_or("-".to_owned(), |x| format!("{x:.0e}"));
    let start = format!("{:<13} {:<9} {:>2}", row.scheme, shortened(&row.mesh), row.level);
    let [ours_bytes, peer_bytes] = bytes(row);
    if one_shot(part) {
        let yes = |is: bool| if is { "yes" } else { "NO" };
        println!(
            "{start} {:<14} {:<7} {:>9} {:>3} {:>4} {difference:>6} {ours:>11} {peer:>11} {:>6.1} {:>5} {ours_bytes:>5} {peer_bytes:>5}",
            peer_name(row),
            row.regime,
            row.faces,
            yes(row.same_counts),
            yes(row.same_faces),
            row.ratio,
            row.ours_per_write.map_or("-".to_owned(), |x| format!("{x:.1}")),
        );
        return;
    }
    let count = format!("{} {}", row.faces, &row.unit[..1]);
    let speeds = row.ours_gb_per_s.zip(row.copy_gb_per_s);
    let speeds =
        speeds.map_or(String::new(), |(ours, copy)| format!(", {ours:.1} of {copy:.1} GB/s"));
    let cpu = if part == Part::Threads {
        format!(", cpu {:.1} / {:.1}", row.ours_cpu_ns_per_face, row.peer_cpu_ns_per_face)
    } else {
        String::new()
    };
    println!(
        "{start} {count:>10} {difference:>6} {ours:>11} {peer:>11} {:>6.2} {ours_bytes:>5} {peer_bytes:>5} {} / {}{cpu}{speeds}",
        row.ratio, row.ours_call, row.peer_call,
    );
}

/// The peer's name, with a word where it runs another scheme.
fn peer_name(row: &Row) -> String {
    if row.peer_call == row.scheme { row.peer.clone() } else { format!("{} (D-S)", row.peer) }
}

/// Of the tables where topology is ready; of the calls elsewhere.
fn bytes(row: &Row) -> [String; 2] {
    let both = if row.unit == "vertex" {
        [row.ours_table_bytes, row.peer_table_bytes]
    } else {
        [Some(row.ours_bytes_per_face), Some(row.peer_bytes_per_face)]
    };
    both.map(|bytes| bytes.map_or("-".to_owned(), |x| format!("{x:.0}")))
}

/// A mesh's name as far as it fits.
fn shortened(name: &str) -> String {
    name.chars().take(9).collect()
}
