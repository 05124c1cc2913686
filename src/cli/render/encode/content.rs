//! The content of an image file, as far as the command line decides it.

use super::channel_file::{ChannelFile, ChannelFormat};
use super::view_file::ViewFile;
use crate::cli::terminal::reporter::Reporter;
use crate::film::{ChannelName, Image};
use crate::shape::Geometry;

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Content {
    /// Channels as computed.
    Channels(ChannelFile),
    /// A view, for a PNG.
    View(ViewFile),
}

impl Content {
    /// The channels that must be rendered.
    pub(crate) fn channels(&self) -> Vec<ChannelName> {
        match self {
            Content::Channels(file) => file.channels(),
            Content::View(file) => file.view.channels().to_vec(),
        }
    }

    /// Returns true if the content is about rays in a tree.
    pub(crate) fn needs_tree(&self) -> bool {
        self.channels().contains(&ChannelName::Cost)
    }

    /// Returns true if the format has a place for a header.
    pub(crate) fn has_header(&self) -> bool {
        match self {
            Content::Channels(file) => matches!(file.format, ChannelFormat::Exr { .. }),
            Content::View(_) => true,
        }
    }

    /// If a part of the film would get other colours than the whole: the view's name, and the names
    /// of the ends of the range that would fix them.
    pub(crate) fn missing_range(&self) -> Option<(&'static str, String)> {
        match self {
            Content::Channels(_) => None,
            Content::View(file) => file.missing_range().map(|ends| (file.view.name(), ends)),
        }
    }

    /// Adds the channel `instance` if `prim` alone does not identify a primitive.
    pub(crate) fn for_scene(self, geometry: &Geometry, reporter: &Reporter) -> Content {
        match self {
            Content::Channels(file) => Content::Channels(file.for_scene(geometry, reporter)),
            view => view,
        }
    }

    /// The value of `Z` and `t` at a miss; views ignore it.
    pub(crate) fn miss(&self) -> Option<f32> {
        match self {
            Content::Channels(file) => Some(file.miss),
            Content::View(_) => None,
        }
    }

    /// Sets the range of a view from `image`, unless the user has set it.
    pub(super) fn with_range_of(self, image: &Image) -> Content {
        match self {
            Content::View(file) => Content::View(file.with_range_of(image)),
            channels => channels,
        }
    }

    /// The meaning of a view's colours, in words.
    pub(super) fn description(&self) -> Option<String> {
        match self {
            Content::Channels(_) => None,
            Content::View(file) => Some(file.description()),
        }
    }
}
