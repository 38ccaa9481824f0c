//! OFF, PLY and STL: what is kept, what is noted, what is refused and where.
// What was written must read back as the very same numbers.
#![allow(clippy::float_cmp)]

use carvel::io::{
    self, ColorType, Encoding, Format, MeshFile, NumberType, VertexAttribute, VertexColors,
    WriteOptions,
};
use carvel::{Element, ErrorKind};

const COW: &str = include_str!("../../assets/spot/spot_control_mesh.obj");
const ENCODINGS: [Encoding; 3] = [Encoding::Binary, Encoding::BinaryBigEndian, Encoding::Ascii];

fn read(data: impl AsRef<[u8]>, format: Format) -> MeshFile {
    io::read_from(data.as_ref(), format, "t").unwrap()
}

fn write(mesh: &MeshFile, format: Format, encoding: Encoding) -> Vec<u8> {
    let mut out = Vec::new();
    let options = WriteOptions { encoding, ..WriteOptions::default() };
    io::write_to(&mut out, format, mesh, &options).unwrap();
    out
}

/// A mesh with everything that goes by vertex.
fn full() -> MeshFile {
    let corners = vec![0, 1, 2, 3, 0, 2, 1];
    let values = (0..16).map(|i| f64::from(i * 17) / 255.0).collect();
    MeshFile {
        positions: vec![[0.1, -0.0, 1e-300], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.3]],
        face_sizes: vec![4, 3],
        face_vertices: corners.clone(),
        colors: Some(VertexColors { width: 4, values, kind: ColorType::U8 }),
        uvs: vec![[0.0, 0.1], [0.2, 0.3], [0.4, 0.5], [0.6, 0.7]],
        face_uvs: Some(corners.clone()),
        normals: vec![[0.0, 0.0, 1.0]; 4],
        face_normals: Some(corners),
        ..MeshFile::default()
    }
}

/// One attribute of every type, with its extremes.
fn attributes() -> Vec<VertexAttribute> {
    let attribute = |name: &str, kind, values: [f64; 4]| VertexAttribute {
        name: name.to_owned(),
        kind,
        values: values.to_vec(),
    };
    let single = f64::from(0.1_f32);
    vec![
        attribute("quality", NumberType::F32, [0.5, single, f64::from(f32::MAX), -0.0]),
        attribute("pressure", NumberType::F64, [0.1, 1e300, -0.0, 3.0]),
        attribute("a", NumberType::I8, [-128.0, 127.0, 0.0, -1.0]),
        attribute("b", NumberType::U8, [255.0, 0.0, 1.0, 2.0]),
        attribute("c", NumberType::I16, [-32768.0, 32767.0, 0.0, -1.0]),
        attribute("d", NumberType::U16, [65535.0, 0.0, 1.0, 2.0]),
        attribute("e", NumberType::I32, [-2_147_483_648.0, 2_147_483_647.0, 0.0, -1.0]),
        attribute("s", NumberType::U32, [4_294_967_295.0, 0.0, 1.0, 2.0]),
    ]
}

fn without_lines(mesh: MeshFile) -> MeshFile {
    MeshFile { face_lines: Vec::new(), vertex_lines: Vec::new(), ..mesh }
}

fn bits(mesh: &MeshFile) -> Vec<u64> {
    mesh.positions.as_flattened().iter().map(|x| x.to_bits()).collect()
}

#[track_caller]
fn refused(data: impl AsRef<[u8]>, format: Format, kind: ErrorKind, at: Element, reason: &str) {
    let error = io::read_from(data.as_ref(), format, "t").unwrap_err();
    let place = match at {
        Element::Line(line) => format!("t:{line}"),
        other => format!("t: {other}"),
    };
    assert_eq!(error.to_string(), format!("{place}: {reason}"));
    assert_eq!((error.kind(), error.elements()[0]), (kind, at));
}

#[test]
fn ply_keeps_everything_that_goes_by_vertex() {
    let mesh = MeshFile { attributes: attributes(), ..full() };
    assert!(io::losses(&mesh, Format::Ply).is_empty());
    for encoding in ENCODINGS {
        let back = without_lines(read(write(&mesh, Format::Ply, encoding), Format::Ply));
        assert_eq!(back, mesh, "{encoding:?}");
        assert_eq!(bits(&back), bits(&mesh));
    }
}

#[test]
fn off_keeps_normals_colours_and_texture_coordinates() {
    for kind in [ColorType::U8, ColorType::Float] {
        let mut mesh = full();
        mesh.colors.as_mut().unwrap().kind = kind;
        assert!(io::losses(&mesh, Format::Off).is_empty());
        let text = write(&mesh, Format::Off, Encoding::Binary);
        assert!(text.starts_with(b"STCNOFF\n4 2 0\n"));
        let back = without_lines(read(text, Format::Off));
        assert_eq!(back, mesh);
        assert_eq!(bits(&back), bits(&mesh));
    }
}

