//! A file of an image: where it goes, and its content.

use super::encode::{Content, Encoding, Existing, Provenance};
use super::record::WrittenFile;
use crate::camera::Camera;
use crate::cli::files::destination::Destination;
use crate::error::Result;
use crate::film::Image;
use crate::film::atomic_file::Overwrite;
use crate::progress::Progress;

/// A file that an image is to be written to.
pub(super) struct TargetFile {
    pub(super) destination: Destination,
    pub(super) content: Content,
    /// The header of the file, if the format has one.
    header: Option<String>,
}

impl TargetFile {
    pub(super) fn new(
        destination: Destination,
        content: Content,
        provenance: Option<&Provenance>,
    ) -> TargetFile {
        let provenance = provenance.filter(|_| content.has_header());
        let header = provenance.map(|provenance| provenance.header(&content));
        TargetFile {
            destination,
            content,
            header,
        }
    }

    /// Looks at the file in the place of this one; `None` if there is none.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn existing(&self, provenance: Option<&Provenance>) -> Result<Option<Existing>> {
        let Destination::File(path) = &self.destination else {
            return Ok(None);
        };
        if !path.is_file() {
            return Ok(None);
        }
        match (provenance, &self.header) {
            (Some(provenance), Some(header)) => {
                Existing::find(path, &self.content, header, provenance).map(Some)
            }
            // Without a header the writer of the file is unknown.
            _ => Ok(Some(Existing::Foreign)),
        }
    }
}

/// Writes `image`, seen by `camera`, to all `files`. Each appears complete or not at all. `progress`
/// counts the rows of all of them.
///
/// # Errors
/// A depth or a number does not fit one of the formats, and no file is begun; a file cannot be
/// made; the disk is full. Files before that one are complete.
pub(super) fn write(
    files: Vec<TargetFile>,
    image: &Image,
    camera: &Camera,
    overwrite: Overwrite,
    progress: Progress,
) -> Result<Vec<WrittenFile>> {
    let encode = |file: TargetFile| {
        let encoding = Encoding::new(file.content, image, camera, file.header)?;
        Ok((file.destination, encoding))
    };
    let encodings = files.into_iter().map(encode).collect::<Result<Vec<_>>>()?;
    let write = |(destination, encoding): (Destination, Encoding)| {
        destination.write(overwrite, &encoding, progress)?;
        let description = encoding.description();
        Ok(WrittenFile {
            destination,
            description,
        })
    };
    encodings.into_iter().map(write).collect()
}
