//! All levels of a refinement, kept: topology once, values as often as wanted.

use super::columns::{Column, Place};
use super::predict::Prediction;
use super::step::{Interpolation, Step};
use super::values::{check, check_length, check_overflow, lanes};
use crate::base::memory;
use crate::base::{Context, Error, ErrorKind, Result, Scalar};
use crate::mesh::Mesh;
use crate::refine::adjacency::Recycled;
use crate::refine::{EdgeNumbers, FaceOrigin, Split, VertexOrigin};
use crate::scheme::{ComposedRows, RowSink, Scheme, SchemeRows};
use std::sync::Arc;

/// The topology of levels 0 to n of a mesh under a scheme.
///
/// # Example
/// ```
/// use carvel::{Context, Hierarchy, Mesh, Scheme};
/// let cube = Mesh::from_polygons(8, &[4; 6], &[
///     0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3,
/// ])?;
/// let hierarchy = Hierarchy::new(&Context::serial(), cube, Scheme::doo_sabin(), 2)?;
/// assert_eq!(hierarchy.mesh(1).faces(), 26);
/// assert_eq!(hierarchy.mesh(2).faces(), 98);
/// # Ok::<(), carvel::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Hierarchy {
    scheme: Scheme,
    levels: Vec<Arc<Mesh>>,
}

impl Hierarchy {
    /// Builds levels 1 to `levels`, all with adjacency. A control mesh that is
    /// shared already is not copied.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] or [`ErrorKind::MemoryCeiling`] before anything
    /// is built; [`ErrorKind::Cancelled`].
    pub fn new(
        context: &Context,
        mesh: impl Into<Arc<Mesh>>,
        scheme: Scheme,
        levels: u32,
    ) -> Result<Self> {
        let mesh = mesh.into();
        let plan = Prediction::new(&mesh, &scheme, levels)?;
        plan.check_index_type()?;
        context.check_memory(plan.topology_bytes())?;
        context.report(0.0)?;
        let mut hierarchy = Self { scheme, levels: vec![mesh] };
        let mut memory = EdgeNumbers::default();
        for level in 0..levels {
            let scheme = &hierarchy.scheme;
            let parent = hierarchy.mesh(level);
            let holes = scheme.holes(parent)?;
            let split = hierarchy.split(context, level, &mut memory)?;
            let child = split.mesh(context, scheme.carried(&holes), &mut Recycled::default())?;
            split.recycle(&mut memory);
            hierarchy.levels.push(child.into());
            context.report(f64::from(level + 1) / f64::from(levels))?;
        }
        Ok(hierarchy)
    }

    /// The number of the last level.
    pub fn last_level(&self) -> u32 {
        self.levels.len() as u32 - 1
    }

    /// The scheme.
    pub fn scheme(&self) -> &Scheme {
        &self.scheme
    }

    /// The mesh of a level; 0 is the control mesh.
    ///
    /// # Panics
    /// If `level` is beyond [`Hierarchy::last_level`].
    pub fn mesh(&self, level: u32) -> &Mesh {
        &self.levels[level as usize]
    }

    /// The mesh of a level, shared: it may outlive the hierarchy.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for a level that was not built.
    pub fn shared_mesh(&self, level: u32) -> Result<Arc<Mesh>> {
        self.check_level(level)?;
        Ok(Arc::clone(&self.levels[level as usize]))
    }

    /// Refines values on the control vertices to a level: `width` values per
    /// vertex in, `width` per vertex of that level out.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for slices of the wrong length,
    /// [`ErrorKind::ParameterOutOfRange`] for a level that was not built,
    /// [`ErrorKind::NotFinite`], [`ErrorKind::Overflow`],
    /// [`ErrorKind::MemoryCeiling`], [`ErrorKind::Cancelled`].
    pub fn refine<T: Scalar>(
        &self,
        context: &Context,
        level: u32,
        values: &[T],
        width: usize,
        out: &mut [T],
    ) -> Result<()> {
        self.interpolate(context, level, Interpolation::Vertex, values, width, out)
    }

