//! Plots: `analyse --plot` and `catalogue --plot`.

use serde_json::Value;

use super::bench::Bench;

fn text(bench: &Bench, name: &str) -> String {
    String::from_utf8(bench.get(name)).unwrap()
}

#[test]
fn a_mask_has_its_derivatives_frequencies_and_ranges() {
    let bench = Bench::new();
    bench.run("analyse --mask 1,9,22,22,9,1/32 --plot mask.svg").ok();
    let svg = text(&bench, "mask.svg");
    for title in ["limit function", "its derivative", "derivative 2", "magnitude of frequencies"] {
        assert!(svg.contains(title), "{title}");
    }
    // It is C2 and no more.
    assert!(!svg.contains("derivative 3") && !svg.contains("proved C^k"));
    bench.run("analyse four-point:1/16 --range w --plot range.svg").ok();
    assert!(text(&bench, "range.svg").contains("w for which it is proved C^k"));
    // What does not converge has frequencies alone.
    bench.run("analyse --mask [1,0,0,0,1,2]/2 --plot none.svg").ok();
    assert!(!text(&bench, "none.svg").contains("derivative"));
}

#[test]
fn a_scheme_has_a_row_of_pictures_for_each_valence() {
    let bench = Bench::new();
    let run = bench.run("analyse catmull-clark --valence 3,5 --plot map.svg").ok();
    assert!(run.out_text().contains("curvature"));
    let svg = text(&bench, "map.svg");
    for faces in [3, 5] {
        for what in ["spectrum", "natural configuration", "characteristic map"] {
            assert!(svg.contains(&format!("{faces} faces: {what}")), "{faces} {what}");
        }
    }
    // Three rings of quads around 3 and 5 faces, each refined three times, with those inside.
    assert!(
        svg.matches("<polygon").count() >= 8 * 8 * (3 + 5) * 3,
        "{}",
        svg.matches("<polygon").count()
    );
    bench.run("analyse bilinear --valence 5 --plot none.png").ok();
    assert_eq!(&bench.get("none.png")[1..4], b"PNG");
}

#[test]
fn the_sheet_has_all_schemes() {
    let bench = Bench::new();
    bench.run("catalogue --plot sheet.svg").ok();
    let svg = text(&bench, "sheet.svg");
    let list = bench.run("catalogue --json").ok().json();
    let list = list.as_array().unwrap();
    assert!(list.len() >= 22);
    for family in list {
        let name = family["name"].as_str().unwrap();
        assert!(svg.contains(&format!("\n{name}\n")), "{name}");
        let parameters = family["parameters"].as_array();
        let value = |p: &Value| format!("{} = {}", p["name"], p["default"]).replace('"', "");
        let values: Vec<_> = parameters.into_iter().flatten().map(value).collect();
        assert!(values.is_empty() || svg.contains(&format!("\n{}\n", values.join(", "))), "{name}");
    }
    // A control and a refined polygon in each panel.
    assert_eq!(svg.matches("<polyline").count(), 4 * list.len());
}

#[test]
fn plots_have_names_and_places() {
    let bench = Bench::new();
    bench.run("analyse chaikin --plot plot.pdf").fails(2, "plots are SVG or PNG");
    bench.run("analyse chaikin --plot none/plot.svg").fails(7, "there is no directory none");
    bench.run("analyse loop --valence 3..40 --plot p.svg").fails(2, "shows 12 valences at most");
    assert!(bench.files().is_empty());
    let run = bench.run("analyse chaikin --plot -").ok();
    assert!(run.out_text().starts_with("<svg ") && run.out_text().trim_end().ends_with("</svg>"));
}

/// The picture of docs/paper.md is what its command draws.
#[test]
fn the_picture_of_the_page_is_up_to_date() {
    let bench = Bench::new();
    bench.run("analyse three-point:1/32 --range w --plot paper.svg").ok();
    let kept = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/paper.svg");
    assert!(bench.get("paper.svg") == std::fs::read(kept).unwrap(), "docs/paper.svg is not");
}

/// So is that of docs/gallery.md.
#[test]
fn the_picture_of_the_gallery_is_up_to_date() {
    let bench = Bench::new();
    bench.run("catalogue --plot gallery.svg").ok();
    let kept = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/gallery.svg");
    assert!(bench.get("gallery.svg") == std::fs::read(kept).unwrap(), "docs/gallery.svg is not");
}

#[test]
fn the_same_plot_twice_is_the_same_bytes() {
    let bench = Bench::new();
    for name in ["a.png", "b.png", "a.svg", "b.svg"] {
        bench.run(&format!("analyse three-point:1/32 --plot {name}")).ok();
    }
    assert_eq!(bench.get("a.png"), bench.get("b.png"));
    assert_eq!(bench.get("a.svg"), bench.get("b.svg"));
}
