//! `carvel analyse`: what schemes do around extraordinary points, in words and JSON.

use super::bench::Bench;

#[test]
fn a_table_has_a_row_for_each_valence() {
    let bench = Bench::new();
    let run = bench.run("analyse doo-sabin --valence 4,6..7").ok();
    let text = run.out_text();
    let rows: Vec<&str> = text.lines().filter(|line| line.contains("0.50000000")).collect();
    assert_eq!(rows.len(), 3, "{text}");
    assert!(rows[0].contains("curvature bounded"), "{text}");
    assert!(rows.iter().all(|row| row.contains("0.25000000") && row.contains("C1")), "{text}");
}

#[test]
fn the_tuned_rule_keeps_curvature_bounded() {
    let bench = Bench::new();
    let run = bench.run("analyse three-point --extraordinary tuned --valence 3,12,32").ok();
    let text = run.out_text();
    let rows: Vec<&str> = text.lines().filter(|line| line.contains("0.50000000")).collect();
    assert_eq!(rows.len(), 3, "{text}");
    let bounded = |row: &&str| row.contains("0.25000000") && row.contains("curvature bounded");
    assert!(rows.iter().all(bounded), "{text}");
}

#[test]
fn json_has_eigenvalues_and_limits() {
    let bench = Bench::new();
    let json = bench.run("analyse --scheme catmull-clark --valence 5 --json").ok().json();
    let found = &json[0];
    assert_eq!((&found["feature"], &found["valence"]), (&"interior".into(), &5.into()));
    let lambda = found["lambda"].as_f64().expect("a number");
    assert!((lambda - 0.549_988_354_518_3).abs() < 1e-12);
    let own = found["limit_weights"][0][0].as_f64().expect("a number");
    assert!((own - 0.5).abs() < 1e-12, "{own}");
    assert_eq!((&found["c1"], &found["curvature"]), (&true.into(), &"unbounded".into()));
    let eigenvalues = found["eigenvalues"].as_array().expect("a list");
    let first: Vec<f64> =
        eigenvalues.iter().take(3).filter_map(serde_json::Value::as_f64).collect();
    assert!((first[0] - 1.0).abs() < 1e-12, "{first:?}");
    assert!((first[1] - lambda).abs() < 1e-12 && (first[2] - lambda).abs() < 1e-12, "{first:?}");
}

#[test]
fn what_is_no_feature_is_refused() {
    let bench = Bench::new();
    for (command, word) in [
        ("analyse doo-sabin --feature dart", "creases"),
        ("analyse catmull-clark --valence 2", "3 to 512"),
        ("analyse bspline --degree 5 --feature corner", "one face alone"),
        ("analyse bspline --degree 65", "8 passes"),
        ("analyse loop --boundary none --feature boundary", "holes"),
        ("analyse loop --w 1/32", "three-point"),
        ("analyse doo-sabin --boundary none --feature boundary", "no face there"),
    ] {
        bench.run(command).fails(2, word);
    }
    for (command, word) in [
        ("analyse catmull-clark --valence 7..3", "smaller number comes first"),
        ("analyse catmull-clark --valence 3..99999999999", "512"),
        ("analyse catmul", "catmull-clark"),
        ("analyse loop --scheme three-point", "cannot be used with"),
    ] {
        let run = bench.run(command);
        assert!(run.code == 2 && run.err.contains(word), "{command}: {}", run.err);
    }
}
