//! Which processor a thread runs on, and what two threads gain on this machine at all.

use rustix::thread::{CpuSet, Pid, sched_getaffinity, sched_setaffinity};
use std::fs;
use std::hint::black_box;
use std::io;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Scope, scope};

use crate::sides::Side;
use crate::turns;

/// What carvel's threads are called, before their number.
const NAME: &str = "carvel-";

/// Steps of a count, each of which waits for the one before: some ten milliseconds, as long as
/// a refinement to two million faces.
const STEPS: u64 = 10_000_000;

/// The first processors that this process may run on.
pub fn allowed(wanted: usize) -> Result<Vec<usize>, String> {
    let set = sched_getaffinity(None).map_err(|e| format!("processors: {e}"))?;
    let found: Vec<_> = (0..CpuSet::MAX_CPU).filter(|&i| set.is_set(i)).take(wanted).collect();
    if found.len() == wanted {
        return Ok(found);
    }
    Err(format!("{wanted} processors are needed, {} are there", found.len()))
}

/// Keeps a thread, or the calling one, on a processor.
pub fn hold(thread: Option<Pid>, processor: usize) -> Result<(), String> {
    let mut set = CpuSet::new();
    set.set(processor);
    sched_setaffinity(thread, &set).map_err(|e| format!("processor {processor}: {e}"))
}

/// Keeps each of carvel's threads on a processor of its own.
pub fn hold_ours(processors: &[usize]) -> Result<(), String> {
    let failed = |e: io::Error| format!("/proc/self/task: {e}");
    let mut held = 0;
    for thread in fs::read_dir("/proc/self/task").map_err(failed)? {
        let path = thread.map_err(failed)?.path();
        let name = fs::read_to_string(path.join("comm")).map_err(failed)?;
        let Some(number) = name.trim().strip_prefix(NAME) else { continue };
        let number: usize = number.parse().map_err(|_| format!("a thread called {name}"))?;
        let id = path.file_name().and_then(|id| id.to_str()?.parse().ok());
        let id = id.and_then(Pid::from_raw).ok_or("a thread without a number")?;
        hold(Some(id), *processors.get(number).ok_or("more threads than processors")?)?;
        held += 1;
    }
    if held == processors.len() { Ok(()) } else { Err(format!("{held} threads of carvel")) }
}

/// How many times as fast as one thread two bare ones count that wait for work as carvel's
/// do, wherever they are put and each held on a processor of its own.
pub fn gain(processors: &[usize], runs: u32, clock: turns::Clock) -> Result<[f64; 2], String> {
    let free = scope(|scope| counted(&Counters::start(scope, processors.len(), None), runs, clock));
    let held = scope(|scope| {
        counted(&Counters::start(scope, processors.len(), Some(processors)), runs, clock)
    });
    Ok([free?, held?])
}

fn counted(counters: &Counters, runs: u32, clock: turns::Clock) -> Result<f64, String> {
    let mut all = Count { counters, used: counters.threads.len() };
    let mut one = Count { counters, used: 1 };
    let taken = turns::warmed(&mut [&mut all, &mut one], runs, clock)?;
    Ok(taken[1].time() / taken[0].time())
}

/// Threads that count when they are told to.
struct Counters {
    threads: Vec<SyncSender<u64>>,
    done: Receiver<Result<(), String>>,
}

impl Counters {
    fn start<'s>(scope: &'s Scope<'s, '_>, threads: usize, held: Option<&'s [usize]>) -> Self {
        let (report, done) = sync_channel(threads);
        let start = |i: usize| {
            let (tell, told) = sync_channel(1);
            let report = report.clone();
            scope.spawn(move || {
                let place = held.map_or(Ok(()), |processors| hold(None, processors[i]));
                for steps in told {
                    count(steps);
                    if report.send(place.clone()).is_err() {
                        return;
                    }
                }
            });
            tell
        };
        Self { threads: (0..threads).map(start).collect(), done }
    }
}

/// The same number of steps, shared by some of the threads.
struct Count<'a> {
    counters: &'a Counters,
    used: usize,
}

impl Side for Count<'_> {
    fn call(&mut self) -> Result<(), String> {
        let used = &self.counters.threads[..self.used];
        for thread in used {
            thread.send(STEPS / self.used as u64).map_err(|e| e.to_string())?;
        }
        let wait = |_| self.counters.done.recv().map_err(|e| e.to_string())?;
        used.iter().try_for_each(wait)
    }
}

fn count(steps: u64) {
    let mut sum = 1_u64;
    for step in 0..steps {
        sum = black_box(sum.wrapping_mul(step | 1));
    }
    black_box(sum);
}
