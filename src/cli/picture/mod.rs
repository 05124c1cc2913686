//! What goes into one file, and how it gets there.

mod data;
mod existing;
mod header;
mod shown;

pub(crate) use data::{Data, DataFormat};
pub(crate) use existing::Existing;
pub(crate) use header::Origin;
pub(crate) use shown::Shown;

use super::output_name::{Destination, Encode};
use super::reporter::Reporter;
use feimos::error::Result;
use feimos::film::atomic_file::Overwrite;
use feimos::film::{CameraAttributes, ChannelName, Image};
use feimos::shape::Geometry;
use shown::Pixels;
use std::io::{self, Seek, Write};

/// A file's content, as far as the command line decides it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Picture {
    /// Channels as they were computed.
    Data(Data),
    /// Colours, for a PNG.
    View(Shown),
}

/// What a file says beside its pixels.
#[derive(Debug, Clone)]
pub(crate) struct Caption {
    /// What [`Picture::header`] made, where the format has a place for it.
    pub(crate) header: Option<String>,
    /// Where it was seen from, in an EXR.
    pub(crate) camera: Option<CameraAttributes>,
}

impl Picture {
    /// The channels that have to be rendered for it.
    pub(crate) fn channels(&self) -> Vec<ChannelName> {
        match self {
            Picture::Data(data) => data.channels(),
            Picture::View(shown) => shown.view().channels().to_vec(),
        }
    }

    /// Whether it depends on all of the aggregate, and not only on what the view shows.
    pub(crate) fn needs_whole_tree(&self) -> bool {
        self.channels().contains(&ChannelName::Cost)
    }

    /// What is missing to show a part of the film in the colours of the whole: the view's name, and what its range is of.
    pub(crate) fn lacks_range(&self) -> Option<(&'static str, &'static str)> {
        match self {
            Picture::Data(_) => None,
            Picture::View(shown) => shown.lacks_range().map(|ends| (shown.view().name(), ends)),
        }
    }

    /// The same with an `instance` channel, where `prim` alone would not tell what was hit.
    pub(crate) fn for_scene(self, geometry: &Geometry, reporter: &Reporter) -> Picture {
        match self {
            Picture::Data(data) => Picture::Data(data.for_scene(geometry, reporter)),
            view => view,
        }
    }

    /// What `Z` and `t` hold where nothing is hit; pictures for people do not look at it.
    pub(crate) fn miss(&self) -> f32 {
        match self {
            Picture::Data(data) => data.miss,
            Picture::View(_) => f32::INFINITY,
        }
    }

    /// The same with the range that `image` is shown in, if it was not given; of depths there is none where nothing is hit.
    pub(crate) fn with_range_of(self, image: &Image) -> Picture {
        match self {
            Picture::View(shown) => Picture::View(shown.with_range_of(image)),
            data => data,
        }
    }

    /// What its colours mean, in words.
    pub(crate) fn legend(&self) -> Option<String> {
        match self {
            Picture::Data(_) => None,
            Picture::View(shown) => Some(shown.legend()),
        }
    }

    /// Writes `image`, in the range that the picture has.
    ///
    /// # Errors
    /// Depths that do not fit, of which no file is begun; a place where no file can be made, or a full disk.
    pub(crate) fn write(
        &self,
        image: &Image,
        caption: Caption,
        destination: &Destination,
        overwrite: Overwrite,
    ) -> Result<()> {
        let content = match self {
            Picture::Data(data) => Content::Data(data, image, caption),
            Picture::View(shown) => Content::View(shown, shown.pixels(image)?, image, caption),
        };
        destination.write(overwrite, &content)
    }
}

/// All that is to be encoded.
enum Content<'a> {
    Data(&'a Data, &'a Image, Caption),
    View(&'a Shown, Pixels, &'a Image, Caption),
}

impl Encode for Content<'_> {
    fn encode(&self, out: &mut (impl Write + Seek)) -> io::Result<()> {
        match self {
            Content::Data(data, image, caption) => data.encode(image, caption, out),
            Content::View(shown, pixels, image, caption) => {
                let size = [image.data_window.width(), image.data_window.height()];
                pixels.encode(size, &shown.texts(caption.header.as_deref()), out)
            }
        }
    }
}
