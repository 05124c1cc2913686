//! Pictures of differences.

use super::comparison::{Comparison, Difference};
use crate::parallel::CollectVec;
use rayon::prelude::*;

/// A colour: red, green, blue.
type Rgb = [u8; 3];

/// Equal misses.
pub const EQUAL: Rgb = [20, 20, 24];
/// Equal hits.
pub const EQUAL_HIT: Rgb = [88, 88, 88];
/// A false hit: vermilion. This and the following are colours of Okabe and Ito, which colour-blind
/// readers can distinguish.
pub const FALSE_HIT: Rgb = [213, 94, 0];
/// A missed hit: sky blue.
pub const MISSED_HIT: Rgb = [86, 180, 233];
/// A wrong primitive: reddish purple.
pub const WRONG_PRIMITIVE: Rgb = [204, 121, 167];
/// The ends of the ramp of depth errors: from a dark green to yellow.
pub const DEPTH: [Rgb; 2] = [[0, 84, 62], [240, 228, 66]];

/// A colour for each of the first `pixels` pixels. The brightness of an error of a depth or a
/// surface is the logarithm of one more than its ulps; errors of `max_ulp` and more are the
/// brightest.
pub fn difference_picture(comparison: &Comparison, pixels: usize, max_ulp: u32) -> Vec<[u8; 3]> {
    let color = |pixel: usize| match comparison.difference(pixel) {
        Difference::None if comparison.is_hit(pixel) => EQUAL_HIT,
        Difference::None => EQUAL,
        Difference::FalseHit => FALSE_HIT,
        Difference::MissedHit => MISSED_HIT,
        Difference::WrongPrimitive => WRONG_PRIMITIVE,
        Difference::Depth(ulps) | Difference::Surface(ulps) => ramp(ulps, max_ulp),
    };
    (0..pixels).into_par_iter().map(color).collect_vec()
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
    fn each_kind_of_difference_has_its_colour() {
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
