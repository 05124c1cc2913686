//! PLY meshes: a header that describes elements and their properties, and values as text or bytes.
//!
//! The mesh comes from the properties x, y and z of the element `vertex`, the list `vertex_indices`
//! or `vertex_index` of the elements `face` and `tristrips`, and, on demand, u and v and normals of
//! vertices.
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
use self::vertices::has_wanted;
use super::{CornerWants, Loaded};
use crate::error::Result;
use crate::input::{Budget, Storage, gzip};

/// Reads the mesh in `storage`, compressed or not, if it is a PLY file in the usual form, whose
/// vertices have nothing of what is wanted: fast, and without messages.
pub(super) fn read_fast(
    path: &Path,
    storage: &Storage,
    wants: CornerWants,
    budget: &Budget,
) -> Option<Loaded> {
    if gzip::is_in(storage) {
        gzip::stream(storage, budget, |text| {
            parallel::read_compressed(path, text, wants)
        })
    } else {
        parallel::read(path, storage, wants, budget)
    }
}

/// Parses the content of any PLY file, with what `wants` says of the vertices, if it has that.
/// `is_refused` if [`read_fast`] has refused just this content.
pub(super) fn parse(
    path: &Path,
    content: &[u8],
    is_refused: bool,
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    let header = Header::parse(path, content)?;
    if has_wanted(&header, wants) {
        return read(path, content, header, wants, budget);
    }
    // The content may be in the usual form even if it could not be read as a stream.
    let fast = match is_refused {
        true => None,
        false => parallel::read(
            path,
            &Storage::Memory(content),
            CornerWants::NOTHING,
            budget,
        ),
    };
    match fast {
        Some(loaded) => Ok(loaded),
        None => read(path, content, header, CornerWants::NOTHING, budget),
    }
}

fn read(
    path: &Path,
    content: &[u8],
    header: Header,
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    let start = header.size;
    match header.encoding {
        Encoding::Ascii => {
            let values = Ascii::new(path, content, start);
            reader::read(path, content, values, header, wants, budget)
        }
        Encoding::LittleEndian => {
            let values = Binary::<LittleEndian>::new(path, content, start);
            reader::read(path, content, values, header, wants, budget)
        }
        Encoding::BigEndian => {
            let values = Binary::<BigEndian>::new(path, content, start);
            reader::read(path, content, values, header, wants, budget)
        }
    }
}
