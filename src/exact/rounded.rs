//! `f64` numbers that track whether they were rounded.

use super::UNIT_ROUNDOFF as U;
use std::ops::{Add, Mul, Neg, Sub};

/// A value, rounded like those behind an image, that differs from the exact number by at most
/// `error`, which is infinite if nothing is known, and never NaN.
///
/// This is the running error analysis of [`Approximation`](super::Approximation), but slow and
/// sharp: an operation without a remainder adds nothing, so exact numbers keep an error of 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounded {
    /// The rounded value.
    pub value: f64,
    /// The largest distance from the exact number.
    pub error: f64,
}

/// A bound on the underflow of an operation and of the products in its bound, 2^-1075 each.
const TINY: f64 = f64::from_bits(1 << 4);

/// The remainder of a larger product is an `f64`: a product of 106 bits ends above 2^-1040.
const HAS_REMAINDER: f64 = 1e-280;

/// `bound`, enlarged for fewer than 8 roundings on the way to it. NaN becomes infinity.
fn made_up(bound: f64) -> f64 {
    if bound.is_nan() {
        f64::INFINITY
    } else {
        bound * (1.0 + 16.0 * U) + TINY
    }
}

impl Rounded {
    /// The exact number `value`; nothing is known of one that is infinite or NaN.
    pub fn exactly(value: f64) -> Rounded {
        Rounded::within(value, 0.0)
    }

    /// A number that differs from `value` by at most `error`.
    pub fn within(value: f64, error: f64) -> Rounded {
        let is_known = value.is_finite() && !error.is_nan();
        Rounded {
            value,
            error: if is_known { error } else { f64::INFINITY },
        }
    }

    /// A number to which `value` is the nearest.
    pub fn nearest(value: f64) -> Rounded {
        Rounded::within(value, made_up(U * value.abs()))
    }

    /// The largest possible absolute value.
    pub fn most(self) -> f64 {
        made_up(self.value.abs() + self.error)
    }

    /// The smallest possible absolute value.
    pub fn least(self) -> f64 {
        (self.value.abs() - made_up(self.error))
            .next_down()
            .max(0.0)
    }

    /// The square root of a number that is not negative.
    pub fn square_root(self) -> Rounded {
        let root = self.value.sqrt();
        let is_exact = root.mul_add(root, -self.value) == 0.0 && self.value >= HAS_REMAINDER;
        if is_exact && self.error == 0.0 {
            return Rounded::exactly(root);
        }
        // |sqrt x - sqrt y| = |x - y| / (sqrt x + sqrt y), and not more than sqrt |x - y|
        let carried = made_up(self.error.sqrt()).min(made_up(self.error / root));
        Rounded::within(root, made_up(carried + U * root))
    }

    /// The quotient.
    pub fn over(self, divisor: Rounded) -> Rounded {
        let value = self.value / divisor.value;
        let is_exact = value.mul_add(divisor.value, -self.value) == 0.0
            && (self.value.abs() >= HAS_REMAINDER || self.value == 0.0);
        if is_exact && self.error == 0.0 && divisor.error == 0.0 {
            return Rounded::exactly(value);
        }
        // x/y - v = ((x - x') - v (y - y')) / y with v = x'/y', up to the rounding of v
        let carried = made_up(self.error + (value.abs() * (1.0 + 4.0 * U) + TINY) * divisor.error)
            / divisor.least();
        Rounded::within(value, made_up(carried + U * value.abs()))
    }
}

impl Add for Rounded {
    type Output = Rounded;

    fn add(self, other: Rounded) -> Rounded {
        let (a, b) = (self.value, other.value);
        let sum = a + b;
        // Knuth's TwoSum: the remainder of a sum, exactly.
        let part = sum - a;
        let remainder = (a - (sum - part)) + (b - part);
        if self.error == 0.0 && other.error == 0.0 && remainder == 0.0 {
            return Rounded::exactly(sum);
        }
        Rounded::within(sum, made_up(self.error + other.error + remainder.abs()))
    }
}

