//! Which cases are meshes: under every policy for what is not manifold.

use carvel::base::Scalar;
use carvel::mesh::{BuildOptions, Built, NonManifold, build};
use carvel::{Context, Crease, Result, SharpVertex};

use crate::case::{Case, Outcome};
use crate::cases;

/// Policies with the words that the cases have for them. More are a line each.
const POLICIES: [(&str, NonManifold); 3] =
    [("", NonManifold::Error), ("cut", NonManifold::Cut), ("sharpen", NonManifold::Sharpen)];

/// The mesh of a case with all that is tagged.
pub fn built(case: &Case, non_manifold: NonManifold) -> Result<Built> {
    let creases = case.creases.iter().map(|&(vertices, sharpness)| Crease { vertices, sharpness });
    let sharp = case.sharp_vertices.iter();
    let sharp = sharp.map(|&(vertex, sharpness)| SharpVertex { vertex, sharpness });
    let options = BuildOptions {
        non_manifold,
        creases: &creases.collect::<Vec<_>>(),
        sharp_vertices: &sharp.collect::<Vec<_>>(),
        holes: &case.holes,
        ..BuildOptions::default()
    };
    let vertices = case.positions.len();
    Ok(build(&Context::serial(), vertices, &case.sizes, &case.indices, &options)?)
}

/// The meshes of all cases: a sound one once, others under every policy that repairs them.
pub fn meshes() -> Vec<(Case, Built)> {
    let policies = |case: Case| match built(&case, NonManifold::Error) {
        Ok(built) => vec![(case, built)],
        Err(_) => POLICIES[1..]
            .iter()
            .filter_map(|&(situation, policy)| {
                let built = built(&case, policy).ok()?;
                let mut case = case.clone();
                case.name = format!("{}, {situation}", case.name);
                Some((case, built))
            })
            .collect(),
    };
    cases().into_iter().flat_map(policies).collect()
}

/// What building a case with its tags should come to: without a mesh there is nothing
/// that tags could be wrong about.
fn expected(case: &Case, situation: &str) -> Outcome {
    let topology = case.expected(situation);
    match case.special("tags") {
        Some(tags) if *topology == Outcome::Ok => tags.clone(),
        _ if comes_later(topology) => Outcome::Ok,
        _ => topology.clone(),
    }
}

/// The positions of a mesh that may have copies of vertices.
pub fn positions<T: Scalar>(case: &Case, built: &Built) -> Vec<T> {
    let of = |v: usize| built.vertex_source.as_ref().map_or(v, |source| source[v] as usize);
    let vertices = 0..built.mesh.vertices();
    vertices.flat_map(|v| case.positions[of(v)].map(T::from_f64)).collect()
}

/// True if the error is about coordinates: topology knows nothing of it.
fn comes_later(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::Error(kind) if kind == "NotFinite")
}

#[test]
fn cases_are_accepted_or_refused_as_they_say() {
    for case in cases() {
        for (situation, policy) in POLICIES {
            let outcome = match built(&case, policy) {
                Ok(built) => {
                    built.mesh.validate().unwrap_or_else(|e| panic!("{}: {e}", case.name));
                    Outcome::Ok
                }
                Err(error) => {
                    assert!(!error.elements().is_empty(), "{}: {error}", case.name);
                    assert_eq!(error.to_string().lines().count(), 1, "{}: {error}", case.name);
                    Outcome::Error(format!("{:?}", error.kind()))
                }
            };
            assert_eq!(outcome, expected(&case, situation), "{} {situation}", case.name);
        }
    }
}

/// Where nothing is to be repaired, the policy makes no difference.
#[test]
fn sound_cases_are_the_same_under_every_policy() {
    for case in cases() {
        let Ok(plain) = built(&case, NonManifold::Error) else { continue };
        for (situation, policy) in &POLICIES[1..] {
            let other = built(&case, *policy).expect("a sound case");
            assert_eq!(plain.mesh, other.mesh, "{} {situation}", case.name);
            assert_eq!(other.vertex_source, None, "{} {situation}", case.name);
        }
    }
}

/// Faces and vertices that a cut leaves are those of the file.
#[test]
fn cut_cases_keep_their_faces() {
    for case in cases() {
        let Ok(Built { mesh, vertex_source }) = built(&case, NonManifold::Cut) else { continue };
        let source = |v: u32| vertex_source.as_ref().map_or(v, |source| source[v as usize]);
        let faces: Vec<&[u32]> = faces(&case);
        assert_eq!(mesh.faces(), faces.len(), "{}", case.name);
        for f in 0..mesh.faces() {
            let face: Vec<u32> = mesh.face_vertices(f).iter().map(|&v| source(v)).collect();
            assert_eq!(face, faces[mesh.face_source(f)], "{} face {f}", case.name);
        }
    }
}

fn faces(case: &Case) -> Vec<&[u32]> {
    let mut rest = &case.indices[..];
    let mut face = |&size: &u32| {
        let (face, after) = rest.split_at(size as usize);
        rest = after;
        face
    };
    case.sizes.iter().map(&mut face).collect()
}
