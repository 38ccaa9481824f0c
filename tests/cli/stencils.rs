//! Stencil tables as files: the matrix times the control points is the refined mesh.

use super::bench::{Bench, CUBE, STRIP};
use carvel::{Context, Records, RecordsMut, StencilTable, StoredTable};
use npyz::npz::NpzArchive;
use std::io::Cursor;

/// What a scheme's options and two levels make of a file's points, by a matrix of a
/// format and by refining.
fn agrees(bench: &Bench, file: &str, options: &str, read: fn(&Bench) -> Matrix, extension: &str) {
    let out = format!("matrix.{extension}");
    bench.run(&format!("stencils {file} -o {out} {options}")).ok();
    let refined = format!("subdivide {file} -o refined.ply {options}");
    let (matrix, control) = (read(bench), bench.mesh(file));
    bench.run(&refined).ok();
    let expected = bench.mesh("refined.ply");
    assert_eq!(matrix.shape, [expected.positions.len(), control.positions.len()]);
    let mut found = vec![[0.0; 3]; matrix.shape[0]];
    for &(row, column, weight) in &matrix.entries {
        for (sum, x) in found[row].iter_mut().zip(control.positions[column]) {
            *sum += weight * x;
        }
    }
    for (found, expected) in found.iter().zip(&expected.positions) {
        for (x, y) in found.iter().zip(expected) {
            assert!((x - y).abs() < 1e-12, "{file} {options}: {x} {y}");
        }
    }
}

struct Matrix {
    shape: [usize; 2],
    entries: Vec<(usize, usize, f64)>,
}

/// As `scipy.sparse.load_npz` reads it.
fn npz(bench: &Bench) -> Matrix {
    let bytes = std::fs::read(bench.path().join("matrix.npz")).expect("a file");
    let mut archive = NpzArchive::new(Cursor::new(bytes)).expect("an archive");
    let mut whole = |name: &str| {
        let array = archive.by_name(name).expect("a good archive").expect("an array of the name");
        array.into_vec::<i64>().expect("whole numbers")
    };
    let (shape, offsets, indices) = (whole("shape"), whole("indptr"), whole("indices"));
    let array = archive.by_name("format").expect("a good archive").expect("a format");
    assert_eq!((array.shape(), array.dtype().descr()), (&[][..], "'|S3'".to_owned()));
    assert_eq!(array.into_vec::<Vec<u8>>().expect("text"), [b"csr".to_vec()]);
    let array = archive.by_name("data").expect("a good archive").expect("data");
    let weights = array.into_vec::<f64>().expect("doubles");
    let row = |row: usize| {
        let range = offsets[row] as usize..offsets[row + 1] as usize;
        let entries = indices[range.clone()].iter().zip(&weights[range]);
        entries.map(move |(&i, &w)| (row, i as usize, w)).collect::<Vec<_>>()
    };
    let shape = [shape[0] as usize, shape[1] as usize];
    assert_eq!(offsets.len(), shape[0] + 1);
    Matrix { shape, entries: (0..shape[0]).flat_map(row).collect() }
}

fn mtx(bench: &Bench) -> Matrix {
    let text = std::fs::read_to_string(bench.path().join("matrix.mtx")).expect("a file");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("%%MatrixMarket matrix coordinate real general"));
    let words = |line: &str| line.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let sizes: Vec<usize> =
        words(lines.next().expect("sizes")).iter().map(|n| n.parse().expect("a size")).collect();
    let entry = |line: &str| {
        let [row, column, weight] = &words(line)[..] else { panic!("{line}") };
        let place = |word: &str| word.parse::<usize>().expect("an index") - 1;
        (place(row), place(column), weight.parse().expect("a number"))
    };
    let entries: Vec<_> = lines.map(entry).collect();
    assert_eq!(entries.len(), sizes[2]);
    Matrix { shape: [sizes[0], sizes[1]], entries }
}

fn own(bench: &Bench) -> StencilTable<f64> {
    let file = std::fs::File::open(bench.path().join("matrix.carvel")).expect("a file");
    match StoredTable::read(std::io::BufReader::new(file)).expect("a table") {
        StoredTable::F64(table) => table,
        other => panic!("{other:?}"),
    }
}

const SCHEMES: [&str; 7] = [
    "",
    "--scheme doo-sabin --boundary none",
    "--scheme catmull-clark --crease-angle 30 --crease-sharpness 1.5",
    "--scheme bilinear --levels 3",
    "--scheme bspline --degree 5 --corner-rule average",
    "--scheme three-point --extraordinary tuned",
    "--scheme averaging --passes 1/2,0 --levels 1",
];

