//! OBJ: what is kept, what is noted, what is refused and where.
// What was written must read back as the very same numbers.
#![allow(clippy::float_cmp)]

use carvel::base::NONE;
use carvel::io::{self, Format, MeshFile, Precision, WriteOptions};
use carvel::{Element, ErrorKind};

const COW: &str = include_str!("../../assets/spot/spot_control_mesh.obj");

fn read(text: impl AsRef<[u8]>) -> MeshFile {
    io::read_from(text.as_ref(), Format::Obj, "t.obj").unwrap()
}

fn write(mesh: &MeshFile, precision: Precision) -> String {
    let mut out = Vec::new();
    let options = WriteOptions { precision, ..WriteOptions::default() };
    io::write_to(&mut out, Format::Obj, mesh, &options).unwrap();
    String::from_utf8(out).unwrap()
}

/// The mesh as read from its own text, but for the line numbers.
fn again(mesh: &MeshFile) -> MeshFile {
    let back = read(write(mesh, Precision::F64));
    let (face_lines, vertex_lines) = (mesh.face_lines.clone(), mesh.vertex_lines.clone());
    MeshFile { face_lines, vertex_lines, ..back }
}

#[track_caller]
fn refused(text: impl AsRef<[u8]>, kind: ErrorKind, line: u64, reason: &str) {
    let error = io::read_from(text.as_ref(), Format::Obj, "t.obj").unwrap_err();
    assert_eq!(error.to_string(), format!("t.obj:{line}: {reason}"));
    assert_eq!(error.kind(), kind);
    assert_eq!(error.elements()[0], Element::Line(line));
}

#[test]
fn the_cow_is_kept_exactly() {
    let cow = read(COW);
    assert_eq!((cow.positions.len(), cow.face_sizes.len(), cow.uvs.len()), (188, 180, 267));
    assert_eq!(cow.positions[0], [0.413_568, -0.285_346, -0.140_958]);
    assert!(cow.face_uvs.is_some() && cow.notes.is_empty());
    assert_eq!(again(&cow), cow);
}

#[test]
fn tobj_sees_the_same() {
    let cow = read(COW);
    let options = tobj::LoadOptions::default();
    for text in [COW.to_owned(), write(&cow, Precision::F32)] {
        let (models, _) =
            tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| unreachable!()).unwrap();
        let [model] = &models[..] else { panic!("one model") };
        // tobj numbers by first use, so compare what the corners stand for.
        let corners = |values: &[f32], indices: &[u32], width: usize| -> Vec<f32> {
            indices.iter().flat_map(|&i| values[i as usize * width..][..width].to_vec()).collect()
        };
        let single = |values: &[f64]| -> Vec<f32> { values.iter().map(|&x| x as f32).collect() };
        let (theirs, uv_indices) = (&model.mesh, cow.face_uvs.as_ref().unwrap());
        let positions = single(cow.positions.as_flattened());
        let uvs = single(cow.uvs.as_flattened());
        assert_eq!(theirs.face_arities, cow.face_sizes);
        assert_eq!(
            corners(&theirs.positions, &theirs.indices, 3),
            corners(&positions, &cow.face_vertices, 3)
        );
        assert_eq!(
            corners(&theirs.texcoords, &theirs.texcoord_indices, 2),
            corners(&uvs, uv_indices, 2)
        );
    }
}

