//! What every reader target does with its bytes.

use carvel::io::{self, Encoding, Format, MeshFile, WriteOptions};

/// Reads; a mesh that is accepted must be sound and survive its own format.
pub fn exercise(data: &[u8], format: Format) {
    match io::read_from(data, format, "file") {
        Err(error) => assert_eq!(error.to_string().lines().count(), 1, "{error}"),
        Ok(mesh) => round_trip(&mesh, format),
    }
}

fn round_trip(mesh: &MeshFile, format: Format) {
    mesh.check().expect("what is read is sound");
    // A text STL may hold numbers that a binary one cannot.
    let encoding = if format == Format::Stl { Encoding::Ascii } else { Encoding::Binary };
    let options = WriteOptions { encoding, ..WriteOptions::default() };
    let mut out = Vec::new();
    io::write_to(&mut out, format, mesh, &options).expect("it can be written");
    let back = io::read_from(&out[..], format, "back").expect("it can be read again");
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
