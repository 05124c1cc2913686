//! PNG files, read: colours.

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::film::PixelBounds;
use image::{ColorType, DynamicImage, ImageFormat, ImageReader, Limits};
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufReader, Cursor, Read, Seek, SeekFrom};
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
/// What is no PNG file, damaged, cut off, or too large for the decoder's limits.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Picture> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(PixelBounds::MAX_SIDE), Some(PixelBounds::MAX_SIDE));
    reader.limits(limits);
    reader.decode().map(Picture::of).map_err(|error| refused(path, &error))
}

/// The words that the file `path` has under `keyword`, where it has some; pixels are not read.
///
/// # Errors
/// What is no PNG file, damaged, or cannot be read.
pub fn read_text(path: &Path, keyword: &str) -> Result<Option<String>> {
    let file = File::open(path).map_err(|error| Error::reading(path, &error))?;
    let reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(|error| refused(path, &error))?;
    let info = reader.info();
    if let Some(chunk) = info.uncompressed_latin1_text.iter().find(|chunk| chunk.keyword == keyword) {
        return Ok(Some(chunk.text.clone()));
    }
    let utf8 = info.utf8_text.iter().find(|chunk| chunk.keyword == keyword);
    utf8.map(|chunk| chunk.get_text()).transpose().map_err(|error| refused(path, &error))
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
    let found = Diagnostic::new(format!("this PNG file cannot be read: {error}")).at(SourceLocation::file(path));
    Error::bad_input(found.note("expected a whole file: it may be damaged or cut off"))
}

impl Picture {
    fn of(decoded: DynamicImage) -> Picture {
        let (width, height) = (decoded.width(), decoded.height());
        let is_deep =
            matches!(decoded.color(), ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16);
        match is_deep {
            true => {
                let pixels = decoded.into_rgba16().pixels().map(|pixel| pixel.0).collect();
                Picture { width, height, pixels, full: u16::MAX }
            }
            false => {
                let pixels = decoded.into_rgba8().pixels().map(|pixel| pixel.0.map(u16::from)).collect();
                Picture { width, height, pixels, full: u8::MAX.into() }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use image::{GrayImage, ImageBuffer, Luma, Rgb};

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
        let gray = decoded(&encoded(GrayImage::from_fn(2, 1, |x, _| Luma([x as u8 * 7])))).unwrap();
        let expected = vec![[0, 0, 0, 255], [7, 7, 7, 255]];
        assert_eq!(gray, Picture { width: 2, height: 1, pixels: expected, full: 255 });
        let deep = ImageBuffer::from_fn(1, 2, |_, y| Rgb([y as u16, 300, 65535]));
        let deep = decoded(&encoded(DynamicImage::ImageRgb16(deep))).unwrap();
        let expected = vec![[0, 300, 65535, 65535], [1, 300, 65535, 65535]];
        assert_eq!(deep, Picture { width: 1, height: 2, pixels: expected, full: 65535 });
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
            assert!(error.to_string().starts_with("a.png: this PNG file cannot be read: "), "{error}");
        }
        for place in 0..file.len() {
            let mut changed = file.clone();
            changed[place] ^= 0xff;
            drop(decoded(&changed));
        }
    }
}
