//! Elements tagged more than once: the last tag holds.

use std::collections::HashMap;
use std::hash::Hash;

/// Keeps one item per key, the last at the place of the first. Returns how many
/// were replaced by one that says something else.
pub(super) fn last_of_each<T: Copy, K: Hash + Eq>(
    items: &mut Vec<T>,
    key: impl Fn(&T) -> K,
    agree: impl Fn(&T, &T) -> bool,
) -> u64 {
    let mut places = HashMap::new();
    let mut replaced = 0;
    let mut kept: Vec<T> = Vec::new();
    for item in items.iter() {
        let place = *places.entry(key(item)).or_insert(kept.len());
        match kept.get_mut(place) {
            None => kept.push(*item),
            Some(before) => {
                replaced += u64::from(!agree(before, item));
                *before = *item;
            }
        }
    }
    *items = kept;
    replaced
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_holds_at_the_place_of_the_first() {
        let mut items = vec![(1, 'a'), (2, 'b'), (1, 'c'), (2, 'b'), (3, 'd')];
        let replaced = last_of_each(&mut items, |item| item.0, |a, b| a == b);
        assert_eq!(items, [(1, 'c'), (2, 'b'), (3, 'd')]);
        assert_eq!(replaced, 1);
    }
}