#[test]
fn all_byte_colours_survive() {
    let all: Vec<_> = (0..=255).flat_map(|i| [f64::from(i) / 255.0; 3]).collect();
    // Bytes of 0 and 1 only must not turn into black and white.
    for values in [all, vec![0.0, 1.0 / 255.0, 0.0]] {
        for format in [Format::Ply, Format::Off] {
            let positions = vec![[0.0; 3]; values.len() / 3];
            let colors = VertexColors { width: 3, values: values.clone(), kind: ColorType::U8 };
            let mesh = MeshFile { positions, colors: Some(colors), ..MeshFile::default() };
            let back = read(write(&mesh, format, Encoding::Ascii), format);
            assert_eq!(back.colors.unwrap().values, values);
        }
    }
}

#[test]
fn whole_colours_beyond_one_are_not_taken_for_bytes() {
    let colors = VertexColors { width: 3, values: vec![2.0, 1.0, 0.0], kind: ColorType::Float };
    let mesh = MeshFile { positions: vec![[0.0; 3]], colors: Some(colors), ..MeshFile::default() };
    let back = read(write(&mesh, Format::Off, Encoding::Ascii), Format::Off);
    assert_eq!(back.colors, mesh.colors);
}

#[test]
fn the_cow_goes_through_off_and_ply_unchanged() {
    let cow = read(COW, Format::Obj);
    for format in [Format::Off, Format::Ply] {
        let back = read(write(&cow, format, Encoding::Binary), format);
        assert_eq!((bits(&back), &back.face_vertices), (bits(&cow), &cow.face_vertices));
        assert_eq!(back.face_sizes, cow.face_sizes);
        let lost = format!("267 texture coordinates that go by corner: {format} cannot hold that");
        assert_eq!(io::losses(&cow, format), [lost]);
    }
}

#[test]
fn off_is_read_in_any_layout() {
    let text =
        "\n# c\nOFF # c\n 4 2\n0 0 0 1 0\n0 1 1 0 # c\n0 1 0 4 0\n1 2 3 .5 .5 .5\n3 0 1 2 7\n";
    let mesh = read(text, Format::Off);
    assert_eq!(mesh.positions[3], [0.0, 1.0, 0.0]);
    assert_eq!((mesh.face_vertices, mesh.face_sizes), (vec![0, 1, 2, 3, 0, 1, 2], vec![4, 3]));
    assert_eq!((mesh.vertex_lines, mesh.face_lines), (vec![5, 5, 6, 7], vec![7, 9]));
    assert_eq!(mesh.notes, ["the colours of 2 faces were dropped"]);
    let mesh = read("OFF 1 0 0\n0 0 0\nmore\n", Format::Off);
    assert_eq!(mesh.notes, ["what follows the last face (line 3) was dropped"]);
    let mesh = read("COFF 2 0 0\n0 0 0 255 0 0\n1 1 1 0 1 2\n", Format::Off);
    let colors = mesh.colors.unwrap();
    assert_eq!((colors.kind, colors.width, colors.values[0]), (ColorType::U8, 3, 1.0));
}

#[test]
fn wrong_off_is_refused_at_its_line() {
    use ErrorKind::{
        FaceTooSmall, IndexOutOfRange, NotFinite, Overflow, Syntax, TooLarge, Unsupported,
    };
    let off = |text: &str, kind, line, reason: &str| {
        refused(text, Format::Off, kind, Element::Line(line), reason);
    };
    off("", Syntax, 1, "the file is empty, the header OFF is expected");
    off("ply", Syntax, 1, "'ply' where the header OFF, COFF, NOFF or STOFF is expected");
    off("4OFF\n", Unsupported, 1, "'4OFF': only three-dimensional OFF is supported");
    off("OFF BINARY\n", Unsupported, 1, "binary OFF is not supported");
    off("OFF\n", Syntax, 1, "the file ends before the counts");
    off("OFF\n1\n", Syntax, 2, "the file ends before the number of faces");
    off("OFF\n-1 0 0\n", Syntax, 2, "'-1' where the number of vertices is expected");
    off("OFF\n4294967295 0", TooLarge, 2, "more vertices than a 32-bit index can name");
    off("OFF\n9 0 0 0\n", Syntax, 2, "'0' where the end of the counts is expected");
    let ends = "the header promises 4294967294 vertices, the file ends after 1";
    off("OFF\n4294967294 4000000000 0\n0 0 0\n0 0\n", Syntax, 4, ends);
    off("OFF\n1 0\n0 nan 0\n", NotFinite, 3, "'nan' is not a finite number");
    off("OFF\n1 0\n0 1e400 0\n", Overflow, 3, "'1e400' is too large for a double");
    off("COFF\n1 0\n0 0 0 1\n", Syntax, 3, "a vertex colour of 1 numbers");
    let face = |text: &str, kind, reason: &str| {
        off(&format!("OFF\n1 1\n0 0 0\n{text}\n"), kind, 4, reason);
    };
    face("2 0 0", FaceTooSmall, "face 0 has 2 vertices, at least 3 are needed");
    face("3 0 0 1", IndexOutOfRange, "face 0 names vertex 1, but the file has 1");
    face("3 0 0 -1", IndexOutOfRange, "face 0 names vertex -1, but the file has 1");
    face("3 0 0", Syntax, "the header promises 1 faces, the file ends after 0");
    face("3 0 0 0 1 2 3 4 5", Syntax, "5 numbers after the face: a colour has 4");
    face("99999999999", TooLarge, "more face corners than a 32-bit index can name");
}

