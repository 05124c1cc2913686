//! PNG files, read: colours.

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::film::PixelBounds;
use crate::input::BudgetFactor;
use crate::memory;
use png::{BitDepth, Decoder, Limits, OutputInfo, Transformations};
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::Path;

/// The first bytes of any PNG file.
const MAGIC: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// The last bytes of any PNG file: a chunk without content.
const END: [u8; 12] = *b"\0\0\0\0IEND\xae\x42\x60\x82";

/// A picture: colours, of which nothing is known but how they look.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue and opacity, row by row from the top.
    pub pixels: Vec<[u16; 4]>,
    /// The largest value of a component: 255 or 65535.
    pub full: u16,
}

/// Whether a file of these bytes claims to be a PNG file.
pub fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// The picture in `bytes`, the content of the file `path`; grays become colours.
///
/// # Errors
/// What is no PNG file, damaged, cut off, or takes far more memory than the file.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Picture> {
    decode_within(path, bytes, BudgetFactor::default())
}

/// As [`decode`], where pixels may take so many times the usual memory.
pub(super) fn decode_within(path: &Path, bytes: &[u8], factor: BudgetFactor) -> Result<Picture> {
    let limit = factor.image_limit(bytes.len() as u64);
    let mut decoder = decoder(Cursor::new(bytes));
    decoder.set_limits(Limits {
        bytes: usize::try_from(limit).unwrap_or(usize::MAX),
    });
    // Words and colour profiles are nothing that is compared.
    decoder.set_ignore_text_chunk(true);
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(|error| refused(path, &error))?;
    let (width, height) = (reader.info().width, reader.info().height);
    check_size(path, (width, height), bytes.len(), factor)?;
    let too_large = || refused(path, &"it is too large for this machine's memory");
    let mut samples = Vec::new();
    let size = reader.output_buffer_size().ok_or_else(too_large)?;
    samples.try_reserve_exact(size).map_err(|_| too_large())?;
    samples.resize(size, 0);
    let frame = reader
        .next_frame(&mut samples)
        .map_err(|error| refused(path, &error))?;
    Ok(Picture::of(&samples[..frame.buffer_size()], &frame))
}

/// Refuses pictures that are too wide or high, and those whose pixels take far more memory than the file.
fn check_size(
    path: &Path,
    (width, height): (u32, u32),
    size: usize,
    factor: BudgetFactor,
) -> Result<()> {
    let limit = PixelBounds::MAX_SIDE;
    if width.max(height) > limit {
        return Err(refused(
            path,
            &format!("it is {width} x {height} pixels, and a side has {limit} at most"),
        ));
    }
    let taken = (u64::from(width) * u64::from(height)).saturating_mul(size_of::<[u16; 4]>() as u64);
    if taken > factor.image_limit(size as u64) {
        let found = format!(
            "{size} bytes of PNG hold {width} x {height} pixels, which take {taken} bytes of memory"
        );
        let diagnostic = Diagnostic::new(found).at(SourceLocation::file(path));
        return Err(Error::bad_input(diagnostic.note(factor.advice())));
    }
    memory::check(taken, || {
        format!(
            "{}: this image is too large for this machine's memory",
            path.display()
        )
    })
}

/// A decoder that leaves colour profiles alone.
fn decoder<R: BufRead + Seek>(file: R) -> Decoder<R> {
    let mut decoder = Decoder::new(file);
    decoder.set_ignore_iccp_chunk(true);
    decoder
}

/// Bytes of a text at most, when it is decompressed.
const MOST_TEXT: usize = 1 << 20;

/// The words that the file `path` has under `keyword`, where it has some; pixels are not read.
///
/// # Errors
/// What is no PNG file, damaged, or cannot be read; words of more than a megabyte.
pub fn read_text(path: &Path, keyword: &str) -> Result<Option<String>> {
    let file = File::open(path).map_err(|error| Error::reading(path, &error))?;
    let reader = decoder(BufReader::new(file))
        .read_info()
        .map_err(|error| refused(path, &error))?;
    let info = reader.info();
    if let Some(chunk) = info
        .uncompressed_latin1_text
        .iter()
        .find(|chunk| chunk.keyword == keyword)
    {
        return Ok(Some(chunk.text.clone()));
    }
    let Some(mut chunk) = info
        .utf8_text
        .iter()
        .find(|chunk| chunk.keyword == keyword)
        .cloned()
    else {
        return Ok(None);
    };
    let text = chunk
        .decompress_text_with_limit(MOST_TEXT)
        .and_then(|()| chunk.get_text());
    text.map(Some).map_err(|error| refused(path, &error))
}

