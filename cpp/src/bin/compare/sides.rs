//! The sides as what is timed: one ordinary public call each.

use carvel::mesh::Mesh;
use carvel::{Context, Refined, Refiner, Task};
use carvel_peers::heap;
use std::cell::RefCell;

use crate::buffers::Buffers;

/// Something that can be called again and again.
pub trait Side {
    /// Brings everything back to before the call; not timed.
    fn prepare(&mut self) -> Result<(), String> {
        Ok(())
    }
    /// The call; what it computes is in memory when it returns.
    fn call(&mut self) -> Result<(), String>;
    /// Frees the result; not timed.
    fn clear(&mut self) {}
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

    /// carvel's answer, which is compared before anything is timed.
    pub fn answer(&self, context: &Context) -> Result<Refined<f32>, String> {
        Refiner::new().refine(context, &self.task()).map_err(|e| e.to_string())
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
    context: &'a Context,
    refiner: Refiner<f32>,
    buffers: &'a RefCell<Buffers>,
}

impl<'a> ReUsed<'a> {
    /// Buffers are allocated by the first call.
    pub fn new(given: &'a Given, context: &'a Context, buffers: &'a RefCell<Buffers>) -> Self {
        Self { given, context, refiner: Refiner::new(), buffers }
    }
}

impl Side for ReUsed<'_> {
    fn call(&mut self) -> Result<(), String> {
        let mut buffers = self.buffers.borrow_mut();
        buffers.allocate(self.given)?;
        self.refiner
            .refine_into(self.context, &self.given.task(), buffers.output())
            .map_err(|e| e.to_string())
    }
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
