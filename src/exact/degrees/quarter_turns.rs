//! Sine and cosine of rational angles, correctly rounded, in some tens of nanoseconds.
//!
//! The angle is a multiple of a 32nd of a quarter turn and a rest of at most a 64th. The multiple
//! has its sine and cosine in a table, with twice the bits of an `f64`; the rest has a short Taylor
//! series. So the result is known to 2^-62 of itself. If that does not decide how it rounds, which
//! happens for one angle in some hundreds, integers do (Ziv, "Fast evaluation of elementary
//! mathematical functions with correctly rounded last bit", 1991).

use super::series::{Bracket, pi, series};
use crate::exact::Dyadic;
use crate::exact::pair::Pair;
use num_bigint::BigInt;
use std::sync::LazyLock;

/// The parts of a quarter turn in the table.
pub(super) const PARTS: u64 = 32;

/// pi, off by less than 2^-109.
pub(super) const PI: Pair = Pair {
    high: std::f64::consts::PI,
    low: 1.224_646_799_147_353_2e-16,
};

/// Bounds the relative error of a quick result. The cubic term of the series is less than 2^-13 of
/// the sine of the rest, and takes less than four roundings of 2^-53; the sums of small terms take
/// less together.
const QUICK_ERROR: f64 = 1.0 / (1u64 << 62) as f64;

/// The denominators are below this: integers, and twice these integers, are exact in `f64`.
const MOST: u64 = 1 << 52;

/// Sine and cosine of `numerator / denominator` quarter turns, each correctly rounded. Zeros are
/// positive.
///
/// # Panics
/// The denominator is 0 or above 2^52.
pub fn sine_and_cosine_of_quarter_turns(numerator: u64, denominator: u64) -> [f64; 2] {
    assert!((1..=MOST).contains(&denominator), "{denominator} parts");
    let rest = numerator % denominator;
    let sine = sine_of_part(rest, denominator);
    let cosine = sine_of_part(denominator - rest, denominator);
    match numerator / denominator % 4 {
        0 => [sine, cosine],
        1 => [cosine, 0.0 - sine],
        2 => [0.0 - sine, 0.0 - cosine],
        _ => [0.0 - cosine, sine],
    }
}

/// The sine of `numerator / denominator` quarter turns, from none to one.
fn sine_of_part(numerator: u64, denominator: u64) -> f64 {
    quick_sine(numerator, denominator).unwrap_or_else(|| exact_sine(numerator, denominator))
}

/// The sine of each part of a quarter turn.
static SINES: LazyLock<[Pair; PARTS as usize + 1]> = LazyLock::new(|| {
    std::array::from_fn(|part| {
        let [low, high] = exact_ends(part as u64, PARTS, 160);
        let middle = &(&low + &high) * &Dyadic::from(0.5);
        let first = exact_sine(part as u64, PARTS);
        let low = (&middle - &Dyadic::from(first)).to_f64();
        Pair { high: first, low }
    })
});

/// The sine, if the error bound decides how it rounds.
fn quick_sine(numerator: u64, denominator: u64) -> Option<f64> {
    let part = (2 * PARTS * numerator + denominator) / (2 * denominator);
    let rest = (PARTS * numerator) as i64 - (part * denominator) as i64;
    let angle = angle_of_rest(rest as f64, denominator as f64);
    sine_beside(part as usize, angle).nearest_sine(0.0)
}

/// The sine of a 32nd of a quarter turn times `part`, plus `angle`: radians, at most a 64th of a
/// quarter turn.
pub(super) fn sine_beside(part: usize, angle: Pair) -> QuickSine {
    let (sine, cosine) = (SINES[part], SINES[PARTS as usize - part]);
    // sin r - r, and cos r - 1.
    let square = Pair::of_product(angle.high, angle.high);
    let z = square.high;
    let cubic = z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5040.0 + z / 362_880.0)));
    let small_sine = angle.low * (1.0 - 0.5 * z) + angle.high * cubic;
    let quartic = z * z * (1.0 / 24.0 + z * (-1.0 / 720.0 + z / 40_320.0));
    let small_cosine = quartic - (0.5 * square.low + angle.high * angle.low);
    // sin(a + r) = sin a + cos a sin r + sin a (cos r - 1)
    let along = Pair::of_product(cosine.high, angle.high);
    let across = Pair::of_product(sine.high, -0.5 * z);
    let first = Pair::of_sum(sine.high, along.high);
    let second = Pair::of_sum(first.high, across.high);
    let small = ((sine.low + cosine.low * angle.high) + (along.low + across.low))
        + (first.low + second.low)
        + (cosine.high * small_sine + sine.high * small_cosine);
    QuickSine {
        large: second.high,
        small,
    }
}

