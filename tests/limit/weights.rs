//! Weights of samples, and what evaluation promises of them.

use super::{Shape, WIDTH, assert_near, at, bases, closed_meshes, quad_schemes};
use carvel::limit::{Derivatives, Sample, Surface};
use carvel::{Context, ErrorKind, Scheme};

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

/// Records of three numbers, evaluated all together and each alone.
fn check_threes(shape: &Shape, surface: &Surface, samples: &[Sample], what: &str) {
    let context = Context::serial();
    let threes: Vec<f64> =
        shape.values.chunks(WIDTH).flat_map(|value| &value[..3]).copied().collect();
    for derivatives in [Derivatives::None, Derivatives::First, Derivatives::Second] {
        let records = derivatives.records();
        let evaluate = |samples: &[Sample]| {
            let mut out = vec![f64::NAN; 3 * records * samples.len()];
            surface.evaluate(&context, samples, &threes, 3, derivatives, &mut out).unwrap();
            out
        };
        let together = evaluate(samples);
        for (sample, found) in samples.iter().zip(together.chunks(3 * records)).rev() {
            let wide = shape.evaluate(surface, *sample, derivatives);
            let expected = wide.chunks(WIDTH).flat_map(|record| &record[..3]);
            let alone = evaluate(&[*sample]);
            let same = expected.zip(&alone).zip(found);
            for ((expected, alone), found) in same {
                assert_eq!(expected.to_bits(), found.to_bits(), "{what}, {sample:?}");
                assert_eq!(alone.to_bits(), found.to_bits(), "{what}, {sample:?} alone");
            }
        }
    }
}

/// Records of three numbers have a way of their own in regular patches, and samples between two
/// parts of a cell may not decide in which of them those after it are.
#[test]
fn three_numbers_are_the_first_of_wider_records() {
    let shapes = [
        Shape::new(&bases::cube()),
        Shape::new(&bases::prism(5)),
        Shape::new(&bases::torus(5, 4)),
        Shape::creased(&bases::cube()),
        Shape::new(&bases::grid(3, 3)),
    ];
    for (number, shape) in shapes.iter().enumerate() {
        let surface = shape.surface(&Scheme::catmull_clark());
        // Places on the lines between parts, too.
        let on_lines = (0..600).map(|i| (i % shape.mesh.faces(), [1 + i % 15, 1 + (i / 7) % 15]));
        let mut samples: Vec<Sample> =
            on_lines.map(|(face, at16)| at(face, 0, at16.map(|x| x as f64 / 16.0))).collect();
        samples.extend(many(shape.mesh.faces()));
        check_threes(shape, &surface, &samples, &format!("shape {number}"));
    }
}

#[test]
fn so_they_are_on_triangles() {
    let shapes = [bases::octahedron(), bases::tetrahedron(), bases::triangle_grid(3, 3)];
    for (number, of) in shapes.iter().enumerate() {
        let shape = Shape::new(of);
        let surface = shape.surface(&Scheme::loop_triangles());
        let place = |i: usize| [1 + i % 15, 1 + (i / 7) % 15];
        let inside = |i: &usize| place(*i).iter().sum::<usize>() <= 16;
        let samples: Vec<Sample> = (0..600)
            .filter(inside)
            .map(|i| at(i % shape.mesh.faces(), 0, place(i).map(|x| x as f64 / 16.0)))
            .collect();
        check_threes(&shape, &surface, &samples, &format!("triangles {number}"));
    }
}

/// Samples go in groups, which begin before the first of them ends.
#[test]
fn of_two_that_fail_in_a_group_the_first_is_named() {
    let shape = Shape::new(&bases::cube());
    let surface = shape.surface(&Scheme::catmull_clark());
    let values: Vec<f64> = (0..24).map(f64::from).collect();
    let mut samples = vec![at(0, 0, [0.3, 0.4]); 40];
    samples[39] = at(6, 0, [0.5, 0.5]);
    samples[37] = at(2, 0, [0.0, 0.0]);
    let named = |samples: &[Sample]| {
        let mut out = vec![0.0; 9 * samples.len()];
        let (context, first) = (Context::serial(), Derivatives::First);
        let done = surface.evaluate(&context, samples, &values, 3, first, &mut out);
        let error = done.unwrap_err();
        (error.kind(), error.to_string())
    };
    assert_eq!(named(&samples).0, ErrorKind::Unsupported);
    assert!(named(&samples).1.contains("face 2"), "{}", named(&samples).1);
    samples.swap(37, 38);
    samples.swap(39, 36);
    assert_eq!(named(&samples).0, ErrorKind::ParameterOutOfRange);
    assert!(named(&samples).1.contains("face 6"), "{}", named(&samples).1);
}
