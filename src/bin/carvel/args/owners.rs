//! Which option belongs to which schemes.

use super::names::{Name, spelled};
use crate::exit::Failure;

/// The schemes with creases, holes and seams.
pub(super) const FEATURED: &[Name] = &[Name::CatmullClark, Name::Loop, Name::Bilinear];

/// The averaging family.
pub(super) const AVERAGING: &[Name] =
    &[Name::ThreePoint, Name::DooSabin, Name::Quartic, Name::Bspline, Name::Averaging];

/// Refuses the first option given that belongs to other schemes than the one named:
/// options come with whether they were given, and with their owners.
pub(super) fn refuse_strangers(
    scheme: Name,
    options: &[(&str, bool, &[Name])],
) -> Result<(), Failure> {
    let stranger = options.iter().find(|(_, given, of)| *given && !of.contains(&scheme));
    stranger.map_or(Ok(()), |(option, _, of)| {
        let (of, scheme) = (listed(of), spelled(&scheme));
        Err(Failure::usage(format!("{option} belongs to --scheme {of}, not to {scheme}")))
    })
}

/// `a`, `a or b`, `a, b or c`.
fn listed(names: &[Name]) -> String {
    let names: Vec<_> = names.iter().map(spelled).collect();
    match names.split_last() {
        Some((last, before)) if !before.is_empty() => format!("{} or {last}", before.join(", ")),
        _ => names.concat(),
    }
}
