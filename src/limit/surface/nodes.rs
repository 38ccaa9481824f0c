//! What every cell's surface is: a regular patch, or child cells with the step to them.
//!
//! Around a feature steps repeat themselves: a cell has a child whose vicinity bears the same
//! name. So all surfaces of a mesh, however deep one looks, are a finite graph, which is made
//! once.

use super::box_spline;
use super::cell::Kind;
use super::grid::Finder;
use super::vicinity::Vicinity;
use crate::base::{Context, Error, ErrorKind, NONE, Result, memory};
use crate::hierarchy::Hierarchy;
use crate::mesh::Mesh;
use crate::refine::EdgeNumbers;
use crate::scheme::{Boundary, ComposedRows, Creasing, Method, Scheme};
use std::collections::HashMap;

/// The surface of a cell over its points.
#[derive(Debug)]
pub(super) enum Node {
    /// A tensor product: the points have coordinates in two ranges.
    Grid([[i32; 2]; 2]),
    /// The quartic box spline.
    Triangle,
    /// Child cells.
    Split { kind: Kind, children: Vec<Option<Child>> },
    /// A surface that is not evaluated.
    Refused(&'static str),
}

/// A child cell.
#[derive(Debug)]
pub(super) struct Child {
    pub(super) node: u32,
    /// Where the entries of each of its points begin, and where the last one's end.
    offsets: Vec<u32>,
    /// Points of the parent with weights.
    entries: Vec<(u32, f64)>,
}

impl Child {
    /// How many points it has.
    pub(super) fn count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// For each of its points those of the parent with weights.
    pub(super) fn rows(&self) -> impl Iterator<Item = &[(u32, f64)]> {
        let row = |range: &[u32]| &self.entries[range[0] as usize..range[1] as usize];
        self.offsets.windows(2).map(row)
    }
}

/// First and last coordinate, on either axis, of the points of a regular cell.
pub(super) fn window(scheme: &Scheme) -> [i32; 2] {
    let passes = scheme.passes().len() as i32;
    match scheme.method() {
        Method::Dual => [-1 - passes, 1 + passes],
        Method::Primal => [-passes, 1 + passes],
        Method::CatmullClark | Method::Loop => [-1, 2],
    }
}

/// Rings of faces around a cell that its surface depends on.
fn rings(scheme: &Scheme) -> u32 {
    let passes = scheme.passes().len() as u32;
    match scheme.method() {
        Method::Dual => 1 + passes,
        Method::Primal => passes,
        // The sharpness that Chaikin's rule leaves depends on the edges at both ends.
        Method::CatmullClark | Method::Loop => {
            1 + u32::from(scheme.creasing() == Creasing::Chaikin)
        }
    }
}

/// Makes the graph.
pub(super) struct Builder<'a> {
    scheme: &'a Scheme,
    /// The scheme for parts of a mesh, whose outermost edges are no boundary.
    inner: Scheme,
    known: HashMap<Vec<u32>, u32>,
    pub(super) nodes: Vec<Node>,
    /// Cells whose children are to be found.
    open: Vec<(u32, Vicinity)>,
}

impl<'a> Builder<'a> {
    pub(super) fn new(scheme: &'a Scheme) -> Self {
        let inner = match scheme.method() {
            Method::Dual => scheme.clone().with_boundary(Boundary::None),
            _ => scheme.clone(),
        };
        Self { scheme, inner, known: HashMap::new(), nodes: Vec::new(), open: Vec::new() }
    }

    /// The node of the cell at a corner of the control mesh; `points` gets its vertices.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfResources`].
    pub(super) fn root(&mut self, mesh: &Mesh, corner: u32, points: &mut Vec<u32>) -> Result<u32> {
        let scheme = self.scheme;
        self.cell(scheme, mesh, corner, points)
    }

