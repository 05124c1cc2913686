//! Reads NumPy arrays as `feimos render` writes them: `.npy` version 1.0, little-endian, C order.

use super::{Aov, Channel, ChannelName, Image, PixelBounds, Samples};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use std::path::Path;

/// The first bytes of every NumPy file.
const MAGIC: &[u8] = b"\x93NUMPY";

/// Bytes of a sample.
const SAMPLE: usize = 4;

/// Returns true if the file claims to be a NumPy array.
pub fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Reads `bytes`, the content of the file `path`. An array without field names holds depths `Z`.
///
/// # Errors
/// The file is damaged, or is not an array that feimos writes.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Image> {
    let expected =
        "expected an array of feimos: fields of its AOVs, or a plain array of f32 depths";
    let refused = |found: &str| {
        let diagnostic = Diagnostic::new(format!("this NumPy file cannot be read: {found}"));
        Error::bad_input(diagnostic.at(SourceLocation::file(path)).note(expected))
    };
    let (header, samples) = split(bytes).ok_or_else(|| refused("its header is damaged"))?;
    let (aovs, [height, width]) = parse(header).ok_or_else(|| refused("its type is unknown"))?;
    let channels: Vec<ChannelName> = aovs
        .iter()
        .flat_map(|aov| aov.channels())
        .copied()
        .collect();
    let bounds = PixelBounds::of_film(width, height);
    let length = u128::from(bounds.area()) * (channels.len() * SAMPLE) as u128;
    if bounds.is_empty() || width.max(height) > PixelBounds::MAX_SIDE {
        return Err(refused(&format!("it has {width} x {height} pixels")));
    }
    if length != samples.len() as u128 {
        return Err(refused("its length does not fit its size"));
    }
    let (samples, _) = samples.as_chunks::<SAMPLE>();
    let count = channels.len();
    let channel = |(place, name): (usize, &ChannelName)| {
        let values = samples.iter().skip(place).step_by(count);
        let samples = if name.is_integer() {
            Samples::U32(values.map(|bytes| u32::from_le_bytes(*bytes)).collect())
        } else {
            Samples::F32(values.map(|bytes| f32::from_le_bytes(*bytes)).collect())
        };
        Channel {
            name: *name,
            samples,
        }
    };
    Ok(Image {
        display_window: (width, height),
        data_window: bounds,
        channels: channels.iter().enumerate().map(channel).collect(),
    })
}

/// The header's dictionary and the samples.
fn split(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let rest = bytes.strip_prefix(MAGIC)?.strip_prefix(&[1, 0])?;
    let (length, rest) = rest.split_first_chunk()?;
    let (header, samples) = rest.split_at_checked(u16::from_le_bytes(*length).into())?;
    Some((std::str::from_utf8(header).ok()?, samples))
}

/// The AOVs, and the height and width.
fn parse(header: &str) -> Option<(Vec<Aov>, [u32; 2])> {
    let dictionary = header
        .trim_end()
        .strip_prefix("{'descr': ")?
        .strip_suffix(", }")?;
    let (descr, shape) = dictionary.split_once(", 'fortran_order': False, 'shape': (")?;
    let size = shape.strip_suffix(')')?.split_once(", ")?;
    let size = [size.0.parse().ok()?, size.1.parse().ok()?];
    if descr == "'<f4'" {
        return Some((vec![Aov::Z], size));
    }
    let fields = descr.strip_prefix("[(")?.strip_suffix(")]")?.split("), (");
    let aovs = fields.map(parse_field).collect::<Option<Vec<Aov>>>()?;
    let is_repeated = (1..aovs.len()).any(|place| aovs[..place].contains(&aovs[place]));
    (!is_repeated).then_some((aovs, size))
}

/// A field such as `'Z', '<f4'` or `'N', '<f4', (3,)`.
fn parse_field(field: &str) -> Option<Aov> {
    let mut parts = field.splitn(3, ", ");
    let name = parts.next()?.strip_prefix('\'')?.strip_suffix('\'')?;
    let aov: Aov = name.parse().ok()?;
    let channels = aov.channels();
    let sample = if channels[0].is_integer() {
        "'<u4'"
    } else {
        "'<f4'"
    };
    let components = match channels.len() {
        1 => None,
        count => Some(format!("({count},)")),
    };
    let fits = parts.next() == Some(sample) && parts.next() == components.as_deref();
    fits.then_some(aov)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::npy_file::{self, Field};
    use crate::progress::Progress;

    fn image(names: &[ChannelName]) -> Image {
        let samples = |name: ChannelName| match name.is_integer() {
            true => Samples::U32((0..6).collect()),
            false => Samples::F32((0..6).map(|i| i as f32 + 0.5).collect()),
        };
        let channels = names.iter().map(|name| Channel {
            name: *name,
            samples: samples(*name),
        });
        Image {
            display_window: (3, 2),
            data_window: PixelBounds::of_film(3, 2),
            channels: channels.collect(),
        }
    }

    fn written(aovs: &[Aov]) -> (Image, Vec<u8>) {
        let names = aovs.iter().flat_map(|aov| aov.channels()).copied();
        let image = image(&names.collect::<Vec<_>>());
        let field = |aov: &Aov| Field {
            name: aov.name(),
            channels: aov.channels().to_vec(),
        };
        let fields: Vec<Field> = aovs.iter().map(field).collect();
        let mut file = Vec::new();
        npy_file::write(&image, &fields, &mut file, Progress::SILENT).unwrap();
        (image, file)
    }

    #[test]
    fn arrays_are_read_as_they_are_written() {
        for aovs in [&Aov::ALL[..], &Aov::USUAL, &[Aov::Uv, Aov::Id], &[Aov::Z]] {
            let (image, file) = written(aovs);
            assert_eq!(decode(Path::new("a.npy"), &file).unwrap(), image);
        }
    }

    #[test]
    fn integers_and_vectors_need_names() {
        for aov in [Aov::Id, Aov::Normal] {
            let (_, file) = written(&[aov]);
            let error = decode(Path::new("a.npy"), &file).unwrap_err().to_string();
            assert!(
                error.starts_with("a.npy: this NumPy file cannot be read: its type is unknown")
            );
        }
    }

    #[test]
    fn damage_is_an_error_and_no_panic() {
        let (_, file) = written(&Aov::USUAL);
        for end in 0..file.len() {
            assert!(decode(Path::new("a.npy"), &file[..end]).is_err(), "{end}");
        }
        for place in 0..file.len() {
            let mut changed = file.clone();
            changed[place] ^= 0xff;
            drop(decode(Path::new("a.npy"), &changed));
        }
    }
}
