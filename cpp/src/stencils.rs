//! OpenSubdiv's composed stencil tables, for comparisons of data on fixed topology, and its
//! way without one.

use crate::bridge::ffi;
use crate::opensubdiv::{Tags, options};
use crate::run::message;
use crate::{OpenSubdiv, Result, Task};
use cxx::UniquePtr;

/// A table and the values that it was last applied to.
pub struct Stencils {
    inner: UniquePtr<ffi::Stencils>,
}

impl Stencils {
    /// The table of a uniform level: one row for each of its vertices, in
    /// OpenSubdiv's numbering.
    ///
    /// # Errors
    /// What OpenSubdiv does not take.
    pub fn of_level(task: &Task, level: u32) -> Result<Self> {
        let (tags, options) = Self::input(task)?;
        let (soup, precision) = (task.control.soup(), task.precision.code());
        ffi::stencils_new(&soup, &tags.view(), &options, precision, level)
            .map(|inner| Self { inner })
            .map_err(message)
    }

    /// No table but the refined topology: `PrimvarRefiner` through every level, into the
    /// same rows as [`Stencils::of_level`].
    ///
    /// # Errors
    /// What OpenSubdiv does not take.
    pub fn by_levels(task: &Task, level: u32) -> Result<Self> {
        let (tags, options) = Self::input(task)?;
        let (soup, precision) = (task.control.soup(), task.precision.code());
        ffi::levels_new(&soup, &tags.view(), &options, precision, level)
            .map(|inner| Self { inner })
            .map_err(message)
    }

    /// The table of places on the limit surface: a ptex face and (s, t) for each.
    /// `isolation` is how deep features are isolated.
    ///
    /// # Errors
    /// What OpenSubdiv does not take.
    pub fn of_limit(
        task: &Task,
        isolation: u32,
        faces: &[u32],
        parameters: &[[f64; 2]],
    ) -> Result<Self> {
        let (tags, options) = Self::input(task)?;
        let (soup, precision) = (task.control.soup(), task.precision.code());
        let places = parameters.as_flattened();
        let table = ffi::limit_stencils_new(
            &soup,
            &tags.view(),
            &options,
            precision,
            isolation,
            faces,
            places,
        );
        table.map(|inner| Self { inner }).map_err(message)
    }

    fn input<'a>(task: &Task<'a>) -> Result<(Tags<'a>, ffi::OsdOptions)> {
        Ok((Tags::of(task.control), options(&OpenSubdiv, task.scheme, task.options)?))
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.inner.rows()
    }

    /// Bytes of the table; 0 without one.
    pub fn bytes(&self) -> usize {
        self.inner.bytes()
    }

    /// Makes the table of a level anew from its refined topology: this is what is timed.
    ///
    /// # Errors
    /// Without a table of a level.
    pub fn create(&mut self) -> Result<()> {
        self.inner.pin_mut().create().map_err(message)
    }

    /// Frees the table of a level.
    pub fn clear(&mut self) {
        self.inner.pin_mut().clear();
    }

    /// Computes the rows from the control positions: this is what is timed.
    ///
    /// # Errors
    /// Without the table, or what OpenSubdiv calls an error.
    pub fn update(&mut self) -> Result<()> {
        self.inner.pin_mut().update().map_err(message)
    }

    /// Positions, xyz per row.
    ///
    /// # Errors
    /// None that a table can give.
    pub fn positions(&self) -> Result<Vec<f64>> {
        self.copy(0)
    }

    /// The derivatives along s and t of a limit table, xyz per row.
    ///
    /// # Errors
    /// For the table of a level, which has none.
    pub fn derivatives(&self) -> Result<[Vec<f64>; 2]> {
        Ok([self.copy(1)?, self.copy(2)?])
    }

    fn copy(&self, which: u8) -> Result<Vec<f64>> {
        let mut out = vec![0.0; 3 * self.rows()];
        self.inner.copy_values(which, &mut out).map_err(message)?;
        Ok(out)
    }
}
