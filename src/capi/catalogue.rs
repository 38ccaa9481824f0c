//! The catalogue of schemes of polygons: names, authors, parameters, and for which values of a
//! parameter the schemes are smooth.

use super::buffer::{check_list, list};
use super::guard::call;
use super::mask::text_of;
use super::status::{CARVEL_STATUS_TOO_LARGE, Fault, Result, carvel_status};
use super::versioned::{check, init_function, initial, versioned, write};
use super::{carvel_context, carvel_error, carvel_fraction};
use crate::analysis::mask::{AffineFamily, ParameterRange};
use crate::base::{Error, ErrorKind};
use crate::curve::Rational;
use crate::curve::catalogue::{FAMILIES, Family, NON_STATIONARY, NonStationary, parse};
use crate::curve::rational::{from_fraction, to_fraction};
use std::ffi::{CStr, CString, c_char};
use std::sync::LazyLock;

versioned! {
    pub struct carvel_catalogue_entry {
        pub struct_size: u32,
        pub is_stationary: i32,
        pub name: *const c_char,
        pub summary: *const c_char,
        pub authors: *const c_char,
        pub year: *const c_char,
        pub formula: *const c_char,
        pub attribution: *const c_char,
        pub limit: *const c_char,
        pub parameter_count: u64,
    }
}

versioned! {
    pub struct carvel_catalogue_parameter {
        pub struct_size: u32,
        pub is_free: i32,
        pub name: *const c_char,
        pub range: *const c_char,
        pub default_value: *const c_char,
    }
}

#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct carvel_parameter_range {
    pub low_outside: carvel_fraction,
    pub low_inside: carvel_fraction,
    pub high_inside: carvel_fraction,
    pub high_outside: carvel_fraction,
}

/// A scheme's texts as C has them, from the first call to the end of the process.
struct Entry {
    is_stationary: bool,
    name: CString,
    summary: CString,
    authors: CString,
    year: CString,
    formula: CString,
    attribution: CString,
    limit: CString,
    parameters: Vec<Parameter>,
}

struct Parameter {
    is_free: bool,
    name: CString,
    range: CString,
    default: CString,
}

static ENTRIES: LazyLock<Vec<Entry>> = LazyLock::new(|| {
    let stationary = FAMILIES.iter().map(Entry::of_family);
    stationary.chain(NON_STATIONARY.iter().map(Entry::of_changing)).collect()
});

/// No text of the catalogue holds a zero byte.
fn c_text(text: &str) -> CString {
    CString::new(text).unwrap_or_default()
}

impl Entry {
    fn of_family(family: &Family) -> Self {
        let parameter = |p: &crate::curve::catalogue::Parameter| Parameter {
            is_free: p.is_free,
            name: c_text(p.name),
            range: c_text(p.range),
            default: c_text(p.default),
        };
        Self {
            is_stationary: true,
            name: c_text(family.name),
            summary: c_text(family.summary),
            authors: c_text(family.authors),
            year: c_text(family.year),
            formula: c_text(family.formula),
            attribution: c_text(family.attribution.name()),
            limit: CString::default(),
            parameters: family.parameters.iter().map(parameter).collect(),
        }
    }

    fn of_changing(family: &NonStationary) -> Self {
        Self {
            is_stationary: false,
            name: c_text(family.name),
            summary: c_text(family.summary),
            authors: c_text(family.authors),
            year: c_text(family.year),
            formula: c_text(family.formula),
            attribution: c_text(family.attribution.name()),
            limit: c_text(family.limit),
            parameters: Vec::new(),
        }
    }

    fn described(&'static self) -> carvel_catalogue_entry {
        carvel_catalogue_entry {
            is_stationary: i32::from(self.is_stationary),
            name: self.name.as_ptr(),
            summary: self.summary.as_ptr(),
            authors: self.authors.as_ptr(),
            year: self.year.as_ptr(),
            formula: self.formula.as_ptr(),
            attribution: self.attribution.as_ptr(),
            limit: self.limit.as_ptr(),
            parameter_count: self.parameters.len() as u64,
            ..initial()
        }
    }
}

