//! Sizes in bytes: read from the command line, asked of the system.

use carvel::{Error, ErrorKind, Result};
use std::fs;

/// Reads `500000`, `512K`, `300M`, `2G` or `1T` (powers of 1024, any case, an
/// ending `B` or `iB` allowed).
pub fn parse(text: &str) -> Result<u64, String> {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (number, unit) = text.split_at(digits);
    let shift = match unit.trim().to_ascii_uppercase().as_str() {
        "" | "B" => 0,
        "K" | "KB" | "KIB" => 10,
        "M" | "MB" | "MIB" => 20,
        "G" | "GB" | "GIB" => 30,
        "T" | "TB" | "TIB" => 40,
        _ => return Err(wanted()),
    };
    let bytes = number.parse::<u64>().ok().and_then(|n| n.checked_mul(1 << shift));
    bytes.ok_or_else(wanted)
}

fn wanted() -> String {
    "a size is a whole number of bytes with or without K, M, G or T, such as 2G".to_owned()
}

/// Bytes that programs may still use; `None` where the system does not say.
pub fn available() -> Option<u64> {
    kilobytes("/proc/meminfo", "MemAvailable:")
}

/// The most memory that this process has held so far.
pub fn peak() -> Option<u64> {
    kilobytes("/proc/self/status", "VmHWM:")
}

fn kilobytes(file: &str, field: &str) -> Option<u64> {
    let text = fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(field))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// An array of zeros, or an error where the system has no room for it.
pub fn zeroed<T: Copy>(zero: T, len: u64) -> Result<Vec<T>> {
    let len = usize::try_from(len).unwrap_or(usize::MAX);
    // Tried out first: the plain request below aborts where it is refused, but
    // gets untouched pages straight from the system.
    Vec::<T>::new().try_reserve_exact(len).map_err(|_| {
        let bytes = len.saturating_mul(size_of::<T>());
        Error::new(ErrorKind::OutOfResources, format!("{bytes} bytes could not be had"))
    })?;
    Ok(vec![zero; len])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units() {
        for (text, bytes) in
            [("0", 0), ("17", 17), ("2k", 2048), ("3M", 3 << 20), ("1 GiB", 1 << 30)]
        {
            assert_eq!(parse(text), Ok(bytes), "{text}");
        }
        for text in ["", "G", "-1", "1.5G", "1X", "99999999999T", "18446744073709551616"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn an_impossible_request_is_an_error() {
        assert_eq!(zeroed(0_u64, u64::MAX).unwrap_err().kind(), ErrorKind::OutOfResources);
    }
}
