//! Depths from an `.npy` file as feimos writes it.

use crate::Result;
use std::path::Path;

/// Row by row from the top; infinite where nothing is hit.
pub(super) fn read_depths(path: &Path) -> Result<Vec<f32>> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    depths(&bytes).ok_or_else(|| format!("{}: no array of `<f4`", path.display()).into())
}

/// Version 1 of the format: a magic number, a version, the length of the header in 2 bytes.
fn depths(bytes: &[u8]) -> Option<Vec<f32>> {
    let length = bytes.get(8..10)?;
    let start = 10 + usize::from(u16::from_le_bytes([length[0], length[1]]));
    let header = std::str::from_utf8(bytes.get(10..start)?).ok()?;
    let is_known = bytes.starts_with(b"\x93NUMPY\x01") && header.contains("<f4");
    let (numbers, rest) = bytes[start..].as_chunks::<4>();
    let numbers = numbers.iter().map(|&bytes| f32::from_le_bytes(bytes));
    (is_known && rest.is_empty()).then(|| numbers.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_the_header() {
        let mut bytes = b"\x93NUMPY\x01\x00\x10\x00{'descr': '<f4'}".to_vec();
        bytes.extend([1.5f32, f32::INFINITY].iter().flat_map(|n| n.to_le_bytes()));
        assert_eq!(depths(&bytes), Some(vec![1.5, f32::INFINITY]));
        assert_eq!(depths(&bytes[..bytes.len() - 1]), None);
        assert_eq!(depths(b""), None);
    }
}