const PLY: &str = "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty float x\n\
    property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_index\n\
    end_header\n0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n";

#[test]
fn foreign_ply_is_read_with_notes() {
    let mesh = read(PLY, Format::Ply);
    assert_eq!(mesh.positions[2], [0.0, f64::from(0.1_f32), 0.0], "a float is a float");
    assert_eq!((mesh.vertex_lines, mesh.face_lines), (vec![11, 12, 13], vec![14]));
    let text = "ply\nformat ascii 1.0\nelement edge 1\nproperty int a\nelement face 1\n\
        property uchar flag\nproperty list int uint vertex_indices\nelement vertex 3\n\
        property double u\nproperty double v\nproperty int x\nproperty int y\n\
        property int z\nproperty list uchar int ring\nproperty uchar red\nelement none 7\n\
        end_header\n5\n1 3 0 1 2\n\n.1 .2 0 0 0 2 7 8 9\n0 0 1 0 0 0 8\n0 0 0 1 0 0 7\nmore";
    let mesh = read(text.replace('\n', "\r\n"), Format::Ply);
    assert_eq!((mesh.uvs[0], mesh.positions[1]), ([0.1, 0.2], [1.0, 0.0, 0.0]));
    assert_eq!(mesh.attributes[0].name, "red");
    assert_eq!(mesh.attributes[0].values, [9.0, 8.0, 7.0]);
    let expected = [
        "1 elements edge were dropped",
        "the face property flag was dropped",
        "the vertex property ring was dropped",
        "7 elements none were dropped",
        "what follows the last element was dropped",
    ];
    assert_eq!(mesh.notes, expected);
}

#[test]
fn wrong_ply_headers_are_refused_at_their_line() {
    use ErrorKind::{Syntax, TooLarge, Unsupported};
    let ply = |from: &str, to: &str, kind, line, reason: &str| {
        let text = PLY.replacen(from, to, 1);
        refused(text, Format::Ply, kind, Element::Line(line), reason);
    };
    ply("ply", "plx", Syntax, 1, "'plx': not a PLY file");
    ply("ascii", "latin", Syntax, 2, "'latin' where ascii or binary_..._endian is expected");
    ply("1.0", "2.0", Unsupported, 2, "PLY version '2.0' is not supported");
    ply("format ascii 1.0", "", Syntax, 10, "no format in the header");
    ply("comment", "komment", Syntax, 3, "'komment' where a PLY header keyword is expected");
    ply("vertex 3", "vertex -3", Syntax, 4, "'-3' where the number of elements is expected");
    ply("vertex 3", "vertex 4294967295", TooLarge, 4, "more vertices than a 32-bit index can name");
    ply("element face", "element vertex", Syntax, 8, "a second element 'vertex'");
    ply("float y", "float x", Syntax, 6, "'x' is no new property");
    ply("float y", "real y", Syntax, 6, "'real' where a number type is expected");
    ply("float y", "float w", Syntax, 10, "the vertices have no numbers x, y and z");
    ply("vertex_index", "points", Syntax, 10, "the faces have no list vertex_indices of integers");
    ply("uchar int", "float int", Syntax, 9, "a list whose length is a float");
    let long = "y".repeat(256);
    let cut = format!("'{}...' where a name is expected", "y".repeat(40));
    ply("float y", &format!("float {long}"), Syntax, 6, &cut);
    ply("float y", "float", Syntax, 6, "'' where a name is expected");
    let many = (0..1022).map(|i| format!("float y{i}\nproperty ")).collect::<Vec<_>>().concat();
    let bound = "more than 1024 elements or properties are not supported";
    ply("float y", &format!("{many}float y"), Unsupported, 1029, bound);
    ply("end_header", "", Syntax, 11, "'0' where a PLY header keyword is expected");
}

