//! Any polygon soup, built, refined, and looked at from every side.
#![no_main]

mod soup;

use carvel::base::Scalar;
use carvel::mesh::{BuildOptions, Built, Defect, Defects, Survey, build};
use carvel::refine::Counts;
use carvel::{Attribute, Context, Error, ErrorKind, Hierarchy, Mesh, Prediction};
use carvel::{Refined, Refiner, Result, Scheme, Task};
use soup::{Bytes, Soup};
use std::sync::LazyLock;

/// Contexts of one and two threads that cut the smallest mesh into chunks.
static CONTEXTS: LazyLock<[Context; 2]> = LazyLock::new(|| {
    [1, 2].map(|n| Context::builder().threads(n).chunk(1).build().expect("two threads"))
});

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes::new(data);
    let context = &CONTEXTS[bytes.below(2)];
    let soup = Soup::new(&mut bytes);
    match build(context, soup.vertices, &soup.sizes, &soup.indices, &soup.options()) {
        Err(defects) => check_defects(&soup, defects),
        Ok(built) => {
            check_mesh(&soup, &built);
            let scheme = soup::scheme(&mut bytes);
            let flags = bytes.byte();
            let run =
                Run { context, mesh: &built.mesh, scheme: &scheme, levels: 1 + (flags & 1) as u32 };
            run.topology();
            if flags & 2 == 0 {
                run.values::<f32>(&mut bytes);
            } else {
                run.values::<f64>(&mut bytes);
            }
        }
    }
});

/// A refusal names what is there, in one line.
fn check_defects(soup: &Soup, defects: Defects) {
    if let Defects::Soup(list) = &defects {
        let unusable = |d: &Defect| {
            let kinds =
                [ErrorKind::FaceTooSmall, ErrorKind::IndexOutOfRange, ErrorKind::RepeatedVertex];
            kinds.contains(&d.kind())
        };
        assert!(!list.is_empty());
        assert!(!soup.cut || list.iter().any(unusable), "cutting mends everything else");
        for defect in list {
            assert_eq!(defect.to_string().lines().count(), 1);
            for element in defect.elements() {
                if let carvel::Element::Face(face) = element {
                    assert!((face as usize) < soup.sizes.len());
                }
            }
        }
    }
    let error = Error::from(defects);
    assert_eq!(error.to_string().lines().count(), 1);
    assert_ne!(error.kind(), ErrorKind::BrokenInvariant);
}

/// The mesh is sound and has the soup's faces.
fn check_mesh(soup: &Soup, built: &Built) {
    let mesh = &built.mesh;
    mesh.validate().expect("a built mesh is sound");
    let survey = Survey::of(mesh);
    assert_eq!(survey.face_sizes.values().sum::<usize>(), mesh.faces());
    let seen = [&survey.interior_valences, &survey.boundary_valences];
    let seen: usize = seen.iter().flat_map(|valences| valences.values()).sum();
    assert_eq!(seen + survey.isolated_vertices, mesh.vertices());
    assert_eq!(mesh.faces(), soup.sizes.len());
    let source = |v: u32| built.vertex_source.as_ref().map_or(v, |source| source[v as usize]);
    let mut offsets = vec![0];
    offsets.extend(soup.sizes.iter().scan(0, |sum, &size| {
        *sum += size as usize;
        Some(*sum)
    }));
    for face in 0..mesh.faces() {
        let old = mesh.face_source(face);
        let given = &soup.indices[offsets[old]..offsets[old + 1]];
        assert!(mesh.face_vertices(face).iter().map(|&v| source(v)).eq(given.iter().copied()));
    }
    match &built.vertex_source {
        None => assert_eq!(mesh.vertices(), soup.vertices),
        Some(source) => {
            assert_eq!(source.len(), mesh.vertices());
            assert!(source.iter().take(soup.vertices).copied().eq(0..soup.vertices as u32));
            assert!(source.iter().all(|&v| (v as usize) < soup.vertices));
        }
    }
}

/// One mesh, one scheme.
struct Run<'r> {
    context: &'r Context,
    mesh: &'r Mesh,
    scheme: &'r Scheme,
    levels: u32,
}

