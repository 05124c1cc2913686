//! Reads PNG files: 16-bit depths and numbers as views write them, and the texts of any PNG.

use super::{Channel, ChannelName, Image, MISS, PixelBounds, Samples, View};
use crate::error::{Diagnostic, Error, Result, SourceLocation, grouped};
use crate::film::exr_file::ATTRIBUTE;
use crate::input::BudgetFactor;
use crate::memory;
use png::{BitDepth, ColorType, Decoder, Info, Limits};
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::Path;

/// The first bytes of any PNG file.
const MAGIC: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// The last bytes of any PNG file: a chunk without content.
const END: [u8; 12] = *b"\0\0\0\0IEND\xae\x42\x60\x82";

/// A limit on the bytes of a text after decompression.
const MAX_TEXT: usize = 1 << 20;

/// Returns true if the file claims to be a PNG.
pub fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// Reads `bytes`, the content of the file `path`: one 16-bit gray channel. It holds numbers
/// if the header says so, else depths in steps of an unknown size.
///
/// The image has `Z` as integers, unlike images of other formats, and `A`. A miss is the value that
/// the file's header names, else 0.
///
/// # Errors
/// The file is not a PNG of one 16-bit channel, is damaged, or takes far more memory than its size.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Image> {
    decode_within(path, bytes, BudgetFactor::default())
}

/// Like [`decode`], with `factor` times the usual memory for pixels.
pub(super) fn decode_within(path: &Path, bytes: &[u8], factor: BudgetFactor) -> Result<Image> {
    let limit = factor.image_limit(bytes.len() as u64);
    let mut decoder = decoder(Cursor::new(bytes));
    decoder.set_limits(Limits {
        bytes: usize::try_from(limit).unwrap_or(usize::MAX),
    });
    let mut reader = decoder.read_info().map_err(|error| damaged(path, &error))?;
    let info = reader.info();
    let (width, height) = (info.width, info.height);
    if (info.color_type, info.bit_depth) != (ColorType::Grayscale, BitDepth::Sixteen) {
        let diagnostic = Diagnostic::new("this PNG file holds colours, not data")
            .at(SourceLocation::file(path))
            .note("expected 16-bit data, as from --view depth16, or an .exr, .npy or .pfm");
        return Err(Error::bad_input(diagnostic));
    }
    check_size(path, (width, height), bytes.len(), factor)?;
    let header = text(info, ATTRIBUTE).map_err(|error| damaged(path, &error))?;
    let (name, miss) = header.map_or((ChannelName::Z, 0), |header| content_of(&header));
    let too_large = || damaged(path, &"it is too large for this machine's memory");
    let mut samples = Vec::new();
    let size = reader.output_buffer_size().ok_or_else(too_large)?;
    samples.try_reserve_exact(size).map_err(|_| too_large())?;
    samples.resize(size, 0);
    reader
        .next_frame(&mut samples)
        .map_err(|error| damaged(path, &error))?;
    let steps = samples
        .as_chunks()
        .0
        .iter()
        .map(|bytes| u16::from_be_bytes(*bytes));
    let is_hit = |step: u16| if step == miss { 0.0 } else { 1.0 };
    let a = Samples::F32(steps.clone().map(is_hit).collect());
    let values = Samples::U32(steps.map(u32::from).collect());
    Ok(Image {
        display_window: (width, height),
        data_window: PixelBounds::of_film(width, height),
        channels: vec![
            Channel {
                name: ChannelName::A,
                samples: a,
            },
            Channel {
                name,
                samples: values,
            },
        ],
    })
}

/// The channel that a header names by its view, else depth; and the value of a miss, else 0.
fn content_of(header: &str) -> (ChannelName, u16) {
    let header: Option<serde_json::Value> = serde_json::from_str(header).ok();
    let field = |name: &str| header.as_ref().map(|header| &header[name]);
    let view = field("view").and_then(|view| view.as_str()?.parse().ok());
    let name = match view {
        Some(View::Id16) => ChannelName::Id,
        Some(View::Instance16) => ChannelName::Instance,
        _ => ChannelName::Z,
    };
    let miss = field(MISS).and_then(|miss| miss.as_u64()?.try_into().ok());
    (name, miss.unwrap_or(0))
}

/// Refuses images that are too wide or high, or take far more memory than the file has bytes.
fn check_size(
    path: &Path,
    (width, height): (u32, u32),
    size: usize,
    factor: BudgetFactor,
) -> Result<()> {
    let limit = PixelBounds::MAX_SIDE;
    if width.max(height) > limit {
        let found = format!("it has {width} x {height} pixels, more than {limit} along a side");
        return Err(damaged(path, &found));
    }
    const PIXEL: u64 = (size_of::<f32>() + size_of::<u32>()) as u64;
    let taken = (u64::from(width) * u64::from(height)).saturating_mul(PIXEL);
    if taken > factor.image_limit(size as u64) {
        let found = format!(
            "{} bytes of PNG hold {width} x {height} pixels, which take {} bytes of memory",
            grouped(size as u64),
            grouped(taken)
        );
        let diagnostic = Diagnostic::new(found).at(SourceLocation::file(path));
        return Err(Error::bad_input(diagnostic.note(factor.advice())));
    }
    let path = path.display();
    memory::check(taken, || {
        format!("{path}: this image is too large for this machine's memory")
    })
}

/// A decoder that ignores colour profiles.
fn decoder<R: BufRead + Seek>(file: R) -> Decoder<R> {
    let mut decoder = Decoder::new(file);
    decoder.set_ignore_iccp_chunk(true);
    decoder
}

