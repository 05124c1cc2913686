//! The stretch of depths that a picture shows.

use super::{ChannelName, Image};
use rayon::prelude::*;

/// The depths that get the two ends of a colour map. Where `near` lies beyond `far`, the map is reversed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthRange {
    /// The depth at the near end.
    pub near: f32,
    /// The depth at the far end.
    pub far: f32,
}

impl DepthRange {
    /// The smallest and the largest finite `Z` of the image's hits. `None` where no hit has a finite depth, or
    /// the image lacks `Z` or `A`.
    pub fn of_hits(image: &Image) -> Option<DepthRange> {
        let (z, a) = (
            image.measures(ChannelName::Z)?,
            image.measures(ChannelName::A)?,
        );
        // In parts of a fixed size and in order: of two zeros the sign depends on the order.
        let parts = z
            .par_chunks(PART)
            .zip(a.par_chunks(PART))
            .map(|(z, a)| range_of_part(z, a));
        let parts: Vec<(f32, f32)> = parts.collect();
        let (near, far) = parts.into_iter().fold(NOTHING, wider);
        (near <= far).then_some(DepthRange { near, far })
    }

    /// Where `z` lies on the way from near (0) to far (1), clamped to it. In a range of one depth, that depth and
    /// everything before it is near. Never NaN.
    pub fn position(&self, z: f32) -> f64 {
        position_between(z, self.near, self.far)
    }
}

/// Where `value` lies on the way from `start` (0) to `end` (1), clamped to it; what is not beyond a start that is the end is at
/// 0. Never NaN.
pub(super) fn position_between(value: f32, start: f32, end: f32) -> f64 {
    // In f64 the difference of two f32 neither overflows nor vanishes.
    let (value, start, end) = (f64::from(value), f64::from(start), f64::from(end));
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

/// Pixels that one thread looks at.
const PART: usize = 1 << 14;

/// The range of no depth at all.
const NOTHING: (f32, f32) = (f32::INFINITY, f32::NEG_INFINITY);

fn range_of_part(z: &[f32], a: &[f32]) -> (f32, f32) {
    let of_hit = |(z, a): (&f32, &f32)| {
        if *a != 0.0 && z.is_finite() {
            (*z, *z)
        } else {
            NOTHING
        }
    };
    z.iter().zip(a).map(of_hit).fold(NOTHING, wider)
}

fn wider(one: (f32, f32), other: (f32, f32)) -> (f32, f32) {
    (one.0.min(other.0), one.1.max(other.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};
    use proptest::num::f32::ANY;
    use proptest::prelude::*;

    fn image(z: &[f32], a: &[f32]) -> Image {
        let channel = |name, values: &[f32]| Channel {
            name,
            samples: Samples::F32(values.to_vec()),
        };
        Image {
            display_window: (z.len() as u32, 1),
            data_window: PixelBounds::of_film(z.len() as u32, 1),
            channels: vec![channel(ChannelName::Z, z), channel(ChannelName::A, a)],
        }
    }

    #[test]
    fn spans_the_finite_hits_and_ignores_what_misses_hold() {
        let image = image(
            &[0.0, 3.0, f32::NAN, -1.0, f32::INFINITY, 5.0],
            &[0.0, 1.0, 0.0, 1.0, 1.0, 0.0],
        );
        assert_eq!(
            DepthRange::of_hits(&image),
            Some(DepthRange {
                near: -1.0,
                far: 3.0
            })
        );
    }

    #[test]
    fn nothing_was_hit() {
        assert_eq!(DepthRange::of_hits(&image(&[1.0, 2.0], &[0.0, 0.0])), None);
        assert_eq!(DepthRange::of_hits(&image(&[f32::INFINITY], &[1.0])), None);
    }

    #[test]
    fn one_depth_is_near() {
        let range = DepthRange {
            near: 2.0,
            far: 2.0,
        };
        assert_eq!(
            [1.0, 2.0, f32::INFINITY].map(|z| range.position(z)),
            [0.0, 0.0, 1.0]
        );
    }

    #[test]
    fn clamps_to_both_ends_and_reverses() {
        let range = DepthRange {
            near: 1.0,
            far: 3.0,
        };
        assert_eq!(
            [0.0, 1.0, 2.0, 3.0, f32::INFINITY].map(|z| range.position(z)),
            [0.0, 0.0, 0.5, 1.0, 1.0]
        );
        let reversed = DepthRange {
            near: 3.0,
            far: 1.0,
        };
        assert_eq!(
            [0.0, 1.0, 2.0, 4.0].map(|z| reversed.position(z)),
            [1.0, 1.0, 0.5, 0.0]
        );
        let whole = DepthRange {
            near: -f32::MAX,
            far: f32::MAX,
        };
        assert_eq!(whole.position(0.0), 0.5);
    }

    proptest! {
        #[test]
        fn is_always_on_the_way(near in ANY, far in ANY, z in ANY) {
            let position = DepthRange { near, far }.position(z);
            prop_assert!((0.0..=1.0).contains(&position));
        }
    }
}
