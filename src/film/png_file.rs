//! PNG: pictures for people to look at.

use std::io::{self, Write};

use clap::ValueEnum;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use rayon::prelude::*;

use super::color_map::Rgb;
use super::{ChannelName, ColorMap, CostRange, DepthRange, Image};

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, ValueEnum)]
pub enum View {
    /// Depth from near to far through a colour map
    #[default]
    Depth,
    /// Hits red, misses yellow
    Hit,
    /// What each ray costs alone, nodes and primitives tested: cheap is dark, dear is bright or warm
    Cost,
}

impl View {
    /// The name on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            View::Depth => "depth",
            View::Hit => "hit",
            View::Cost => "cost",
        }
    }

    /// The channels that the picture is made of, and no other.
    pub fn channels(self) -> &'static [ChannelName] {
        match self {
            View::Depth => &[ChannelName::Z, ChannelName::A],
            View::Hit => &[ChannelName::A],
            View::Cost => &[ChannelName::Cost],
        }
    }
}

/// A miss in the depth view: a pale sky, which no colour map passes near, not even gray, and which stands off
/// the dark far ends, where things meet the background.
pub const MISS_IN_DEPTH: Rgb = [184, 200, 224];
/// A hit in the hit view.
pub const HIT: Rgb = [255, 0, 0];
/// A miss in the hit view.
pub const MISS: Rgb = [255, 255, 0];

/// Writes the hit view of `image`, which needs channel `A`.
pub fn write_hit(image: &Image, out: &mut impl Write) -> io::Result<()> {
    let a = needed(image, ChannelName::A)?;
    let pixels = a.par_iter().map(|a| if *a != 0.0 { HIT } else { MISS });
    encode_view(image, pixels, out)
}

/// Writes the depth view of `image`, which needs channels `Z` and `A`; `range` is stretched over `colors`.
pub fn write_depth(image: &Image, colors: ColorMap, range: DepthRange, out: &mut impl Write) -> io::Result<()> {
    let (z, a) = (needed(image, ChannelName::Z)?, needed(image, ChannelName::A)?);
    let color = colors.steps();
    let pixels = z.par_iter().zip(a).map(|(z, a)| if *a != 0.0 { color(range.position(*z)) } else { MISS_IN_DEPTH });
    encode_view(image, pixels, out)
}

/// Writes a picture of these colours, row by row from the top.
///
/// # Errors
/// Where there are not as many of them as pixels, or writing fails.
pub fn write_rgb(width: u32, height: u32, pixels: &[[u8; 3]], out: &mut impl Write) -> io::Result<()> {
    if pixels.len() as u64 != u64::from(width) * u64::from(height) {
        let problem = format!("{} colours for {width} x {height} pixels", pixels.len());
        return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
    }
    encode(width, height, pixels, out)
}

/// Writes the cost view of `image`, which needs channel `cost`; `range` is stretched over `colors`, the other way round than
/// depths are: what costs most has the colour of what is near.
pub fn write_cost(image: &Image, colors: ColorMap, range: CostRange, out: &mut impl Write) -> io::Result<()> {
    let costs = available(image, ChannelName::Cost, Image::numbers)?;
    let color = colors.steps();
    encode_view(image, costs.par_iter().map(|cost| color(range.position(*cost))), out)
}

fn needed(image: &Image, name: ChannelName) -> io::Result<&[f32]> {
    available(image, name, Image::measures)
}

/// The samples of the channel of that name, as `samples` takes them from an image that is as it should be.
fn available<T>(
    image: &Image,
    name: ChannelName,
    samples: impl FnOnce(&Image, ChannelName) -> Option<&[T]>,
) -> io::Result<&[T]> {
    let invalid = |problem: String| io::Error::new(io::ErrorKind::InvalidInput, problem);
    image.validate().map_err(invalid)?;
    samples(image, name).ok_or_else(|| invalid(format!("no channel {}", name.as_str())))
}

fn encode_view(
    image: &Image,
    pixels: impl IndexedParallelIterator<Item = Rgb>,
    out: &mut impl Write,
) -> io::Result<()> {
    encode(image.data_window.width(), image.data_window.height(), &pixels.collect::<Vec<Rgb>>(), out)
}

