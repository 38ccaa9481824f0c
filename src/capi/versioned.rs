//! Structs that may grow: the caller says by `struct_size` which version it was
//! compiled with (docs/abi.md, "How to add a field").

use super::buffer::check_pointer;
use super::status::{CARVEL_STATUS_STRUCT_SIZE, Fault, Result};

/// A struct whose first field is `struct_size: u32`.
///
/// # Safety
/// `#[repr(C)]`, all bytes zero is a value, and `ENDS` are the offsets where its
/// fields end, ascending.
pub(super) unsafe trait Versioned: Copy {
    const NAME: &'static str;
    const ENDS: &'static [usize];
    /// The sizes of its fields, in order.
    const SIZES: &'static [usize];
    /// Padding would be taken for a field by a later version, or hold one of an
    /// earlier: there is none, where pointers have 64 bits.
    const HAS_NO_PADDING: () = assert!(
        cfg!(not(target_pointer_width = "64"))
            || (is_gapless(Self::ENDS, Self::SIZES)
                && Self::ENDS[Self::ENDS.len() - 1] == size_of::<Self>())
    );
}

/// True if each field begins where the one before it ends.
const fn is_gapless(ends: &[usize], sizes: &[usize]) -> bool {
    let (mut i, mut end) = (0, 0);
    while i < ends.len() {
        end += sizes[i];
        if end != ends[i] {
            return false;
        }
        i += 1;
    }
    true
}

/// Defines a struct that may grow.
macro_rules! versioned {
    (
        $(#[$meta:meta])*
        pub struct $name:ident $(<$number:ident>)? $(as $c_name:literal)? {
            pub struct_size: u32,
            $(pub $field:ident: $type:ty,)*
        }
    ) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Debug, Clone, Copy)]
        pub struct $name $(<$number>)? {
            pub struct_size: u32,
            $(pub $field: $type,)*
        }

        // SAFETY: the fields are numbers, pointers and optional functions, and
        // the ends are those of the fields, in order.
        unsafe impl $(<$number: Copy>)? $crate::capi::versioned::Versioned
            for $name $(<$number>)?
        {
            const NAME: &'static str = [$($c_name,)? stringify!($name)][0];
            const ENDS: &'static [usize] = &[
                size_of::<u32>(),
                $(std::mem::offset_of!(Self, $field) + size_of::<$type>(),)*
            ];
            const SIZES: &'static [usize] = &[size_of::<u32>(), $(size_of::<$type>(),)*];
        }
    };
}
pub(super) use versioned;

/// Defines the function that sets a caller's struct to its defaults.
macro_rules! init_function {
    ($name:ident, $type:ty) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            value: *mut $type,
            struct_size: u32,
        ) -> $crate::capi::carvel_status {
            let init = |_: &mut _| {
                // SAFETY: the header's contract.
                unsafe { $crate::capi::versioned::init(value, struct_size) }
            };
            // SAFETY: there is no error.
            unsafe { $crate::capi::guard::call(std::ptr::null_mut(), init) }
        }
    };
}
pub(super) use init_function;

/// A struct with every field at its default.
pub(super) fn initial<S: Versioned>() -> S {
    // SAFETY: all bytes zero is a value, by the trait's contract.
    unsafe { std::mem::zeroed() }
}

/// What every struct has had from the first: a smaller size is that of a pointer to
/// it, or was never set.
const SMALLEST: u32 = 16;

/// Checks a `struct_size`.
fn check_size<S: Versioned>(size: u32) -> Result<usize> {
    const { S::HAS_NO_PADDING };
    let known = S::ENDS.contains(&(size as usize)) || size as usize == size_of::<S>();
    if known && size >= SMALLEST {
        return Ok(size as usize);
    }
    Err(Fault::new(
        CARVEL_STATUS_STRUCT_SIZE,
        format!(
            "{}: struct_size is {size}, this version has {}; {}_init takes sizeof the struct",
            S::NAME,
            size_of::<S>(),
            S::NAME
        ),
    ))
}

/// The size that the caller's struct claims to have.
///
/// # Safety
/// The pointer is NULL or leads to a `struct_size`.
unsafe fn claimed<S: Versioned>(from: *const S) -> Result<usize> {
    check_pointer(from, S::NAME)?;
    // SAFETY: not NULL and aligned for S, so for its first field.
    check_size::<S>(unsafe { from.cast::<u32>().read() })
}

/// Reads the caller's struct; what it is too short for takes its default.
///
/// # Safety
/// The pointer is NULL or leads to as many bytes as its `struct_size` says.
pub(super) unsafe fn read<S: Versioned>(from: *const S) -> Result<S> {
    // SAFETY: the caller's contract.
    let size = unsafe { claimed(from)? };
    let mut value = initial::<S>();
    let to = std::ptr::from_mut(&mut value).cast::<u8>();
    // SAFETY: `size` is at most that of S, and the caller's struct has as many.
    unsafe { from.cast::<u8>().copy_to_nonoverlapping(to, size) };
    Ok(value)
}

