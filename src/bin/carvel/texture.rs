//! Texture coordinates with seams, through the schemes that have rules for them.
//!
//! A face some of whose corners have none keeps none. Such faces share one value in the
//! channel, so that they make a region of their own with a seam around it, and that region
//! is taken out again afterwards.

use crate::memory::zeroed;
use crate::precise::Precise;
use crate::records::Kept;
use carvel::base::NONE;
use carvel::hierarchy::ChannelOutput;
use carvel::io::MeshFile;
use carvel::limit::{Derivatives, Surface, Tessellation};
use carvel::{Channel, Context, FaceVaryingMode, Mesh, Prediction, Result, Scheme};

/// The texture coordinates of a control mesh.
#[derive(Debug)]
pub struct Texture {
    /// Who takes which.
    pub channel: Channel,
    /// The values, 2 each.
    pub values: Vec<f64>,
    /// The faces of the file that have none, if there are any.
    bare: Option<Vec<bool>>,
    /// One line about faces that lost theirs.
    pub note: Option<String>,
}

impl Texture {
    /// Those of a file, if a face has any.
    ///
    /// # Errors
    /// As [`Channel::new`].
    pub fn of(file: &MeshFile, mesh: &Mesh, mode: FaceVaryingMode) -> Result<Option<Self>> {
        let Some(given) = &file.face_uvs else { return Ok(None) };
        let mut indices = given.clone();
        let (bare, partly) = bare_faces(file, &mut indices);
        if bare.iter().all(|bare| *bare) {
            return Ok(None);
        }
        let mut values = file.uvs.as_flattened().to_vec();
        let some = bare.contains(&true);
        if some {
            values.extend([0.0, 0.0]);
        }
        let note = (partly > 0).then(|| match partly {
            1 => "1 face lost its texture coordinates: some of its corners have none".to_owned(),
            n => {
                format!("{n} faces lost their texture coordinates: some of their corners have none")
            }
        });
        let channel = Channel::new(mesh, &indices, values.len() / 2, mode)?;
        Ok(Some(Self { channel, values, bare: some.then_some(bare), note }))
    }

    /// Those of triangles on the surface: what is the same on both sides of an edge has one number.
    ///
    /// # Errors
    /// As [`Surface::of_channel`] and [`Surface::evaluate`]; if the system has no room.
    pub fn on_surface(
        &self,
        context: &Context,
        mesh: &Mesh,
        scheme: &Scheme,
        made: &Tessellation,
    ) -> Result<Refined<f64>> {
        let surface = Surface::of_channel(context, mesh, &self.channel, scheme)?;
        let places = made.places.len() as u64;
        let mut values = zeroed(0.0, 2 * places)?;
        let none = Derivatives::None;
        surface.evaluate(context, &made.places, &self.values, 2, none, &mut values)?;
        let mut numbers = zeroed(NONE, places)?;
        let kept = join(&made.place_vertices, &mut values, &mut numbers)?;
        values.truncate(2 * kept);
        let mut indices = zeroed(0, 3 * made.triangle_places.len() as u64)?;
        for (index, &place) in indices.iter_mut().zip(made.triangle_places.as_flattened()) {
            *index = numbers[place as usize];
        }
        Ok(Refined { indices, values })
    }

    /// Puts refined coordinates into the refined file; `faces` gives the control file's
    /// face for every refined one.
    pub fn unload(&self, refined: Refined<f64>, faces: &[u32], file: &mut MeshFile) {
        let Refined { mut indices, values } = refined;
        let mut uvs = values.as_chunks().0.to_vec();
        if let Some(bare) = &self.bare {
            let sizes = file.face_sizes.iter().zip(faces);
            let dressed: Vec<bool> = sizes
                .flat_map(|(&size, &face)| std::iter::repeat_n(!bare[face as usize], size as usize))
                .collect();
            let kept = Kept::of(uvs.len(), &indices, |corner| dressed[corner]);
            kept.keep(&mut uvs, 1);
            // What bare corners take goes, for it is theirs alone.
            kept.renumber(&mut indices);
        }
        file.uvs = uvs;
        file.face_uvs = Some(indices);
    }
}