    /// The same where the rules of a scheme hold.
    fn cell(
        &mut self,
        scheme: &Scheme,
        mesh: &Mesh,
        corner: u32,
        points: &mut Vec<u32>,
    ) -> Result<u32> {
        points.clear();
        let kind = Kind::at(scheme, mesh, corner);
        match kind {
            Kind::Sector => {}
            Kind::Triangle => {
                if let Some(rows) = box_spline::points(scheme, mesh, corner) {
                    return self.triangle(&rows, points);
                }
            }
            Kind::Quad | Kind::Quarter => {
                if let Some(grid) = (Finder { scheme, mesh, window: window(scheme) }).grid(corner) {
                    memory::extend(points, grid.vertices)?;
                    let extent = grid.extent.as_flattened().iter().map(|&x| x as u32);
                    let name = [NONE, 3].into_iter().chain(extent).collect();
                    return Ok(self.named(name, Node::Grid(grid.extent))?.0);
                }
            }
        }
        let refused =
            |of: &mut Self, name: u32, why| Ok(of.named(vec![NONE, name], Node::Refused(why))?.0);
        let rings = rings(scheme);
        let Some(vicinity) = Vicinity::new(scheme, mesh, corner, kind, rings) else {
            return refused(self, 0, "too many faces around it");
        };
        if kind == Kind::Quarter && vicinity.on_rim {
            return refused(self, 1, "beside a boundary a dual scheme's cell must be regular");
        }
        memory::extend(points, vicinity.vertices.iter().copied())?;
        let unfinished = Node::Refused("not made yet");
        let (node, is_new) = self.named(vicinity.name(), unfinished)?;
        if is_new {
            memory::extend(&mut self.open, [(node, vicinity)])?;
        }
        Ok(node)
    }

    /// The node of a regular triangle with points that may lie beyond a boundary.
    fn triangle(&mut self, rows: &[box_spline::Row], points: &mut Vec<u32>) -> Result<u32> {
        let node = self.named(vec![NONE, 2], Node::Triangle)?.0;
        if rows.iter().all(|row| row.len() == 1) {
            memory::extend(points, rows.iter().map(|row| row[0].0))?;
            return Ok(node);
        }
        let mut child = Child { node, offsets: vec![0], entries: Vec::new() };
        let mut name = vec![NONE, 4];
        for row in rows {
            for &(v, weight) in row {
                let known = points.iter().position(|&point| point == v);
                let place = known.unwrap_or(points.len()) as u32;
                if known.is_none() {
                    memory::extend(points, [v])?;
                }
                child.entries.push((place, weight));
                name.extend([place, u32::from(weight > 0.0)]);
            }
            child.offsets.push(child.entries.len() as u32);
        }
        name.extend(&child.offsets);
        // The triangle itself, with points for which it is regular.
        let whole = Node::Split { kind: Kind::Sector, children: vec![Some(child)] };
        Ok(self.named(name, whole)?.0)
    }

    /// The number of the node of a name, and whether it is new.
    fn named(&mut self, name: Vec<u32>, node: Node) -> Result<(u32, bool)> {
        if let Some(&known) = self.known.get(&name) {
            return Ok((known, false));
        }
        let number = self.nodes.len() as u32;
        memory::extend(&mut self.nodes, [node])?;
        let refused = |_| Error::new(ErrorKind::OutOfResources, "a table could not grow");
        self.known.try_reserve(1).map_err(refused)?;
        self.known.insert(name, number);
        Ok((number, true))
    }

    /// Finds the children of all nodes.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`].
    pub(super) fn finish(mut self, context: &Context) -> Result<Vec<Node>> {
        while let Some((node, vicinity)) = self.open.pop() {
            context.check_cancelled()?;
            self.nodes[node as usize] = self.split(&vicinity)?;
        }
        Ok(self.nodes)
    }

    fn split(&mut self, vicinity: &Vicinity) -> Result<Node> {
        let (built, corner) = vicinity.mesh()?;
        let sources = built.vertex_source;
        let source = |v: u32| sources.as_ref().map_or(v, |list| list[v as usize]);
        let inner = self.inner.clone();
        let hierarchy = Hierarchy::new(&Context::serial(), built.mesh, inner.clone(), 1)?;
        let mut numbers = EdgeNumbers::default();
        let plan = inner.plan(&Context::serial(), hierarchy.mesh(0), &mut numbers)?;
        let mut rows = ComposedRows::new(&inner, &plan);
        let mut children = Vec::new();
        let mut points = Vec::new();
        for corner in vicinity.kind.children(&hierarchy, corner)? {
            if corner == NONE {
                children.push(None);
                continue;
            }
            let node = self.cell(&inner, hierarchy.mesh(1), corner, &mut points)?;
            let mut child = Child { node, offsets: vec![0], entries: Vec::new() };
            for &v in &points {
                let row = rows.row(v).into_iter();
                child.entries.extend(row.map(|(v, weight)| (source(v), weight)));
                child.offsets.push(child.entries.len() as u32);
            }
            children.push(Some(child));
        }
        Ok(Node::Split { kind: vicinity.kind, children })
    }
}
