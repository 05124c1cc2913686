//! File formats, told by the extension of the output's name.

use std::path::Path;

use crate::error::{Error, Result};

/// A format that images are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// OpenEXR: data, every channel as computed.
    Exr,
    /// PNG: a picture for people.
    Png,
    /// PFM: one or three channels of floats.
    Pfm,
    /// NumPy's format: an array of some channels.
    Npy,
}

impl Format {
    /// Every format there is.
    pub const ALL: [Format; 4] = [Format::Exr, Format::Png, Format::Pfm, Format::Npy];

    /// The extension of the format's files, without the point.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Exr => "exr",
            Format::Png => "png",
            Format::Pfm => "pfm",
            Format::Npy => "npy",
        }
    }

    /// The format that the name `path` asks for; capitals do not count.
    pub fn of_path(path: &Path) -> Result<Format> {
        let extension = path
            .extension()
            .map(|extension| extension.to_string_lossy());
        let known = |extension: &str| {
            Format::ALL
                .into_iter()
                .find(|format| format.extension().eq_ignore_ascii_case(extension))
        };
        extension.as_deref().and_then(known).ok_or_else(|| {
            let found = match extension {
                Some(extension) => format!("unknown image format `.{extension}`"),
                None => "no extension that tells the image format".to_string(),
            };
            let known = Format::ALL
                .map(|format| format!(".{}", format.extension()))
                .join(", ");
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
    fn the_extension_decides_whatever_its_case() {
        assert_eq!(Format::of_path(Path::new("a/b.exr")).unwrap(), Format::Exr);
        assert_eq!(
            Format::of_path(Path::new("b.tar.PNG")).unwrap(),
            Format::Png
        );
    }

    #[test]
    fn an_unknown_or_missing_extension_is_answered_with_the_known_ones() {
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
