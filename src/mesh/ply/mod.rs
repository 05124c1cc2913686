//! The PLY format (Greg Turk, 1994), with what files in the wild make of it.

mod ascii;
mod binary;
mod body;
mod elements;
mod header;
#[cfg(test)]
mod tests;

use super::Loaded;
use crate::error::Result;
use ascii::AsciiBody;
use binary::{BigEndian, BinaryBody, LittleEndian};
use header::{Encoding, Header};
use std::path::Path;

pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    let header = Header::parse(path, bytes)?;
    match header.encoding {
        Encoding::Ascii => elements::read(&header, path, AsciiBody::new(path, bytes, header.end)),
        Encoding::BinaryLittleEndian => {
            elements::read(&header, path, BinaryBody::<LittleEndian>::new(path, bytes, header.end))
        }
        Encoding::BinaryBigEndian => {
            elements::read(&header, path, BinaryBody::<BigEndian>::new(path, bytes, header.end))
        }
    }
}
