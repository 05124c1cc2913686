//! File formats, by the extension of the name.

use std::path::Path;

use crate::error::{self, Error};
use crate::named::named;

/// A format of image files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// OpenEXR: data, every channel as computed.
    Exr,
    /// PNG: a view for people, or 16-bit depths.
    Png,
    /// PFM: one or three channels of floats.
    Pfm,
    /// NumPy: an array of channels.
    Npy,
}

// The name is the extension, without the dot.
named!(Format: Exr => "exr", Png => "png", Pfm => "pfm", Npy => "npy");

impl Format {
    /// The format of the name `path`; case does not matter.
    pub fn of_path(path: &Path) -> error::Result<Format> {
        let extension = path
            .extension()
            .map(|extension| extension.to_string_lossy());
        let known = |extension: &str| {
            Format::ALL
                .into_iter()
                .find(|format| format.name().eq_ignore_ascii_case(extension))
        };
        extension.as_deref().and_then(known).ok_or_else(|| {
            let found = match extension {
                Some(extension) => format!("unknown image format `.{extension}`"),
                None => "no extension that selects the image format".to_string(),
            };
            let known = Format::ALL.map(|format| format!(".{format}")).join(", ");
            Error::usage(format!("{}: {found}", path.display()))
                .note(format!("known formats: {known}"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn the_extension_decides_in_any_case() {
        assert_eq!(Format::of_path(Path::new("a/b.exr")).unwrap(), Format::Exr);
        assert_eq!(
            Format::of_path(Path::new("b.tar.PNG")).unwrap(),
            Format::Png
        );
    }

    #[test]
    fn an_unknown_or_missing_extension_lists_the_known_ones() {
        for path in ["a.jpg", "a", ".png", "a.", "a.png/..", ""] {
            let error = Format::of_path(Path::new(path)).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Usage);
            assert!(
                error
                    .to_string()
                    .ends_with("known formats: .exr, .png, .pfm, .npy"),
                "{error}"
            );
        }
    }
}
