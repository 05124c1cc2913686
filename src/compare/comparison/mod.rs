//! Compares two images pixel by pixel.

#[cfg(test)]
mod tests;

use super::ulps::ulps_between;
use crate::film::{ChannelName, Image, PixelBounds, Samples};
use std::fmt;

/// Channels of depths.
const DEPTHS: [ChannelName; 2] = [ChannelName::Z, ChannelName::T];

/// Channels that identify what was hit.
const NUMBERS: [ChannelName; 3] = [ChannelName::Id, ChannelName::Prim, ChannelName::Instance];

/// The worst difference of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Difference {
    /// No difference.
    None,
    /// A hit, but a miss was expected.
    FalseHit,
    /// A miss, but a hit was expected.
    MissedHit,
    /// A hit with a wrong number: `id`, `prim` or `instance`.
    WrongPrimitive,
    /// A hit of the right primitive with a wrong depth: the larger error of `Z` and `t`, in units
    /// in the last place.
    Depth(u32),
    /// A hit of the right primitive, and `N.X` to `v` are worse than its depth: their largest
    /// error.
    Surface(u32),
}

impl Difference {
    /// Returns true if the difference exceeds a tolerance of `max_ulp` units in the last place for
    /// depths and surfaces.
    pub fn is_beyond(self, max_ulp: u32) -> bool {
        match self {
            Difference::None => false,
            Difference::FalseHit | Difference::MissedHit | Difference::WrongPrimitive => true,
            Difference::Depth(ulps) | Difference::Surface(ulps) => ulps > max_ulp,
        }
    }
}

/// Why two images cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Incomparable {
    /// They show different pixels: those of the expected and of the found image.
    Windows(PixelBounds, PixelBounds),
    /// No channel of one of them distinguishes hits from misses.
    NoHits,
    /// One has depths in scene units, the other in steps of an unknown size.
    Units,
}

impl fmt::Display for Incomparable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Incomparable::Windows(expected, found) => {
                let words = |PixelBounds { x0, x1, y0, y1 }: &PixelBounds| {
                    format!("x {x0} to {x1}, y {y0} to {y1}")
                };
                let (expected, found) = (words(expected), words(found));
                write!(f, "they show different pixels: {expected} and {found}")
            }
            Incomparable::NoHits => f.write_str(
                "no channel distinguishes hits from misses: expected one of A, id, prim, Z, t",
            ),
            Incomparable::Units => {
                f.write_str("16-bit depths have no known unit: they compare with each other only")
            }
        }
    }
}

impl std::error::Error for Incomparable {}

/// An image with the expected answers, and another one.
///
/// `A` distinguishes hits from misses; without it the numbers of what was hit do, and without these
/// depths that are finite. Channels are compared if both images have them. Depths and surfaces
/// count only where the numbers are right.
#[derive(Debug, Clone)]
pub struct Comparison<'a> {
    expected: Hits<'a>,
    found: Hits<'a>,
    numbers: Vec<NumberPair<'a>>,
    depths: Vec<MeasurePair<'a>>,
    surfaces: Vec<MeasurePair<'a>>,
}

/// The samples of a channel of numbers in both images.
#[derive(Debug, Clone, Copy)]
pub struct NumberPair<'a> {
    /// The channel.
    pub name: ChannelName,
    expected: &'a [u32],
    found: &'a [u32],
}

impl NumberPair<'_> {
    /// Returns true if the numbers of pixel number `pixel` differ.
    pub fn differs(&self, pixel: usize) -> bool {
        self.expected[pixel] != self.found[pixel]
    }
}

/// The samples of a channel of depths or surfaces in both images.
#[derive(Debug, Clone, Copy)]
pub struct MeasurePair<'a> {
    /// The channel.
    pub name: ChannelName,
    /// Of the same type as `found`.
    expected: &'a Samples,
    found: &'a Samples,
}

impl MeasurePair<'_> {
    /// The error in pixel number `pixel`: units in the last place, or steps of integer depths.
    pub fn error(&self, pixel: usize) -> u32 {
        match (self.expected, self.found) {
            (Samples::F32(a), Samples::F32(b)) => ulps_between(a[pixel], b[pixel]),
            (Samples::U32(a), Samples::U32(b)) => a[pixel].abs_diff(b[pixel]),
            _ => u32::MAX,
        }
    }
}

