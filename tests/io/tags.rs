//! Subdivision tags in OBJ: what is kept, what is noted, what is refused and where.

use carvel::io::{
    self, BoundaryTag, CreasingTag, FaceVaryingTag, Format, MeshFile, SchemeTags, TriangleTag,
    WriteOptions,
};
use carvel::{Crease, Element, ErrorKind, SharpVertex};

/// Two quads side by side, open; six lines.
const QUADS: &str = "v 0 0 0\nv 1 0 0\nv 2 0 1\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\n";

fn read(tags: &str) -> MeshFile {
    io::read_from(format!("{QUADS}{tags}").as_bytes(), Format::Obj, "t.obj").unwrap()
}

fn write(mesh: &MeshFile) -> carvel::Result<String> {
    let mut out = Vec::new();
    io::write_to(&mut out, Format::Obj, mesh, &WriteOptions::default())?;
    Ok(String::from_utf8(out).unwrap())
}

/// The mesh as read from its own text, but for the line numbers.
fn again(mesh: &MeshFile) -> MeshFile {
    let text = write(mesh).unwrap();
    let back = io::read_from(text.as_bytes(), Format::Obj, "t.obj").unwrap();
    let (face_lines, vertex_lines) = (mesh.face_lines.clone(), mesh.vertex_lines.clone());
    MeshFile { face_lines, vertex_lines, ..back }
}

fn crease(a: u32, b: u32, sharpness: f32) -> Crease {
    Crease { vertices: [a, b], sharpness }
}

fn sharp(vertex: u32, sharpness: f32) -> SharpVertex {
    SharpVertex { vertex, sharpness }
}

/// Tags are refused on the line after the faces.
#[track_caller]
fn refused(tag: &str, kind: ErrorKind, reason: &str) {
    let text = format!("{QUADS}{tag}\n");
    let error = io::read_from(text.as_bytes(), Format::Obj, "t.obj").unwrap_err();
    assert_eq!(error.to_string(), format!("t.obj:9: {reason}"));
    assert_eq!((error.kind(), error.elements()[0]), (kind, Element::Line(9)));
}

#[test]
fn tags_count_from_zero() {
    let mesh = read("t crease 2/1/0 1 4 2.5\nt corner 1/1/0 0 10\nt hole 1/0/0 1\n");
    assert_eq!(mesh.creases, [crease(1, 4, 2.5)]);
    assert_eq!(mesh.sharp_vertices, [sharp(0, 10.0)]);
    assert_eq!(mesh.holes, [1]);
    assert_eq!(mesh.scheme, SchemeTags::default());
    assert!(mesh.notes.is_empty(), "{:?}", mesh.notes);
}

#[test]
fn one_statement_may_have_many_elements() {
    let edges = |tag: &str| -> Vec<_> {
        let mesh = read(tag);
        mesh.creases.iter().map(|c| (c.vertices, c.sharpness.to_string())).collect()
    };
    let made = |a, b, s: &str| ([a, b], s.to_owned());
    assert_eq!(edges("t crease 4/1/0 0 1 4 5 2"), [made(0, 1, "2"), made(4, 5, "2")]);
    assert_eq!(edges("t crease 4/2/0 0 1 4 5 2 3"), [made(0, 1, "2"), made(4, 5, "3")]);
    assert_eq!(edges("t crease 3/1/0 0 1 2 2"), [made(0, 1, "2"), made(1, 2, "2")]);
    let chain = edges("t crease 4/3/0 0 1 4 5 .3 1 10");
    assert_eq!(chain, [made(0, 1, "0.3"), made(1, 4, "1"), made(4, 5, "10")]);
    let corners = read("t corner 3/1/0 0 2 5 4\n\tt  corner 2/2/0 1 3 1 2 # a comment\n");
    let expected = [sharp(0, 4.0), sharp(2, 4.0), sharp(5, 4.0), sharp(1, 1.0), sharp(3, 2.0)];
    assert_eq!(corners.sharp_vertices, expected);
    assert_eq!(read("t hole 2/0/0 1 0\nt hole 1/0/0 1\n").holes, [1, 0]);
}

