//! Huge pages for large arrays, where the system offers them.
//!
//! A fresh array costs more in page faults than in arithmetic: 1.7 µs for each 4 KiB,
//! against one fault for 2 MiB. Linux gives huge pages to memory that asks for them.

#![allow(unsafe_code)]

/// The size of a huge page on most machines; where it is another one, nothing is lost but
/// the advice.
#[cfg(target_os = "linux")]
const HUGE: usize = 2 << 20;

/// Room for what an allocator writes in front of a large array.
#[cfg(target_os = "linux")]
const HEADER: usize = 64;

/// Arrays of fewer bytes stay as they are.
#[cfg(target_os = "linux")]
const LARGE: usize = 256 << 10;

/// The length for an array that is to hold `len` values.
///
/// Linux puts a mapping of whole huge pages where huge pages begin; others cost small
/// pages at both ends. So a large array gets whole ones if that adds no more than
/// half, 2 MiB at most.
#[cfg(target_os = "linux")]
pub(super) fn roomy<T>(len: usize) -> usize {
    let bytes = len.saturating_mul(size_of::<T>());
    if bytes < HUGE || bytes > isize::MAX as usize - 2 * HUGE {
        return len;
    }
    let whole = (bytes + HEADER).next_multiple_of(HUGE) - HEADER;
    if whole - bytes <= bytes / 2 { whole / size_of::<T>() } else { len }
}

/// As long as asked for.
#[cfg(not(target_os = "linux"))]
pub(super) fn roomy<T>(len: usize) -> usize {
    len
}

/// Asks for huge pages behind an array, best before it is touched. A system that refuses
/// says so to nobody: the array is as good as before.
///
/// Also for arrays that hold no whole huge page: large ones lie next to each other, and
/// together they do. So the pages at both ends are counted in, whoever else uses them.
#[cfg(target_os = "linux")]
pub(super) fn prefer_huge<T>(array: &mut Vec<T>) {
    const PAGE: usize = 4096;
    let bytes = array.capacity().saturating_mul(size_of::<T>());
    if bytes < LARGE {
        return;
    }
    let start = array.as_mut_ptr().cast::<u8>();
    let before = start.addr() % PAGE;
    let whole = (before + bytes).next_multiple_of(PAGE);
    // SAFETY: the system is told about pages that hold the array's own memory; the advice
    // changes neither their content nor their address, and a wrong range is refused.
    unsafe {
        libc::madvise(start.wrapping_sub(before).cast(), whole, libc::MADV_HUGEPAGE);
    }
    let before = start.addr() % HUGE;
    if before <= HEADER && before + bytes >= HUGE && huge_pages_are_on() {
        join_pages(start.wrapping_sub(before));
    }
}

/// False where the system's owner wants none: joining pages would not ask.
#[cfg(target_os = "linux")]
fn huge_pages_are_on() -> bool {
    let setting = std::fs::read_to_string("/sys/kernel/mm/transparent_hugepage/enabled");
    setting.is_ok_and(|setting| !setting.contains("[never]"))
}

/// Makes one page of small ones. The allocator has written in front of the array, so that
/// the system has begun its first huge page with a small one.
#[cfg(target_os = "linux")]
fn join_pages(start: *mut u8) {
    /// Since Linux 6.1; older ones refuse it.
    const MADV_COLLAPSE: libc::c_int = 25;
    // SAFETY: the pages are mapped and hold the array; what they hold is kept.
    unsafe {
        libc::madvise(start.cast(), HUGE, MADV_COLLAPSE);
    }
}

/// Nothing to ask for.
#[cfg(not(target_os = "linux"))]
pub(super) fn prefer_huge<T>(_: &mut Vec<T>) {}
