//! PNG: pictures for people to look at.

use std::io::{self, Write};

use clap::ValueEnum;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use rayon::prelude::*;

use super::color_map::{Rgb, TABLE_LENGTH};
use super::{ChannelName, ColorMap, DepthRange, Image};

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, ValueEnum)]
pub enum View {
    /// Depth from near to far through a colour map
    #[default]
    Depth,
    /// Hits red, misses yellow
    Hit,
}

impl View {
    /// The name on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            View::Depth => "depth",
            View::Hit => "hit",
        }
    }

    /// The channels that the picture is made of, and no other.
    pub fn channels(self) -> &'static [ChannelName] {
        match self {
            View::Depth => &[ChannelName::Z, ChannelName::A],
            View::Hit => &[ChannelName::A],
        }
    }
}

/// A miss in the depth view: a slate that no map comes near, dark enough to read as nothing.
pub const MISS_IN_DEPTH: Rgb = [46, 52, 64];
/// A hit in the hit view.
pub const HIT: Rgb = [255, 0, 0];
/// A miss in the hit view.
pub const MISS: Rgb = [255, 255, 0];

/// Writes the hit view of `image`, which needs channel `A`.
pub fn write_hit(image: &Image, out: &mut impl Write) -> io::Result<()> {
    let a = needed(image, ChannelName::A)?;
    let pixels = a.par_iter().map(|a| if *a != 0.0 { HIT } else { MISS });
    encode(image, pixels, out)
}

/// Writes the depth view of `image`, which needs channels `Z` and `A`; `range` is stretched over `colors`.
pub fn write_depth(image: &Image, colors: ColorMap, range: DepthRange, out: &mut impl Write) -> io::Result<()> {
    let (z, a) = (needed(image, ChannelName::Z)?, needed(image, ChannelName::A)?);
    let table = colors.table();
    let color = |z: f32| table[(range.position(z) * (TABLE_LENGTH - 1) as f64 + 0.5) as usize];
    let pixels = z.par_iter().zip(a).map(|(z, a)| if *a != 0.0 { color(*z) } else { MISS_IN_DEPTH });
    encode(image, pixels, out)
}

fn needed(image: &Image, name: ChannelName) -> io::Result<&[f32]> {
    let missing = || io::Error::new(io::ErrorKind::InvalidInput, format!("no channel {}", name.as_str()));
    image.validate().map_err(|problem| io::Error::new(io::ErrorKind::InvalidInput, problem))?;
    image.measures(name).ok_or_else(missing)
}

fn encode(image: &Image, pixels: impl IndexedParallelIterator<Item = Rgb>, out: &mut impl Write) -> io::Result<()> {
    let rgb: Vec<Rgb> = pixels.collect();
    let (width, height) = (image.data_window.width(), image.data_window.height());
    // The encoder ends the file in a destructor, where an error would be lost: let it write to memory.
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Sub)
        .write_image(rgb.as_flattened(), width, height, ExtendedColorType::Rgb8)
        .map_err(into_io)?;
    out.write_all(&file)
}

fn into_io(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other),
    }
}
