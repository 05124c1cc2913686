//! Two pictures, colour by colour, and what can be told of hits from them.

use crate::film::png_reader::Picture;
use crate::film::view::{HIT, MISS, MISS_IN_DEPTH};
use rayon::prelude::*;

/// What is different in a pixel of two pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorDifference {
    /// Nothing.
    None,
    /// The colour of a hit where that of a miss was expected.
    FalseHit,
    /// The other way round.
    MissedHit,
    /// Another colour: the largest difference of a component.
    Color(u16),
}

/// Pixels of pictures, each counted in one place.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ColorTally {
    /// Pixels that were compared.
    pub pixels: u64,
    /// By colour a hit, where a miss was expected.
    pub false_hits: u64,
    /// The other way round.
    pub missed_hits: u64,
    /// Pixels of another colour else.
    pub other_colors: u64,
    /// The largest difference of a component of any pixel, flips too.
    pub largest: u16,
    /// The first pixels that differ.
    pub first: Vec<usize>,
}

impl ColorTally {
    /// Pixels that differ.
    pub fn different(&self) -> u64 {
        self.false_hits + self.missed_hits + self.other_colors
    }
}

/// What the colours of feimos's own pictures tell of hits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hits {
    /// Every pixel has the colour of a hit or a miss in the hit view.
    All,
    /// Some have the colour of a miss in the depth view, which no depth has.
    Misses,
    /// Nothing.
    Unknown,
}

/// The picture expected, and another one of the same size.
#[derive(Debug, Clone)]
pub struct ColorComparison<'a> {
    expected: &'a Picture,
    found: &'a Picture,
    hits: Hits,
    /// What a component of a picture is multiplied by to be compared with one of the other.
    scales: [u16; 2],
}

/// From eight bits to sixteen.
const TO_16_BITS: u16 = u16::MAX / u8::MAX as u16;

impl<'a> ColorComparison<'a> {
    /// `None` where the sizes differ.
    pub fn new(expected: &'a Picture, found: &'a Picture) -> Option<ColorComparison<'a>> {
        let is_same_size = (expected.width, expected.height) == (found.width, found.height);
        let full = expected.full.max(found.full);
        let scale = |picture: &Picture| if picture.full == full { 1 } else { TO_16_BITS };
        let scales = [scale(expected), scale(found)];
        is_same_size.then(|| ColorComparison {
            expected,
            found,
            hits: Hits::of(&[expected, found]),
            scales,
        })
    }

    /// The largest difference that there can be: 255, or 65535 where one of the pictures has 16 bits.
    pub fn full(&self) -> u16 {
        self.expected.full.max(self.found.full)
    }

    /// What the colours tell of hits.
    pub fn hits(&self) -> Hits {
        self.hits
    }

    /// How many pixels there are.
    pub fn pixels(&self) -> usize {
        self.expected.pixels.len()
    }

    /// What is different in pixel number `pixel`, counted from the upper left corner row by row.
    pub fn difference(&self, pixel: usize) -> ColorDifference {
        let size = self.size(pixel);
        if size == 0 {
            return ColorDifference::None;
        }
        let is_hit = |picture: &Picture| match self.hits {
            Hits::All => is_color(picture, pixel, HIT),
            Hits::Misses => !is_color(picture, pixel, MISS_IN_DEPTH),
            Hits::Unknown => true,
        };
        match (is_hit(self.expected), is_hit(self.found)) {
            (false, true) => ColorDifference::FalseHit,
            (true, false) => ColorDifference::MissedHit,
            _ => ColorDifference::Color(size),
        }
    }

    /// The largest difference of a component.
    fn size(&self, pixel: usize) -> u16 {
        let ([a, b], [by_a, by_b]) = (
            [self.expected.pixels[pixel], self.found.pixels[pixel]],
            self.scales,
        );
        (0..4)
            .map(|i| (a[i] * by_a).abs_diff(b[i] * by_b))
            .max()
            .unwrap_or(0)
    }

    /// Counts all pixels, and lists the first `listed` that differ.
    pub fn tally(&self, listed: usize) -> ColorTally {
        let mut tally = ColorTally {
            pixels: self.pixels() as u64,
            ..ColorTally::default()
        };
        for pixel in 0..self.pixels() {
            match self.difference(pixel) {
                ColorDifference::None => continue,
                ColorDifference::FalseHit => tally.false_hits += 1,
                ColorDifference::MissedHit => tally.missed_hits += 1,
                ColorDifference::Color(_) => tally.other_colors += 1,
            }
            tally.largest = tally.largest.max(self.size(pixel));
            if tally.first.len() < listed {
                tally.first.push(pixel);
            }
        }
        tally
    }
}

