//! Which options have a meaning for which kind of file.

use crate::cli::files::destination::Destination;
use crate::error::{Error, Result};
use crate::film::View;

/// The kind of a file: its format, and the view of a PNG.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FileKind {
    Exr,
    Npy,
    Pfm,
    Png(View),
}

/// An option that has a meaning for some kinds of files only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ImageOption {
    Aov,
    DepthChannel,
    View,
    ColorMap,
    Range,
    Legend,
    Background,
    Scale,
    Miss,
    SkipExisting,
}

impl ImageOption {
    fn flag(self) -> &'static str {
        match self {
            ImageOption::Aov => "--aov",
            ImageOption::DepthChannel => "--depth-channel",
            ImageOption::View => "--view",
            ImageOption::ColorMap => "--colormap",
            ImageOption::Range => "--range",
            ImageOption::Legend => "--legend",
            ImageOption::Background => "--background",
            ImageOption::Scale => "--scale",
            ImageOption::Miss => "--miss",
            ImageOption::SkipExisting => "--skip-existing",
        }
    }

    /// What a file of this kind is, if the option has no meaning for it.
    fn obstacle(self, kind: FileKind) -> Option<String> {
        match kind {
            FileKind::Exr => self.obstacle_in_channels(),
            FileKind::Npy | FileKind::Pfm => match self {
                ImageOption::DepthChannel | ImageOption::SkipExisting => {
                    Some("a file without a header for it; an .exr has one".to_owned())
                }
                _ => self.obstacle_in_channels(),
            },
            FileKind::Png(view) => self.obstacle_in_view(view),
        }
    }

    fn obstacle_in_channels(self) -> Option<String> {
        match self {
            ImageOption::View
            | ImageOption::ColorMap
            | ImageOption::Range
            | ImageOption::Legend
            | ImageOption::Background
            | ImageOption::Scale => Some("a file that holds the values themselves".to_owned()),
            _ => None,
        }
    }

    fn obstacle_in_view(self, view: View) -> Option<String> {
        match self {
            ImageOption::Aov | ImageOption::DepthChannel => {
                Some("a PNG; for channels give the output the extension .exr".to_owned())
            }
            ImageOption::ColorMap | ImageOption::Range | ImageOption::Legend => {
                let is_fixed = !view.has_color_map();
                is_fixed.then(|| format!("a PNG of the view {view}, whose colours are fixed"))
            }
            ImageOption::Background => {
                let is_fixed = !view.has_background();
                is_fixed.then(|| format!("a PNG of the view {view}, whose misses have no colour"))
            }
            ImageOption::Scale | ImageOption::Miss => {
                let is_other = view != View::Depth16;
                is_other.then(|| "a PNG, but not of the view depth16".to_owned())
            }
            ImageOption::View | ImageOption::SkipExisting => None,
        }
    }
}

/// Checks that each of the `options` has a meaning for one of the files at least. Skipping has to
/// have one for all.
///
/// # Errors
/// One has not; the message is about the first such file.
pub(super) fn check_meanings(
    options: &[ImageOption],
    destinations: &[Destination],
    kinds: &[FileKind],
) -> Result<()> {
    for option in options {
        let files = destinations.iter().zip(kinds);
        let obstacles = files.filter_map(|(destination, kind)| {
            let obstacle = option.obstacle(*kind)?;
            let flag = option.flag();
            Some(format!(
                "{flag} has no meaning for {destination}: it is {obstacle}"
            ))
        });
        let obstacles: Vec<String> = obstacles.collect();
        let is_for_all = *option == ImageOption::SkipExisting;
        let is_refused = is_for_all || obstacles.len() == kinds.len();
        if let (true, Some(first)) = (is_refused, obstacles.into_iter().next()) {
            return Err(Error::usage(first));
        }
    }
    Ok(())
}
