//! The samples that views read.

use crate::film::{ChannelName, Image};
use std::io;

/// Black: the colour of misses in views whose colours are data.
pub const NOTHING: [u8; 3] = [0; 3];

/// The samples of the `f32` channel of that name.
pub(super) fn measures(image: &Image, name: ChannelName) -> io::Result<&[f32]> {
    available(image, name, Image::measures)
}

/// The samples of the channels of `N`: x, y and z.
pub(super) fn normals(image: &Image) -> io::Result<[&[f32]; 3]> {
    Ok([
        measures(image, ChannelName::Nx)?,
        measures(image, ChannelName::Ny)?,
        measures(image, ChannelName::Nz)?,
    ])
}

/// The samples of the `u32` channel of that name.
pub(super) fn numbers(image: &Image, name: ChannelName) -> io::Result<&[u32]> {
    available(image, name, Image::numbers)
}

/// Column and row, on the film, of the sample at `place` of a channel.
pub(super) fn pixel_at(image: &Image, place: usize) -> [u32; 2] {
    let (window, width) = (image.data_window, image.data_window.width() as usize);
    [
        window.x0 + (place % width) as u32,
        window.y0 + (place / width) as u32,
    ]
}

/// Checks the image and takes the samples of a channel with `samples`.
fn available<T>(
    image: &Image,
    name: ChannelName,
    samples: impl FnOnce(&Image, ChannelName) -> Option<&[T]>,
) -> io::Result<&[T]> {
    let invalid = |problem: String| io::Error::new(io::ErrorKind::InvalidInput, problem);
    image.validate().map_err(invalid)?;
    samples(image, name).ok_or_else(|| invalid(format!("no channel {name}")))
}
