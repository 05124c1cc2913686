//! Writes PFM, the portable float map: one or three channels of `f32`, with rows from the bottom.
//!
//! <http://www.pauldebevec.com/Research/HDR/PFM/>. A scale below 0 marks little-endian samples.

use super::in_order::{rows_of_part, write_in_order};
use super::interleaved::interleave;
use super::{ChannelName, Image};
use crate::progress::Progress;
use std::io::{self, Write};

/// Writes one or three channels of `image`. `progress` counts rows.
///
/// # Errors
/// Channels are missing, integers, or not one or three; or writing fails.
pub fn write(
    image: &Image,
    channels: &[ChannelName],
    out: &mut (impl Write + Send),
    progress: Progress,
) -> io::Result<()> {
    let invalid = |problem: String| io::Error::new(io::ErrorKind::InvalidInput, problem);
    image.validate().map_err(invalid)?;
    let samples = |name: &ChannelName| {
        image
            .measures(*name)
            .ok_or_else(|| invalid(format!("no channel {name} of floats")))
    };
    let samples = channels
        .iter()
        .map(samples)
        .collect::<io::Result<Vec<&[f32]>>>()?;
    let kind = match samples.len() {
        1 => "Pf",
        3 => "PF",
        count => {
            return Err(invalid(format!(
                "a PFM holds one or three channels, not {count}"
            )));
        }
    };
    let (width, height) = (
        image.data_window.width() as usize,
        image.data_window.height() as usize,
    );
    write!(out, "{kind}\n{width} {height}\n-1.0\n")?;
    let row_bytes = samples.len() * width * size_of::<f32>();
    let rows = rows_of_part(row_bytes);
    let make = |index: usize, part: &mut Vec<u8>| {
        let (first, end) = (index * rows, ((index + 1) * rows).min(height));
        part.resize((end - first) * row_bytes, 0);
        for (row, y) in part.chunks_exact_mut(row_bytes).zip(first..end) {
            let start = (height - 1 - y) * width;
            for (place, values) in samples.iter().enumerate() {
                let values = &values[start..start + width];
                interleave(row, [place, samples.len()], values, f32::to_le_bytes);
            }
        }
        Ok(())
    };
    write_in_order(height.div_ceil(rows), make, |part: &Vec<u8>| {
        progress.advance(part.len() / row_bytes.max(1));
        out.write_all(part)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    fn written(channels: &[ChannelName]) -> io::Result<Vec<u8>> {
        let f32s = |name, start: f32| Channel {
            name,
            samples: Samples::F32((0..4).map(|i| start + i as f32).collect()),
        };
        let image = Image {
            display_window: (2, 2),
            data_window: PixelBounds::of_film(2, 2),
            channels: vec![
                f32s(ChannelName::Z, 0.5),
                f32s(ChannelName::T, 10.0),
                f32s(ChannelName::A, 20.0),
                Channel {
                    name: ChannelName::Id,
                    samples: Samples::U32(vec![1; 4]),
                },
            ],
        };
        let mut file = Vec::new();
        write(&image, channels, &mut file, Progress::SILENT).map(|()| file)
    }

    #[test]
    fn rows_come_from_the_bottom() {
        let expected = [
            b"Pf\n2 2\n-1.0\n".to_vec(),
            [2.5f32, 3.5, 0.5, 1.5].map(f32::to_le_bytes).concat(),
        ]
        .concat();
        assert_eq!(written(&[ChannelName::Z]).unwrap(), expected);
        let three = written(&[ChannelName::Z, ChannelName::T, ChannelName::A]).unwrap();
        let pixels = [
            2.5f32, 12.0, 22.0, 3.5, 13.0, 23.0, 0.5, 10.0, 20.0, 1.5, 11.0, 21.0,
        ];
        assert_eq!(
            three,
            [
                b"PF\n2 2\n-1.0\n".to_vec(),
                pixels.map(f32::to_le_bytes).concat()
            ]
            .concat()
        );
    }

    #[test]
    fn parts_follow_each_other_from_the_bottom() {
        let (width, height) = (5000, 40);
        let values = |y: u32| (0..width).map(move |x| (y * width + x) as f32);
        let image = Image {
            display_window: (width, height),
            data_window: PixelBounds::of_film(width, height),
            channels: vec![Channel {
                name: ChannelName::Z,
                samples: Samples::F32((0..height).flat_map(values).collect()),
            }],
        };
        let mut file = Vec::new();
        write(&image, &[ChannelName::Z], &mut file, Progress::SILENT).unwrap();
        let rows = (0..height).rev().flat_map(values);
        let expected: Vec<u8> = rows.flat_map(f32::to_le_bytes).collect();
        assert!(file.ends_with(&expected));
    }

    #[test]
    fn content_that_the_format_cannot_hold_is_an_error() {
        for channels in [
            &[ChannelName::Id][..],
            &[ChannelName::Cost],
            &[],
            &[ChannelName::Z, ChannelName::T],
        ] {
            assert!(written(channels).is_err(), "{channels:?}");
        }
    }
}
