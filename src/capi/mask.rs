//! `carvel_mask`: a scheme of polygons, what it makes of them and of grids, and what is proved
//! of it.

use super::buffer::{Target, check_list, check_overlap, check_pointer, list, size};
use super::guard::call;
use super::object::{destroy_function, object};
use super::status::{CARVEL_STATUS_TOO_LARGE, Fault, Result, carvel_status};
use super::versioned::{check, init_function, initial, versioned, write};
use super::{carvel_context, carvel_error, carvel_fraction, carvel_scheme};
use crate::analysis::mask::{Analysis, Effort};
use crate::base::{Context, Error, ErrorKind};
use crate::curve::rational::{to_f64, to_fraction};
use crate::curve::{
    CurveScheme, CurveSplit, Ends, Factors, Mask, Parametrisation, Polygon, Rational,
    sample_derivative,
};
use crate::scheme::Scheme;
use std::ffi::{CStr, c_char};

object!(carvel_mask, CurveScheme);

pub const CARVEL_ENDS_CLOSED: i32 = 0;
pub const CARVEL_ENDS_DROPPED: i32 = 1;
pub const CARVEL_ENDS_KEPT: i32 = 2;
pub const CARVEL_ENDS_ANCHORED: i32 = 3;

pub const CARVEL_PARAMETRISATION_PRIMAL: i32 = 0;
pub const CARVEL_PARAMETRISATION_DUAL: i32 = 1;
pub const CARVEL_PARAMETRISATION_OTHER: i32 = 2;

versioned! {
    pub struct carvel_polygon_counts {
        pub struct_size: u32,
        pub ends: i32,
        pub points: u64,
    }
}

versioned! {
    pub struct carvel_mask_analysis {
        pub struct_size: u32,
        pub arity: u32,
        pub offset: i64,
        pub continuity: i32,
        pub parametrisation: i32,
        pub is_symmetric: i32,
        pub is_interpolating: i32,
        pub proof_continuity: i32,
        pub proof_power: u32,
        pub proof_norm: carvel_fraction,
        pub holder_low: f64,
        pub holder_high: f64,
        pub support: carvel_fraction,
        pub tau: carvel_fraction,
        pub smoothing_factors: u32,
        pub generation_degree: u32,
        pub reproduction_degree: u32,
        pub reserved: u32,
    }
}

pub(super) fn ends(ends: i32) -> Result<Ends> {
    match ends {
        CARVEL_ENDS_CLOSED => Ok(Ends::Closed),
        CARVEL_ENDS_DROPPED => Ok(Ends::Dropped),
        CARVEL_ENDS_KEPT => Ok(Ends::Kept),
        CARVEL_ENDS_ANCHORED => Ok(Ends::Anchored),
        other => Err(Fault::out_of_range(format!("there are no ends {other}"))),
    }
}

fn ends_number(ends: Ends) -> i32 {
    match ends {
        Ends::Closed => CARVEL_ENDS_CLOSED,
        Ends::Dropped => CARVEL_ENDS_DROPPED,
        Ends::Kept => CARVEL_ENDS_KEPT,
        Ends::Anchored => CARVEL_ENDS_ANCHORED,
    }
}

/// The nearest thing to a number that fits: none is 0/0.
fn fraction(value: Option<&Rational>) -> carvel_fraction {
    value.and_then(to_fraction).map(Into::into).unwrap_or_default()
}

/// A degree, an order or a count; of what is not there -1.
fn order(value: Option<usize>) -> i32 {
    value.and_then(|k| i32::try_from(k).ok()).unwrap_or(-1)
}

/// A text of the caller's.
///
/// # Safety
/// NULL, or a string that ends with a zero byte, and lives as long as it is used.
pub(super) unsafe fn text_of<'a>(text: *const c_char, name: &'static str) -> Result<&'a CStr> {
    check_pointer(text, name)?;
    // SAFETY: the caller's contract.
    Ok(unsafe { CStr::from_ptr(text) })
}

/// The scheme of a text: a name of the catalogue begins with a letter, coefficients do not.
///
/// # Safety
/// NULL, or a string that ends with a zero byte.
unsafe fn scheme(text: *const c_char, arity: u32, offset: Option<i64>) -> Result<CurveScheme> {
    // SAFETY: the caller's contract.
    let text = unsafe { text_of(text, "text")? }.to_str();
    let text =
        text.map_err(|_| Error::new(ErrorKind::InvalidText, "the text is no UTF-8".to_owned()))?;
    let named = text.trim_start().starts_with(|c: char| c.is_ascii_alphabetic());
    match (named, arity, offset) {
        (true, 0, None) => Ok(CurveScheme::named(text)?),
        (true, 0, Some(_)) => Err(Fault::out_of_range("a name has an offset of its own")),
        (true, ..) => Err(Fault::out_of_range("arity is set, but a name has its own")),
        (false, 0, _) => Ok(CurveScheme::Stationary(Mask::parse(text, 2, offset)?)),
        (false, arity, _) => {
            Ok(CurveScheme::Stationary(Mask::parse(text, arity as usize, offset)?))
        }
    }
}

/// Samples of the limit function as doubles.
fn doubles(samples: &[Rational]) -> Result<Vec<f64>> {
    let double = |(i, sample): (usize, &Rational)| match to_f64(sample) {
        value if value.is_finite() => Ok(value),
        _ => {
            let message = format!("sample {i} is beyond the range of doubles");
            Err(Error::new(ErrorKind::Overflow, message).into())
        }
    };
    samples.iter().enumerate().map(double).collect()
}

