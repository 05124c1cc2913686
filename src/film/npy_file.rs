//! Writes NumPy arrays, `.npy`, with rows from the top.
//!
//! One field makes a plain array, height x width, with a last axis if the field has several
//! components. Several fields make a structured array with a name for each. Format version 1.0
//! (NumPy Enhancement Proposal 1), little-endian, C order.

use super::in_order::{rows_of_part, write_in_order};
use super::interleaved::interleave;
use super::{Channel, ChannelName, Image, Samples};
use crate::progress::Progress;
use std::io::{self, Write};

/// A field: channels that belong together, and their name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// The name in a structured array.
    pub name: &'static str,
    /// The components, of one type.
    pub channels: Vec<ChannelName>,
}

/// Writes the `fields` of `image`. `progress` counts rows.
///
/// # Errors
/// The image lacks a channel, or writing fails.
pub fn write(
    image: &Image,
    fields: &[Field],
    out: &mut (impl Write + Send),
    progress: Progress,
) -> io::Result<()> {
    let invalid = |problem: String| io::Error::new(io::ErrorKind::InvalidInput, problem);
    image.validate().map_err(invalid)?;
    let channel = |name: &ChannelName| {
        let found = image.channels.iter().find(|channel| channel.name == *name);
        found.ok_or_else(|| invalid(format!("no channel {name}")))
    };
    let names = fields.iter().flat_map(|field| &field.channels);
    let channels = names.map(channel).collect::<io::Result<Vec<&Channel>>>()?;
    out.write_all(&header(image, fields))?;
    let (width, height) = (
        image.data_window.width() as usize,
        image.data_window.height() as usize,
    );
    let row_bytes = channels.len() * width * size_of::<u32>();
    let rows = rows_of_part(row_bytes);
    let make = |index: usize, part: &mut Vec<u8>| {
        let (first, end) = (index * rows, ((index + 1) * rows).min(height));
        part.resize((end - first) * row_bytes, 0);
        for (place, channel) in channels.iter().enumerate() {
            let (place, pixels) = ([place, channels.len()], first * width..end * width);
            match &channel.samples {
                Samples::F32(values) => {
                    interleave(part, place, &values[pixels], f32::to_le_bytes);
                }
                Samples::U32(values) => {
                    interleave(part, place, &values[pixels], u32::to_le_bytes);
                }
            }
        }
        Ok(())
    };
    write_in_order(height.div_ceil(rows), make, |part: &Vec<u8>| {
        progress.advance(part.len() / row_bytes.max(1));
        out.write_all(part)
    })
}

/// Everything before the samples: a Python dictionary, blanks up to a length that is a multiple of
/// 64, and a line end.
fn header(image: &Image, fields: &[Field]) -> Vec<u8> {
    const BEFORE: usize = 10;
    let (width, height) = (image.data_window.width(), image.data_window.height());
    let (descr, shape) = match fields {
        [field] => {
            let components = match field.channels.len() {
                1 => String::new(),
                count => format!(", {count}"),
            };
            (
                format!("'{}'", type_of(field)),
                format!("({height}, {width}{components})"),
            )
        }
        fields => {
            let descr: Vec<String> = fields.iter().map(describe).collect();
            (
                format!("[{}]", descr.join(", ")),
                format!("({height}, {width})"),
            )
        }
    };
    let mut text = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}");
    let end = (BEFORE + text.len() + 1).next_multiple_of(64);
    text.push_str(&" ".repeat(end - BEFORE - text.len() - 1));
    text.push('\n');
    let length = u16::try_from(text.len()).expect("some twenty short names");
    [
        &b"\x93NUMPY\x01\x00"[..],
        &length.to_le_bytes(),
        text.as_bytes(),
    ]
    .concat()
}

fn describe(field: &Field) -> String {
    let components = match field.channels.len() {
        1 => String::new(),
        count => format!(", ({count},)"),
    };
    format!("('{}', '{}'{components})", field.name, type_of(field))
}

