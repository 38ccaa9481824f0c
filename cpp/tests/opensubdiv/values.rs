//! Vertex and varying data of other widths than three.

use carvel_peers::lineage::match_refinement;
use carvel_peers::normalise::tolerance;
use carvel_peers::{Control, OpenSubdiv, Precision, Scheme, Task, Values, ours, shapes};

/// Values between -1 and 1, of no pattern.
fn data(control: &Control, width: usize) -> Vec<f64> {
    (0..control.vertices() * width)
        .map(|i| f64::from((1.0 + 7.3 * i as f64).sin() as f32))
        .collect()
}

fn agree(control: &Control, scheme: Scheme, kind: Values, width: usize) {
    let values = data(control, width);
    for precision in Precision::ALL {
        let task = Task::new(control, scheme, precision);
        let ours = ours::carry(&task, 3, kind, &values, width).expect("carvel");
        let refinement = OpenSubdiv.refinement(&task, 3).expect("OpenSubdiv");
        let (_, at) = match_refinement(&task, &refinement, 3).expect("the same children");
        let theirs = refinement.interpolate(kind, &values, width).expect("values");
        for (mine, &w) in ours.values.chunks(width).zip(&at.vertices) {
            for (a, b) in mine.iter().zip(&theirs[w as usize * width..]) {
                // Relative to the range of the values, which is two.
                let apart = (a - b).abs() / 2.0;
                assert!(apart <= tolerance(precision), "{scheme:?} {kind:?} {width}: {a} {b}");
            }
        }
    }
}

#[test]
fn any_width() {
    let quads = shapes::frame().creased(&[[5, 9]], 1.5).rounded();
    let triangles = shapes::triangulated(&shapes::grid(3, 3)).rounded();
    for kind in [Values::Vertex, Values::Varying] {
        for width in [1, 2, 3, 4, 9] {
            agree(&quads, Scheme::CatmullClark, kind, width);
            agree(&quads, Scheme::Bilinear, kind, width);
            agree(&triangles, Scheme::Loop, kind, width);
        }
    }
}
