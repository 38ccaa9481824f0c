//! `make compare`: carvel and its peers on the same meshes, in one table.
//!
//! One process per part and memory regime: a regime is a state of the whole process, and some of
//! it must be set before the process begins. Within one, carvel and the peer take turns,
//! so that whatever disturbs the machine disturbs both.

mod args;
mod buffers;
mod cases;
mod linear;
mod matched;
mod measure;
mod memory;
mod orientation;
mod part;
mod per_frame;
mod processors;
mod regime;
mod row;
mod sides;
mod surface;
mod table;
mod threads;
mod turns;

use args::Args;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = match Args::read() {
        Ok(args) => args,
        Err(code) => return code,
    };
    let done = match args.child {
        Some(regime) => regime::run_here(regime, &args),
        None => regime::run_all(&args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("compare: {reason}");
            ExitCode::FAILURE
        }
    }
}