/// Checks that the caller's struct can take a result.
///
/// # Safety
/// As [`read`].
pub(super) unsafe fn check<S: Versioned>(to: *const S) -> Result<()> {
    // SAFETY: the caller's contract.
    unsafe { claimed(to) }.map(drop)
}

/// Writes a result into the caller's struct, as far as that goes.
///
/// # Safety
/// As [`read`], and the bytes can be written.
pub(super) unsafe fn write<S: Versioned>(to: *mut S, value: &S) -> Result<()> {
    const HEAD: usize = size_of::<u32>();
    // SAFETY: the caller's contract.
    let size = unsafe { claimed(to)? };
    let from = std::ptr::from_ref(value).cast::<u8>();
    // SAFETY: as in `read`; the first field stays what the caller said.
    unsafe { from.add(HEAD).copy_to_nonoverlapping(to.cast::<u8>().add(HEAD), size - HEAD) };
    Ok(())
}

/// Writes one field of the caller's struct, of the size that it was read with, if
/// the struct goes that far.
///
/// # Safety
/// The struct can be written, and `offset` is that of a field of this type.
pub(super) unsafe fn write_field<S: Versioned, F: Copy>(
    to: *mut S,
    size: u32,
    offset: usize,
    value: F,
) {
    if offset + size_of::<F>() <= size as usize {
        // SAFETY: within the struct; aligned, since the struct is.
        unsafe { to.byte_add(offset).cast::<F>().write(value) };
    }
}

/// Sets the caller's struct to its defaults.
///
/// # Safety
/// The pointer is NULL or leads to `size` bytes that can be written.
pub(super) unsafe fn init<S: Versioned>(to: *mut S, size: u32) -> Result<()> {
    check_pointer(to, S::NAME)?;
    let bytes = check_size::<S>(size)?;
    // SAFETY: not NULL, aligned, and `size` bytes long by the caller's contract.
    unsafe {
        to.cast::<u8>().write_bytes(0, bytes);
        to.cast::<u32>().write(size);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::{CARVEL_STATUS_MISALIGNED, CARVEL_STATUS_NULL_POINTER, carvel_scheme_desc};

    fn full() -> carvel_scheme_desc {
        carvel_scheme_desc { family: 3, corner_rule: 1, boundary: 2, degree: 6, ..initial() }
    }

    fn read_as(size: u32) -> Result<carvel_scheme_desc> {
        let desc = carvel_scheme_desc { struct_size: size, ..full() };
        // SAFETY: a whole struct is there, whatever its size says.
        unsafe { read(&raw const desc) }
    }

    #[test]
    fn a_shorter_struct_is_an_older_version() {
        let fields = |size| read_as(size).map(|d| (d.family, d.corner_rule, d.boundary, d.degree));
        assert_eq!(fields(16).unwrap(), (3, 1, 2, 0));
        assert_eq!(fields(size_of::<carvel_scheme_desc>() as u32).unwrap(), (3, 1, 2, 6));
    }

    #[test]
    fn sizes_that_no_version_had_are_refused() {
        for size in [0, 1, 3, 4, 5, 8, 12, 17, 24, 57, 73, 80, u32::MAX] {
            assert_eq!(read_as(size).unwrap_err().status, CARVEL_STATUS_STRUCT_SIZE, "{size}");
        }
    }

    #[test]
    fn pointers_are_checked_first() {
        let refused = |from: *const carvel_scheme_desc| {
            // SAFETY: neither pointer is followed.
            unsafe { read(from) }.unwrap_err().status
        };
        let desc = full();
        assert_eq!(refused(std::ptr::null()), CARVEL_STATUS_NULL_POINTER);
        assert_eq!(refused((&raw const desc).wrapping_byte_add(1)), CARVEL_STATUS_MISALIGNED);
    }

    #[test]
    fn a_result_goes_as_far_as_the_struct() {
        let mut out = carvel_scheme_desc { struct_size: 16, ..initial() };
        // SAFETY: a whole struct is there.
        unsafe { write(&raw mut out, &full()).unwrap() };
        assert_eq!((out.struct_size, out.family, out.corner_rule), (16, 3, 1));
        assert_eq!((out.boundary, out.degree), (2, 0));
    }

    #[test]
    fn init_writes_no_more_than_it_was_told() {
        let mut out = full();
        // SAFETY: a whole struct is there.
        unsafe { init(&raw mut out, 16).unwrap() };
        assert_eq!((out.struct_size, out.family, out.corner_rule), (16, 0, 0));
        assert_eq!((out.boundary, out.degree), (0, 6));
    }
}
