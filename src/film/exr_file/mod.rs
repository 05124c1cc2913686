//! Writes OpenEXR files: every channel as computed.
//!
//! Scan lines come in increasing order, each compressed by itself (`zips`), so that equal images
//! give equal files: the default encoding of the `exr` crate writes tiles in the order in which
//! threads finish them. The crate writes the header. Compression, in the pool of the caller, and
//! chunks are ours: they take a small fraction of the time.

mod chunks;

use std::io::{self, Seek, Write};

use exr::error::Error as ExrError;
use exr::math::Vec2;
use exr::meta::attribute::{
    AttributeValue, ChannelDescription, IntegerBounds, LineOrder, SampleType, Text,
};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use exr::meta::{BlockDescription, MetaData, magic_number};

#[cfg(test)]
mod tests;

use super::{CameraAttributes, Channel, ChannelName, Image, Metadata, PixelBounds, Samples};
use crate::progress::Progress;

/// The name of the attribute with the metadata of the caller. There is only one, because the `exr`
/// crate keeps custom attributes in a hash table and writes several of them in random order.
pub const ATTRIBUTE: &str = "feimos";

/// Writes `image` as an OpenEXR file with `metadata`: its JSON in the [`ATTRIBUTE`], and the
/// standard attributes of a camera. `progress` counts rows.
pub fn write(
    image: &Image,
    metadata: &Metadata,
    out: &mut (impl Write + Seek + Send),
    progress: Progress,
) -> io::Result<()> {
    write_channels(image, &all_names(image), metadata, out, progress)
}

fn all_names(image: &Image) -> Vec<ChannelName> {
    image.channels.iter().map(|channel| channel.name).collect()
}

/// Like [`write()`], but only those channels of `image` that `names` lists.
pub fn write_channels(
    image: &Image,
    names: &[ChannelName],
    metadata: &Metadata,
    out: &mut (impl Write + Seek + Send),
    progress: Progress,
) -> io::Result<()> {
    image
        .validate()
        .map_err(|problem| io::Error::new(io::ErrorKind::InvalidInput, problem))?;
    let channels = sorted_channels(image, names, metadata);
    let header = header(image, &channels, metadata)
        .and_then(|header| encode(&[header]))
        .map_err(into_io)?;
    chunks::write(header, &channels, image.data_window, out, progress)
}

/// The beginning of a file, up to the table of chunks.
fn encode(headers: &[Header]) -> Result<Vec<u8>, ExrError> {
    let mut bytes = Vec::new();
    let requirements = MetaData::validate(headers, true)?;
    magic_number::write(&mut bytes)?;
    requirements.write(&mut bytes)?;
    Header::write_all(headers, &mut bytes, false)?;
    Ok(bytes)
}

/// The channels in the order of their names in the file, by bytes, as the format demands.
fn sorted_channels<'a>(
    image: &'a Image,
    names: &[ChannelName],
    metadata: &Metadata,
) -> Vec<&'a Channel> {
    let channels = image.channels.iter();
    let mut channels: Vec<&Channel> = channels.filter(|c| names.contains(&c.name)).collect();
    channels.sort_by_key(|channel| metadata.name_in_file(channel.name));
    channels
}

fn header(image: &Image, channels: &[&Channel], metadata: &Metadata) -> Result<Header, ExrError> {
    let bounds = integer_bounds(image.data_window)?;
    let (width, height) = image.display_window;
    let display_window = integer_bounds(PixelBounds::of_film(width, height))?;
    // Bytes, because `Text::from` panics at characters beyond Latin-1. Readers expect UTF-8.
    let text = AttributeValue::Text(Text::from_slice_unchecked(metadata.json.as_bytes()));
    let attributes = LayerAttributes {
        layer_position: bounds.position,
        other: [(Text::from(ATTRIBUTE), text)].into_iter().collect(),
        ..metadata
            .camera
            .as_ref()
            .map_or_else(LayerAttributes::default, layer_attributes)
    };
    let descriptions = channels
        .iter()
        .map(|channel| describe(channel, metadata.name_in_file(channel.name)))
        .collect();
    let pixel_aspect = metadata.camera.map_or(1.0, |camera| camera.pixel_aspect);
    Ok(Header::new(Text::from(""), bounds.size, descriptions)
        .with_encoding(
            exr::compression::Compression::ZIP1,
            BlockDescription::ScanLines,
            LineOrder::Increasing,
        )
        .with_shared_attributes(ImageAttributes {
            pixel_aspect,
            ..ImageAttributes::new(display_window)
        })
        .with_attributes(attributes))
}

fn layer_attributes(camera: &CameraAttributes) -> LayerAttributes {
    let [x, y] = camera.screen_window_center;
    LayerAttributes {
        screen_window_center: Vec2(x, y),
        screen_window_width: camera.screen_window_width,
        world_to_camera: Some(camera.world_to_camera),
        world_to_normalized_device: camera.world_to_ndc,
        ..LayerAttributes::default()
    }
}

fn describe(channel: &Channel, name: &str) -> ChannelDescription {
    let sample_type = match channel.samples {
        Samples::F32(_) => SampleType::F32,
        Samples::U32(_) => SampleType::U32,
    };
    // The last argument matters to lossy compression only; true is right for anything but colours.
    ChannelDescription::new(name, sample_type, true)
}

fn integer_bounds(bounds: PixelBounds) -> Result<IntegerBounds, ExrError> {
    let position = Vec2(i32::try_from(bounds.x0)?, i32::try_from(bounds.y0)?);
    Ok(IntegerBounds::new(
        position,
        (bounds.width() as usize, bounds.height() as usize),
    ))
}

/// An error of the disk unchanged; any other as an error of the input.
fn into_io(error: ExrError) -> io::Error {
    match error {
        ExrError::Io(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}
