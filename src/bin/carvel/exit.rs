//! Exit codes, and which mistake has which.

use carvel::{Error, ErrorKind};
use std::error::Error as _;
use std::process::ExitCode;

/// How a run of the command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// Everything asked for was done.
    Success = 0,
    /// The command or the library is at fault.
    Internal = 1,
    /// The command line asks for what does not exist.
    Usage = 2,
    /// An input cannot be read, or its content breaks its format.
    Input = 3,
    /// A mesh is no orientable 2-manifold, or not what an option or the scheme asks for.
    Mesh = 4,
    /// A coordinate is no finite number, or leaves the range of the precision.
    Values = 5,
    /// The result fits neither the memory nor the index type.
    Size = 6,
    /// An output cannot be written.
    Output = 7,
    /// The run was interrupted.
    Cancelled = 8,
}

/// The codes as the help shows them.
pub const HELP: &str = "\
Exit codes:
  0  success
  1  internal error
  2  wrong usage
  3  an input cannot be read or parsed
  4  a mesh is defective: no faces, an index out of range, not manifold, ...
     or the scheme has no rule for it, such as Loop for other faces than triangles
  5  values: a coordinate that is not finite or overflows
  6  size: the memory ceiling, the system's memory or 32-bit indices
  7  an output cannot be written
  8  interrupted (Ctrl-C); no partial output is left
With several inputs the others are still worked on, and the code is that of the
first that failed.";

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// What was being done when something went wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Doing {
    /// Understanding the command line.
    Asking,
    /// Reading an input.
    Reading,
    /// Building, refining, drawing.
    Working,
    /// Writing an output.
    Writing,
}

impl Exit {
    /// The code of an error of the library.
    pub fn of(kind: ErrorKind, doing: Doing) -> Self {
        use ErrorKind as K;
        match kind {
            K::IndexOutOfRange
            | K::FaceTooSmall
            | K::RepeatedVertex
            | K::InconsistentOrientation
            | K::NonManifoldEdge
            | K::NonManifoldVertex
            | K::NotAnchored
            | K::InvalidTag => Self::Mesh,
            K::NotFinite | K::Overflow => Self::Values,
            K::TooLarge | K::MemoryCeiling | K::OutOfResources => Self::Size,
            K::ParameterOutOfRange | K::InvalidText => Self::Usage,
            K::Cancelled => Self::Cancelled,
            // The scheme has no rule for the mesh.
            K::Unsupported if doing == Doing::Working => Self::Mesh,
            K::Io | K::Syntax | K::Unsupported => Self::of_file(doing),
            _ => Self::Internal,
        }
    }

    fn of_file(doing: Doing) -> Self {
        match doing {
            Doing::Asking => Self::Usage,
            Doing::Reading => Self::Input,
            Doing::Working => Self::Internal,
            Doing::Writing => Self::Output,
        }
    }
}

/// Why a run, or the work on one input, failed: one line and an exit code.
#[derive(Debug, Clone)]
pub struct Failure {
    /// The exit code.
    pub exit: Exit,
    /// One line, without the command's name.
    pub message: String,
    /// The library's kind of error, if the library found it.
    pub kind: Option<ErrorKind>,
    /// Nobody listens any more: the reader of our output went away.
    pub silent: bool,
}

impl Failure {
    /// A command line that cannot be followed.
    pub fn usage(message: impl Into<String>) -> Self {
        Self::new(Exit::Usage, message)
    }

    /// A failure that the command found itself.
    pub fn new(exit: Exit, message: impl Into<String>) -> Self {
        Self { exit, message: message.into(), kind: None, silent: false }
    }

    /// An error of the library.
    pub fn from_error(error: &Error, doing: Doing) -> Self {
        let pipe_closed = doing == Doing::Writing && is_broken_pipe(error);
        Self {
            exit: if pipe_closed { Exit::Success } else { Exit::of(error.kind(), doing) },
            message: error.to_string(),
            kind: Some(error.kind()),
            silent: pipe_closed,
        }
    }
}

/// True if a reader such as `head` closed its end: it has what it wants.
fn is_broken_pipe(error: &Error) -> bool {
    let source = error.source().and_then(|s| s.downcast_ref::<std::io::Error>());
    source.is_some_and(|e| e.kind() == std::io::ErrorKind::BrokenPipe)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_go_by_what_was_being_done() {
        for (doing, exit) in [
            (Doing::Asking, Exit::Usage),
            (Doing::Reading, Exit::Input),
            (Doing::Writing, Exit::Output),
        ] {
            assert_eq!(Exit::of(ErrorKind::Io, doing), exit);
            assert_eq!(Exit::of(ErrorKind::Unsupported, doing), exit);
        }
        assert_eq!(Exit::of(ErrorKind::Unsupported, Doing::Working), Exit::Mesh);
    }

    #[test]
    fn every_other_kind_has_one_code() {
        for (kind, exit) in [
            (ErrorKind::IndexOutOfRange, Exit::Mesh),
            (ErrorKind::NonManifoldVertex, Exit::Mesh),
            (ErrorKind::NotAnchored, Exit::Mesh),
            (ErrorKind::NotFinite, Exit::Values),
            (ErrorKind::Overflow, Exit::Values),
            (ErrorKind::TooLarge, Exit::Size),
            (ErrorKind::MemoryCeiling, Exit::Size),
            (ErrorKind::Cancelled, Exit::Cancelled),
            (ErrorKind::ParameterOutOfRange, Exit::Usage),
            (ErrorKind::BrokenInvariant, Exit::Internal),
            (ErrorKind::LengthMismatch, Exit::Internal),
        ] {
            for doing in [Doing::Reading, Doing::Working, Doing::Writing] {
                assert_eq!(Exit::of(kind, doing), exit, "{kind:?}");
            }
        }
    }

    #[test]
    fn a_closed_pipe_is_quiet_on_writing_only() {
        let closed = || Error::io("standard output", std::io::ErrorKind::BrokenPipe.into());
        assert!(Failure::from_error(&closed(), Doing::Writing).silent);
        assert!(!Failure::from_error(&closed(), Doing::Reading).silent);
    }
}
