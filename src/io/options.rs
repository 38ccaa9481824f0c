//! What a caller can choose when reading and writing.

use super::Format;
use std::fmt;

/// A progress hook: bytes done, bytes in all where known; false cancels.
pub type Progress<'a> = &'a dyn Fn(u64, Option<u64>) -> bool;

/// Options of [`read`](super::read()).
#[derive(Clone, Copy, Default)]
pub struct ReadOptions<'a> {
    /// The format; `None` goes by the extension.
    pub format: Option<Format>,
    /// Called about once per mebibyte.
    pub progress: Option<Progress<'a>>,
}

/// Options of [`write`](super::write()).
#[derive(Clone, Copy, Default)]
pub struct WriteOptions<'a> {
    /// The format; `None` goes by the extension.
    pub format: Option<Format>,
    /// The type that numbers are written in.
    pub precision: Precision,
    /// Text or binary, where the format has both.
    pub encoding: Encoding,
    /// Called about once per mebibyte.
    pub progress: Option<Progress<'a>>,
}

/// The number type of written coordinates.
///
/// Text gets the shortest digits that read back as the same number of that
/// type; binary PLY gets `float` or `double`. STL is `float` when binary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// Rounded to single precision.
    F32,
    /// Double precision, exactly as in memory.
    #[default]
    F64,
}

/// How PLY and STL are written; OBJ and OFF are always text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Encoding {
    /// Binary, least significant byte first.
    #[default]
    Binary,
    /// Binary, most significant byte first; PLY only.
    BinaryBigEndian,
    /// Text.
    Ascii,
}

impl fmt::Debug for ReadOptions<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ReadOptions").field("format", &self.format).finish_non_exhaustive()
    }
}

impl fmt::Debug for WriteOptions<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("WriteOptions")
            .field("format", &self.format)
            .field("precision", &self.precision)
            .field("encoding", &self.encoding)
            .finish_non_exhaustive()
    }
}
