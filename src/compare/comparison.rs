//! Two images, pixel by pixel.

use super::ulps_between;
use crate::film::{ChannelName, Image, PixelBounds};
use std::fmt;

/// Channels that hold depths.
const DEPTHS: [ChannelName; 2] = [ChannelName::Z, ChannelName::T];

/// Channels that tell what was hit.
const NUMBERS: [ChannelName; 3] = [ChannelName::Id, ChannelName::Prim, ChannelName::Instance];

/// What is wrong with a pixel: the worst of it, where several things are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Difference {
    /// Nothing.
    None,
    /// A hit where a miss was expected.
    FalseHit,
    /// A miss where a hit was expected.
    MissedHit,
    /// A hit of something else: a number of it is another one.
    WrongPrimitive,
    /// A hit of the right primitive whose depth is off by so many units in the last place; of `Z` and `t`, the larger error.
    Depth(u32),
    /// A hit of the right primitive of which something else is farther off than its depth: the largest error of `N.X` to `v`.
    Primitive(u32),
}

impl Difference {
    /// Whether it is one where depths, and what surfaces are like, may be off by `max_ulp` units in the last place.
    pub fn is_beyond(self, max_ulp: u32) -> bool {
        match self {
            Difference::None => false,
            Difference::FalseHit | Difference::MissedHit | Difference::WrongPrimitive => true,
            Difference::Depth(ulps) | Difference::Primitive(ulps) => ulps > max_ulp,
        }
    }
}

/// Why two images cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Incomparable {
    /// They do not show the same pixels: those of the image expected, those of the one found.
    Windows(PixelBounds, PixelBounds),
    /// Nothing in one of them tells hits from misses.
    NoHits,
}

impl fmt::Display for Incomparable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Incomparable::Windows(expected, found) => {
                let words = |PixelBounds { x0, x1, y0, y1 }: &PixelBounds| {
                    format!("x {x0} to {x1}, y {y0} to {y1}")
                };
                write!(
                    f,
                    "they show different pixels: {} and {}",
                    words(expected),
                    words(found)
                )
            }
            Incomparable::NoHits => {
                f.write_str("no channel tells hits from misses: expected one of A, id, prim, Z, t")
            }
        }
    }
}

impl std::error::Error for Incomparable {}

/// An image with the right answers, and another one.
///
/// Hits are told by `A`, where an image lacks it by the numbers of what was hit, and where it lacks these too, by depths
/// that are finite. Numbers, depths and what surfaces are like are compared as far as both images have them, and the latter two only
/// where the numbers are right.
#[derive(Debug, Clone)]
pub struct Comparison<'a> {
    expected: Hits<'a>,
    found: Hits<'a>,
    numbers: Vec<Pair<'a, u32>>,
    depths: Vec<Pair<'a, f32>>,
    surfaces: Vec<Pair<'a, f32>>,
}

/// The samples of a channel that both images have.
#[derive(Debug, Clone, Copy)]
pub struct Pair<'a, T> {
    /// Which channel.
    pub name: ChannelName,
    /// Those of the image expected.
    pub expected: &'a [T],
    /// Those of the other one.
    pub found: &'a [T],
}

impl<'a> Comparison<'a> {
    /// Of two images of the same pixels.
    ///
    /// # Errors
    /// Where they are not, or nothing tells their hits.
    pub fn new(expected: &'a Image, found: &'a Image) -> Result<Comparison<'a>, Incomparable> {
        if expected.data_window != found.data_window {
            return Err(Incomparable::Windows(
                expected.data_window,
                found.data_window,
            ));
        }
        let numbers = |name| {
            Some(Pair {
                name,
                expected: expected.numbers(name)?,
                found: found.numbers(name)?,
            })
        };
        let measures = |name| {
            Some(Pair {
                name,
                expected: expected.measures(name)?,
                found: found.measures(name)?,
            })
        };
        Ok(Comparison {
            expected: Hits::of(expected).ok_or(Incomparable::NoHits)?,
            found: Hits::of(found).ok_or(Incomparable::NoHits)?,
            numbers: NUMBERS.into_iter().filter_map(numbers).collect(),
            depths: DEPTHS.into_iter().filter_map(measures).collect(),
            surfaces: ChannelName::SURFACE
                .into_iter()
                .filter_map(measures)
                .collect(),
        })
    }

    /// What is different in pixel number `pixel`, counted from the upper left corner row by row.
    pub fn difference(&self, pixel: usize) -> Difference {
        match (self.expected.is_hit(pixel), self.found.is_hit(pixel)) {
            (false, false) => Difference::None,
            (false, true) => Difference::FalseHit,
            (true, false) => Difference::MissedHit,
            (true, true)
                if self
                    .numbers
                    .iter()
                    .any(|pair| pair.expected[pixel] != pair.found[pixel]) =>
            {
                Difference::WrongPrimitive
            }
            (true, true) => {
                let ulps = |pair: &Pair<f32>| ulps_between(pair.expected[pixel], pair.found[pixel]);
                let [depth, surface] = [&self.depths, &self.surfaces]
                    .map(|pairs| pairs.iter().map(ulps).max().unwrap_or(0));
                match (depth, surface) {
                    (0, 0) => Difference::None,
                    _ if surface > depth => Difference::Primitive(surface),
                    _ => Difference::Depth(depth),
                }
            }
        }
    }

    /// Whether the image expected has a hit in this pixel.
    pub fn is_hit(&self, pixel: usize) -> bool {
        self.expected.is_hit(pixel)
    }

    /// Whether depths are compared: both images have some.
    pub fn has_depths(&self) -> bool {
        !self.depths.is_empty()
    }

    /// The channels that tell what was hit and are compared.
    pub fn numbers(&self) -> &[Pair<'a, u32>] {
        &self.numbers
    }

    /// The channels of depths that are compared.
    pub fn depths(&self) -> &[Pair<'a, f32>] {
        &self.depths
    }

    /// The channels that say what surfaces are like and are compared.
    pub fn surfaces(&self) -> &[Pair<'a, f32>] {
        &self.surfaces
    }
}

