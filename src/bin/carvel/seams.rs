//! Corner data that is vertex data in truth.
//!
//! OBJ gives texture coordinates and normals by corner. Where all corners of
//! every vertex agree they refine like positions; at a seam they do not, since
//! the new faces along it would have to lie on both sides.

use carvel::base::NONE;

/// The data of one kind, by corner.
#[derive(Debug, Clone, Copy)]
pub struct ByCorner<'a, const N: usize> {
    /// The number of vertices.
    pub vertices: usize,
    /// The vertex of every corner.
    pub corners: &'a [u32],
    /// The record of every corner, if any has one.
    pub indices: Option<&'a [u32]>,
    /// The records.
    pub records: &'a [[f64; N]],
}

impl<const N: usize> ByCorner<'_, N> {
    /// One record per vertex (zero where no face is), or why there is no such.
    pub fn by_vertex(&self) -> Result<Vec<[f64; N]>, String> {
        let Some(indices) = self.indices else {
            return Err("no face uses them".to_owned());
        };
        if indices == self.corners && self.records.len() == self.vertices {
            return Ok(self.records.to_vec());
        }
        let missing = indices.iter().filter(|&&i| i == NONE).count();
        if missing > 0 {
            return Err(format!("{missing} of {} corners have none", indices.len()));
        }
        let (first, seams) = self.first_records(indices);
        if seams > 0 {
            return Err(format!("seams at {seams} of {} vertices", self.vertices));
        }
        Ok(first.into_iter().map(|i| self.record(i).copied().unwrap_or([0.0; N])).collect())
    }

    /// The first record of every vertex, and at how many others differ from it.
    fn first_records(&self, indices: &[u32]) -> (Vec<u32>, usize) {
        let mut first = vec![NONE; self.vertices];
        let mut seam = vec![false; self.vertices];
        for (&vertex, &index) in self.corners.iter().zip(indices) {
            let slot = &mut first[vertex as usize];
            if *slot == NONE {
                *slot = index;
            } else if *slot != index && self.record(*slot) != self.record(index) {
                seam[vertex as usize] = true;
            }
        }
        (first, seam.into_iter().filter(|&s| s).count())
    }

    fn record(&self, index: u32) -> Option<&[f64; N]> {
        self.records.get(index as usize)
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // what is exact is compared exactly
mod tests {
    use super::*;

    fn two_triangles<'a>(indices: Option<&'a [u32]>, records: &'a [[f64; 1]]) -> ByCorner<'a, 1> {
        ByCorner { vertices: 5, corners: &[0, 1, 2, 2, 1, 3], indices, records }
    }

    #[test]
    fn equal_records_make_no_seam() {
        let records = [[5.0], [6.0], [7.0], [7.0], [8.0]];
        let data = two_triangles(Some(&[0, 1, 2, 3, 1, 4]), &records);
        assert_eq!(data.by_vertex().unwrap(), [[5.0], [6.0], [7.0], [8.0], [0.0]]);
    }

    #[test]
    fn seams_and_gaps_are_told() {
        let records = [[5.0], [6.0], [7.0]];
        let seam = two_triangles(Some(&[0, 1, 2, 0, 1, 2]), &records).by_vertex();
        assert_eq!(seam.unwrap_err(), "seams at 1 of 5 vertices");
        let gap = two_triangles(Some(&[0, 1, NONE, 0, 1, 2]), &records).by_vertex();
        assert_eq!(gap.unwrap_err(), "1 of 6 corners have none");
        assert_eq!(two_triangles(None, &records).by_vertex().unwrap_err(), "no face uses them");
    }
}
