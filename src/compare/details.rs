//! What is different in each channel, and where.

use super::{Comparison, Difference, Pair, Tally, Ulps};
use crate::film::ChannelName;
use rayon::prelude::*;

/// Everything about two images in one pass: the [`Tally`], the same channel by channel, and the first pixels that differ.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Details {
    /// Pixels by what is wrong with them.
    pub tally: Tally,
    /// Hits in the image expected.
    pub hits: u64,
    /// Of each channel of numbers that both images have, the hits of both whose number is another one.
    pub numbers: Vec<(ChannelName, u64)>,
    /// Of each channel of depths that both images have, and then of each that says what surfaces are like, the errors of those hits of
    /// both whose numbers are right.
    pub measures: Vec<(ChannelName, Ulps)>,
    /// The first pixels that differ, by their numbers from the upper left corner, row by row.
    pub first: Vec<usize>,
}

/// Pixels that a thread looks at.
const PART: usize = 1 << 16;

impl Details {
    /// Of the first `pixels` of a comparison, which are all of an image of so many; measures may be off by `max_ulp`, and of the
    /// pixels that differ no more than `listed` are listed.
    pub fn of(comparison: &Comparison, pixels: usize, max_ulp: u32, listed: usize) -> Details {
        let starts = (0..pixels).into_par_iter().step_by(PART);
        let parts: Vec<Details> = starts
            .map(|start| {
                Details::of_part(comparison, start..pixels.min(start + PART), max_ulp, listed)
            })
            .collect();
        let mut all = Details::none(comparison);
        for part in parts {
            all.merge(part, listed);
        }
        all
    }

    fn none(comparison: &Comparison) -> Details {
        Details {
            numbers: comparison
                .numbers()
                .iter()
                .map(|pair| (pair.name, 0))
                .collect(),
            measures: measures(comparison)
                .map(|pair| (pair.name, Ulps::default()))
                .collect(),
            ..Details::default()
        }
    }

    fn of_part(
        comparison: &Comparison,
        pixels: std::ops::Range<usize>,
        max_ulp: u32,
        listed: usize,
    ) -> Details {
        let mut part = Details {
            tally: Tally::of(comparison, pixels.clone()),
            ..Details::none(comparison)
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
                        *wrong += u64::from(pair.expected[pixel] != pair.found[pixel]);
                    }
                }
                Difference::None | Difference::Depth(_) | Difference::Primitive(_)
                    if comparison.is_hit(pixel) =>
                {
                    for (pair, (_, ulps)) in measures(comparison).zip(&mut part.measures) {
                        ulps.add(super::ulps_between(pair.expected[pixel], pair.found[pixel]));
                    }
                }
                Difference::None | Difference::Depth(_) | Difference::Primitive(_) => {}
            }
        }
        part
    }

    /// Adds those of the pixels that follow.
    fn merge(&mut self, next: Details, listed: usize) {
        self.tally.merge(&next.tally);
        self.hits += next.hits;
        self.numbers
            .iter_mut()
            .zip(next.numbers)
            .for_each(|((_, wrong), (_, more))| *wrong += more);
        self.measures
            .iter_mut()
            .zip(&next.measures)
            .for_each(|((_, ulps), (_, more))| ulps.merge(more));
        self.first
            .extend(next.first.into_iter().take(listed - self.first.len()));
    }
}

fn measures<'a, 'b>(comparison: &'b Comparison<'a>) -> impl Iterator<Item = &'b Pair<'a, f32>> {
    comparison.depths().iter().chain(comparison.surfaces())
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
