//! The fast PLY readers: all threads, for files in the usual form.
//!
//! Nearly all files have it: vertices without lists, then faces with one list; in text, one vertex
//! or face to a line. The mesh is the one that the general [`reader`](super::reader) makes.
//! Anything else, such as a mistake or a comment among the values, makes these readers give up
//! without a message, and the general reader starts over.

mod ascii;
mod binary;
mod blocks;
mod compressed;
mod element_lines;
mod form;
mod lines;
mod one_pass;
#[cfg(test)]
mod tests;

use std::path::Path;

use self::blocks::HEAD;
use self::form::Form;
use super::binary::{BigEndian, LittleEndian};
use super::header::{Encoding, Header};
use super::vertices::has_wanted;
use crate::input::{Budget, Storage};
use crate::mesh::{CornerWants, Loaded};

pub(super) use self::compressed::read as read_compressed;

/// Bytes that a task reads: few enough for a core's own cache, many enough to hide its overhead.
const BLOCK: u64 = 1 << 18;

/// The mesh in `storage`, if it is a PLY file in the usual form, without anything that is wanted
/// of corners.
pub(super) fn read(
    path: &Path,
    storage: &Storage,
    wants: CornerWants,
    budget: &Budget,
) -> Option<Loaded> {
    read_in_blocks(path, storage, BLOCK, wants, budget)
}

fn read_in_blocks(
    path: &Path,
    storage: &Storage,
    block: u64,
    wants: CornerWants,
    budget: &Budget,
) -> Option<Loaded> {
    let mut buffer = Vec::new();
    let head = storage
        .piece(0..storage.size().min(HEAD), &mut buffer)
        .ok()?;
    let header = Header::parse(path, head).ok()?;
    if has_wanted(&header, wants) {
        return None;
    }
    let form = Form::of(&header)?;
    let start = header.size as u64;
    let mesh = match header.encoding {
        Encoding::Ascii => ascii::read(storage, start, &form, block, budget),
        Encoding::LittleEndian => {
            binary::read::<LittleEndian>(storage, start, &form, block, budget)
        }
        Encoding::BigEndian => binary::read::<BigEndian>(storage, start, &form, block, budget),
    }?;
    Some(Loaded::new(path, mesh, header.warnings))
}
