//! Every line and the progress bar on the standard error stream.

use crate::exit::{Exit, Failure};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, Write, stderr};
use std::thread;
use std::time::Duration;

/// Work shorter than this gets no progress bar.
const PATIENCE: Duration = Duration::from_secs(1);
/// Time between two pictures of a bar that does not move.
const TICK: Duration = Duration::from_millis(200);
/// Steps of the bar.
const STEPS: u64 = 1000;

/// Notes, errors, summaries and progress; a closed stream is ignored.
#[derive(Debug)]
pub struct Console {
    quiet: bool,
    bar: ProgressBar,
}

impl Console {
    /// A console without a progress bar.
    pub fn plain() -> Self {
        Self { quiet: false, bar: ProgressBar::hidden() }
    }

    /// A console for long work: a bar appears on a terminal after a second,
    /// unless `quiet`.
    pub fn new(quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        bar.set_style(style());
        if !quiet && stderr().is_terminal() {
            let bar = bar.clone();
            thread::spawn(move || show_later(&bar));
        }
        Self { quiet, bar }
    }

    /// Names what is being done now.
    pub fn phase(&self, what: &str, name: &str) {
        self.bar.set_position(0);
        self.bar.set_message(String::new());
        self.bar.set_prefix(format!("{what} {name}"));
    }

    /// Says which part of it is done, in [0, 1].
    pub fn part(&self, done: f64) {
        self.bar.set_position((done.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }

    /// Says how many bytes are done, and of how many where that is known.
    pub fn bytes(&self, done: u64, total: Option<u64>) {
        match total {
            Some(total) if total > 0 => self.part(done as f64 / total as f64),
            _ => self.bar.set_message(format!("{} MB ", done / 1_000_000)),
        }
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// Something the user should know, unless they asked for quiet.
    pub fn note(&self, text: &str) {
        if !self.quiet {
            self.line(&format!("carvel: note: {text}"));
        }
    }

    /// What was done, unless they asked for quiet.
    pub fn summary(&self, text: &str) {
        if !self.quiet {
            self.line(text);
        }
    }

    /// Why something was not done; returns the exit code.
    pub fn failure(&self, failure: &Failure) -> Exit {
        if !failure.silent {
            self.line(&format!("carvel: {}", failure.message));
        }
        failure.exit
    }

    /// A line as it is.
    pub fn line(&self, text: &str) {
        self.bar.suspend(|| {
            let _ = writeln!(stderr(), "{text}");
        });
    }
}

fn show_later(bar: &ProgressBar) {
    thread::sleep(PATIENCE);
    if !bar.is_finished() {
        bar.set_draw_target(ProgressDrawTarget::stderr());
        bar.enable_steady_tick(TICK);
    }
}

fn style() -> ProgressStyle {
    let template = "{prefix} [{bar:30}] {percent}% {msg}{elapsed}";
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}
