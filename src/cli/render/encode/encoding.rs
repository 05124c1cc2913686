//! Everything that a file is encoded from.

use super::content::Content;
use super::picture::Picture;
use crate::camera::Camera;
use crate::cli::files::destination::Encode;
use crate::error::Result;
use crate::film::{CameraAttributes, Image};
use crate::progress::Progress;
use std::io::{self, Seek, Write};

/// A rendered image, ready to be written as a file. Several files may be made from one image.
pub(crate) struct Encoding<'a> {
    content: Content,
    /// The picture of a view.
    picture: Option<Picture>,
    image: &'a Image,
    header: Option<String>,
    camera: Option<CameraAttributes>,
}

impl<'a> Encoding<'a> {
    /// The file with `content` of `image`, seen by `camera`. The file has the `header` if its
    /// format has one.
    ///
    /// # Errors
    /// A depth or a number does not fit the format.
    pub(crate) fn new(
        content: Content,
        image: &'a Image,
        camera: &Camera,
        header: Option<String>,
    ) -> Result<Encoding<'a>> {
        let content = content.with_range_of(image);
        let picture = match &content {
            Content::Channels(_) => None,
            Content::View(file) => Some(file.picture(image, camera)?),
        };
        Ok(Encoding {
            content,
            picture,
            image,
            header,
            camera: CameraAttributes::of(camera),
        })
    }

    /// The meaning of a view's colours, in words.
    pub(crate) fn description(&self) -> Option<String> {
        self.content.description()
    }
}

impl Encode for Encoding<'_> {
    fn encode(&self, out: &mut (impl Write + Seek + Send), progress: Progress) -> io::Result<()> {
        let header = self.header.as_deref();
        match (&self.content, &self.picture) {
            (Content::View(file), Some(picture)) => {
                picture.encode(&file.texts(header), out, progress)
            }
            (Content::Channels(file), _) => {
                file.encode(self.image, header, self.camera, out, progress)
            }
            (Content::View(_), None) => unreachable!("a view has a picture"),
        }
    }
}
