//! Writes OpenEXR files: every channel as computed.
//!
//! Scan lines come in increasing order, each compressed by itself (`zips`), so that equal images
//! give equal files: the default encoding of the `exr` crate writes tiles in the order in which
//! threads finish them. The thread pool of the crate is off: lines are compressed in the pool of
//! the caller, and written in order. The crate writes the header and the structure of the file, but
//! not its ZIP: ours takes a small fraction of the time.

use std::io::{self, Seek, Write};
use std::ops::Range;

use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock};
use exr::block::writer::ChunksWriter;
use exr::error::Error as ExrError;
use exr::math::Vec2;
use exr::meta::BlockDescription;
use exr::meta::attribute::{
    AttributeValue, ChannelDescription, IntegerBounds, LineOrder, SampleType, Text,
};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use rayon::prelude::*;

#[cfg(test)]
mod tests;

use super::exr_zip::Zipper;
use super::{CameraAttributes, Channel, Image, Metadata, PixelBounds, Samples};

/// The name of the attribute with the metadata of the caller. There is only one, because the `exr`
/// crate keeps custom attributes in a hash table and writes several of them in random order.
pub const ATTRIBUTE: &str = "feimos";

/// Scan lines in a batch: enough to keep every thread busy, few enough that memory never holds the
/// whole compressed image.
const BATCH: u32 = 256;

/// Writes `image` as an OpenEXR file with `metadata`: its JSON in the [`ATTRIBUTE`], and the
/// standard attributes of a camera.
pub fn write(image: &Image, metadata: &Metadata, out: &mut (impl Write + Seek)) -> io::Result<()> {
    image
        .validate()
        .map_err(|problem| io::Error::new(io::ErrorKind::InvalidInput, problem))?;
    let channels = sorted_channels(image, metadata);
    let header = header(image, &channels, metadata).map_err(into_io)?;
    let window = image.data_window;
    let batches = (0..window.height())
        .step_by(BATCH as usize)
        .map(|first| first..window.height().min(first + BATCH));
    exr::block::write(out, [header].into_iter().collect(), true, |_, writer| {
        for batch in batches {
            let chunks = compress(&channels, window, batch.clone())?;
            for (line, chunk) in batch.zip(chunks) {
                writer.write_chunk(line as usize, chunk)?;
            }
        }
        Ok(())
    })
    .map_err(into_io)
}

/// The channels in the order of their names in the file, by bytes, as the format demands.
fn sorted_channels<'a>(image: &'a Image, metadata: &Metadata) -> Vec<&'a Channel> {
    let mut channels: Vec<&Channel> = image.channels.iter().collect();
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
        world_to_normalized_device: Some(camera.world_to_ndc),
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

/// The compressed lines of a batch, in order, each with its place in the file.
fn compress(
    channels: &[&Channel],
    window: PixelBounds,
    lines: Range<u32>,
) -> Result<Vec<Chunk>, ExrError> {
    let width = window.width() as usize;
    let chunk = |zipper: &mut Zipper, line: u32| {
        let compressed_pixels_le = zipper.zip(channels, width, line as usize);
        let y_coordinate = i32::try_from(window.y0 + line)?;
        let block = CompressedScanLineBlock {
            y_coordinate,
            compressed_pixels_le,
        };
        Ok(Chunk {
            layer_index: 0,
            compressed_block: CompressedBlock::ScanLine(block),
        })
    };
    lines
        .into_par_iter()
        .map_init(Zipper::default, chunk)
        .collect()
}

/// An error of the disk unchanged; any other as an error of the input.
fn into_io(error: ExrError) -> io::Error {
    match error {
        ExrError::Io(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}
