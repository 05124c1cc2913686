//! Allocates the channels of an image.

use super::options::RenderOptions;
use crate::camera::Camera;
use crate::error::{Diagnostic, Error, ErrorKind, Result};
use crate::film::{Channel, ChannelName, Image, PixelBounds, Samples};
use crate::memory;

/// The largest number of pixels rendered at once: more take more memory than a machine has.
const MAX_PIXELS: u64 = 1 << 30;

const IN_PARTS: &str = "render it in parts, with --pixelbounds";

/// An image of zeros for [`super::render_into`].
///
/// # Errors
/// If the image does not fit into memory.
pub fn blank_image(camera: &Camera, options: &RenderOptions) -> Result<Image> {
    let [width, height] = camera.resolution;
    let channels = allocate(&options.channels, &options.data_window)?;
    Ok(Image {
        display_window: (width, height),
        data_window: options.data_window,
        channels,
    })
}

/// Allocates channels of zeros over the pixels of `window`.
///
/// # Errors
/// If they do not fit into memory.
pub(crate) fn allocate(names: &[ChannelName], window: &PixelBounds) -> Result<Vec<Channel>> {
    let message = || {
        let (width, height) = (window.width(), window.height());
        format!("an image of {width} x {height} pixels is too large for this machine's memory")
    };
    let too_large = |kind| Error::new(kind, Diagnostic::new(message()).note(IN_PARTS));
    let count = match window.area() {
        area if area <= MAX_PIXELS => area as usize,
        _ => return Err(too_large(ErrorKind::Usage)),
    };
    let bytes = (names.len() * size_of::<f32>()) as u64 * count as u64;
    // Writing the file takes some more.
    memory::check(bytes.saturating_add(bytes / 8), message)
        .map_err(|error| error.note(IN_PARTS))?;
    // All are reserved before the first is touched, so that too large an image is refused at once.
    let reserve = |name: &ChannelName| {
        let samples = if name.is_integer() {
            reserved(count).map(Samples::U32)
        } else {
            reserved(count).map(Samples::F32)
        };
        Ok(Channel {
            name: *name,
            samples: samples.map_err(|_| too_large(ErrorKind::TryAgain))?,
        })
    };
    let mut channels = names
        .iter()
        .map(reserve)
        .collect::<Result<Vec<Channel>>>()?;
    // Now that there is room, allocate memory that the system zeroes on first touch, by the
    // threads. The reserved memory is freed first, so that no channel takes its memory twice.
    for channel in &mut channels {
        match &mut channel.samples {
            Samples::F32(values) => {
                *values = Vec::new();
                *values = vec![0.0; count];
            }
            Samples::U32(values) => {
                *values = Vec::new();
                *values = vec![0; count];
            }
        }
    }
    Ok(channels)
}

/// An empty list with room for `count` values.
fn reserved<T>(count: usize) -> std::result::Result<Vec<T>, std::collections::TryReserveError> {
    let mut values = Vec::new();
    values.try_reserve_exact(count)?;
    Ok(values)
}
