//! Writes STL. Polygons become fans around their first corner.

use super::binary;
use crate::base::{ErrorKind, Result};
use crate::io::sink::Sink;
use crate::io::{Encoding, MeshFile};
use std::io::Write;

type Triangle = [[f64; 3]; 3];

pub(in crate::io) fn write<W: Write>(
    sink: &mut Sink<'_, W>,
    mesh: &MeshFile,
    encoding: Encoding,
) -> Result<()> {
    match encoding {
        Encoding::Ascii => write_text(sink, mesh),
        Encoding::Binary => write_binary(sink, mesh),
        Encoding::BinaryBigEndian => {
            Err(sink.error(ErrorKind::Unsupported, "STL is never big-endian"))
        }
    }
}

fn write_binary<W: Write>(sink: &mut Sink<'_, W>, mesh: &MeshFile) -> Result<()> {
    let count: u64 = mesh.face_sizes.iter().map(|&size| u64::from(size) - 2).sum();
    let Ok(count) = u32::try_from(count) else {
        return Err(sink.error(ErrorKind::TooLarge, format!("{count} triangles do not fit STL")));
    };
    sink.expect(binary::size(count));
    // Not beginning with `solid`, by which some readers know a text.
    sink.put(format!("{:80}", "binary STL written by carvel"));
    sink.put(count.to_le_bytes());
    for face in mesh.faces() {
        for triangle in fan(mesh, face) {
            put_floats(sink, &normal(&triangle))?;
            put_floats(sink, triangle.as_flattened())?;
            sink.put([0, 0]);
            sink.pause()?;
        }
    }
    Ok(())
}

fn put_floats<W: Write>(sink: &mut Sink<'_, W>, values: &[f64]) -> Result<()> {
    for &value in values {
        let single = value as f32;
        if single.is_infinite() {
            return Err(sink.overflow(value));
        }
        sink.put(single.to_le_bytes());
    }
    Ok(())
}

/// Text, with one solid per run of faces of the same object.
fn write_text<W: Write>(sink: &mut Sink<'_, W>, mesh: &MeshFile) -> Result<()> {
    let mut solid = mesh.objects.get(0);
    begin_solid(sink, "solid", solid);
    for (i, face) in mesh.faces().enumerate() {
        let object = mesh.objects.get(i);
        if object != solid {
            begin_solid(sink, "endsolid", solid);
            begin_solid(sink, "solid", object);
            solid = object;
        }
        for triangle in fan(mesh, face) {
            facet(sink, &triangle)?;
        }
    }
    begin_solid(sink, "endsolid", solid);
    Ok(())
}

fn begin_solid<W: Write>(sink: &mut Sink<'_, W>, keyword: &str, name: Option<&str>) {
    sink.put(keyword);
    if let Some(name) = name {
        sink.put(b" ");
        sink.put(name);
    }
    sink.put(b"\n");
}

fn facet<W: Write>(sink: &mut Sink<'_, W>, triangle: &Triangle) -> Result<()> {
    sink.put(b"facet normal");
    sink.put_floats(&normal(triangle))?;
    sink.put(b"\nouter loop\n");
    for position in triangle {
        sink.put(b"vertex");
        sink.put_floats(position)?;
        sink.put(b"\n");
    }
    sink.put(b"endloop\nendfacet\n");
    sink.pause()
}

fn fan<'m>(mesh: &'m MeshFile, face: &'m [u32]) -> impl Iterator<Item = Triangle> {
    let at = |vertex: u32| mesh.positions[vertex as usize];
    face[1..].windows(2).map(move |pair| [at(face[0]), at(pair[0]), at(pair[1])])
}

/// The unit normal, or zero for a triangle without area.
fn normal(triangle: &Triangle) -> [f64; 3] {
    // Scaled to 1, before the differences and after, so that neither a huge
    // nor a tiny triangle leaves the range of doubles on the way.
    let [a, b, c] = scaled(*triangle);
    let [u, v] = scaled([difference(b, a), difference(c, a)]);
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 { n.map(|x| x / length) } else { [0.0; 3] }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Vectors divided by their largest component, if any is not zero.
fn scaled<const N: usize>(vectors: [[f64; 3]; N]) -> [[f64; 3]; N] {
    let largest = vectors.as_flattened().iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    if largest > 0.0 { vectors.map(|v| v.map(|x| x / largest)) } else { vectors }
}
