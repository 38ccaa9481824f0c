//! Several corner splits at once, tile by tile.
//!
//! Each quad of a closed mesh that a corner split has made becomes a tile (`tile_tables`), so
//! that no mesh in between exists: the numbers of a tile's vertices follow from one
//! number, those at its border from the tiles around it, which the parent's twins name.
//! The numbering is that of one split after the other (`corner_split`): faces that are no
//! quads; the quads around them, the latest first; the tiles.

use super::counts::Counts;
use super::patch_grid::Place;
use super::tile_tables::{
    Foreign, PlaceNumbers, SectorVertex, TILE_KINDS, TileKind, TileTables, seen_from_next,
    seen_from_previous,
};
use crate::base::{Context, Error, ErrorKind, Result, memory};
use crate::mesh::Mesh;
use std::ops::Range;

/// Some corner splits of a mesh, planned together.
#[derive(Debug)]
pub(crate) struct Tiles<'a> {
    parent: &'a Mesh,
    /// What each quad leads.
    near: &'a [u8],
    pub(crate) counts: Counts,
    tables: TileTables,
    /// The first vertex of each tile.
    vertices: Vec<u32>,
    chunks: Vec<TileChunk>,
    /// Corners of faces that are no quads: the sectors.
    sectors: u32,
}

/// A run of tiles with their last faces and the vertices that belong to them.
#[derive(Debug, Clone)]
pub(crate) struct TileChunk {
    pub(crate) tiles: Range<usize>,
    faces: usize,
    pub(crate) vertices: usize,
}

/// Some sectors, and for each run what belongs to them.
pub(crate) type SectorRuns<'o, V> = (Range<u32>, Vec<&'o mut [V]>);

impl<'a> Tiles<'a> {
    /// True if a mesh of these counts, split once, can be refined this way: closed, and every
    /// vertex isolated or of valence 4, so that afterwards quads surround all other faces.
    pub(crate) fn fit(before: &Counts) -> bool {
        before.boundary_edges == 0 && before.has_regular_vertices()
    }

    /// Plans `depth` splits of the split of a mesh that fits.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] if the children do not fit the index type.
    pub(crate) fn new(context: &Context, parent: &'a Mesh, depth: u32) -> Result<Self> {
        let near = parent.near.as_ref().map_or(&[][..], |near| &near.quads);
        debug_assert!(parent.rim.is_empty() && parent.joints.is_empty());
        debug_assert_eq!(
            4 * near.len() + parent.layout.irregular_corners() as usize,
            parent.corners()
        );
        let mut counts = Counts::of(parent);
        for _ in 0..depth {
            counts = counts
                .plain()
                .ok_or_else(|| Error::new(ErrorKind::TooLarge, "the split exceeds 64-bit sizes"))?;
            counts.check_index_type()?;
        }
        let tables = TileTables::new(depth)?;
        let sectors = parent.layout.irregular_corners();
        let mut tiles = Self {
            parent,
            near,
            counts,
            tables,
            vertices: memory::reserved(near.len())?,
            chunks: Vec::new(),
            sectors,
        };
        let mut vertex = tiles.first_of_tiles(depth - 1);
        let [faces, own] = [depth, depth - 1].map(|level| TILE_KINDS.map(|kind| kind.faces(level)));
        let len = (context.chunk_len(counts.faces as usize) >> (2 * depth)).max(1);
        for (chunk, near) in near.chunks(len).enumerate() {
            let mut it =
                TileChunk { tiles: chunk * len..chunk * len + near.len(), faces: 0, vertices: 0 };
            let before = vertex;
            for &near in near {
                let kind = TileKind::of(near) as usize;
                tiles.vertices.push(vertex);
                vertex += 4 * own[kind];
                it.faces += faces[kind] as usize;
            }
            it.vertices = (vertex - before) as usize;
            memory::extend(&mut tiles.chunks, [it])?;
        }
        context.check_cancelled()?;
        Ok(tiles)
    }