impl Run<'_> {
    fn hierarchy(&self) -> Hierarchy {
        Hierarchy::new(self.context, self.mesh.clone(), self.scheme.clone(), self.levels)
            .expect("a small hierarchy")
    }

    /// Every level is sound and as large as predicted.
    fn topology(&self) {
        let plan = Prediction::new(self.mesh, self.scheme, self.levels).expect("small counts");
        let hierarchy = self.hierarchy();
        for level in 0..=self.levels {
            let mesh = hierarchy.mesh(level);
            mesh.validate().expect("a refined mesh is sound");
            let (is, said) = (Counts::of(mesh), plan.counts(level));
            let public = |c: &Counts| {
                let sizes = [c.vertices, c.faces, c.corners, c.edges, c.boundary_edges];
                (sizes, c.irregular_faces, c.irregular_corners)
            };
            assert_eq!(public(&is), public(said), "level {level}");
            if level > 0 {
                let vertices = hierarchy.vertex_origins(level).expect("built");
                let faces = hierarchy.face_origins(level).expect("built");
                assert_eq!((vertices.len(), faces.len()), (mesh.vertices(), mesh.faces()));
            }
        }
    }

    fn values<T: Scalar>(&self, bytes: &mut Bytes) {
        let (kind, constant) = (bytes.below(4), f64::from(bytes.byte()) - 128.0);
        let count = 3 * self.mesh.vertices();
        let positions: Vec<T> = (0..count)
            .map(|_| {
                T::from_f64(match kind {
                    0 => constant / 7.0,
                    _ if bytes.is_empty() => constant,
                    1 => f64::from(bytes.byte() as i8) / 16.0,
                    2 => f64::from(f32::from_bits(bytes.word() as u32)),
                    _ => f64::from_bits(bytes.word()),
                })
            })
            .collect();
        let width = 1 + bytes.below(5);
        let copies: Vec<T> = positions
            .chunks_exact(3)
            .flat_map(|xyz| (0..width).map(move |lane| xyz[lane % 3]))
            .collect();
        let attributes = [Attribute::vertex(&copies, width)];
        let task = Task {
            mesh: self.mesh,
            scheme: self.scheme,
            levels: self.levels,
            positions: &positions,
            attributes: &attributes,
            channels: &[],
            face_sources: true,
        };
        let refined = Refiner::new().refine(self.context, &task);
        self.agrees_with_hierarchy(&positions, &refined);
        self.agrees_with_itself(&task, &refined);
        match refined {
            Err(error) if positions.iter().all(|x| x.is_finite()) => {
                assert_eq!(error.kind(), ErrorKind::Overflow, "{error}");
            }
            Err(error) => assert_eq!(error.kind(), ErrorKind::NotFinite, "{error}"),
            Ok(refined) => {
                assert!(positions.iter().all(|x| x.is_finite()), "accepted");
                assert!(refined.positions.iter().all(|x| x.is_finite()), "let through");
                let faces = self.mesh.faces();
                assert!(refined.face_sources.iter().all(|&f| (f as usize) < faces));
                let lanes = refined.attributes[0].chunks_exact(width);
                for (xyz, record) in refined.positions.chunks_exact(3).zip(lanes) {
                    let copied = (0..width).map(|lane| xyz[lane % 3]);
                    assert!(record.iter().copied().map(bits).eq(copied.map(bits)), "lanes differ");
                }
                if kind == 0 {
                    self.is_constant(&refined.positions, constant / 7.0);
                }
            }
        }
    }

    /// Equal positions stay equal, up to what rounding and the weights' size allow.
    fn is_constant<T: Scalar>(&self, positions: &[T], constant: f64) {
        let epsilon = if T::BYTES == 4 { f64::from(f32::EPSILON) } else { f64::EPSILON };
        let norm = |t: f64| t * t + (1.0 - t * t).abs() + 2.0 * (t * (1.0 - t)).abs();
        let passes = self.scheme.passes();
        let step: f64 = passes.iter().map(|t| 3.0 * norm(t.to_f64())).product();
        let largest = self.mesh.face_sizes().max().unwrap_or(0);
        let terms = 64.0 + f64::from(largest) + self.mesh.corners() as f64;
        let bound = constant.abs() * epsilon * terms * (4.0 * step).powi(self.levels as i32);
        for x in positions {
            let off = (x.to_f64() - constant).abs();
            assert!(off <= bound, "{x:?} instead of {constant}: {off:e} > {bound:e}");
        }
    }

    /// The hierarchy has the same faces and the same values.
    fn agrees_with_hierarchy<T: Scalar>(&self, positions: &[T], refined: &Result<Refined<T>>) {
        let hierarchy = self.hierarchy();
        let mesh = hierarchy.mesh(self.levels);
        let mut out = vec![T::default(); 3 * mesh.vertices()];
        let values = hierarchy.refine(self.context, self.levels, positions, 3, &mut out);
        match (values, refined) {
            (Ok(()), Ok(refined)) => {
                assert!(same(&out, &refined.positions), "hierarchy and refiner differ");
                assert_eq!(refined.face_vertices, mesh.corner_vertices());
                assert!(mesh.face_sizes().eq(refined.face_sizes.iter().copied()));
                assert_eq!(refined.anchored, mesh.is_anchored());
            }
            (Err(a), Err(b)) => assert_eq!(a.kind(), b.kind()),
            (a, b) => panic!("hierarchy {a:?}, refiner {:?}", b.as_ref().err()),
        }
    }

    /// Neither threads nor used memory change a byte; stops in between change no value.
    fn agrees_with_itself<T: Scalar>(&self, task: &Task<T>, refined: &Result<Refined<T>>) {
        let mut refiner = Refiner::new();
        let serial = Context::serial();
        let one = refiner.refine(&serial, &Task { levels: 1, attributes: &[], ..*task });
        equal(&refiner.refine(&serial, task), refined);
        let (2, Ok(one)) = (self.levels, one) else { return };
        let options = BuildOptions { anchored: one.anchored, ..BuildOptions::default() };
        let (sizes, indices) = (&one.face_sizes, &one.face_vertices);
        let built = build(&serial, one.positions.len() / 3, sizes, indices, &options)
            .expect("what is refined can be built");
        built.mesh.validate().expect("a rebuilt mesh is sound");
        let rest = Task {
            mesh: &built.mesh,
            levels: 1,
            positions: &one.positions,
            attributes: &[],
            ..*task
        };
        match (refiner.refine(self.context, &rest), refined) {
            (Ok(two), Ok(refined)) => {
                assert_eq!(two.face_sizes, refined.face_sizes);
                // A built mesh may put the faces of edges and vertices elsewhere.
                assert!(face_set(&two) == face_set(refined), "faces differ");
                assert!(same(&two.positions, &refined.positions), "steps differ");
            }
            (Err(a), Err(b)) => assert_eq!(a.kind(), b.kind()),
            (a, b) => panic!("step by step {:?}, at once {:?}", a.err(), b.as_ref().err()),
        }
    }
}