#[test]
fn every_kind_of_data_survives() {
    let mesh = read(
        "mtllib a.mtl b.mtl\nmtllib c.mtl\no thing\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\n\
         v 1 1 0 0 0 1\nv 0 1 0 .5 .5 .5\nv 9 9 9 0 0 0\nvt 0 0\nvt 1\nvt 1 1 0\nvn 0 0 1\n\
         f 1 2 3\ng left front\nusemtl red\ns 1\nf 1/1/1 2/2/1 3/3/1\nf 1//1 3/3 4\n\
         s off\ng right\nf -1 -2 -3 -4 # a comment\nusemtl red\ng left front\nf 1 3 4",
    );
    assert_eq!(mesh.positions.len(), 5, "isolated vertices are kept");
    assert_eq!(mesh.face_sizes, [3, 3, 3, 4, 3]);
    assert_eq!(mesh.face_vertices[9..13], [4, 3, 2, 1]);
    assert_eq!(mesh.face_lines, [13, 17, 18, 21, 24]);
    assert_eq!(mesh.vertex_lines, [4, 5, 6, 7, 8]);
    let colors = mesh.colors.as_ref().unwrap();
    assert_eq!((colors.width, &colors.values[9..12]), (3, &[0.5, 0.5, 0.5][..]));
    assert_eq!(mesh.uvs, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    let uvs = mesh.face_uvs.as_ref().unwrap();
    assert_eq!(uvs[..9], [NONE, NONE, NONE, 0, 1, 2, NONE, 2, NONE]);
    assert_eq!(mesh.face_normals.as_ref().unwrap()[3..8], [0, 0, 0, 0, NONE]);
    let groups: Vec<_> = (0..5).map(|face| mesh.groups.get(face)).collect();
    let left = Some("left front");
    assert_eq!(groups, [None, left, left, Some("right"), left]);
    assert_eq!((mesh.objects.get(0), mesh.materials.get(3)), (Some("thing"), Some("red")));
    assert_eq!((mesh.smoothing.get(2), mesh.smoothing.get(3)), (Some("1"), None));
    assert_eq!(mesh.material_libraries, ["a.mtl b.mtl", "c.mtl"]);
    assert!(mesh.notes.is_empty(), "{:?}", mesh.notes);
    assert_eq!(again(&mesh), mesh);
}

#[test]
fn layout_does_not_matter() {
    let plain = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let odd = read("\u{feff}# c\r\n\tv  0 0\\\r\n0\r\nv 1 0 0 \r\nv 0 1 0\r\n\r\nf 1 2\\\n 3");
    assert_eq!((&odd.positions, &odd.face_vertices), (&plain.positions, &plain.face_vertices));
    assert_eq!((odd.vertex_lines, odd.face_lines), (vec![2, 4, 5], vec![7]));
}

#[test]
fn vertices_may_follow_the_faces_that_name_them() {
    assert_eq!(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").face_vertices, [0, 1, 2]);
}

#[test]
fn what_is_dropped_is_noted() {
    let mesh = read(
        "v 0 0 0 2\nv 1 0 0 1\nv 0 1 0 1 1 1\nvt 0 0 1\np 1\nl 1 2\nl 2 3\nvp 0 0\ncurv 0 1 1 2\n\
         g unused\n",
    );
    let expected = [
        "1 rational weights (the 4th number of v) were dropped",
        "1 third texture coordinates (the 3rd number of vt) were dropped",
        "2 vertices without colour or opacity became opaque white",
        "1 statements curv were dropped",
        "2 line elements (l) were dropped",
        "1 point elements (p) were dropped",
        "1 statements vp were dropped",
        "1 o, g, usemtl or s statements without faces were dropped",
    ];
    assert_eq!(mesh.notes, expected);
}

#[test]
fn an_empty_file_is_an_empty_mesh() {
    assert_eq!(read(""), MeshFile::default());
    assert_eq!(read("# nothing\n\n"), MeshFile::default());
    assert_eq!(write(&MeshFile::default(), Precision::F64), "");
}

#[test]
fn wrong_indices_are_refused_at_their_line() {
    let start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
    let face = |face: &str, kind, reason: &str| {
        refused(format!("{start}{face}\nf 1 2 3\n"), kind, 6, reason);
    };
    let index = |text: &str, what: &str| {
        face(text, ErrorKind::IndexOutOfRange, &format!("face 1 names {what}"));
    };
    index("f 1 2 99", "vertex 99, but the file has 3");
    index("f 0 1 2", "vertex 0, but OBJ counts from 1");
    index("f -4 1 2", "vertex (from the end) -4, but the file has 3");
    let huge = format!("vertex {}, but the file has 3", i64::MAX);
    index("f 1 2 99999999999999999999", &huge);
    index("f 1 2 4294967296", "vertex 4294967296, but the file has 3");
    index("f 1/2 2 3", "texture coordinate 2, but the file has 1");
    index("f 1//7 2 3", "normal 7, but the file has 1");
    index("f 1/0 2 3", "texture coordinate 0, but OBJ counts from 1");
    let small = ErrorKind::FaceTooSmall;
    face("f 1 2 # 3", small, "face 1 has 2 vertices, at least 3 are needed");
    face("f 1", small, "face 1 has 1 vertex, at least 3 are needed");
    let corner = "where a face corner such as 7, 7/2 or 7/2/1 is expected";
    face("f 1 2 3.5", ErrorKind::Syntax, &format!("'3.5' {corner}"));
    face("f 1 2 3/1/1/1", ErrorKind::Syntax, &format!("'3/1/1/1' {corner}"));
}

#[test]
fn wrong_numbers_are_refused_at_their_line() {
    use ErrorKind::{NotFinite, Overflow, Syntax};
    let line = |line: &str, kind, reason: &str| {
        refused(format!("# one\n{line}\nv 0 0 0\n"), kind, 2, reason);
    };
    line("v 1 nan 0", NotFinite, "'nan' is not a finite number");
    line("v 1 2 -inf", NotFinite, "'-inf' is not a finite number");
    line("vn 1 2 1e999", Overflow, "'1e999' is too large for a double");
    line("v 1 2 x", Syntax, "'x' where a number is expected");
    line("v 1 2", Syntax, "a vertex of 2 numbers: 3, 4, 6 or 7 fit");
    line("v 1 2 3 4 5 6 7 8", Syntax, "more than 7 numbers");
    line("vt", Syntax, "a texture coordinate without numbers");
    line("vn 1 2", Syntax, "a normal of 2 numbers, 3 are needed");
}

#[test]
fn what_is_no_obj_is_refused() {
    let syntax = |text: &[u8], line, reason: &str| refused(text, ErrorKind::Syntax, line, reason);
    let garbage = "'\u{fffd}\u{fffd}\\u{0}\\u{1}' where an OBJ keyword is expected";
    syntax(b"OK\n\xff\xfe\0\x01", 2, garbage);
    syntax(b"v 0 0 0\0", 1, "'0\\u{0}' where a number is expected");
    syntax(b"# a\0b", 1, "a NUL byte in the comment '# a\\u{0}b'");
    syntax(b"# a\rv 0 0 0\r", 1, "a carriage return without line feed");
    syntax(b"g \xe9t\xe9", 1, "'\u{fffd}t\u{fffd}' is not plain UTF-8 text");
    syntax(b"foo \0", 1, "'\\u{0}' is not plain UTF-8 text");
    let blanks = "blanks between a backslash and the end of the line";
    syntax(b"mtllib a\\ \nb\n", 1, blanks);
    let long = [b"v ".to_vec(), vec![b'1'; 17 << 20]].concat();
    syntax(&long, 1, "the line is longer than 16777216 bytes");
    syntax(&b"#abcdef\\\n".repeat(17 << 17), 1, "the line is longer than 16777216 bytes");
}

#[test]
fn numbers_read_back_exactly() {
    let odd = [0.1, -0.0, 1.0, 1e16, 1e-7, 5e-324, f64::MAX, 1.0 / 3.0, 123_456_789.123_456_78];
    let positions: Vec<_> = odd.iter().map(|&x| [x, -x, x]).collect();
    let mesh = MeshFile { positions, ..MeshFile::default() };
    let bits = |mesh: &MeshFile| -> Vec<u64> {
        mesh.positions.as_flattened().iter().map(|x| x.to_bits()).collect()
    };
    let text = write(&mesh, Precision::F64);
    assert!(text.starts_with("v 0.1 -0.1 0.1\nv -0 0 -0\nv 1 -1 1\nv 1e16"), "{text}");
    assert_eq!(bits(&read(text)), bits(&mesh));
    let mesh = MeshFile { positions: vec![[f64::from(0.1_f32); 3]], ..MeshFile::default() };
    assert_eq!(write(&mesh, Precision::F32), "v 0.1 0.1 0.1\n");
}

#[test]
fn a_name_that_would_swallow_the_next_line_is_refused() {
    let mesh = MeshFile { material_libraries: vec!["a\\".into()], ..MeshFile::default() };
    let options = WriteOptions::default();
    let error = io::write_to(Vec::new(), Format::Obj, &mesh, &options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidText);
}

#[test]
fn what_single_precision_cannot_hold_is_refused() {
    let mesh = MeshFile { positions: vec![[1e39, 0.0, 0.0]], ..MeshFile::default() };
    let options = WriteOptions { precision: Precision::F32, ..WriteOptions::default() };
    let error = io::write_to(Vec::new(), Format::Obj, &mesh, &options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Overflow);
}
