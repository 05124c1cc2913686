//! OpenEXR: every channel as it was computed.
//!
//! Scan lines in increasing order, each compressed by itself (`zips`), so that equal images are equal files: the
//! default encoding of the `exr` crate writes its tiles in the order in which threads finish them. The crate's
//! thread pool is off; lines are compressed in the pool that the caller runs in, and written in order. The header and
//! the frame of the file are the crate's work; its ZIP is not used, since ours takes a small part of the time.

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

use super::exr_zip::Zipper;
use super::{CameraAttributes, Channel, Image, Metadata, PixelBounds, Samples};

/// The name of the attribute that holds what the caller says about the image. There is only this one, because
/// the `exr` crate keeps custom attributes in a hash table and writes several of them in a random order.
pub const ATTRIBUTE: &str = "feimos";

/// Scan lines that are compressed before they are written: enough to keep every thread busy, few enough that the
/// compressed image never lies in memory as a whole.
const BATCH: u32 = 256;

/// Writes `image` as an OpenEXR file with what `metadata` says: its JSON in the [`ATTRIBUTE`], and the standard attributes of a camera.
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

/// The channels by their names in the file, byte for byte: the order that the format demands.
fn sorted_channels<'a>(image: &'a Image, metadata: &Metadata) -> Vec<&'a Channel> {
    let mut channels: Vec<&Channel> = image.channels.iter().collect();
    channels.sort_by_key(|channel| metadata.name_in_file(channel.name));
    channels
}

fn header(image: &Image, channels: &[&Channel], metadata: &Metadata) -> Result<Header, ExrError> {
    let bounds = integer_bounds(image.data_window)?;
    let (width, height) = image.display_window;
    let display_window = integer_bounds(PixelBounds::of_film(width, height))?;
    // Bytes, since `Text::from` panics where a character of a file name is beyond Latin-1. Readers expect UTF-8.
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
    // The last argument guides lossy compressions alone; true is what holds for anything but colours.
    ChannelDescription::new(name, sample_type, true)
}

fn integer_bounds(bounds: PixelBounds) -> Result<IntegerBounds, ExrError> {
    let position = Vec2(i32::try_from(bounds.x0)?, i32::try_from(bounds.y0)?);
    Ok(IntegerBounds::new(
        position,
        (bounds.width() as usize, bounds.height() as usize),
    ))
}

/// The compressed lines of a batch, in order, each with what the file says about it.
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

