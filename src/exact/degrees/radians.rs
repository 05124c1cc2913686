//! Sine and cosine of angles in radians, correctly rounded.
//!
//! As for [quarter turns](super::quarter_turns), a table and a short series decide most of them,
//! and integers the rest. No sine of a number other than 0 is a tie: it is transcendental
//! (Lindemann).

use super::quarter_turns::{PARTS, PI, sine_beside};
use super::series::{Bracket, pi, series};
use crate::exact::powers::mantissa_and_exponent;
use crate::exact::{Dyadic, Pair};
use num_bigint::BigInt;

/// The largest angle: more than a whole turn.
const MOST: f64 = 7.0;

/// Bounds the error of an angle that a table's angle is subtracted from: two products and two sums
/// of pairs up to 8.
const REST_ERROR: f64 = 1.0 / (1u128 << 96) as f64;

/// Sine and cosine of `angle` radians, each correctly rounded.
///
/// # Panics
/// The angle is negative, NaN, or above 7.
pub fn sine_and_cosine_of_radians(angle: f64) -> [f64; 2] {
    assert!((0.0..=MOST).contains(&angle), "{angle} radians");
    if angle == 0.0 {
        return [0.0, 1.0];
    }
    let quick = quick_sine_and_cosine(angle);
    [0, 1].map(|k| quick[k].unwrap_or_else(|| exact_sine(angle, k == 1)))
}

/// The parts of the table nearest to `angle`, and the rest in radians.
fn part_and_rest(angle: f64) -> (usize, Pair) {
    const LENGTH: f64 = std::f64::consts::PI / (2 * PARTS) as f64;
    let parts = (angle / LENGTH).round();
    let scale = parts / (2 * PARTS) as f64;
    // The factor has few bits, and a power of two.
    let nearest = Pair::of_product(PI.high, scale) + Pair::from(PI.low * scale);
    (parts as usize, Pair::from(angle) - nearest)
}

/// Both, where the error bound decides how they round.
fn quick_sine_and_cosine(angle: f64) -> [Option<f64>; 2] {
    let (parts, rest) = part_and_rest(angle);
    let (quarters, part) = (parts / PARTS as usize, parts % PARTS as usize);
    let opposite = Pair {
        high: -rest.high,
        low: -rest.low,
    };
    let error = if parts == 0 { 0.0 } else { REST_ERROR };
    let sine = sine_beside(part, rest).nearest_sine(error);
    let cosine = sine_beside(PARTS as usize - part, opposite).nearest_sine(error);
    let negative = |x: Option<f64>| x.map(|x| 0.0 - x);
    match quarters % 4 {
        0 => [sine, cosine],
        1 => [cosine, negative(sine)],
        2 => [negative(sine), negative(cosine)],
        _ => [negative(cosine), sine],
    }
}

/// The sine, or the cosine, by integers, with ever more bits.
fn exact_sine(angle: f64, is_cosine: bool) -> f64 {
    let mut bits = 160;
    loop {
        let [low, high] = exact_ends(angle, is_cosine, bits);
        if low == high {
            return low;
        }
        bits *= 2;
    }
}

/// Bounds of the sine or the cosine of `angle`, which differ by some units of `2^-bits`.
fn exact_ends(angle: f64, is_cosine: bool, bits: u64) -> [f64; 2] {
    let (mantissa, exponent) = mantissa_and_exponent(angle);
    // Small angles have small sines.
    let bits = bits + u64::from((-exponent - 52).max(0).unsigned_abs());
    let shift = i64::from(exponent) + bits as i64;
    // Truncated: off by less than a unit.
    let angle = if shift >= 0 {
        BigInt::from(mantissa) << shift
    } else {
        BigInt::from(mantissa) >> -shift
    };
    let half_pi: BigInt = pi(bits + 8) >> 9;
    let doubled: BigInt = &angle * 2 + &half_pi;
    let quarters: BigInt = doubled / (&half_pi * 2);
    // At most seven quarters: off by less than 8 units more.
    let rest = angle - &quarters * &half_pi;
    let (sine, cosine) = series(&rest, bits);
    let quarter = quarters.iter_u32_digits().next().unwrap_or(0) + u32::from(is_cosine);
    let Bracket { low, high } = if quarter.is_multiple_of(2) {
        sine
    } else {
        cosine
    };
    let slack = BigInt::from(16);
    let ends = [low - &slack, high + slack].map(|end| Dyadic::new(end, -(bits as i64)).to_f64());
    if quarter % 4 < 2 {
        ends
    } else {
        [0.0 - ends[1], 0.0 - ends[0]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::degrees::sine_and_cosine_of_quarter_turns;
    use proptest::prelude::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn known_values_are_right() {
        assert_eq!(sine_and_cosine_of_radians(0.0), [0.0, 1.0]);
        // From the digits of sin 1, cos 1, and of pi beyond an `f64`.
        assert_eq!(
            sine_and_cosine_of_radians(1.0),
            [0.841_470_984_807_896_5, 0.540_302_305_868_139_8]
        );
        let [sine, cosine] = sine_and_cosine_of_radians(std::f64::consts::PI);
        assert_eq!((sine, cosine), (1.224_646_799_147_353_2e-16, -1.0));
        let [sine, cosine] = sine_and_cosine_of_radians(std::f64::consts::FRAC_PI_2);
        assert_eq!((sine, cosine), (1.0, 6.123_233_995_736_766e-17));
    }

    #[test]
    fn tiny_angles_are_their_sines() {
        for angle in [f64::from_bits(1), 1e-300, 1e-160, 1e-20] {
            assert_eq!(sine_and_cosine_of_radians(angle), [angle, 1.0]);
        }
    }

    #[test]
    fn quarter_turns_are_close() {
        for numerator in 0..400 {
            let angle = numerator as f64 / 100.0 * std::f64::consts::FRAC_PI_2;
            let found = sine_and_cosine_of_radians(angle);
            let near = sine_and_cosine_of_quarter_turns(numerator, 100);
            assert!((0..2).all(|k| (found[k] - near[k]).abs() < 1e-15));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn quick_ones_are_those_of_integers(
            angle in prop_oneof![
                0.0f64..MOST, 0.0f64..1e-3,
                (1u32..5, -1e-9f64..1e-9).prop_map(|(k, off)| f64::from(k) * FRAC_PI_2 + off),
            ],
        ) {
            for (k, quick) in quick_sine_and_cosine(angle).into_iter().enumerate() {
                if let Some(quick) = quick {
                    prop_assert_eq!(quick, exact_sine(angle, k == 1));
                }
            }
        }
    }

    #[test]
    fn most_angles_need_no_integers() {
        let angles = (1..4000).map(|k| f64::from(k) / 1000.0);
        let undecided = angles.filter(|angle| quick_sine_and_cosine(*angle).contains(&None));
        assert!(undecided.count() < 80);
    }
}
