//! Equality of two meshes up to the numbering of vertices and faces and the
//! first vertex of each face.
//!
//! Positions decide where they can: when every vertex has exactly one partner
//! within the tolerance, the faces must agree under that pairing. Where
//! vertices coincide (collapsed or touching meshes) the connectivity decides:
//! each component is laid over the expected mesh from one corner outwards.
//! Costs O(n log n) for meshes whose vertices are apart, and at worst
//! (all vertices in one place) one attempt per corner and component.

use std::collections::HashMap;

use super::number::Point;
use super::poly::Poly;
use super::topology::Topology;

type Verdict<T> = Result<T, String>;

/// Panics with what differs.
pub fn assert_same(actual: &Poly<f64>, expected: &Poly<f64>, relative: f64, what: &str) {
    if let Err(message) = same_mesh(actual, expected, relative) {
        panic!("{what}: {message}");
    }
}

/// Compares two meshes; `relative` is the tolerance per coordinate, relative to
/// the largest coordinate of the expected mesh.
///
/// # Returns
/// For each vertex of `actual`, its partner in `expected`; or what differs.
pub fn same_mesh(actual: &Poly<f64>, expected: &Poly<f64>, relative: f64) -> Verdict<Vec<usize>> {
    check_counts(actual, expected)?;
    let grid = Grid::new(&expected.positions, relative);
    let partners = find_partners(actual, &grid)?;
    let only: Option<Vec<usize>> = partners.iter().copied().collect();
    let matched = match only {
        Some(matched) => matched,
        None => Overlay::new(actual, expected, &grid, partners).run()?,
    };
    check_bijection(&matched)?;
    check_faces(actual, expected, &matched)?;
    Ok(matched)
}

/// The faces of a mesh with their vertices renamed, as sorted canonical cycles.
pub fn canonical_faces(faces: &[Vec<usize>], rename: impl Fn(usize) -> usize) -> Vec<Vec<usize>> {
    let renamed = |f: &Vec<usize>| canonical_cycle(f.iter().map(|&v| rename(v)).collect());
    let mut canonical: Vec<_> = faces.iter().map(renamed).collect();
    canonical.sort_unstable();
    canonical
}

/// A cycle rotated so that its smallest entry comes first.
pub fn canonical_cycle(mut cycle: Vec<usize>) -> Vec<usize> {
    let first = (0..cycle.len()).min_by_key(|&i| cycle[i]).unwrap_or(0);
    cycle.rotate_left(first);
    cycle
}

fn check_counts(actual: &Poly<f64>, expected: &Poly<f64>) -> Verdict<()> {
    let of = |m: &Poly<f64>| (m.positions.len(), m.faces.len(), m.corner_count());
    let ((v, f, c), (w, g, d)) = (of(actual), of(expected));
    if (v, f, c) == (w, g, d) {
        return Ok(());
    }
    Err(format!("{v} vertices, {f} faces, {c} corners; expected {w}, {g}, {d}"))
}

fn largest_coordinate(points: &[Point<f64>]) -> f64 {
    points.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// The largest difference of a coordinate; infinite where one is not a number.
fn distance(x: &Point<f64>, y: &Point<f64>) -> f64 {
    // Bits first: equal infinities are no distance apart.
    let same = |k: usize| x[k].to_bits() == y[k].to_bits();
    let part = |k: usize| if same(k) { 0.0 } else { (x[k] - y[k]).abs() };
    (0..3).map(part).fold(0.0, |m, d| if d.is_nan() { f64::INFINITY } else { m.max(d) })
}

// ----------------------------------------------------------------- positions

/// A hash grid whose cells are at least four tolerances wide.
struct Grid<'a> {
    points: &'a [Point<f64>],
    epsilon: f64,
    width: f64,
    cells: HashMap<[i64; 3], Vec<usize>>,
}

impl<'a> Grid<'a> {
    fn new(points: &'a [Point<f64>], relative: f64) -> Self {
        let largest = largest_coordinate(points).max(f64::MIN_POSITIVE);
        // The floor keeps cell numbers small where the tolerance is zero.
        let width = largest * (4.0 * relative).max(1e-14);
        let mut it = Self { points, epsilon: relative * largest, width, cells: HashMap::new() };
        for (v, p) in points.iter().enumerate() {
            it.cells.entry(it.cell(p, [0.0; 3])).or_default().push(v);
        }
        it
    }

