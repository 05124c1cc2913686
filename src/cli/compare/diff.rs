//! The difference picture's file.

use crate::cli::files::inputs::Inputs;
use feimos::error::{Error, Result};
use feimos::film::atomic_file::{self, Overwrite};
use feimos::film::{Format, png_file};
use std::path::Path;

/// Tells of what is wrong with the name `diff` before any image is read.
///
/// # Errors
/// Another format than PNG, one of the images compared, a place where no file can be made.
pub(super) fn check(diff: &Path, inputs: [&Path; 2]) -> Result<()> {
    if Format::of_path(diff)? != Format::Png {
        let error = Error::usage(format!(
            "{}: the difference picture is a PNG",
            diff.display()
        ));
        return Err(error.note("expected a name that ends in .png"));
    }
    Inputs::default()
        .with(inputs, "an image that is compared")
        .check(diff, "--diff")?;
    atomic_file::check(diff)
}

/// Writes the picture.
pub(super) fn write(diff: &Path, width: u32, height: u32, pixels: &[[u8; 3]]) -> Result<()> {
    atomic_file::write_file(diff, Overwrite::Yes, |out| {
        png_file::write_rgb([width, height], pixels, &[], out)
    })
    .map(|_| ())
}