#[test]
fn the_scheme_has_its_tags() {
    for (i, boundary) in
        [BoundaryTag::None, BoundaryTag::EdgeAndCorner, BoundaryTag::Edge].into_iter().enumerate()
    {
        let mesh = read(&format!("t interpolateboundary 1/0/0 {i}\n"));
        assert_eq!(mesh.scheme.boundary, Some(boundary));
        assert_eq!(again(&mesh), mesh);
    }
    let modes = [
        FaceVaryingTag::None,
        FaceVaryingTag::CornersOnly,
        FaceVaryingTag::CornersPlus1,
        FaceVaryingTag::CornersPlus2,
        FaceVaryingTag::Boundaries,
        FaceVaryingTag::All,
    ];
    for (i, mode) in modes.into_iter().enumerate() {
        let mesh = read(&format!("t facevaryinginterpolateboundary 1/0/0 {i}\n"));
        assert_eq!(mesh.scheme.face_varying, Some(mode));
        assert_eq!(again(&mesh), mesh);
    }
    for (words, creasing, triangles) in [
        (["normal", "catmark"], CreasingTag::Uniform, TriangleTag::CatmullClark),
        (["chaikin", "smooth"], CreasingTag::Chaikin, TriangleTag::Smooth),
    ] {
        let [method, rule] = words;
        let mesh =
            read(&format!("t creasemethod 0/0/1 {method}\nt smoothtriangles 0/0/1 {rule}\n"));
        assert_eq!(mesh.scheme.creasing, Some(creasing));
        assert_eq!(mesh.scheme.triangles, Some(triangles));
        assert_eq!(again(&mesh), mesh);
    }
}

#[test]
fn all_tags_survive() {
    let tags = "t crease 2/1/0 1 4 0.3\nt crease 2/1/0 5 4 3.7\nt corner 1/1/0 2 10\n\
        t hole 1/0/0 0\nt interpolateboundary 1/0/0 2\nt facevaryinginterpolateboundary 1/0/0 3\n\
        t creasemethod 0/0/1 chaikin\nt smoothtriangles 0/0/1 smooth\n";
    let mesh = read(tags);
    assert!(write(&mesh).unwrap().ends_with(tags), "{}", write(&mesh).unwrap());
    assert_eq!(again(&mesh), mesh);
}

#[test]
fn sharpness_reads_back_exactly() {
    let odd = [0.0, 0.1, 1.0 / 3.0, 3.7, 1e-45, f32::MIN_POSITIVE, 16_777_217.0, f32::MAX];
    for sharpness in odd {
        let mesh = MeshFile { creases: vec![crease(0, 1, sharpness)], ..read("") };
        let back = again(&mesh).creases[0].sharpness;
        assert_eq!(back.to_bits(), sharpness.to_bits(), "{sharpness}");
    }
}

#[test]
fn tags_may_precede_what_they_name() {
    let text = format!("t crease 2/1/0 1 4 2\nt corner 1/1/0 5 1\nt hole 1/0/0 1\n{QUADS}");
    let mesh = io::read_from(text.as_bytes(), Format::Obj, "t.obj").unwrap();
    assert_eq!((mesh.creases.len(), mesh.sharp_vertices.len(), mesh.holes.len()), (1, 1, 1));
}

#[test]
fn the_last_of_several_tags_holds() {
    let mesh = read(
        "t crease 2/1/0 1 4 1\nt crease 2/1/0 0 1 2\nt crease 2/1/0 4 1 3\nt crease 2/1/0 0 1 2\n\
         t corner 2/2/0 3 3 1 2\n",
    );
    assert_eq!(mesh.creases, [crease(4, 1, 3.0), crease(0, 1, 2.0)]);
    assert_eq!(mesh.sharp_vertices, [sharp(3, 2.0)]);
    let notes =
        ["1 creases were replaced by later ones", "1 corner tags were replaced by later ones"];
    assert_eq!(mesh.notes, notes);
}

#[test]
fn tags_of_other_kinds_are_noted() {
    let mesh = read(
        "t vertexedit 4/3/3 0 1 2 3 .1 .2 .3 add P value\nt facevaryingpropagatecorners 1/0/0 1\n\
         t vertexedit 0/0/0\nt\nt %$ 1\n",
    );
    let expected = [
        "2 statements t were dropped",
        "1 statements t facevaryingpropagatecorners were dropped",
        "2 statements t vertexedit were dropped",
    ];
    assert_eq!(mesh.notes, expected);
}

#[test]
fn wrong_counts_are_refused() {
    let syntax = |tag: &str, reason: &str| refused(tag, ErrorKind::Syntax, reason);
    syntax("t crease", "'' where a triple of counts such as 2/1/0 is expected");
    syntax("t crease 0 1 2", "'0' where a triple of counts such as 2/1/0 is expected");
    syntax("t crease 2/1/0 0 1", "a tag of '2/1/0' takes 3 values, 2 follow");
    syntax("t crease 2/1/0 0 1 2 3", "a tag of '2/1/0' takes 3 values, 4 follow");
    syntax("t crease 2/1/0 0 1 # 2", "a tag of '2/1/0' takes 3 values, 2 follow");
    let huge = "9223372036854775807/9223372036854775807/9";
    let all = usize::MAX;
    syntax(
        &format!("t crease {huge} 1"),
        &format!("a tag of '{}...' takes {all} values, 1 follow", &huge[..40]),
    );
    let rule = "a crease takes two vertices an edge, and one sharpness or one an edge";
    syntax("t crease 2/2/0 0 1 2 3", &format!("a tag of '2/2/0': {rule}"));
    syntax("t crease 2/0/0 0 1", &format!("a tag of '2/0/0': {rule}"));
    syntax("t crease 1/1/0 0 1", &format!("a tag of '1/1/0': {rule}"));
    syntax("t crease 2/1/1 0 1 2 a", "a tag of '2/1/1': this tag takes no words");
    let rule = "corners take one sharpness or one a vertex";
    syntax("t corner 0/1/0 1", &format!("a tag of '0/1/0': {rule}"));
    syntax("t corner 3/2/0 0 1 2 1 1", &format!("a tag of '3/2/0': {rule}"));
    syntax("t hole 1/1/0 0 1", "a tag of '1/1/0': holes take faces alone");
    syntax("t hole 0/0/0", "a tag of '0/0/0': holes take faces alone");
    syntax("t interpolateboundary 0/1/0 1", "a tag of '0/1/0': this tag takes one integer");
    syntax("t creasemethod 1/0/0 1", "a tag of '1/0/0': this tag takes one word");
}

