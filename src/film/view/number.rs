//! The views of numbers: a colour for each shape, primitive or instance.

use super::samples::{NOTHING, numbers};
use crate::film::color_map::Rgb;
use crate::film::{ChannelName, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::io;

/// The colours of the numbers in channel `name` of `image`, row by row from the top; 0, as at a
/// miss, is black. A number has the same colour in every image. Consecutive numbers never look
/// alike, but some distant ones do.
///
/// # Errors
/// The image lacks the channel.
pub fn number(image: &Image, name: ChannelName) -> io::Result<Vec<Rgb>> {
    Ok(numbers(image, name)?
        .par_iter()
        .map(|number| color_of(*number))
        .collect_vec())
}

/// The golden ratio as a fraction of 2^32: its multiples spread evenly over a circle, for any
/// number of them.
const GOLDEN: u32 = 0x9e37_79b9;

/// A saturated hue, in one of three brightnesses by turns.
fn color_of(number: u32) -> Rgb {
    if number == 0 {
        return NOTHING;
    }
    let hue = f64::from(number.wrapping_mul(GOLDEN)) / f64::from(u32::MAX) * 6.0;
    let brightness = [255.0, 200.0, 150.0][number as usize % 3];
    // Each component is a trapezium along the circle of hues, a third of a turn after the one
    // before.
    [0.0, 2.0, 4.0].map(|shift| {
        let distance = (hue - shift).rem_euclid(6.0);
        let distance = distance.min(6.0 - distance);
        let full = (2.0 - distance).clamp(0.0, 1.0);
        (brightness * (0.15 + 0.85 * full)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    #[test]
    fn only_misses_are_black() {
        let channels = vec![Channel {
            name: ChannelName::Id,
            samples: Samples::U32(vec![0, 1, 7, 1]),
        }];
        let image = Image {
            display_window: (2, 2),
            data_window: PixelBounds::of_film(2, 2),
            channels,
        };
        let colors = number(&image, ChannelName::Id).unwrap();
        assert_eq!((colors[0], colors[1]), (NOTHING, colors[3]));
        assert!(colors[1] != colors[2]);
        assert!(
            (1..100_000).all(|number| color_of(number).iter().any(|component| *component >= 120))
        );
    }

    #[test]
    fn close_numbers_have_different_colours() {
        let distance = |a: Rgb, b: Rgb| (0..3).map(|i| a[i].abs_diff(b[i])).max().unwrap();
        for number in 1..10_000 {
            for next in number + 1..number + 5 {
                assert!(
                    distance(color_of(number), color_of(next)) > 30,
                    "{number} and {next}"
                );
            }
        }
    }
}
