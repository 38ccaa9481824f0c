//! What schemes of polygons make of points in the caller's memory: steps of polygons and grids,
//! limits.

use super::buffer::{check_overlap, check_pointer, size};
use super::grid_mask::carvel_grid_mask;
use super::guard::call;
use super::mask::{carvel_mask, ends};
use super::status::{
    CARVEL_STATUS_LENGTH_MISMATCH, CARVEL_STATUS_TOO_LARGE, Fault, Result, carvel_status,
};
use super::values::{ConstValues, Values};
use super::{carvel_context, carvel_error};
use crate::base::{Context, Scalar, memory};
use crate::curve::{Coordinate, CurveScheme, Ends, Grid, GridMask, Mask, Polygon};

/// What is made of points in the caller's memory.
trait Work<T> {
    /// The number of points that `count` become.
    fn count(&self, count: usize) -> Result<usize>;
    /// The values of those.
    fn run(&self, context: &Context, points: Vec<T>, width: usize) -> Result<Vec<T>>;
}

/// Steps of a polygon.
struct Steps<'a>(&'a CurveScheme, Ends, u32);

impl<T: Coordinate> Work<T> for Steps<'_> {
    fn count(&self, count: usize) -> Result<usize> {
        Ok(self.0.predict(count, self.1, self.2)?.0)
    }

    fn run(&self, context: &Context, points: Vec<T>, width: usize) -> Result<Vec<T>> {
        Ok(self.0.refine(context, &Polygon::new(points, width, self.1), self.2)?.points)
    }
}

/// The limit of a polygon, or a derivative.
struct Limit<'a>(&'a Mask, Ends, usize);

impl<T: Coordinate> Work<T> for Limit<'_> {
    fn count(&self, count: usize) -> Result<usize> {
        let Self(mask, ends, derivative) = *self;
        Ok(Polygon::<T>::predict_limit(&Context::serial(), mask, count, ends, derivative)?.0)
    }

    fn run(&self, context: &Context, points: Vec<T>, width: usize) -> Result<Vec<T>> {
        Ok(Polygon::new(points, width, self.1).limit(context, self.0, self.2)?.points)
    }
}

/// Steps of a grid: masks, ends, the number of columns, steps.
struct GridSteps<'a>([&'a Mask; 2], [Ends; 2], usize, u32);

impl<T: Coordinate> Work<T> for GridSteps<'_> {
    fn count(&self, count: usize) -> Result<usize> {
        let Self([down, along], ends, columns, steps) = *self;
        let rows = full_rows(count, columns)?;
        let (rows, _) = Polygon::<T>::predict(down, rows, ends[0], steps)?;
        let (columns, _) = Polygon::<T>::predict(along, columns, ends[1], steps)?;
        grid_total(rows, columns)
    }

    fn run(&self, context: &Context, points: Vec<T>, width: usize) -> Result<Vec<T>> {
        let Self(masks, ends, columns, steps) = *self;
        Ok(Grid { points, columns, width, ends }.refine(context, masks, steps)?.points)
    }
}

/// Steps of a grid by a bivariate mask: ends, the number of columns, steps.
struct BivariateSteps<'a>(&'a GridMask, [Ends; 2], usize, u32);

impl<T: Coordinate> Work<T> for BivariateSteps<'_> {
    fn count(&self, count: usize) -> Result<usize> {
        let Self(mask, ends, columns, steps) = *self;
        let [rows, columns] = mask.predict(ends, [full_rows(count, columns)?, columns], steps)?;
        grid_total(rows, columns)
    }

    fn run(&self, context: &Context, points: Vec<T>, width: usize) -> Result<Vec<T>> {
        let Self(mask, ends, columns, steps) = *self;
        Ok(Grid { points, columns, width, ends }.refine_by(context, mask, steps)?.points)
    }
}

