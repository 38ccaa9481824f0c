//! The products of some matrices that grow most.

use super::spectral::{Dense, radius};
use crate::base::{Context, Result};

/// The most products that are looked at, and multiplications spent on them.
const MOST_PRODUCTS: usize = 1500;
const MOST_WORK: usize = 100_000_000;
/// Growths that differ by less count as the same.
const SAME: f64 = 1e-9;

/// A product of matrices: the order in which they are applied, last first.
#[derive(Debug, Clone)]
pub(super) struct Word {
    pub letters: Vec<usize>,
    /// The spectral radius to the power 1/length, estimated.
    pub growth: f64,
    /// A high power of the product.
    pub power: Dense,
}

/// The products that grow most among the short ones: all with the same growth up to
/// rounding, the shortest first; empty if none grows. No other product is a rotation of one.
///
/// # Errors
/// [`crate::ErrorKind::Cancelled`].
pub(super) fn leading_words(context: &Context, matrices: &[Dense]) -> Result<Vec<Word>> {
    let size = matrices.first().map_or(1, |matrix| matrix.size);
    // Squarings are given up early for most products.
    let budget = (MOST_WORK / (12 * size.pow(3))).clamp(64, MOST_PRODUCTS);
    let mut found: Vec<Word> = Vec::new();
    let mut level: Vec<(Vec<usize>, Dense)> =
        matrices.iter().enumerate().map(|(i, matrix)| (vec![i], matrix.clone())).collect();
    let mut seen = 0;
    while seen + level.len() <= budget {
        context.check_cancelled()?;
        seen += level.len();
        let necklaces = level.iter().filter(|(letters, _)| is_least_rotation(letters));
        for (letters, product) in necklaces {
            keep_if_leading(&mut found, letters, product);
        }
        level = extended(&level, matrices);
    }
    Ok(found)
}

fn extended(level: &[(Vec<usize>, Dense)], matrices: &[Dense]) -> Vec<(Vec<usize>, Dense)> {
    let with = |(letters, product): &(Vec<usize>, Dense), i: usize| {
        let mut letters = letters.clone();
        letters.push(i);
        (letters, product.product(&matrices[i]))
    };
    let all = level.iter().flat_map(|word| (0..matrices.len()).map(move |i| with(word, i)));
    all.collect()
}

fn keep_if_leading(found: &mut Vec<Word>, letters: &[usize], product: &Dense) {
    let best = found.first().map_or(0.0, |word| word.growth);
    let length = letters.len() as f64;
    let least = libm::pow(best * (1.0 - SAME), length);
    let Some((radius, power)) = radius(product, least) else { return };
    let growth = libm::pow(radius, 1.0 / length);
    if growth > best * (1.0 + SAME) {
        found.clear();
    } else if growth < best * (1.0 - SAME) || found.len() >= 8 {
        return;
    }
    found.push(Word { letters: letters.to_vec(), growth, power });
}

/// True for the least of its rotations that is no power of a shorter word.
fn is_least_rotation(letters: &[usize]) -> bool {
    (1..letters.len()).all(|k| {
        let rotated = letters[k..].iter().chain(&letters[..k]);
        letters.iter().lt(rotated)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_counted_once_up_to_rotation() {
        assert!(is_least_rotation(&[0, 0, 1]));
        assert!(!is_least_rotation(&[0, 1, 0]));
        assert!(!is_least_rotation(&[0, 1, 0, 1]));
    }

    /// The golden pair: neither matrix grows faster than their product.
    #[test]
    fn the_product_of_the_golden_pair_leads() {
        let a = Dense { size: 2, entries: vec![1.0, 1.0, 0.0, 1.0] };
        let b = Dense { size: 2, entries: vec![1.0, 0.0, 1.0, 1.0] };
        let words = leading_words(&Context::serial(), &[a, b]).unwrap();
        assert_eq!(words[0].letters, [0, 1]);
        assert!((words[0].growth - f64::midpoint(1.0, 5f64.sqrt())).abs() < 1e-9);
    }
}
