//! OpenSubdiv's limit surface at any point, by either of its two ways.

use crate::bridge::ffi;
use crate::opensubdiv::{Tags, options};
use crate::run::message;
use crate::{OpenSubdiv, Result, Task};
use cxx::UniquePtr;

/// A point of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The caller's face.
    pub face: u32,
    /// The corner whose quarter it is; 0 in a quad, and in a triangle under Loop's scheme.
    pub sector: u32,
    /// In the face or the quarter: from its first corner along the outgoing edge, and along the
    /// edge before.
    pub uv: [f64; 2],
}

/// Patches that hold the control positions, and what they were last evaluated to.
pub struct Patches {
    inner: UniquePtr<ffi::Patches>,
    samples: usize,
    records: usize,
}

impl Patches {
    /// `Far::PatchTable`, whose extraordinary places are isolated so many levels, up to 10, and
    /// are approximated by Gregory patches from there. Samples are found by `Far::PatchMap`.
    ///
    /// # Errors
    /// What OpenSubdiv does not take.
    pub fn far(task: &Task, isolation: u32) -> Result<Self> {
        Self::new(task, isolation, ffi::far_patches_new)
    }

    /// A `Bfr::Surface` for each face, approximated beyond as many levels.
    ///
    /// # Errors
    /// What OpenSubdiv does not take.
    pub fn bfr(task: &Task, isolation: u32) -> Result<Self> {
        Self::new(task, isolation, ffi::bfr_patches_new)
    }

    fn new(task: &Task, isolation: u32, make: Make) -> Result<Self> {
        let tags = Tags::of(task.control);
        let options = options(&OpenSubdiv, task.scheme, task.options)?;
        let (soup, precision) = (task.control.soup(), task.precision.code());
        let inner = make(&soup, &tags.view(), &options, precision, isolation).map_err(message)?;
        Ok(Self { inner, samples: 0, records: 1 })
    }

    /// Says where to evaluate.
    ///
    /// # Errors
    /// For a place that is not there, or has no surface.
    pub fn place(&mut self, places: &[Place]) -> Result<()> {
        let list = |of: fn(&Place) -> u32| places.iter().map(of).collect::<Vec<_>>();
        let parameters: Vec<f64> = places.iter().flat_map(|place| place.uv).collect();
        let (faces, sectors) = (list(|place| place.face), list(|place| place.sector));
        self.inner.pin_mut().place(&faces, &sectors, &parameters).map_err(message)?;
        self.samples = places.len();
        Ok(())
    }

    /// Evaluates all places: positions alone, with first derivatives, or with second ones,
    /// for 1, 3 or 6 records. This is what is timed.
    ///
    /// # Errors
    /// For another number of records.
    pub fn evaluate(&mut self, records: u8) -> Result<()> {
        self.inner.pin_mut().evaluate(records).map_err(message)?;
        self.records = usize::from(records);
        Ok(())
    }

    /// What was evaluated, in the order of [`carvel::limit::Surface::evaluate`].
    ///
    /// # Errors
    /// None after [`Patches::evaluate`].
    pub fn values(&self) -> Result<Vec<f64>> {
        let mut out = vec![0.0; 3 * self.records * self.samples];
        self.inner.copy_samples(&mut out).map_err(message)?;
        Ok(out)
    }
}

type Make = fn(
    &ffi::Soup<'_>,
    &ffi::Tags<'_>,
    &ffi::OsdOptions,
    ffi::Precision,
    u32,
) -> std::result::Result<UniquePtr<ffi::Patches>, cxx::Exception>;