/// A sine as a sum, off by at most [`QUICK_ERROR`] of itself.
pub(super) struct QuickSine {
    large: f64,
    small: f64,
}

impl QuickSine {
    /// The nearest `f64`, if the error bound decides it. `more` is the error of the angle.
    pub(super) fn nearest_sine(&self, more: f64) -> Option<f64> {
        let error = QUICK_ERROR * self.large.abs() + more;
        let [low, high] = [self.small - error, self.small + error].map(|small| self.large + small);
        (low == high).then_some(low)
    }
}

/// The angle of `rest / (32 * denominator)` quarter turns in radians.
fn angle_of_rest(rest: f64, denominator: f64) -> Pair {
    const SCALE: f64 = 1.0 / (2 * PARTS) as f64;
    let quotient = rest / denominator;
    let back = Pair::of_product(quotient, denominator);
    let remainder = ((rest - back.high) - back.low) / denominator;
    let angle = Pair::of_product(quotient, PI.high * SCALE);
    let small = angle.low + (quotient * (PI.low * SCALE) + remainder * (PI.high * SCALE));
    Pair::of_sum(angle.high, small)
}

/// The sine by integers, with ever more bits.
fn exact_sine(numerator: u64, denominator: u64) -> f64 {
    // By Niven's theorem these are the only rational values, which no bracket would decide.
    if numerator == 0 {
        return 0.0;
    }
    if numerator == denominator {
        return 1.0;
    }
    if 3 * numerator == denominator {
        return 0.5;
    }
    let mut bits = 128;
    loop {
        let [low, high] = exact_ends(numerator, denominator, bits).map(|end| end.to_f64());
        if low == high {
            return low;
        }
        bits *= 2;
    }
}

/// Bounds of the sine of `numerator / denominator` quarter turns, which differ by some units of
/// `2^-bits`.
fn exact_ends(numerator: u64, denominator: u64, bits: u64) -> [Dyadic; 2] {
    let is_steep = 2 * numerator <= denominator;
    let nearer = numerator.min(denominator - numerator);
    let bits = bits + u64::from(denominator.ilog2());
    // pi / 2 times a part of at most a half, divided once: off by less than 2 units.
    let radians = BigInt::from(nearer) * pi(bits) / (2 * denominator);
    let (sine, cosine) = series(&radians, bits);
    let Bracket { low, high } = if is_steep { sine } else { cosine };
    [low, high].map(|end| Dyadic::new(end, -(bits as i64)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::degrees;
    use proptest::prelude::*;

    #[test]
    fn rational_values_are_exact() {
        for d in [1, 3, 6, 90, 360, MOST / 3 * 3] {
            assert_eq!(sine_and_cosine_of_quarter_turns(0, d), [0.0, 1.0]);
            assert_eq!(sine_and_cosine_of_quarter_turns(d, d), [1.0, 0.0]);
            assert_eq!(sine_and_cosine_of_quarter_turns(2 * d, d), [0.0, -1.0]);
            assert_eq!(sine_and_cosine_of_quarter_turns(3 * d, d), [-1.0, 0.0]);
            if d % 3 == 0 {
                let [sine, cosine] = sine_and_cosine_of_quarter_turns(d / 3, d);
                assert_eq!((sine, cosine), (0.5, degrees::cosine(30.0)));
                assert_eq!(sine_and_cosine_of_quarter_turns(2 * d / 3, d)[1], 0.5);
            }
        }
    }

    #[test]
    fn whole_degrees_are_those_of_rotations() {
        for angle in 0..720u32 {
            let found = sine_and_cosine_of_quarter_turns(angle.into(), 90);
            let angle = f64::from(angle);
            assert_eq!(
                found,
                [degrees::sine(angle), degrees::cosine(angle)],
                "{angle}"
            );
        }
    }

    #[test]
    fn most_angles_need_no_integers() {
        let undecided = (0..4000).filter(|k| quick_sine(*k, 3999 + k % 2).is_none());
        assert!(undecided.count() < 80);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn quick_sines_are_those_of_integers(
            (numerator, denominator) in prop_oneof![1u64..400, 1u64..70_000, 1..=MOST]
                .prop_flat_map(|d| (prop_oneof![0..=d, 0..=d.min(9)], Just(d))),
        ) {
            if let Some(quick) = quick_sine(numerator, denominator) {
                prop_assert_eq!(quick, exact_sine(numerator, denominator));
            }
        }
    }
}
