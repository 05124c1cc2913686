//! Brackets: bounds of a real number.

/// Two `f64` that enclose a real number, or equal it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// The lower bound.
    pub low: f64,
    /// The upper bound.
    pub high: f64,
}

impl Bracket {
    /// All positive numbers.
    pub const POSITIVE: Bracket = Bracket {
        low: 0.0,
        high: f64::INFINITY,
    };

    /// The bracket of the exact number `value`.
    pub fn exactly(value: f64) -> Bracket {
        Bracket {
            low: value,
            high: value,
        }
    }

    /// The bracket of a number that differs from `value` by at most `error`; of NaN, everything.
    pub fn around(value: f64, error: f64) -> Bracket {
        // The sum and the difference are off by at most half a unit in the last place.
        let (low, high) = ((value - error).next_down(), (value + error).next_up());
        if low <= high {
            Bracket { low, high }
        } else {
            Bracket {
                low: f64::NEG_INFINITY,
                high: f64::INFINITY,
            }
        }
    }

    /// Whether this number is certainly less than the other. Brackets that only touch do not count:
    /// that makes no difference, since all whose ends are not the number itself are widened.
    pub fn is_below(&self, other: &Bracket) -> bool {
        self.high < other.low
    }

    /// The nearest `f32` to the number, ties to even, if it is certain: rounding is monotone, so
    /// the ends decide.
    pub fn nearest_f32(&self) -> Option<f32> {
        let (low, high) = (self.low as f32, self.high as f32);
        (low == high).then_some(low)
    }

    /// The product of two numbers that are not negative.
    pub fn times(&self, other: &Bracket) -> Bracket {
        let (low, high) = (self.low * other.low, self.high * other.high);
        // A product of 0 and infinity could be anything.
        if low.is_nan() || high.is_nan() {
            return Bracket::POSITIVE;
        }
        Bracket {
            low: low.next_down().max(0.0),
            high: high.next_up(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Bracket;
    use crate::exact::Dyadic;
    use proptest::prelude::*;

    #[test]
    fn ends_lie_outside() {
        let third = Bracket::around(1.0 / 3.0, 0.0);
        assert!(third.low < 1.0 / 3.0 && third.high > 1.0 / 3.0);
        let anything = Bracket::around(f64::NAN, 1.0);
        assert_eq!(
            (anything.low, anything.high),
            (f64::NEG_INFINITY, f64::INFINITY)
        );
        let product = Bracket::POSITIVE.times(&third);
        assert_eq!((product.low, product.high), (0.0, f64::INFINITY));
    }

    proptest! {
        #[test]
        fn products_lie_between_their_ends(a in 0.0f64..1e-300, b in 0.0f64..1e10, c in 0.0f64..9.0) {
            for (x, y) in [(a, b), (b, c), (c, a)] {
                let product = Bracket::exactly(x).times(&Bracket::exactly(y));
                let meant = &Dyadic::from(x) * &Dyadic::from(y);
                prop_assert!(Dyadic::from(product.low) <= meant && meant <= Dyadic::from(product.high));
            }
        }
    }

    #[test]
    fn an_f32_is_known_where_both_ends_round_alike() {
        assert_eq!(
            Bracket::around(1.0 / 3.0, 1e-15).nearest_f32(),
            Some(1.0 / 3.0)
        );
        let tie = 1.0 + f64::from(f32::EPSILON) / 2.0;
        assert_eq!(Bracket::around(tie, 0.0).nearest_f32(), None);
        assert_eq!(
            Bracket::exactly(tie).nearest_f32(),
            Some(1.0),
            "ties go to even"
        );
        assert_eq!(
            Bracket {
                low: 1e39,
                high: f64::INFINITY
            }
            .nearest_f32(),
            Some(f32::INFINITY)
        );
    }
}
