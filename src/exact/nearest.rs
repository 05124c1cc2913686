//! Rounding once: the nearest `f32` to a number that can only be compared.

use super::{Bracket, Dyadic};
use std::cmp::Ordering;

/// The nearest `f32` to a positive number within `bracket`, ties to even; infinite from half a unit
/// above the largest `f32` on.
///
/// `compare` compares the number with a given one. Bisection calls it with points halfway between
/// neighbouring `f32`: once for a narrow bracket, at most 31 times.
pub fn nearest_f32(bracket: &Bracket, compare: impl Fn(&Dyadic) -> Ordering) -> f32 {
    // Positive `f32` are ordered like their bits, up to infinity.
    let mut low = (bracket.low.max(0.0) as f32).to_bits();
    let mut high = (bracket.high as f32).to_bits();
    while low < high {
        let middle = low + (high - low) / 2;
        let rounds_up = match compare(&Dyadic::from(halfway_above(middle))) {
            Ordering::Less => false,
            Ordering::Equal => middle % 2 == 1,
            Ordering::Greater => true,
        };
        if rounds_up {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    f32::from_bits(low)
}

/// Halfway between the finite `f32` of these bits and the next one: exact in `f64`.
fn halfway_above(bits: u32) -> f64 {
    let next = f32::from_bits(bits + 1);
    // The next one, if exponents continued.
    let next = if next.is_finite() {
        f64::from(next)
    } else {
        2f64.powi(128)
    };
    (f64::from(f32::from_bits(bits)) + next) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn nearest(x: f64) -> f32 {
        nearest_f32(&Bracket::POSITIVE, |y| Dyadic::from(x).cmp(y))
    }

    proptest! {
        #[test]
        fn rounds_as_the_processor_does(bits in 0u64..0x7ff0_0000_0000_0000) {
            let x = f64::from_bits(bits);
            prop_assert_eq!(nearest(x), x as f32);
        }

        #[test]
        fn ties_and_their_neighbours_round_as_the_processor_does(bits in 0u32..0x7f80_0000, step in -1i64..2) {
            let x = f64::from_bits((halfway_above(bits).to_bits() as i64 + step) as u64);
            prop_assert_eq!(nearest(x), x as f32);
            prop_assert_eq!(nearest_f32(&Bracket::around(x, 0.0), |y| Dyadic::from(x).cmp(y)), x as f32);
        }
    }

    #[test]
    fn the_ends_of_the_range() {
        assert_eq!(nearest(2f64.powi(-150)), 0.0);
        assert_eq!(nearest(2f64.powi(-150).next_up()), f32::from_bits(1));
        assert_eq!(nearest(halfway_above(f32::MAX.to_bits())), f32::INFINITY);
        assert_eq!(
            nearest(halfway_above(f32::MAX.to_bits()).next_down()),
            f32::MAX
        );
    }
}
