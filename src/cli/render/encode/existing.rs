//! Compares an existing file with the image that would replace it.

use super::channel_file::ChannelFile;
use super::content::Content;
use super::header::Provenance;
use crate::error::{ErrorKind, Result};
use crate::film::exr_reader::{self, Outline};
use crate::film::{exr_file, png_reader};
use std::collections::BTreeSet;
use std::path::Path;

/// An existing file, as its header and its end show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Existing {
    /// The image that would be written.
    Same,
    /// An image by feimos, of another scene or with other options.
    Stale,
    /// The image that would be written, without its end.
    Truncated,
    /// Another file.
    Foreign,
}

impl Existing {
    /// Looks at the file `path` in the place of an image of `content` with `header`.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(crate) fn find(
        path: &Path,
        content: &Content,
        header: &str,
        provenance: &Provenance,
    ) -> Result<Existing> {
        let found = match content {
            Content::Channels(file) => of_exr(file, path, header, provenance),
            Content::View(_) => png_reader::read_text(path, exr_file::ATTRIBUTE)
                .map(|text| text.map_or(Existing::Foreign, |text| same_or_stale(text == header))),
        };
        let is_whole = || match content {
            Content::Channels(_) => exr_reader::is_whole(path),
            Content::View(_) => png_reader::is_whole(path),
        };
        match found {
            Ok(Existing::Same) if !is_whole()? => Ok(Existing::Truncated),
            // Another format, or damage: not ours to overwrite.
            Err(error) if error.kind() == ErrorKind::BadInput => Ok(Existing::Foreign),
            found => found,
        }
    }
}

fn of_exr(
    file: &ChannelFile,
    path: &Path,
    header: &str,
    provenance: &Provenance,
) -> Result<Existing> {
    let Outline {
        film,
        window,
        channels,
        metadata,
    } = exr_reader::read_outline(path)?;
    if metadata.json.is_empty() {
        return Ok(Existing::Foreign);
    }
    let [found, expected] = [channels, file.channels()].map(BTreeSet::from_iter);
    let same_windows = film == provenance.film.into() && window == provenance.window;
    let is_same = metadata.json == header && same_windows && found == expected;
    Ok(same_or_stale(is_same))
}

fn same_or_stale(is_same: bool) -> Existing {
    if is_same {
        Existing::Same
    } else {
        Existing::Stale
    }
}