impl Hits {
    fn of(pictures: &[&Picture; 2]) -> Hits {
        let pixels = |picture: &Picture| (0..picture.pixels.len()).into_par_iter();
        let is_hit_view = |picture: &&Picture| {
            pixels(picture)
                .all(|pixel| is_color(picture, pixel, HIT) || is_color(picture, pixel, MISS))
        };
        let has_misses = |picture: &&Picture| {
            pixels(picture).any(|pixel| is_color(picture, pixel, MISS_IN_DEPTH))
        };
        match () {
            () if pictures.iter().all(is_hit_view) => Hits::All,
            () if pictures.iter().any(has_misses) => Hits::Misses,
            () => Hits::Unknown,
        }
    }
}

/// Whether a pixel has a colour that feimos uses, in a picture of eight bits as it writes them.
fn is_color(picture: &Picture, pixel: usize, [red, green, blue]: [u8; 3]) -> bool {
    let opaque = [red, green, blue, u8::MAX].map(u16::from);
    picture.full == u16::from(u8::MAX) && picture.pixels[pixel] == opaque
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(colors: &[[u8; 3]]) -> Picture {
        let pixels = colors
            .iter()
            .map(|[r, g, b]| [*r, *g, *b, 255].map(u16::from))
            .collect();
        Picture {
            width: colors.len() as u32,
            height: 1,
            pixels,
            full: 255,
        }
    }

    fn differences(expected: &Picture, found: &Picture) -> Vec<ColorDifference> {
        let comparison = ColorComparison::new(expected, found).unwrap();
        (0..comparison.pixels())
            .map(|pixel| comparison.difference(pixel))
            .collect()
    }

    #[test]
    fn hit_views_tell_hits() {
        let (expected, found) = (
            picture(&[HIT, HIT, MISS, MISS]),
            picture(&[HIT, MISS, HIT, MISS]),
        );
        use ColorDifference::{FalseHit, MissedHit, None};
        assert_eq!(
            differences(&expected, &found),
            [None, MissedHit, FalseHit, None]
        );
        let comparison = ColorComparison::new(&expected, &found).unwrap();
        let tally = ColorTally {
            pixels: 4,
            false_hits: 1,
            missed_hits: 1,
            largest: 255,
            first: vec![1],
            other_colors: 0,
        };
        assert_eq!((comparison.tally(1), comparison.hits()), (tally, Hits::All));
    }

    #[test]
    fn depth_views_tell_misses() {
        let depth = [9, 90, 200];
        let expected = picture(&[MISS_IN_DEPTH, MISS_IN_DEPTH, depth, depth, depth]);
        let found = picture(&[MISS_IN_DEPTH, depth, MISS_IN_DEPTH, depth, [9, 93, 195]]);
        use ColorDifference::{Color, FalseHit, MissedHit, None};
        assert_eq!(
            differences(&expected, &found),
            [None, FalseHit, MissedHit, None, Color(5)]
        );
    }

    #[test]
    fn other_pictures_tell_colors() {
        let mut deep = picture(&[[0, 0, 0], [1, 0, 0]]);
        deep.full = u16::MAX;
        deep.pixels = vec![[0, 0, 0, 65535], [258, 0, 0, 65535]];
        let comparison = picture(&[[0, 0, 0], [1, 0, 0]]);
        use ColorDifference::{Color, None};
        assert_eq!(differences(&comparison, &deep), [None, Color(1)]);
        assert_eq!(
            ColorComparison::new(&comparison, &deep).unwrap().full(),
            u16::MAX
        );
        assert!(ColorComparison::new(&comparison, &picture(&[HIT])).is_none());
    }
}
