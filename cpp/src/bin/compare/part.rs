//! The parts of the comparison, each of which can be asked for alone.

use crate::args::Args;
use crate::regime::Regime;
use crate::row::Row;
use crate::{cases, linear, measure, orientation, per_frame, surface, threads};

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Part {
    /// One-shot refinement beside every peer.
    Refine,
    /// New positions on a topology that is ready, beside OpenSubdiv.
    PerFrame,
    /// Points of the limit surface, beside OpenSubdiv.
    Surface,
    /// Two threads beside one.
    Threads,
    /// Large results beside a small one.
    Linear,
    /// One-shot refinement beside Rust crates.
    Orientation,
}

/// Takes a row, or what came in its place, as it comes.
pub type Emit<'a> = &'a mut dyn FnMut(Result<Row, String>);

impl Part {
    /// All.
    pub const ALL: [Self; 6] = [
        Self::Refine,
        Self::PerFrame,
        Self::Surface,
        Self::Threads,
        Self::Linear,
        Self::Orientation,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Refine => "refine",
            Self::PerFrame => "per-frame",
            Self::Surface => "surface",
            Self::Threads => "threads",
            Self::Linear => "linear",
            Self::Orientation => "orientation",
        }
    }

    /// The states of memory that it is measured in.
    pub fn regimes(self) -> &'static [Regime] {
        match self {
            Self::Refine => &Regime::ALL,
            Self::PerFrame | Self::Surface | Self::Threads => &[Regime::ReUsed],
            Self::Linear => &[Regime::Default],
            Self::Orientation => &[Regime::Default, Regime::ReUsed],
        }
    }

    /// Measures all of it in this process.
    pub fn run(self, regime: Regime, args: &Args, emit: Emit) -> Result<(), String> {
        match self {
            Self::Refine => refine(regime, args, emit),
            Self::PerFrame => per_frame::run(args.runs, emit),
            Self::Surface => surface::run(args.runs, emit),
            Self::Threads => threads::run(args.runs, emit),
            Self::Linear => linear::run(args, emit),
            Self::Orientation => orientation::run(regime, args.runs, emit),
        }
    }
}

fn refine(regime: Regime, args: &Args, emit: Emit) -> Result<(), String> {
    for case in cases::all(args, regime)? {
        for peer in case.peers() {
            let row = measure::row(&case, peer, regime, args.runs);
            let about =
                |reason| format!("{} on {} with {}: {reason}", case.name(), case.mesh, peer.name());
            emit(row.map_err(about));
        }
    }
    Ok(())
}
