//! The bytes of a mesh file, unpacked.

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use flate2::read::MultiGzDecoder;
use std::io::Read;
use std::path::Path;

const GZIP_MAGIC: [u8; 2] = [0x1f, 0x8b];

/// How many times its packed size a gzipped file may have, beyond [`MAX_UNPACKED_FREE`]. Text of random numbers
/// packs to a third, and an endless row of zeros to a thousandth.
const MAX_RATIO: u64 = 256;

/// Bytes that any gzipped file may unpack to.
const MAX_UNPACKED_FREE: u64 = 64 << 20;

/// Reads a file; gzip is recognised by its first bytes, whatever the name.
pub(super) fn read(path: &Path) -> Result<Vec<u8>> {
    let bytes = std::fs::read(path).map_err(|error| Error::reading(path, &error))?;
    if bytes.starts_with(&GZIP_MAGIC) { unpack(path, &bytes) } else { Ok(bytes) }
}

fn unpack(path: &Path, packed: &[u8]) -> Result<Vec<u8>> {
    let limit = MAX_UNPACKED_FREE + MAX_RATIO * packed.len() as u64;
    let mut bytes = Vec::with_capacity(size_hint(packed, limit));
    let unpacked = MultiGzDecoder::new(packed).take(limit + 1).read_to_end(&mut bytes);
    let wrong = |message: String| Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path)));
    unpacked.map_err(|error| wrong(format!("the gzip data are damaged or cut short: {error}")))?;
    if bytes.len() as u64 > limit {
        let error = wrong(format!("unpacks to more than {limit} bytes, {MAX_RATIO} times its size: refused"));
        return Err(error.note("unpack it with gunzip if it is what it should be"));
    }
    Ok(bytes)
}

/// The last four bytes of a gzip file hold the unpacked size; believed only as far as packing usually goes.
fn size_hint(packed: &[u8], limit: u64) -> usize {
    let Some(size) = packed.last_chunk::<4>() else { return 0 };
    let believable = limit.min(packed.len() as u64 * 8);
    u64::from(u32::from_le_bytes(*size)).min(believable) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::GzEncoder;
    use std::io::Write;

    fn packed(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn gzip_is_told_by_content_and_may_have_several_members() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("mesh.ply");
        std::fs::write(&path, [packed(b"ply\n"), packed(b"format")].concat()).unwrap();
        assert_eq!(read(&path).unwrap(), b"ply\nformat");
    }

    #[test]
    fn bombs_and_broken_files_are_refused() {
        let path = Path::new("bomb.ply.gz");
        let bomb = packed(&vec![0; 200 << 20]);
        let message = unpack(path, &bomb).unwrap_err().to_string();
        assert!(message.starts_with("bomb.ply.gz: unpacks to more than"), "{message}");
        let mut cut = packed(b"ply\nformat ascii 1.0\n");
        cut.truncate(20);
        let message = unpack(path, &cut).unwrap_err().to_string();
        assert!(message.starts_with("bomb.ply.gz: the gzip data are damaged or cut short"), "{message}");
    }
}
