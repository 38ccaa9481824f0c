//! The two sides as what is timed: one ordinary public call each.

use carvel::mesh::Mesh;
use carvel::{Context, Output, Prediction, Refined, Refiner, Task};
use carvel_peers::heap;

/// Something that can be called again and again.
pub trait Side {
    /// Brings everything back to before the call; not timed.
    fn prepare(&mut self) -> Result<(), String>;
    /// The call; faces and positions are in memory when it returns.
    fn call(&mut self) -> Result<(), String>;
    /// Frees the result; not timed.
    fn clear(&mut self);
}

/// The control mesh, the scheme, the level.
pub struct Given {
    /// carvel's mesh.
    pub mesh: Mesh,
    /// carvel's scheme.
    pub scheme: carvel::Scheme,
    /// The level.
    pub level: u32,
    /// xyz.
    pub positions: Vec<f32>,
}

impl Given {
    fn task(&self) -> Task<'_, f32> {
        Task::new(&self.mesh, &self.scheme, self.level, &self.positions)
    }
}

/// carvel into arrays that the call makes, with a refiner of its own.
pub struct Fresh<'a> {
    given: &'a Given,
    result: Option<(Refiner<f32>, Refined<f32>)>,
}

impl<'a> Fresh<'a> {
    /// Nothing is allocated yet.
    pub fn new(given: &'a Given) -> Self {
        Self { given, result: None }
    }
}

impl Side for Fresh<'_> {
    fn prepare(&mut self) -> Result<(), String> {
        heap::trim();
        Ok(())
    }

    fn call(&mut self) -> Result<(), String> {
        let mut refiner = Refiner::new();
        let refined = refiner.refine(&Context::serial(), &self.given.task());
        // The refiner's scratch is freed with the result: freeing is timed for neither.
        self.result = Some((refiner, refined.map_err(|e| e.to_string())?));
        Ok(())
    }

    fn clear(&mut self) {
        self.result = None;
    }
}

/// carvel into the caller's buffers, with a refiner that is kept.
pub struct ReUsed<'a> {
    given: &'a Given,
    refiner: Refiner<f32>,
    sizes: Vec<u32>,
    indices: Vec<u32>,
    positions: Vec<f32>,
}

impl<'a> ReUsed<'a> {
    /// Buffers come with the first call.
    pub fn new(given: &'a Given) -> Self {
        let refiner = Refiner::new();
        Self { given, refiner, sizes: vec![], indices: vec![], positions: vec![] }
    }

    fn allocate(&mut self) -> Result<(), String> {
        let given = self.given;
        let plan = Prediction::new(&given.mesh, &given.scheme, given.level);
        let last = *plan.map_err(|e| e.to_string())?.last();
        self.sizes = vec![0; last.faces as usize];
        self.indices = vec![0; last.corners as usize];
        self.positions = vec![0.0; 3 * last.vertices as usize];
        Ok(())
    }
}

impl Side for ReUsed<'_> {
    fn prepare(&mut self) -> Result<(), String> {
        Ok(())
    }

    fn call(&mut self) -> Result<(), String> {
        if self.sizes.is_empty() {
            self.allocate()?;
        }
        let output = Output {
            face_sizes: Some(&mut self.sizes),
            face_vertices: Some(&mut self.indices),
            face_sources: None,
            positions: &mut self.positions,
            attributes: Vec::new(),
            channels: Vec::new(),
        };
        self.refiner
            .refine_into(&Context::serial(), &self.given.task(), output)
            .map_err(|e| e.to_string())
    }

    fn clear(&mut self) {}
}

/// A peer's ordinary call.
pub struct Theirs {
    /// The control mesh in the peer's memory.
    pub run: carvel_peers::Run,
    /// The level.
    pub level: u32,
    /// Give free memory back before each call.
    pub fresh: bool,
}

impl Side for Theirs {
    fn prepare(&mut self) -> Result<(), String> {
        self.run.prepare()?;
        if self.fresh {
            heap::trim();
        }
        Ok(())
    }

    fn call(&mut self) -> Result<(), String> {
        self.run.refine(self.level)
    }

    fn clear(&mut self) {
        self.run.clear();
    }
}
