//! Files on disk: what is replaced, what is left alone, what is reported.

use carvel::ErrorKind;
use carvel::io::{self, Format, MeshFile, ReadOptions, WriteOptions};
use std::cell::Cell;
use std::fs;
use std::path::Path;

fn mesh() -> MeshFile {
    MeshFile { positions: vec![[1.0, 2.0, 3.0]], ..MeshFile::default() }
}

/// Too large for one buffer, so that writing reaches the file before its end.
fn large() -> MeshFile {
    MeshFile { positions: vec![[1.0, 2.0, 3.0]; 500_000], ..MeshFile::default() }
}

fn entries(directory: &Path) -> usize {
    fs::read_dir(directory).unwrap().count()
}

fn write(path: &Path, mesh: &MeshFile) -> carvel::Result<()> {
    io::write(path, mesh, &WriteOptions::default())
}

#[test]
fn formats_go_by_extension() {
    let directory = tempfile::tempdir().unwrap();
    for format in Format::ALL {
        let path = directory.path().join(format!("a.{}", format.name().to_uppercase()));
        write(&path, &mesh()).unwrap();
        let back = io::read(&path, &ReadOptions::default()).unwrap();
        assert_eq!(back.positions.len(), usize::from(format != Format::Stl));
    }
    assert_eq!(entries(directory.path()), 4, "no temporary files");
    for (path, message) in [
        ("a.xyz", "a.xyz: 'xyz' is not a known format (obj, off, ply or stl)"),
        ("a", "a: no extension says which format this is (obj, off, ply or stl)"),
    ] {
        let error = io::read(Path::new(path), &ReadOptions::default()).unwrap_err();
        assert_eq!((error.kind(), error.to_string().as_str()), (ErrorKind::Unsupported, message));
    }
}

#[test]
fn what_cannot_be_opened_says_why() {
    let directory = tempfile::tempdir().unwrap();
    let folder = directory.path().join("folder.obj");
    fs::create_dir(&folder).unwrap();
    for error in [
        io::read(&folder, &ReadOptions::default()).unwrap_err(),
        write(&folder, &mesh()).unwrap_err(),
    ] {
        assert_eq!(error.kind(), ErrorKind::Io);
        assert!(error.to_string().ends_with("folder.obj: is a directory"), "{error}");
    }
    let none = directory.path().join("none\n/a.obj");
    for error in
        [io::read(&none, &ReadOptions::default()).unwrap_err(), write(&none, &mesh()).unwrap_err()]
    {
        assert_eq!(error.kind(), ErrorKind::Io);
        assert!(error.to_string().contains(r"none\n/a.obj: No such file"), "{error}");
        assert_eq!(error.to_string().lines().count(), 1);
    }
}

#[test]
fn a_failed_or_cancelled_run_leaves_the_old_file() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.obj");
    fs::write(&path, "old").unwrap();
    let stop = |bytes: u64, _: Option<u64>| bytes < 1 << 20;
    let options = WriteOptions { progress: Some(&stop), ..WriteOptions::default() };
    let error = io::write(&path, &large(), &options).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    let bad = MeshFile { positions: vec![[f64::NAN; 3]], ..MeshFile::default() };
    assert_eq!(write(&path, &bad).unwrap_err().kind(), ErrorKind::NotFinite);
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(entries(directory.path()), 1, "no temporary files");
}

#[test]
fn progress_is_told_and_can_stop_a_read() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.obj");
    let seen = Cell::new((0, 0, None));
    let count = |bytes, total| {
        seen.set((seen.get().0 + 1, bytes, total));
        true
    };
    let options = WriteOptions { progress: Some(&count), ..WriteOptions::default() };
    io::write(&path, &large(), &options).unwrap();
    let size = fs::metadata(&path).unwrap().len();
    assert!(seen.get().0 > 4 && seen.get().1 == size);
    seen.set((0, 0, None));
    let options = ReadOptions { progress: Some(&count), ..ReadOptions::default() };
    io::read(&path, &options).unwrap();
    assert!(seen.get().0 > 4 && seen.get().1 == size && seen.get().2 == Some(size));
    let stop = |bytes: u64, _: Option<u64>| bytes < 1 << 20;
    let options = ReadOptions { progress: Some(&stop), ..ReadOptions::default() };
    assert_eq!(io::read(&path, &options).unwrap_err().kind(), ErrorKind::Cancelled);
}

#[test]
fn broken_meshes_are_not_written() {
    let triangle = MeshFile {
        positions: vec![[0.0; 3]; 3],
        face_sizes: vec![3],
        face_vertices: vec![0, 1, 2],
        ..MeshFile::default()
    };
    let broken = |change: fn(&mut MeshFile)| {
        let mut mesh = triangle.clone();
        change(&mut mesh);
        let options = WriteOptions::default();
        io::write_to(Vec::new(), Format::Obj, &mesh, &options).unwrap_err().kind()
    };
    assert_eq!(broken(|m| m.face_vertices[0] = 3), ErrorKind::IndexOutOfRange);
    assert_eq!(broken(|m| m.face_sizes[0] = 2), ErrorKind::FaceTooSmall);
    assert_eq!(broken(|m| m.face_sizes[0] = 4), ErrorKind::LengthMismatch);
    assert_eq!(broken(|m| m.face_uvs = Some(vec![0, 0, 0])), ErrorKind::IndexOutOfRange);
    assert_eq!(broken(|m| m.groups.of_face = vec![0]), ErrorKind::IndexOutOfRange);
    assert_eq!(broken(|m| m.groups.of_face = vec![0; 2]), ErrorKind::LengthMismatch);
    assert_eq!(broken(|m| m.material_libraries.push("a\nf 1".into())), ErrorKind::InvalidText);
    assert_eq!(broken(|m| m.normals.push([f64::INFINITY; 3])), ErrorKind::NotFinite);
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

    #[test]
    fn permissions_and_links_are_kept() {
        let directory = tempfile::tempdir().unwrap();
        let (path, link) = (directory.path().join("a.obj"), directory.path().join("link.obj"));
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("a.obj", &link).unwrap();
        write(&link, &mesh()).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&path).unwrap(), "v 1 2 3\n");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        // A link to nothing yet makes what it points to.
        let dangling = directory.path().join("dangling.obj");
        symlink("b.obj", &dangling).unwrap();
        write(&dangling, &mesh()).unwrap();
        assert!(fs::symlink_metadata(directory.path().join("b.obj")).unwrap().is_file());
        let round = directory.path().join("round.obj");
        symlink("round.obj", &round).unwrap();
        assert_eq!(write(&round, &mesh()).unwrap_err().kind(), ErrorKind::Io);
    }

    #[test]
    fn new_files_get_the_usual_permissions() {
        let directory = tempfile::tempdir().unwrap();
        let (ours, usual) = (directory.path().join("a.obj"), directory.path().join("usual"));
        write(&ours, &mesh()).unwrap();
        fs::write(&usual, "").unwrap();
        let mode = |path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(ours), mode(usual));
    }

    #[test]
    fn devices_are_written_directly() {
        let path = Path::new("/dev/null");
        let options = WriteOptions { format: Some(Format::Ply), ..WriteOptions::default() };
        io::write(path, &mesh(), &options).unwrap();
        assert!(fs::metadata(path).unwrap().file_type().is_char_device());
    }
}
