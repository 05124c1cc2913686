//! The plain form that nearly all PLY files have, read by several threads: vertices without lists, then faces with one list,
//! in text one of either to a line.
//!
//! A mesh read here is the one that [`body`](super::body) reads. Whatever is odd about a file, a mistake or only a comment
//! among the values, makes these readers give up without a word: then `body` reads the file from its start, and only it has
//! messages and warnings about values.

mod blocks;
mod face_lines;
mod form;
mod lines;
mod records;
mod stream;
#[cfg(test)]
mod tests;
mod text;
mod vertex_lines;

use std::path::Path;

use rayon::prelude::*;

use self::form::Form;
use super::binary::{BigEndian, LittleEndian};
use super::header::{Encoding, Header};
use crate::input::Storage;
use crate::memory;
use crate::mesh::Loaded;

pub(super) use self::stream::read as read_stream;

/// Bytes that a task reads at a time: few enough for a core's own cache, many enough that a task costs nothing.
const BLOCK: u64 = 1 << 18;
/// Bytes in which a header ends, if the file is to be plain; and the longest line.
const HEAD: u64 = 1 << 14;

/// The mesh in `storage`, if it is a plain PLY file.
pub(super) fn read(path: &Path, storage: &Storage) -> Option<Loaded> {
    read_in_blocks(path, storage, BLOCK)
}

fn read_in_blocks(path: &Path, storage: &Storage, block: u64) -> Option<Loaded> {
    let mut buffer = Vec::new();
    let head = storage
        .piece(0..storage.size().min(HEAD), &mut buffer)
        .ok()?;
    let header = Header::parse(path, head).ok()?;
    let form = Form::of(&header)?;
    let start = header.size as u64;
    let mesh = match header.encoding {
        Encoding::Ascii => text::read(storage, start, &form, block),
        Encoding::LittleEndian => records::read::<LittleEndian>(storage, start, &form, block),
        Encoding::BigEndian => records::read::<BigEndian>(storage, start, &form, block),
    }?;
    Some(Loaded::new(path, mesh, header.warnings))
}

/// `count` defaults, made by all threads: most of the work is the system's, which makes room. Nothing where there is no memory for
/// them.
fn defaults<T: Copy + Default + Send + Sync>(count: usize) -> Option<Vec<T>> {
    let bytes = count.checked_mul(size_of::<T>())?;
    memory::check(bytes as u64, String::new).ok()?;
    let mut values = Vec::new();
    values.try_reserve_exact(count).ok()?;
    rayon::iter::repeat_n(T::default(), count).collect_into_vec(&mut values);
    Some(values)
}
