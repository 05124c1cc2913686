//! PLY: a header that describes elements and their properties, and their values as text or bytes.
//!
//! Read are the properties x, y and z of the element `vertex`, and the list `vertex_indices` or `vertex_index` of the
//! elements `face` and `tristrips`; all else is skipped, whatever it is. A header may list faces and strips several times and in
//! any order: triangles come in the order of the file.

mod ascii;
mod binary;
mod body;
mod complaint;
mod face;
mod header;
mod line;
mod plain;
mod step;
mod strip;
mod values;
mod vertex;

use std::path::Path;

use self::ascii::Ascii;
use self::binary::{BigEndian, Binary, LittleEndian};
use self::header::{Encoding, Header};
use super::Loaded;
use crate::error::Result;
use crate::input::{Storage, gzip};

/// Reads the bytes of a PLY file, compressed or not; `path` is for messages only.
pub fn parse_ply(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    read_plain(path, &Storage::Memory(bytes)).map_or_else(|| parse_odd(path, bytes), Ok)
}

/// The mesh in `storage`, compressed or not, if it is a plain PLY file: the quick way, which has no messages.
pub(super) fn read_plain(path: &Path, storage: &Storage) -> Option<Loaded> {
    let is_compressed = gzip::is_in(storage);
    if is_compressed {
        gzip::stream(storage, |text| plain::read_stream(path, text))
    } else {
        plain::read(path, storage)
    }
}

/// The mesh in the bytes of any PLY file that [`read_plain`] has left alone.
pub(super) fn parse_odd(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    gzip::parsed(path, bytes, |content| {
        // A compressed file may be plain, if not as a stream.
        let plain = gzip::is_in(&Storage::Memory(bytes)).then(|| plain::read(path, &Storage::Memory(content)));
        plain.flatten().map_or_else(|| parse(path, content), Ok)
    })
}

fn parse(path: &Path, content: &[u8]) -> Result<Loaded> {
    let header = Header::parse(path, content)?;
    let start = header.size;
    match header.encoding {
        Encoding::Ascii => body::read(path, content, Ascii::new(path, content, start), header),
        Encoding::LittleEndian => body::read(path, content, Binary::<LittleEndian>::new(path, content, start), header),
        Encoding::BigEndian => body::read(path, content, Binary::<BigEndian>::new(path, content, start), header),
    }
}
