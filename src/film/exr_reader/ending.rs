//! Finds truncated files without reading pixels.

use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use std::io::{self, Read, Seek, SeekFrom};

/// Returns true if the file holds all chunks of its offset tables, which begin at byte `start`:
/// each chunk begins within the file, and the last one of each part ends there.
///
/// # Errors
/// Reading fails; a file that is too short is no error.
pub(super) fn has_end(
    file: &mut (impl Read + Seek),
    start: u64,
    meta: &MetaData,
) -> io::Result<bool> {
    const SIZE: u64 = size_of::<i32>() as u64;
    let length = file.seek(SeekFrom::End(0))?;
    let chunks = meta
        .headers
        .iter()
        .map(|header| header.chunk_count as u64)
        .fold(0, u64::saturating_add);
    let first = start.saturating_add(chunks.saturating_mul(size_of::<u64>() as u64));
    let is_multilayer = meta.requirements.is_multilayer();
    file.seek(SeekFrom::Start(start))?;
    if first > length {
        return Ok(false);
    }
    let mut last_chunks = Vec::new();
    for header in &meta.headers {
        let mut last = 0;
        for _ in 0..header.chunk_count {
            let offset = u64::from_le_bytes(read_array(file)?);
            // An unwritten table holds zeros.
            if !(first..length).contains(&offset) {
                return Ok(false);
            }
            last = last.max(offset);
        }
        last_chunks.push((header, last));
    }
    for (header, offset) in last_chunks {
        let before = bytes_before_size(header, is_multilayer);
        if length - offset < before + SIZE {
            return Ok(false);
        }
        file.seek(SeekFrom::Start(offset + before))?;
        // No chunk is empty: zeros are the rest of a file without its end.
        let Ok(size @ 1..) = u64::try_from(i32::from_le_bytes(read_array(file)?)) else {
            return Ok(false);
        };
        if file.stream_position()? + size > length {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Bytes of a chunk before its size: the number of its part, and a row or the place of a tile.
fn bytes_before_size(header: &Header, is_multilayer: bool) -> u64 {
    let part = if is_multilayer { size_of::<i32>() } else { 0 };
    let place = match header.blocks {
        BlockDescription::ScanLines => size_of::<i32>(),
        BlockDescription::Tiles(_) => 4 * size_of::<i32>(),
    };
    (part + place) as u64
}

fn read_array<const N: usize>(file: &mut impl Read) -> io::Result<[u8; N]> {
    let mut bytes = [0; N];
    file.read_exact(&mut bytes).map(|()| bytes)
}
