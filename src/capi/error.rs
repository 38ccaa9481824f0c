//! `carvel_error`: why a call failed.

use super::guard::quietly;
use super::object::{Handle, Object, destroy_function, hand_over, look, object};
use super::status::{CARVEL_STATUS_OK, Entries, Fault, carvel_status};
use crate::base::Element;
use std::ffi::{CString, c_char};

object!(carvel_error, Report);

/// The last failure, if the last call failed.
#[derive(Default)]
pub(super) struct Report {
    fault: Option<Fault>,
    message: CString,
    /// The text of the entry that was asked for last.
    entry: CString,
}

pub const CARVEL_ELEMENT_VERTEX: u64 = 1;
pub const CARVEL_ELEMENT_FACE: u64 = 2;
pub const CARVEL_ELEMENT_EDGE: u64 = 3;
pub const CARVEL_ELEMENT_LINE: u64 = 4;
pub const CARVEL_ELEMENT_BYTE: u64 = 5;

#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct carvel_element {
    pub kind: u64,
    pub index: u64,
    pub second: u64,
}

impl From<Element> for carvel_element {
    fn from(element: Element) -> Self {
        let (kind, index, second) = match element {
            Element::Vertex(v) => (CARVEL_ELEMENT_VERTEX, v, 0),
            Element::Face(f) => (CARVEL_ELEMENT_FACE, f, 0),
            Element::Edge(a, b) => (CARVEL_ELEMENT_EDGE, a, b),
            Element::Line(n) => (CARVEL_ELEMENT_LINE, n, 0),
            Element::Byte(n) => (CARVEL_ELEMENT_BYTE, n, 0),
        };
        Self { kind, index, second }
    }
}

impl Report {
    fn entries(&self) -> usize {
        match self.fault.as_ref().map(|fault| &fault.entries) {
            None => 0,
            Some(Entries::One(_)) => 1,
            Some(Entries::Defects(list)) => list.len(),
        }
    }

    /// The failure that an entry belongs to, if there is such an entry.
    fn fault(&self, entry: u64) -> Option<&Fault> {
        self.fault.as_ref().filter(|_| entry < self.entries() as u64)
    }

    fn status(&self, entry: u64) -> Option<carvel_status> {
        self.fault(entry).map(|fault| match &fault.entries {
            Entries::One(_) => fault.status,
            Entries::Defects(list) => list[entry as usize].kind() as carvel_status,
        })
    }

    fn text(&self, entry: u64) -> Option<String> {
        self.fault(entry).map(|fault| match &fault.entries {
            Entries::One(_) => fault.message.clone(),
            Entries::Defects(list) => list[entry as usize].to_string(),
        })
    }

    fn element_count(&self, entry: u64) -> usize {
        self.fault(entry).map_or(0, |fault| match &fault.entries {
            Entries::One(elements) => elements.len(),
            Entries::Defects(list) => list[entry as usize].element_count(),
        })
    }

    fn element(&self, entry: u64, element: u64) -> Option<Element> {
        let element = usize::try_from(element).ok()?;
        match &self.fault(entry)?.entries {
            Entries::One(elements) => elements.get(element).copied(),
            Entries::Defects(list) => list[entry as usize].element(element),
        }
    }
}

/// Text for C. Messages have no NUL; were there one, the text would end there.
fn c_text(text: impl Into<Vec<u8>>) -> CString {
    let mut bytes = text.into();
    bytes.retain(|&byte| byte != 0);
    CString::new(bytes).unwrap_or_default()
}

/// Puts the outcome of a call into the caller's error.
///
/// # Safety
/// `error` is NULL or an error that no other thread uses now.
pub(super) unsafe fn fill(error: *mut carvel_error, fault: Option<Fault>) {
    // SAFETY: the caller's contract: nobody else looks at it now.
    let Some(handle) = (unsafe { error.cast::<Handle<Report>>().as_mut() }) else { return };
    let message = fault.as_ref().map(|fault| c_text(fault.message.as_str())).unwrap_or_default();
    handle.value = Report { fault, message, entry: CString::default() };
}

/// Reads from the caller's error; empty for NULL.
///
/// # Safety
/// As [`fill`].
unsafe fn read<R>(error: *const carvel_error, empty: R, get: impl FnOnce(&Report) -> R) -> R {
    // SAFETY: the caller's contract.
    match unsafe { look(error) } {
        Some(handle) => quietly(|| get(&handle.value)).unwrap_or(empty),
        None => empty,
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_error_create(out: *mut *mut carvel_error) -> carvel_status {
    if let Err(fault) = super::buffer::check_pointer(out, carvel_error::NAME) {
        return fault.status;
    }
    // SAFETY: not NULL and aligned; the header asks for a pointer to write to.
    unsafe { out.write(hand_over(Report::default())) };
    CARVEL_STATUS_OK
}

destroy_function!(carvel_error_destroy, carvel_error);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_error_status(error: *const carvel_error) -> carvel_status {
    let get = |report: &Report| report.fault.as_ref().map_or(CARVEL_STATUS_OK, |f| f.status);
    // SAFETY: the header's contract.
    unsafe { read(error, CARVEL_STATUS_OK, get) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_error_message(error: *const carvel_error) -> *const c_char {
    // SAFETY: the header's contract; the text lives in the error.
    unsafe { read(error, c"".as_ptr(), |report| report.message.as_ptr()) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_error_entry_count(error: *const carvel_error) -> u64 {
    // SAFETY: the header's contract.
    unsafe { read(error, 0, |report| report.entries() as u64) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_error_entry_status(
    error: *const carvel_error,
    entry: u64,
) -> carvel_status {
    let get = |report: &Report| report.status(entry).unwrap_or(CARVEL_STATUS_OK);
    // SAFETY: the header's contract.
    unsafe { read(error, CARVEL_STATUS_OK, get) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_error_entry_message(
    error: *mut carvel_error,
    entry: u64,
) -> *const c_char {
    // SAFETY: the header's contract.
    let text = unsafe { read(error, None, |report| report.text(entry)) };
    let handle = error.cast::<Handle<Report>>();
    if text.is_none() || !handle.is_aligned() {
        return c"".as_ptr();
    }
    // SAFETY: the header's contract: one thread at a time, so nobody else looks.
    match (text, unsafe { handle.as_mut() }) {
        (Some(text), Some(handle)) => {
            handle.value.entry = c_text(text);
            handle.value.entry.as_ptr()
        }
        _ => c"".as_ptr(),
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_error_element_count(error: *const carvel_error, entry: u64) -> u64 {
    let get = |report: &Report| report.element_count(entry) as u64;
    // SAFETY: the header's contract.
    unsafe { read(error, 0, get) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_error_element(
    error: *const carvel_error,
    entry: u64,
    element: u64,
) -> carvel_element {
    let get = |report: &Report| report.element(entry, element);
    // SAFETY: the header's contract.
    unsafe { read(error, None, get) }.map(carvel_element::from).unwrap_or_default()
}