/// The rows that points are.
fn full_rows(count: usize, columns: usize) -> Result<usize> {
    if columns == 0 || !count.is_multiple_of(columns) {
        let message = format!("points: {count} are no rows of {columns}");
        return Err(Fault::new(CARVEL_STATUS_LENGTH_MISMATCH, message));
    }
    Ok(count / columns)
}

fn grid_total(rows: usize, columns: usize) -> Result<usize> {
    let too_many = || Fault::new(CARVEL_STATUS_TOO_LARGE, "the grid has too many points");
    rows.checked_mul(columns).ok_or_else(too_many)
}

/// Reads points, works and writes what comes of it.
///
/// # Safety
/// The header's contract.
unsafe fn work<T: Scalar + Coordinate>(
    context: &Context,
    work: &impl Work<T>,
    (points, out): (*const ConstValues<T>, *const Values<T>),
) -> Result<()> {
    check_pointer(points, "points")?;
    check_pointer(out, "out")?;
    // SAFETY: the caller's contract.
    unsafe {
        let points = points.read();
        let needed = work.count(usize::try_from(points.count).unwrap_or(usize::MAX))?;
        let from = points.check(points.count, "points".into())?;
        let to = out.read().check(needed as u64, from.width, "out".into())?;
        check_overlap(&[from.read_span().hull(), to.write_span().hull()])?;
        let made = work.run(context, memory::copied(from.read()?.values())?, from.width)?;
        let mut sink = to.sink()?;
        sink.values().copy_from_slice(&made);
        sink.finish();
    }
    Ok(())
}

/// The functions of a kind of points.
macro_rules! functions {
    ($number:ty, $refine:ident, $limit:ident, $refine_grid:ident, $bivariate:ident) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $refine(
            mask: *const carvel_mask,
            context: *const carvel_context,
            ends_before: i32,
            steps: u32,
            points: *const ConstValues<$number>,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe {
                call(error, |call| {
                    let (mask, context) = (call.object(mask)?, call.context(context)?);
                    work(&context, &Steps(mask, ends(ends_before)?, steps), (points, out))
                })
            }
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $limit(
            mask: *const carvel_mask,
            context: *const carvel_context,
            ends_before: i32,
            derivative: u32,
            points: *const ConstValues<$number>,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe {
                call(error, |call| {
                    let (mask, context) = (call.object(mask)?, call.context(context)?);
                    let limit = Limit(mask.stationary()?, ends(ends_before)?, derivative as usize);
                    work(&context, &limit, (points, out))
                })
            }
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $refine_grid(
            down: *const carvel_mask,
            along: *const carvel_mask,
            context: *const carvel_context,
            ends_down: i32,
            ends_along: i32,
            columns: u64,
            steps: u32,
            points: *const ConstValues<$number>,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe {
                call(error, |call| {
                    let masks =
                        [call.object(down)?.stationary()?, call.object(along)?.stationary()?];
                    let context = call.context(context)?;
                    let both = [ends(ends_down)?, ends(ends_along)?];
                    let steps = GridSteps(masks, both, size(columns), steps);
                    work(&context, &steps, (points, out))
                })
            }
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $bivariate(
            mask: *const carvel_grid_mask,
            context: *const carvel_context,
            ends_down: i32,
            ends_along: i32,
            columns: u64,
            steps: u32,
            points: *const ConstValues<$number>,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe {
                call(error, |call| {
                    let (mask, context) = (call.object(mask)?, call.context(context)?);
                    let both = [ends(ends_down)?, ends(ends_along)?];
                    let steps = BivariateSteps(mask, both, size(columns), steps);
                    work(&context, &steps, (points, out))
                })
            }
        }
    };
}

functions!(
    f32,
    carvel_mask_refine_f32,
    carvel_mask_limit_f32,
    carvel_mask_refine_grid_f32,
    carvel_grid_mask_refine_f32
);
functions!(
    f64,
    carvel_mask_refine_f64,
    carvel_mask_limit_f64,
    carvel_mask_refine_grid_f64,
    carvel_grid_mask_refine_f64
);