/// Filter `Up` and the fast deflate made for PNG. Depth of the dragon from nearby, 1920 by 1080, one thread, fastest of 15 runs: 8 ms and 0.74 MB;
/// filter `Sub` takes as long for 0.87 MB. Bands in parallel, on two threads, gained nothing: 7 ms by the same deflate, whose
/// streams cannot be joined, and 9 ms for 1.0 MB by zlib's level 1, whose can. Adaptive filters took four times as long.
fn encode(width: u32, height: u32, pixels: &[Rgb], out: &mut impl Write) -> io::Result<()> {
    // The encoder ends the file in a destructor, where an error would be lost: let it write to memory.
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Up)
        .write_image(pixels.as_flattened(), width, height, ExtendedColorType::Rgb8)
        .map_err(into_io)?;
    out.write_all(&file)
}

fn into_io(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::color_map::TABLE_LENGTH;
    use crate::film::{Channel, PixelBounds, Samples};
    use image::RgbImage;

    fn picture(z: &[f32], a: &[f32], width: u32) -> Image {
        let channel = |name, values: &[f32]| Channel { name, samples: Samples::F32(values.to_vec()) };
        Image {
            display_window: (width + 5, 20),
            data_window: PixelBounds { x0: 5, x1: 5 + width, y0: 2, y1: 2 + a.len() as u32 / width },
            channels: vec![channel(ChannelName::A, a), channel(ChannelName::Z, z)],
        }
    }

    fn decoded(write: impl FnOnce(&mut Vec<u8>) -> io::Result<()>) -> RgbImage {
        let mut file = Vec::new();
        write(&mut file).unwrap();
        image::load_from_memory(&file).unwrap().into_rgb8()
    }

    fn depth(z: &[f32], a: &[f32], colors: ColorMap, range: DepthRange) -> Vec<Rgb> {
        let picture = picture(z, a, z.len() as u32);
        decoded(|out| write_depth(&picture, colors, range, out)).pixels().map(|pixel| pixel.0).collect()
    }

    #[test]
    fn clap_and_we_call_the_views_by_the_same_names() {
        for view in View::value_variants() {
            assert_eq!(view.to_possible_value().unwrap().get_name(), view.as_str());
        }
    }

    #[test]
    fn hits_are_red_and_misses_yellow() {
        let mut picture = picture(&[], &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0], 3);
        picture.channels.truncate(1);
        let rgb = decoded(|out| write_hit(&picture, out));
        assert_eq!(rgb.dimensions(), (3, 2));
        let red: Vec<(u32, u32)> = (0..6).map(|i| (i % 3, i / 3)).filter(|(x, y)| rgb[(*x, *y)].0 == HIT).collect();
        assert_eq!(red, [(0, 0), (1, 1)]);
        assert_eq!(rgb.pixels().filter(|pixel| pixel.0 == MISS).count(), 4);
    }

    #[test]
    fn depth_goes_from_near_to_far_and_what_misses_hold_does_not_show() {
        let z = [1.0, 3.0, f32::INFINITY, 0.0, f32::NAN, 2.0, 2.0];
        let a = [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0];
        let pixels = depth(&z, &a, ColorMap::Gray, DepthRange { near: 1.0, far: 3.0 });
        let gray = |value| [value; 3];
        assert_eq!(pixels[..4], [gray(255), gray(0), gray(0), gray(255)]);
        assert_eq!(pixels[4..6], [MISS_IN_DEPTH; 2]);
        assert!((127..=128).contains(&pixels[6][0]));
    }

    #[test]
    fn depths_beyond_the_range_get_the_colours_of_its_ends() {
        for colors in ColorMap::value_variants() {
            let (table, range) = (colors.table(), DepthRange { near: 1.0, far: 3.0 });
            let z = [f32::NEG_INFINITY, -7.0, 1.0, 3.0, 3.1, f32::MAX, f32::INFINITY];
            let (near, far) = (table[0], table[TABLE_LENGTH - 1]);
            assert_eq!(depth(&z, &[1.0; 7], *colors, range), [near, near, near, far, far, far, far], "{colors:?}");
        }
    }

    #[test]
    fn costs_go_from_dark_to_bright() {
        let costs = vec![0, 10, 20, 30, u32::MAX];
        let picture = Image {
            display_window: (5, 1),
            data_window: PixelBounds::of_film(5, 1),
            channels: vec![Channel { name: ChannelName::Cost, samples: Samples::U32(costs) }],
        };
        let range = CostRange { low: 10.0, high: 30.0 };
        let row = |colors| -> Vec<Rgb> {
            decoded(|out| write_cost(&picture, colors, range, out)).pixels().map(|pixel| pixel.0).collect()
        };
        let gray = row(ColorMap::Gray);
        assert_eq!([gray[0], gray[1], gray[3], gray[4]], [[0; 3], [0; 3], [255; 3], [255; 3]]);
        assert!((127..=128).contains(&gray[2][0]));
        assert_eq!(row(ColorMap::Viridis)[..2], [[68, 1, 84]; 2]);
        assert_eq!(row(ColorMap::Viridis)[3..], [[253, 231, 37]; 2]);
        let error = write_cost(&self::picture(&[1.0], &[1.0], 1), ColorMap::Gray, range, &mut Vec::new()).unwrap_err();
        assert_eq!(error.to_string(), "no channel cost");
    }

    #[test]
    fn plain_colours_are_written_as_they_are() {
        let colors = [HIT, MISS, [1, 2, 3], MISS_IN_DEPTH, HIT, [0; 3]];
        let rgb = decoded(|out| write_rgb(2, 3, &colors, out));
        assert!(rgb.dimensions() == (2, 3) && rgb.pixels().map(|pixel| pixel.0).eq(colors));
        assert!(write_rgb(3, 3, &colors, &mut Vec::new()).is_err());
    }

    #[test]
    fn a_crop_is_a_picture_of_its_own_size() {
        let picture = picture(&[1.0; 12], &[1.0; 12], 4);
        let range = DepthRange { near: 0.0, far: 1.0 };
        assert_eq!(decoded(|out| write_hit(&picture, out)).dimensions(), (4, 3));
        assert_eq!(decoded(|out| write_depth(&picture, ColorMap::Gray, range, out)).dimensions(), (4, 3));
    }

    #[test]
    fn rows_go_from_the_top_and_from_the_left() {
        let picture = picture(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], &[1.0; 6], 3);
        let range = DepthRange { near: 0.0, far: 5.0 };
        let rgb = decoded(|out| write_depth(&picture, ColorMap::Gray, range, out));
        assert!(rgb.pixels().is_sorted_by(|before, after| before.0[0] > after.0[0]));
        assert_eq!((rgb[(0, 0)].0, rgb[(2, 1)].0), ([255; 3], [0; 3]));
    }

    #[test]
    fn equal_images_are_equal_files_on_any_number_of_threads() {
        let z: Vec<f32> = (0..512 * 16).map(|i| (i as f32).sin()).collect();
        let picture = picture(&z, &vec![1.0; z.len()], 512);
        let files = [1, 2, 5].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut file = Vec::new();
            let range = DepthRange { near: -1.0, far: 1.0 };
            pool.install(|| write_depth(&picture, ColorMap::Turbo, range, &mut file)).unwrap();
            file
        });
        assert!(files[0] == files[1] && files[0] == files[2]);
    }

    #[test]
    fn one_depth_makes_one_colour() {
        for colors in ColorMap::value_variants() {
            let pixels = depth(&[2.0, 2.0], &[1.0, 1.0], *colors, DepthRange { near: 2.0, far: 2.0 });
            assert_eq!(pixels, [colors.table()[0]; 2]);
        }
    }

    #[test]
    fn no_map_passes_near_the_colour_of_a_miss() {
        let distance = |a: &Rgb, b: &Rgb| (0..3).map(|i| (i32::from(a[i]) - i32::from(b[i])).pow(2)).sum::<i32>();
        for colors in ColorMap::value_variants() {
            let closest = colors.table().iter().map(|color| distance(color, &MISS_IN_DEPTH)).min().unwrap();
            assert!(closest > 25 * 25, "{colors:?}: {closest}");
        }
    }

    #[test]
    fn a_missing_channel_is_an_error() {
        let mut picture = picture(&[1.0], &[1.0], 1);
        picture.channels.truncate(1);
        let range = DepthRange { near: 0.0, far: 1.0 };
        let error = write_depth(&picture, ColorMap::Turbo, range, &mut Vec::new()).unwrap_err();
        assert_eq!(error.to_string(), "no channel Z");
    }
}
