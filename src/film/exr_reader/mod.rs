//! Reads OpenEXR files of any program: the channels that feimos knows.
//!
//! Reads scan lines or tiles, in any order and any compression except those for colours. The crate
//! reads the header and decompresses; this module reads the offset table and the chunks, so that it
//! knows that a file can hold what its header claims before it allocates memory.

mod blocks;
mod convert;
mod ending;
mod errors;
mod part;
#[cfg(test)]
mod tests;

use super::{Channel, ChannelName, Image, Metadata, PixelBounds, Samples};
use crate::error::{Diagnostic, Error, Result, SourceLocation, grouped};
use crate::input::{self, BudgetFactor};
use crate::memory;
use crate::parallel::CollectVec;
use blocks::{Block, blocks};
use errors::{damaged, wrong};
use exr::meta::MetaData;
use part::Part;
use rayon::prelude::*;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, Seek};
use std::path::Path;

/// The first bytes of every OpenEXR file.
const MAGIC: [u8; 4] = exr::meta::magic_number::BYTES;

/// Blocks in a batch: few enough that memory does not hold the decompressed image twice.
const BATCH: usize = 64;

/// Returns true if the file claims to be an OpenEXR file.
pub fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// Reads the image in the file `path`, like [`decode`].
///
/// # Errors
/// Like [`decode`]; or the file cannot be read.
pub fn read(path: &Path) -> Result<Image> {
    decode(path, &input::read(path)?)
}

/// The content of the header of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Width and height of the whole film.
    pub film: (u32, u32),
    /// The pixels of the film that the file holds.
    pub window: PixelBounds,
    /// The channels that feimos knows, in the order of the file.
    pub channels: Vec<ChannelName>,
    /// The metadata.
    pub metadata: Metadata,
}

/// Reads the header of the file `path`, but no pixels.
///
/// # Errors
/// Like [`read`], as far as the header shows.
pub fn read_outline(path: &Path) -> Result<Outline> {
    let reading = |error: io::Error| Error::reading(path, &error);
    let mut file = BufReader::new(File::open(path).map_err(reading)?);
    file.fill_buf().map_err(reading)?;
    let mut outline = || {
        let meta = meta_data(&mut file)?;
        let Part {
            film,
            window,
            channels,
            metadata,
            ..
        } = Part::find(&meta)?;
        Ok(Outline {
            film,
            window,
            channels: channels.iter().map(|channel| channel.name).collect(),
            metadata,
        })
    };
    outline().map_err(|error: Error| error.or_at(|| SourceLocation::file(path)))
}

/// Returns true if the file `path` is complete, as far as its offset tables and last chunks show;
/// reads no pixels.
///
/// # Errors
/// Like [`read_outline`]; a file that is too short is no error.
pub fn is_whole(path: &Path) -> Result<bool> {
    let reading = |error: io::Error| Error::reading(path, &error);
    let mut file = BufReader::new(File::open(path).map_err(reading)?);
    let meta = meta_data(&mut file).map_err(|error| error.or_at(|| SourceLocation::file(path)))?;
    let start = file.stream_position().map_err(reading)?;
    ending::has_end(&mut file, start, &meta).map_err(reading)
}

/// Reads the image in the file `path` and its metadata, with `factor` times the usual memory for
/// pixels.
///
/// # Errors
/// Like [`read`].
pub fn read_with_metadata(path: &Path, factor: BudgetFactor) -> Result<(Image, Metadata)> {
    decoded(&input::read(path)?, factor).map_err(|error| error.or_at(|| SourceLocation::file(path)))
}

/// Reads the image in `bytes`, the content of the file `path`: the channels that feimos knows of
/// the first part that has any, each in the type that it has in feimos. Other types are converted
/// if they hold the same numbers. Of several resolutions the largest is read. The origin of the
/// display window becomes that of the film.
///
/// # Errors
/// The file is not an OpenEXR file, is damaged or truncated; it has deep data, subsampled channels,
/// DWA or B44; the data window leaves the display window or is too large; a number does not fit the
/// type of a channel. Memory is allocated only for what the file can hold.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Image> {
    decode_within(path, bytes, BudgetFactor::default())
}

/// Like [`decode`], with `factor` times the usual memory for pixels.
pub(super) fn decode_within(path: &Path, bytes: &[u8], factor: BudgetFactor) -> Result<Image> {
    let decoded =
        decoded(bytes, factor).map_err(|error| error.or_at(|| SourceLocation::file(path)));
    decoded.map(|(image, _)| image)
}