/// Whether the file `path` has the end that every PNG file has; no pixel is read.
///
/// # Errors
/// Reading; a file that ends too early is no error.
pub fn is_whole(path: &Path) -> Result<bool> {
    let last = || {
        let mut file = File::open(path)?;
        let mut bytes = [0; END.len()];
        file.seek(SeekFrom::End(-(END.len() as i64)))?;
        file.read_exact(&mut bytes).map(|()| bytes)
    };
    match last() {
        Ok(bytes) => Ok(bytes == END),
        // A file of fewer bytes has no place that far from its end.
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => Ok(false),
        Err(error) => Err(Error::reading(path, &error)),
    }
}

fn refused(path: &Path, error: &impl Display) -> Error {
    let found = Diagnostic::new(format!("this PNG file cannot be read: {error}"))
        .at(SourceLocation::file(path));
    Error::bad_input(found.note("expected a whole file: it may be damaged or cut off"))
}

impl Picture {
    /// The picture of `samples`, a frame without palette whose samples have 8 or 16 bits.
    fn of(samples: &[u8], frame: &OutputInfo) -> Picture {
        let channels = frame.color_type.samples();
        let is_deep = frame.bit_depth == BitDepth::Sixteen;
        let full = if is_deep { u16::MAX } else { u8::MAX.into() };
        let pixel = |values: &[u16]| match *values {
            [gray] => [gray, gray, gray, full],
            [gray, alpha] => [gray, gray, gray, alpha],
            [red, green, blue] => [red, green, blue, full],
            [red, green, blue, alpha] => [red, green, blue, alpha],
            _ => [0; 4],
        };
        let mut values = [0; 4];
        let values = &mut values[..channels];
        let pixels = match is_deep {
            true => samples
                .chunks_exact(2 * channels)
                .map(|bytes| {
                    let deep = bytes
                        .as_chunks()
                        .0
                        .iter()
                        .map(|bytes| u16::from_be_bytes(*bytes));
                    values
                        .iter_mut()
                        .zip(deep)
                        .for_each(|(value, sample)| *value = sample);
                    pixel(values)
                })
                .collect(),
            false => samples
                .chunks_exact(channels)
                .map(|bytes| {
                    values
                        .iter_mut()
                        .zip(bytes)
                        .for_each(|(value, sample)| *value = (*sample).into());
                    pixel(values)
                })
                .collect(),
        };
        Picture {
            width: frame.width,
            height: frame.height,
            pixels,
            full,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use image::{DynamicImage, GrayImage, ImageBuffer, ImageFormat, Luma, Rgb};

    fn encoded(image: impl Into<DynamicImage>) -> Vec<u8> {
        let mut file = Cursor::new(Vec::new());
        image.into().write_to(&mut file, ImageFormat::Png).unwrap();
        file.into_inner()
    }

    fn decoded(file: &[u8]) -> Result<Picture> {
        decode(Path::new("a.png"), file)
    }

    #[test]
    fn eight_and_sixteen_bits_are_read() {
        let gray = decoded(&encoded(GrayImage::from_fn(2, 1, |x, _| {
            Luma([x as u8 * 7])
        })))
        .unwrap();
        let expected = vec![[0, 0, 0, 255], [7, 7, 7, 255]];
        assert_eq!(
            gray,
            Picture {
                width: 2,
                height: 1,
                pixels: expected,
                full: 255
            }
        );
        let deep = ImageBuffer::from_fn(1, 2, |_, y| Rgb([y as u16, 300, 65535]));
        let deep = decoded(&encoded(DynamicImage::ImageRgb16(deep))).unwrap();
        let expected = vec![[0, 300, 65535, 65535], [1, 300, 65535, 65535]];
        assert_eq!(
            deep,
            Picture {
                width: 1,
                height: 2,
                pixels: expected,
                full: 65535
            }
        );
    }

    #[test]
    fn the_end_of_a_file_is_missed_without_reading_pixels() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.png");
        let file = encoded(GrayImage::from_fn(5, 4, |x, y| Luma([(x * y) as u8])));
        for end in 0..=file.len() {
            std::fs::write(&path, &file[..end]).unwrap();
            assert_eq!(is_whole(&path).unwrap(), end == file.len());
        }
    }

    #[test]
    fn damage_is_an_error_and_no_panic() {
        let file = encoded(GrayImage::from_fn(5, 4, |x, y| Luma([(x * y) as u8])));
        for end in 0..file.len() - 12 {
            let error = decoded(&file[..end]).expect_err("cut off");
            assert_eq!(error.kind(), ErrorKind::BadInput);
            assert!(
                error
                    .to_string()
                    .starts_with("a.png: this PNG file cannot be read: "),
                "{error}"
            );
        }
        for place in 0..file.len() {
            let mut changed = file.clone();
            changed[place] ^= 0xff;
            drop(decoded(&changed));
        }
    }
}
