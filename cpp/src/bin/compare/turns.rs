//! Sides in turns, so that whatever disturbs the machine disturbs all of them.

use carvel_peers::heap;

use crate::memory::Watch;
use crate::sides::Side;

/// Seconds since some moment.
pub type Clock = fn() -> f64;

/// What a side's calls took.
#[derive(Default)]
pub struct Taken {
    seconds: Vec<f64>,
    /// Processor time of all threads.
    cpu: Vec<f64>,
    bytes: Vec<f64>,
}

impl Taken {
    /// The median in seconds.
    pub fn time(&self) -> f64 {
        median(&self.seconds)
    }

    /// The median processor time in seconds.
    pub fn cpu(&self) -> f64 {
        median(&self.cpu)
    }

    /// Half the range of the middle half of the times, relative to the median.
    pub fn spread(&self) -> f64 {
        let (sorted, n) = (sorted(&self.seconds), self.seconds.len());
        let range = sorted.get(n - 1 - n / 4).zip(sorted.get(n / 4));
        range.map_or(f64::NAN, |(high, low)| (high - low) / 2.0 / self.time())
    }

    /// The median growth of the resident set in bytes.
    pub fn memory(&self) -> f64 {
        median(&self.bytes)
    }

    /// How many calls were timed.
    pub fn runs(&self) -> u32 {
        self.seconds.len() as u32
    }

    fn watch(&mut self, side: &mut dyn Side, clock: Clock) -> Result<(), String> {
        side.prepare()?;
        let watch = Watch::start()?;
        self.clock(side, clock)?;
        self.bytes.push(watch.peak()? as f64);
        Ok(())
    }

    fn clock(&mut self, side: &mut dyn Side, clock: Clock) -> Result<(), String> {
        let start = [clock(), heap::cpu_seconds()];
        side.call()?;
        self.seconds.push(clock() - start[0]);
        self.cpu.push(heap::cpu_seconds() - start[1]);
        Ok(())
    }
}

/// All sides in turn, each from memory that nobody has touched.
pub fn fresh(sides: &mut [&mut dyn Side], runs: u32) -> Result<Vec<Taken>, String> {
    let mut taken: Vec<_> = sides.iter().map(|_| Taken::default()).collect();
    for _ in 0..runs {
        for (side, taken) in sides.iter_mut().zip(&mut taken) {
            taken.watch(*side, heap::cpu_seconds)?;
            side.clear();
        }
    }
    Ok(taken)
}

/// All sides in turn, after a call of each that touches the memory; what it touched is
/// the peak, since later calls touch no more.
pub fn warmed(sides: &mut [&mut dyn Side], runs: u32, clock: Clock) -> Result<Vec<Taken>, String> {
    several(sides, runs, 1, clock)
}

/// The same with some calls of a side after each other in its turn.
pub fn several(
    sides: &mut [&mut dyn Side],
    runs: u32,
    calls: u32,
    clock: Clock,
) -> Result<Vec<Taken>, String> {
    let mut taken: Vec<_> = sides.iter().map(|_| Taken::default()).collect();
    for (side, taken) in sides.iter_mut().zip(&mut taken) {
        heap::trim();
        taken.watch(*side, clock)?;
        taken.seconds.clear();
        taken.cpu.clear();
    }
    for side in sides.iter_mut() {
        side.clear();
    }
    for _ in 0..runs {
        for (side, taken) in sides.iter_mut().zip(&mut taken) {
            for _ in 0..calls {
                side.prepare()?;
                taken.clock(*side, clock)?;
                side.clear();
            }
        }
    }
    Ok(taken)
}

fn sorted(values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values
}

fn median(values: &[f64]) -> f64 {
    let values = sorted(values);
    let n = values.len();
    if n == 0 { f64::NAN } else { f64::midpoint(values[(n - 1) / 2], values[n / 2]) }
}
