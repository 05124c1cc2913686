//! Images of PNG, JPEG and TGA files as textures of numbers.

use super::encoding::Encoding;
use super::image_refusal::ImageRefusal;
use crate::input::Budget;
use crate::memory;
use crate::texture::Texels;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use std::path::Path;

/// The formats that are read.
const FORMATS: [ImageFormat; 3] = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Tga];

/// Reads an image. Its texels are its alpha unless that is 1 everywhere, else the mean of its
/// colours (rule A2).
pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    encoding: Encoding,
    budget: &Budget,
) -> Result<Texels, ImageRefusal> {
    let format = format_of(path, bytes)?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    // The budget limits the size below.
    reader.limits(Limits::no_limits());
    let decoder = reader.into_decoder().map_err(|error| damaged(&error))?;
    let (width, height) = decoder.dimensions();
    let texels = u64::from(width) * u64::from(height);
    let decoded = decoder.total_bytes();
    charge(
        budget,
        [width, height],
        decoded.max(texels.saturating_mul(4)),
    )?;
    let image = DynamicImage::from_decoder(decoder).map_err(|error| damaged(&error))?;
    let texels = texels_of(image, encoding);
    texels.ok_or_else(|| ImageRefusal::new("the image has no pixels"))
}

/// Charges an image of this size that takes `bytes` of memory while it is read.
pub(super) fn charge(
    budget: &Budget,
    [width, height]: [u32; 2],
    bytes: u64,
) -> Result<(), ImageRefusal> {
    budget.charge_stored(bytes).map_err(ImageRefusal::fatal)?;
    // Also what is computed from it.
    memory::check(bytes.saturating_mul(2), || {
        format!("this image of {width} x {height} pixels is too large for this machine's memory")
    })
    .map_err(ImageRefusal::fatal)
}

/// The format by the first bytes, or else, since TGA has none of its own, by the name.
fn format_of(path: &Path, bytes: &[u8]) -> Result<ImageFormat, ImageRefusal> {
    let of_content = image::guess_format(bytes).ok();
    let format = of_content.or_else(|| {
        let extension = path.extension()?;
        ImageFormat::from_extension(extension).filter(|format| *format == ImageFormat::Tga)
    });
    format
        .filter(|format| FORMATS.contains(format))
        .ok_or_else(|| {
            ImageRefusal::new("this is not an image that textures can have")
                .note("expected a PNG, JPEG, TGA or OpenEXR file")
        })
}

fn damaged(error: &image::ImageError) -> ImageRefusal {
    ImageRefusal::new(format!("the image cannot be read: {error}"))
}

fn texels_of(image: DynamicImage, encoding: Encoding) -> Option<Texels> {
    let size = [image.width(), image.height()];
    match image {
        DynamicImage::ImageLuma8(image) => of_bytes(size, image.as_raw(), 1, encoding),
        DynamicImage::ImageLumaA8(image) => of_bytes(size, image.as_raw(), 2, encoding),
        DynamicImage::ImageRgb8(image) => of_bytes(size, image.as_raw(), 3, encoding),
        DynamicImage::ImageRgba8(image) => of_bytes(size, image.as_raw(), 4, encoding),
        other => of_words(size, other, encoding),
    }
}

fn of_bytes(size: [u32; 2], samples: &[u8], channels: usize, encoding: Encoding) -> Option<Texels> {
    let meaning = encoding.of_bytes();
    let pixels = || samples.chunks_exact(channels);
    let has_alpha = channels.is_multiple_of(2);
    let is_opaque = !has_alpha || pixels().all(|pixel| pixel[channels - 1] == u8::MAX);
    let is_grey =
        channels < 3 || pixels().all(|pixel| pixel[0] == pixel[1] && pixel[1] == pixel[2]);
    // One byte a texel says it all.
    let place = match (is_opaque, is_grey) {
        (false, _) => channels - 1,
        (true, true) => 0,
        (true, false) => {
            let mean = |pixel: &[u8]| {
                let [r, g, b] = [0, 1, 2].map(|k| meaning[usize::from(pixel[k])]);
                mean_of([r, g, b])
            };
            return Texels::of_floats(size, pixels().map(mean).collect());
        }
    };
    Texels::of_bytes(size, pixels().map(|pixel| pixel[place]).collect(), meaning)
}

fn of_words(size: [u32; 2], image: DynamicImage, encoding: Encoding) -> Option<Texels> {
    let image = image.into_rgba16();
    let decode = |word: u16| encoding.decode(f64::from(word) / 65535.0);
    let is_opaque = image.pixels().all(|pixel| pixel.0[3] == u16::MAX);
    let texel = |pixel: &image::Rgba<u16>| {
        let [r, g, b, a] = pixel.0;
        if is_opaque {
            mean_of([r, g, b].map(decode))
        } else {
            decode(a) as f32
        }
    };
    Texels::of_floats(size, image.pixels().map(texel).collect())
}

/// The mean of three colours, rounded once to `f32`.
pub(super) fn mean_of([r, g, b]: [f64; 3]) -> f32 {
    (((r + g) + b) / 3.0) as f32
}
