//! Tables in files.
//!
//! # Format
//! All numbers are little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `CARVELST` |
//! | 4 | version, 1 |
//! | 4 | bytes of a weight, 4 or 8 |
//! | 8 × 3 | rows, columns, entries |
//! | 4 × (rows + 1) | where the entries of each row begin |
//! | 4 × entries | columns |
//! | (4 or 8) × entries | weights |
//! | 4 | CRC-32 (IEEE) of everything before |
//!
//! Nothing may follow. A reader allocates as the bytes come, so that a header that
//! promises too much costs nothing.

use super::StencilTable;
use super::table::check_size;
use crate::base::{Element, Error, ErrorKind, Result, Scalar, memory};
use crc32fast::Hasher;
use std::io::{self, Read, Write};

const MAGIC: [u8; 8] = *b"CARVELST";
const VERSION: u32 = 1;
/// Bytes that are converted at a time.
const BLOCK: usize = 1 << 16;

/// A table as a file holds it, in either number type.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum StoredTable {
    /// Weights in single precision.
    F32(StencilTable<f32>),
    /// Weights in double precision.
    F64(StencilTable<f64>),
}

impl StoredTable {
    /// Reads a table that [`StencilTable::write`] wrote, to the end of the stream.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`], naming the byte, for what is no such file, cut off, changed
    /// or followed by something; [`ErrorKind::Unsupported`] for a later version;
    /// [`ErrorKind::Io`]; [`ErrorKind::OutOfResources`].
    pub fn read(stream: impl Read) -> Result<Self> {
        let mut input = Input { stream, sum: Hasher::new(), at: 0 };
        let header = Header::read(&mut input)?;
        Ok(match header.width {
            4 => Self::F32(header.table(&mut input, f32::from_le_bytes)?),
            _ => Self::F64(header.table(&mut input, f64::from_le_bytes)?),
        })
    }
}

/// The number types that files hold.
pub trait StoredScalar: Scalar {
    /// Bytes as a file has them.
    #[doc(hidden)]
    type Bytes: AsRef<[u8]>;

    /// A number as a file has it.
    #[doc(hidden)]
    fn stored(self) -> Self::Bytes;
}

impl StoredScalar for f32 {
    type Bytes = [u8; 4];

    fn stored(self) -> Self::Bytes {
        self.to_le_bytes()
    }
}

impl StoredScalar for f64 {
    type Bytes = [u8; 8];

    fn stored(self) -> Self::Bytes {
        self.to_le_bytes()
    }
}

impl<T: StoredScalar> StencilTable<T> {
    /// Writes the table in a format of its own, with a version and a checksum.
    ///
    /// # Errors
    /// [`ErrorKind::Io`].
    pub fn write(&self, stream: impl Write) -> Result<()> {
        self.write_all(stream).map_err(|error| Error::io("stencil table", error))
    }

    fn write_all(&self, stream: impl Write) -> io::Result<()> {
        let mut out = Output { stream, sum: Hasher::new(), block: Vec::with_capacity(BLOCK) };
        out.put(&MAGIC)?;
        out.put(&VERSION.to_le_bytes())?;
        out.put(&(T::BYTES as u32).to_le_bytes())?;
        for count in [self.rows(), self.columns(), self.entries()] {
            out.put(&(count as u64).to_le_bytes())?;
        }
        self.offsets().iter().try_for_each(|offset| out.put(&offset.to_le_bytes()))?;
        self.indices().iter().try_for_each(|index| out.put(&index.to_le_bytes()))?;
        self.weights().iter().try_for_each(|weight| out.put(weight.stored().as_ref()))?;
        out.finish()
    }
}

struct Output<W> {
    stream: W,
    sum: Hasher,
    block: Vec<u8>,
}

impl<W: Write> Output<W> {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        if self.block.len() + bytes.len() > BLOCK {
            self.flush()?;
        }
        self.block.extend_from_slice(bytes);
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.sum.update(&self.block);
        self.stream.write_all(&self.block)?;
        self.block.clear();
        Ok(())
    }

    fn finish(mut self) -> io::Result<()> {
        self.flush()?;
        self.stream.write_all(&self.sum.finalize().to_le_bytes())?;
        self.stream.flush()
    }
}

