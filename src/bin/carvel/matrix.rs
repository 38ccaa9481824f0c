//! Stencil tables as files: for SciPy, as text, in the library's own format.

use crate::args::MatrixFormat;
use carvel::base::Scalar;
use carvel::sparse::StoredScalar;
use carvel::{Error, Result, StencilTable};
use npyz::npz::NpzWriter;
use npyz::{AutoSerialize, DType, Serialize, WriterBuilder, zip};
use std::io::{self, Seek, Write};

/// Numbers that all formats can hold.
pub trait Entry: Scalar + StoredScalar + AutoSerialize + Serialize + ryu::Float {}

impl Entry for f32 {}
impl Entry for f64 {}

/// Writes a table.
pub fn write<T: Entry>(
    table: &StencilTable<T>,
    format: MatrixFormat,
    out: &mut (impl Write + Seek),
) -> Result<()> {
    let written = match format {
        MatrixFormat::Npz => npz(table, out),
        MatrixFormat::Mtx => mtx(table, out),
        MatrixFormat::Carvel => return table.write(out),
    };
    written.map_err(|e| Error::io("matrix", e))
}

/// What `scipy.sparse.load_npz` reads: the arrays of a CSR matrix in a zip archive.
fn npz<T: Entry>(table: &StencilTable<T>, out: &mut (impl Write + Seek)) -> io::Result<()> {
    let mut archive = NpzWriter::new(out);
    let kind = "|S3".parse().map_err(io::Error::other)?;
    let options = zip::write::FileOptions::default;
    let mut format = archive
        .array::<Vec<u8>>("format", options())?
        .dtype(DType::Plain(kind))
        .shape(&[])
        .begin_nd()?;
    format.push(&b"csr".to_vec())?;
    format.finish()?;
    let shape = [table.rows(), table.columns()].map(|n| n as i64);
    array(&mut archive, "shape", shape)?;
    array(&mut archive, "indptr", table.offsets().iter().map(|&at| i64::from(at)))?;
    // SciPy takes the type of both index arrays to be one.
    array(&mut archive, "indices", table.indices().iter().map(|&i| i64::from(i)))?;
    array(&mut archive, "data", table.weights().iter().copied())
}

fn array<T: AutoSerialize>(
    archive: &mut NpzWriter<impl Write + Seek>,
    name: &str,
    values: impl IntoIterator<Item = T, IntoIter: ExactSizeIterator>,
) -> io::Result<()> {
    let values = values.into_iter();
    let options = zip::write::FileOptions::default().large_file(true);
    let mut writer = archive
        .array::<T>(name, options)?
        .default_dtype()
        .shape(&[values.len() as u64])
        .begin_nd()?;
    for value in values {
        writer.push(&value)?;
    }
    writer.finish()
}

/// Matrix Market: a line per weight with as many digits as bring it back.
fn mtx<T: Entry>(table: &StencilTable<T>, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "%%MatrixMarket matrix coordinate real general")?;
    writeln!(out, "{} {} {}", table.rows(), table.columns(), table.entries())?;
    let mut digits = ryu::Buffer::new();
    for row in 0..table.rows() {
        let (indices, weights) = table.row(row);
        for (&column, &weight) in indices.iter().zip(weights) {
            writeln!(out, "{} {} {}", row + 1, u64::from(column) + 1, digits.format(weight))?;
        }
    }
    Ok(())
}
