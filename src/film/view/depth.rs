//! The depth view: depth from near to far, through a colour map.

use super::samples::measures;
use crate::film::color_map::Rgb;
use crate::film::{ChannelName, ColorMap, ColorRange, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::io;

/// The colour of a miss in the depth view: a pale sky. No colour map comes near it, not even gray,
/// and it contrasts with the dark far ends, where objects meet the background.
pub const MISS_IN_DEPTH: Rgb = [184, 200, 224];

/// The colours of `image`, row by row from the top; `range` is stretched over `colors`.
///
/// # Errors
/// The image lacks `Z` or `A`.
pub fn depth(image: &Image, colors: ColorMap, range: ColorRange) -> io::Result<Vec<Rgb>> {
    let (z, a) = (
        measures(image, ChannelName::Z)?,
        measures(image, ChannelName::A)?,
    );
    let color = colors.steps();
    let pixel = |(z, a): (&f32, &f32)| {
        if *a != 0.0 {
            color(range.position(*z))
        } else {
            MISS_IN_DEPTH
        }
    };
    Ok(z.par_iter().zip(a).map(pixel).collect_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::color_map::TABLE_LENGTH;
    use crate::film::{Channel, PixelBounds, Samples};

    fn depths(z: &[f32], a: &[f32], colors: ColorMap, range: ColorRange) -> Vec<Rgb> {
        let channel = |name, values: &[f32]| Channel {
            name,
            samples: Samples::F32(values.to_vec()),
        };
        let size = (z.len() as u32, 1);
        let channels = vec![channel(ChannelName::A, a), channel(ChannelName::Z, z)];
        let image = Image {
            display_window: size,
            data_window: PixelBounds::of_film(size.0, 1),
            channels,
        };
        depth(&image, colors, range).unwrap()
    }

    #[test]
    fn depth_goes_from_near_to_far_and_values_of_misses_do_not_show() {
        let z = [1.0, 3.0, f32::INFINITY, 0.0, f32::NAN, 2.0, 2.0];
        let a = [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0];
        let pixels = depths(
            &z,
            &a,
            ColorMap::Gray,
            ColorRange {
                start: 1.0,
                end: 3.0,
            },
        );
        let gray = |value| [value; 3];
        assert_eq!(pixels[..4], [gray(255), gray(0), gray(0), gray(255)]);
        assert_eq!(pixels[4..6], [MISS_IN_DEPTH; 2]);
        assert!((127..=128).contains(&pixels[6][0]));
    }

    #[test]
    fn depths_beyond_the_range_get_the_colours_of_its_ends() {
        for colors in ColorMap::ALL {
            let (table, range) = (
                colors.table(),
                ColorRange {
                    start: 1.0,
                    end: 3.0,
                },
            );
            let z = [
                f32::NEG_INFINITY,
                -7.0,
                1.0,
                3.0,
                3.1,
                f32::MAX,
                f32::INFINITY,
            ];
            let (near, far) = (table[0], table[TABLE_LENGTH - 1]);
            assert_eq!(
                depths(&z, &[1.0; 7], colors, range),
                [near, near, near, far, far, far, far],
                "{colors:?}"
            );
        }
    }

    #[test]
    fn a_single_depth_has_a_single_colour() {
        for colors in ColorMap::ALL {
            let pixels = depths(
                &[2.0, 2.0],
                &[1.0, 1.0],
                colors,
                ColorRange {
                    start: 2.0,
                    end: 2.0,
                },
            );
            assert_eq!(pixels, [colors.table()[0]; 2]);
        }
    }

    #[test]
    fn no_colour_map_comes_near_the_colour_of_a_miss() {
        let distance = |a: &Rgb, b: &Rgb| {
            (0..3)
                .map(|i| (i32::from(a[i]) - i32::from(b[i])).pow(2))
                .sum::<i32>()
        };
        for colors in ColorMap::ALL {
            let closest = colors
                .table()
                .iter()
                .map(|color| distance(color, &MISS_IN_DEPTH))
                .min()
                .unwrap();
            assert!(closest > 25 * 25, "{colors:?}: {closest}");
        }
    }
}
