//! Colours of depths in a tree.

use colorous::TURBO;
use std::ops::RangeInclusive;

/// A colour: red, green, blue.
pub type Rgb = [u8; 3];

/// The colours of the depths from the first, red, to the last, blue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Palette {
    depths: RangeInclusive<usize>,
}

/// The part of the rainbow that stands out against gray: not its dark ends.
const ENDS: [f64; 2] = [0.88, 0.1];

impl Palette {
    /// Colours for these depths.
    pub fn new(depths: RangeInclusive<usize>) -> Palette {
        Palette { depths }
    }

    /// The colour of a depth. Those beyond an end have the colour of that end.
    pub fn color(&self, depth: usize) -> Rgb {
        let (first, last) = (*self.depths.start(), *self.depths.end());
        let steps = last.saturating_sub(first).max(1);
        let step = depth.saturating_sub(first).min(steps);
        let place = step as f64 / steps as f64;
        TURBO
            .eval_continuous(ENDS[0] + (ENDS[1] - ENDS[0]) * place)
            .as_array()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_go_from_red_to_blue() {
        let palette = Palette::new(2..=6);
        let [r, _, b] = palette.color(2);
        assert!(r > 2 * b, "red");
        let [r, _, b] = palette.color(6);
        assert!(b > 2 * r, "blue");
        let all: Vec<Rgb> = (2..=6).map(|depth| palette.color(depth)).collect();
        assert!((1..5).all(|k| !all[..k].contains(&all[k])), "{all:?}");
        assert_eq!((palette.color(0), palette.color(9)), (all[0], all[4]));
        assert_eq!(Palette::new(3..=3).color(3), all[0]);
    }
}