fn decoded(bytes: &[u8], factor: BudgetFactor) -> Result<(Image, Metadata)> {
    let mut file = Cursor::new(bytes);
    let meta = meta_data(&mut file)?;
    let part = Part::find(&meta)?;
    check_size(&part, bytes.len(), factor)?;
    let blocks = blocks(bytes, file.position(), &meta, &part)?;
    let image = fill(&meta, &part, &blocks)?;
    Ok((image, part.metadata))
}

/// Refuses images that take far more memory than the file has bytes: zeros compress a thousandfold.
fn check_size(part: &Part, size: usize, factor: BudgetFactor) -> Result<()> {
    let bytes_each = part
        .bytes_per_pixel()
        .max(part.channels.len() * size_of::<f32>());
    let bytes = part.window.area().saturating_mul(bytes_each as u64);
    if bytes <= factor.image_limit(size as u64) {
        return Ok(());
    }
    let (width, height) = (part.window.width(), part.window.height());
    let found = format!(
        "{} bytes of OpenEXR hold {width} x {height} pixels, which take {} bytes of memory",
        grouped(size as u64),
        grouped(bytes)
    );
    Err(Error::bad_input(
        Diagnostic::new(found).note(factor.advice()),
    ))
}

/// Reads the headers of a file without checks. All readers are passed as one type, since the crate
/// compiles a long parser for each type.
pub(crate) fn header_of(file: &mut dyn Read) -> exr::error::Result<MetaData> {
    MetaData::read_from_buffered(file, false)
}

/// Reads and checks the headers of a file, and nothing after them.
fn meta_data(file: &mut impl BufRead) -> Result<MetaData> {
    if !file.fill_buf().is_ok_and(recognises) {
        return Err(wrong(
            "this is not an OpenEXR file",
            "its first bytes to be 76 2f 31 01",
        ));
    }
    let meta = header_of(file).map_err(|error| damaged("header", &error))?;
    if meta.headers.iter().any(|header| header.deep) {
        let expected = "one sample a pixel: flatten the image first";
        return Err(wrong(
            "the file holds deep data, several samples a pixel",
            expected,
        ));
    }
    MetaData::validate(&meta.headers, false).map_err(|error| damaged("header", &error))?;
    Ok(meta)
}

/// Decompresses all `blocks` into an image.
fn fill(meta: &MetaData, part: &Part, blocks: &[Block]) -> Result<Image> {
    let area = part.window.area() as usize;
    let bytes = area.saturating_mul(part.channels.len() * size_of::<f32>());
    // Zeroed memory is free until it is used, but a refusal ends the program: so reserve it first.
    memory::check(bytes as u64, || {
        "this image is too large for this machine's memory".to_owned()
    })?;
    Vec::<u8>::new().try_reserve_exact(bytes).map_err(|_| {
        wrong(
            format!("the image takes {bytes} bytes of memory"),
            "as many to be had",
        )
    })?;
    let zeros = |is_integer: bool| {
        if is_integer {
            Samples::U32(vec![0; area])
        } else {
            Samples::F32(vec![0.0; area])
        }
    };
    let mut samples: Vec<Samples> = part
        .channels
        .iter()
        .map(|channel| zeros(channel.name.is_integer()))
        .collect();
    for batch in blocks.chunks(BATCH) {
        let decompressed: Vec<_> = batch
            .par_iter()
            .map(|block| block.decompress(meta, part))
            .collect_vec();
        for (block, pixels) in batch.iter().zip(decompressed) {
            put(part, block, &pixels?, &mut samples)?;
        }
    }
    let named = part
        .channels
        .iter()
        .zip(samples)
        .map(|(channel, samples)| Channel {
            name: channel.name,
            samples,
        });
    Ok(Image {
        display_window: part.film,
        data_window: part.window,
        channels: named.collect(),
    })
}

/// Copies a decompressed block into the samples of each channel.
fn put(part: &Part, block: &Block, pixels: &[u8], samples: &mut [Samples]) -> Result<()> {
    let width = block.width as usize;
    let rows = pixels.chunks_exact(width * part.bytes_per_pixel());
    for (y, row) in (block.y..).zip(rows) {
        let start = y as usize * part.window.width() as usize + block.x as usize;
        for (channel, samples) in part.channels.iter().zip(&mut *samples) {
            let bytes = &row[channel.offset * width..][..channel.bytes() * width];
            convert::put(channel.sample_type, bytes, samples, start).map_err(|unfit| {
                let (x, y) = (
                    part.window.x0 + block.x + unfit.place as u32,
                    part.window.y0 + y,
                );
                let found = format!(
                    "channel {} holds {} in pixel ({x}, {y})",
                    channel.name, unfit.value
                );
                wrong(found, unfit.expected)
            })?;
        }
    }
    Ok(())
}
