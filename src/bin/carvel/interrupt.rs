//! Ctrl-C and a polite kill: stop soon, leave nothing half done.
//!
//! Work in progress sees the cancel flag and unwinds, which removes temporary
//! files. While the process waits for a stream of another process there is no
//! temporary file, and nobody to look at the flag: then it ends at once.
//!
//! A hang-up is left to the system, so that `nohup` works.

use crate::console::Console;
use crate::exit::Exit;
use carvel::base::CancelFlag;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the process may be waiting for another one.
#[derive(Debug, Clone, Default)]
pub struct Blocking(Arc<AtomicBool>);

/// Marks the time of waiting; over when dropped.
#[derive(Debug)]
pub struct Waiting<'a>(&'a AtomicBool);

impl Blocking {
    /// From now on an interruption ends the process at once.
    pub fn enter(&self) -> Waiting<'_> {
        self.0.store(true, Ordering::SeqCst);
        Waiting(&self.0)
    }
}

impl Drop for Waiting<'_> {
    fn drop(&mut self) {
        self.0.store(false, Ordering::SeqCst);
    }
}

/// Sets the flag when the user interrupts.
///
/// Where signals cannot be had the system's own way stays in force.
pub fn listen(flag: CancelFlag, console: Arc<Console>) -> Blocking {
    let blocking = Blocking::default();
    let waiting = blocking.clone();
    on_signal(move || {
        flag.cancel();
        if waiting.0.load(Ordering::SeqCst) {
            console.clear();
            console.line("carvel: interrupted");
            std::process::exit(Exit::Cancelled as i32);
        }
    });
    blocking
}

#[cfg(unix)]
fn on_signal(act: impl Fn() + Send + 'static) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM]) {
        std::thread::spawn(move || signals.forever().for_each(|_| act()));
    }
}

#[cfg(not(unix))]
fn on_signal(act: impl Fn() + Send + 'static) {
    let _ = ctrlc::set_handler(act);
}