/// Gives all corners of faces without texture coordinates the value after the last;
/// returns which faces those are, and how many of them had some.
fn bare_faces(file: &MeshFile, indices: &mut [u32]) -> (Vec<bool>, usize) {
    let extra = file.uvs.len() as u32;
    let mut rest = indices;
    let mut partly = 0;
    let bare = file.face_sizes.iter().map(|&size| {
        let (face, after) = std::mem::take(&mut rest).split_at_mut(size as usize);
        rest = after;
        let missing = face.iter().filter(|&&i| i == NONE).count();
        partly += usize::from(missing > 0 && missing < face.len());
        if missing > 0 {
            face.fill(extra);
        }
        missing > 0
    });
    (bare.collect(), partly)
}

/// Coordinates that are nearer than this part of the largest are the same.
const SAME: f64 = 1e-9;

/// Numbers the pairs of values of places, those of a vertex that are the same once, and moves them
/// to their numbers. Returns how many there are.
fn join(vertices: &[u32], values: &mut [f64], numbers: &mut [u32]) -> Result<usize> {
    let largest = values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let pair = |values: &[f64], place: usize| [values[2 * place], values[2 * place + 1]];
    let same = |a: [f64; 2], b: [f64; 2]| (0..2).all(|k| (a[k] - b[k]).abs() <= SAME * largest);
    let mut order = zeroed(0_u32, vertices.len() as u64)?;
    order.iter_mut().zip(0..).for_each(|(place, i)| *place = i);
    order.sort_unstable_by_key(|&place| (vertices[place as usize], place));
    for at_vertex in order.chunk_by(|a, b| vertices[*a as usize] == vertices[*b as usize]) {
        for (i, &place) in at_vertex.iter().enumerate() {
            let mut before = at_vertex[..i].iter().copied();
            let here = pair(values, place as usize);
            let first = before.find(|&other| same(pair(values, other as usize), here));
            // The first place that has them, while they have no numbers.
            numbers[place as usize] = first.unwrap_or(place);
        }
    }
    let mut count = 0;
    for place in 0..vertices.len() {
        let first = numbers[place] as usize;
        numbers[place] = if first == place { count as u32 } else { numbers[first] };
        if first == place {
            let here = pair(values, place);
            values[2 * count..][..2].copy_from_slice(&here);
            count += 1;
        }
    }
    Ok(count)
}

/// Refined texture coordinates.
#[derive(Debug)]
pub struct Refined<T> {
    /// The value of every corner.
    indices: Vec<u32>,
    /// The values, 2 each.
    values: Vec<T>,
}

impl<T: Precise> Refined<T> {
    /// Room for the last level.
    ///
    /// # Errors
    /// As [`Prediction::of_channel`]; if the system has no room.
    pub fn room(channel: &Channel, scheme: &Scheme, levels: u32) -> Result<Self> {
        let plan = Prediction::of_channel(channel, scheme, levels)?;
        let last = plan.last();
        let indices = zeroed(0, last.corners)?;
        Ok(Self { indices, values: zeroed(T::default(), 2 * last.vertices)? })
    }

    /// Where refinement writes.
    pub fn output(&mut self) -> ChannelOutput<'_, T> {
        ChannelOutput { indices: &mut self.indices, values: &mut self.values }
    }

    /// The same in double precision.
    ///
    /// # Errors
    /// If the system has no room.
    pub fn widen(self) -> Result<Refined<f64>> {
        Ok(Refined { indices: self.indices, values: T::widen(self.values)? })
    }
}

/// Bytes that refined texture coordinates take in memory.
///
/// # Errors
/// As [`Prediction::of_channel`].
pub fn bytes<T: Precise>(texture: &Texture, scheme: &Scheme, levels: u32) -> Result<u64> {
    let plan = Prediction::of_channel(&texture.channel, scheme, levels)?;
    let last = plan.last();
    let narrow = if T::BYTES < 8 { 2 * T::BYTES } else { 0 };
    // The values twice: as numbers and as the file's pairs.
    Ok(last.vertices.saturating_mul(32 + narrow).saturating_add(4 * last.corners))
}
