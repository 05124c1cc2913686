//! Sine and cosine of rational angles, correctly rounded, in some tens of nanoseconds.
//!
//! The angle is a multiple of a 32nd of a quarter turn and a rest of at most a 64th. The multiple
//! has its sine and cosine in a table, with twice the bits of an `f64`; the rest has a short Taylor
//! series. So the result is known to 2^-62 of itself. If that does not decide how it rounds, which
//! happens for one angle in some hundreds, integers do (Ziv, "Fast evaluation of elementary
//! mathematical functions with correctly rounded last bit", 1991).

use super::{Bracket, pi, series};
use crate::exact::Dyadic;
use num_bigint::BigInt;
use std::sync::LazyLock;

/// The parts of a quarter turn in the table.
const PARTS: u64 = 32;

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

/// A sum of two `f64`, the second of which is at most half a unit in the last place of the first.
type Pair = [f64; 2];

/// The sine of each part of a quarter turn.
static SINES: LazyLock<[Pair; PARTS as usize + 1]> = LazyLock::new(|| {
    std::array::from_fn(|part| {
        let [low, high] = exact_ends(part as u64, PARTS, 160);
        let middle = &(&low + &high) * &Dyadic::from(0.5);
        let first = exact_sine(part as u64, PARTS);
        [first, (&middle - &Dyadic::from(first)).to_f64()]
    })
});

/// The sine, if the error bound decides how it rounds.
fn quick_sine(numerator: u64, denominator: u64) -> Option<f64> {
    let part = (2 * PARTS * numerator + denominator) / (2 * denominator);
    let rest = (PARTS * numerator) as i64 - (part * denominator) as i64;
    let sine = SINES[part as usize];
    let cosine = SINES[(PARTS - part) as usize];
    let angle = angle_of_rest(rest as f64, denominator as f64);
    // sin r - r, and cos r - 1.
    let square = product(angle[0], angle[0]);
    let z = square[0];
    let cubic = z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5040.0 + z / 362_880.0)));
    let small_sine = angle[1] * (1.0 - 0.5 * z) + angle[0] * cubic;
    let quartic = z * z * (1.0 / 24.0 + z * (-1.0 / 720.0 + z / 40_320.0));
    let small_cosine = quartic - (0.5 * square[1] + angle[0] * angle[1]);
    // sin(a + r) = sin a + cos a sin r + sin a (cos r - 1)
    let along = product(cosine[0], angle[0]);
    let across = product(sine[0], -0.5 * z);
    let first = sum(sine[0], along[0]);
    let second = sum(first[0], across[0]);
    let small = ((sine[1] + cosine[1] * angle[0]) + (along[1] + across[1]))
        + (first[1] + second[1])
        + (cosine[0] * small_sine + sine[0] * small_cosine);
    let error = QUICK_ERROR * second[0].abs();
    let [low, high] = [small - error, small + error].map(|small| second[0] + small);
    (low == high).then_some(low)
}

/// The angle of `rest / (32 * denominator)` quarter turns in radians.
fn angle_of_rest(rest: f64, denominator: f64) -> Pair {
    const SCALE: f64 = 1.0 / (2 * PARTS) as f64;
    const PI: Pair = [
        std::f64::consts::PI * SCALE,
        1.224_646_799_147_353_2e-16 * SCALE,
    ];
    let quotient = rest / denominator;
    let back = product(quotient, denominator);
    let remainder = ((rest - back[0]) - back[1]) / denominator;
    let angle = product(quotient, PI[0]);
    let small = angle[1] + (quotient * PI[1] + remainder * PI[0]);
    sum(angle[0], small)
}

/// A sum without an error (Knuth, "The Art of Computer Programming", volume 2).
fn sum(a: f64, b: f64) -> Pair {
    let sum = a + b;
    let part = sum - a;
    [sum, (a - (sum - part)) + (b - part)]
}

/// A product without an error (Dekker, "A floating-point technique for extending the available
/// precision", 1971). No factor is near the ends of the range.
fn product(a: f64, b: f64) -> Pair {
    const SPLIT: f64 = ((1u64 << 27) + 1) as f64;
    let halves = |x: f64| {
        let scaled = SPLIT * x;
        let high = scaled - (scaled - x);
        [high, x - high]
    };
    let ([a0, a1], [b0, b1]) = (halves(a), halves(b));
    let product = a * b;
    [product, ((a0 * b0 - product) + a0 * b1 + a1 * b0) + a1 * b1]
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
