//! One step of any scheme on one mesh, ready to be applied to values.

use super::dual_step::DualStep;
use super::kernel::Value;
use super::patch_step::PatchStep;
use super::primal_step::PrimalStep;
use super::tile_step::TileStep;
use crate::base::{Context, Error, ErrorKind, Result, Scalar};
use crate::refine::Split;
use crate::scheme::{RowSink, Scheme, SplitKind};

/// By which rows values are refined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Interpolation {
    /// The scheme's own, as positions are.
    #[default]
    Vertex,
    /// Linear: midpoints of edges and means of faces, old vertices keep their values;
    /// for primal schemes.
    Varying,
}

impl Scheme {
    /// Refuses rows that the scheme does not have.
    pub(crate) fn check_interpolation(&self, interpolation: Interpolation) -> Result<()> {
        if interpolation == Interpolation::Vertex || self.split() != SplitKind::Corner {
            return Ok(());
        }
        let message = "varying values belong to primal schemes; a dual one has no linear rows yet";
        Err(Error::new(ErrorKind::Unsupported, message))
    }
}

/// One step of a scheme on one mesh.
pub(super) struct Step<'a> {
    children: usize,
    kind: Kind<'a>,
}

enum Kind<'a> {
    Dual(DualStep<'a>),
    Primal(PrimalStep<'a>),
    Patches(PatchStep<'a>),
    Tiles(TileStep<'a>),
}

impl<'a> Step<'a> {
    /// The step that belongs to a planned split.
    pub(super) fn new(
        scheme: &'a Scheme,
        split: &'a Split<'a>,
        interpolation: Interpolation,
    ) -> Result<Self> {
        let kind = match split {
            Split::Corner(split) => Kind::Dual(DualStep::new(scheme, split)),
            Split::Primal(split) => Kind::Primal(PrimalStep::new(scheme, split, interpolation)?),
        };
        Ok(Self { children: split.counts().vertices as usize, kind })
    }

    /// Several primal steps at once.
    pub(super) fn patches(step: PatchStep<'a>) -> Self {
        Self { children: step.children(), kind: Kind::Patches(step) }
    }

    /// Several dual steps at once.
    pub(super) fn tiles(step: TileStep<'a>) -> Self {
        Self { children: step.children(), kind: Kind::Tiles(step) }
    }

    /// The step of face-varying values.
    pub(super) fn channel(step: PrimalStep<'a>) -> Self {
        Self { children: step.children(), kind: Kind::Primal(step) }
    }

    /// The number of child vertices.
    pub(super) fn children(&self) -> usize {
        self.children
    }

    /// The values of all child vertices.
    ///
    /// `values` has one entry per parent vertex, `out` one per child vertex.
    pub(super) fn apply<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        out: &mut [Value<T, W>],
        scratch: &mut Scratch<T, W>,
    ) -> Result<()> {
        match &self.kind {
            Kind::Dual(step) => step.apply(context, values, out, scratch),
            Kind::Primal(step) => step.apply(context, values, out, scratch),
            Kind::Patches(step) => step.apply(context, values, out, scratch),
            Kind::Tiles(step) => step.apply(context, values, out, scratch),
        }
    }
}

/// Memory that a step needs besides its input and output.
#[derive(Debug)]
pub(super) struct Scratch<T, const W: usize> {
    /// Split points of the irregular corners.
    pub(super) irregular: Vec<Value<T, W>>,
    /// The stage before the last, where there are several; of tiles with a pass the first level.
    pub(super) stage: Vec<Value<T, W>>,
    /// What the corners of patches become.
    pub(super) corners: Vec<Value<T, W>>,
}

impl<T, const W: usize> Default for Scratch<T, W> {
    fn default() -> Self {
        Self { irregular: Vec::new(), stage: Vec::new(), corners: Vec::new() }
    }
}

impl<T, const W: usize> Scratch<T, W> {
    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        let lists = [&self.irregular, &self.stage, &self.corners];
        let values: usize = lists.iter().map(|list| list.capacity()).sum();
        (values * size_of::<Value<T, W>>()) as u64
    }
}

/// A row applied to stored values.
pub(super) struct Sum<'v, T, const W: usize> {
    pub(super) values: &'v [Value<T, W>],
    total: Value<T, W>,
}

impl<'v, T: Scalar, const W: usize> Sum<'v, T, W> {
    pub(super) fn new(values: &'v [Value<T, W>]) -> Self {
        Self { values, total: [T::default(); W] }
    }

    /// The value of the row that `emit` sends.
    pub(super) fn of(&mut self, emit: impl FnOnce(&mut Self)) -> Value<T, W> {
        self.total = [T::default(); W];
        emit(self);
        self.total
    }
}

impl<T: Scalar, const W: usize> RowSink<f64> for Sum<'_, T, W> {
    fn add(&mut self, vertex: u32, weight: f64) {
        accumulate(&mut self.total, T::from_f64(weight), &self.values[vertex as usize]);
    }
}

#[inline(always)]
pub(super) fn accumulate<T: Scalar, const W: usize>(
    total: &mut Value<T, W>,
    w: T,
    value: &Value<T, W>,
) {
    for (sum, &x) in total.iter_mut().zip(value) {
        *sum = *sum + w * x;
    }
}
