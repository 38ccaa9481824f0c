//! Rules for face-varying values beside seams, as OpenSubdiv has them.
//!
//! A value whose vertex has no seam (nor other reason for a rule of its own) follows the
//! vertex. The others are *split*: each is a corner, which stays, or a crease between the
//! two ends of its run of faces, or on its way from one to the other while a sharp edge
//! inside the run loses its sharpness.

use super::crease_rules::Surroundings;
use super::{Boundary, Creasing, PointSink, Scheme, SplitKind};
use crate::base::{Element, Error, ErrorKind, NONE, Result, Weight, memory};
use crate::mesh::sharpness::{INFINITE, Sharpness};
use crate::mesh::{Channel, FaceVaryingMode, Mesh};
use crate::refine::{Around, PrimalSplit, decrement};
use std::borrow::Cow;

/// The rule of a split value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SplitRule {
    /// It stays.
    Corner,
    /// The boundary curve.
    Crease,
    /// A corner until sharpness inside its run of faces is used up.
    SemiSharp,
    /// The same, but for the sharpness in the run of the other value.
    Dependent,
}

/// A split value: its vertex, its number in the channel, its rule.
pub(crate) type SplitValue = (u32, u32, SplitRule);

/// A channel at some level.
#[derive(Debug)]
pub(crate) struct ChannelLevel<'a> {
    /// The mesh cut along the seams.
    pub(crate) mesh: Cow<'a, Mesh>,
    /// The split values, by vertex and number.
    pub(crate) split: Vec<SplitValue>,
}

/// What a mode asks for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChannelRules<'a> {
    scheme: &'a Scheme,
    mode: FaceVaryingMode,
}

impl<'a> ChannelRules<'a> {
    pub(crate) fn new(scheme: &'a Scheme, mode: FaceVaryingMode) -> Self {
        Self { scheme, mode }
    }

