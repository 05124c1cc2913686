//! Reads an image file of any data format.

use super::{Image, exr_reader, npy_reader, pfm_reader, png_reader};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::{self, BudgetFactor};
use std::path::Path;

/// Reads the file `path`: an EXR, a NumPy array, a PFM, or a PNG of 16-bit depths. The content
/// decides, not the name. Pixels may take `factor` times the usual memory.
///
/// # Errors
/// The file cannot be read, has another format, is damaged, or takes more memory.
pub fn read_image(path: &Path, factor: BudgetFactor) -> Result<Image> {
    let bytes = input::read(path)?;
    if exr_reader::recognises(&bytes) {
        return exr_reader::decode_within(path, &bytes, factor);
    }
    if npy_reader::recognises(&bytes) {
        return npy_reader::decode(path, &bytes);
    }
    if pfm_reader::recognises(&bytes) {
        return pfm_reader::decode(path, &bytes);
    }
    if png_reader::recognises(&bytes) {
        return png_reader::decode_within(path, &bytes, factor);
    }
    let diagnostic = Diagnostic::new("this is not an EXR, NPY, PFM or PNG file")
        .at(SourceLocation::file(path))
        .note("expected an image as `feimos render` writes it");
    Err(Error::bad_input(diagnostic))
}
