//! Version, status codes, and the failures that turn into them.

use crate::base::{Element, Error, ErrorKind};
use crate::mesh::{Defect, Defects, summary};
use std::ffi::{CStr, c_char};

#[unsafe(no_mangle)]
pub extern "C" fn carvel_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => panic!("a version has no NUL"),
        };
    VERSION.as_ptr()
}

#[unsafe(no_mangle)]
pub extern "C" fn carvel_version_number() -> u32 {
    const PARTS: [&str; 3] = [
        env!("CARGO_PKG_VERSION_MAJOR"),
        env!("CARGO_PKG_VERSION_MINOR"),
        env!("CARGO_PKG_VERSION_PATCH"),
    ];
    PARTS.iter().fold(0, |number, part| 100 * number + part.parse::<u32>().unwrap_or(99))
}

pub type carvel_status = i32;

/// The codes, their names in C and their texts, written once.
macro_rules! statuses {
    ($($name:ident = $number:expr, $text:literal;)*) => {
        $(pub const $name: carvel_status = $number;)*

        fn text(status: carvel_status) -> &'static CStr {
            match status {
                $($name => $text,)*
                _ => c"unknown status",
            }
        }
    };
}

statuses! {
    CARVEL_STATUS_OK = 0, c"success";
    CARVEL_STATUS_INDEX_OUT_OF_RANGE = ErrorKind::IndexOutOfRange as i32, c"vertex index out of range";
    CARVEL_STATUS_FACE_TOO_SMALL = ErrorKind::FaceTooSmall as i32, c"face with fewer than three vertices";
    CARVEL_STATUS_REPEATED_VERTEX = ErrorKind::RepeatedVertex as i32, c"vertex repeated in a face";
    CARVEL_STATUS_INCONSISTENT_ORIENTATION = ErrorKind::InconsistentOrientation as i32, c"inconsistent orientation";
    CARVEL_STATUS_NON_MANIFOLD_EDGE = ErrorKind::NonManifoldEdge as i32, c"non-manifold edge";
    CARVEL_STATUS_NON_MANIFOLD_VERTEX = ErrorKind::NonManifoldVertex as i32, c"non-manifold vertex";
    CARVEL_STATUS_TOO_LARGE = ErrorKind::TooLarge as i32, c"size too large";
    CARVEL_STATUS_NOT_ANCHORED = ErrorKind::NotAnchored as i32, c"mesh is not anchored";
    CARVEL_STATUS_INVALID_TAG = ErrorKind::InvalidTag as i32, c"invalid tag";
    CARVEL_STATUS_LENGTH_MISMATCH = ErrorKind::LengthMismatch as i32, c"array length does not match";
    CARVEL_STATUS_NOT_FINITE = ErrorKind::NotFinite as i32, c"value is not finite";
    CARVEL_STATUS_OVERFLOW = ErrorKind::Overflow as i32, c"value overflows";
    CARVEL_STATUS_PARAMETER_OUT_OF_RANGE = ErrorKind::ParameterOutOfRange as i32, c"parameter out of range";
    CARVEL_STATUS_INVALID_NUMBER = ErrorKind::InvalidText as i32, c"not a number";
    CARVEL_STATUS_MEMORY_CEILING = ErrorKind::MemoryCeiling as i32, c"memory ceiling exceeded";
    CARVEL_STATUS_OUT_OF_RESOURCES = ErrorKind::OutOfResources as i32, c"out of memory or threads";
    CARVEL_STATUS_CANCELLED = ErrorKind::Cancelled as i32, c"cancelled";
    CARVEL_STATUS_IO = ErrorKind::Io as i32, c"input or output failed";
    CARVEL_STATUS_SYNTAX = ErrorKind::Syntax as i32, c"syntax error";
    CARVEL_STATUS_UNSUPPORTED = ErrorKind::Unsupported as i32, c"not supported";
    CARVEL_STATUS_BROKEN_INVARIANT = ErrorKind::BrokenInvariant as i32, c"broken invariant in the library";
    CARVEL_STATUS_NULL_POINTER = 101, c"pointer is NULL";
    CARVEL_STATUS_MISALIGNED = 102, c"pointer or stride is misaligned";
    CARVEL_STATUS_OVERLAP = 103, c"buffers overlap";
    CARVEL_STATUS_STRUCT_SIZE = 104, c"unknown struct_size";
    CARVEL_STATUS_BUFFER_TOO_SMALL = 105, c"output buffer too small";
    CARVEL_STATUS_INVALID_STRIDE = 106, c"stride smaller than the record";
    CARVEL_STATUS_BUSY = 107, c"object is in use by another thread";
    CARVEL_STATUS_PANIC = 108, c"defect in the library";
    CARVEL_STATUS_POISONED = 109, c"object was left unusable by a defect in the library";
}

#[unsafe(no_mangle)]
pub extern "C" fn carvel_status_string(status: carvel_status) -> *const c_char {
    text(status).as_ptr()
}

/// Why a call failed.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) status: carvel_status,
    pub(super) message: String,
    pub(super) entries: Entries,
}

/// What a failure is about.
#[derive(Debug)]
pub(super) enum Entries {
    /// The elements of a single failure.
    One(Vec<Element>),
    /// Every defect of a mesh.
    Defects(Vec<Defect>),
}

pub(super) type Result<T, E = Fault> = std::result::Result<T, E>;

impl Fault {
    pub(super) fn new(status: carvel_status, message: impl Into<String>) -> Self {
        Self { status, message: message.into(), entries: Entries::One(Vec::new()) }
    }

    pub(super) fn null(what: impl std::fmt::Display) -> Self {
        Self::new(CARVEL_STATUS_NULL_POINTER, format!("{what} is NULL"))
    }

    pub(super) fn out_of_range(message: impl Into<String>) -> Self {
        Self::new(CARVEL_STATUS_PARAMETER_OUT_OF_RANGE, message)
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        let entries = Entries::One(error.elements().to_vec());
        Self { status: error.kind() as carvel_status, message: error.to_string(), entries }
    }
}

impl From<Defects> for Fault {
    fn from(defects: Defects) -> Self {
        match defects {
            Defects::Call(error) => error.into(),
            Defects::Soup(list) => Self {
                status: list[0].kind() as carvel_status,
                message: summary(&list),
                entries: Entries::Defects(list),
            },
        }
    }
}
