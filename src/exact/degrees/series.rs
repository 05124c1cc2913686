//! pi, sine and cosine on integers: bounds with any number of bits.

use num_bigint::BigInt;
use std::sync::LazyLock;

/// The bounds `low` and `high` of a number, in units of `2^-p`.
pub(super) struct Bracket {
    pub(super) low: BigInt,
    pub(super) high: BigInt,
}

/// Sine and cosine of an angle up to 45 degrees, given in radians, in units of `2^-p`. The angle is
/// off by less than 2 units.
pub(super) fn series(radians: &BigInt, p: u64) -> (Bracket, Bracket) {
    let mut sums = [BigInt::ZERO, BigInt::ZERO];
    let mut term = BigInt::from(1) << p;
    let mut count = 0u32;
    while term.bits() > 0 {
        let sum = &mut sums[(count % 2) as usize];
        if count % 4 < 2 {
            *sum += &term;
        } else {
            *sum -= &term;
        }
        count += 1;
        term = ((term * radians) >> p) / count;
    }
    // A term is off by less than 3 more than the one before, scaled by x/k < 1; the terms after the
    // last one add up to less than a unit. So 4 units for every term are ample.
    let slack = BigInt::from(4 * (count + 2));
    let [cosine, sine] = sums.map(|sum| Bracket {
        low: &sum - &slack,
        high: sum + &slack,
    });
    (sine, cosine)
}

/// pi in units of `2^-p`, at most one unit too small or too large.
pub(super) fn pi(p: u64) -> BigInt {
    // Scenes have millions of rotations, hardly any of which needs more bits.
    const KEPT: u64 = 256;
    static PI: LazyLock<BigInt> = LazyLock::new(|| machin(KEPT));
    if p <= KEPT {
        &*PI >> (KEPT - p)
    } else {
        machin(p)
    }
}

/// Computes pi: 16 atan(1/5) - 4 atan(1/239).
fn machin(p: u64) -> BigInt {
    const GUARD: u64 = 32;
    let unit = BigInt::from(1) << (p + GUARD);
    let pi: BigInt = arctangent_of_inverse(5, &unit) * 16 - arctangent_of_inverse(239, &unit) * 4;
    pi >> GUARD
}

/// `atan(1/n)` in units of `1/unit`; off by less than a unit per term.
fn arctangent_of_inverse(n: u32, unit: &BigInt) -> BigInt {
    let mut power = unit / n;
    let mut sum = BigInt::ZERO;
    let mut k = 0u32;
    while power.bits() > 0 {
        let term = &power / (2 * k + 1);
        if k.is_multiple_of(2) {
            sum += term;
        } else {
            sum -= term;
        }
        power /= n * n;
        k += 1;
    }
    sum
}