#[test]
fn matrices_do_what_refining_does() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE).put("strip.obj", STRIP);
    for options in SCHEMES {
        for file in ["cube.obj", "strip.obj"] {
            agrees(&bench, file, options, npz, "npz");
            agrees(&bench, file, options, mtx, "mtx");
        }
    }
    let tent = "v 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 3 4\nf 1 4 5\n";
    bench.put("tent.obj", tent);
    agrees(&bench, "tent.obj", "--scheme loop --levels 3 --boundary edge", mtx, "mtx");
}

/// A mesh that is cut open has copies of vertices, which the file does not know.
#[test]
fn columns_are_the_vertices_of_the_file() {
    let bench = Bench::new();
    let bow_tie = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0 0\nv -1 -1 0\nv 0 -1 0\n\
        f 1 2 3 4\nf 1 5 6 7\n";
    bench.put("tie.obj", bow_tie);
    agrees(&bench, "tie.obj", "--non-manifold cut", npz, "npz");
    agrees(&bench, "tie.obj", "--scheme catmull-clark --non-manifold sharpen", npz, "npz");
    bench.run("stencils tie.obj -o out.npz").fails(4, "tie.obj");
}

#[test]
fn steps_selections_and_varying_rows() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let run = |options: &str| {
        let scheme = "--scheme catmull-clark";
        bench.run(&format!("stencils cube.obj -o matrix.carvel {scheme} {options}")).ok();
        own(&bench)
    };
    let whole = run("-l 2");
    let context = Context::serial();
    let (first, last) = (run("-l 1"), run("-l 2 --step"));
    assert_eq!([first.rows(), first.columns(), last.columns()], [26, 8, 26]);
    let x: Vec<f64> = (0..8).map(f64::from).collect();
    let apply = |table: &StencilTable<f64>, x: &[f64]| {
        let mut out = vec![0.0; table.rows()];
        let into = RecordsMut::packed(&mut out, 1);
        table.apply(&context, Records::packed(x, 1), into).expect("it fits");
        out
    };
    for (a, b) in apply(&whole, &x).iter().zip(apply(&last, &apply(&first, &x))) {
        assert!((a - b).abs() < 1e-14);
    }
    let some = run("-l 2 --vertices 5,0,5");
    assert_eq!(some, whole.select(&context, &[5, 0, 5]).expect("rows"));
    assert_eq!(run("-l 0").entries(), 8);
    let varying = run("-l 1 --varying");
    assert_eq!(varying.row(0), (&[0][..], &[1.0][..]));
}

#[test]
fn reports_say_what_was_made() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let line = "stencils cube.obj -o out.npz --scheme catmull-clark -l 1 --precision f32 --json";
    let report = bench.run(line).ok().json();
    assert_eq!(report["rows"], 26);
    assert_eq!(report["columns"], 8);
    assert_eq!(report["format"], "npz");
    assert_eq!(report["scheme"]["name"], "catmull-clark");
    assert_eq!(report["precision"], "f32");
    let run = bench.run("stencils cube.obj -o - --format mtx --scheme catmull-clark -l 1").ok();
    assert!(run.out_text().starts_with("%%MatrixMarket"));
    assert!(run.err.contains("26 rows on 8 columns"), "{}", run.err);
    let failed = bench.run("stencils missing.obj -o out.npz --json");
    assert_eq!((failed.code, failed.json()["error"]["exit_code"].clone()), (3, 3.into()));
    // The same bytes each time, on any number of threads.
    let bytes = |threads: u32| {
        bench.run(&format!("stencils cube.obj -o out.npz -l 3 --threads {threads}")).ok();
        std::fs::read(bench.path().join("out.npz")).expect("a file")
    };
    assert_eq!(bytes(1), bytes(2));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE).put("empty.obj", "");
    let fails = |line: &str, code, words: &str| {
        bench.run(&format!("stencils {line}")).fails(code, words);
        assert!(!bench.path().join("out.npz").exists());
    };
    fails("cube.obj -o out.txt", 2, "--format chooses one");
    fails("cube.obj -o -", 2, "--format chooses one");
    fails("cube.obj -o nowhere/out.npz", 7, "there is no directory nowhere");
    fails("empty.obj -o out.npz", 4, "no mesh");
    fails("cube.obj -o out.npz --varying", 2, "--varying belongs to primal schemes");
    fails("cube.obj -o out.npz --scheme catmull-clark --anchored", 2, "--anchored");
    fails("cube.obj -o out.npz --step -l 0", 2, "--step");
    fails("cube.obj -o out.npz --vertices 1000000", 4, "vertex 1000000");
    fails("cube.obj -o out.npz --scheme loop", 4, "Loop refines triangles only");
    fails("cube.obj -o out.npz -l 16", 6, "32-bit");
    fails("cube.obj -o out.npz -l 6 --memory 1K", 6, "ceiling");
    fails("cube.obj -o out.npz --crease-angle 3", 2, "--crease-angle");
}
