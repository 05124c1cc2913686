//! Numbers `m * 2^e`: every finite `f64` is one, and sums and products of them are exact.

use super::powers::{mantissa_and_exponent, power_of_two};
use num_bigint::{BigInt, BigUint, Sign};
use std::ops::{Add, Mul, Neg, Sub};

/// An integer times a power of two.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dyadic {
    mantissa: BigInt,
    exponent: i64,
}

impl Dyadic {
    /// `mantissa * 2^exponent`.
    pub fn new(mantissa: BigInt, exponent: i64) -> Dyadic {
        Dyadic { mantissa, exponent }
    }

    /// Whether the number is 0.
    pub fn is_zero(&self) -> bool {
        self.mantissa.sign() == Sign::NoSign
    }

    /// The `f64` nearest to `self / divisor`, ties to even; infinite beyond the range.
    ///
    /// # Panics
    /// Where `divisor` is 0.
    pub fn quotient_to_f64(&self, divisor: &Dyadic) -> f64 {
        let magnitude =
            round_quotient(self.mantissa.magnitude(), divisor.mantissa.magnitude(), self.exponent - divisor.exponent);
        let negative = self.mantissa.sign() != divisor.mantissa.sign() && !self.is_zero();
        if negative { -magnitude } else { magnitude }
    }

    /// The nearest `f64`, ties to even; infinite beyond the range.
    pub fn to_f64(&self) -> f64 {
        self.quotient_to_f64(&Dyadic::new(BigInt::from(1), 0))
    }

    /// Both mantissas for the smaller of the two exponents.
    fn aligned(&self, other: &Dyadic) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        let shift = |x: &Dyadic| &x.mantissa << (x.exponent - exponent) as u64;
        (shift(self), shift(other), exponent)
    }
}

impl From<f64> for Dyadic {
    /// # Panics
    /// Where `value` is not finite.
    fn from(value: f64) -> Dyadic {
        assert!(value.is_finite(), "{value} is not an integer times a power of two");
        let (mantissa, exponent) = mantissa_and_exponent(value);
        let sign = if value.is_sign_negative() { Sign::Minus } else { Sign::Plus };
        Dyadic { mantissa: BigInt::from_biguint(sign, BigUint::from(mantissa)), exponent: exponent.into() }
    }
}

impl Add for Dyadic {
    type Output = Dyadic;

    fn add(self, other: Dyadic) -> Dyadic {
        let (a, b, exponent) = self.aligned(&other);
        Dyadic { mantissa: a + b, exponent }
    }
}

impl Sub for Dyadic {
    type Output = Dyadic;

    fn sub(self, other: Dyadic) -> Dyadic {
        self + -other
    }
}

impl Neg for Dyadic {
    type Output = Dyadic;

    fn neg(self) -> Dyadic {
        Dyadic { mantissa: -self.mantissa, exponent: self.exponent }
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;

    fn mul(self, other: &Dyadic) -> Dyadic {
        Dyadic { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }
}

/// `numerator / denominator * 2^exponent` rounded once to the nearest `f64`, ties to even.
fn round_quotient(numerator: &BigUint, denominator: &BigUint, exponent: i64) -> f64 {
    if numerator.bits() == 0 {
        return 0.0;
    }
    // The quotient gets at least 65 bits, or as many as lie above the last bit of a subnormal; one more bit
    // behind them says whether anything was cut off, so that the rounding below is the only one.
    let shift = 66 + denominator.bits() as i64 - numerator.bits() as i64;
    let (n, d) = if shift >= 0 {
        (numerator << shift as u64, denominator.clone())
    } else {
        (numerator.clone(), denominator << (-shift) as u64)
    };
    let quotient = &n / &d;
    let inexact = &quotient * &d != n;
    let significand = (quotient << 1u32) | BigUint::from(u8::from(inexact));
    let significand: u128 = significand.try_into().expect("68 bits fit in 128");
    scale_and_round(significand, exponent - shift - 1)
}

/// `significand * 2^exponent`, rounded once. The significand has more bits than an `f64`.
fn scale_and_round(significand: u128, exponent: i64) -> f64 {
    let bits = i64::from(128 - significand.leading_zeros());
    // The exponent of the last bit that the result can hold.
    let last = (exponent + bits - 53).max(-1074);
    let cut = last - exponent;
    if cut > 127 {
        return 0.0;
    }
    let kept = significand >> cut;
    let rest = significand & ((1u128 << cut) - 1);
    let half = 1u128 << (cut - 1);
    let rounded = kept + u128::from(rest > half || (rest == half && kept & 1 == 1));
    if last + i64::from(128 - rounded.leading_zeros()) > 1024 {
        return f64::INFINITY;
    }
    // Exact in two steps: a factor of 2^-1074 alone would not be a normal number.
    let half_exponent = last as i32 / 2;
    rounded as f64 * power_of_two(half_exponent) * power_of_two(last as i32 - half_exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_finite_number_comes_back(bits: u64) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            prop_assert_eq!(Dyadic::from(value).to_f64(), value);
        }

        #[test]
        fn one_operation_rounds_as_the_processor_does(a: f64, b: f64) {
            prop_assume!(a.is_finite() && b.is_finite());
            let (x, y) = (Dyadic::from(a), Dyadic::from(b));
            prop_assert_eq!((&x * &y).to_f64(), a * b);
            prop_assert_eq!((x.clone() + y.clone()).to_f64(), a + b);
            prop_assert_eq!((x.clone() - y.clone()).to_f64(), a - b);
            if b != 0.0 {
                prop_assert_eq!(x.quotient_to_f64(&y), a / b);
            }
        }

        #[test]
        fn subnormal_quotients_round_once(a in 1u64..1 << 53, b in 1u64..1 << 53, e in 40i32..110) {
            let (a, b) = (a as f64, b as f64 * 2f64.powi(e));
            let small = a * 2f64.powi(-1000);
            prop_assert_eq!(Dyadic::from(small).quotient_to_f64(&Dyadic::from(b)), small / b);
        }
    }

    #[test]
    fn ends_of_the_range() {
        let huge = Dyadic::from(f64::MAX);
        assert_eq!((&huge * &Dyadic::from(2.0)).to_f64(), f64::INFINITY);
        let least = Dyadic::from(f64::from_bits(1));
        assert_eq!((&least * &Dyadic::from(0.5)).to_f64(), 0.0, "a tie goes to even");
        assert_eq!((&least * &Dyadic::from(0.75)).to_f64(), f64::from_bits(1));
        assert_eq!((&least * &least).to_f64(), 0.0);
    }
}
