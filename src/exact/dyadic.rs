//! Exact numbers `m * 2^e`: every finite `f64` is one, and so are their sums and products.

use super::integer::Integer;
use super::powers::{mantissa_and_exponent, times_power_of_two};
use num_bigint::{BigInt, BigUint};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// An integer times a power of two.
#[derive(Debug, Clone)]
pub struct Dyadic {
    mantissa: Integer,
    exponent: i64,
}

impl Dyadic {
    /// `mantissa * 2^exponent`.
    pub fn new(mantissa: BigInt, exponent: i64) -> Dyadic {
        Dyadic {
            mantissa: mantissa.into(),
            exponent,
        }
    }

    /// The number 0.
    pub fn zero() -> Dyadic {
        Dyadic {
            mantissa: Integer::Small(0),
            exponent: 0,
        }
    }

    /// How the number compares with 0.
    pub fn sign(&self) -> Ordering {
        self.mantissa.sign()
    }

    /// Whether the number is 0.
    pub fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    /// The absolute value.
    pub fn abs(self) -> Dyadic {
        if self.sign() == Ordering::Less {
            -&self
        } else {
            self
        }
    }

    /// The square.
    pub fn square(&self) -> Dyadic {
        self * self
    }

    /// The `f64` nearest to `self / divisor`, ties to even; infinite beyond the range.
    ///
    /// # Panics
    /// If `divisor` is 0.
    pub fn quotient_to_f64(&self, divisor: &Dyadic) -> f64 {
        let (numerator, denominator) = (self.mantissa.magnitude(), divisor.mantissa.magnitude());
        let magnitude = round_quotient(&numerator, &denominator, self.exponent - divisor.exponent);
        let negative = self.sign() != divisor.sign() && !self.is_zero();
        if negative { -magnitude } else { magnitude }
    }

    /// The nearest `f64`, ties to even; infinite beyond the range.
    pub fn to_f64(&self) -> f64 {
        self.quotient_to_f64(&Dyadic::new(BigInt::from(1), 0))
    }

    /// Bounds of the square root with about `bits` significant bits; equal if the root has no more.
    ///
    /// # Panics
    /// If the number is negative.
    pub fn square_root(&self, bits: u64) -> [Dyadic; 2] {
        assert!(
            self.sign() != Ordering::Less,
            "a square root is of a number that is not negative"
        );
        let radicand = self.mantissa.magnitude();
        let mut shift = (2 * bits).saturating_sub(radicand.bits());
        if (self.exponent - shift as i64) % 2 != 0 {
            // Only an even exponent can be halved.
            shift += 1;
        }
        let scaled = radicand << shift;
        let exponent = (self.exponent - shift as i64) / 2;
        let root = scaled.sqrt();
        let is_exact = &root * &root == scaled;
        let above = if is_exact { root.clone() } else { &root + 1u32 };
        [root, above].map(|root| Dyadic::new(root.into(), exponent))
    }

    /// Applies `operation`, a sum or a difference, to both mantissas for the smaller of the two
    /// exponents.
    fn combine(&self, other: &Dyadic, operation: fn(&Integer, &Integer) -> Integer) -> Dyadic {
        // A zero has no exponent of its own.
        let exponent = match (self.is_zero(), other.is_zero()) {
            (true, _) => other.exponent,
            (_, true) => self.exponent,
            _ => self.exponent.min(other.exponent),
        };
        let shift = |x: &Dyadic| (x.exponent - exponent).max(0) as u64;
        let mantissa = match (shift(self), shift(other)) {
            (0, 0) => operation(&self.mantissa, &other.mantissa),
            (a, 0) => operation(&self.mantissa.shifted(a), &other.mantissa),
            (_, b) => operation(&self.mantissa, &other.mantissa.shifted(b)),
        };
        Dyadic { mantissa, exponent }
    }
}

impl From<f64> for Dyadic {
    /// # Panics
    /// If `value` is not finite.
    fn from(value: f64) -> Dyadic {
        assert!(
            value.is_finite(),
            "{value} is not an integer times a power of two"
        );
        let (mantissa, exponent) = mantissa_and_exponent(value);
        // Short mantissas make short products.
        let zeros = if mantissa == 0 {
            0
        } else {
            mantissa.trailing_zeros()
        };
        let magnitude = i128::from(mantissa >> zeros);
        let signed = if value.is_sign_negative() {
            -magnitude
        } else {
            magnitude
        };
        Dyadic {
            mantissa: Integer::Small(signed),
            exponent: i64::from(exponent) + i64::from(zeros),
        }
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Dyadic) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Dyadic) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Dyadic) -> Ordering {
        (self - other).sign()
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;

    fn add(self, other: &Dyadic) -> Dyadic {
        self.combine(other, |a, b| a + b)
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;

    fn sub(self, other: &Dyadic) -> Dyadic {
        self.combine(other, |a, b| a - b)
    }
}

impl Neg for &Dyadic {
    type Output = Dyadic;

    fn neg(self) -> Dyadic {
        Dyadic {
            mantissa: -&self.mantissa,
            exponent: self.exponent,
        }
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;

    fn mul(self, other: &Dyadic) -> Dyadic {
        Dyadic {
            mantissa: &self.mantissa * &other.mantissa,
            exponent: self.exponent + other.exponent,
        }
    }
}

/// `numerator / denominator * 2^exponent`, rounded once to the nearest `f64`, ties to even.
fn round_quotient(numerator: &BigUint, denominator: &BigUint, exponent: i64) -> f64 {
    if numerator.bits() == 0 {
        return 0.0;
    }
    // The quotient gets at least 65 bits, or as many as lie above the last bit of a subnormal; one
    // more bit records whether anything was truncated, so that the rounding below is the only one.
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
    // The exponent of the last bit of the result.
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
    times_power_of_two(rounded as f64, last as i32)
}

#[cfg(test)]
mod tests;
