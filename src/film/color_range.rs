//! The range of depths or costs that a picture shows.

use super::{ChannelName, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;

/// The values at the two ends of a colour map: depths from near to far, or costs from low to high.
/// If `start` is above `end`, the map is reversed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorRange {
    /// The near depth or the low cost.
    pub start: f32,
    /// The far depth or the high cost.
    pub end: f32,
}

impl ColorRange {
    /// From the smallest to the largest finite `Z` of the image's hits. `None` if no hit has a
    /// finite depth, or if the image lacks `Z` or `A`.
    pub fn of_depths(image: &Image) -> Option<ColorRange> {
        let z = image.measures(ChannelName::Z)?;
        let a = image.measures(ChannelName::A)?;
        // In parts of a fixed size and in order: the sign of a zero depends on the order.
        let parts = z.par_chunks(PART).zip(a.par_chunks(PART));
        let parts: Vec<ColorRange> = parts.map(|(z, a)| range_of_part(z, a)).collect_vec();
        let range = parts.into_iter().fold(EMPTY, wider);
        (range.start <= range.end).then_some(range)
    }

    /// From 0 to the cost that `per_mille` of the image's rays do not exceed: a few rays may cost
    /// many times as much as all others. `None` if the image lacks the channel `cost`.
    pub fn of_costs(image: &Image, per_mille: usize) -> Option<ColorRange> {
        let mut costs = image.numbers(ChannelName::Cost)?.to_vec();
        let rank = (costs.len() * per_mille / 1000).min(costs.len().checked_sub(1)?);
        let end = *costs.select_nth_unstable(rank).1 as f32;
        Some(ColorRange { start: 0.0, end })
    }

    /// The position of `value` between `start` (0) and `end` (1), clamped to that range. If both
    /// ends are equal, that value and all below are at 0. Never NaN.
    pub fn position(&self, value: f32) -> f64 {
        // In f64 the difference of two f32 neither overflows nor vanishes.
        let [value, start, end] = [value, self.start, self.end].map(f64::from);
        let position = if start == end {
            value - start
        } else {
            (value - start) / (end - start)
        };
        // Only infinite ends can make a NaN.
        if position.is_nan() {
            0.0
        } else {
            position.clamp(0.0, 1.0)
        }
    }
}

/// Pixels that one thread looks at.
const PART: usize = 1 << 14;

/// The range of no depth at all.
const EMPTY: ColorRange = ColorRange {
    start: f32::INFINITY,
    end: f32::NEG_INFINITY,
};

fn range_of_part(z: &[f32], a: &[f32]) -> ColorRange {
    let samples = z.iter().zip(a);
    let finite = samples.filter(|(z, a)| **a != 0.0 && z.is_finite());
    let single = |(z, _): (&f32, &f32)| ColorRange { start: *z, end: *z };
    finite.map(single).fold(EMPTY, wider)
}

fn wider(one: ColorRange, other: ColorRange) -> ColorRange {
    ColorRange {
        start: one.start.min(other.start),
        end: one.end.max(other.end),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};
    use proptest::num::f32::ANY;
    use proptest::prelude::*;

    fn image(channels: &[(ChannelName, Samples)]) -> Image {
        let width = channels[0].1.len() as u32;
        let channels = channels.iter().cloned();
        Image {
            display_window: (width, 1),
            data_window: PixelBounds::of_film(width, 1),
            channels: channels
                .map(|(name, samples)| Channel { name, samples })
                .collect(),
        }
    }

    fn of_depths(z: &[f32], a: &[f32]) -> Option<ColorRange> {
        let [z, a] = [z, a].map(|values| Samples::F32(values.to_vec()));
        ColorRange::of_depths(&image(&[(ChannelName::Z, z), (ChannelName::A, a)]))
    }

    fn range(start: f32, end: f32) -> ColorRange {
        ColorRange { start, end }
    }

    #[test]
    fn depths_span_the_finite_hits_and_ignore_misses() {
        let z = [0.0, 3.0, f32::NAN, -1.0, f32::INFINITY, 5.0];
        let a = [0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
        assert_eq!(of_depths(&z, &a), Some(range(-1.0, 3.0)));
    }

    #[test]
    fn without_a_finite_hit_there_is_no_range() {
        assert_eq!(of_depths(&[1.0, 2.0], &[0.0, 0.0]), None);
        assert_eq!(of_depths(&[f32::INFINITY], &[1.0]), None);
    }

    #[test]
    fn costs_span_the_range_from_zero_to_a_percentile() {
        let of = |name, costs: Vec<u32>, per_mille| {
            ColorRange::of_costs(&image(&[(name, Samples::U32(costs))]), per_mille)
        };
        let few = || vec![7, 90, 8];
        assert_eq!(of(ChannelName::Cost, few(), 995), Some(range(0.0, 90.0)));
        assert_eq!(of(ChannelName::Cost, few(), 1000), Some(range(0.0, 90.0)));
        assert_eq!(of(ChannelName::Cost, few(), 0), Some(range(0.0, 7.0)));
        let many = (0..1000).rev().collect();
        assert_eq!(of(ChannelName::Cost, many, 995), Some(range(0.0, 995.0)));
        assert_eq!(of(ChannelName::Id, few(), 995), None);
    }

    #[test]
    fn a_range_of_one_value_starts_with_it() {
        let positions = [1.0, 2.0, f32::INFINITY].map(|value| range(2.0, 2.0).position(value));
        assert_eq!(positions, [0.0, 0.0, 1.0]);
        assert_eq!(range(0.0, 0.0).position(0.0), 0.0);
    }

    #[test]
    fn positions_are_clamped_and_may_be_reversed() {
        let values = [0.0, 1.0, 2.0, 3.0, f32::INFINITY];
        let positions = values.map(|value| range(1.0, 3.0).position(value));
        assert_eq!(positions, [0.0, 0.0, 0.5, 1.0, 1.0]);
        let reversed = [0.0, 1.0, 2.0, 4.0].map(|value| range(3.0, 1.0).position(value));
        assert_eq!(reversed, [1.0, 1.0, 0.5, 0.0]);
        assert_eq!(range(-f32::MAX, f32::MAX).position(0.0), 0.5);
    }

    proptest! {
        #[test]
        fn a_position_is_always_between_0_and_1(start in ANY, end in ANY, value in ANY) {
            prop_assert!((0.0..=1.0).contains(&range(start, end).position(value)));
        }
    }
}
