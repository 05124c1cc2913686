//! Files as they are written, by the reader of the crate.

mod header;
mod random;

use super::*;
use crate::film::in_order::{PART, rows_of_part};
use crate::film::{ChannelName, exr_zip};
use exr::prelude::{FlatImage, FlatSamples, ReadChannels, ReadLayers};
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
    write(image, metadata, &mut out, Progress::SILENT).unwrap();
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

/// Writes `image`, reads it with the crate's reader, and compares everything.
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
    for (found, expected) in layer.channel_data.list.iter().zip(sorted_channels(
        image,
        &all_names(image),
        &Metadata::default(),
    )) {
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
fn a_crop_keeps_its_position_in_the_film() {
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
fn any_subset_of_channels_can_be_written() {
    for names in [
        &ChannelName::ALL[1..4],
        &[ChannelName::Prim, ChannelName::Z],
        &[ChannelName::Id, ChannelName::A],
    ] {
        assert_survives(&picture((6, 5), PixelBounds::of_film(6, 5), names));
    }
}

#[test]
fn rows_may_have_odd_or_even_length() {
    for width in 1..10 {
        assert_survives(&picture(
            (width, 3),
            PixelBounds::of_film(width, 3),
            &ChannelName::ALL,
        ));
    }
}

#[test]
fn bands_write_every_line() {
    const WIDTH: u32 = 2048;
    let lines = rows_of_part(WIDTH as usize * size_of::<u32>()) as u32;
    let wide = PART as u32 / 2;
    let sizes = [lines - 1, lines, lines + 1, 2 * lines].map(|height| (WIDTH, height));
    for (width, height) in sizes.into_iter().chain([(wide, 3)]) {
        assert_survives(&picture(
            (width, height),
            PixelBounds::of_film(width, height),
            &[ChannelName::Id],
        ));
    }
}

/// The pixels of each line as stored in the file, compressed or not.
fn stored_lines(file: &[u8]) -> Vec<Vec<u8>> {
    let reader = exr::block::read(Cursor::new(file), true).unwrap();
    let chunks = reader.all_chunks(true).unwrap();
    let pixels = chunks.map(|chunk| match chunk.unwrap().compressed_block {
        exr::block::chunk::CompressedBlock::ScanLine(line) => line.compressed_pixels_le,
        other => panic!("{other:?}"),
    });
    pixels.collect()
}

#[test]
fn incompressible_lines_are_stored() {
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
        exr_zip::bytes_of_row(
            &sorted_channels(&image, &all_names(&image), &Metadata::default()),
            0..64
        )
    );
    assert!(lines[1].len() < 30, "{}", lines[1].len());
    assert_survives(&image);
}

#[test]
fn each_line_is_compressed_alone_in_increasing_order() {
    let file = decoded(&encoded(
        &picture((9, 9), PixelBounds::of_film(9, 9), &ChannelName::ALL),
        "{}",
    ));
    let encoding = file.layer_data[0].encoding;
    assert_eq!(encoding.compression, exr::compression::Compression::ZIP1);
    assert_eq!(encoding.line_order, LineOrder::Increasing);
}

#[test]
fn only_the_named_channels_are_written() {
    let window = PixelBounds::of_film(9, 9);
    let names = [ChannelName::Id, ChannelName::Z];
    let mut file = Cursor::new(Vec::new());
    let all = picture((9, 9), window, &ChannelName::ALL);
    let (metadata, silent) = (Metadata::default(), Progress::SILENT);
    write_channels(&all, &names, &metadata, &mut file, silent).unwrap();
    let two = picture((9, 9), window, &names);
    assert!(file.into_inner() == encoded(&two, ""));
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
fn content_that_the_format_cannot_hold_is_an_error() {
    let is_refused = |image: &Image| {
        let mut out = Cursor::new(Vec::new());
        write(image, &metadata("{}"), &mut out, Progress::SILENT).is_err()
    };
    let none = picture((1, 1), PixelBounds::of_film(1, 1), &[]);
    assert!(is_refused(&none));
    let far = PixelBounds {
        x0: u32::MAX - 1,
        x1: u32::MAX,
        y0: 0,
        y1: 1,
    };
    let far = picture((u32::MAX, 1), far, &[ChannelName::Z]);
    assert!(is_refused(&far));
}
