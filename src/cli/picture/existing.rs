//! Whether a file is already there.

use super::{Data, DataFormat, Origin, Picture};
use feimos::error::{Error, ErrorKind, Result};
use feimos::film::exr_reader::{self, Outline};
use feimos::film::{exr_file, png_reader};
use std::collections::BTreeSet;
use std::path::Path;

/// What is found in the place of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Existing {
    /// The image that would be written, by what it says of itself.
    Same,
    /// Another image by feimos: of a scene or options that have changed.
    Stale,
    /// The image that would be written, but without its end.
    CutOff,
    /// Something else.
    Foreign,
}

impl Picture {
    /// Compares the file `path`, by its header and its end, with the image that would get `header`.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(crate) fn existing(&self, path: &Path, header: &str, origin: &Origin) -> Result<Existing> {
        let found = match self {
            Picture::Data(data) => of_exr(data, path, header, origin),
            Picture::View(_) => png_reader::read_text(path, exr_file::ATTRIBUTE)
                .map(|text| text.map_or(Existing::Foreign, |text| same_or_stale(text == header))),
        };
        match found {
            Ok(Existing::Same) if !self.is_whole(path)? => Ok(Existing::CutOff),
            found => found.or_else(not_an_image),
        }
    }

    fn is_whole(&self, path: &Path) -> Result<bool> {
        match self {
            Picture::Data(_) => exr_reader::is_whole(path),
            Picture::View(_) => png_reader::is_whole(path),
        }
    }
}

fn of_exr(data: &Data, path: &Path, header: &str, origin: &Origin) -> Result<Existing> {
    debug_assert!(
        matches!(data.format, DataFormat::Exr { .. }),
        "no other data has a header"
    );
    let Outline {
        film,
        window,
        channels,
        metadata,
    } = exr_reader::read_outline(path)?;
    if metadata.json.is_empty() {
        return Ok(Existing::Foreign);
    }
    let [found, expected] = [channels, data.channels()].map(BTreeSet::from_iter);
    let same_windows = film == origin.film.into() && window == origin.window;
    Ok(same_or_stale(
        metadata.json == header && same_windows && found == expected,
    ))
}

fn same_or_stale(is_same: bool) -> Existing {
    if is_same {
        Existing::Same
    } else {
        Existing::Stale
    }
}

/// A file of another format, or a damaged one, is nobody's to overwrite.
fn not_an_image(error: Error) -> Result<Existing> {
    if error.kind() == ErrorKind::BadInput {
        Ok(Existing::Foreign)
    } else {
        Err(error)
    }
}
