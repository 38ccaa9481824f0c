//! A scheme: a split, the weights that go with it, and options.

use super::CornerRule;
use super::scheme_options::{Boundary, Extraordinary, LoopWeights, TriangleRule};
use crate::base::{Context, Element, Error, ErrorKind, Fraction, Result, memory};
use crate::mesh::Mesh;
use crate::refine::{Carried, CornerSplit, Creasing, EdgeNumbers, Pieces, PrimalSplit, Split};

/// How a scheme splits faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SplitKind {
    /// Dual: a vertex for every corner of a face.
    Corner,
    /// Primal: a quad for every corner of a face.
    Quad,
    /// Primal: four triangles for every triangle.
    Triangle,
}

/// Where the weights come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Method {
    /// The averaging family after a corner split.
    Dual,
    /// The averaging family after a quad split.
    Primal,
    /// Catmull and Clark (1978).
    CatmullClark,
    /// Loop (1987).
    Loop,
}

/// A subdivision scheme.
///
/// # Example
/// ```
/// use carvel::{Boundary, Fraction, Scheme};
/// let paper = Scheme::three_point(Fraction::new(1, 32)?)?;
/// assert_eq!(paper.passes(), [Fraction::HALF]);
/// let film = Scheme::catmull_clark().with_boundary(Boundary::Edge);
/// # Ok::<(), carvel::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Scheme {
    method: Method,
    passes: Vec<Fraction>,
    rule: CornerRule,
    boundary: Boundary,
    creasing: Creasing,
    triangle_rule: TriangleRule,
    loop_weights: LoopWeights,
    extraordinary: Extraordinary,
}

impl Scheme {
    /// A scheme with passes that are known to be in range.
    pub(super) fn from_passes(method: Method, passes: &[Fraction]) -> Self {
        Self {
            method,
            passes: passes.to_vec(),
            rule: CornerRule::default(),
            boundary: Boundary::default(),
            creasing: Creasing::default(),
            triangle_rule: TriangleRule::default(),
            loop_weights: LoopWeights::default(),
            extraordinary: Extraordinary::default(),
        }
    }

    /// The same scheme with another corner operator on n-gons.
    #[must_use]
    pub fn with_rule(mut self, rule: CornerRule) -> Self {
        self.rule = rule;
        self
    }

    /// The same scheme with another boundary rule.
    #[must_use]
    pub fn with_boundary(mut self, boundary: Boundary) -> Self {
        self.boundary = boundary;
        self
    }

    /// The same scheme with another way to use up the sharpness of creases.
    #[must_use]
    pub fn with_creasing(mut self, creasing: Creasing) -> Self {
        self.creasing = creasing;
        self
    }

    /// The same scheme with another rule beside triangles; only Catmull–Clark asks.
    #[must_use]
    pub fn with_triangle_rule(mut self, rule: TriangleRule) -> Self {
        self.triangle_rule = rule;
        self
    }

    /// The same scheme with other weights at extraordinary vertices; only Loop asks.
    #[must_use]
    pub fn with_loop_weights(mut self, weights: LoopWeights) -> Self {
        self.loop_weights = weights;
        self
    }

