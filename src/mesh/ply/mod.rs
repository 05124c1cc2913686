//! PLY: a header that describes elements and their properties, and their values as text or bytes.
//!
//! Read are the properties x, y and z of the element `vertex`, and the list `vertex_indices` or `vertex_index` of the
//! element `face`; all else is skipped, whatever it is.

mod ascii;
mod binary;
mod body;
mod complaint;
mod face;
mod header;
mod line;
mod step;
mod values;
mod vertex;

use std::path::Path;

use self::ascii::Ascii;
use self::binary::{BigEndian, Binary, LittleEndian};
use self::header::{Encoding, Header};
use super::{Loaded, gzip};
use crate::error::Result;

/// Reads the bytes of a PLY file, compressed or not; `path` is for messages only.
pub fn parse_ply(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    gzip::parsed(path, bytes, |content| parse(path, content))
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