fn type_of(field: &Field) -> &'static str {
    if field.channels.iter().any(|channel| channel.is_integer()) {
        "<u4"
    } else {
        "<f4"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::PixelBounds;

    fn image() -> Image {
        let f32s = |name, start: f32| Channel {
            name,
            samples: Samples::F32((0..6).map(|i| start + i as f32).collect()),
        };
        Image {
            display_window: (9, 9),
            data_window: PixelBounds {
                x0: 1,
                x1: 4,
                y0: 2,
                y1: 4,
            },
            channels: vec![
                f32s(ChannelName::Z, 0.5),
                f32s(ChannelName::T, 10.0),
                Channel {
                    name: ChannelName::Id,
                    samples: Samples::U32(vec![0, 1, u32::MAX, 3, 4, 5]),
                },
            ],
        }
    }

    fn field(name: &'static str, channels: &[ChannelName]) -> Field {
        Field {
            name,
            channels: channels.to_vec(),
        }
    }

    /// The dictionary of the header, and the samples.
    fn written(fields: &[Field]) -> (String, Vec<u8>) {
        let mut file = Vec::new();
        write(&image(), fields, &mut file, Progress::SILENT).unwrap();
        assert_eq!(file[..8], *b"\x93NUMPY\x01\x00");
        let end = 10 + usize::from(u16::from_le_bytes([file[8], file[9]]));
        assert!(end.is_multiple_of(64) && file[end - 1] == b'\n');
        (
            String::from_utf8(file[10..end].to_vec())
                .unwrap()
                .trim_end()
                .to_owned(),
            file[end..].to_vec(),
        )
    }

    #[test]
    fn one_channel_is_an_array_of_two_axes() {
        let (header, samples) = written(&[field("id", &[ChannelName::Id])]);
        assert_eq!(
            header,
            "{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3), }"
        );
        assert_eq!(
            samples,
            [0, 1, u32::MAX, 3, 4, 5].map(u32::to_le_bytes).concat()
        );
    }

    #[test]
    fn components_are_a_third_axis() {
        let (header, samples) = written(&[field("both", &[ChannelName::Z, ChannelName::T])]);
        assert_eq!(
            header,
            "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, 2), }"
        );
        assert_eq!(
            samples[..16],
            [0.5f32, 10.0, 1.5, 11.0].map(f32::to_le_bytes).concat()
        );
    }

    #[test]
    fn several_fields_have_names() {
        let (header, samples) = written(&[
            field("id", &[ChannelName::Id]),
            field("both", &[ChannelName::Z, ChannelName::T]),
        ]);
        let expected = "{'descr': [('id', '<u4'), ('both', '<f4', (2,))], 'fortran_order': False, 'shape': (2, 3), }";
        assert_eq!(header, expected);
        let second = [
            1u32.to_le_bytes(),
            1.5f32.to_le_bytes(),
            11f32.to_le_bytes(),
        ]
        .concat();
        assert_eq!((samples.len(), &samples[12..24]), (6 * 12, &second[..]));
    }

    #[test]
    fn parts_follow_each_other() {
        let (width, height) = (5000, 40);
        let samples = |factor: u32| (0..width * height).map(move |i| i * factor);
        let channel = |name, factor| Channel {
            name,
            samples: Samples::U32(samples(factor).collect()),
        };
        let image = Image {
            display_window: (width, height),
            data_window: PixelBounds::of_film(width, height),
            channels: vec![channel(ChannelName::Id, 1), channel(ChannelName::Prim, 3)],
        };
        let fields = [
            field("id", &[ChannelName::Id]),
            field("prim", &[ChannelName::Prim]),
        ];
        let mut file = Vec::new();
        write(&image, &fields, &mut file, Progress::SILENT).unwrap();
        let both = samples(1).zip(samples(3)).flat_map(|(a, b)| [a, b]);
        let expected: Vec<u8> = both.flat_map(u32::to_le_bytes).collect();
        assert!(file.ends_with(&expected));
    }

    #[test]
    fn a_missing_channel_is_an_error() {
        let error = write(
            &image(),
            &[field("A", &[ChannelName::A])],
            &mut Vec::new(),
            Progress::SILENT,
        )
        .unwrap_err();
        assert_eq!(error.to_string(), "no channel A");
    }
}
