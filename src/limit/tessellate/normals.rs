//! Positions and normals of points of the surface.

use super::Tessellation;
use crate::base::{Context, ErrorKind, Result, memory};
use crate::limit::surface::{Derivatives, Sample, Surface};
use glam::DVec3;

/// Samples whose derivatives are asked for together.
const SHARE: usize = 256;
/// Steps towards the inside of a face where derivatives do not exist or say nothing.
const STEPS: [f64; 3] =
    [1.0 / (1_u64 << 30) as f64, 1.0 / (1_u64 << 20) as f64, 1.0 / (1_u64 << 10) as f64];
/// The sine of an angle between tangents that is rounding.
const PARALLEL: f64 = 1e-10;
/// Normals of a point that are one if their cosine is as much.
const ALIKE: f64 = 1.0 - 5e-7;

/// A position and the normal there, zero where there is none.
pub(super) type Place = [[f64; 3]; 2];

/// Those of samples.
///
/// # Errors
/// As [`Surface::evaluate`] for positions.
pub(super) fn evaluate(
    context: &Context,
    surface: &Surface,
    samples: &[Sample],
    positions: &[f64],
) -> Result<Vec<Place>> {
    let mut places = memory::filled([[0.0; 3]; 2], samples.len())?;
    let of = Evaluator { context: Context::serial(), surface, positions };
    let shares = memory::collect(samples.chunks(SHARE).zip(places.chunks_mut(SHARE)))?;
    for result in context.map(shares, |(samples, places)| of.share(samples, places))? {
        result?;
    }
    Ok(places)
}

struct Evaluator<'a> {
    context: Context,
    surface: &'a Surface,
    positions: &'a [f64],
}

impl Evaluator<'_> {
    /// Position and first derivatives of samples.
    fn records(&self, samples: &[Sample], derivatives: Derivatives) -> Result<Vec<f64>> {
        let mut out = memory::filled(0.0, 3 * derivatives.records() * samples.len())?;
        self.surface.evaluate(&self.context, samples, self.positions, 3, derivatives, &mut out)?;
        Ok(out)
    }

    fn share(&self, samples: &[Sample], places: &mut [Place]) -> Result<()> {
        match self.records(samples, Derivatives::First) {
            Ok(records) => {
                for ((place, record), sample) in
                    places.iter_mut().zip(records.as_chunks::<9>().0).zip(samples)
                {
                    let [x, y, z, ..] = *record;
                    let normal = normal(record).map_or_else(|| self.beside(sample), Ok)?;
                    *place = [[x, y, z], normal];
                }
                Ok(())
            }
            // At least one has no derivatives, or none that fit.
            Err(error) if matches!(error.kind(), ErrorKind::Unsupported | ErrorKind::NotFinite) => {
                let mut each = samples.iter().zip(places);
                each.try_for_each(|(sample, place)| self.one(sample, place))
            }
            Err(error) => Err(error),
        }
    }

    fn one(&self, sample: &Sample, place: &mut Place) -> Result<()> {
        let position = self.records(&[*sample], Derivatives::None)?;
        place[0].copy_from_slice(&position);
        place[1] = match self.normal_at(sample)? {
            Some(normal) => normal,
            None => self.beside(sample)?,
        };
        Ok(())
    }

    /// The normal at a sample, if there is one.
    fn normal_at(&self, sample: &Sample) -> Result<Option<[f64; 3]>> {
        match self.records(&[*sample], Derivatives::First) {
            Ok(record) => Ok(record.first_chunk().and_then(normal)),
            Err(error) if matches!(error.kind(), ErrorKind::Unsupported | ErrorKind::NotFinite) => {
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// The normal beside a sample, or zero.
    fn beside(&self, sample: &Sample) -> Result<[f64; 3]> {
        let middle = if self.surface.is_triangle(sample.face as usize) { 1.0 / 3.0 } else { 0.5 };
        for step in STEPS {
            let towards = |x: f64| x + step * (middle - x);
            let moved = Sample { u: towards(sample.u), v: towards(sample.v), ..*sample };
            if let Some(normal) = self.normal_at(&moved)? {
                return Ok(normal);
            }
        }
        Ok([0.0; 3])
    }
}

/// The unit normal of a position with two derivatives.
fn normal(record: &[f64; 9]) -> Option<[f64; 3]> {
    let [u, v] = [3, 6].map(|k| DVec3::new(record[k], record[k + 1], record[k + 2]));
    let [u, v] = [scaled(u)?, scaled(v)?];
    let cross = u.cross(v);
    (cross.length() > PARALLEL).then(|| scaled(cross)).flatten().map(|n| n.to_array())
}

/// A vector of length 1, whatever its length was.
fn scaled(vector: DVec3) -> Option<DVec3> {
    let most = vector.abs().max_element();
    if most == 0.0 || !most.is_finite() {
        return None;
    }
    let small = vector / most;
    Some(small / small.length())
}

fn is_zero(normal: &[f64; 3]) -> bool {
    normal.iter().all(|&x| x == 0.0)
}

/// Gives points one normal where those of their faces hardly differ, and those without any that
/// of their triangles.
pub(super) fn settle(of: &mut Tessellation) -> Result<()> {
    if of.normals.iter().any(is_zero) {
        let mut sums = memory::filled(DVec3::ZERO, of.normals.len())?;
        for (triangle, places) in of.triangles.iter().zip(&of.triangle_places) {
            let [a, b, c] = triangle.map(|v| DVec3::from(of.positions[v as usize]));
            let area = (b - a).cross(c - a);
            for &place in places {
                sums[place as usize] += area;
            }
        }
        for (normal, sum) in of.normals.iter_mut().zip(sums) {
            if is_zero(normal) {
                *normal = scaled(sum).unwrap_or_default().to_array();
            }
        }
    }
    let mut first = memory::filled([0.0; 3], of.positions.len())?;
    let mut known = 0;
    for (&v, normal) in of.place_vertices.iter().zip(&mut of.normals) {
        // Vertices are numbered by their first places.
        if v as usize == known {
            first[known] = *normal;
            known += 1;
        } else if DVec3::from(first[v as usize]).dot(DVec3::from(*normal)) > ALIKE {
            *normal = first[v as usize];
        }
    }
    Ok(())
}