struct Input<R> {
    stream: R,
    sum: Hasher,
    at: u64,
}

impl<R: Read> Input<R> {
    fn fill(&mut self, bytes: &mut [u8]) -> Result<()> {
        self.stream.read_exact(bytes).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => self.broken("the file is cut off"),
            _ => Error::io("stencil table", error),
        })?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N]> {
        let mut bytes = [0; N];
        self.fill(&mut bytes)?;
        self.sum.update(&bytes);
        Ok(bytes)
    }

    fn broken(&self, what: &str) -> Error {
        let message = format!("byte {}: {what}: no stencil table", self.at);
        Error::new(ErrorKind::Syntax, message).with_elements([Element::Byte(self.at)])
    }

    /// An array of numbers of `N` bytes.
    fn array<T: Copy, const N: usize>(
        &mut self,
        len: usize,
        number: impl Fn([u8; N]) -> T,
    ) -> Result<Vec<T>> {
        let mut list = Vec::new();
        let mut block = memory::filled(0, BLOCK.min(len.saturating_mul(N)))?;
        while list.len() < len {
            let bytes = (len - list.len()).saturating_mul(N).min(block.len());
            let block = &mut block[..bytes];
            self.fill(block)?;
            self.sum.update(block);
            memory::grow(&mut list, bytes / N)?;
            list.extend(block.as_chunks::<N>().0.iter().map(|&bytes| number(bytes)));
        }
        Ok(memory::fitted(list))
    }

    /// The end: a checksum that fits, and nothing more.
    fn end(&mut self) -> Result<()> {
        let sum = self.sum.clone().finalize();
        let mut bytes = [0; 4];
        self.fill(&mut bytes)?;
        if u32::from_le_bytes(bytes) != sum {
            return Err(self.broken("the checksum does not fit"));
        }
        match self.stream.read(&mut [0]) {
            Ok(0) => Ok(()),
            Ok(_) => Err(self.broken("something follows")),
            Err(error) => Err(Error::io("stencil table", error)),
        }
    }
}

struct Header {
    width: u32,
    rows: usize,
    columns: usize,
    entries: usize,
}

impl Header {
    fn read<R: Read>(input: &mut Input<R>) -> Result<Self> {
        if input.take()? != MAGIC {
            return Err(input.broken("the first bytes are others"));
        }
        let version = u32::from_le_bytes(input.take()?);
        if version != VERSION {
            let message = format!("a stencil table of version {version}: only {VERSION} is known");
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
        let width = u32::from_le_bytes(input.take()?);
        if width != 4 && width != 8 {
            return Err(input.broken("weights of neither 4 nor 8 bytes"));
        }
        let mut count = |what| -> Result<usize> {
            let n = u64::from_le_bytes(input.take()?);
            let n = usize::try_from(n).unwrap_or(usize::MAX);
            check_size(what, n).map_err(|_| input.broken("a size that no table has"))?;
            Ok(n)
        };
        let (rows, columns, entries) = (count("rows")?, count("columns")?, count("entries")?);
        Ok(Self { width, rows, columns, entries })
    }

    fn table<T: Scalar, R: Read, const N: usize>(
        &self,
        input: &mut Input<R>,
        weight: impl Fn([u8; N]) -> T,
    ) -> Result<StencilTable<T>> {
        let offsets = input.array(self.rows + 1, u32::from_le_bytes)?;
        let indices = input.array(self.entries, u32::from_le_bytes)?;
        let weights = input.array(self.entries, weight)?;
        input.end()?;
        let ends = [offsets.first(), offsets.last()].map(|end| end.map(|&end| end as usize));
        if ends != [Some(0), Some(self.entries)] || !offsets.is_sorted() {
            return Err(input.broken("rows out of order"));
        }
        let table = StencilTable::from_parts(self.columns as u32, offsets, indices, weights);
        table.check_entries().map_err(|error| input.broken(&error.to_string()))?;
        Ok(table)
    }
}
