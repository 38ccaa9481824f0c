//! Which faces are alike.
//!
//! What a quad or triangle split makes inside a face whose vertices are interior and smooth
//! depends on the faces that touch it: their sides, and how many there are at each vertex.
//! Faces for which these are the same are of one *kind*; of one *sort*, if they lead the same
//! edges too.

use super::stencil_block::{Block, Led};
use super::stencil_ring::{MOST_VERTICES, Ring, Walker};
use super::stencil_runs::Runs;
use crate::base::{Context, Error, ErrorKind, NONE, Result, memory};
use crate::mesh::Mesh;
use crate::refine::Pieces;
use crate::scheme::Scheme;
use std::collections::HashMap;
use std::hash::Hash;
use std::ops::Range;

/// Faces between two looks at whether to go on.
const CANCEL_EVERY: u32 = 1 << 12;

/// The sorts of all faces of a mesh.
pub(super) struct Sorts {
    /// For every face its sort, `NONE` if it is not to be told what happens inside.
    faces: Vec<u32>,
    /// The rings of the faces that have a sort, and where each begins and the last one ends.
    rings: Vec<u32>,
    starts: Vec<u32>,
    /// A kind and a selection.
    list: Vec<(u32, u32)>,
    /// A face of every kind.
    kinds: Vec<u32>,
    /// The slots of a sort, for each number of sides and those of them that lead.
    selections: Vec<Led>,
}

impl Sorts {
    pub(super) fn new(
        context: &Context,
        mesh: &Mesh,
        scheme: &Scheme,
        runs: &Runs,
        depth: u32,
    ) -> Result<Self> {
        let mut walker = Walker::new(mesh, scheme.ruled_vertices(mesh))?;
        let mut known = Known::new(scheme.pieces(), depth);
        let mut ring = Ring::default();
        let mut sorts = Self {
            faces: memory::reserved(mesh.faces())?,
            rings: Vec::new(),
            starts: memory::reserved(mesh.faces() + 1)?,
            list: Vec::new(),
            kinds: Vec::new(),
            selections: Vec::new(),
        };
        sorts.starts.push(0);
        for face in 0..mesh.layout.faces() {
            if face.is_multiple_of(CANCEL_EVERY) {
                context.check_cancelled()?;
            }
            // Places are counted in 32 bits; faces beyond go without a sort.
            let room = sorts.rings.len() < NONE as usize - MOST_VERTICES;
            let sort = if room && walker.walk(face, &mut ring) {
                memory::grow(&mut sorts.rings, ring.vertices.len())?;
                sorts.rings.extend_from_slice(&ring.vertices);
                sorts.sort(&mut known, face, &ring.signature, runs.leads(face))?
            } else {
                NONE
            };
            sorts.faces.push(sort);
            sorts.starts.push(sorts.rings.len() as u32);
        }
        Ok(sorts)
    }

    fn sort(&mut self, known: &mut Known, face: u32, signature: &[u32], leads: u32) -> Result<u32> {
        if known.signature != signature {
            known.signature = memory::copied(signature)?;
            known.recent = [None; 16];
            let new = self.kinds.len() as u32;
            known.kind = number(&mut known.kinds, known.signature.as_slice(), new)?;
            if known.kind == new {
                memory::extend(&mut self.kinds, [face])?;
            }
        }
        if let Some(&Some(sort)) = known.recent.get(leads as usize) {
            return Ok(sort);
        }
        let new = self.list.len() as u32;
        let sort = number(&mut known.sorts, &[known.kind, leads][..], new)?;
        if sort == new {
            let selection = self.selection(known, signature[0], leads)?;
            memory::extend(&mut self.list, [(known.kind, selection)])?;
        }
        if let Some(recent) = known.recent.get_mut(leads as usize) {
            *recent = Some(sort);
        }
        Ok(sort)
    }

    fn selection(&mut self, known: &mut Known, sides: u32, leads: u32) -> Result<u32> {
        let new = self.selections.len() as u32;
        let selection = number(&mut known.selections, &[sides, leads][..], new)?;
        if selection == new {
            let led = known.block(sides)?.led(leads)?;
            memory::extend(&mut self.selections, [led])?;
        }
        Ok(selection)
    }

