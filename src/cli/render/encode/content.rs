//! The content of an image file, as far as the command line decides it.

use super::channel_file::{ChannelFile, ChannelFormat};
use super::view_file::{Pixels, ViewFile};
use crate::cli::files::destination::{Destination, Encode};
use crate::cli::terminal::reporter::Reporter;
use feimos::error::Result;
use feimos::film::atomic_file::Overwrite;
use feimos::film::{CameraAttributes, ChannelName, Image};
use feimos::progress::Progress;
use feimos::shape::Geometry;
use std::io::{self, Seek, Write};

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
            Content::View(file) => file.view().channels().to_vec(),
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
    pub(crate) fn missing_range(&self) -> Option<(&'static str, &'static str)> {
        match self {
            Content::Channels(_) => None,
            Content::View(file) => file.missing_range().map(|ends| (file.view().name(), ends)),
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
    pub(crate) fn miss(&self) -> f32 {
        match self {
            Content::Channels(file) => file.miss,
            Content::View(_) => f32::INFINITY,
        }
    }

    /// Sets the range of a view from `image`, unless the user has set it.
    pub(crate) fn with_range_of(self, image: &Image) -> Content {
        match self {
            Content::View(file) => Content::View(file.with_range_of(image)),
            channels => channels,
        }
    }

    /// The meaning of a view's colours.
    pub(crate) fn legend(&self) -> Option<String> {
        match self {
            Content::Channels(_) => None,
            Content::View(file) => Some(file.legend()),
        }
    }

    /// Writes `image` with the `header`, if the format has one, and the camera, if it is an EXR.
    /// `progress` counts rows.
    ///
    /// # Errors
    /// A depth does not fit, and no file is begun; the file cannot be made; the disk is full.
    pub(crate) fn write(
        &self,
        image: &Image,
        header: Option<&str>,
        camera: Option<CameraAttributes>,
        destination: &Destination,
        overwrite: Overwrite,
        progress: Progress,
    ) -> Result<()> {
        let pixels = match self {
            Content::Channels(_) => None,
            Content::View(file) => Some(file.pixels(image)?),
        };
        let encoding = Encoding {
            content: self,
            pixels,
            image,
            header,
            camera,
        };
        destination.write(overwrite, &encoding, progress)
    }
}

/// Everything that a file is encoded from.
struct Encoding<'a> {
    content: &'a Content,
    /// The pixels of a view.
    pixels: Option<Pixels>,
    image: &'a Image,
    header: Option<&'a str>,
    camera: Option<CameraAttributes>,
}

impl Encode for Encoding<'_> {
    fn encode(&self, out: &mut (impl Write + Seek + Send), progress: Progress) -> io::Result<()> {
        match (self.content, &self.pixels) {
            (Content::View(file), Some(pixels)) => {
                let window = &self.image.data_window;
                let size = [window.width(), window.height()];
                pixels.encode(size, &file.texts(self.header), out, progress)
            }
            (Content::Channels(file), _) => {
                file.encode(self.image, self.header, self.camera, out, progress)
            }
            (Content::View(_), None) => unreachable!("a view has pixels"),
        }
    }
}
