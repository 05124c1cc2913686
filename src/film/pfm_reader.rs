//! Reads PFM files of one channel as depths.

use super::{Channel, ChannelName, Image, PixelBounds, Samples};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use std::path::Path;

/// Bytes of a sample.
const SAMPLE: usize = 4;

/// Returns true if the file claims to be a PFM.
pub fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(b"Pf\n") || bytes.starts_with(b"PF\n")
}

/// Reads `bytes`, the content of the file `path`, as depths `Z`.
///
/// # Errors
/// The file is damaged, or has three channels, which have no names.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Image> {
    let refused = |found: &str| {
        let diagnostic = Diagnostic::new(format!("this PFM file cannot be read: {found}"));
        let note = "expected one channel, which is taken as depths";
        Error::bad_input(diagnostic.at(SourceLocation::file(path)).note(note))
    };
    if bytes.starts_with(b"PF") {
        return Err(refused("it has three channels without names"));
    }
    let header = parse(bytes).ok_or_else(|| refused("its header is damaged"))?;
    let ([width, height], is_little_endian, samples) = header;
    let bounds = PixelBounds::of_film(width, height);
    if bounds.is_empty() || width.max(height) > PixelBounds::MAX_SIDE {
        return Err(refused(&format!("it has {width} x {height} pixels")));
    }
    if u128::from(bounds.area()) * SAMPLE as u128 != samples.len() as u128 {
        return Err(refused("its length does not fit its size"));
    }
    let (samples, _) = samples.as_chunks::<SAMPLE>();
    let from_bytes = if is_little_endian {
        f32::from_le_bytes
    } else {
        f32::from_be_bytes
    };
    // Rows come from the bottom.
    let rows = samples.chunks_exact(width as usize).rev();
    let values = rows.flatten().map(|bytes| from_bytes(*bytes)).collect();
    Ok(Image {
        display_window: (width, height),
        data_window: bounds,
        channels: vec![Channel {
            name: ChannelName::Z,
            samples: Samples::F32(values),
        }],
    })
}

/// The width and height, true for little-endian samples, and the samples.
fn parse(bytes: &[u8]) -> Option<([u32; 2], bool, &[u8])> {
    let mut lines = bytes.splitn(4, |byte| *byte == b'\n');
    lines.next()?;
    let mut line = || std::str::from_utf8(lines.next()?).ok();
    let (width, height) = line()?.split_once(' ')?;
    let scale: f64 = line()?.parse().ok()?;
    let size = [width.parse().ok()?, height.parse().ok()?];
    Some((size, scale < 0.0, lines.next()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::pfm_file;
    use crate::progress::Progress;

    fn image() -> Image {
        let values = [0.5, f32::INFINITY, f32::NAN, -1.0, 3.0, 0.0];
        Image {
            display_window: (3, 2),
            data_window: PixelBounds::of_film(3, 2),
            channels: vec![Channel {
                name: ChannelName::Z,
                samples: Samples::F32(values.to_vec()),
            }],
        }
    }

    fn written() -> Vec<u8> {
        let mut file = Vec::new();
        pfm_file::write(&image(), &[ChannelName::Z], &mut file, Progress::SILENT).unwrap();
        file
    }

    #[test]
    fn depths_are_read_as_they_are_written() {
        let read = decode(Path::new("a.pfm"), &written()).unwrap();
        let bits = |image: &Image| {
            let z = image.measures(ChannelName::Z).unwrap();
            z.iter().map(|z| z.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(
            (bits(&read), read.data_window),
            (bits(&image()), image().data_window)
        );
        let big_endian = [b"Pf\n1 1\n1.0\n".to_vec(), 1.5f32.to_be_bytes().to_vec()].concat();
        let read = decode(Path::new("a.pfm"), &big_endian).unwrap();
        assert_eq!(read.measures(ChannelName::Z).unwrap(), [1.5]);
    }

    #[test]
    fn damage_is_an_error_and_no_panic() {
        let file = written();
        for end in 0..file.len() {
            assert!(decode(Path::new("a.pfm"), &file[..end]).is_err(), "{end}");
        }
        for place in 0..file.len() {
            let mut changed = file.clone();
            changed[place] ^= 0xff;
            drop(decode(Path::new("a.pfm"), &changed));
        }
        let error = decode(Path::new("a.pfm"), b"PF\n1 1\n-1.0\n")
            .unwrap_err()
            .to_string();
        assert!(error.contains("three channels without names"), "{error}");
    }
}
