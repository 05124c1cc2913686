//! OpenEXR: every channel as it was computed.
//!
//! Scan lines in increasing order, each compressed by itself (`zips`), so that equal images are equal files: the
//! default encoding of the `exr` crate writes its tiles in the order in which threads finish them. The crate's
//! thread pool is off; lines are compressed in the pool that the caller runs in, and written in order.

use std::io::{self, Seek, Write};

use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock};
use exr::block::writer::ChunksWriter;
use exr::error::Error as ExrError;
use exr::math::Vec2;
use exr::meta::BlockDescription;
use exr::meta::attribute::{AttributeValue, ChannelDescription, IntegerBounds, LineOrder, SampleType, Text};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use flate2::{Compress, Compression, FlushCompress, Status};
use rayon::prelude::*;

use super::{Channel, Image, PixelBounds, Samples};

/// The name of the attribute that holds what the caller says about the image. There is only this one, because
/// the `exr` crate keeps custom attributes in a hash table and writes several of them in a random order.
pub const ATTRIBUTE: &str = "feimos";

/// Scan lines that are compressed before they are written: enough to keep every thread busy, few enough that the
/// compressed image never lies in memory as a whole.
const BATCH: usize = 128;

/// The level of deflate: measured on depth images, more takes twice the time for files hardly shorter.
const LEVEL: u32 = 2;

/// Writes `image` as an OpenEXR file with `json` in its [`ATTRIBUTE`].
pub fn write(image: &Image, json: &str, out: &mut (impl Write + Seek)) -> io::Result<()> {
    image.validate().map_err(|problem| io::Error::new(io::ErrorKind::InvalidInput, problem))?;
    let channels = sorted_channels(image);
    let header = header(image, &channels, json).map_err(into_io)?;
    let window = image.data_window;
    let lines: Vec<u32> = (0..window.height()).collect();
    exr::block::write(out, [header].into_iter().collect(), true, |_, writer| {
        for batch in lines.chunks(BATCH) {
            let chunks = batch.par_iter().map_init(deflate, |deflate, line| chunk(&channels, window, *line, deflate));
            let chunks = chunks.collect::<Result<Vec<Chunk>, ExrError>>()?;
            for (line, chunk) in batch.iter().zip(chunks) {
                writer.write_chunk(*line as usize, chunk)?;
            }
        }
        Ok(())
    })
    .map_err(into_io)
}

fn deflate() -> Compress {
    Compress::new(Compression::new(LEVEL), true)
}

/// The channels by name, byte for byte: the order that the format demands.
fn sorted_channels(image: &Image) -> Vec<&Channel> {
    let mut channels: Vec<&Channel> = image.channels.iter().collect();
    channels.sort_by_key(|channel| channel.name.as_str());
    channels
}

fn header(image: &Image, channels: &[&Channel], json: &str) -> Result<Header, ExrError> {
    let bounds = integer_bounds(image.data_window)?;
    let (width, height) = image.display_window;
    let display_window = integer_bounds(PixelBounds::of_film(width, height))?;
    // Bytes, since `Text::from` panics where a character of a file name is beyond Latin-1. Readers expect UTF-8.
    let text = AttributeValue::Text(Text::from_slice_unchecked(json.as_bytes()));
    let attributes = LayerAttributes {
        layer_position: bounds.position,
        other: [(Text::from(ATTRIBUTE), text)].into_iter().collect(),
        ..LayerAttributes::default()
    };
    let descriptions = channels.iter().map(|channel| describe(channel)).collect();
    Ok(Header::new(Text::from(""), bounds.size, descriptions)
        .with_encoding(exr::compression::Compression::ZIP1, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_shared_attributes(ImageAttributes::new(display_window))
        .with_attributes(attributes))
}

fn describe(channel: &Channel) -> ChannelDescription {
    let sample_type = match channel.samples {
        Samples::F32(_) => SampleType::F32,
        Samples::U32(_) => SampleType::U32,
    };
    // The last argument guides lossy compressions alone; true is what holds for anything but colours.
    ChannelDescription::new(channel.name.as_str(), sample_type, true)
}

fn integer_bounds(bounds: PixelBounds) -> Result<IntegerBounds, ExrError> {
    let position = Vec2(i32::try_from(bounds.x0)?, i32::try_from(bounds.y0)?);
    Ok(IntegerBounds::new(position, (bounds.width() as usize, bounds.height() as usize)))
}

/// Row `line` of the data window as the file stores it: by `zips`, or as it is where that would not be shorter.
fn chunk(channels: &[&Channel], window: PixelBounds, line: u32, deflate: &mut Compress) -> Result<Chunk, ExrError> {
    let bytes = row_bytes(channels, window.width() as usize, line as usize);
    let pixels = zip(&bytes, deflate)?.unwrap_or(bytes);
    let block =
        CompressedScanLineBlock { y_coordinate: i32::try_from(window.y0 + line)?, compressed_pixels_le: pixels };
    Ok(Chunk { layer_index: 0, compressed_block: CompressedBlock::ScanLine(block) })
}

/// The row's samples, channel after channel, in little-endian order.
fn row_bytes(channels: &[&Channel], width: usize, line: usize) -> Vec<u8> {
    let row = line * width..(line + 1) * width;
    let mut bytes = Vec::with_capacity(channels.len() * width * size_of::<u32>());
    for channel in channels {
        match &channel.samples {
            Samples::F32(values) => bytes.extend(values[row.clone()].iter().flat_map(|value| value.to_le_bytes())),
            Samples::U32(values) => bytes.extend(values[row.clone()].iter().flat_map(|value| value.to_le_bytes())),
        }
    }
    bytes
}

/// The format's ZIP: bytes at even places before those at odd ones, each as its difference from the one before,
/// then deflate. `None` where that is not shorter than `bytes`, since readers tell by the length.
fn zip(bytes: &[u8], deflate: &mut Compress) -> io::Result<Option<Vec<u8>>> {
    let (pairs, _) = bytes.as_chunks::<2>();
    let split: Vec<u8> = pairs.iter().map(|pair| pair[0]).chain(pairs.iter().map(|pair| pair[1])).collect();
    let mut differences = vec![split[0]; split.len()];
    for ((difference, before), byte) in differences[1..].iter_mut().zip(&split).zip(&split[1..]) {
        *difference = byte.wrapping_sub(*before).wrapping_add(128);
    }
    let mut zipped = Vec::with_capacity(bytes.len() - 1);
    deflate.reset();
    let status = deflate.compress_vec(&differences, &mut zipped, FlushCompress::Finish)?;
    Ok((status == Status::StreamEnd).then_some(zipped))
}

/// An error of the disk as it came, any other as the input's.
fn into_io(error: ExrError) -> io::Error {
    match error {
        ExrError::Io(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}