    /// The same by rows of choice.
    ///
    /// # Errors
    /// As [`Hierarchy::refine`]; [`ErrorKind::Unsupported`] for varying values under a
    /// dual scheme.
    pub fn interpolate<T: Scalar>(
        &self,
        context: &Context,
        level: u32,
        interpolation: Interpolation,
        values: &[T],
        width: usize,
        out: &mut [T],
    ) -> Result<()> {
        self.scheme.check_interpolation(interpolation)?;
        self.check_level(level)?;
        check(context, "values", values, width, self.levels[0].vertices())?;
        check_length("output", out.len(), width, self.mesh(level).vertices())?;
        context.report(0.0)?;
        if level == 0 {
            out.copy_from_slice(values);
            return Ok(());
        }
        let plan = Prediction::new(self.mesh(0), &self.scheme, level)?.level_by_level();
        context.check_memory(plan.scratch_bytes(width as u64, T::BYTES))?;
        let steps = (lanes(width).count() as u32 * level) as f64;
        let mut memory = EdgeNumbers::default();
        for (group, (first, n)) in (0_u32..).zip(lanes(width)) {
            let place = Place { attribute: 0, width, first };
            let mut column = Column::new(n);
            for step in 0..level {
                let split = self.split(context, step, &mut memory)?;
                let rule = Step::new(&self.scheme, &split, interpolation)?;
                if step + 1 < level {
                    column.step(context, &rule, step as usize, place, values)?;
                } else {
                    column.finish(context, &rule, step as usize, place, values, out)?;
                }
                split.recycle(&mut memory);
                context.report((group * level + step + 1) as f64 / steps)?;
            }
        }
        check_overflow(context, out, level as usize)
    }

    /// The parent elements, at `level − 1`, of the vertices of a level.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for level 0 or one that was not built.
    pub fn vertex_origins(&self, level: u32) -> Result<Vec<VertexOrigin>> {
        self.split_to(level)?.vertex_origins()
    }

    /// The parent elements, at `level − 1`, of the faces of a level.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for level 0 or one that was not built.
    pub fn face_origins(&self, level: u32) -> Result<Vec<FaceOrigin>> {
        let split = self.split_to(level)?;
        let mut origins = memory::reserved(split.counts().faces as usize)?;
        split.each_face_origin(|_, origin| origins.push(origin));
        Ok(origins)
    }

    /// The rows of the step from `level − 1` to `level`, stage by stage: the
    /// split's rows on the parent's vertices, then each pass's on the children. With the tuned
    /// rule, which some vertices have instead of split and pass, a step is one stage.
    /// `row` gets the stage, the vertex, and the row in `W`'s arithmetic.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for level 0 or one that was not built.
    pub fn each_row<W: crate::base::Weight>(
        &self,
        level: u32,
        mut row: impl FnMut(usize, u32, &[(u32, W)]),
    ) -> Result<()> {
        (0..self.scheme.stages()).try_for_each(|stage| {
            self.each_row_of(level, stage, |vertex, entries: &[(u32, W)]| {
                row(stage, vertex, entries);
            })
        })
    }

    /// The rows of one stage of the step from `level − 1` to `level`; see
    /// [`Hierarchy::each_row`].
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for level 0, one that was not built, or a
    /// stage that the scheme does not have.
    pub fn each_row_of<W: crate::base::Weight>(
        &self,
        level: u32,
        stage: usize,
        mut row: impl FnMut(u32, &[(u32, W)]),
    ) -> Result<()> {
        let split = self.split_to(level)?;
        let stages = self.scheme.stages();
        if stage >= stages {
            return Err(Error::new(
                ErrorKind::ParameterOutOfRange,
                format!("stage {stage}: a step has {stages}, counted from 0"),
            ));
        }
        let vertices = split.counts().vertices as u32;
        if !self.scheme.is_staged() {
            let mut rows = ComposedRows::<W>::new(&self.scheme, &split);
            for vertex in 0..vertices {
                let entries: Vec<(u32, W)> = rows.row(vertex).into_iter().collect();
                row(vertex, &entries);
                rows.forget();
            }
            return Ok(());
        }
        let mut rows = SchemeRows::<W>::new(&self.scheme, &split);
        let mut entries = Entries(Vec::new());
        for vertex in 0..vertices {
            entries.0.clear();
            match stage.checked_sub(1) {
                None => rows.split_row(vertex, &mut entries),
                Some(pass) => rows.pass_row(pass, vertex, &mut entries),
            }
            row(vertex, &entries.0);
        }
        Ok(())
    }

    fn check_level(&self, level: u32) -> Result<()> {
        if level <= self.last_level() {
            return Ok(());
        }
        Err(Error::new(
            ErrorKind::ParameterOutOfRange,
            format!("level {level} was not built, the last is {}", self.last_level()),
        ))
    }

    /// The split that leads to a level.
    fn split_to(&self, level: u32) -> Result<Split<'_>> {
        self.check_level(level)?;
        let before = level.checked_sub(1).ok_or_else(|| {
            Error::new(
                ErrorKind::ParameterOutOfRange,
                "level 0 is the control mesh, it has no parent",
            )
        })?;
        self.split(&Context::serial(), before, &mut EdgeNumbers::default())
    }

    pub(super) fn split(
        &self,
        context: &Context,
        level: u32,
        memory: &mut EdgeNumbers,
    ) -> Result<Split<'_>> {
        self.scheme.plan(context, self.mesh(level), memory)
    }
}

/// A row as a list.
struct Entries<W>(Vec<(u32, W)>);

impl<W> RowSink<W> for Entries<W> {
    fn add(&mut self, vertex: u32, weight: W) {
        self.0.push((vertex, weight));
    }
}
