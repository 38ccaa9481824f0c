//! Weights of samples, and what evaluation promises of them.

use super::{Shape, WIDTH, assert_near, at, bases, closed_meshes, quad_schemes};
use carvel::limit::{Derivatives, Sample};
use carvel::{Context, Scheme};

#[test]
fn weights_are_what_is_evaluated() {
    for of in closed_meshes() {
        let shape = Shape::new(&of);
        for scheme in quad_schemes() {
            let surface = shape.surface(&scheme);
            for face in [0, of.faces.len() - 1] {
                let sample = at(face, surface.sectors(face) - 1, [0.81, 0.93]);
                let weights = surface.weights(&sample, Derivatives::First).unwrap();
                assert!(weights.windows(2).all(|pair| pair[0].0 < pair[1].0));
                let mut sums = vec![0.0; 3 * WIDTH];
                let mut totals = [0.0; 3];
                for (v, of) in weights {
                    for record in 0..3 {
                        totals[record] += of[record];
                        for k in 0..WIDTH {
                            let value = shape.values[WIDTH * v as usize + k];
                            sums[record * WIDTH + k] += of[record] * value;
                        }
                    }
                }
                let what = format!("{scheme:?}, {sample:?}");
                assert_near(&totals, &[1.0, 0.0, 0.0], 1e-12, &what);
                let found = shape.evaluate(&surface, sample, Derivatives::First);
                assert_near(&found, &sums, 1e-11, &what);
            }
        }
    }
}

fn many(faces: usize) -> Vec<Sample> {
    let coordinate = |i: usize, by: f64| (0.05 + i as f64 * by).fract();
    let sample = |i: usize| at(i % faces, 0, [coordinate(i, 0.37), coordinate(i, 0.73)]);
    (0..500).map(sample).collect()
}

#[test]
fn threads_change_no_bit_and_singles_are_near() {
    let shape = Shape::new(&bases::prism(5));
    let single: Vec<f32> = shape.values.iter().map(|&x| x as f32).collect();
    let threads = Context::builder().threads(3).chunk(7).build().unwrap();
    for scheme in [Scheme::catmull_clark(), Scheme::doo_sabin()] {
        let surface = shape.surface(&scheme);
        let samples = many(shape.mesh.faces());
        let len = samples.len() * WIDTH * 3;
        let (mut alone, mut together) = (vec![0.0; len], vec![1.0; len]);
        let first = Derivatives::First;
        let values = &shape.values;
        surface.evaluate(&Context::serial(), &samples, values, WIDTH, first, &mut alone).unwrap();
        surface.evaluate(&threads, &samples, values, WIDTH, first, &mut together).unwrap();
        assert!(alone.iter().zip(&together).all(|(a, b)| a.to_bits() == b.to_bits()));
        let mut near = vec![0.0_f32; len];
        surface.evaluate(&threads, &samples, &single, WIDTH, first, &mut near).unwrap();
        let near: Vec<f64> = near.iter().map(|&x| f64::from(x)).collect();
        assert_near(&near, &alone, 1e-6, "single precision");
    }
}

/// Samples share the way down to them. More than is remembered of it here leads to where a
/// sample alone is led.
#[test]
fn what_is_remembered_changes_no_bit() {
    const WIDE: usize = 128;
    let shape = Shape::new(&bases::cube());
    let values: Vec<f64> = (0..8 * WIDE).map(|i| ((i * i) as f64).sin()).collect();
    let near = |i: usize| 0.75 * 0.5_f64.powi(i as i32 % 40);
    let samples: Vec<Sample> = (0..240).map(|i| at(i % 6, 0, [near(i), near(i / 6)])).collect();
    for scheme in [Scheme::catmull_clark(), Scheme::doo_sabin()] {
        let surface = shape.surface(&scheme);
        let evaluate = |samples: &[Sample]| {
            let mut out = vec![0.0; samples.len() * WIDE * 3];
            let (context, first) = (Context::serial(), Derivatives::First);
            surface.evaluate(&context, samples, &values, WIDE, first, &mut out).unwrap();
            out
        };
        let together = evaluate(&samples);
        let twice = evaluate(&[&samples[..], &samples[..]].concat());
        for (i, sample) in samples.iter().enumerate() {
            let alone = evaluate(&[*sample]);
            for all in [&together, &twice[..together.len()], &twice[together.len()..]] {
                let found = &all[i * WIDE * 3..][..WIDE * 3];
                assert!(found.iter().zip(&alone).all(|(a, b)| a.to_bits() == b.to_bits()));
            }
        }
    }
}
