//! Where results go, settled before any work is done.

use crate::exit::{Exit, Failure};
use crate::text::one_line;
use carvel::io::Format;
use std::path::{Path, PathBuf};

/// One input and where its results go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Job {
    /// The mesh file to read.
    pub input: PathBuf,
    /// The mesh file to write.
    pub output: PathBuf,
    /// The format to write it in.
    pub format: Format,
    /// The picture to write.
    pub picture: Option<PathBuf>,
    /// The directories to create if they are missing.
    pub directories: Vec<PathBuf>,
}

/// What was asked for.
#[derive(Debug, Clone, Copy)]
pub struct Wish<'a> {
    /// The inputs.
    pub inputs: &'a [PathBuf],
    /// The argument of `--output`.
    pub output: &'a Path,
    /// The argument of `--format`.
    pub format: Option<Format>,
    /// The argument of `--preview`.
    pub picture: Option<&'a Path>,
}

/// The jobs of a wish.
///
/// # Errors
/// A usage error if two results would get one name, a result would replace an
/// input whose name it keeps, or no format is known; an output error for a
/// directory that is not there.
pub fn plan(wish: &Wish) -> Result<Vec<Job>, Failure> {
    let mut jobs = Vec::new();
    for input in wish.inputs {
        let mut directories = Vec::new();
        let (output, format) = output_of(wish, input, &mut directories)?;
        let picture = wish.picture.map(|path| picture_of(wish, path, input, &mut directories));
        let picture = picture.transpose()?;
        jobs.push(Job { input: input.clone(), output, format, picture, directories });
    }
    refuse_shared_names(&jobs)?;
    refuse_replacing_inputs(&jobs)?;
    Ok(jobs)
}

/// Checks the name of a picture.
pub fn check_picture(path: &Path) -> Result<(), Failure> {
    let png = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if png || is_stream(path) || path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir()) {
        return require_parent(path);
    }
    Err(Failure::usage(format!("{}: pictures are PNG, so call it something.png", shown(path))))
}

fn output_of(
    wish: &Wish,
    input: &Path,
    directories: &mut Vec<PathBuf>,
) -> Result<(PathBuf, Format), Failure> {
    let fail = |e: carvel::Error| Failure::usage(format!("{e}; --format chooses one"));
    let path = wish.output;
    if is_stream(path) && wish.inputs.len() == 1 {
        return Ok((path.to_path_buf(), wish.format.unwrap_or(Format::Obj)));
    }
    if !is_directory(path, wish.inputs.len())? {
        require_parent(path)?;
        let format = wish.format.map_or_else(|| Format::from_path(path), Ok).map_err(fail)?;
        return Ok((path.to_path_buf(), format));
    }
    directories.push(path.to_path_buf());
    let name = file_name(input)?;
    if let Some(format) = wish.format {
        return Ok((path.join(name).with_extension(format.name()), format));
    }
    Ok((path.join(name), Format::from_path(input).map_err(fail)?))
}

fn picture_of(
    wish: &Wish,
    path: &Path,
    input: &Path,
    directories: &mut Vec<PathBuf>,
) -> Result<PathBuf, Failure> {
    if is_stream(path) && is_stream(wish.output) {
        return Err(Failure::usage("mesh and picture cannot both go to the standard output"));
    }
    if (is_stream(path) && wish.inputs.len() == 1) || !is_directory(path, wish.inputs.len())? {
        check_picture(path)?;
        return Ok(path.to_path_buf());
    }
    directories.push(path.to_path_buf());
    Ok(path.join(file_name(input)?).with_extension("png"))
}

/// True if a path stands for a directory in which names are kept.
fn is_directory(path: &Path, inputs: usize) -> Result<bool, Failure> {
    let slash = path.as_os_str().as_encoded_bytes().ends_with(b"/");
    // The components leave the slash out, with which a file does not exist.
    if path.is_dir() || (slash && !path.components().as_path().exists()) {
        return Ok(true);
    }
    if slash {
        return Err(Failure::new(Exit::Output, format!("{}: not a directory", shown(path))));
    }
    if inputs == 1 {
        return Ok(false);
    }
    if path.exists() || is_stream(path) || path.extension().is_some() {
        let name = shown(path);
        let message = format!("{name}: several inputs need a directory, such as {name}/");
        return Err(Failure::usage(if is_stream(path) {
            "several inputs need a directory, not the standard output".to_owned()
        } else {
            message
        }));
    }
    Ok(true)
}

/// The name that a result keeps.
fn file_name(input: &Path) -> Result<&Path, Failure> {
    if is_stream(input) {
        let message = "the standard input has no name to keep: -o must be a file or -";
        return Err(Failure::usage(message));
    }
    let name = input.file_name().map(Path::new);
    name.ok_or_else(|| Failure::usage(format!("{}: not the name of a file", shown(input))))
}

/// Refuses a place in a directory that is not there.
pub fn require_parent(path: &Path) -> Result<(), Failure> {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() && !parent.is_dir() => {
            let message = format!("{}: there is no directory {}", shown(path), shown(parent));
            Err(Failure::new(Exit::Output, message))
        }
        _ => Ok(()),
    }
}

fn refuse_shared_names(jobs: &[Job]) -> Result<(), Failure> {
    let mut seen: Vec<(&Path, &Path)> = Vec::new();
    for job in jobs {
        seen.push((&job.output, &job.input));
        seen.extend(job.picture.as_deref().map(|picture| (picture, &*job.input)));
    }
    seen.sort_by_key(|(result, _)| *result);
    let twice = seen.windows(2).find(|pair| pair[0].0 == pair[1].0 && !is_stream(pair[0].0));
    twice.map_or(Ok(()), |pair| {
        let [result, first, second] = [pair[0].0, pair[0].1, pair[1].1].map(shown);
        let message = if first == second && jobs.len() > 1 {
            format!("{result}: {first} is given twice")
        } else if first == second {
            format!("{result}: both the mesh and the picture would get this name")
        } else {
            format!("{result}: both {first} and {second} would get this name")
        };
        Err(Failure::usage(message))
    })
}

/// A directory that holds the inputs is the one in which results with the same
/// names would destroy them.
fn refuse_replacing_inputs(jobs: &[Job]) -> Result<(), Failure> {
    let inputs: Vec<_> = jobs.iter().filter_map(|job| job.input.canonicalize().ok()).collect();
    let kept = jobs.iter().filter(|job| !job.directories.is_empty());
    let mut existing = kept.filter_map(|job| Some((job, job.output.canonicalize().ok()?)));
    existing.find(|(_, output)| inputs.contains(output)).map_or(Ok(()), |(job, _)| {
        let message = format!("{}: this input would be replaced", shown(&job.output));
        Err(Failure::usage(message + "; name another directory"))
    })
}

/// True for a standard stream.
pub fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn shown(path: &Path) -> String {
    one_line(&path.display().to_string())
}
