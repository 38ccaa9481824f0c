//! `carvel_grid_mask`: a scheme of grids by any bivariate mask.

use super::buffer::{Name, Target, check_overlap, input, size};
use super::guard::call;
use super::mask::ends;
use super::object::{destroy_function, object};
use super::status::{Result, carvel_status};
use super::{carvel_error, carvel_fraction};
use crate::base::memory;
use crate::curve::rational::from_fraction;
use crate::curve::{GridMask, Rational};

object!(carvel_grid_mask, GridMask);

fn exact(coefficients: &[carvel_fraction]) -> Result<Vec<Rational>> {
    let mut all = memory::reserved(coefficients.len())?;
    for (i, coefficient) in coefficients.iter().enumerate() {
        let name = Name { text: "coefficients", index: Some(i) };
        all.push(from_fraction(coefficient.exact(name)?));
    }
    Ok(all)
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_grid_mask_create(
    coefficients: *const carvel_fraction,
    count: u64,
    columns: u64,
    arity_down: u32,
    arity_along: u32,
    offset_down: i64,
    offset_along: i64,
    out: *mut *mut carvel_grid_mask,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |_| {
                GridMask::check_count(size(count))?;
                let coefficients = exact(input(coefficients, count, "coefficients")?)?;
                let arity = [arity_down, arity_along].map(|m| m as usize);
                let offset = [offset_down, offset_along];
                Ok(GridMask::new(arity, offset, size(columns), coefficients)?)
            })
        })
    }
}

destroy_function!(carvel_grid_mask_destroy, carvel_grid_mask);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_grid_mask_counts(
    mask: *const carvel_grid_mask,
    ends_down: i32,
    ends_along: i32,
    rows: u64,
    columns: u64,
    steps: u32,
    refined_rows: *mut u64,
    refined_columns: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let mask = call.object(mask)?;
            let down = Target::new((refined_rows, 1), 1, "refined_rows");
            let along = Target::new((refined_columns, 1), 1, "refined_columns");
            check_overlap(&[down.span()?, along.span()?])?;
            let both = [ends(ends_down)?, ends(ends_along)?];
            let [rows, columns] = mask.predict(both, [size(rows), size(columns)], steps)?;
            down.slice()[0] = rows as u64;
            along.slice()[0] = columns as u64;
            Ok(())
        })
    }
}
