//! OpenSubdiv 3.5: `Far::TopologyRefiner` and `Far::PrimvarRefiner`.

use crate::bridge::ffi;
use crate::peer::code;
use crate::run::{Run, empty, message};
use crate::{Channel, Control, Options, Peer, PeerMesh, Result, Scheme, Task};
use cxx::UniquePtr;

/// OpenSubdiv.
#[derive(Debug, Clone, Copy)]
pub struct OpenSubdiv;

impl Peer for OpenSubdiv {
    fn name(&self) -> &'static str {
        "OpenSubdiv"
    }

    fn version(&self) -> String {
        ffi::osd_version()
    }

    fn schemes(&self) -> &'static [Scheme] {
        // In the order of Sdc::SchemeType.
        &[Scheme::Bilinear, Scheme::CatmullClark, Scheme::Loop]
    }

    fn start(&self, task: &Task) -> Result<Run> {
        create(task).and_then(|osd| Run::new(Ok(ffi::osd_into_run(osd))))
    }
}

impl OpenSubdiv {
    /// Refines and keeps the refiner, to ask about levels, lineage and further values.
    ///
    /// # Errors
    /// What OpenSubdiv calls an error, or would not notice.
    pub fn refinement(self, task: &Task, levels: u32) -> Result<Refinement> {
        let mut inner = create(task)?;
        ffi::osd_refine(inner.pin_mut(), levels).map_err(message)?;
        Ok(Refinement { inner, levels, warnings: ffi::osd_take_warnings() })
    }
}

/// Where the vertices of a level go in the limit, in OpenSubdiv's numbering; xyz each.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexLimits {
    /// The points.
    pub points: Vec<f64>,
    /// Two tangents.
    pub tangents: [Vec<f64>; 2],
}

impl OpenSubdiv {
    /// Limits in double precision of a level with this many vertices, by
    /// `PrimvarRefiner::Limit`, which takes semi-sharp features for sharp ones.
    ///
    /// # Errors
    /// What OpenSubdiv does not take, or for another number of vertices.
    pub fn limits(self, task: &Task, level: u32, vertices: usize) -> Result<VertexLimits> {
        let tags = Tags::of(task.control);
        let options = options(&self, task.scheme, task.options)?;
        let [mut points, mut first, mut second] = [(); 3].map(|()| vec![0.0; 3 * vertices]);
        let (soup, tags) = (task.control.soup(), tags.view());
        ffi::osd_limits(&soup, &tags, &options, level, &mut points, &mut first, &mut second)
            .map_err(message)?;
        Ok(VertexLimits { points, tangents: [first, second] })
    }
}

fn create(task: &Task) -> Result<UniquePtr<ffi::Osd>> {
    let tags = Tags::of(task.control);
    let options = options(&OpenSubdiv, task.scheme, task.options)?;
    ffi::osd_new(&task.control.soup(), &tags.view(), &options, task.precision.code())
        .map_err(message)
}

pub(crate) fn options(peer: &dyn Peer, scheme: Scheme, given: Options) -> Result<ffi::OsdOptions> {
    Ok(ffi::OsdOptions {
        scheme: code(peer, scheme)?,
        boundary: given.boundary as u8,
        face_varying: given.face_varying as u8,
        creasing: given.creasing as u8,
        triangles: given.triangles as u8,
    })
}

/// Tags as the flat arrays that the shim takes.
pub(crate) struct Tags<'a> {
    crease_ends: Vec<u32>,
    crease_sharpness: Vec<f32>,
    corners: Vec<u32>,
    corner_sharpness: Vec<f32>,
    holes: &'a [u32],
    channel_values: Vec<u32>,
    channel_indices: Vec<u32>,
}

impl<'a> Tags<'a> {
    pub(crate) fn of(control: &'a Control) -> Self {
        let sizes = |channel: &Channel| (channel.values.len() / channel.width) as u32;
        Self {
            crease_ends: control.creases.iter().flat_map(|crease| crease.vertices).collect(),
            crease_sharpness: control.creases.iter().map(|crease| crease.sharpness).collect(),
            corners: control.sharp_vertices.iter().map(|corner| corner.vertex).collect(),
            corner_sharpness: control.sharp_vertices.iter().map(|it| it.sharpness).collect(),
            holes: &control.holes,
            channel_values: control.channels.iter().map(sizes).collect(),
            channel_indices: control.channels.iter().flat_map(|it| it.indices.clone()).collect(),
        }
    }

    pub(crate) fn view(&self) -> ffi::Tags<'_> {
        ffi::Tags {
            crease_ends: &self.crease_ends,
            crease_sharpness: &self.crease_sharpness,
            corners: &self.corners,
            corner_sharpness: &self.corner_sharpness,
            holes: self.holes,
            channel_values: &self.channel_values,
            channel_indices: &self.channel_indices,
        }
    }
}

