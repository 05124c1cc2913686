//! PLY meshes: a header that describes elements and their properties, and values as text or bytes.
//!
//! The mesh comes from the properties x, y and z of the element `vertex`, the list `vertex_indices`
//! or `vertex_index` of the elements `face` and `tristrips`, and, on demand, u and v of vertices.
//! Everything else is skipped. A header may list faces and strips several times and in any order:
//! triangles come in the order of the file.

mod ascii;
mod binary;
mod element_reader;
mod faces;
mod header;
mod header_lines;
mod parallel;
mod plan;
mod reader;
mod strips;
mod values;
mod vertices;

use std::path::Path;

use self::ascii::Ascii;
use self::binary::{BigEndian, Binary, LittleEndian};
use self::header::{Encoding, Header};
use self::vertices::names_of_uv;
use super::Loaded;
use crate::error::Result;
use crate::input::{Budget, Storage, gzip};

/// Reads the mesh in `storage`, compressed or not, if it is a PLY file in the usual form: fast, and
/// without messages.
pub(super) fn read_fast(path: &Path, storage: &Storage, budget: &Budget) -> Option<Loaded> {
    if gzip::is_in(storage) {
        gzip::stream(storage, budget, |text| {
            parallel::read_compressed(path, text)
        })
    } else {
        parallel::read(path, storage)
    }
}

/// Reads the bytes of any PLY file, after [`read_fast`] has refused it.
pub(super) fn parse(path: &Path, bytes: &[u8], budget: &Budget) -> Result<Loaded> {
    let is_compressed = gzip::is_in(&Storage::Memory(bytes));
    gzip::parsed(path, bytes, budget, |content| {
        // The content may be in the usual form even if it could not be read as a stream.
        let fast = match is_compressed {
            true => parallel::read(path, &Storage::Memory(content)),
            false => None,
        };
        match fast {
            Some(loaded) => Ok(loaded),
            None => read(path, content, Header::parse(path, content)?, false, budget),
        }
    })
}

/// Reads the bytes of any PLY file, with u and v of the vertices if it has them.
pub(super) fn parse_with_uv(path: &Path, bytes: &[u8], budget: &Budget) -> Result<Loaded> {
    gzip::parsed(path, bytes, budget, |content| {
        let header = Header::parse(path, content)?;
        let mut vertices = header
            .elements
            .iter()
            .filter(|element| element.name == "vertex");
        if vertices.any(|element| names_of_uv(element).is_some()) {
            return read(path, content, header, true, budget);
        }
        match parallel::read(path, &Storage::Memory(content)) {
            Some(loaded) => Ok(loaded),
            None => read(path, content, header, false, budget),
        }
    })
}

fn read(
    path: &Path,
    content: &[u8],
    header: Header,
    with_uv: bool,
    budget: &Budget,
) -> Result<Loaded> {
    let start = header.size;
    match header.encoding {
        Encoding::Ascii => {
            let values = Ascii::new(path, content, start);
            reader::read(path, content, values, header, with_uv, budget)
        }
        Encoding::LittleEndian => {
            let values = Binary::<LittleEndian>::new(path, content, start);
            reader::read(path, content, values, header, with_uv, budget)
        }
        Encoding::BigEndian => {
            let values = Binary::<BigEndian>::new(path, content, start);
            reader::read(path, content, values, header, with_uv, budget)
        }
    }
}
