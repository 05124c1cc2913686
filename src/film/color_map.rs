//! Colour maps from near to far.

use crate::named::named;

/// A colour, red, green, blue.
pub(super) type Rgb = [u8; 3];

/// How depths become colours. In every map, near is the bright or warm end, as if the viewer
/// carried the lamp. A high cost has the colour of near.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ColorMap {
    /// A rainbow of even steps: near is red, far is blue and in the end almost black.
    #[default]
    Turbo,
    /// Perceptually uniform, also for colour-blind viewers: near is yellow, far is dark violet.
    Viridis,
    /// Near is white, far is black.
    Gray,
}

/// Entries of a colour table. Neighbours differ by at most 2 of 255 in each component.
pub(super) const TABLE_LENGTH: usize = 4096;

named!(ColorMap: Turbo => "turbo", Viridis => "viridis", Gray => "gray");

impl ColorMap {
    /// The names of the colours at the near and at the far end.
    pub fn ends(self) -> [&'static str; 2] {
        match self {
            ColorMap::Turbo => ["red", "dark violet"],
            ColorMap::Viridis => ["yellow", "dark violet"],
            ColorMap::Gray => ["white", "black"],
        }
    }

    /// A quick function from a position between near (0) and far (1) to its colour, in equal steps.
    pub(super) fn steps(self) -> impl Fn(f64) -> Rgb {
        let table = self.table();
        // Rounds by hand: `round` is a call where the target has no instruction for it.
        move |position| table[(position * (TABLE_LENGTH - 1) as f64 + 0.5) as usize]
    }

    /// The colours from near to far in equal steps.
    pub(super) fn table(self) -> Vec<Rgb> {
        self.stops(TABLE_LENGTH)
    }

    /// `count` colours, at least two, in equal steps from near to far: for a colour bar.
    pub fn stops(self, count: usize) -> Vec<[u8; 3]> {
        let last = (count - 1) as f64;
        (0..count)
            .map(|index| self.color(index as f64 / last))
            .collect()
    }

    /// The colour at `position` between near (0) and far (1).
    fn color(self, position: f64) -> Rgb {
        let nearness = 1.0 - position;
        let gradient = match self {
            ColorMap::Turbo => colorous::TURBO,
            ColorMap::Viridis => colorous::VIRIDIS,
            ColorMap::Gray => return [(255.0 * nearness).round() as u8; 3],
        };
        gradient.eval_continuous(nearness).as_array()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_is_bright_or_warm() {
        let ends = |map: ColorMap| (map.color(0.0), map.color(1.0));
        assert_eq!(ends(ColorMap::Gray), ([255; 3], [0; 3]));
        let (near, far) = ends(ColorMap::Turbo);
        assert!(
            near[0] > 2 * near[2] && far.iter().all(|value| *value < 50),
            "{near:?} {far:?}"
        );
        let blue = ColorMap::Turbo.color(0.9);
        assert!(blue[2] > 2 * blue[0] && blue[2] > blue[1], "{blue:?}");
        let (near, far) = ends(ColorMap::Viridis);
        assert!(
            near[0] > 200 && near[1] > 200 && far[1] < 50,
            "{near:?} {far:?}"
        );
    }

    #[test]
    fn neighbouring_colours_are_close() {
        for map in ColorMap::ALL {
            let table = map.table();
            let steps = table
                .windows(2)
                .flat_map(|pair| (0..3).map(|i| pair[0][i].abs_diff(pair[1][i])));
            assert!(steps.max().unwrap() <= 2, "{map:?}");
        }
    }

    #[test]
    fn no_colour_occurs_at_two_distant_depths() {
        for map in ColorMap::ALL {
            let table = map.table();
            let mut places = std::collections::HashMap::new();
            for (place, color) in table.iter().enumerate() {
                let first = *places.entry(color).or_insert(place);
                assert!(
                    place - first <= TABLE_LENGTH / 50,
                    "{map:?}: {color:?} at {first} and {place}"
                );
            }
        }
    }

    #[test]
    fn the_gray_table_has_every_gray() {
        let table = ColorMap::Gray.table();
        assert_eq!(table.len(), TABLE_LENGTH);
        assert!(
            (0..=255)
                .rev()
                .eq(table.chunk_by(|a, b| a == b).map(|run| run[0][0]))
        );
    }
}
