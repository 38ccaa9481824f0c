//! Tables seen from their columns.

use super::StencilTable;
use super::table::check_size;
use crate::base::{Context, Error, ErrorKind, Result, Scalar, memory};

/// The rows that depend on each column, for [`StencilTable::update`].
///
/// 4 bytes per entry of the table and per column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dependents {
    rows: u32,
    offsets: Vec<u32>,
    of_column: Vec<u32>,
}

impl Dependents {
    /// Refuses a table of another shape.
    pub(super) fn check<T: Scalar>(&self, table: &StencilTable<T>) -> Result<()> {
        let own = [self.rows as usize, self.columns(), self.of_column.len()];
        let given = [table.rows(), table.columns(), table.entries()];
        if own == given {
            return Ok(());
        }
        let message = format!("dependents of a table of another shape: {own:?}, not {given:?}");
        Err(Error::new(ErrorKind::LengthMismatch, message))
    }

    /// Bytes held.
    pub fn bytes(&self) -> u64 {
        4 * (self.offsets.capacity() + self.of_column.capacity()) as u64
    }

    fn columns(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The rows that depend on some columns: ascending, each once.
    ///
    /// # Errors
    /// [`ErrorKind::IndexOutOfRange`] for a column that does not exist,
    /// [`ErrorKind::OutOfResources`].
    pub fn of(&self, changed: &[u32]) -> Result<Vec<u32>> {
        let columns = self.columns();
        if let Some(column) = changed.iter().find(|&&column| column as usize >= columns) {
            let message = format!("column {column} of {columns}");
            return Err(Error::new(ErrorKind::IndexOutOfRange, message));
        }
        let mut seen = memory::filled(false, self.rows as usize)?;
        let mut rows = Vec::new();
        for &column in changed {
            let [start, end] = [column, column + 1].map(|at| self.offsets[at as usize] as usize);
            for &row in &self.of_column[start..end] {
                if !std::mem::replace(&mut seen[row as usize], true) {
                    memory::extend(&mut rows, [row])?;
                }
            }
        }
        rows.sort_unstable();
        Ok(rows)
    }
}

impl<T: Scalar> StencilTable<T> {
    /// The table with rows and columns exchanged; entries of a row come in the order of the
    /// rows that they stood in. Two looks at every entry, on one thread.
    ///
    /// # Errors
    /// [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`],
    /// [`ErrorKind::Cancelled`].
    pub fn transpose(&self, context: &Context) -> Result<Self> {
        let places = self.places(context, 8 + T::BYTES)?;
        let mut indices = memory::zeroed(self.entries())?;
        let mut weights = memory::zeroed(self.entries())?;
        let offsets = self.scatter(context, places, |at, row, entry| {
            indices[at] = row;
            weights[at] = self.weights()[entry];
        })?;
        Ok(Self::from_parts(self.rows() as u32, offsets, indices, weights))
    }

    /// The rows that depend on each column; costs and fails as
    /// [`StencilTable::transpose`].
    ///
    /// # Errors
    /// As [`StencilTable::transpose`].
    pub fn dependents(&self, context: &Context) -> Result<Dependents> {
        let places = self.places(context, 4)?;
        let mut of_column = memory::zeroed(self.entries())?;
        let offsets = self.scatter(context, places, |at, row, _| of_column[at] = row)?;
        Ok(Dependents { rows: self.rows() as u32, offsets, of_column })
    }

    /// Where the entries of each column go: the first place is that of column 0.
    fn places(&self, context: &Context, each: u64) -> Result<Vec<u32>> {
        check_size("columns", self.columns() + 1)?;
        context.check_memory(each * self.entries() as u64 + 8 * self.columns() as u64)?;
        context.check_cancelled()?;
        let mut places = memory::zeroed(self.columns() + 2)?;
        for &i in self.indices() {
            places[i as usize + 2] += 1_u32;
        }
        for i in 2..places.len() {
            places[i] += places[i - 1];
        }
        Ok(places)
    }

    /// Sends every entry to its place; returns where columns begin.
    fn scatter(
        &self,
        context: &Context,
        mut places: Vec<u32>,
        mut put: impl FnMut(usize, u32, usize),
    ) -> Result<Vec<u32>> {
        for rows in context.chunks(self.rows()) {
            context.check_cancelled()?;
            for row in rows {
                for entry in self.entries_of(row..row + 1) {
                    // One place further on, so that in the end all are beginnings.
                    let place = &mut places[self.indices()[entry] as usize + 1];
                    put(*place as usize, row as u32, entry);
                    *place += 1;
                }
            }
        }
        places.pop();
        Ok(places)
    }
}
