//! What all commands share: threads, limits, interruption, the console.

use crate::console::Console;
use crate::exit::{Doing, Failure};
use crate::interrupt::{self, Blocking};
use crate::memory;
use carvel::base::CancelFlag;
use carvel::{Context, Error, ErrorKind};
use std::path::Path;
use std::sync::Arc;

/// One run of the command.
#[derive(Debug)]
pub struct Session {
    /// Threads, memory ceiling, cancel flag.
    pub context: Context,
    /// Lines and progress.
    pub console: Arc<Console>,
    cancel: CancelFlag,
    blocking: Blocking,
}

impl Session {
    /// A session on so many threads (0: all cores) under a memory ceiling
    /// (`None`: what the system has left).
    pub fn new(threads: usize, ceiling: Option<u64>, quiet: bool) -> Result<Self, Failure> {
        let console = Arc::new(Console::new(quiet));
        let shown = Arc::clone(&console);
        let mut builder = Context::builder().threads(threads).progress(move |done| {
            shown.part(done);
            true
        });
        if let Some(bytes) = ceiling.or_else(memory::available) {
            builder = builder.memory_ceiling(bytes);
        }
        let context = builder.build().map_err(|e| Failure::from_error(&e, Doing::Working))?;
        let cancel = context.cancel_flag();
        let blocking = interrupt::listen(cancel.clone(), Arc::clone(&console));
        Ok(Self { context, console, cancel, blocking })
    }

    /// A hook for readers and writers, which count bytes.
    pub fn bytes_hook(&self) -> impl Fn(u64, Option<u64>) -> bool + '_ {
        |done, total| {
            self.console.bytes(done, total);
            !self.is_cancelled()
        }
    }

    /// True once the user wants to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// Stops here once the user wants to stop.
    pub fn refuse_if_cancelled(&self) -> Result<(), Failure> {
        let error = Error::new(ErrorKind::Cancelled, "cancelled");
        if self.is_cancelled() { Err(Failure::from_error(&error, Doing::Working)) } else { Ok(()) }
    }

    /// Runs work on a path. If that is a standard stream or a pipe it may wait
    /// for others without end, and an interruption then ends the process at once.
    pub fn on_path<R>(&self, path: &Path, work: impl FnOnce() -> R) -> R {
        let file = path.as_os_str() != "-" && path.metadata().is_ok_and(|m| m.is_file());
        let missing = path.as_os_str() != "-" && !path.exists();
        let _guard = (!file && !missing).then(|| self.blocking.enter());
        work()
    }
}