/// What tells hits from misses.
#[derive(Debug, Clone, Copy)]
enum Hits<'a> {
    /// Not 0 where something is hit.
    Coverage(&'a [f32]),
    /// Likewise.
    Numbers(&'a [u32]),
    /// Finite where something is hit.
    Depths(&'a [f32]),
}

impl<'a> Hits<'a> {
    fn of(image: &'a Image) -> Option<Hits<'a>> {
        let coverage = || image.measures(ChannelName::A).map(Hits::Coverage);
        let numbers = || {
            [ChannelName::Id, ChannelName::Prim]
                .iter()
                .find_map(|name| image.numbers(*name))
        };
        let depths = || DEPTHS.iter().find_map(|name| image.measures(*name));
        coverage()
            .or_else(|| numbers().map(Hits::Numbers))
            .or_else(|| depths().map(Hits::Depths))
    }

    fn is_hit(&self, pixel: usize) -> bool {
        match self {
            Hits::Coverage(coverage) => coverage[pixel] != 0.0,
            Hits::Numbers(numbers) => numbers[pixel] != 0,
            Hits::Depths(depths) => depths[pixel].is_finite(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, Samples};

    fn image(channels: Vec<(ChannelName, Samples)>) -> Image {
        let width = channels[0].1.len() as u32;
        let channels = channels
            .into_iter()
            .map(|(name, samples)| Channel { name, samples })
            .collect();
        Image {
            display_window: (width, 1),
            data_window: PixelBounds::of_film(width, 1),
            channels,
        }
    }

    fn differences(expected: &Image, found: &Image) -> Vec<Difference> {
        let comparison = Comparison::new(expected, found).unwrap();
        (0..expected.data_window.width() as usize)
            .map(|pixel| comparison.difference(pixel))
            .collect()
    }

    #[test]
    fn the_worst_is_told() {
        let next = 1f32.next_up();
        let expected = image(vec![
            (ChannelName::A, Samples::F32(vec![0.0, 0.0, 1.0, 1.0, 1.0])),
            (ChannelName::Prim, Samples::U32(vec![0, 0, 7, 7, 7])),
            (ChannelName::Z, Samples::F32(vec![9.0, 9.0, 1.0, 1.0, 1.0])),
            (ChannelName::T, Samples::F32(vec![9.0, 9.0, 1.0, 1.0, 1.0])),
        ]);
        let found = image(vec![
            (ChannelName::A, Samples::F32(vec![0.0, 1.0, 0.0, 1.0, 1.0])),
            (ChannelName::Prim, Samples::U32(vec![0, 7, 0, 8, 7])),
            (
                ChannelName::Z,
                Samples::F32(vec![5.0, 1.0, 9.0, next, next]),
            ),
            (
                ChannelName::T,
                Samples::F32(vec![5.0, 1.0, 9.0, 1.0, next.next_up()]),
            ),
        ]);
        use Difference::{Depth, FalseHit, MissedHit, None, WrongPrimitive};
        assert_eq!(
            differences(&expected, &found),
            [None, FalseHit, MissedHit, WrongPrimitive, Depth(2)]
        );
    }

    #[test]
    fn surfaces_count_where_they_are_farther_off_than_depths() {
        let next = 1f32.next_up();
        let measures = |z: [f32; 4], normal: [f32; 4]| {
            let channel = |name, values: [f32; 4]| (name, Samples::F32(values.to_vec()));
            let a = channel(ChannelName::A, [0.0, 1.0, 1.0, 1.0]);
            image(vec![
                a,
                channel(ChannelName::Z, z),
                channel(ChannelName::Nx, normal),
            ])
        };
        let expected = measures([1.0; 4], [1.0; 4]);
        let found = measures(
            [1.0, 1.0, next, next.next_up()],
            [9.0, next, next.next_up(), next],
        );
        use Difference::{Depth, None, Primitive};
        assert_eq!(
            differences(&expected, &found),
            [None, Primitive(1), Primitive(2), Depth(2)]
        );
        assert!(Primitive(2).is_beyond(1) && !Primitive(1).is_beyond(1));
    }

    #[test]
    fn what_only_one_image_has_is_not_compared() {
        let depths = image(vec![(
            ChannelName::Z,
            Samples::F32(vec![f32::INFINITY, 1.0, f32::NAN, 2.0]),
        )]);
        let numbers = image(vec![(ChannelName::Id, Samples::U32(vec![0, 5, 1, 0]))]);
        use Difference::{FalseHit, MissedHit, None};
        assert_eq!(
            differences(&depths, &numbers),
            [None, None, FalseHit, MissedHit]
        );
        assert!(!Comparison::new(&depths, &numbers).unwrap().has_depths());
    }

    #[test]
    fn images_of_other_pixels_and_without_hits_cannot_be_compared() {
        let one = image(vec![(ChannelName::A, Samples::F32(vec![0.0]))]);
        let two = image(vec![(ChannelName::A, Samples::F32(vec![0.0; 2]))]);
        assert!(matches!(
            Comparison::new(&one, &two),
            Err(Incomparable::Windows(..))
        ));
        let instances = image(vec![(ChannelName::Instance, Samples::U32(vec![0]))]);
        assert_eq!(
            Comparison::new(&one, &instances).unwrap_err(),
            Incomparable::NoHits
        );
    }
}