#[test]
fn wrong_ply_rows_are_refused_at_their_line() {
    use ErrorKind::{FaceTooSmall, IndexOutOfRange, NotFinite, Overflow, Syntax};
    let ply = |from: &str, to: &str, kind, line, reason: &str| {
        let text = PLY.replacen(from, to, 1);
        refused(text, Format::Ply, kind, Element::Line(line), reason);
    };
    let vertex = |to: &str, kind, reason: &str| ply("\n1 0 0\n", to, kind, 12, reason);
    vertex("\n1 0 inf\n", NotFinite, "'inf' is not a finite number");
    vertex("\n1 0 1e39\n", Overflow, "'1e39' is too large for a float");
    vertex("\n1 0 0 0\n", Syntax, "'0' where the end of the line is expected");
    vertex("\n1 0\n", Syntax, "the line ends before all properties are there");
    let face = |to: &str, kind, reason: &str| ply("3 0 1 2", to, kind, 14, reason);
    face("3 0 1 3", IndexOutOfRange, "face 0 names vertex 3, but the file has 3");
    face("3 0 1 -1", IndexOutOfRange, "face 0 names vertex -1, but the file has 3");
    face("2 0 1", FaceTooSmall, "face 0 has 2 vertices, at least 3 are needed");
    face("300 0 1", Syntax, "'300' does not fit a uchar");
    let ends = "the header promises 2 elements face, the file ends after 1";
    ply("face 1", "face 2", Syntax, 14, ends);
}

#[test]
fn huge_claims_in_binary_ply_cost_nothing() {
    let ply = |table: &str, data: &[u8], at: usize, kind, reason: &str| {
        let header = format!("ply\nformat binary_little_endian 1.0\n{table}\nend_header\n");
        let at = Element::Byte((header.len() + at) as u64);
        refused([header.as_bytes(), data].concat(), Format::Ply, kind, at, reason);
    };
    let xyz = "property float x\nproperty float y\nproperty float z";
    let ends = "the header promises 4294967294 elements vertex, the file ends after 1";
    ply(&format!("element vertex 4294967294\n{xyz}"), &[0; 14], 12, ErrorKind::Syntax, ends);
    let nan = [[0; 8].as_slice(), &f32::NAN.to_le_bytes()].concat();
    let bad = "NaN before here is not a finite number";
    ply(&format!("element vertex 1\n{xyz}"), &nan, 12, ErrorKind::NotFinite, bad);
    let ends = "the header promises 1 elements other, the file ends after 0";
    let list = "element other 1\nproperty list uint char l";
    ply(list, &[0xff; 12], 12, ErrorKind::Syntax, ends);
    let negative = [&[0xff][..], &[0; 8]].concat();
    let list = "element face 1\nproperty list char int vertex_indices";
    ply(list, &negative, 1, ErrorKind::Syntax, "a list of -1 numbers");
    // Rows without properties are not counted one by one.
    let header =
        "ply\nformat binary_big_endian 1.0\nelement other 9223372036854775807\nend_header\n";
    let mesh = read(header, Format::Ply);
    assert_eq!(mesh.notes, ["9223372036854775807 elements other were dropped"]);
}

#[test]
fn names_that_clash_in_ply_are_refused() {
    let mut mesh = MeshFile { attributes: attributes(), ..full() };
    "nx".clone_into(&mut mesh.attributes[0].name);
    let options = WriteOptions::default();
    let error = io::write_to(Vec::new(), Format::Ply, &mesh, &options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidText);
}

fn triangles() -> MeshFile {
    MeshFile {
        positions: vec![[0.0, -0.0, 0.0], [2.0, 0.0, 0.5], [2.0, 1.0, 0.0], [0.0, 1.5, 0.0]],
        face_sizes: vec![3, 3],
        face_vertices: vec![0, 1, 2, 0, 2, 3],
        ..MeshFile::default()
    }
}

#[test]
fn stl_welds_what_it_wrote() {
    let mesh = triangles();
    let quad = MeshFile { face_sizes: vec![4], face_vertices: vec![0, 1, 2, 3], ..triangles() };
    assert_eq!(io::losses(&quad, Format::Stl).len(), 2);
    for encoding in [Encoding::Binary, Encoding::Ascii] {
        let data = write(&mesh, Format::Stl, encoding);
        let back = read(&data, Format::Stl);
        assert_eq!((bits(&back), &back.face_vertices), (bits(&mesh), &mesh.face_vertices));
        let welded = "6 triangle corners were welded to 4 vertices";
        assert_eq!(back.notes, ["2 facet normals were dropped", welded]);
        assert_eq!(write(&quad, Format::Stl, encoding), data);
    }
}