/// The faces in no order, each from its smallest vertex.
fn face_set<T>(refined: &Refined<T>) -> Vec<Vec<u32>> {
    let mut rest = &refined.face_vertices[..];
    let turned = refined.face_sizes.iter().map(|&size| {
        let (face, after) = rest.split_at(size as usize);
        rest = after;
        let smallest = (0..face.len()).min_by_key(|&i| face[i]).unwrap_or(0);
        [&face[smallest..], &face[..smallest]].concat()
    });
    let mut faces: Vec<_> = turned.collect();
    faces.sort_unstable();
    faces
}

fn bits<T: Scalar>(x: T) -> u64 {
    x.to_f64().to_bits()
}

fn same<T: Scalar>(a: &[T], b: &[T]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(&a, &b)| bits(a) == bits(b))
}

fn equal<T: Scalar>(a: &Result<Refined<T>>, b: &Result<Refined<T>>) {
    match (a, b) {
        (Ok(a), Ok(b)) => {
            assert_eq!(a.face_sizes, b.face_sizes);
            assert_eq!(a.face_vertices, b.face_vertices);
            assert_eq!(a.face_sources, b.face_sources);
            assert!(same(&a.positions, &b.positions), "positions differ");
            assert!(same(&a.attributes[0], &b.attributes[0]), "attributes differ");
        }
        (Err(a), Err(b)) => assert_eq!((a.kind(), a.to_string()), (b.kind(), b.to_string())),
        (a, b) => panic!("{:?} and {:?}", a.as_ref().err(), b.as_ref().err()),
    }
}
