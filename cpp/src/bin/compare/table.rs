//! The table, at most 120 columns wide.

use crate::row::Row;

/// Prints what the columns are.
pub fn print_head() {
    println!(
        "carvel beside its peers: one thread, single precision, medians (± half the middle half)"
    );
    println!("ns and bytes are per face of the result; diff is relative to the bounding box\n");
    println!(
        "{:<13} {:<9} {:>2} {:<10} {:<7} {:>9} {:>5} {:>5} {:>7} {:>12} {:>12} {:>6} {:>5} {:>5}",
        "scheme",
        "mesh",
        "L",
        "peer",
        "regime",
        "faces",
        "count",
        "same",
        "diff",
        "ours ns",
        "peer ns",
        "ratio",
        "ours",
        "peer"
    );
    println!("{:>94} {:>24}", "", "bytes bytes");
}

/// Prints one row.
pub fn print_row(row: &Row) {
    let yes = |is: bool| if is { "yes" } else { "NO" };
    let time = |ns: f64, spread: f64| format!("{ns:.1} ±{:.0}%", 100.0 * spread);
    let difference = row.max_difference.map_or("-".to_owned(), |x| format!("{x:.0e}"));
    println!(
        "{:<13} {:<9} {:>2} {:<10} {:<7} {:>9} {:>5} {:>5} {:>7} {:>12} {:>12} {:>6.1} {:>5.0} {:>5.0}",
        row.scheme,
        shortened(&row.mesh),
        row.level,
        row.peer,
        row.regime,
        row.faces,
        yes(row.same_counts),
        yes(row.same_faces),
        difference,
        time(row.ours_ns_per_face, row.ours_spread),
        time(row.peer_ns_per_face, row.peer_spread),
        row.ratio,
        row.ours_bytes_per_face,
        row.peer_bytes_per_face
    );
}

/// A mesh's name as far as it fits.
fn shortened(name: &str) -> String {
    name.chars().take(9).collect()
}