/// Reads the text of the file `path` under `keyword`, if it has one; reads no pixels.
///
/// # Errors
/// The file is not a PNG, is damaged or cannot be read, or the text exceeds a megabyte.
pub fn read_text(path: &Path, keyword: &str) -> Result<Option<String>> {
    let file = File::open(path).map_err(|error| Error::reading(path, &error))?;
    let reader = decoder(BufReader::new(file)).read_info();
    let reader = reader.map_err(|error| damaged(path, &error))?;
    text(reader.info(), keyword).map_err(|error| damaged(path, &error))
}

fn text(info: &Info, keyword: &str) -> std::result::Result<Option<String>, png::DecodingError> {
    let mut latin1 = info.uncompressed_latin1_text.iter();
    if let Some(chunk) = latin1.find(|chunk| chunk.keyword == keyword) {
        return Ok(Some(chunk.text.clone()));
    }
    let utf8 = info.utf8_text.iter().find(|chunk| chunk.keyword == keyword);
    let Some(mut chunk) = utf8.cloned() else {
        return Ok(None);
    };
    chunk.decompress_text_with_limit(MAX_TEXT)?;
    chunk.get_text().map(Some)
}

/// Returns true if the file `path` ends like every PNG file; reads no pixels.
///
/// # Errors
/// The file cannot be read; a file that is too short is no error.
pub fn is_whole(path: &Path) -> Result<bool> {
    let last = || {
        let mut file = File::open(path)?;
        let mut bytes = [0; END.len()];
        file.seek(SeekFrom::End(-(END.len() as i64)))?;
        file.read_exact(&mut bytes).map(|()| bytes)
    };
    match last() {
        Ok(bytes) => Ok(bytes == END),
        // The file has fewer bytes.
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => Ok(false),
        Err(error) => Err(Error::reading(path, &error)),
    }
}

fn damaged(path: &Path, error: &impl Display) -> Error {
    let diagnostic = Diagnostic::new(format!("this PNG file cannot be read: {error}"))
        .at(SourceLocation::file(path))
        .note("the file is truncated or damaged; was its writer interrupted?");
    Error::bad_input(diagnostic)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use crate::film::png_file::{self, Text};
    use crate::progress::Progress;
    use image::{DynamicImage, ImageFormat, RgbImage};

    fn file(steps: &[u16], header: Option<&str>) -> Vec<u8> {
        let keyword = ATTRIBUTE;
        let text = |header: &str| Text {
            keyword,
            text: header.to_owned(),
        };
        let texts: Vec<Text> = header.map(text).into_iter().collect();
        let mut file = Cursor::new(Vec::new());
        png_file::write_gray16([2, 2], steps, &texts, &mut file, Progress::SILENT).unwrap();
        file.into_inner()
    }

    fn decoded(file: &[u8]) -> Result<Image> {
        decode(Path::new("a.png"), file)
    }

    #[test]
    fn depths_are_read_as_steps_with_misses() {
        let steps = [0, 1, 300, 65535];
        for (header, a) in [
            (None, [0.0, 1.0, 1.0, 1.0]),
            (Some("{\"miss\":300}"), [1.0, 1.0, 0.0, 1.0]),
            (Some("no JSON"), [0.0, 1.0, 1.0, 1.0]),
        ] {
            let image = decoded(&file(&steps, header)).unwrap();
            assert_eq!(image.data_window, PixelBounds::of_film(2, 2));
            assert_eq!(image.numbers(ChannelName::Z).unwrap(), steps.map(u32::from));
            assert_eq!(image.measures(ChannelName::A).unwrap(), a);
        }
    }

    #[test]
    fn the_header_names_other_numbers() {
        for (view, name) in [
            ("depth16", ChannelName::Z),
            ("id16", ChannelName::Id),
            ("instance16", ChannelName::Instance),
        ] {
            let header = format!("{{\"view\":\"{view}\"}}");
            let image = decoded(&file(&[0, 1, 2, 65535], Some(&header))).unwrap();
            assert_eq!(image.numbers(name), Some(&[0, 1, 2, 65535][..]), "{view}");
            assert_eq!(
                image.measures(ChannelName::A),
                Some(&[0.0, 1.0, 1.0, 1.0][..])
            );
        }
    }

    #[test]
    fn colours_are_refused() {
        let mut file = Cursor::new(Vec::new());
        let image: DynamicImage = RgbImage::new(5, 4).into();
        image.write_to(&mut file, ImageFormat::Png).unwrap();
        let error = decoded(file.get_ref()).unwrap_err().to_string();
        assert!(
            error.starts_with("a.png: this PNG file holds colours, not data"),
            "{error}"
        );
    }

    #[test]
    fn a_missing_end_is_found_without_reading_pixels() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.png");
        let file = file(&[1, 2, 3, 4], None);
        for end in 0..=file.len() {
            std::fs::write(&path, &file[..end]).unwrap();
            assert_eq!(is_whole(&path).unwrap(), end == file.len());
        }
    }

    #[test]
    fn damage_is_an_error_and_no_panic() {
        let file = file(&[1, 2, 3, 4], None);
        for end in 0..file.len() - 12 {
            let error = decoded(&file[..end]).expect_err("truncated");
            assert_eq!(error.kind(), ErrorKind::BadInput);
            let message = error.to_string();
            assert!(
                message.starts_with("a.png: this PNG file cannot be read: "),
                "{message}"
            );
        }
        for place in 0..file.len() {
            let mut changed = file.clone();
            changed[place] ^= 0xff;
            drop(decoded(&changed));
        }
    }
}