#[test]
fn zeros_of_either_sign_are_the_same_corner() {
    let facet = |a: &str, b: &str, c: &str| {
        format!(
            "facet normal 0 0 nan\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n"
        )
    };
    let (first, second) = (facet("0 -0 0", "1 0 0", "0 1 0"), facet("-0 0 0", "0 1 -0", "1 1 0"));
    let mesh = read(format!("SOLID\n{first}{second}endsolid\n"), Format::Stl);
    assert_eq!(mesh.face_vertices, [0, 1, 2, 0, 2, 3]);
    assert!(mesh.positions[0][1].is_sign_negative(), "the first spelling stays");
}

#[test]
fn text_stl_keeps_solids_and_double_precision() {
    let mut mesh = triangles();
    mesh.positions[1][0] = 0.1;
    mesh.objects.names = vec!["a part".to_owned(), "b".to_owned()];
    mesh.objects.of_face = vec![1, 0];
    let text = write(&mesh, Format::Stl, Encoding::Ascii);
    assert!(text.starts_with(b"solid b\nfacet normal "));
    let back = read(text, Format::Stl);
    assert_eq!(bits(&back), bits(&mesh));
    assert_eq!((back.objects.get(0), back.objects.get(1)), (Some("b"), Some("a part")));
    assert_eq!((back.face_lines, back.vertex_lines), (vec![2, 11], vec![4, 5, 6, 15]));
}

#[test]
fn facet_normals_are_units_at_every_scale() {
    for scale in [1e-300, 1e-30, 1.0, 1e30, 1e300] {
        let positions = vec![[0.0, 0.0, 0.0], [scale, 0.0, 0.0], [0.0, scale, 0.0]];
        let (face_sizes, face_vertices) = (vec![3], vec![0, 1, 2]);
        let mesh = MeshFile { positions, face_sizes, face_vertices, ..MeshFile::default() };
        let text = String::from_utf8(write(&mesh, Format::Stl, Encoding::Ascii)).unwrap();
        assert!(text.starts_with("solid\nfacet normal 0 0 1\n"), "{text}");
    }
}

#[test]
fn wrong_binary_stl_is_refused_where_it_is_wrong() {
    let good = write(&triangles(), Format::Stl, Encoding::Binary);
    let stl = |data: &[u8], kind, at, reason: &str| {
        refused(data, Format::Stl, kind, Element::Byte(at), reason);
    };
    let ends = "the header promises 2 triangles, the file ends after 1";
    stl(&good[..180], ErrorKind::Syntax, 134, ends);
    let neither = "neither a text STL (no solid) nor a binary one (84 bytes)";
    stl(&good[..80], ErrorKind::Syntax, 0, neither);
    let mut claim = good.clone();
    claim[80..84].copy_from_slice(&[0xff; 4]);
    let ends = "the header promises 4294967295 triangles, the file ends after 2";
    stl(&claim, ErrorKind::Syntax, 184, ends);
    let mut nan = good;
    nan[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    let bad = "NaN in the triangle here is not a finite number";
    stl(&nan, ErrorKind::NotFinite, 84, bad);
    let mut far = triangles();
    far.positions[0][0] = 1e39;
    let error = io::write_to(Vec::new(), Format::Stl, &far, &WriteOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Overflow);
}

#[test]
fn wrong_text_stl_is_refused_at_its_line() {
    use ErrorKind::{NotFinite, Syntax};
    let text = String::from_utf8(write(&triangles(), Format::Stl, Encoding::Ascii)).unwrap();
    let stl = |from: &str, to: &str, kind, line, reason: &str| {
        let text = text.replacen(from, to, 1);
        refused(text, Format::Stl, kind, Element::Line(line), reason);
    };
    stl("vertex 2 0 0.5", "vertex 2 0 inf", NotFinite, 5, "'inf' is not a finite number");
    stl("vertex 2 0 0.5", "vertex 2 0", Syntax, 6, "'vertex' where a number is expected");
    stl("endloop", "vertex 1 1 1", Syntax, 7, "'vertex' where endloop is expected");
    stl("facet", "fazet", Syntax, 2, "'fazet' where facet or endsolid is expected");
    let ends = "the file ends where facet or endsolid is expected";
    stl("endsolid\n", "", Syntax, 15, ends);
}
