//! Files by our writer, by the `exr` crate in all its encodings, and damaged files.

mod damage;
mod encodings;
mod windows;

use super::*;
use crate::error::ErrorKind;
use crate::film::{ChannelName, PixelBounds, exr_file};
use crate::progress::Progress;
use exr::image::write::layers::WritableLayers;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Layer, LayerAttributes,
    LineOrder, WritableImage,
};

/// Numbers that fit any type of channel.
const SMALL: [f32; 5] = [0.0, 1.0, 7.0, 1024.0, 2047.0];

/// A channel of these numbers.
fn small(count: usize) -> Vec<f32> {
    SMALL.into_iter().cycle().take(count).collect()
}

fn as_f16(values: &[f32]) -> FlatSamples {
    FlatSamples::F16(
        values
            .iter()
            .map(|value| exr::prelude::f16::from_f32(*value))
            .collect(),
    )
}

fn as_u32(values: &[f32]) -> FlatSamples {
    FlatSamples::U32(values.iter().map(|value| *value as u32).collect())
}

fn layer(
    size: (usize, usize),
    channels: Vec<(&str, FlatSamples)>,
    encoding: Encoding,
) -> Layer<AnyChannels<FlatSamples>> {
    let channels = channels
        .into_iter()
        .map(|(name, samples)| AnyChannel::new(name, samples))
        .collect();
    Layer::new(
        size,
        LayerAttributes::default(),
        encoding,
        AnyChannels::sort(channels),
    )
}

/// The bytes of a file by the crate.
fn written<'a, L: WritableLayers<'a>>(image: &'a exr::prelude::Image<L>) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    image.write().non_parallel().to_buffered(&mut file).unwrap();
    file.into_inner()
}

fn one_layer(
    size: (usize, usize),
    channels: Vec<(&str, FlatSamples)>,
    encoding: Encoding,
) -> Vec<u8> {
    written(&exr::prelude::Image::from_layer(layer(
        size, channels, encoding,
    )))
}

fn read(bytes: &[u8]) -> Result<Image> {
    decode(Path::new("a.exr"), bytes)
}

/// The message about a damaged file.
fn refused(bytes: &[u8]) -> String {
    let error = read(bytes).expect_err("the file is damaged");
    assert_eq!(error.kind(), ErrorKind::BadInput);
    let message = error.to_string();
    let has_note = message.contains("\n   = expected") || message.contains("\n   = the file is");
    assert!(message.starts_with("a.exr: ") && has_note, "{message}");
    message
}

fn bits(image: &Image, name: ChannelName) -> Vec<u32> {
    let of_measures = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect();
    image
        .measures(name)
        .map(of_measures)
        .or_else(|| image.numbers(name).map(<[u32]>::to_vec))
        .expect("the channel")
}

/// Asserts that two images are equal, bit for bit.
fn assert_same(expected: &Image, found: &Image) {
    found.validate().unwrap();
    assert_eq!(
        (expected.display_window, expected.data_window),
        (found.display_window, found.data_window)
    );
    assert_eq!(expected.channels.len(), found.channels.len());
    for channel in &expected.channels {
        assert!(
            bits(expected, channel.name) == bits(found, channel.name),
            "{}",
            channel.name
        );
    }
}

/// An image with unusual numbers in every channel.
fn strange(film: (u32, u32), data_window: PixelBounds) -> Image {
    let bits = [
        0x7fc0_0000,
        0xffff_ffff,
        0x7f80_0000,
        0xff80_0000,
        0x8000_0000,
        0,
        1,
        0x3f80_0001,
        0x7f80_0001,
        0x00ff_ffff,
    ];
    let all: Vec<u32> = bits
        .into_iter()
        .cycle()
        .take(data_window.area() as usize)
        .collect();
    let channel = |(place, name): (usize, ChannelName)| {
        let mut bits = all.clone();
        bits.rotate_left(place % all.len());
        let samples = match name.is_integer() {
            true => Samples::U32(bits),
            false => Samples::F32(bits.into_iter().map(f32::from_bits).collect()),
        };
        Channel { name, samples }
    };
    let channels = ChannelName::ALL
        .into_iter()
        .enumerate()
        .map(channel)
        .collect();
    Image {
        display_window: film,
        data_window,
        channels,
    }
}

fn of_our_writer(image: &Image) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    exr_file::write(image, &Metadata::default(), &mut file, Progress::SILENT).unwrap();
    file.into_inner()
}
