//! A file with an image in any format that is read.

use super::png_reader::Picture;
use super::{Image, exr_reader, png_reader};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{self, BudgetFactor};
use std::path::Path;

/// What an image file holds; its content tells, not its name.
#[derive(Debug, Clone, PartialEq)]
pub enum ImageFile {
    /// Data, of an EXR.
    Exr(Image),
    /// Colours, of a PNG.
    Png(Picture),
}

impl ImageFile {
    /// Reads the file `path`, whose pixels may take so many times the usual memory.
    ///
    /// # Errors
    /// A file that cannot be read, has another format, is wrong in its own, or would take more memory.
    pub fn read(path: &Path, factor: BudgetFactor) -> Result<ImageFile> {
        let bytes = input::read(path)?;
        if exr_reader::recognises(&bytes) {
            return exr_reader::decode_within(path, &bytes, factor).map(ImageFile::Exr);
        }
        if png_reader::recognises(&bytes) {
            return png_reader::decode_within(path, &bytes, factor).map(ImageFile::Png);
        }
        let found =
            Diagnostic::new("this is neither an EXR nor a PNG file").at(SourceLocation::file(path));
        Err(Error::bad_input(
            found.note("expected an image, as `feimos render` writes it"),
        ))
    }
}