    /// The cell of a point moved by `shift` tolerances.
    fn cell(&self, p: &Point<f64>, shift: [f64; 3]) -> [i64; 3] {
        std::array::from_fn(|k| ((p[k] + shift[k] * self.epsilon) / self.width).floor() as i64)
    }

    /// All points within the tolerance, lazily: they may be very many.
    fn near(&self, p: &Point<f64>) -> impl Iterator<Item = usize> {
        // A little more than the tolerance, against rounding in `cell`.
        let (low, high) = (self.cell(p, [-1.5; 3]), self.cell(p, [1.5; 3]));
        let span = move |k: usize| low[k]..=high[k];
        let cells = span(0).flat_map(move |x| span(1).map(move |y| (x, y)));
        let cells = cells.flat_map(move |(x, y)| span(2).map(move |z| [x, y, z]));
        let p = *p;
        let inside = cells.filter_map(|cell| self.cells.get(&cell)).flatten().copied();
        inside.filter(move |&w| self.fits(w, &p))
    }

    fn fits(&self, w: usize, p: &Point<f64>) -> bool {
        distance(&self.points[w], p) <= self.epsilon
    }
}

/// For each vertex of `actual`, the expected one in its place; `None` where
/// there are several.
fn find_partners(actual: &Poly<f64>, grid: &Grid) -> Verdict<Vec<Option<usize>>> {
    let partner = |p: &Point<f64>| {
        let mut near = grid.near(p);
        near.next().map(|w| if near.next().is_none() { Some(w) } else { None })
    };
    let partners: Vec<_> = actual.positions.iter().map(partner).collect();
    match partners.iter().position(Option::is_none) {
        None => Ok(partners.into_iter().flatten().collect()),
        Some(v) => {
            let lost = partners.iter().filter(|p| p.is_none()).count();
            Err(unmatched(&actual.positions[v], v, lost, grid))
        }
    }
}

fn unmatched(p: &Point<f64>, v: usize, lost: usize, grid: &Grid) -> String {
    let away = |w: &usize| distance(p, &grid.points[*w]);
    let nearest = (0..grid.points.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
    let nearest = nearest.map_or(String::from("none"), |w| {
        format!("{w} at {:?}, {:e} away", grid.points[w], away(&w))
    });
    format!(
        "{lost} vertices have no partner within {:e}; the first is {v} at {p:?} (nearest: \
         {nearest})",
        grid.epsilon
    )
}

fn check_bijection(matched: &[usize]) -> Verdict<()> {
    let mut owner = HashMap::new();
    for (v, &w) in matched.iter().enumerate() {
        if let Some(u) = owner.insert(w, v) {
            return Err(format!("vertices {u} and {v} both lie on expected vertex {w}"));
        }
    }
    Ok(())
}

fn check_faces(actual: &Poly<f64>, expected: &Poly<f64>, matched: &[usize]) -> Verdict<()> {
    let mut wanted: HashMap<Vec<usize>, usize> = HashMap::new();
    for cycle in canonical_faces(&expected.faces, |v| v) {
        *wanted.entry(cycle).or_default() += 1;
    }
    for (f, face) in actual.faces.iter().enumerate() {
        let cycle = canonical_cycle(face.iter().map(|&v| matched[v]).collect());
        match wanted.get_mut(&cycle) {
            Some(left) if *left > 0 => *left -= 1,
            _ => return Err(surplus_face(expected, f, face, &cycle)),
        }
    }
    Ok(())
}

fn surplus_face(expected: &Poly<f64>, f: usize, face: &[usize], cycle: &[usize]) -> String {
    let mut sorted = cycle.to_vec();
    sorted.sort_unstable();
    let same_set = |g: &Vec<usize>| {
        let mut other = g.clone();
        other.sort_unstable();
        other == sorted
    };
    let hint = match expected.faces.iter().find(|&g| same_set(g)) {
        Some(g) => format!("the face with these vertices there is {g:?}"),
        None => String::from("no face there has these vertices"),
    };
    format!("face {f} {face:?} is not expected; in expected vertices it is {cycle:?}; {hint}")
}

// -------------------------------------------------------------- connectivity

/// Lays the components of one mesh over the other, corner by corner.
struct Overlay<'a> {
    actual: Topology,
    expected: Topology,
    actual_faces: &'a [Vec<usize>],
    expected_faces: &'a [Vec<usize>],
    grid: &'a Grid<'a>,
    positions: &'a [Point<f64>],
    /// For each actual vertex, the expected one in its place, if it is alone.
    partners: Vec<Option<usize>>,
    /// Partner of each actual corner, and the reverse.
    corner: Vec<Option<usize>>,
    taken: Vec<bool>,
    vertex: Vec<Option<usize>>,
    vertex_taken: Vec<bool>,
}

