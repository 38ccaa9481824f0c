//! No bytes whatsoever make a reader panic, and what it accepts can be written.

use carvel::io::{self, Encoding, Format, MeshFile, WriteOptions};
use proptest::prelude::*;

/// A small file of each format and encoding, with a bit of everything.
fn seeds() -> Vec<(Format, Vec<u8>)> {
    let obj = "mtllib a\no x\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1e0 0 0 0 1\nv 0 1 -.5 1 1 1\n\
        vt 0 0\nvt 1 0\nvn 0 0 1\ng a b\nusemtl m\ns 1\nf 1/1/1 2//1 3/2 -1\nl 1 2\nf 1 \\\n2 3\n\
        t crease 3/2/0 0 1 2 .3 10\nt corner 2/1/0 0 3 1.5\nt hole 1/0/0 1\nt interpolateboundary 1/0/0 1\n\
        t creasemethod 0/0/1 chaikin\nt edit 1/1/1 0 1 a\n";
    let mesh = io::read_from(obj.as_bytes(), Format::Obj, "seed").unwrap();
    let by_vertex = MeshFile {
        uvs: vec![[0.0, 0.5]; 4],
        face_uvs: Some(mesh.face_vertices.clone()),
        normals: vec![[0.0, 0.0, 1.0]; 4],
        face_normals: Some(mesh.face_vertices.clone()),
        ..mesh
    };
    let write = |format, encoding| {
        let mut out = Vec::new();
        let options = WriteOptions { encoding, ..WriteOptions::default() };
        io::write_to(&mut out, format, &by_vertex, &options).unwrap();
        (format, out)
    };
    vec![
        (Format::Obj, obj.as_bytes().to_vec()),
        write(Format::Off, Encoding::Ascii),
        write(Format::Ply, Encoding::Ascii),
        write(Format::Ply, Encoding::Binary),
        write(Format::Ply, Encoding::BinaryBigEndian),
        write(Format::Stl, Encoding::Ascii),
        write(Format::Stl, Encoding::Binary),
    ]
}

/// Reads; an error must be one line that names the file, a mesh must be sound
/// and come back from every format.
fn exercise(data: &[u8], format: Format) {
    match io::read_from(data, format, "file") {
        Err(error) => {
            let message = error.to_string();
            assert_eq!(message.lines().count(), 1, "{message:?}");
            assert!(message.starts_with("file") && message.len() < 400, "{message:?}");
            assert!(!error.elements().is_empty(), "{message:?}");
        }
        Ok(mesh) => {
            mesh.check().unwrap();
            assert!(mesh.notes.iter().all(|note| note.lines().count() == 1));
            write_and_read(&mesh, format);
        }
    }
}

fn write_and_read(mesh: &MeshFile, format: Format) {
    // A text STL may hold numbers that a binary one cannot.
    let encoding = if format == Format::Stl { Encoding::Ascii } else { Encoding::Binary };
    let options = WriteOptions { encoding, ..WriteOptions::default() };
    let mut out = Vec::new();
    io::write_to(&mut out, format, mesh, &options).unwrap();
    let back = io::read_from(&out[..], format, "back").unwrap();
    if format == Format::Obj {
        assert_eq!((&back.creases, &back.holes), (&mesh.creases, &mesh.holes));
        assert_eq!((&back.sharp_vertices, back.scheme), (&mesh.sharp_vertices, mesh.scheme));
    }
    if format != Format::Stl {
        assert_eq!(back.positions, mesh.positions);
        assert_eq!(back.face_vertices, mesh.face_vertices);
        assert_eq!(back.face_sizes, mesh.face_sizes);
    }
}

#[test]
fn every_truncation_is_an_error_or_a_mesh() {
    for (format, seed) in seeds() {
        for end in 0..=seed.len() {
            exercise(&seed[..end], format);
        }
    }
}

#[test]
fn every_byte_replaced_is_an_error_or_a_mesh() {
    for (format, seed) in seeds() {
        for at in 0..seed.len() {
            for byte in [0, b'\n', b'\r', b' ', b'-', b'9', b'\\', 0x7f, 0xff] {
                let mut data = seed.clone();
                data[at] = byte;
                exercise(&data, format);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutations_are_errors_or_meshes(
        seed in 0..7_usize,
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..12),
    ) {
        let (format, mut data) = seeds().swap_remove(seed);
        for (at, byte, what) in edits {
            let at = at.index(data.len());
            match what {
                0 => data[at] = byte,
                1 => data.insert(at, byte),
                2 => drop(data.remove(at)),
                _ => data.extend_from_within(at..),
            }
            prop_assume!(!data.is_empty());
        }
        exercise(&data, format);
    }

    #[test]
    fn noise_is_an_error_or_a_mesh(data in prop::collection::vec(any::<u8>(), 0..400)) {
        for format in Format::ALL {
            exercise(&data, format);
        }
    }
}