    pub(crate) fn parent(&self) -> &'a Mesh {
        self.parent
    }

    pub(crate) fn depth(&self) -> u32 {
        self.tables.depth
    }

    pub(crate) fn tables(&self) -> &TileTables {
        &self.tables
    }

    /// The runs of tiles that are done together.
    pub(crate) fn chunks(&self) -> &[TileChunk] {
        &self.chunks
    }

    /// What a tile stands for.
    #[inline(always)]
    pub(crate) fn kind(&self, tile: usize) -> TileKind {
        TileKind::of(self.near[tile])
    }

    /// The first corner of a tile's quad.
    #[inline(always)]
    pub(crate) fn corner(&self, tile: usize) -> u32 {
        self.sectors + 4 * tile as u32
    }

    /// Corners of faces that are no quads.
    pub(crate) fn sectors(&self) -> u32 {
        self.sectors
    }

    /// Quads that a split adds at one sector, after some more splits.
    fn quads_each(level: u32) -> u32 {
        TileKind::Vertex.faces(level) + TileKind::Edge.faces(level)
    }

    /// The first quad of those that the split `run` adds, among all quads of a level, and how many
    /// each sector has.
    fn run(&self, run: u32, level: u32) -> (u32, u32) {
        let later = (run + 1..level).map(|run| Self::quads_each(level - 1 - run)).sum::<u32>();
        (self.sectors * later, Self::quads_each(level - 1 - run))
    }

    /// The first vertex that a sector's quads of one run bring to the last level.
    pub(crate) fn sector_vertices(&self, sector: u32, run: u32) -> u32 {
        let (first, each) = self.run(run, self.depth() - 1);
        self.sectors + 4 * (first + sector * each)
    }

    /// The first vertex of the tiles at the end of so many splits.
    fn first_of_tiles(&self, level: u32) -> u32 {
        self.sectors + 4 * self.quads_around(level) as u32
    }

    /// The number of a vertex at the border of a sector.
    fn sector_vertex(&self, sector: u32, vertex: SectorVertex) -> u32 {
        let sector = if vertex.next { self.parent.next(sector) } else { sector };
        self.sector_vertices(sector, vertex.run) + vertex.at
    }

    /// The number of a vertex along the side of the tile at a corner.
    #[inline(always)]
    fn at_side(&self, corner: u32, at: u16) -> u32 {
        match corner.checked_sub(self.sectors) {
            Some(local) => {
                let tile = local as usize / 4;
                let table = self.tables.tile(self.kind(tile));
                self.vertices[tile] + table.sides[local as usize % 4][at as usize % 32]
            }
            None => self.sector_vertex(corner, self.tables.sector.side[at as usize]),
        }
    }

    /// The number of the vertex of a tile at a corner.
    fn at_corner(&self, corner: u32) -> u32 {
        match corner.checked_sub(self.sectors) {
            Some(local) => {
                let tile = local as usize / 4;
                let table = self.tables.tile(self.kind(tile));
                self.vertices[tile] + table.corners[local as usize % 4]
            }
            None => self.sector_vertex(corner, self.tables.sector.corner),
        }
    }

    /// Writes the size of every last face.
    pub(crate) fn write_sizes(&self, out: &mut [u32]) {
        let layout = &self.parent.layout;
        let (irregular, quads) = out.split_at_mut(layout.irregular_faces() as usize);
        for (size, face) in irregular.iter_mut().zip(0..) {
            *size = layout.face(face).len() as u32;
        }
        quads.fill(4);
    }

    /// Writes the vertices of all last faces.
    pub(crate) fn write_faces(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let (irregular, quads) = out.split_at_mut(self.sectors as usize);
        for (slot, corner) in irregular.iter_mut().zip(0..) {
            *slot = corner;
        }
        let quads = quads.as_chunks_mut::<4>().0;
        let (around, mut rest) = quads.split_at_mut(self.quads_around(self.depth()));
        self.write_sectors(context, around)?;
        let mut parts = memory::reserved(self.chunks.len())?;
        for chunk in &self.chunks {
            let (part, later) = rest.split_at_mut(chunk.faces);
            parts.push((chunk.tiles.clone(), part));
            rest = later;
        }
        context.for_each(parts, |(tiles, mut out)| {
            for tile in tiles {
                let table = self.tables.tile(self.kind(tile));
                let (faces, later) = out.split_at_mut(table.faces.len());
                self.write_tile(tile, faces);
                out = later;
            }
        })
    }

    /// The faces of one tile: its own vertices by their distance from the first, those of
    /// its neighbours one by one.
    #[inline(always)]
    fn write_tile(&self, tile: usize, out: &mut [[u32; 4]]) {
        let table = self.tables.tile(self.kind(tile));
        let first = self.vertices[tile];
        for (slot, face) in out.iter_mut().zip(&table.faces) {
            *slot = face.map(|vertex| first + vertex);
        }
        let out = out.as_flattened_mut();
        let corner = self.corner(tile);
        for (side, foreign) in (0..).zip(&table.across) {
            if !foreign.is_empty() {
                self.write_across(self.parent.twin[(corner + side) as usize], foreign, out);
            }
        }
        for (side, foreign) in (0..).zip(&table.beyond) {
            if !foreign.is_empty() {
                let number = self.at_corner(self.beyond(corner + side));
                for it in foreign {
                    out[it.slot as usize] = number;
                }
            }
        }
    }

    /// The vertices that belong to the tile at a twin.
    #[inline(always)]
    fn write_across(&self, twin: u32, foreign: &[Foreign], out: &mut [u32]) {
        let Some(local) = twin.checked_sub(self.sectors) else {
            for it in foreign {
                out[it.slot as usize] = self.at_side(twin, it.at);
            }
            return;
        };
        let tile = local as usize / 4;
        let side = &self.tables.tile(self.kind(tile)).sides[local as usize % 4];
        let first = self.vertices[tile];
        for it in foreign {
            out[it.slot as usize] = first + side[it.at as usize % 32];
        }
    }

    /// The corner opposite a corner around its vertex.
    #[inline(always)]
    pub(crate) fn beyond(&self, corner: u32) -> u32 {
        self.parent.ccw(self.parent.ccw(corner))
    }

    /// The number of quads around faces that are no quads after some splits.
    pub(crate) fn quads_around(&self, level: u32) -> usize {
        (self.sectors * (0..level).map(Self::quads_each).sum::<u32>()) as usize
    }

    /// Cuts an array of one entry for each of those quads: for some sectors what each run
    /// brings them, run 0 first.
    pub(crate) fn cut_sectors<'o, V>(
        &self,
        context: &Context,
        level: u32,
        quads: &'o mut [V],
    ) -> Result<Vec<SectorRuns<'o, V>>> {
        let each = (0..level).map(Self::quads_each).sum::<u32>() as usize;
        let chunk = context.chunk_len(quads.len()).div_ceil(each) as u32;
        let mut parts = Vec::new();
        for first in (0..self.sectors).step_by(chunk as usize) {
            let range = first..first.saturating_add(chunk).min(self.sectors);
            memory::extend(&mut parts, [(range, memory::reserved(level as usize)?)])?;
        }
        let mut rest = quads;
        // They lie the latest run first.
        for run in (0..level).rev() {
            let (_, each) = self.run(run, level);
            for (range, runs) in &mut parts {
                let (part, later) = rest.split_at_mut(range.len() * each as usize);
                runs.push(part);
                rest = later;
            }
        }
        for (_, runs) in &mut parts {
            runs.reverse();
        }
        Ok(parts)
    }

    /// The quads around all faces that are no quads.
    fn write_sectors(&self, context: &Context, out: &mut [[u32; 4]]) -> Result<()> {
        let parts = self.cut_sectors(context, self.depth(), out)?;
        let done = context.map(parts, |(range, mut runs)| {
            let mut numbers = SectorNumbers::new(self)?;
            for sector in range {
                numbers.fill(sector);
                for (out, faces) in runs.iter_mut().zip(&self.tables.sector.faces) {
                    let (mine, later) = std::mem::take(out).split_at_mut(faces.len());
                    for (slot, face) in mine.iter_mut().zip(faces) {
                        *slot = face.map(|place| numbers.by_place.get(place).unwrap_or(0));
                    }
                    *out = later;
                }
            }
            Ok(())
        })?;
        done.into_iter().collect()
    }

    /// Calls `each` with every last face's place and the face that it comes from.
    pub(crate) fn each_face_source(&self, mut each: impl FnMut(usize, u32)) {
        let layout = &self.parent.layout;
        let irregular = layout.irregular_faces();
        let mut place = 0;
        let mut push = |face: u32, count: u32| {
            (0..count as usize).for_each(|i| each(place + i, face));
            place += count as usize;
        };
        (0..irregular).for_each(|face| push(face, 1));
        for run in (0..self.depth()).rev() {
            let (_, count) = self.run(run, self.depth());
            (0..self.sectors).for_each(|c| push(layout.face_of(c), count));
        }
        for tile in 0..self.vertices.len() {
            push(irregular + tile as u32, self.kind(tile).faces(self.depth()));
        }
    }
}

