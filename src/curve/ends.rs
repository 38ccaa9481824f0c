//! What happens at the ends of a polygon.

use super::mask::out_of_range;
use super::rules::Rules;
use crate::base::{Error, ErrorKind, Result};

/// Whether a polygon is closed, and what a step does at the ends of an open one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Ends {
    /// The last point is followed by the first.
    Closed,
    /// New points whose rule reaches beyond the ends are dropped.
    Dropped,
    /// The ends stay where they are: the polygon goes on by the odd extension
    /// p₋ⱼ = 2p₀ − pⱼ. Needs a symmetric mask and two points.
    Kept,
    /// The same for a polygon whose first and last point are *anchors*, half an interval
    /// before the next point and behind the last but one: what a step with [`Ends::Kept`]
    /// leaves if new points do not fall on old ones (Chaikin and all dual binary masks).
    Anchored,
}

impl Ends {
    /// The name: `closed`, `dropped`, `kept`, `anchored`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Closed => "closed",
            Self::Dropped => "dropped",
            Self::Kept => "kept",
            Self::Anchored => "anchored",
        }
    }

    /// The fewest points of a polygon with these ends.
    fn least(self) -> usize {
        match self {
            Self::Closed | Self::Dropped => 1,
            Self::Kept => 2,
            Self::Anchored => 3,
        }
    }
}

/// Which new points a step makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Extent {
    /// The index of the first new point by the mask's own counting, where old point 0 is
    /// the first that is not an anchor.
    pub first: i64,
    /// How many the rules make.
    pub made: usize,
    /// The ends of the result.
    pub ends: Ends,
}

impl Extent {
    /// What a step makes of `points` points.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for too few points, [`ErrorKind::Unsupported`] for ends
    /// that are to stay under rules that are not symmetric, [`ErrorKind::TooLarge`].
    pub fn of<W>(rules: &Rules<W>, ends: Ends, points: usize) -> Result<Self> {
        let least = ends.least();
        if points < least {
            let message =
                format!("a polygon ({}) needs {least} or more points, not {points}", ends.name());
            return Err(Error::new(ErrorKind::LengthMismatch, message));
        }
        let too_large = || Error::new(ErrorKind::TooLarge, format!("{points} points and more"));
        let n = i64::try_from(points).ok().filter(|n| n.checked_mul(128).is_some());
        let n = n.ok_or_else(too_large)?;
        match ends {
            Ends::Closed => Ok(Self { first: 0, made: (n * rules.arity()) as usize, ends }),
            Ends::Dropped => Self::complete(rules, n),
            Ends::Kept => Self::mirrored(rules, n - 1, 0),
            Ends::Anchored => Self::mirrored(rules, n - 2, 1),
        }
    }

    /// The longest run of new points that need nothing beyond `n` points.
    fn complete<W>(rules: &Rules<W>, n: i64) -> Result<Self> {
        let m = rules.arity();
        let reaches = || rules.reaches().enumerate().map(|(e, reach)| (e as i64, reach));
        let first = reaches().map(|(e, (low, _))| m * (-low - 1) + e + 1).max().unwrap_or(0);
        let end = reaches().map(|(e, (_, high))| m * (n - high) + e).min().unwrap_or(0);
        if end <= first {
            let message = format!("too few points, {n}, for a rule that stays between the ends");
            return Err(Error::new(ErrorKind::LengthMismatch, message));
        }
        Ok(Self { first, made: (end - first) as usize, ends: Ends::Dropped })
    }

    /// New points from one end to the other, `intervals` apart; `anchored` is 1 if old
    /// points lie half an interval from the ends.
    ///
    /// New point i lies at (i − c)/m + anchored/2 from the first end, c the mask's middle.
    fn mirrored<W>(rules: &Rules<W>, intervals: i64, anchored: i64) -> Result<Self> {
        let Some(twice_centre) = rules.twice_centre() else {
            let message = "ends stay in place under symmetric masks only".to_owned();
            return Err(Error::new(ErrorKind::Unsupported, message));
        };
        let m = rules.arity();
        let twice_first = twice_centre - anchored * m;
        let on_end = twice_first.rem_euclid(2) == 0;
        let made = m * intervals + i64::from(on_end);
        Ok(Self {
            first: twice_first.div_euclid(2) + i64::from(!on_end),
            made: made as usize,
            ends: if on_end { Ends::Kept } else { Ends::Anchored },
        })
    }

    /// The number of points of the result, anchors included.
    pub fn points(&self) -> usize {
        self.made + 2 * usize::from(self.ends == Ends::Anchored)
    }
}

/// The number of points, and the ends, after some steps.
///
/// # Errors
/// As a refinement: [`ErrorKind::LengthMismatch`], [`ErrorKind::Unsupported`],
/// [`ErrorKind::TooLarge`], [`ErrorKind::ParameterOutOfRange`] for more than 64 steps.
pub(crate) fn predict<W>(
    rules: &Rules<W>,
    ends: Ends,
    points: usize,
    steps: u32,
) -> Result<(usize, Ends)> {
    check_steps(steps)?;
    (0..steps).try_fold((points, ends), |(points, ends), _| {
        let extent = Extent::of(rules, ends, points)?;
        Ok((extent.points(), extent.ends))
    })
}

pub(crate) fn check_steps(steps: u32) -> Result<()> {
    const MOST_STEPS: u32 = 64;
    if steps > MOST_STEPS {
        return Err(out_of_range(format!("{steps} steps: the limit is {MOST_STEPS}")));
    }
    Ok(())
}
