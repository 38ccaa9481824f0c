//! Where the control points of a cell form a regular grid.
//!
//! Beyond a boundary, or an edge that is sharp for ever, the grid goes on by the odd extension
//! p₋ⱼ = 2p₀ − pⱼ, which is what the boundary rules of tensor-product schemes come to.

use crate::base::NONE;
use crate::mesh::{INFINITE, Mesh};
use crate::scheme::{Boundary, Method, Scheme};

/// The points of a cell: those of the vertices with coordinates in two ranges, row by row.
#[derive(Debug)]
pub(super) struct Grid {
    /// First and last coordinate along both axes, the corner's vertex being (0, 0).
    pub(super) extent: [[i32; 2]; 2],
    pub(super) vertices: Vec<u32>,
}

/// Looks for grids in a mesh.
pub(super) struct Finder<'a> {
    pub(super) scheme: &'a Scheme,
    pub(super) mesh: &'a Mesh,
    /// First and last coordinate of the points of a cell on either axis.
    pub(super) window: [i32; 2],
}

impl Finder<'_> {
    /// The points of the cell at a corner; nothing if they are not regular.
    pub(super) fn grid(&self, corner: u32) -> Option<Grid> {
        if !self.is_quad(corner) {
            return None;
        }
        let [lo, hi] = self.window;
        let reach = |next: fn(&Self, u32) -> Option<u32>, most: i32| {
            let mut at = corner;
            let further = |_: &i32| match next(self, at) {
                Some(next) => {
                    at = next;
                    true
                }
                None => false,
            };
            (0..most).take_while(further).count() as i32
        };
        // Faces beside that of the corner, each way.
        let faces = [
            [-reach(Self::left, -lo), reach(Self::right, hi - 1)],
            [-reach(Self::down, -lo), reach(Self::up, hi - 1)],
        ];
        let cells = self.cells(corner, faces)?;
        let extent = faces.map(|[first, last]| [first, last + 1]);
        let open = extent.map(|[first, last]| [first > lo, last < hi]);
        self.check_edges(&cells, faces, open)?;
        let vertices = self.vertices(&cells, faces);
        self.check_vertices(&vertices, extent, open)?;
        Some(Grid { extent, vertices })
    }

    fn is_quad(&self, corner: u32) -> bool {
        self.mesh.layout.face_around(corner).len() == 4
    }

    /// The corner across an edge that a grid does not end at.
    fn across(&self, corner: u32) -> Option<u32> {
        let twin = self.mesh.twin[corner as usize];
        let sharp = || {
            self.scheme.creases()
                && self.mesh.sharpness.edge(self.mesh.first_of_edge(corner)) >= INFINITE
        };
        (twin != NONE && !sharp()).then_some(twin)
    }

    // From the first corner of a cell to that of the one beside it.

    fn right(&self, corner: u32) -> Option<u32> {
        self.across(self.mesh.next(corner)).map(|twin| self.mesh.next(twin))
    }

    fn left(&self, corner: u32) -> Option<u32> {
        self.across(self.mesh.prev(corner)).map(|twin| self.mesh.prev(twin))
    }

    fn up(&self, corner: u32) -> Option<u32> {
        self.across(self.mesh.next(self.mesh.next(corner)))
    }

    fn down(&self, corner: u32) -> Option<u32> {
        self.across(corner).map(|twin| self.mesh.next(self.mesh.next(twin)))
    }

    /// The first corner of every cell, row by row.
    fn cells(&self, corner: u32, faces: [[i32; 2]; 2]) -> Option<Vec<u32>> {
        let go = |from: u32, steps: i32, [back, on]: [fn(&Self, u32) -> Option<u32>; 2]| {
            let next = if steps < 0 { back } else { on };
            (0..steps.abs()).try_fold(from, |at, _| next(self, at).filter(|&c| self.is_quad(c)))
        };
        let mut cells = Vec::new();
        for y in faces[1][0]..=faces[1][1] {
            for x in faces[0][0]..=faces[0][1] {
                let along = go(corner, x, [Self::left, Self::right])?;
                cells.push(go(along, y, [Self::down, Self::up])?);
            }
        }
        Some(cells)
    }

    /// Cells beside each other are so in the mesh; where the grid ends early, all of it does.
    fn check_edges(&self, cells: &[u32], faces: [[i32; 2]; 2], open: [[bool; 2]; 2]) -> Option<()> {
        let [width, height] = faces.map(|[first, last]| (last - first + 1) as usize);
        let at = |x: usize, y: usize| cells[y * width + x];
        let ends = |next: Option<u32>, open: bool| next.is_none() || !open;
        let row = |y: usize| {
            (1..width).all(|x| self.right(at(x - 1, y)) == Some(at(x, y)))
                && ends(self.left(at(0, y)), open[0][0])
                && ends(self.right(at(width - 1, y)), open[0][1])
        };
        let column = |x: usize| {
            (1..height).all(|y| self.up(at(x, y - 1)) == Some(at(x, y)))
                && ends(self.down(at(x, 0)), open[1][0])
                && ends(self.up(at(x, height - 1)), open[1][1])
        };
        ((0..height).all(row) && (0..width).all(column)).then_some(())
    }

    fn vertices(&self, cells: &[u32], faces: [[i32; 2]; 2]) -> Vec<u32> {
        let [width, height] = faces.map(|[first, last]| (last - first + 1) as usize);
        let mesh = self.mesh;
        let vertex = |x: usize, y: usize| {
            let corner = cells[y.min(height - 1) * width + x.min(width - 1)];
            let turned = match (x == width, y == height) {
                (false, false) => corner,
                (true, false) => mesh.next(corner),
                (true, true) => mesh.next(mesh.next(corner)),
                (false, true) => mesh.prev(corner),
            };
            mesh.vert[turned as usize]
        };
        (0..=height)
            .flat_map(|y| (0..=width).map(move |x| (x, y)))
            .map(|(x, y)| vertex(x, y))
            .collect()
    }

    /// Vertices whose own rule matters follow that of their place in the grid.
    fn check_vertices(
        &self,
        vertices: &[u32],
        extent: [[i32; 2]; 2],
        open: [[bool; 2]; 2],
    ) -> Option<()> {
        let [[x0, x1], [y0, y1]] = extent;
        let places = (y0..=y1).flat_map(|y| (x0..=x1).map(move |x| [x, y]));
        for (&v, place) in vertices.iter().zip(places) {
            let mut sides = 0;
            let mut outer = false;
            for (axis, at) in place.into_iter().enumerate() {
                for (end, &limit) in extent[axis].iter().enumerate() {
                    if at == limit {
                        sides += usize::from(open[axis][end]);
                        outer |= !open[axis][end];
                    }
                }
            }
            if !outer && !self.follows(v, sides) {
                return None;
            }
        }
        Some(())
    }

    /// True if a vertex on so many sides where the grid ends has the rule that goes with it.
    fn follows(&self, v: u32, sides: usize) -> bool {
        let (scheme, mesh) = (self.scheme, self.mesh);
        match scheme.method() {
            Method::Primal => true,
            Method::Dual => {
                let tagged = mesh.corner_tags.binary_search(&v).is_ok();
                match sides {
                    0 => true,
                    1 => scheme.boundary() != Boundary::None && !tagged,
                    _ => match scheme.boundary() {
                        Boundary::None => false,
                        Boundary::Edge => tagged,
                        Boundary::EdgeAndCorner => true,
                    },
                }
            }
            Method::CatmullClark | Method::Loop => {
                let sharpness = scheme.vertex_sharpness(mesh, v);
                let (mut sharp, mut passing) = (0, sharpness > 0.0 && sharpness < INFINITE);
                mesh.each_edge_at(v, |_, sharpness| {
                    sharp += usize::from(sharpness >= INFINITE);
                    passing |= sharpness > 0.0 && sharpness < INFINITE;
                });
                let is_corner = sharpness >= INFINITE || sharp > 2;
                !passing
                    && match sides {
                        0 => sharp == 0 && sharpness == 0.0,
                        1 => sharp == 2 && !is_corner,
                        _ => is_corner,
                    }
            }
        }
    }
}
