//! Images of OpenEXR files as textures of numbers.

use super::decoded_image::{charge, mean_of};
use super::image_refusal::ImageRefusal;
use crate::film::exr_reader;
use crate::input::Budget;
use crate::texture::Texels;
use exr::compression::Compression;
use exr::image::{AnyChannel, FlatSamples};
use exr::prelude::{ReadChannels, ReadLayers};
use std::io::Cursor;

/// Reads the first layer of an image. Its texels are its alpha unless that is 1 everywhere, else
/// the mean of its colours, or its only channel (rule A2).
pub(super) fn read(bytes: &[u8], budget: &Budget) -> Result<Texels, ImageRefusal> {
    let size = check(bytes, budget)?;
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| damaged(&error))?;
    let channels = &image.layer_data.channel_data.list;
    let called = |name: &str| {
        let is_it = |channel: &&AnyChannel<FlatSamples>| channel.name.eq(name);
        channels
            .iter()
            .find(is_it)
            .map(|channel| &channel.sample_data)
    };
    let values = match (called("A"), ["R", "G", "B"].map(called)) {
        (Some(alpha), _) if !alpha.values_as_f32().all(|alpha| alpha == 1.0) => {
            alpha.values_as_f32().collect()
        }
        (_, [Some(r), Some(g), Some(b)]) => r
            .values_as_f32()
            .zip(g.values_as_f32())
            .zip(b.values_as_f32())
            .map(|((r, g), b)| mean_of([r, g, b].map(f64::from)))
            .collect(),
        _ => match (called("Y"), &channels[..]) {
            (Some(only), _) => only.values_as_f32().collect(),
            (None, [only]) => only.sample_data.values_as_f32().collect(),
            _ => {
                return Err(ImageRefusal::new(
                    "the image has neither one channel nor R, G and B",
                ));
            }
        },
    };
    let texels = Texels::of_floats(size, values);
    texels.ok_or_else(|| ImageRefusal::new("the image has channels of other sizes"))
}

/// Checks the header before memory is taken; returns the size of the image.
fn check(bytes: &[u8], budget: &Budget) -> Result<[u32; 2], ImageRefusal> {
    let meta = exr_reader::header_of(&mut &*bytes).map_err(|error| damaged(&error))?;
    let Some(header) = meta.headers.iter().find(|header| !header.deep) else {
        return Err(ImageRefusal::new("the image has no pixels"));
    };
    // Their decoders trust the sizes that they read.
    if matches!(
        header.compression,
        Compression::B44 | Compression::B44A | Compression::DWAA(_) | Compression::DWAB(_)
    ) {
        let message = format!("the compression {} is not supported", header.compression);
        return Err(ImageRefusal::new(message));
    }
    let exr::math::Vec2(width, height) = header.layer_size;
    let size = [width, height].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let channels = header.channels.list.len() as u64;
    let texels = (width as u64).saturating_mul(height as u64);
    charge(budget, size, texels.saturating_mul(4 * (channels + 1)))?;
    Ok(size)
}

fn damaged(error: &exr::error::Error) -> ImageRefusal {
    ImageRefusal::new(format!("the image cannot be read: {error}"))
}
