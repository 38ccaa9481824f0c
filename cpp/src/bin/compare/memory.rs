//! How much memory a call takes, measured and not computed.

use std::fs;
use std::hint::black_box;

/// A field of a file under `/proc` in bytes.
fn field(file: &str, name: &str) -> Result<u64, String> {
    let text = fs::read_to_string(file).map_err(|e| format!("{file}: {e}"))?;
    let line = text.lines().find(|line| line.starts_with(name));
    let kib = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<u64>().ok());
    kib.map(|kib| kib * 1024).ok_or_else(|| format!("{file} has no {name}"))
}

/// Bytes that the system could give to a process now.
pub fn available() -> Result<u64, String> {
    field("/proc/meminfo", "MemAvailable:")
}

/// The resident set at the start of a measurement.
pub struct Watch {
    before: u64,
}

impl Watch {
    /// Starts at the present size of the resident set.
    pub fn start() -> Result<Self, String> {
        // 5 sets the recorded peak back to the present size.
        let place = "/proc/self/clear_refs";
        fs::write(place, "5").map_err(|e| format!("{place}: {e}"))?;
        Ok(Self { before: field("/proc/self/status", "VmRSS:")? })
    }

    /// By how much the resident set has grown since, at its peak.
    pub fn peak(&self) -> Result<u64, String> {
        Ok(field("/proc/self/status", "VmHWM:")?.saturating_sub(self.before))
    }
}

/// Fails unless a large array of this process lies on huge pages.
pub fn check_huge_pages() -> Result<(), String> {
    const BYTES: usize = 64 << 20;
    let array = black_box(vec![1_u8; BYTES]);
    let huge = field("/proc/self/smaps_rollup", "AnonHugePages:")?;
    drop(array);
    if huge >= BYTES as u64 / 2 {
        return Ok(());
    }
    Err(format!(
        "regime huge: {huge} of {BYTES} bytes are on huge pages; the system does not give them"
    ))
}