/// Where a refined vertex comes from, in the numbering of the level before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parent {
    /// A vertex.
    Vertex(u32),
    /// An edge by its ends, the smaller first.
    Edge(u32, u32),
    /// A face.
    Face(u32),
}

/// One level of a refinement, in OpenSubdiv's numbering.
#[derive(Debug, Clone, Default)]
pub struct Level {
    /// Corners per face.
    pub sizes: Vec<u32>,
    /// The corners' vertices, face after face.
    pub indices: Vec<u32>,
    /// True for faces that are holes.
    pub holes: Vec<bool>,
    /// The parent of each vertex; empty at level 0.
    pub parents: Vec<Option<Parent>>,
    /// The parent of each face; empty at level 0.
    pub face_parents: Vec<u32>,
}

impl Level {
    /// The faces as slices, in order.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        crate::control::faces(&self.sizes, &self.indices)
    }
}

/// Which topology values follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Values {
    /// On vertices, by the scheme's rows.
    Vertex,
    /// On vertices, linearly.
    Varying,
    /// On the values of a channel.
    FaceVarying {
        /// The channel.
        channel: u32,
    },
}

/// A refined mesh with all its levels.
pub struct Refinement {
    inner: UniquePtr<ffi::Osd>,
    levels: u32,
    warnings: Vec<String>,
}

impl Refinement {
    /// What OpenSubdiv warned of.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The last level.
    ///
    /// # Errors
    /// None that a refinement can give.
    pub fn mesh(&self) -> Result<PeerMesh> {
        let mut mesh = empty(&self.inner.level_counts(self.levels).map_err(message)?);
        let into = (&mut mesh.sizes, &mut mesh.indices, &mut mesh.positions);
        ffi::osd_copy(&self.inner, into.0, into.1, into.2).map_err(message)?;
        Ok(mesh)
    }

    /// A level's faces and where they and its vertices come from.
    ///
    /// # Errors
    /// For a level that is not there.
    pub fn level(&self, level: u32) -> Result<Level> {
        let counts = self.inner.level_counts(level).map_err(message)?;
        let (mut sizes, mut indices) = (vec![0; counts.faces], vec![0; counts.corners]);
        let mut holes = vec![0; counts.faces];
        self.inner.copy_faces(level, &mut sizes, &mut indices, &mut holes).map_err(message)?;
        let holes = holes.into_iter().map(|hole| hole != 0).collect();
        let (parents, face_parents) = self.lineage(level, &counts)?;
        Ok(Level { sizes, indices, holes, parents, face_parents })
    }

    fn lineage(&self, level: u32, counts: &ffi::Counts) -> Result<(Vec<Option<Parent>>, Vec<u32>)> {
        /// No kind of parent.
        const NOBODY: u8 = u8::MAX;
        if level == 0 {
            return Ok(Default::default());
        }
        let (mut kinds, mut ends) = (vec![NOBODY; counts.vertices], vec![0; 2 * counts.vertices]);
        let mut face_parents = vec![0; counts.faces];
        self.inner
            .copy_lineage(level, &mut kinds, &mut ends, &mut face_parents)
            .map_err(message)?;
        let parent = |(&kind, ends): (&u8, &[u32])| match kind {
            0 => Some(Parent::Vertex(ends[0])),
            1 => Some(Parent::Edge(ends[0].min(ends[1]), ends[0].max(ends[1]))),
            2 => Some(Parent::Face(ends[0])),
            _ => None,
        };
        Ok((kinds.iter().zip(ends.chunks(2)).map(parent).collect(), face_parents))
    }

    /// The number of values of a channel at the last level.
    ///
    /// # Errors
    /// For a channel that is not there.
    pub fn channel_size(&self, channel: u32) -> Result<usize> {
        self.inner.channel_size(channel).map_err(message)
    }

    /// A channel's index for each corner of the last level.
    ///
    /// # Errors
    /// For a channel that is not there.
    pub fn channel_indices(&self, channel: u32) -> Result<Vec<u32>> {
        let counts = self.inner.level_counts(self.levels).map_err(message)?;
        let mut indices = vec![0; counts.corners];
        self.inner.copy_channel(channel, &mut indices).map_err(message)?;
        Ok(indices)
    }

    /// Refines values of any width, in double precision, to the last level.
    ///
    /// # Errors
    /// For values that do not match the topology they follow.
    pub fn interpolate(&self, values: Values, data: &[f64], width: usize) -> Result<Vec<f64>> {
        let vertices = self.inner.level_counts(self.levels).map_err(message)?.vertices;
        let (kind, channel, records) = match values {
            Values::Vertex => (0, 0, vertices),
            Values::Varying => (1, 0, vertices),
            Values::FaceVarying { channel } => (2, channel, self.channel_size(channel)?),
        };
        let mut out = vec![0.0; records * width];
        self.inner.interpolate(kind, channel, data, width, &mut out).map_err(message)?;
        Ok(out)
    }
}
