//! `f64` numbers with a bound on their error.

use super::{Bracket, UNIT_ROUNDOFF as U};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// A value that differs from the exact number by at most `error`; nothing is known if that is
/// infinite or NaN.
///
/// Every operation adds its own rounding to the errors of its operands (Higham, "Accuracy and
/// Stability of Numerical Algorithms", section 3.3, running error analysis). The bounds are
/// computed in `f64`, too, so each ends in a factor that covers the roundings on the way to it. No
/// test can show that, since it matters only for 2^-53 of a bound that is hardly ever reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approximation {
    value: f64,
    error: f64,
}

/// A bound on the underflow of a product, at most 2^-1075, and of the four products in its bound.
const TINY: f64 = f64::from_bits(1 << 4);

impl Approximation {
    /// The exact number `value`.
    pub fn exactly(value: f64) -> Approximation {
        Approximation { value, error: 0.0 }
    }

    /// A number that differs from `value` by at most `error`.
    pub fn within(value: f64, error: f64) -> Approximation {
        Approximation { value, error }
    }

    /// The value.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// The bound on its error.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// How the number compares with 0, if that is certain.
    pub fn sign(&self) -> Option<Ordering> {
        if self.value > self.error {
            Some(Ordering::Greater)
        } else if self.value < -self.error {
            Some(Ordering::Less)
        } else {
            None
        }
    }

    /// The bracket of the number.
    #[inline]
    pub fn bracket(&self) -> Bracket {
        Bracket::around(self.value, self.error)
    }

    /// The square.
    pub fn square(self) -> Approximation {
        self * self
    }

    /// The larger one of two numbers: it differs from the larger value by at most the larger error.
    pub fn at_least(self, other: Approximation) -> Approximation {
        Approximation {
            value: self.value.max(other.value),
            error: self.error.max(other.error),
        }
    }

    /// The absolute value.
    pub fn abs(self) -> Approximation {
        Approximation {
            value: self.value.abs(),
            ..self
        }
    }

    /// The square root of a number that is known not to be negative, even if its approximation is.
    pub fn square_root(self) -> Approximation {
        if self.value > self.error {
            // |sqrt x - sqrt y| = |x - y| / (sqrt x + sqrt y)
            let root = self.value.sqrt();
            Approximation {
                value: root,
                error: (self.error / root + U * root) * (1.0 + 8.0 * U),
            }
        } else {
            // Both roots lie between 0 and this; the factor covers the roundings.
            let most = (self.value.abs() + self.error).sqrt() * (1.0 + 8.0 * U);
            Approximation {
                value: 0.0,
                error: most,
            }
        }
    }

    /// The quotient.
    pub fn over(self, divisor: Approximation) -> Approximation {
        let value = self.value / divisor.value;
        // x/y - v = ((x - x') - v (y - y')) / y with v = x'/y'
        let least_divisor = divisor.value.abs() - divisor.error;
        if least_divisor.is_nan() || least_divisor <= 0.0 {
            return Approximation {
                value,
                error: f64::INFINITY,
            };
        }
        // The division magnifies the underflow of the product.
        let carried = (self.error + value.abs() * divisor.error + TINY) / least_divisor;
        Approximation {
            value,
            error: (carried + U * value.abs()) * (1.0 + 16.0 * U) + TINY,
        }
    }
}

impl Add for Approximation {
    type Output = Approximation;

    fn add(self, other: Approximation) -> Approximation {
        // Underflow does not round a sum. Three roundings of the bound: (1 - U)^3 (1 + 4 U) > 1.
        let value = self.value + other.value;
        Approximation {
            value,
            error: ((self.error + other.error) + U * value.abs()) * (1.0 + 4.0 * U),
        }
    }
}

impl Sub for Approximation {
    type Output = Approximation;

    fn sub(self, other: Approximation) -> Approximation {
        self + -other
    }
}

impl Neg for Approximation {
    type Output = Approximation;

    fn neg(self) -> Approximation {
        Approximation {
            value: -self.value,
            error: self.error,
        }
    }
}

impl Mul for Approximation {
    type Output = Approximation;

    fn mul(self, other: Approximation) -> Approximation {
        // Five roundings of the bound: (1 - U)^5 (1 + 8 U) > 1.
        let value = self.value * other.value;
        let carried = self.value.abs() * other.error + other.value.abs() * self.error;
        let own = self.error * other.error + U * value.abs();
        Approximation {
            value,
            error: (carried + own) * (1.0 + 8.0 * U) + TINY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Dyadic, times_power_of_two};
    use proptest::prelude::*;

    /// Numbers of all sizes, each a little off from a known one.
    fn pair() -> impl Strategy<Value = (Dyadic, Approximation)> {
        let size = prop::sample::select(vec![-1074, -1070, -600, -30, -2, -1, 0, 1, 2, 30, 500]);
        (-1.0f64..1.0, size, 0u32..3, -1.0f64..1.0).prop_map(|(fraction, exponent, digits, off)| {
            let value = times_power_of_two(fraction, exponent);
            let error = value.abs() * [0.0, 1e-12, 0.3][digits as usize];
            let meant = &Dyadic::from(value) + &Dyadic::from(error * off * 0.999);
            (meant, Approximation { value, error })
        })
    }

    fn holds(approximation: &Approximation, meant: &Dyadic) -> bool {
        if !approximation.error.is_finite() || !approximation.value.is_finite() {
            return true;
        }
        (meant - &Dyadic::from(approximation.value)).abs() <= Dyadic::from(approximation.error)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        #[test]
        fn sums_and_products_stay_within_their_bounds((a, x) in pair(), (b, y) in pair()) {
            prop_assert!(holds(&(x + y), &(&a + &b)));
            prop_assert!(holds(&(x - y), &(&a - &b)));
            prop_assert!(holds(&(x * y), &(&a * &b)));
            prop_assert!(holds(&x.abs(), &a.abs()));
        }

        #[test]
        fn quotients_stay_within_their_bounds((a, x) in pair(), (b, y) in pair()) {
            let quotient = x.over(y);
            if !quotient.error.is_finite() || !quotient.value.is_finite() || b.is_zero() {
                return Ok(());
            }
            // |a/b - v| <= e as |a - v b| <= e |b|
            let off = (&a - &(&Dyadic::from(quotient.value) * &b)).abs();
            prop_assert!(off <= &Dyadic::from(quotient.error) * &b.abs());
        }

        #[test]
        fn square_roots_stay_within_their_bounds((a, x) in pair()) {
            let (a, x) = (a.abs(), x.abs());
            let root = x.square_root();
            prop_assume!(root.error.is_finite());
            let [low, high] = a.square_root(300);
            let error = Dyadic::from(root.error);
            prop_assert!(&high - &Dyadic::from(root.value) <= error && &Dyadic::from(root.value) - &low <= error);
        }

        #[test]
        fn signs_are_right((a, x) in pair()) {
            prop_assert!(x.sign().is_none_or(|sign| sign == a.sign()));
        }
    }

    #[test]
    fn what_is_unknown_has_no_sign() {
        let zero = Approximation::exactly(0.0);
        let overflown = Approximation::exactly(1e300).square();
        for unknown in [
            zero,
            overflown,
            overflown - overflown,
            Approximation::exactly(1.0).over(zero),
        ] {
            assert_eq!(unknown.sign(), None, "{unknown:?}");
        }
        assert_eq!(
            Approximation::exactly(1e-300).square().sign(),
            None,
            "an underflow"
        );
    }
}