    /// The sort of a face.
    #[inline]
    pub(super) fn of(&self, face: u32) -> Option<usize> {
        let sort = self.faces[face as usize];
        (sort != NONE).then_some(sort as usize)
    }

    /// The number of sorts.
    pub(super) fn len(&self) -> usize {
        self.list.len()
    }

    /// Every kind with a sort that is wanted: a face of it, and where its sorts stand in the
    /// list that comes along.
    pub(super) fn kinds(&self, wanted: &[bool]) -> Result<(Vec<OfKind>, Vec<u32>)> {
        let numbers = (0..self.list.len() as u32).filter(|&sort| wanted[sort as usize]);
        let mut sorts = memory::collect(numbers)?;
        let kind = |sort: u32| self.list[sort as usize].0;
        sorts.sort_unstable_by_key(|&sort| (kind(sort), sort));
        let mut kinds = Vec::new();
        let mut first = 0;
        for alike in sorts.chunk_by(|&a, &b| kind(a) == kind(b)) {
            let face = self.kinds[kind(alike[0]) as usize];
            memory::extend(&mut kinds, [(face, first..first + alike.len())])?;
            first += alike.len();
        }
        Ok((kinds, sorts))
    }

    /// The slots of a sort.
    #[inline]
    pub(super) fn slots(&self, sort: usize) -> &Led {
        &self.selections[self.list[sort].1 as usize]
    }

    /// The ring of a face that has a sort.
    #[inline]
    pub(super) fn ring(&self, face: u32) -> &[u32] {
        let [start, end] = [face, face + 1].map(|at| self.starts[at as usize] as usize);
        &self.rings[start..end]
    }
}

/// A face of a kind, and the range of its sorts.
pub(super) type OfKind = (u32, Range<usize>);

/// A list's number among others.
type Numbers = HashMap<Vec<u32>, u32>;

/// What was met before.
struct Known {
    kinds: Numbers,
    /// By number of sides and those that lead.
    selections: Numbers,
    /// By kind and the sides that lead.
    sorts: Numbers,
    /// The signature and the kind of the last face; its sorts by leading sides, of four.
    signature: Vec<u32>,
    kind: u32,
    recent: [Option<u32>; 16],
    pieces: Pieces,
    depth: u32,
    blocks: Vec<(u32, Block)>,
}

impl Known {
    fn new(pieces: Pieces, depth: u32) -> Self {
        Self {
            kinds: Numbers::new(),
            selections: Numbers::new(),
            sorts: Numbers::new(),
            signature: Vec::new(),
            kind: NONE,
            recent: [None; 16],
            pieces,
            depth,
            blocks: Vec::new(),
        }
    }

    fn block(&mut self, sides: u32) -> Result<&Block> {
        let known = self.blocks.iter().position(|block| block.0 == sides);
        let place = known.unwrap_or(self.blocks.len());
        if known.is_none() {
            let block = Block::new(self.pieces, sides, self.depth)?;
            memory::extend(&mut self.blocks, [(sides, block)])?;
        }
        Ok(&self.blocks[place].1)
    }
}

/// The number of a list: `new`, if it was not met before.
fn number(known: &mut Numbers, list: &[u32], new: u32) -> Result<u32> {
    match known.get(list) {
        Some(&number) => Ok(number),
        None => remember(known, memory::copied(list)?, new),
    }
}

/// Puts a value down.
pub(super) fn remember<K: Hash + Eq, V: Copy>(
    known: &mut HashMap<K, V>,
    key: K,
    value: V,
) -> Result<V> {
    make_room(known)?;
    known.insert(key, value);
    Ok(value)
}

/// Makes room for another value.
pub(super) fn make_room<K: Hash + Eq, V>(known: &mut HashMap<K, V>) -> Result<()> {
    let refused = |_| Error::new(ErrorKind::OutOfResources, "no memory for another kind of face");
    known.try_reserve(1).map_err(refused)
}
