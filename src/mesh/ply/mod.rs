//! PLY: a header that describes elements and their properties, and their values as text or bytes.
//!
//! Read are the properties x, y and z of the element `vertex`, and the list `vertex_indices` or `vertex_index` of the
//! elements `face` and `tristrips`, and u and v of vertices where they are wanted; all else is skipped, whatever it is. A header may list faces and strips several times and in
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
use self::body::Wanted;
use self::header::{Encoding, Header};
use self::vertex::names_of_uv;
use super::Loaded;
use crate::error::Result;
use crate::input::{Budget, Storage, gzip};

/// Reads the bytes of a PLY file, compressed or not; `path` is for messages only.
pub(super) fn parse_any(path: &Path, bytes: &[u8], budget: &Budget) -> Result<Loaded> {
    read_plain(path, &Storage::Memory(bytes), budget)
        .map_or_else(|| parse_odd(path, bytes, budget), Ok)
}

/// The mesh in `storage`, compressed or not, if it is a plain PLY file: the quick way, which has no messages.
pub(super) fn read_plain(path: &Path, storage: &Storage, budget: &Budget) -> Option<Loaded> {
    let is_compressed = gzip::is_in(storage);
    if is_compressed {
        gzip::stream(storage, budget, |text| plain::read_stream(path, text))
    } else {
        plain::read(path, storage)
    }
}

/// The mesh in the bytes of any PLY file that [`read_plain`] has left alone.
pub(super) fn parse_odd(path: &Path, bytes: &[u8], budget: &Budget) -> Result<Loaded> {
    gzip::parsed(path, bytes, budget, |content| {
        // A compressed file may be plain, if not as a stream.
        let plain = gzip::is_in(&Storage::Memory(bytes))
            .then(|| plain::read(path, &Storage::Memory(content)));
        plain
            .flatten()
            .map_or_else(|| parse(path, content, budget), Ok)
    })
}

/// As [`parse_any`], with u and v of the vertices, if the file has them.
pub(super) fn parse_with_uv(path: &Path, bytes: &[u8], budget: &Budget) -> Result<Loaded> {
    gzip::parsed(path, bytes, budget, |content| {
        let header = Header::parse(path, content)?;
        if header
            .elements
            .iter()
            .any(|element| element.name == "vertex" && names_of_uv(element).is_some())
        {
            return read(path, content, header, true, budget);
        }
        plain::read(path, &Storage::Memory(content))
            .map_or_else(|| read(path, content, header, false, budget), Ok)
    })
}

fn parse(path: &Path, content: &[u8], budget: &Budget) -> Result<Loaded> {
    read(path, content, Header::parse(path, content)?, false, budget)
}

fn read(
    path: &Path,
    content: &[u8],
    header: Header,
    with_uv: bool,
    budget: &Budget,
) -> Result<Loaded> {
    let start = header.size;
    let wanted = Wanted { with_uv, budget };
    match header.encoding {
        Encoding::Ascii => body::read(
            path,
            content,
            Ascii::new(path, content, start),
            header,
            wanted,
        ),
        Encoding::LittleEndian => body::read(
            path,
            content,
            Binary::<LittleEndian>::new(path, content, start),
            header,
            wanted,
        ),
        Encoding::BigEndian => body::read(
            path,
            content,
            Binary::<BigEndian>::new(path, content, start),
            header,
            wanted,
        ),
    }
}