    /// The same scheme with another rule around faces that are no quads.
    ///
    /// [`Extraordinary::Tuned`] replaces split and pass at the four children of every interior
    /// vertex of valence 4 with exactly one face that is no quad, if that face has 3 to 32 sides.
    /// The limit is C¹ with bounded, non-vanishing curvature (λ = ½, μ = ¼); its shape is good
    /// up to 8 sides and fair to 12. Everywhere else, and beside boundary faces that are completed
    /// by mirror images, the scheme does what it did.
    ///
    /// The rule counts from the second step on. What has been refined already is known by its
    /// mesh: a level that a step of a dual scheme made, or one marked *anchored*
    /// ([`BuildOptions::anchored`](crate::mesh::BuildOptions)). A control mesh without that mark
    /// takes the default in its first step, even where its vertices have such a shape.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for the tuned rule of any scheme but three-point with w = 1/32:
    /// it was computed for that one's regular stencils.
    pub fn with_extraordinary(mut self, extraordinary: Extraordinary) -> Result<Self> {
        let paper = self.method == Method::Dual && self.passes == [Fraction::HALF];
        if extraordinary == Extraordinary::Tuned && !paper {
            let message = format!(
                "the tuned rule fits the stencils of three-point with w = 1/32, a corner split \
                 and the pass 1/2, not those of {}",
                self.described()
            );
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
        self.extraordinary = extraordinary;
        Ok(self)
    }

    /// What the scheme is made of.
    fn described(&self) -> String {
        let split = match self.method {
            Method::Dual => "a corner split",
            Method::Primal => "a quad split",
            Method::CatmullClark => return "Catmull-Clark".to_owned(),
            Method::Loop => return "Loop".to_owned(),
        };
        let passes: Vec<_> = self.passes.iter().map(ToString::to_string).collect();
        match &passes[..] {
            [] => format!("{split} without passes"),
            [pass] => format!("{split} and the pass {pass}"),
            _ => format!("{split} and the passes {}", passes.join(", ")),
        }
    }

    /// The smoothing passes of the averaging family, in order.
    pub fn passes(&self) -> &[Fraction] {
        &self.passes
    }

    /// The corner operator.
    pub fn rule(&self) -> CornerRule {
        self.rule
    }

    /// The boundary rule.
    pub fn boundary(&self) -> Boundary {
        self.boundary
    }

    /// How the sharpness of creases is used up.
    pub fn creasing(&self) -> Creasing {
        self.creasing
    }

    /// The rule beside triangles.
    pub fn triangle_rule(&self) -> TriangleRule {
        self.triangle_rule
    }

    /// The weights of Loop's scheme.
    pub fn loop_weights(&self) -> LoopWeights {
        self.loop_weights
    }

    /// The rule around faces that are no quads.
    pub fn extraordinary(&self) -> Extraordinary {
        self.extraordinary
    }

    /// False if the rows of a step cannot be told by stages: some vertices have rows instead
    /// of split and passes.
    pub(crate) fn is_staged(&self) -> bool {
        self.extraordinary != Extraordinary::Tuned
    }

    /// How many stages the rows of a step come in: the split and each pass, or, with the tuned
    /// rule, all in one.
    pub fn stages(&self) -> usize {
        if self.is_staged() { 1 + self.passes.len() } else { 1 }
    }

    /// True if a step on this mesh heeds the tuned rule.
    pub(crate) fn tunes(&self, mesh: &Mesh) -> bool {
        self.extraordinary == Extraordinary::Tuned && mesh.refined
    }

    /// How faces are split.
    pub fn split(&self) -> SplitKind {
        match self.method {
            Method::Dual => SplitKind::Corner,
            Method::Primal | Method::CatmullClark => SplitKind::Quad,
            Method::Loop => SplitKind::Triangle,
        }
    }

    pub(crate) fn method(&self) -> Method {
        self.method
    }

    /// True if a step heeds creases and sharp vertices.
    pub(crate) fn creases(&self) -> bool {
        matches!(self.method, Method::CatmullClark | Method::Loop)
    }

    /// The pieces of a primal split.
    pub(crate) fn pieces(&self) -> Pieces {
        if self.method == Method::Loop { Pieces::Triangles } else { Pieces::Quads }
    }

    /// Refuses a mesh that the scheme has no rule for.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`]: Loop on other faces than triangles; sharp features or
    /// a mesh that is not manifold under a dual scheme, or under passes.
    pub fn check(&self, mesh: &Mesh) -> Result<()> {
        let unsupported = |message: String| Err(Error::new(ErrorKind::Unsupported, message));
        if self.method == Method::Loop {
            return check_triangles(mesh);
        }
        let averages = self.method == Method::Dual || !self.passes.is_empty();
        if averages && !mesh.is_manifold() {
            return unsupported(
                "only linear refinement, Catmull-Clark and Loop refine a mesh that is not manifold"
                    .to_owned(),
            );
        }
        if averages && !mesh.sharpness.is_empty() {
            return unsupported(
                "creases and sharp vertices belong to Catmull-Clark and Loop".to_owned(),
            );
        }
        Ok(())
    }

    /// The faces, ascending in the mesh's order, that are holes: those tagged and, for
    /// Catmull–Clark and Loop with [`Boundary::None`], those at boundary vertices. A
    /// refined face is a hole if the control face that it descends from is one.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfResources`].
    pub fn holes(&self, mesh: &Mesh) -> Result<Vec<u32>> {
        let mut holes = memory::copied(mesh.holes())?;
        if self.boundary != Boundary::None || !self.creases() {
            return Ok(holes);
        }
        let boundary = mesh.rim.iter().filter(|&&c| mesh.joints.leader(c).is_none());
        let ends = boundary.flat_map(|&c| [c, mesh.next(c)]).map(|c| mesh.vert[c as usize]);
        let mut vertices = memory::collect(ends)?;
        vertices.sort_unstable();
        vertices.dedup();
        for v in vertices {
            memory::extend(&mut holes, mesh.fans(v).map(|c| mesh.layout.face_of(c)))?;
        }
        holes.sort_unstable();
        holes.dedup();
        Ok(holes)
    }

    /// Plans the next step on a mesh; a primal one numbers edges in the memory given.
    ///
    /// # Errors
    /// As [`Scheme::check`]; [`ErrorKind::TooLarge`].
    pub(crate) fn plan<'a>(
        &self,
        context: &Context,
        mesh: &'a Mesh,
        memory: &mut EdgeNumbers,
    ) -> Result<Split<'a>> {
        self.check(mesh)?;
        Ok(match self.method {
            Method::Dual => Split::Corner(CornerSplit::new(context, mesh, self.anchor(mesh)?)?),
            _ => Split::Primal(PrimalSplit::new(context, mesh, self.pieces(), memory)?),
        })
    }

    /// What the meshes of a step carry; `holes` are those of the parent.
    pub(crate) fn carried<'h>(&self, holes: &'h [u32]) -> Carried<'h> {
        Carried { anchored: self.anchors(), creasing: self.creasing, holes }
    }

    /// A bound on how much one step can enlarge a coordinate.
    pub(crate) fn growth(&self) -> f64 {
        // Weights of Catmull–Clark and Loop are not negative but where Chaikin creasing
        // goes beyond a crease, by a third at most.
        const BEYOND_CREASE: f64 = 2.0;
        if self.creases() { BEYOND_CREASE } else { self.averaging_growth() }
    }
}

/// Names the first face, in the caller's order, that is no triangle.
fn check_triangles(mesh: &Mesh) -> Result<()> {
    if mesh.layout.side() == 3 {
        return Ok(());
    }
    let others = (0..mesh.faces()).filter(|&f| mesh.face_corners(f).len() != 3);
    let first = others.min_by_key(|&f| mesh.face_source(f));
    first.map_or(Ok(()), |face| {
        let (size, face) = (mesh.face_corners(face).len(), mesh.face_source(face));
        let message = format!("Loop refines triangles only, face {face} has {size} sides");
        let element = Element::Face(face as u64);
        Err(Error::new(ErrorKind::Unsupported, message).with_elements([element]))
    })
}
