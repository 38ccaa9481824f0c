//! Tells the two kinds of STL apart.

use super::{ascii, binary};
use crate::base::{Error, Result};
use crate::io::MeshFile;
use crate::io::watch::Watch;
use std::io::{BufRead, Cursor, Read};

/// Bytes looked at to tell text from binary.
const HEAD: u64 = 1024;

pub(in crate::io) fn read(
    mut reader: impl BufRead,
    name: &str,
    watch: Watch<'_>,
) -> Result<MeshFile> {
    let mut head = Vec::new();
    reader.by_ref().take(HEAD).read_to_end(&mut head).map_err(|e| Error::io(name, e))?;
    let total = if (head.len() as u64) < HEAD { Some(head.len() as u64) } else { watch.total() };
    let text = is_text(&head, total);
    let reader = Cursor::new(head).chain(reader);
    if text { ascii::read(reader, name, watch) } else { binary::read(reader, name, watch) }
}

/// The size decides where it is known and right for a binary file; many binary
/// headers begin with `solid`, but few hold text only up to the 1024th byte.
fn is_text(head: &[u8], total: Option<u64>) -> bool {
    let count = head.get(80..84).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    if count.is_some_and(|n| total == Some(binary::size(n))) {
        return false;
    }
    let control = |&b: &u8| b.is_ascii_control() && !b.is_ascii_whitespace();
    let word = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start();
    let solid = word.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    word.is_empty() || solid && !head.iter().any(control)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_decides() {
        let mut binary = b"solid of a misleading exporter".to_vec();
        binary.resize(80, b' ');
        binary.extend(1_u32.to_le_bytes());
        binary.resize(134, b' ');
        assert!(!is_text(&binary, Some(134)));
        assert!(!is_text(&binary, None), "the count has control characters");
        assert!(is_text(b" solid a\nfacet", None));
        assert!(!is_text(b"sold a\nfacet", None));
        assert!(is_text(b"", Some(0)));
    }
}