impl<'a> Comparison<'a> {
    /// Compares two images of the same pixels. Depths that are integers are steps of an unknown
    /// size, as in a 16-bit PNG.
    ///
    /// # Errors
    /// The images show different pixels, have depths of different units, or no hits.
    pub fn new(expected: &'a Image, found: &'a Image) -> Result<Comparison<'a>, Incomparable> {
        let windows = [expected, found].map(|image| image.data_window);
        if windows[0] != windows[1] {
            return Err(Incomparable::Windows(windows[0], windows[1]));
        }
        let numbers = |name| {
            let (expected, found) = (expected.numbers(name)?, found.numbers(name)?);
            Some(NumberPair {
                name,
                expected,
                found,
            })
        };
        let measures = |name| {
            let samples = |image: &'a Image| {
                let channel = image.channels.iter().find(|channel| channel.name == name);
                channel.map(|channel| &channel.samples)
            };
            let (expected, found) = (samples(expected)?, samples(found)?);
            Some(MeasurePair {
                name,
                expected,
                found,
            })
        };
        let depths: Vec<MeasurePair> = DEPTHS.into_iter().filter_map(measures).collect();
        let is_integer = |samples: &Samples| matches!(samples, Samples::U32(_));
        if depths
            .iter()
            .any(|pair| is_integer(pair.expected) != is_integer(pair.found))
        {
            return Err(Incomparable::Units);
        }
        Ok(Comparison {
            expected: Hits::of(expected).ok_or(Incomparable::NoHits)?,
            found: Hits::of(found).ok_or(Incomparable::NoHits)?,
            numbers: NUMBERS.into_iter().filter_map(numbers).collect(),
            depths,
            surfaces: ChannelName::SURFACE
                .into_iter()
                .filter_map(measures)
                .collect(),
        })
    }

    /// The difference in pixel number `pixel`, counted row by row from the upper left corner.
    pub fn difference(&self, pixel: usize) -> Difference {
        match (self.expected.is_hit(pixel), self.found.is_hit(pixel)) {
            (false, false) => return Difference::None,
            (false, true) => return Difference::FalseHit,
            (true, false) => return Difference::MissedHit,
            (true, true) => {}
        }
        if self.numbers.iter().any(|pair| pair.differs(pixel)) {
            return Difference::WrongPrimitive;
        }
        let largest = |pairs: &[MeasurePair]| {
            pairs
                .iter()
                .map(|pair| pair.error(pixel))
                .max()
                .unwrap_or(0)
        };
        match (largest(&self.depths), largest(&self.surfaces)) {
            (0, 0) => Difference::None,
            (depth, surface) if surface > depth => Difference::Surface(surface),
            (depth, _) => Difference::Depth(depth),
        }
    }

    /// Returns true if the expected image has a hit in this pixel.
    pub fn is_hit(&self, pixel: usize) -> bool {
        self.expected.is_hit(pixel)
    }

    /// Returns true if both images have depths.
    pub fn has_depths(&self) -> bool {
        !self.depths.is_empty()
    }

    /// The compared channels of numbers.
    pub fn numbers(&self) -> &[NumberPair<'a>] {
        &self.numbers
    }

    /// The compared channels of depths, then those of surfaces.
    pub fn measures(&self) -> impl Iterator<Item = &MeasurePair<'a>> {
        self.depths.iter().chain(&self.surfaces)
    }

    /// The compared channels that describe the surface at the hit.
    pub fn surfaces(&self) -> &[MeasurePair<'a>] {
        &self.surfaces
    }
}

/// The channel that distinguishes hits from misses.
#[derive(Debug, Clone, Copy)]
enum Hits<'a> {
    /// Not 0 at a hit.
    Coverage(&'a [f32]),
    /// Not 0 at a hit.
    Numbers(&'a [u32]),
    /// Finite at a hit.
    Depths(&'a [f32]),
}

impl<'a> Hits<'a> {
    fn of(image: &'a Image) -> Option<Hits<'a>> {
        let numbers = || {
            image
                .numbers(ChannelName::Id)
                .or(image.numbers(ChannelName::Prim))
        };
        let depths = || DEPTHS.iter().find_map(|name| image.measures(*name));
        let coverage = image.measures(ChannelName::A).map(Hits::Coverage);
        coverage
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
