//! Each shim gives what its library is known to give, and says what it cannot do.

use carvel_peers::lineage::{Ours, Split, match_levels};
use carvel_peers::{
    Boundary, Cgal, Channel, Comparison, Control, Creasing, FaceVarying, OpenMesh, OpenSubdiv,
    Options, PEERS, Peer, PeerMesh, Precision, Scheme, Stencils, Task, Values, shapes,
};

/// (vertices, faces) at level n of a closed mesh with V vertices, E edges, F faces.
fn expected(control: &Control, scheme: Scheme, levels: u32) -> (usize, usize) {
    let corners = control.indices.len();
    let (mut v, mut e, mut f) = (control.vertices(), corners / 2, control.sizes.len());
    for _ in 0..levels {
        (v, e, f) = match scheme {
            Scheme::CatmullClark | Scheme::Bilinear => (v + e + f, 4 * e, 2 * e),
            Scheme::DooSabin => (2 * e, 4 * e, v + e + f),
            Scheme::Loop | Scheme::ModifiedButterfly => (v + e, 2 * e + 3 * f, 4 * f),
            Scheme::Sqrt3 | Scheme::LabsikGreiner => (v + f, 3 * e, 3 * f),
        };
    }
    (v, f)
}

fn refine(peer: &dyn Peer, control: &Control, scheme: Scheme, levels: u32) -> PeerMesh {
    let task = Task::new(control, scheme, Precision::Double);
    peer.refine(&task, levels).unwrap_or_else(|e| panic!("{} {scheme:?}: {e}", peer.name()))
}

#[test]
fn every_scheme_of_every_peer_gives_its_counts() {
    for peer in PEERS {
        for &scheme in peer.schemes() {
            let control =
                if scheme.needs_triangles() { shapes::icosahedron() } else { shapes::prism(5) };
            for levels in 1..=3 {
                let mesh = refine(peer, &control, scheme, levels);
                let counts = (mesh.vertices(), mesh.sizes.len());
                assert_eq!(
                    counts,
                    expected(&control, scheme, levels),
                    "{} {scheme:?}",
                    peer.name()
                );
                assert!(mesh.positions.iter().all(|x| x.is_finite()));
            }
        }
    }
}

#[test]
fn precisions_differ_by_rounding_and_do_differ() {
    for peer in PEERS {
        for &scheme in peer.schemes() {
            let control = shapes::icosahedron().rounded();
            let at = |precision| {
                peer.refine(&Task::new(&control, scheme, precision), 2).expect("a closed mesh")
            };
            let (single, double) = (at(Precision::Single), at(Precision::Double));
            let apart = Comparison::through_adjacency(&single, &double);
            assert!(apart.agrees(Precision::Single), "{} {scheme:?} {apart:?}", peer.name());
            assert!(!apart.agrees(Precision::Double), "{} {scheme:?}: no single", peer.name());
        }
    }
}

#[test]
fn the_peers_agree_with_each_other_on_closed_meshes() {
    let (quads, triangles) = (shapes::prism(7), shapes::icosahedron());
    for (scheme, control) in [(Scheme::CatmullClark, quads), (Scheme::Loop, triangles)] {
        let osd = refine(&OpenSubdiv, &control, scheme, 3);
        for peer in [&OpenMesh as &dyn Peer, &Cgal] {
            let apart = Comparison::through_adjacency(&osd, &refine(peer, &control, scheme, 3));
            assert!(apart.agrees(Precision::Double), "{} {scheme:?} {apart:?}", peer.name());
        }
    }
    let control = shapes::icosahedron();
    let [a, b] = [&OpenMesh as &dyn Peer, &Cgal].map(|it| refine(it, &control, Scheme::Sqrt3, 3));
    assert!(Comparison::through_adjacency(&a, &b).agrees(Precision::Double));
}

/// The position of the vertex that a vertex of the control mesh becomes.
fn child_of_first_vertex(peer: &dyn Peer, control: &Control, scheme: Scheme) -> [f64; 3] {
    let mesh = refine(peer, control, scheme, 1);
    [mesh.positions[0], mesh.positions[1], mesh.positions[2]]
}