/// An error of the disk as it came, any other as the input's.
fn into_io(error: ExrError) -> io::Error {
    match error {
        ExrError::Io(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{ChannelName, exr_zip};
    use exr::prelude::{FlatImage, FlatSamples, ReadChannels, ReadLayers};
    use proptest::prelude::*;
    use std::io::Cursor;

    const STRANGE: [f32; 8] = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        -0.0,
        0.0,
        0.1,
        f32::MAX,
        f32::MIN_POSITIVE / 2.0,
    ];

    fn channel(name: ChannelName, length: usize) -> Channel {
        let samples = match name.is_integer() {
            false => Samples::F32(
                (0..length)
                    .map(|i| STRANGE[i % 8] * if i % 3 == 0 { 1.0 } else { i as f32 })
                    .collect(),
            ),
            true => Samples::U32(
                (0..length)
                    .map(|i| (i as u32 + 1).wrapping_mul(2_654_435_761) | 1 << 24)
                    .collect(),
            ),
        };
        Channel { name, samples }
    }

    fn picture(film: (u32, u32), data_window: PixelBounds, names: &[ChannelName]) -> Image {
        let length = data_window.area() as usize;
        let channels = names.iter().map(|name| channel(*name, length)).collect();
        Image {
            display_window: film,
            data_window,
            channels,
        }
    }

    fn metadata(json: &str) -> Metadata {
        Metadata::of_json(json.to_owned())
    }

    fn encoded(image: &Image, json: &str) -> Vec<u8> {
        encoded_with(image, &metadata(json))
    }

    fn encoded_with(image: &Image, metadata: &Metadata) -> Vec<u8> {
        let mut out = Cursor::new(Vec::new());
        write(image, metadata, &mut out).unwrap();
        out.into_inner()
    }

    fn decoded(file: &[u8]) -> FlatImage {
        let read = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels();
        read.all_layers()
            .all_attributes()
            .pedantic()
            .from_buffered(Cursor::new(file))
            .unwrap()
    }

    fn bits(samples: &Samples) -> Vec<u32> {
        match samples {
            Samples::F32(values) => values.iter().map(|value| value.to_bits()).collect(),
            Samples::U32(values) => values.clone(),
        }
    }

    fn decoded_bits(samples: &FlatSamples) -> Samples {
        match samples {
            FlatSamples::F32(values) => Samples::F32(values.clone()),
            FlatSamples::U32(values) => Samples::U32(values.clone()),
            FlatSamples::F16(_) => panic!("half"),
        }
    }

    /// Writes `image`, reads it with the crate's reader, and compares all there is.
    fn assert_survives(image: &Image) {
        let file = decoded(&encoded(image, "{}"));
        let window = image.data_window;
        let (width, height) = image.display_window;
        assert_eq!(
            file.attributes.display_window,
            integer_bounds(PixelBounds::of_film(width, height)).unwrap()
        );
        assert_eq!(file.attributes.pixel_aspect, 1.0);
        assert_eq!(file.layer_data.len(), 1);
        let layer = &file.layer_data[0];
        assert_eq!(
            layer.size,
            Vec2(window.width() as usize, window.height() as usize)
        );
        assert_eq!(
            layer.attributes.layer_position,
            Vec2(window.x0 as i32, window.y0 as i32)
        );
        assert_eq!(layer.channel_data.list.len(), image.channels.len());
        for (found, expected) in layer
            .channel_data
            .list
            .iter()
            .zip(sorted_channels(image, &Metadata::default()))
        {
            assert_eq!(found.name.to_string(), expected.name.to_string());
            let samples = decoded_bits(&found.sample_data);
            assert_eq!(
                std::mem::discriminant(&samples),
                std::mem::discriminant(&expected.samples)
            );
            assert_eq!(
                bits(&samples),
                bits(&expected.samples),
                "{:?}",
                expected.name
            );
        }
    }

    #[test]
    fn every_bit_survives() {
        assert_survives(&picture(
            (70, 300),
            PixelBounds::of_film(70, 300),
            &ChannelName::ALL,
        ));
    }

    #[test]
    fn a_crop_keeps_its_place_in_the_film() {
        let crop = PixelBounds {
            x0: 17,
            x1: 60,
            y0: 130,
            y1: 271,
        };
        assert_survives(&picture((70, 300), crop, &ChannelName::ALL));
    }

    #[test]
    fn one_pixel_and_one_channel_are_enough() {
        for name in ChannelName::ALL {
            assert_survives(&picture((1, 1), PixelBounds::of_film(1, 1), &[name]));
        }
    }

    #[test]
    fn any_channels_may_be_chosen() {
        for names in [
            &ChannelName::ALL[1..4],
            &[ChannelName::Prim, ChannelName::Z],
            &[ChannelName::Id, ChannelName::A],
        ] {
            assert_survives(&picture((6, 5), PixelBounds::of_film(6, 5), names));
        }
    }

    #[test]
    fn rows_may_be_of_odd_or_even_length() {
        for width in 1..10 {
            assert_survives(&picture(
                (width, 3),
                PixelBounds::of_film(width, 3),
                &ChannelName::ALL,
            ));
        }
    }

    #[test]
    fn batches_of_lines_leave_no_line_out() {
        for height in [BATCH - 1, BATCH, BATCH + 1, 2 * BATCH] {
            assert_survives(&picture(
                (2, height),
                PixelBounds::of_film(2, height),
                &[ChannelName::Id],
            ));
        }
    }

    /// The pixels of each line as the file has them, compressed or not.
    fn stored_lines(file: &[u8]) -> Vec<Vec<u8>> {
        let reader = exr::block::read(Cursor::new(file), true).unwrap();
        let chunks = reader.all_chunks(true).unwrap();
        let pixels = chunks.map(|chunk| match chunk.unwrap().compressed_block {
            CompressedBlock::ScanLine(line) => line.compressed_pixels_le,
            other => panic!("{other:?}"),
        });
        pixels.collect()
    }

    #[test]
    fn what_does_not_shrink_is_stored_as_it_is() {
        let mut state = 1u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state.rotate_left(16) ^ state
        };
        let values: Vec<u32> = (0..64).map(|_| noise()).chain([7; 64]).collect();
        let channels = vec![Channel {
            name: ChannelName::Id,
            samples: Samples::U32(values),
        }];
        let image = Image {
            display_window: (64, 2),
            data_window: PixelBounds::of_film(64, 2),
            channels,
        };
        let lines = stored_lines(&encoded(&image, "{}"));
        assert_eq!(
            lines[0],
            exr_zip::bytes_of_row(&sorted_channels(&image, &Metadata::default()), 0..64)
        );
        assert!(lines[1].len() < 30, "{}", lines[1].len());
        assert_survives(&image);
    }

    #[test]
    fn lines_are_zipped_alone_in_increasing_order() {
        let file = decoded(&encoded(
            &picture((9, 9), PixelBounds::of_film(9, 9), &ChannelName::ALL),
            "{}",
        ));
        let encoding = file.layer_data[0].encoding;
        assert_eq!(encoding.compression, exr::compression::Compression::ZIP1);
        assert_eq!(encoding.line_order, LineOrder::Increasing);
    }

    #[test]
    fn the_one_attribute_holds_the_callers_text_in_utf8() {
        let json = format!(
            r#"{{"scene":"Käse 🧀.pbrt","long":"{}"}}"#,
            "x".repeat(5000)
        );
        let file = decoded(&encoded(
            &picture((2, 2), PixelBounds::of_film(2, 2), &[ChannelName::Z]),
            &json,
        ));
        assert!(file.attributes.other.is_empty());
        let other: Vec<_> = file.layer_data[0].attributes.other.iter().collect();
        let [(name, AttributeValue::Text(text))] = other[..] else {
            panic!("{other:?}")
        };
        assert_eq!(
            (name.to_string().as_str(), text.as_slice()),
            (ATTRIBUTE, json.as_bytes())
        );
    }

    #[test]
    fn the_depth_channel_may_have_another_name_and_stands_where_that_belongs() {
        let image = picture(
            (4, 3),
            PixelBounds::of_film(4, 3),
            &[ChannelName::Z, ChannelName::A, ChannelName::T],
        );
        let file = decoded(&encoded(&image, r#"{"depth_channel":"Y"}"#));
        let channels: Vec<_> = file.layer_data[0].channel_data.list.iter().collect();
        assert_eq!(
            channels
                .iter()
                .map(|channel| channel.name.to_string())
                .collect::<Vec<_>>(),
            ["A", "Y", "t"]
        );
        assert_eq!(
            bits(&decoded_bits(&channels[1].sample_data)),
            bits(&image.channels[0].samples)
        );
    }

    #[test]
    fn the_camera_is_in_the_standard_attributes() {
        let camera = CameraAttributes {
            pixel_aspect: 2.0,
            screen_window_center: [0.5, -0.25],
            screen_window_width: 3.0,
            world_to_camera: std::array::from_fn(|at| at as f32),
            world_to_ndc: std::array::from_fn(|at| -(at as f32)),
        };
        let image = picture((2, 2), PixelBounds::of_film(2, 2), &[ChannelName::Z]);
        let file = decoded(&encoded_with(
            &image,
            &Metadata {
                camera: Some(camera),
                ..Metadata::default()
            },
        ));
        let attributes = &file.layer_data[0].attributes;
        assert_eq!(file.attributes.pixel_aspect, 2.0);
        assert_eq!(
            (
                attributes.screen_window_center,
                attributes.screen_window_width
            ),
            (Vec2(0.5, -0.25), 3.0)
        );
        assert_eq!(attributes.world_to_camera, Some(camera.world_to_camera));
        assert_eq!(
            attributes.world_to_normalized_device,
            Some(camera.world_to_ndc)
        );
    }

    #[test]
    fn equal_images_are_equal_files_on_any_number_of_threads() {
        let image = picture((64, 300), PixelBounds::of_film(64, 300), &ChannelName::ALL);
        let first = encoded(&image, "{}");
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            for _ in 0..4 {
                assert!(
                    pool.install(|| encoded(&image, "{}")) == first,
                    "{threads} threads"
                );
            }
        }
    }

    #[test]
    fn channels_may_come_in_any_order() {
        let mut image = picture((8, 8), PixelBounds::of_film(8, 8), &ChannelName::ALL);
        let first = encoded(&image, "{}");
        image.channels.reverse();
        assert!(encoded(&image, "{}") == first);
    }

    #[test]
    fn what_the_format_cannot_hold_is_an_error() {
        let none = picture((1, 1), PixelBounds::of_film(1, 1), &[]);
        assert!(write(&none, &metadata("{}"), &mut Cursor::new(Vec::new())).is_err());
        let far = PixelBounds {
            x0: u32::MAX - 1,
            x1: u32::MAX,
            y0: 0,
            y1: 1,
        };
        let far = picture((u32::MAX, 1), far, &[ChannelName::Z]);
        assert!(write(&far, &metadata("{}"), &mut Cursor::new(Vec::new())).is_err());
    }

    proptest! {
        #[test]
        fn any_bits_survive(width in 1u32..40, rows in prop::collection::vec(any::<u32>(), 1..6), flat: bool) {
            // Flat rows are zipped, noisy ones are stored as they are.
            let noise = |x: u32, seed: u32| (x + 1).wrapping_mul(seed | 1).wrapping_mul(2_654_435_761).rotate_left(13);
            let value = |x: u32, seed: u32| if flat { seed } else { noise(x, seed) };
            let values: Vec<u32> = rows.iter().flat_map(|seed| (0..width).map(|x| value(x, *seed))).collect();
            let floats = values.iter().map(|bits| f32::from_bits(*bits)).collect();
            let data_window = PixelBounds { x0: 3, x1: 3 + width, y0: 1, y1: 1 + rows.len() as u32 };
            let channels = vec![
                Channel { name: ChannelName::T, samples: Samples::F32(floats) },
                Channel { name: ChannelName::Id, samples: Samples::U32(values) },
            ];
            assert_survives(&Image { display_window: (50, 10), data_window, channels });
        }
    }
}
