//! Tests of the file formats.

mod files;
mod formats;
mod hostile;
mod obj;
mod tags;