#[test]
fn known_positions() {
    // Cube: a corner moves to 5/9 of itself under Catmull-Clark.
    for peer in PEERS {
        let [x, y, z] = child_of_first_vertex(peer, &shapes::cube(), Scheme::CatmullClark);
        for value in [x, y, z] {
            assert!((value + 5.0 / 9.0).abs() < 1e-15, "{}: {value}", peer.name());
        }
    }
    // Tetrahedron under Loop, beta(3) = 3/16: 7/16 v + 9/16 of the mean -v/3.
    for peer in PEERS {
        let [x, ..] = child_of_first_vertex(peer, &shapes::tetrahedron(), Scheme::Loop);
        assert!((x - 0.25).abs() < 1e-15, "{}: {x}", peer.name());
    }
    // The interpolating schemes and the bilinear one keep their vertices.
    for (peer, scheme) in [
        (&OpenMesh as &dyn Peer, Scheme::ModifiedButterfly),
        (&OpenMesh, Scheme::LabsikGreiner),
        (&OpenSubdiv, Scheme::Bilinear),
    ] {
        let [x, ..] = child_of_first_vertex(peer, &shapes::tetrahedron(), scheme);
        assert!((x - 1.0).abs() < 1e-15, "{scheme:?}: {x}");
    }
}

#[test]
fn openmesh_catmull_clark_is_no_oracle_at_a_boundary() {
    let control = shapes::grid(3, 3);
    let theirs = refine(&OpenMesh, &control, Scheme::CatmullClark, 1);
    for boundary in Boundary::ALL {
        let mut task = Task::new(&control, Scheme::CatmullClark, Precision::Double);
        task.options.boundary = boundary;
        let osd = OpenSubdiv.refine(&task, 1).expect("a grid");
        let apart = Comparison::through_adjacency(&osd, &theirs);
        assert!(!apart.agrees(Precision::Single), "{boundary:?}");
    }
}

#[test]
fn border_rules_of_cgal_and_openmesh_are_opensubdivs_edge_only() {
    let (grid, triangles) = (shapes::frame(), shapes::triangulated(&shapes::grid(3, 4)));
    for (peer, scheme, control) in [
        (&Cgal as &dyn Peer, Scheme::CatmullClark, &grid),
        (&Cgal, Scheme::Loop, &triangles),
        (&OpenMesh, Scheme::Loop, &triangles),
    ] {
        let theirs = refine(peer, control, scheme, 2);
        for boundary in Boundary::ALL {
            let mut task = Task::new(control, scheme, Precision::Double);
            task.options.boundary = boundary;
            let osd = OpenSubdiv.refine(&task, 2).expect("a grid");
            let apart = Comparison::through_adjacency(&osd, &theirs);
            let same = apart.agrees(Precision::Double);
            // Positions under `none` are those of edge-only; it only adds holes.
            let expected = boundary != Boundary::EdgeAndCorner;
            assert_eq!(same, expected, "{} {scheme:?} {boundary:?} {apart:?}", peer.name());
        }
    }
}

#[test]
fn errors_are_one_line_and_nothing_is_refined_in_silence() {
    let mut bad = shapes::cube();
    bad.indices[3] = 99;
    for peer in PEERS {
        let error = peer.refine(&Task::new(&bad, Scheme::CatmullClark, Precision::Single), 1);
        let error = error.expect_err("vertex 99 of 8");
        assert!(error.contains("99") && !error.contains('\n'), "{}: {error}", peer.name());
    }
    for peer in [&OpenMesh as &dyn Peer, &Cgal] {
        let book = shapes::book(3);
        let error = peer.refine(&Task::new(&book, Scheme::CatmullClark, Precision::Single), 1);
        assert!(error.expect_err("three pages").contains("manifold"), "{}", peer.name());
    }
    let error =
        OpenMesh.refine(&Task::new(&shapes::bipyramid(60), Scheme::Loop, Precision::Single), 1);
    assert!(error.expect_err("valence 60").contains("valences"));
    let error =
        OpenSubdiv.refine(&Task::new(&shapes::cube(), Scheme::DooSabin, Precision::Single), 1);
    assert_eq!(error.expect_err("no Doo-Sabin"), "OpenSubdiv does not have doo-sabin");
    let error = OpenSubdiv.refine(&Task::new(&shapes::cube(), Scheme::Loop, Precision::Single), 1);
    assert!(error.expect_err("quads").contains("triangles"));
}

#[test]
fn opensubdivs_own_messages_become_errors() {
    let control = shapes::cube().creased(&[[0, 7]], 2.0);
    let task = Task::new(&control, Scheme::CatmullClark, Precision::Double);
    match OpenSubdiv.refinement(&task, 1) {
        // A crease that is no edge is a warning of the library's, kept and not printed.
        Ok(it) => assert!(!it.warnings().is_empty()),
        Err(error) => assert!(!error.contains('\n'), "{error}"),
    }
}

