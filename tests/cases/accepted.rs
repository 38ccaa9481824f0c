//! Which cases are meshes: under every policy for what is not manifold.

use std::collections::HashSet;

use carvel::base::Scalar;
use carvel::mesh::{BuildOptions, Built, NonManifold, build};
use carvel::{Context, Result};

use crate::case::{Case, Outcome};
use crate::cases;

/// Policies with the words that the cases have for them. More are a line each.
const POLICIES: [(&str, NonManifold); 3] =
    [("", NonManifold::Error), ("cut", NonManifold::Cut), ("sharpen", NonManifold::Sharpen)];

/// The mesh of a case. Meshes take no creases, sharp vertices and holes yet, so that what
/// cases `expect tags` is not asked for either.
pub fn built(case: &Case, non_manifold: NonManifold) -> Result<Built> {
    let options = BuildOptions { non_manifold, ..BuildOptions::default() };
    let vertices = case.positions.len();
    Ok(build(&Context::serial(), vertices, &case.sizes, &case.indices, &options)?)
}

/// The meshes of all cases that a policy turns into some. While tags are not taken,
/// cases that differ in them alone are one mesh.
pub fn meshes() -> Vec<(Case, Built)> {
    let mut seen = HashSet::new();
    let mut meshes = Vec::new();
    for case in cases() {
        let bits: Vec<u64> = case.positions.as_flattened().iter().map(|x| x.to_bits()).collect();
        if seen.insert((bits, case.sizes.clone(), case.indices.clone())) {
            let first = POLICIES.iter().find_map(|&(_, policy)| built(&case, policy).ok());
            meshes.extend(first.map(|built| (case, built)));
        }
    }
    meshes
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
            let expected = case.expected(situation);
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
            let expected = if comes_later(expected) { &Outcome::Ok } else { expected };
            assert_eq!(&outcome, expected, "{} {situation}", case.name);
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
