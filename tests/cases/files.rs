//! The cases as files: the reader takes them as they stand, or refuses them with the
//! line, and the writer gives them back.

use carvel::ErrorKind;
use carvel::base::NONE;
use carvel::io::{self, Format, MeshFile, WriteOptions};

use crate::case::{Case, Outcome};
use crate::cases;

fn read(case: &Case) -> carvel::Result<MeshFile> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases");
    let text = std::fs::read(format!("{folder}/{}.obj", case.name)).expect("a case");
    io::read_from(&text[..], Format::Obj, &case.name)
}

/// What reading should come to: files are checked for less than meshes are.
fn expected(case: &Case) -> Outcome {
    const READERS: [&str; 3] = ["FaceTooSmall", "IndexOutOfRange", "NotFinite"];
    match (case.special("read"), case.expected("")) {
        (Some(outcome), _) => outcome.clone(),
        (None, Outcome::Error(kind)) if READERS.contains(&kind.as_str()) => {
            Outcome::Error(kind.clone())
        }
        _ => Outcome::Ok,
    }
}

#[test]
fn files_are_read_as_they_stand_or_refused() {
    for case in cases() {
        match read(&case) {
            Ok(file) => {
                assert_eq!(Outcome::Ok, expected(&case), "{}", case.name);
                check_read(&case, &file);
            }
            Err(error) => {
                let kind = format!("{:?}", error.kind());
                assert_eq!(Outcome::Error(kind), expected(&case), "{error}");
                assert_eq!(error.to_string().lines().count(), 1, "{error}");
            }
        }
    }
}

fn check_read(case: &Case, file: &MeshFile) {
    let name = &case.name;
    let bits = |p: &[[f64; 3]]| p.as_flattened().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&file.positions), bits(&case.positions), "{name}");
    assert_eq!((&file.face_sizes, &file.face_vertices), (&case.sizes, &case.indices), "{name}");
    assert_eq!(file.uvs, case.uvs, "{name}");
    if case.uvs.is_empty() {
        assert_eq!(file.face_uvs, None, "{name}");
    } else {
        assert_eq!(file.face_uvs.as_ref(), Some(&case.uv_indices), "{name}");
    }
    check_tags(case, file);
}

/// The file's tags are the case's, but for those that a later one replaced.
fn check_tags(case: &Case, file: &MeshFile) {
    let name = &case.name;
    let creases: Vec<_> = file.creases.iter().map(|c| (c.vertices, c.sharpness)).collect();
    let sharp: Vec<_> = file.sharp_vertices.iter().map(|s| (s.vertex, s.sharpness)).collect();
    if file.notes.is_empty() {
        assert_eq!(creases, case.creases, "{name}");
    } else {
        assert_eq!(file.notes, ["1 creases were replaced by later ones"], "{name}");
        assert_eq!(creases, [case.creases[1]], "{name}");
    }
    assert_eq!((&sharp, &file.holes), (&case.sharp_vertices, &case.holes), "{name}");
}

#[test]
fn files_come_back_from_their_own_text() {
    for case in cases() {
        let Ok(file) = read(&case) else { continue };
        let mut text = Vec::new();
        let options = WriteOptions::default();
        io::write_to(&mut text, Format::Obj, &file, &options).expect("what was read");
        let back = io::read_from(&text[..], Format::Obj, &case.name).expect("what was written");
        let lines = |file: MeshFile| MeshFile {
            face_lines: Vec::new(),
            vertex_lines: Vec::new(),
            notes: Vec::new(),
            ..file
        };
        assert_eq!(lines(back), lines(file), "{}", case.name);
    }
}

/// A corner without a texture coordinate is one in the file and in the case.
#[test]
fn missing_indices_are_the_same_number() {
    assert_eq!(NONE, crate::case::NONE);
}

/// Every kind that a case names is one of the library's.
#[test]
fn expected_kinds_exist() {
    let kinds = [
        ErrorKind::IndexOutOfRange,
        ErrorKind::FaceTooSmall,
        ErrorKind::RepeatedVertex,
        ErrorKind::InconsistentOrientation,
        ErrorKind::NonManifoldEdge,
        ErrorKind::NonManifoldVertex,
        ErrorKind::InvalidTag,
        ErrorKind::NotFinite,
        ErrorKind::Overflow,
    ];
    let known: Vec<String> = kinds.iter().map(|kind| format!("{kind:?}")).collect();
    for case in cases() {
        for situation in ["", "cut", "sharpen", "f32", "tags", "read"] {
            if let Some(Outcome::Error(kind)) = case.special(situation) {
                assert!(known.contains(kind), "{}: {kind}", case.name);
            }
        }
    }
}