/// Matches our numbering, laid out from the documentation, with OpenSubdiv's.
fn matched(control: &Control, scheme: Scheme, split: Split) {
    let task = Task::new(control, scheme, Precision::Double);
    let refinement = OpenSubdiv.refinement(&task, 3).expect("a mesh");
    let levels: Vec<_> = (0..=3).map(|n| refinement.level(n).expect("a level")).collect();
    let ours = Ours::control(control.vertices(), control.sizes.clone(), control.indices.clone());
    let faces = (0..control.sizes.len() as u32).collect();
    let (mut ours, at) = match_levels(&ours, faces, split, &levels).expect("the same children");
    let theirs = refinement.mesh().expect("a mesh");
    ours.level.positions = at
        .vertices
        .iter()
        .flat_map(|&w| theirs.positions[3 * w as usize..][..3].to_vec())
        .collect();
    let apart = Comparison::of(&ours.level, &theirs, &at);
    assert!(apart.agrees(Precision::Double), "{scheme:?} {apart:?}");
}

#[test]
fn opensubdivs_children_are_known_by_their_parents() {
    for scheme in [Scheme::CatmullClark, Scheme::Bilinear] {
        for control in [
            shapes::cube(),
            shapes::prism(9),
            shapes::frame(),
            shapes::valence_two(),
            shapes::book(3),
        ] {
            matched(&control, scheme, Split::Quad);
        }
        matched(&shapes::touching_cubes(), scheme, Split::Quad);
    }
    for control in [shapes::tetrahedron(), shapes::fan(5), shapes::half_fan(1)] {
        matched(&control, Scheme::Loop, Split::Triangle);
    }
}

#[test]
fn options_and_tags_reach_opensubdiv() {
    let plain = shapes::grid(4, 4);
    let refined = |control: &Control, options: Options| {
        let task = Task { options, ..Task::new(control, Scheme::CatmullClark, Precision::Double) };
        OpenSubdiv.refine(&task, 2).expect("a grid")
    };
    let base = refined(&plain, Options::default());
    let differs = |control: &Control, options: Options| {
        assert_ne!(refined(control, options), base, "{options:?}");
    };
    let with = Options::default;
    differs(&plain, Options { boundary: Boundary::Edge, ..with() });
    let creased = plain.clone().creased(&[[6, 7], [7, 8]], 1.5);
    differs(&creased, with());
    assert_ne!(
        refined(
            &creased.clone().creased(&[[8, 9]], 3.0),
            Options { creasing: Creasing::Chaikin, ..with() }
        ),
        refined(&creased.clone().creased(&[[8, 9]], 3.0), with())
    );
    differs(&plain.clone().cornered(&[12], 2.5), with());
    // Holes change no position; they are flags that children inherit.
    let holed = plain.holed(&[5]);
    let task = Task::new(&holed, Scheme::CatmullClark, Precision::Double);
    let level = OpenSubdiv.refinement(&task, 2).and_then(|it| it.level(2)).expect("a level");
    assert_eq!(level.holes.iter().filter(|&&hole| hole).count(), 16);
}

#[test]
fn face_varying_values_follow_their_seams() {
    let mut control = shapes::grid(2, 1);
    // A seam along the middle edge: eight values on six vertices.
    let values = [[0., 0.], [1., 0.], [1., 1.], [0., 1.], [2., 0.], [3., 0.], [3., 1.], [2., 1.]];
    let channel = Channel { indices: (0..8).collect(), values: values.concat(), width: 2 };
    control.channels.push(channel.clone());
    let mut seen = Vec::new();
    for face_varying in FaceVarying::ALL {
        let options = Options { face_varying, ..Options::default() };
        let task = Task { options, ..Task::new(&control, Scheme::CatmullClark, Precision::Double) };
        let refinement = OpenSubdiv.refinement(&task, 1).expect("a grid");
        assert_eq!(refinement.channel_size(0), Ok(18));
        assert_eq!(refinement.channel_indices(0).expect("indices").len(), 32);
        let kind = Values::FaceVarying { channel: 0 };
        let values = refinement.interpolate(kind, &channel.values, 2).expect("values");
        assert_eq!(values.len(), 36);
        seen.push(values);
    }
    // `Smooth` rounds the corners of both islands, `All` keeps them.
    assert_ne!(seen[0], seen[5]);
}