    pub(crate) fn scheme(self) -> &'a Scheme {
        self.scheme
    }

    /// Refuses schemes without rules for face-varying values.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`].
    pub(crate) fn check(self) -> Result<()> {
        if self.scheme.creases()
            || (self.scheme.split() == SplitKind::Quad && self.scheme.passes().is_empty())
        {
            return Ok(());
        }
        let message = "face-varying values belong to Catmull-Clark, Loop and bilinear refinement";
        Err(Error::new(ErrorKind::Unsupported, message))
    }

    /// True if every value is refined linearly.
    pub(crate) fn is_linear(self) -> bool {
        self.mode == FaceVaryingMode::All || !self.scheme.creases()
    }

    fn has_linear_boundaries(self) -> bool {
        matches!(self.mode, FaceVaryingMode::Boundaries | FaceVaryingMode::All)
    }

    fn is_dependent(self) -> bool {
        matches!(self.mode, FaceVaryingMode::CornersPlus1 | FaceVaryingMode::CornersPlus2)
    }

    /// The split values of a channel on its control mesh.
    pub(crate) fn split_values(self, mesh: &Mesh, channel: &Mesh) -> Result<Vec<SplitValue>> {
        let mut split = Vec::new();
        for v in self.split_vertices(mesh, channel)? {
            let mut values = memory::collect(mesh.fans(v).map(|c| channel.vert[c as usize]))?;
            values.sort_unstable();
            values.dedup();
            let rules = self.rules_at(mesh, channel, v, &values);
            memory::extend(&mut split, values.iter().zip(rules).map(|(&s, rule)| (v, s, rule)))?;
        }
        Ok(split)
    }

    /// The channel as a mesh, which of the caller's values each of its vertices is, and a scheme whose
    /// own rules on that mesh are those of the values. What the channel's scheme says of boundaries is
    /// said by the mesh.
    ///
    /// # Errors
    /// As [`ChannelRules::check`]; [`ErrorKind::Unsupported`], naming the vertex, where values of
    /// one vertex wait for each other or Chaikin's rule sees sharp edges beyond a seam;
    /// [`ErrorKind::OutOfResources`].
    pub(crate) fn as_mesh(
        self,
        mesh: &Mesh,
        channel: &Channel,
    ) -> Result<(Mesh, Vec<u32>, Scheme)> {
        self.check()?;
        let (mut cut, own) = channel.apart()?;
        let split = self.split_values(mesh, &channel.mesh)?;
        self.check_alone(mesh, &split)?;
        let is_corner = |slot: u32| split_rule(&split, slot) == Some(SplitRule::Corner);
        let linear = self.is_linear();
        let sharpness = |vertex: u32| {
            let slot = own[vertex as usize];
            match cut.start[vertex as usize] {
                NONE => 0.0,
                _ if linear || is_corner(slot) => INFINITE,
                corner => self.scheme.vertex_sharpness(mesh, mesh.vert[corner as usize]),
            }
        };
        let vertices = (0..own.len() as u32).map(|v| (v, sharpness(v)));
        let vertices = memory::collect(vertices.filter(|&(_, sharpness)| sharpness > 0.0))?;
        let inside = |c: &u32| {
            let twin = cut.twin[*c as usize];
            twin != NONE && *c < twin
        };
        let edges = (0..cut.twin.len() as u32).filter(inside);
        let edges = edges.map(|c| (c, if linear { INFINITE } else { mesh.edge_sharpness(c) }));
        let edges = memory::collect(edges.filter(|&(_, sharpness)| sharpness > 0.0))?;
        cut.sharpness = Sharpness { edges, vertices };
        cut.holes = self.scheme.holes(mesh)?;
        let values = memory::collect(own.iter().map(|&slot| channel.source[slot as usize]))?;
        let scheme = match self.scheme.split() {
            // Lines that a step draws in a face are no sharp edges.
            SplitKind::Quad if linear => Scheme::primal(&[])?,
            _ => self.scheme.clone().with_boundary(Boundary::Edge),
        };
        Ok((cut, values, scheme))
    }

    /// Refuses split values whose rules depend on what is beyond their seams.
    fn check_alone(self, mesh: &Mesh, split: &[SplitValue]) -> Result<()> {
        let passing = |sharpness: f32| sharpness > 0.0 && sharpness < INFINITE;
        let chaikin = self.scheme.creasing() == Creasing::Chaikin;
        let waits = |&&(v, _, rule): &&SplitValue| {
            let edges = || mesh.fans(v).flat_map(|c| [c, mesh.prev(c)]);
            rule == SplitRule::Dependent
                || (chaikin && edges().any(|c| passing(mesh.edge_sharpness(c))))
        };
        let Some(&(v, ..)) = split.iter().find(waits) else { return Ok(()) };
        let message = format!(
            "at vertex {v} face-varying values depend on semi-sharp edges beyond a seam: \
             their surface is not evaluated"
        );
        Err(Error::new(ErrorKind::Unsupported, message).with_elements([Element::Vertex(v.into())]))
    }

    /// The vertices with a seam or another reason for rules of their own.
    fn split_vertices(self, mesh: &Mesh, channel: &Mesh) -> Result<Vec<u32>> {
        let rim = channel.rim.iter().copied();
        // A side of a non-manifold edge is on no seam as long as all sides agree.
        let seams = rim.clone().filter(|&c| channel.joints.leader(c).is_none());
        let seams = seams.filter(|&c| !mesh.is_boundary_edge(c));
        let ends = |c: u32| [c, mesh.next(c)].map(|c| mesh.vert[c as usize]);
        let mut vertices = memory::collect(seams.flat_map(ends))?;
        let boundary = mesh.rim.iter().copied().filter(|&c| mesh.is_boundary_edge(c));
        if self.has_linear_boundaries() {
            memory::extend(&mut vertices, boundary.flat_map(ends))?;
        } else if self.mode != FaceVaryingMode::Smooth
            && self.scheme.boundary() != Boundary::EdgeAndCorner
        {
            let single = |&v: &u32| mesh.fans(v).nth(1).is_none();
            memory::extend(&mut vertices, boundary.flat_map(ends).filter(single))?;
        }
        let value = |c: u32| channel.vert[c as usize];
        let apart = |&v: &u32| mesh.fans(v).any(|c| value(c) != value(mesh.start[v as usize]));
        let mut several = memory::collect(mesh.joints.fans.iter().map(|&(v, _)| v))?;
        several.dedup();
        memory::extend(&mut vertices, several.into_iter().filter(apart))?;
        vertices.sort_unstable();
        vertices.dedup();
        Ok(vertices)
    }

    fn rules_at(self, mesh: &Mesh, channel: &Mesh, v: u32, values: &[u32]) -> Vec<SplitRule> {
        let sharpness = self.scheme.vertex_sharpness(mesh, v);
        let count = values.len();
        let on_boundary = || mesh.fans(v).any(|c| mesh.touches_boundary(c));
        let darts = self.mode == FaceVaryingMode::CornersPlus2 || self.has_linear_boundaries();
        let corners = vec![SplitRule::Corner; count];
        if self.has_linear_boundaries()
            || sharpness >= INFINITE
            || mesh.fans(v).any(|c| mesh.touches_joint(c))
            || mesh.joints.further_fans(v).next().is_some()
            || (self.is_dependent() && count > 2)
            || (darts && count == 1 && !on_boundary())
        {
            return corners;
        }
        let spans: Vec<Span> = values.iter().map(|&s| Span::of(mesh, channel, s)).collect();
        let mut dependent = false;
        if let ([a, b], true) = (&spans[..], self.is_dependent()) {
            let one_corner =
                self.mode == FaceVaryingMode::CornersPlus2 && (a.faces == 1 || b.faces == 1);
            if a.disjoint || b.disjoint || one_corner {
                return corners;
            }
            dependent = a.semi_sharp != b.semi_sharp;
        }
        // A lone value on the boundary has the boundary's own edges inside its run.
        let alone = count == 1 && on_boundary();
        let rule = |span: &Span| {
            if span.disjoint || alone || (span.faces == 1 && self.mode != FaceVaryingMode::Smooth) {
                SplitRule::Corner
            } else if span.semi_sharp > 0 || sharpness > 0.0 {
                SplitRule::SemiSharp
            } else if dependent {
                SplitRule::Dependent
            } else {
                SplitRule::Crease
            }
        };
        spans.iter().map(rule).collect()
    }

    /// The split values after a step. `split` and `channel_split` are the splits of the
    /// mesh and of the channel, `child` is the split mesh.
    pub(crate) fn next(
        self,
        split: &PrimalSplit,
        level: &ChannelLevel,
        channel_split: &PrimalSplit,
    ) -> Result<Vec<SplitValue>> {
        let mut next = Vec::new();
        for values in level.split.chunk_by(|a, b| a.0 == b.0) {
            memory::extend(&mut next, self.left_at(split.parent(), &level.mesh, values))?;
        }
        let along =
            if self.has_linear_boundaries() { SplitRule::Corner } else { SplitRule::Crease };
        let mesh = split.parent();
        for &c in &level.mesh.rim {
            let seam = level.mesh.joints.leader(c).is_none() && !mesh.is_boundary_edge(c);
            if seam || (self.has_linear_boundaries() && mesh.is_boundary_edge(c)) {
                let value = (split.edge_vertex(c), channel_split.edge_vertex(c), along);
                memory::extend(&mut next, [value])?;
            }
        }
        next.sort_unstable_by_key(|&(v, s, _)| (v, s));
        Ok(next)
    }

    /// The rules at a vertex after a step.
    fn left_at(self, mesh: &Mesh, channel: &Mesh, values: &[SplitValue]) -> Vec<SplitValue> {
        let v = values[0].0;
        let mut next = values.to_vec();
        let before = self.scheme.vertex_sharpness(mesh, v);
        let semi = |sharpness: f32| sharpness > 0.0 && sharpness < INFINITE;
        let mut around = Surroundings::default();
        around.look(mesh, v, before, self.scheme.creasing());
        if !semi(before) && !around.spokes.iter().any(|spoke| semi(spoke.sharpness)) {
            return next;
        }
        if decrement(before) > 0.0 {
            return next;
        }
        if !around.spokes.iter().any(|spoke| semi(spoke.left)) {
            for (_, _, rule) in &mut next {
                if *rule != SplitRule::Corner {
                    *rule = SplitRule::Crease;
                }
            }
            return next;
        }
        for (_, slot, rule) in &mut next {
            if *rule == SplitRule::SemiSharp
                && !self.inside(mesh, channel, *slot).iter().any(|&(_, left)| semi(left))
            {
                *rule = SplitRule::Crease;
            }
        }
        // A value that waited for the other one goes on by itself.
        if let [(_, _, a), (_, _, b)] = &mut next[..] {
            let waits =
                |rule: SplitRule| matches!(rule, SplitRule::SemiSharp | SplitRule::Dependent);
            if *a == SplitRule::Dependent && !waits(*b) {
                *a = SplitRule::SemiSharp;
            } else if *b == SplitRule::Dependent && !waits(*a) {
                *b = SplitRule::SemiSharp;
            }
        }
        next
    }

    /// Sharpness before and after the step of the edges inside the run of a value.
    fn inside(self, mesh: &Mesh, channel: &Mesh, slot: u32) -> Vec<(f32, f32)> {
        let v = mesh.vert[channel.start[slot as usize] as usize];
        let around = Around::of(mesh, v);
        let corners = channel.fan(slot).filter(|&c| channel.twin[c as usize] != NONE);
        let sharpness = corners.map(|c| mesh.edge_sharpness(c));
        sharpness.map(|s| (s, self.scheme.creasing().edge(s, around))).collect()
    }

    /// The row of a split value: `left` is its rule after the step, `values` those of its
    /// vertex.
    pub(crate) fn row<W: Weight>(
        self,
        mesh: &Mesh,
        channel: &Mesh,
        (value, left): (SplitValue, SplitRule),
        values: &[SplitValue],
        sink: &mut impl PointSink<W>,
    ) {
        let (v, slot, rule) = value;
        if self.is_linear() || left != SplitRule::Crease {
            return sink.vertex(slot, W::ratio(1, 1));
        }
        let corner = match rule {
            SplitRule::SemiSharp => self.corner_weight(mesh, channel, v, slot),
            SplitRule::Dependent => {
                let other = values.iter().find(|other| other.1 != slot).unwrap_or(&value);
                self.corner_weight(mesh, channel, v, other.1)
            }
            SplitRule::Corner | SplitRule::Crease => 0.0,
        };
        let corner = W::from_sharpness(corner);
        let crease = W::ratio(1, 1) - corner.clone();
        sink.vertex(slot, crease.clone() * W::ratio(3, 4) + corner);
        let first = channel.start[slot as usize];
        let last = channel.fan(slot).last().unwrap_or(first);
        for end in [channel.next(first), channel.prev(last)] {
            sink.vertex(channel.vert[end as usize], crease.clone() * W::ratio(1, 8));
        }
    }

    /// The weight of the corner rule while a value becomes a crease.
    fn corner_weight(self, mesh: &Mesh, channel: &Mesh, v: u32, slot: u32) -> f32 {
        let before = self.scheme.vertex_sharpness(mesh, v);
        Surroundings::inside(self.inside(mesh, channel, slot), before, self.scheme.creasing())
            .weight()
    }
}

