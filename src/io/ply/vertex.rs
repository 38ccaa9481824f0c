//! What becomes of each vertex property.

use super::header::{ElementType, Kind};
use crate::base::Result;
use crate::io::place::Place;
use crate::io::{ColorType, MeshFile, NumberType, VertexAttribute, VertexColors};

/// The names that texture coordinates go by, the preferred first.
pub(super) const UV_NAMES: [[&str; 2]; 3] = [["s", "t"], ["u", "v"], ["texture_u", "texture_v"]];
pub(super) const POSITION_NAMES: [&str; 3] = ["x", "y", "z"];
pub(super) const NORMAL_NAMES: [&str; 3] = ["nx", "ny", "nz"];
pub(super) const COLOR_NAMES: [&str; 4] = ["red", "green", "blue", "alpha"];

/// Where a number of a vertex goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Slot {
    Position(usize),
    Normal(usize),
    Color(usize),
    Uv(usize),
    Attribute(usize),
    /// A list, which a vertex attribute cannot hold.
    Dropped,
}

/// The slots of a vertex table's properties, in order.
#[derive(Debug)]
pub(super) struct Layout {
    pub slots: Vec<Slot>,
    pub normals: bool,
    pub uvs: bool,
    pub colors: Option<(usize, ColorType)>,
}

impl Layout {
    /// Distributes the properties and makes room in the mesh; `place` is the
    /// header's end, for the error of a vertex without a position.
    pub fn new(element: &ElementType, place: Place<'_>, mesh: &mut MeshFile) -> Result<Self> {
        let mut slots: Vec<_> = element.properties.iter().map(|_| Slot::Dropped).collect();
        let mut assign = |names: &[&str], fits: fn(NumberType) -> bool, slot: fn(usize) -> Slot| {
            let columns: Option<Vec<_>> =
                names.iter().map(|name| column(element, name, fits)).collect();
            let columns = columns?;
            columns.iter().enumerate().for_each(|(i, &column)| slots[column] = slot(i));
            Some(())
        };
        if assign(&POSITION_NAMES, |_| true, Slot::Position).is_none() {
            return Err(place.syntax("the vertices have no numbers x, y and z"));
        }
        let normals = assign(&NORMAL_NAMES, NumberType::is_float, Slot::Normal).is_some();
        let uvs =
            UV_NAMES.iter().any(|names| assign(names, NumberType::is_float, Slot::Uv).is_some());
        let mut color = |fits: fn(NumberType) -> bool| {
            let width = if assign(&COLOR_NAMES, fits, Slot::Color).is_some() { 4 } else { 3 };
            let some = width == 4 || assign(&COLOR_NAMES[..3], fits, Slot::Color).is_some();
            some.then_some(width)
        };
        let colors = match color(|kind| kind == NumberType::U8) {
            Some(width) => Some((width, ColorType::U8)),
            None => color(NumberType::is_float).map(|width| (width, ColorType::Float)),
        };
        take_the_rest(element, &mut slots, mesh);
        mesh.colors = colors.map(|(width, kind)| VertexColors { width, values: Vec::new(), kind });
        Ok(Self { slots, normals, uvs, colors })
    }
}

/// The column of a scalar property whose type fits.
fn column(element: &ElementType, name: &str, fits: fn(NumberType) -> bool) -> Option<usize> {
    element.properties.iter().position(|property| {
        property.name == name && matches!(property.kind, Kind::Scalar(kind) if fits(kind))
    })
}

/// Scalars without a meaning of their own become attributes, lists a note.
fn take_the_rest(element: &ElementType, slots: &mut [Slot], mesh: &mut MeshFile) {
    for (property, slot) in element.properties.iter().zip(slots) {
        if *slot != Slot::Dropped {
            continue;
        }
        let name = property.name.clone();
        let one_word = name.bytes().all(|b| b.is_ascii_graphic());
        match property.kind {
            Kind::Scalar(kind) if one_word => {
                *slot = Slot::Attribute(mesh.attributes.len());
                mesh.attributes.push(VertexAttribute { name, kind, values: Vec::new() });
            }
            _ => mesh.notes.push(format!("the vertex property {name} was dropped")),
        }
    }
}
