//! Counts bytes and calls the progress hook now and then.

use super::Progress;
use crate::base::{Error, ErrorKind, Result};

/// Bytes between two calls of the hook.
const STEP: u64 = 1 << 20;

/// The bytes done so far and who wants to know.
pub(super) struct Watch<'a> {
    progress: Option<Progress<'a>>,
    total: Option<u64>,
    done: u64,
    next: u64,
}

impl<'a> Watch<'a> {
    pub fn new(progress: Option<Progress<'a>>, total: Option<u64>) -> Self {
        Self { progress, total, done: 0, next: 0 }
    }

    /// Bytes in all, where known.
    pub fn total(&self) -> Option<u64> {
        self.total
    }

    pub fn set_total(&mut self, total: u64) {
        self.total = Some(total);
    }

    /// Bytes done.
    pub fn done(&self) -> u64 {
        self.done
    }

    /// Counts bytes; an error if the hook wants to stop.
    #[inline]
    pub fn advance(&mut self, bytes: u64, name: &str) -> Result<()> {
        self.done += bytes;
        if self.done < self.next { Ok(()) } else { self.report(name) }
    }

    /// Calls the hook.
    #[cold]
    pub fn report(&mut self, name: &str) -> Result<()> {
        self.next = self.done + STEP;
        match self.progress {
            Some(hook) if !hook(self.done, self.total) => {
                Err(Error::new(ErrorKind::Cancelled, format!("{name}: cancelled")))
            }
            _ => Ok(()),
        }
    }
}