/// What a sector beside another one sees at a place.
type Turn = fn(Place, u32) -> Place;

/// The numbers of the vertices around one sector.
struct SectorNumbers<'t> {
    tiles: &'t Tiles<'t>,
    by_place: PlaceNumbers,
}

impl<'t> SectorNumbers<'t> {
    fn new(tiles: &'t Tiles<'t>) -> Result<Self> {
        Ok(Self { tiles, by_place: PlaceNumbers::new()? })
    }

    /// What belongs to the sector and to those beside it, and what lies across their sides.
    fn fill(&mut self, sector: u32) {
        let (tiles, depth) = (self.tiles, self.tiles.depth());
        let table = &tiles.tables.sector;
        let mesh = tiles.parent;
        let (next, previous) = (mesh.next(sector), mesh.prev(sector));
        let turned: [(u32, Turn); 3] =
            [(sector, |place, _| place), (next, seen_from_previous), (previous, seen_from_next)];
        for (corner, seen) in turned {
            let centre = table.centres[depth as usize][0];
            self.by_place.set(seen(centre, depth), corner);
            for (run, faces) in (0..).zip(&table.vertices) {
                let first = tiles.sector_vertices(corner, run);
                for (number, &place) in (first..).zip(faces.as_flattened()) {
                    self.by_place.set(seen(place, depth), number);
                }
            }
        }
        for (side, corner) in [(0, sector), (1, next), (3, previous)] {
            let twin = mesh.twin[corner as usize];
            for &(at, place) in &table.across[side] {
                self.by_place.set(place, tiles.at_side(twin, at));
            }
        }
        for (place, corner) in table.beyond.into_iter().flatten().zip([sector, next]) {
            self.by_place.set(place, tiles.at_corner(tiles.beyond(corner)));
        }
    }
}