/// The rule of a value, if it is split.
fn split_rule(split: &[SplitValue], slot: u32) -> Option<SplitRule> {
    // Numbers ascend with vertices.
    let at = split.binary_search_by_key(&slot, |&(_, slot, _)| slot).ok()?;
    Some(split[at].2)
}

/// The run of faces of a value at a vertex.
struct Span {
    faces: usize,
    /// It has several pieces, or is cut by an infinitely sharp edge.
    disjoint: bool,
    /// Semi-sharp edges inside.
    semi_sharp: usize,
}

impl Span {
    fn of(mesh: &Mesh, channel: &Mesh, slot: u32) -> Self {
        let mut span = Self {
            faces: channel.fans(slot).count(),
            disjoint: channel.joints.further_fans(slot).next().is_some(),
            semi_sharp: 0,
        };
        for c in channel.fan(slot).filter(|&c| channel.twin[c as usize] != NONE) {
            let sharpness = mesh.edge_sharpness(c);
            span.disjoint |= sharpness >= INFINITE;
            span.semi_sharp += usize::from(sharpness > 0.0);
        }
        span
    }
}

impl Mesh {
    /// True if an edge of the corner's face at its vertex is a boundary edge.
    fn touches_boundary(&self, corner: u32) -> bool {
        [corner, self.prev(corner)].into_iter().any(|c| self.is_boundary_edge(c))
    }

    /// True if an edge of the corner's face at its vertex is not manifold.
    fn touches_joint(&self, corner: u32) -> bool {
        !self.joints.sides.is_empty()
            && [corner, self.prev(corner)].into_iter().any(|c| self.joints.leader(c).is_some())
    }
}

impl<'a> ChannelLevel<'a> {
    /// The channel on its control mesh.
    pub(crate) fn control(rules: ChannelRules, mesh: &Mesh, channel: &'a Channel) -> Result<Self> {
        let split = rules.split_values(mesh, &channel.mesh)?;
        Ok(Self { mesh: Cow::Borrowed(&channel.mesh), split })
    }
}