#[test]
fn varying_values_are_linear() {
    let control = shapes::grid(2, 2);
    let task = Task::new(&control, Scheme::CatmullClark, Precision::Double);
    let refinement = OpenSubdiv.refinement(&task, 1).expect("a grid");
    let height: Vec<f64> = (0..9).map(|v| if v == 4 { 1.0 } else { 0.0 }).collect();
    let varying = refinement.interpolate(Values::Varying, &height, 1).expect("values");
    let vertex = refinement.interpolate(Values::Vertex, &height, 1).expect("values");
    assert!(varying.contains(&1.0) && !vertex.contains(&1.0));
}

#[test]
fn stencils_give_the_refined_positions() {
    let control = shapes::prism(5).rounded();
    for precision in Precision::ALL {
        let task = Task::new(&control, Scheme::CatmullClark, precision);
        let refined = OpenSubdiv.refine(&task, 2).expect("a prism");
        let mut table = Stencils::of_level(&task, 2).expect("a table");
        assert_eq!(table.rows(), refined.vertices());
        table.update().expect("rows");
        let apart = table.positions().expect("positions");
        let apart = apart.iter().zip(&refined.positions).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 4.0 * carvel_peers::normalise::tolerance(precision));
        assert!(table.derivatives().is_err(), "a level has none");
    }
}

#[test]
fn a_table_can_be_made_anew_and_freed() {
    let control = shapes::prism(5);
    let task = Task::new(&control, Scheme::CatmullClark, Precision::Double);
    let mut table = Stencils::of_level(&task, 2).expect("a table");
    table.update().expect("rows");
    let (bytes, before) = (table.bytes(), table.positions().expect("positions"));
    // A size for each row, an index and a weight for each entry; four entries at least.
    assert!(bytes >= table.rows() * (4 + 4 * 12), "{bytes}");
    table.clear();
    assert_eq!(table.bytes(), 0);
    assert!(table.update().is_err());
    table.create().and_then(|()| table.update()).expect("the same table");
    assert_eq!((table.bytes(), table.positions()), (bytes, Ok(before)));
}

#[test]
fn levels_alone_give_the_positions_of_the_whole_call() {
    let (quads, triangles) = (shapes::prism(5).rounded(), shapes::icosahedron().rounded());
    for (scheme, control) in [(Scheme::CatmullClark, &quads), (Scheme::Loop, &triangles)] {
        for precision in Precision::ALL {
            let task = Task::new(control, scheme, precision);
            for level in 0..=3 {
                let refined = OpenSubdiv.refine(&task, level).expect("a closed mesh");
                let mut levels = Stencils::by_levels(&task, level).expect("a refiner");
                levels.update().expect("rows");
                assert_eq!(levels.positions(), Ok(refined.positions), "{scheme:?} {level}");
                assert_eq!(levels.bytes(), 0);
                assert!(levels.create().is_err(), "there is no table");
            }
        }
    }
}

#[test]
fn a_shuffled_mesh_is_the_same_mesh() {
    let control = shapes::torus(7, 5);
    let shuffled = shapes::shuffled(&control);
    let mesh = |it: &Control| PeerMesh {
        sizes: it.sizes.clone(),
        indices: it.indices.clone(),
        positions: it.positions.clone(),
    };
    assert_ne!(shuffled.indices, control.indices);
    let apart = Comparison::through_adjacency(&mesh(&shuffled), &mesh(&control));
    assert!(apart.agrees(Precision::Double), "{apart:?}");
    assert_eq!(shapes::shuffled(&control), shuffled);
}

#[test]
fn limit_stencils_give_points_and_tangents() {
    let control = shapes::cube();
    let task = Task::new(&control, Scheme::CatmullClark, Precision::Double);
    let mut table =
        Stencils::of_limit(&task, 4, &[0, 5], &[[0.0, 0.0], [0.5, 0.5]]).expect("a table");
    table.update().expect("rows");
    let points = table.positions().expect("points");
    // A corner of valence 3: (9 v + 4 times its neighbours + the face diagonals) / 24,
    // so -1/2 of the cube's coordinates at -1, as neighbours add -1 and diagonals +1.
    for x in &points[..3] {
        assert!((x + 0.5).abs() < 1e-12, "{points:?}");
    }
    let [along_s, along_t] = table.derivatives().expect("a limit table has them");
    let dot: f64 = along_s[3..].iter().zip(&along_t[3..]).map(|(a, b)| a * b).sum();
    assert!(dot.abs() < 1e-12, "the middle of a face of the cube: {along_s:?} {along_t:?}");
}
