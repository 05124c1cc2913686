//! Differences as a picture for people.

use super::{ColorComparison, ColorDifference, Comparison, Difference};
use rayon::prelude::*;

/// A colour: red, green, blue.
type Rgb = [u8; 3];

/// Misses, and colours, that are equal.
pub const EQUAL: Rgb = [20, 20, 24];
/// Hits that are equal.
pub const EQUAL_HIT: Rgb = [88, 88, 88];
/// A hit where a miss was expected: vermilion, one of the colours of Okabe and Ito that the colour-blind tell apart, as
/// are those below.
pub const FALSE_HIT: Rgb = [213, 94, 0];
/// A miss where a hit was expected: sky blue.
pub const MISSED_HIT: Rgb = [86, 180, 233];
/// A hit of something else: reddish purple.
pub const WRONG_PRIMITIVE: Rgb = [204, 121, 167];
/// The ends of the ramp of depth errors: from a dark green to yellow.
pub const DEPTH: [Rgb; 2] = [[0, 84, 62], [240, 228, 66]];

/// A colour for each of `pixels` pixels, which are all of the images compared. Errors of depths, and of what surfaces are like, are shown by the logarithm of one more
/// than their units in the last place; those of `max_ulp` and beyond get the brightest colour.
pub fn difference_picture(comparison: &Comparison, pixels: usize, max_ulp: u32) -> Vec<[u8; 3]> {
    let color = |pixel: usize| match comparison.difference(pixel) {
        Difference::None if comparison.is_hit(pixel) => EQUAL_HIT,
        Difference::None => EQUAL,
        Difference::FalseHit => FALSE_HIT,
        Difference::MissedHit => MISSED_HIT,
        Difference::WrongPrimitive => WRONG_PRIMITIVE,
        Difference::Depth(ulps) | Difference::Primitive(ulps) => ramp(ulps, max_ulp),
    };
    (0..pixels).into_par_iter().map(color).collect()
}

/// Likewise of two pictures; differences of colours, where nothing tells of hits, get the colours of depth errors, the brightest
/// one from a difference of `max` on.
pub fn color_difference_picture(comparison: &ColorComparison, max: u16) -> Vec<[u8; 3]> {
    let color = |pixel: usize| match comparison.difference(pixel) {
        ColorDifference::None => EQUAL,
        ColorDifference::FalseHit => FALSE_HIT,
        ColorDifference::MissedHit => MISSED_HIT,
        ColorDifference::Color(difference) => ramp(difference.into(), max.into()),
    };
    (0..comparison.pixels())
        .into_par_iter()
        .map(color)
        .collect()
}

/// The colour of an error that is not 0.
fn ramp(error: u32, max: u32) -> Rgb {
    let logarithm = |error: u32| (f64::from(error) + 1.0).ln();
    let position = (logarithm(error) / logarithm(max.max(1))).min(1.0);
    let [low, high] = DEPTH;
    std::array::from_fn(|i| {
        (f64::from(low[i]) + position * (f64::from(high[i]) - f64::from(low[i]))).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, ChannelName, Image, PixelBounds, Samples};

    #[test]
    fn each_kind_has_a_color_of_its_own() {
        let image = |prim: [u32; 6], z: [f32; 6]| Image {
            display_window: (6, 1),
            data_window: PixelBounds::of_film(6, 1),
            channels: vec![
                Channel {
                    name: ChannelName::Prim,
                    samples: Samples::U32(prim.to_vec()),
                },
                Channel {
                    name: ChannelName::Z,
                    samples: Samples::F32(z.to_vec()),
                },
            ],
        };
        let expected = image([0, 1, 0, 1, 1, 1], [0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
        let found = image(
            [0, 1, 1, 0, 2, 1],
            [5.0, 1.0, 1.0, 1.0, 1.0, 1f32.next_up()],
        );
        let comparison = Comparison::new(&expected, &found).unwrap();
        let picture = difference_picture(&comparison, 6, 1);
        assert_eq!(
            picture,
            [
                EQUAL,
                EQUAL_HIT,
                FALSE_HIT,
                MISSED_HIT,
                WRONG_PRIMITIVE,
                DEPTH[1]
            ]
        );
    }

    #[test]
    fn larger_errors_are_brighter_up_to_the_largest() {
        let ramp: Vec<Rgb> = [1, 2, 10, 1000, 100_000, u32::MAX]
            .iter()
            .map(|ulps| ramp(*ulps, 100_000))
            .collect();
        assert!(
            ramp[..5].is_sorted_by(|a, b| a[0] < b[0] && a[1] < b[1]),
            "{ramp:?}"
        );
        assert_eq!(ramp[4..], [DEPTH[1]; 2]);
        assert_eq!(super::ramp(7, 0), DEPTH[1]);
        assert_ne!(super::ramp(1, u32::MAX), EQUAL_HIT);
    }
}