#[test]
fn wrong_values_are_refused() {
    use ErrorKind::{IndexOutOfRange, InvalidTag, NotFinite, Overflow, Syntax};
    let beyond = "but the file has 6 (tags count from 0)";
    refused("t crease 2/1/0 0 6 1", IndexOutOfRange, &format!("a tag names vertex 6, {beyond}"));
    refused("t corner 1/1/0 99 1", IndexOutOfRange, &format!("a tag names vertex 99, {beyond}"));
    let hole = "a tag names face 2, but the file has 2 (tags count from 0)";
    refused("t hole 1/0/0 2", IndexOutOfRange, hole);
    let negative = "a tag names vertex -1: tags count from 0";
    refused("t crease 2/1/0 -1 0 1", IndexOutOfRange, negative);
    let large = "a tag names face 4294967295: tags count from 0";
    refused("t hole 1/0/0 4294967295", IndexOutOfRange, large);
    refused("t hole 1/0/0 x", Syntax, "'x' where a face of a tag is expected");
    refused("t crease 2/1/0 1 1 1", InvalidTag, "a crease from vertex 1 to itself");
    refused("t crease 2/1/0 0 1 -0.5", InvalidTag, "the sharpness '-0.5' is negative");
    refused("t corner 1/1/0 0 nan", NotFinite, "'nan' is not a finite number");
    refused("t corner 1/1/0 0 inf", NotFinite, "'inf' is not a finite number");
    let single = "the sharpness '1e39' is too large for single precision";
    refused("t corner 1/1/0 0 1e39", Overflow, single);
    refused("t corner 1/1/0 0 x", Syntax, "'x' where a number is expected");
    let boundary = "'3' where a number from 0 to 2 is expected";
    refused("t interpolateboundary 1/0/0 3", Syntax, boundary);
    let method = "'sharp' where normal or chaikin is expected";
    refused("t creasemethod 0/0/1 sharp", Syntax, method);
}

#[test]
fn broken_tags_are_not_written() {
    let kind = |change: fn(&mut MeshFile)| {
        let mut mesh = read("t crease 2/1/0 1 4 2\nt corner 1/1/0 5 1\nt hole 1/0/0 1\n");
        change(&mut mesh);
        write(&mesh).unwrap_err().kind()
    };
    assert_eq!(kind(|m| m.creases[0].vertices[1] = 6), ErrorKind::IndexOutOfRange);
    assert_eq!(kind(|m| m.creases[0].vertices[1] = 1), ErrorKind::InvalidTag);
    assert_eq!(kind(|m| m.creases[0].sharpness = -1.0), ErrorKind::InvalidTag);
    assert_eq!(kind(|m| m.creases[0].sharpness = f32::NAN), ErrorKind::NotFinite);
    assert_eq!(kind(|m| m.sharp_vertices[0].vertex = 6), ErrorKind::IndexOutOfRange);
    assert_eq!(kind(|m| m.sharp_vertices[0].sharpness = -1.0), ErrorKind::InvalidTag);
    assert_eq!(kind(|m| m.sharp_vertices[0].sharpness = f32::INFINITY), ErrorKind::NotFinite);
    assert_eq!(kind(|m| m.holes[0] = 2), ErrorKind::IndexOutOfRange);
}

#[test]
fn formats_without_tags_say_so() {
    let mesh = read(
        "t crease 2/1/0 1 4 2\nt corner 2/1/0 2 5 1\nt hole 1/0/0 1\nt creasemethod 0/0/1 normal\n",
    );
    assert!(io::losses(&mesh, Format::Obj).is_empty());
    for format in [Format::Off, Format::Ply, Format::Stl] {
        let lost = io::losses(&mesh, format);
        for what in ["1 creases", "2 sharp vertices", "1 holes", "the tags of the scheme"] {
            let line = format!("{what}: {format} cannot hold that");
            assert!(lost.contains(&line), "{line} is not in {lost:?}");
        }
    }
    assert!(io::losses(&read(""), Format::Off).is_empty());
}