impl carvel_mask_analysis {
    fn of(mask: &Mask, found: &Analysis) -> Self {
        let proof = found.contractivity.as_ref();
        Self {
            arity: mask.arity() as u32,
            offset: mask.offset(),
            continuity: order(found.continuity),
            parametrisation: match found.parametrisation {
                Parametrisation::Primal => CARVEL_PARAMETRISATION_PRIMAL,
                Parametrisation::Dual => CARVEL_PARAMETRISATION_DUAL,
                Parametrisation::Other => CARVEL_PARAMETRISATION_OTHER,
            },
            is_symmetric: i32::from(found.is_symmetric),
            is_interpolating: i32::from(found.is_interpolating),
            proof_continuity: order(proof.map(|proof| proof.continuity)),
            proof_power: proof.map_or(0, |proof| proof.power),
            proof_norm: fraction(proof.map(|proof| &proof.norm)),
            holder_low: found.holder.low,
            holder_high: found.holder.high,
            support: fraction(Some(&found.support)),
            tau: fraction(Some(&found.tau)),
            smoothing_factors: found.smoothing.factors as u32,
            generation_degree: found.degrees.generation as u32,
            reproduction_degree: found.degrees.reproduction as u32,
            ..initial()
        }
    }
}

init_function!(carvel_polygon_counts_init, carvel_polygon_counts);
init_function!(carvel_mask_analysis_init, carvel_mask_analysis);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mask_create(
    text: *const c_char,
    arity: u32,
    out: *mut *mut carvel_mask,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { call(error, |call| call.create(out, |_| scheme(text, arity, None))) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mask_create_with_offset(
    text: *const c_char,
    arity: u32,
    offset: i64,
    out: *mut *mut carvel_mask,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { call(error, |call| call.create(out, |_| scheme(text, arity, Some(offset)))) }
}

destroy_function!(carvel_mask_destroy, carvel_mask);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mask_coefficients(
    mask: *const carvel_mask,
    out: *mut carvel_fraction,
    capacity: u64,
    count: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let exact = call.object(mask)?.stationary()?.coefficients().iter().map(to_fraction);
            let exact: Option<Vec<carvel_fraction>> = exact.map(|c| c.map(Into::into)).collect();
            let too_long =
                || Fault::new(CARVEL_STATUS_TOO_LARGE, "a coefficient does not fit 64 bits");
            list(&exact.ok_or_else(too_long)?, out, capacity, count)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mask_scheme(
    mask: *const carvel_mask,
    out: *mut *mut carvel_scheme,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let Factors { split, passes } = Factors::of(call.object(mask)?.stationary()?)?;
                Ok(match split {
                    CurveSplit::Dual => Scheme::dual(&passes)?,
                    CurveSplit::Primal => Scheme::primal(&passes)?,
                })
            })
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mask_analyse(
    mask: *const carvel_mask,
    context: *const carvel_context,
    analysis: *mut carvel_mask_analysis,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let (mask, context) = (call.object(mask)?, call.context(context)?);
            check(analysis)?;
            let mask = mask.stationary()?;
            let found = Analysis::of(&context, mask, Effort::default())?;
            write(analysis, &carvel_mask_analysis::of(mask, &found))
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mask_sample_limit(
    mask: *const carvel_mask,
    context: *const carvel_context,
    derivative: u32,
    levels: u32,
    first: *mut i64,
    out: *mut f64,
    capacity: u64,
    count: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let (mask, context) = (call.object(mask)?.stationary()?, call.context(context)?);
            check_list(out, capacity, count)?;
            let place = Target::new((first, u64::from(!first.is_null())), 1, "first");
            let given = place.is_given().then(|| place.span()).transpose()?;
            let (lowest, samples) = sample_derivative(&context, mask, derivative as usize, levels)?;
            let samples = doubles(&samples)?;
            let written = (samples.len() as u64).min(capacity);
            let mut spans = vec![Target::new((out, capacity), written, "out").span()?];
            spans.extend(given);
            if !count.is_null() {
                spans.push(Target::new((count, 1), 1, "count").span()?);
            }
            check_overlap(&spans)?;
            list(&samples, out, capacity, count)?;
            if given.is_some() {
                place.slice()[0] = lowest;
            }
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mask_counts(
    mask: *const carvel_mask,
    ends_before: i32,
    points: u64,
    steps: u32,
    counts: *mut carvel_polygon_counts,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let mask = call.object(mask)?;
            check(counts)?;
            let (points, after) = mask.predict(size(points), ends(ends_before)?, steps)?;
            let (ends, points) = (ends_number(after), points as u64);
            write(counts, &carvel_polygon_counts { ends, points, ..initial() })
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_mask_limit_counts(
    mask: *const carvel_mask,
    ends_before: i32,
    points: u64,
    derivative: u32,
    counts: *mut carvel_polygon_counts,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let mask = call.object(mask)?.stationary()?;
            check(counts)?;
            let ends = ends(ends_before)?;
            let (points, after) = Polygon::<f64>::predict_limit(
                &Context::serial(),
                mask,
                size(points),
                ends,
                derivative as usize,
            )?;
            let (ends, points) = (ends_number(after), points as u64);
            write(counts, &carvel_polygon_counts { ends, points, ..initial() })
        })
    }
}
