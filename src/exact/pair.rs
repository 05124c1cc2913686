//! Pairs of `f64`: sums of two numbers, with twice the bits of one.

use std::ops::{Add, Mul, Sub};

/// The sum of two `f64`, the second of which is at most half a unit in the last place of the first.
///
/// A sum or product of pairs is off by at most 2^-102 of the sum of the absolute values of its
/// operands, or of the product (Joldes, Muller and Popescu, "Tight and rigorous error bounds for
/// basic building blocks of double-word arithmetic", 2017). No number is near the ends of the
/// range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// The nearest `f64`.
    pub high: f64,
    /// What is missing.
    pub low: f64,
}

impl Pair {
    /// `a + b` without an error (Knuth, "The Art of Computer Programming", volume 2).
    pub fn of_sum(a: f64, b: f64) -> Pair {
        let high = a + b;
        let part = high - a;
        Pair {
            high,
            low: (a - (high - part)) + (b - part),
        }
    }

    /// `a * b` without an error (Dekker, "A floating-point technique for extending the available
    /// precision", 1971).
    pub fn of_product(a: f64, b: f64) -> Pair {
        const SPLIT: f64 = ((1u64 << 27) + 1) as f64;
        let halves = |x: f64| {
            let scaled = SPLIT * x;
            let high = scaled - (scaled - x);
            [high, x - high]
        };
        let ([a0, a1], [b0, b1]) = (halves(a), halves(b));
        let high = a * b;
        Pair {
            high,
            low: ((a0 * b0 - high) + a0 * b1 + a1 * b0) + a1 * b1,
        }
    }

    /// The `f64` nearest to every number that differs from the pair by at most `error`, if they
    /// have one.
    pub fn nearest(self, error: f64) -> Option<f64> {
        // The ends are rounded before they are added: that is covered by the doubled error.
        let error = 2.0 * error;
        let [low, high] = [self.low - error, self.low + error].map(|low| self.high + low);
        (low == high).then_some(low)
    }
}

impl From<f64> for Pair {
    fn from(value: f64) -> Pair {
        Pair {
            high: value,
            low: 0.0,
        }
    }
}

impl Add for Pair {
    type Output = Pair;

    fn add(self, other: Pair) -> Pair {
        let high = Pair::of_sum(self.high, other.high);
        let low = Pair::of_sum(self.low, other.low);
        let sum = Pair::of_sum(high.high, high.low + low.high);
        Pair::of_sum(sum.high, sum.low + low.low)
    }
}

impl Sub for Pair {
    type Output = Pair;

    fn sub(self, other: Pair) -> Pair {
        self + Pair {
            high: -other.high,
            low: -other.low,
        }
    }
}

impl Mul for Pair {
    type Output = Pair;

    fn mul(self, other: Pair) -> Pair {
        let product = Pair::of_product(self.high, other.high);
        let rest = self.high * other.low + self.low * other.high;
        Pair::of_sum(product.high, product.low + rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Dyadic;
    use proptest::prelude::*;

    fn exactly(pair: Pair) -> Dyadic {
        &Dyadic::from(pair.high) + &Dyadic::from(pair.low)
    }

    fn pair() -> impl Strategy<Value = Pair> {
        let number = || prop_oneof![-9i32..9, -900i32..900].prop_map(f64::from);
        prop_oneof![
            (-4.0f64..4.0, -1.0f64..1.0).prop_map(|(a, b)| Pair::of_sum(a, b * 1e-16)),
            (number(), -1.0f64..1.0).prop_map(|(a, b)| Pair::of_sum(a, b * 1e-17)),
            number().prop_map(Pair::from),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn sums_and_products_are_as_precise_as_promised(a in pair(), b in pair()) {
            let (x, y) = (exactly(a), exactly(b));
            let slack = Dyadic::from(2f64.powi(-102));
            let size = &x.clone().abs() + &y.clone().abs();
            let off = |found: Pair, wanted: &Dyadic| (&exactly(found) - wanted).abs();
            prop_assert!(off(a + b, &(&x + &y)) <= &size * &slack);
            prop_assert!(off(a - b, &(&x - &y)) <= &size * &slack);
            let product = &x * &y;
            prop_assert!(off(a * b, &product) <= &product.clone().abs() * &slack);
        }

        #[test]
        fn a_nearest_number_is_that_of_all_within_the_error(a in pair(), bits in 50i32..120) {
            let error = 2f64.powi(-bits);
            if let Some(nearest) = a.nearest(error) {
                let (value, off) = (exactly(a), Dyadic::from(error));
                prop_assert_eq!((&value - &off).to_f64(), nearest);
                prop_assert_eq!((&value + &off).to_f64(), nearest);
            }
        }
    }
}
