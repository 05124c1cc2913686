//! The stretch of costs that a picture shows.

use super::depth_range::position_between;
use super::{ChannelName, Image};
use rayon::prelude::*;

/// The costs, in tests a ray, that get the two ends of a colour map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CostRange {
    /// The cost at the far end of the map, which is dark.
    pub low: f32,
    /// The cost at the near end, which is bright or warm.
    pub high: f32,
}

impl CostRange {
    /// From 0 to the largest cost of the image. `None` where it lacks the channel `cost`.
    pub fn of_image(image: &Image) -> Option<CostRange> {
        let largest = image.numbers(ChannelName::Cost)?.par_iter().max();
        Some(CostRange {
            low: 0.0,
            high: largest.map_or(0.0, |cost| *cost as f32),
        })
    }

    /// Where `cost` lies on the way from high (0) to low (1), clamped to it: its place in a colour map. In a range of one cost, that
    /// cost and everything below it is low. Never NaN.
    pub fn position(&self, cost: u32) -> f64 {
        1.0 - position_between(cost as f32, self.low, self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    fn image(name: ChannelName, costs: Vec<u32>) -> Image {
        let width = costs.len() as u32;
        let channels = vec![Channel {
            name,
            samples: Samples::U32(costs),
        }];
        Image {
            display_window: (width, 1),
            data_window: PixelBounds::of_film(width, 1),
            channels,
        }
    }

    #[test]
    fn spans_all_from_zero() {
        assert_eq!(
            CostRange::of_image(&image(ChannelName::Cost, vec![7, 90, 8])),
            Some(CostRange {
                low: 0.0,
                high: 90.0
            })
        );
        assert_eq!(CostRange::of_image(&image(ChannelName::Id, vec![7])), None);
    }

    #[test]
    fn dear_is_near_and_cheap_is_far() {
        let range = CostRange {
            low: 10.0,
            high: 30.0,
        };
        assert_eq!(
            [0, 10, 20, 30, u32::MAX].map(|cost| range.position(cost)),
            [1.0, 1.0, 0.5, 0.0, 0.0]
        );
    }

    #[test]
    fn where_nothing_costs_anything_all_is_cheap() {
        assert_eq!(
            CostRange {
                low: 0.0,
                high: 0.0
            }
            .position(0),
            1.0
        );
    }
}
