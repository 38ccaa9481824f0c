//! The caller's buffers, and the bare writing of them.

use carvel::{Output, Prediction};
use std::cell::RefCell;
use std::hint::black_box;

use crate::sides::{Given, Side};

/// Arrays of the size that a result has.
pub struct Buffers {
    faces: bool,
    sizes: Vec<u32>,
    indices: Vec<u32>,
    /// xyz.
    pub positions: Vec<f32>,
}

impl Buffers {
    /// For a whole mesh or for positions alone; nothing is allocated yet.
    pub fn new(faces: bool) -> RefCell<Self> {
        RefCell::new(Self { faces, sizes: vec![], indices: vec![], positions: vec![] })
    }

    /// Arrays for a result, if there are none yet.
    pub fn allocate(&mut self, given: &Given) -> Result<(), String> {
        if !self.positions.is_empty() {
            return Ok(());
        }
        let plan = Prediction::new(&given.mesh, &given.scheme, given.level);
        let last = *plan.map_err(|e| e.to_string())?.last();
        self.positions = vec![0.0; 3 * last.vertices as usize];
        if self.faces {
            self.sizes = vec![0; last.faces as usize];
            self.indices = vec![0; last.corners as usize];
        }
        Ok(())
    }

    /// The arrays as carvel takes them.
    pub fn output(&mut self) -> Output<'_, f32> {
        let mut output = Output::new(&mut self.positions);
        if self.faces {
            output.face_sizes = Some(&mut self.sizes);
            output.face_vertices = Some(&mut self.indices);
        }
        output
    }
}

/// As many bytes written into the same buffers: below it no refinement can be.
pub struct BareWrite<'a>(pub &'a RefCell<Buffers>);

impl Side for BareWrite<'_> {
    fn call(&mut self) -> Result<(), String> {
        let mut buffers = self.0.borrow_mut();
        let Buffers { sizes, indices, positions, .. } = &mut *buffers;
        sizes.fill(black_box(4));
        indices.fill(black_box(7));
        positions.fill(black_box(1.0));
        black_box((sizes, indices, positions));
        Ok(())
    }
}