/// The element of a list that a caller counts in.
fn at<T>(list: &'static [T], index: u64, what: &str) -> Result<&'static T> {
    let found = usize::try_from(index).ok().and_then(|i| list.get(i));
    found.ok_or_else(|| {
        let message = format!("{what} {index}: there are {}", list.len());
        Error::new(ErrorKind::IndexOutOfRange, message).into()
    })
}

init_function!(carvel_catalogue_entry_init, carvel_catalogue_entry);
init_function!(carvel_catalogue_parameter_init, carvel_catalogue_parameter);

#[unsafe(no_mangle)]
pub extern "C" fn carvel_catalogue_count() -> u64 {
    (FAMILIES.len() + NON_STATIONARY.len()) as u64
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_catalogue_entry_at(
    index: u64,
    entry: *mut carvel_catalogue_entry,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |_| {
            check(entry)?;
            write(entry, &at(&ENTRIES, index, "scheme")?.described())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_catalogue_parameter_at(
    index: u64,
    parameter_index: u64,
    parameter: *mut carvel_catalogue_parameter,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |_| {
            check(parameter)?;
            let scheme = at(&ENTRIES, index, "scheme")?;
            let found = at(&scheme.parameters, parameter_index, "parameter")?;
            let described = carvel_catalogue_parameter {
                is_free: i32::from(found.is_free),
                name: found.name.as_ptr(),
                range: found.range.as_ptr(),
                default_value: found.default.as_ptr(),
                ..initial()
            };
            write(parameter, &described)
        })
    }
}

/// The family of a text with the named parameter left open.
fn family(text: &str, parameter: &CStr) -> Result<AffineFamily> {
    let (family, parameters) = parse(text)?;
    let named = |p: &crate::curve::catalogue::Parameter| p.name.as_bytes() == parameter.to_bytes();
    let index = family.parameters.iter().position(named).ok_or_else(|| {
        let shown: String = parameter.to_string_lossy().chars().take(40).collect();
        Fault::out_of_range(format!("{} has no parameter '{shown}'", family.name))
    })?;
    Ok(AffineFamily::of(family, &parameters, index)?)
}

/// A number that the caller gave.
fn exact(value: carvel_fraction, name: &'static str) -> Result<Rational> {
    Ok(from_fraction(value.exact(name)?))
}

/// An end of a range; 0/0 for what is not known.
fn end(value: Option<&Rational>) -> Result<carvel_fraction> {
    let Some(value) = value else { return Ok(carvel_fraction::default()) };
    let long = || Fault::new(CARVEL_STATUS_TOO_LARGE, "an end of a range does not fit 64 bits");
    Ok(to_fraction(value).ok_or_else(long)?.into())
}

impl carvel_parameter_range {
    fn of(range: &ParameterRange) -> Result<Self> {
        match range {
            ParameterRange::Single(w) => {
                let (w, none) = (end(Some(w))?, end(None)?);
                Ok(Self { low_outside: none, low_inside: w, high_inside: w, high_outside: none })
            }
            ParameterRange::Interval { low, high } => Ok(Self {
                low_outside: end(low.outside.as_ref())?,
                low_inside: end(Some(&low.inside))?,
                high_inside: end(Some(&high.inside))?,
                high_outside: end(high.outside.as_ref())?,
            }),
        }
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_catalogue_ranges(
    name: *const c_char,
    parameter: *const c_char,
    context: *const carvel_context,
    continuity: u32,
    low: carvel_fraction,
    high: carvel_fraction,
    tolerance: carvel_fraction,
    out: *mut carvel_parameter_range,
    capacity: u64,
    count: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let context = call.context(context)?;
            let name = text_of(name, "name")?.to_str().map_err(|_| {
                Error::new(ErrorKind::InvalidText, "the name is no UTF-8".to_owned())
            })?;
            let family = family(name, text_of(parameter, "parameter")?)?;
            let (low, high) = (exact(low, "low")?, exact(high, "high")?);
            let tolerance = exact(tolerance, "tolerance")?;
            check_list(out, capacity, count)?;
            let k = continuity as usize;
            let found = family.continuity_range(&context, k, [&low, &high], &tolerance)?;
            let found = found.iter().map(carvel_parameter_range::of).collect::<Result<Vec<_>>>()?;
            list(&found, out, capacity, count)
        })
    }
}
