//! Collects everything about a comparison in one pass: counts, errors by channel, and the first
//! differing pixels.

use super::comparison::{Comparison, Difference};
use super::tally::Tally;
use super::ulps::Ulps;
use crate::film::ChannelName;
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::ops::Range;

/// The [`Tally`] of a comparison, the same by channel, and the first pixels that differ.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Details {
    /// Pixels by their difference.
    pub tally: Tally,
    /// Hits in the expected image.
    pub hits: u64,
    /// For each compared channel of numbers, the hits of both images whose numbers differ.
    pub numbers: Vec<(ChannelName, u64)>,
    /// For each compared channel of depths and surfaces, the errors of the hits of both images
    /// whose numbers are right.
    pub measures: Vec<(ChannelName, Ulps)>,
    /// The numbers of the first pixels that differ, counted row by row from the upper left corner.
    pub first: Vec<usize>,
}

/// Pixels that one thread looks at.
const PART: usize = 1 << 16;

impl Details {
    /// Compares the first `pixels` pixels. Values within `max_ulp` ulps count as equal, and no more
    /// than `listed` differing pixels are recorded.
    pub fn of(comparison: &Comparison, pixels: usize, max_ulp: u32, listed: usize) -> Details {
        let starts = (0..pixels).into_par_iter().step_by(PART);
        let part =
            |start| Details::of_part(comparison, start..pixels.min(start + PART), max_ulp, listed);
        let parts: Vec<Details> = starts.map(part).collect_vec();
        let mut all = Details::empty(comparison);
        for part in parts {
            all.merge(part, listed);
        }
        all
    }

    fn empty(comparison: &Comparison) -> Details {
        let measures = comparison.measures();
        Details {
            numbers: comparison
                .numbers()
                .iter()
                .map(|pair| (pair.name, 0))
                .collect(),
            measures: measures.map(|pair| (pair.name, Ulps::default())).collect(),
            ..Details::default()
        }
    }

    fn of_part(
        comparison: &Comparison,
        pixels: Range<usize>,
        max_ulp: u32,
        listed: usize,
    ) -> Details {
        let mut part = Details {
            tally: Tally::of(comparison, pixels.clone()),
            ..Details::empty(comparison)
        };
        for pixel in pixels {
            part.hits += u64::from(comparison.is_hit(pixel));
            let difference = comparison.difference(pixel);
            if difference.is_beyond(max_ulp) && part.first.len() < listed {
                part.first.push(pixel);
            }
            match difference {
                Difference::FalseHit | Difference::MissedHit => {}
                Difference::WrongPrimitive => {
                    for (pair, (_, wrong)) in comparison.numbers().iter().zip(&mut part.numbers) {
                        *wrong += u64::from(pair.differs(pixel));
                    }
                }
                Difference::None | Difference::Depth(_) | Difference::Surface(_) => {
                    if comparison.is_hit(pixel) {
                        for (pair, (_, ulps)) in comparison.measures().zip(&mut part.measures) {
                            ulps.add(pair.error(pixel));
                        }
                    }
                }
            }
        }
        part
    }

    /// Adds the details of the pixels that follow.
    fn merge(&mut self, next: Details, listed: usize) {
        self.tally.merge(&next.tally);
        self.hits += next.hits;
        for ((_, wrong), (_, more)) in self.numbers.iter_mut().zip(next.numbers) {
            *wrong += more;
        }
        for ((_, ulps), (_, more)) in self.measures.iter_mut().zip(&next.measures) {
            ulps.merge(more);
        }
        let room = listed - self.first.len();
        self.first.extend(next.first.into_iter().take(room));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, Image, PixelBounds, Samples};

    #[test]
    fn all_parts_are_merged_in_order() {
        let width = 3 * PART as u32 + 5;
        let image = |prim: Vec<u32>, z: Vec<f32>| {
            let prim = Channel {
                name: ChannelName::Prim,
                samples: Samples::U32(prim),
            };
            let z = Channel {
                name: ChannelName::Z,
                samples: Samples::F32(z),
            };
            let data_window = PixelBounds::of_film(width, 1);
            Image {
                display_window: (width, 1),
                data_window,
                channels: vec![z, prim],
            }
        };
        let expected = image(vec![1; width as usize], vec![1.0; width as usize]);
        let (mut prim, mut z) = (vec![1; width as usize], vec![1.0; width as usize]);
        let last = width as usize - 1;
        (prim[PART], prim[PART + 1], prim[last]) = (2, 0, 3);
        (z[PART - 1], z[2 * PART], z[last]) = (1f32.next_up(), 1f32.next_up().next_up(), 7.0);
        let found = image(prim, z);
        let comparison = Comparison::new(&expected, &found).unwrap();
        let details = Details::of(&comparison, width as usize, 1, 3);
        assert_eq!(details.first, [PART, PART + 1, 2 * PART]);
        assert_eq!(details.tally, Tally::of(&comparison, 0..width as usize));
        assert_eq!(details.tally.different(1), 4);
        assert_eq!(
            (details.hits, &details.numbers[..]),
            (width.into(), &[(ChannelName::Prim, 2)][..])
        );
        let [(ChannelName::Z, ulps)] = &details.measures[..] else {
            panic!("{:?}", details.measures)
        };
        assert_eq!(
            (ulps.total(), ulps.max(), ulps.above(0)),
            (u64::from(width) - 3, Some(2), 2)
        );
    }
}