impl<'a> Overlay<'a> {
    fn new(
        actual: &'a Poly<f64>,
        expected: &'a Poly<f64>,
        grid: &'a Grid<'a>,
        partners: Vec<Option<usize>>,
    ) -> Self {
        let topology = |m: &Poly<f64>| Topology::new(m.positions.len(), &m.faces);
        Self {
            actual: topology(actual),
            expected: topology(expected),
            actual_faces: &actual.faces,
            expected_faces: &expected.faces,
            grid,
            positions: &actual.positions,
            partners,
            corner: vec![None; actual.corner_count()],
            taken: vec![false; expected.corner_count()],
            vertex: vec![None; actual.positions.len()],
            vertex_taken: vec![false; expected.positions.len()],
        }
    }

    fn run(mut self) -> Verdict<Vec<usize>> {
        for component in self.actual.components() {
            self.lay_component(&component)?;
        }
        for v in self.actual.isolated() {
            self.lay_isolated(v)?;
        }
        Ok(self.vertex.into_iter().flatten().collect())
    }

    /// Starts, if it can, where there is one place to go.
    fn lay_component(&mut self, component: &[usize]) -> Verdict<()> {
        let corners = component.iter().flat_map(|&f| self.actual.corners_of(f));
        let unsure = |&c: &usize| self.partners[self.actual.vert[c]].is_none();
        let start = corners.min_by_key(unsure).expect("a component has corners");
        let v = self.actual.vert[start];
        let near = self.grid.near(&self.positions[v]);
        let starts: Vec<usize> = near.flat_map(|w| self.expected.fans[w].clone()).collect();
        let tried = starts.len();
        if starts.into_iter().any(|d| self.lay_from(start, d)) {
            return Ok(());
        }
        Err(format!(
            "the component of vertex {v} (corner {start}) fits nowhere: {tried} corners in its \
             place were tried"
        ))
    }

    /// Tries corner `c` on `d` and all that follows; undoes it if it fails.
    fn lay_from(&mut self, c: usize, d: usize) -> bool {
        let mut laid = Vec::new();
        let mut open = vec![(c, d)];
        while let Some((c, d)) = open.pop() {
            match self.corner[c] {
                Some(there) if there == d => {}
                None if self.fits(c, d) => {
                    self.lay(c, d);
                    laid.push(c);
                    open.push((self.actual.next[c], self.expected.next[d]));
                    open.extend(self.actual.twin[c].zip(self.expected.twin[d]));
                }
                _ => {
                    self.undo(&laid);
                    return false;
                }
            }
        }
        true
    }

    fn fits(&self, c: usize, d: usize) -> bool {
        let (v, w) = (self.actual.vert[c], self.expected.vert[d]);
        let size = |faces: &[Vec<usize>], f: usize| faces[f].len();
        let free = self.vertex[v].map_or(!self.vertex_taken[w], |there| there == w);
        free && !self.taken[d]
            && size(self.actual_faces, self.actual.face[c])
                == size(self.expected_faces, self.expected.face[d])
            && self.actual.twin[c].is_some() == self.expected.twin[d].is_some()
            && self.grid.fits(w, &self.positions[v])
    }

    fn lay(&mut self, c: usize, d: usize) {
        let (v, w) = (self.actual.vert[c], self.expected.vert[d]);
        self.corner[c] = Some(d);
        self.taken[d] = true;
        self.vertex[v] = Some(w);
        self.vertex_taken[w] = true;
    }

    fn undo(&mut self, laid: &[usize]) {
        for &c in laid {
            let v = self.actual.vert[c];
            if let Some(d) = self.corner[c].take() {
                self.taken[d] = false;
            }
            if let Some(w) = self.vertex[v].take() {
                self.vertex_taken[w] = false;
            }
        }
    }

    /// Isolated vertices in one place are interchangeable.
    fn lay_isolated(&mut self, v: usize) -> Verdict<()> {
        let free = |&w: &usize| self.expected.is_isolated(w) && !self.vertex_taken[w];
        let w = self.grid.near(&self.positions[v]).find(free);
        let w = w.ok_or_else(|| format!("isolated vertex {v} has no isolated partner left"))?;
        self.vertex[v] = Some(w);
        self.vertex_taken[w] = true;
        Ok(())
    }
}