impl Neg for Rounded {
    type Output = Rounded;

    fn neg(self) -> Rounded {
        Rounded {
            value: -self.value,
            error: self.error,
        }
    }
}

impl Sub for Rounded {
    type Output = Rounded;

    fn sub(self, other: Rounded) -> Rounded {
        self + -other
    }
}

impl Mul for Rounded {
    type Output = Rounded;

    fn mul(self, other: Rounded) -> Rounded {
        let (a, b) = (self.value, other.value);
        let product = a * b;
        let is_exact = a.mul_add(b, -product) == 0.0
            && (product.abs() >= HAS_REMAINDER || a == 0.0 || b == 0.0);
        if is_exact && self.error == 0.0 && other.error == 0.0 {
            return Rounded::exactly(product);
        }
        let own = if is_exact { 0.0 } else { U * product.abs() };
        let carried = a.abs() * other.error + b.abs() * self.error + self.error * other.error;
        Rounded::within(product, made_up(carried + own))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Dyadic;
    use proptest::prelude::*;

    /// A number of few or many bits, of usual size or near the ends of the range, and what was
    /// meant.
    fn number() -> impl Strategy<Value = (Rounded, Dyadic)> {
        let value = prop_oneof![
            (-9i32..9).prop_map(f64::from),
            -2.0f64..2.0,
            (-2.0f64..2.0, -1070i32..1000)
                .prop_map(|(x, e)| crate::exact::times_power_of_two(x, e)),
        ];
        let share = prop_oneof![Just(0.0), -1e-9f64..1e-9, -0.9f64..0.9];
        (value, share).prop_map(|(value, share)| {
            let off = value * share;
            (
                Rounded::within(value, off.abs()),
                &Dyadic::from(value) + &Dyadic::from(off),
            )
        })
    }

    /// Whether `meant / divisor` is within the bound.
    fn holds(rounded: Rounded, meant: &Dyadic, divisor: &Dyadic) -> bool {
        if rounded.error == f64::INFINITY {
            return true;
        }
        let off = (&(&Dyadic::from(rounded.value) * divisor) - meant).abs();
        off <= &Dyadic::from(rounded.error) * &divisor.clone().abs()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn bounds_hold((a, x) in number(), (b, y) in number()) {
            let one = Dyadic::from(1.0);
            prop_assert!(holds(a + b, &(&x + &y), &one));
            prop_assert!(holds(a - b, &(&x - &y), &one));
            prop_assert!(holds(a * b, &(&x * &y), &one));
            prop_assert!(y.is_zero() || holds(a.over(b), &x, &y));
            prop_assert!(x.clone().abs() <= Dyadic::from(a.most().min(f64::MAX)) || a.most() == f64::INFINITY);
            prop_assert!(x.clone().abs() >= Dyadic::from(a.least()));
            if a.value >= 0.0 {
                let root = a.square_root();
                let [low, high] = x.square_root(200);
                prop_assert!(holds(root, &low, &one) || holds(root, &high, &one));
            }
        }
    }

    #[test]
    fn what_has_no_remainder_stays_exact() {
        let [a, b, c] = [3.0, 0.25, -7.0].map(Rounded::exactly);
        assert_eq!((a * b + c).over(b), Rounded::exactly(-25.0));
        assert_eq!(Rounded::exactly(2.25).square_root(), Rounded::exactly(1.5));
        assert!(Rounded::exactly(1.0).over(a).error > 0.0);
        assert!(Rounded::exactly(2.0).square_root().error > 0.0);
        assert!(
            (Rounded::exactly(1e16) + a).error == 1.0f64.max((Rounded::exactly(1e16) + a).error)
        );
        let zero = Rounded::exactly(0.0);
        assert_eq!(
            (zero.over(zero).error, c.over(zero).error),
            (f64::INFINITY, f64::INFINITY)
        );
        assert_eq!(
            (Rounded::exactly(f64::INFINITY) * zero).error,
            f64::INFINITY
        );
    }
}
