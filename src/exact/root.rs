//! Roots of quadratic equations, compared without taking a square root.

use super::{Bracket, Dyadic};
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// The number `(rational + sign * sqrt(radicand)) / divisor`: where a ray meets a plane or a sphere.
#[derive(Debug, Clone)]
pub struct Root {
    rational: Dyadic,
    /// Whether the square root is subtracted, absent or added.
    sign: Ordering,
    /// Not negative.
    radicand: Dyadic,
    /// Positive.
    divisor: Dyadic,
}

impl Root {
    /// `numerator / denominator`.
    ///
    /// # Panics
    /// Where `denominator` is 0.
    pub fn ratio(numerator: Dyadic, denominator: Dyadic) -> Root {
        let (rational, divisor) = match denominator.sign() {
            Less => (-&numerator, -&denominator),
            Equal => panic!("a ratio has a denominator that is not 0"),
            Greater => (numerator, denominator),
        };
        Root {
            rational,
            sign: Equal,
            radicand: Dyadic::zero(),
            divisor,
        }
    }

    /// The roots of `a t^2 + 2 b t + c = 0`, the smaller one first; equal where they coincide, `None` where they are not
    /// real. `a` is positive.
    pub fn of_quadratic(a: &Dyadic, b: &Dyadic, c: &Dyadic) -> Option<[Root; 2]> {
        debug_assert!(a.sign() == Greater);
        let radicand = &b.square() - &(a * c);
        if radicand.sign() == Less {
            return None;
        }
        let root = |sign| Root {
            rational: -b,
            sign,
            radicand: radicand.clone(),
            divisor: a.clone(),
        };
        Some([root(Less), root(Greater)])
    }

    /// How the number compares with 0.
    pub fn sign(&self) -> Ordering {
        sign_with_root(
            &self.rational,
            self.sign,
            &Dyadic::from(1.0),
            &self.radicand,
        )
    }

    /// How `alpha + beta * self` compares with 0.
    pub fn sign_of_linear(&self, alpha: &Dyadic, beta: &Dyadic) -> Ordering {
        let rational = &(alpha * &self.divisor) + &(beta * &self.rational);
        sign_with_root(
            &rational,
            times(self.sign, beta.sign()),
            beta,
            &self.radicand,
        )
    }

    /// How the number compares with `x`.
    pub fn compare_with(&self, x: &Dyadic) -> Ordering {
        self.sign_of_linear(&-x, &Dyadic::from(1.0))
    }

    /// How the number times the square root of `square` compares with `x`. All three are positive.
    pub fn times_root_compare_with(&self, square: &Dyadic, x: &Dyadic) -> Ordering {
        // With t = (p + s sqrt q) / a: t^2 square - x^2 has the sign of
        // (p^2 + s^2 q) square - x^2 a^2 + 2 p s square sqrt q.
        let mut rational = self.rational.square();
        if self.sign != Equal {
            rational = &rational + &self.radicand;
        }
        let rational = &(&rational * square) - &(x * &self.divisor).square();
        let factor = &(&self.rational * square) * &Dyadic::from(2.0);
        sign_with_root(
            &rational,
            times(self.sign, factor.sign()),
            &factor,
            &self.radicand,
        )
    }

    /// Where the number lies, as narrowly as an `f64` or two can tell; of a positive number, not below 0.
    pub fn bracket(&self) -> Bracket {
        let mut bits = 128;
        loop {
            let (low, high) = self.numerator(bits);
            // The two ends agree in 60 bits: their quotients differ by less than a rounding. Fewer would be as right, and leave
            // more to be decided by integers. Of a square root that makes the number 0, the ends meet.
            let width = &(&high - &low) * &Dyadic::from((1u64 << 60) as f64);
            if width <= low.clone().abs() {
                let [low, high] = [low, high].map(|end| end.quotient_to_f64(&self.divisor));
                let least = if low >= 0.0 && self.sign() == Greater {
                    0.0
                } else {
                    f64::NEG_INFINITY
                };
                return Bracket {
                    low: low.next_down().max(least),
                    high: high.next_up(),
                };
            }
            bits *= 2;
        }
    }

    /// Two numbers between which `rational + sign * sqrt(radicand)` lies, the root taken to so many bits.
    fn numerator(&self, bits: u64) -> (Dyadic, Dyadic) {
        let [low, high] = match self.sign {
            Equal => return (self.rational.clone(), self.rational.clone()),
            _ => self.radicand.square_root(bits),
        };
        match self.sign {
            Less => (&self.rational - &high, &self.rational - &low),
            _ => (&self.rational + &low, &self.rational + &high),
        }
    }
}

impl PartialEq for Root {
    fn eq(&self, other: &Root) -> bool {
        self.cmp(other) == Equal
    }
}

impl Eq for Root {}

impl PartialOrd for Root {
    fn partial_cmp(&self, other: &Root) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Root {
    /// The difference times both divisors is `x + s1 y sqrt(q1) - s2 z sqrt(q2)` with `y` and `z` positive. Where its
    /// first two terms and the last pull in opposite directions, their squares decide.
    fn cmp(&self, other: &Root) -> Ordering {
        let (y, z) = (&other.divisor, &self.divisor);
        let x = &(&self.rational * y) - &(&other.rational * z);
        let first = sign_with_root(&x, self.sign, y, &self.radicand);
        let last = if other.radicand.is_zero() {
            Equal
        } else {
            other.sign.reverse()
        };
        if last == Equal || first == last {
            return first;
        }
        if first == Equal {
            return last;
        }
        // (x + s1 y sqrt q1)^2 - z^2 q2 = x^2 + s1^2 y^2 q1 - z^2 q2 + 2 x s1 y sqrt q1
        let mut rational = &x.square() - &(&z.square() * &other.radicand);
        if self.sign != Equal {
            rational = &rational + &(&y.square() * &self.radicand);
        }
        let factor = &(&x * y) * &Dyadic::from(2.0);
        times(
            first,
            sign_with_root(
                &rational,
                times(self.sign, factor.sign()),
                &factor,
                &self.radicand,
            ),
        )
    }
}

/// The sign of `x + sign * |factor| * sqrt(radicand)`.
fn sign_with_root(x: &Dyadic, sign: Ordering, factor: &Dyadic, radicand: &Dyadic) -> Ordering {
    let of_root = if radicand.is_zero() || factor.is_zero() {
        Equal
    } else {
        sign
    };
    match (x.sign(), of_root) {
        (of_x, Equal) => of_x,
        (Equal, of_root) => of_root,
        (of_x, of_root) if of_x == of_root => of_x,
        (of_x, _) => times(of_x, x.square().cmp(&(&factor.square() * radicand))),
    }
}

/// The sign of a product.
fn times(a: Ordering, b: Ordering) -> Ordering {
    match a {
        Less => b.reverse(),
        Equal => Equal,
        Greater => b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn dyadic(x: i32) -> Dyadic {
        Dyadic::from(f64::from(x))
    }

    fn roots(a: i32, b: i32, c: i32) -> Vec<Root> {
        Root::of_quadratic(&dyadic(a), &dyadic(b), &dyadic(c)).map_or(Vec::new(), Vec::from)
    }

    fn ratio(n: i32, d: i32) -> Root {
        Root::ratio(dyadic(n), dyadic(d))
    }

    /// The number in `f64`, and a bound on its error.
    fn value(root: &Root) -> (f64, f64) {
        let [p, q, a] = [&root.rational, &root.radicand, &root.divisor].map(Dyadic::to_f64);
        let s = match root.sign {
            Less => -1.0,
            Equal => 0.0,
            Greater => 1.0,
        };
        ((p + s * q.sqrt()) / a, (p.abs() + q.sqrt()) / a * 1e-15)
    }

    /// Numbers with small coefficients, so that equal ones are frequent.
    fn number() -> impl Strategy<Value = Root> {
        let of_quadratic = (1i32..6, -9i32..10, -9i32..10, any::<bool>())
            .prop_filter_map("no real root", |(a, b, c, second)| {
                roots(a, b, c).into_iter().nth(usize::from(second))
            });
        let of_ratio = (-9i32..10, prop::sample::select(vec![-3, -2, -1, 1, 2, 3]))
            .prop_map(|(n, d)| ratio(n, d));
        prop_oneof![of_quadratic, of_ratio]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// Small coefficients keep different numbers apart by more than the error of an `f64`.
        #[test]
        fn comparisons_are_those_of_the_values(a in number(), b in number()) {
            let ((x, x_error), (y, y_error)) = (value(&a), value(&b));
            let apart = (x - y).abs() > x_error + y_error;
            let expected = if apart { x.partial_cmp(&y).unwrap() } else { Equal };
            prop_assert_eq!(a.cmp(&b), expected);
            prop_assert_eq!(b.cmp(&a), expected.reverse());
        }

        #[test]
        fn signs_are_those_of_the_values(t in number(), alpha in -9i32..10, beta in -4i32..5) {
            let (value, error) = value(&t);
            let sum = f64::from(alpha) + f64::from(beta) * value;
            let apart = sum.abs() > 10.0 * (error + 1e-15);
            let expected = if apart { sum.partial_cmp(&0.0).unwrap() } else { Equal };
            prop_assert_eq!(t.sign_of_linear(&dyadic(alpha), &dyadic(beta)), expected);
            prop_assert_eq!(t.compare_with(&dyadic(alpha)), t.sign_of_linear(&dyadic(-alpha), &dyadic(1)));
            prop_assert_eq!(t.sign(), t.compare_with(&Dyadic::zero()));
        }

        #[test]
        fn brackets_hold_the_number_and_little_else(t in number(), square in 1i32..9, x in 1i32..30) {
            let t = if t.sign() == Greater { t } else { ratio(3, 7) };
            let bracket = t.bracket();
            prop_assert!(t.compare_with(&Dyadic::from(bracket.low)) != Less);
            prop_assert!(t.compare_with(&Dyadic::from(bracket.high)) != Greater);
            prop_assert!(bracket.high <= bracket.low.next_up().next_up().next_up().next_up());
            let product = value(&t).0 * f64::from(square).sqrt();
            let apart = (product - f64::from(x)).abs() > 1e-12;
            let expected = if apart { product.partial_cmp(&f64::from(x)).unwrap() } else { Equal };
            prop_assert_eq!(t.times_root_compare_with(&dyadic(square), &dyadic(x)), expected);
        }
    }

    #[test]
    fn touching_is_a_double_root() {
        let both = roots(1, -3, 9);
        assert!(both[0] == both[1] && both[0] == ratio(3, 1));
        assert!(roots(1, -3, 10).is_empty());
    }

    /// sqrt(2 + 2^-200) and sqrt(2): far closer than any float could tell.
    #[test]
    fn numbers_of_nearly_one_value_are_told_apart() {
        let least = Dyadic::from(2f64.powi(-200));
        let root = |c: &Dyadic| Root::of_quadratic(&dyadic(1), &dyadic(0), c).unwrap();
        let (above, two) = (root(&-&(&dyadic(2) + &least)), root(&dyadic(-2)));
        assert!(above[1] > two[1] && above[0] < two[0]);
        assert_eq!(above[1].bracket(), two[1].bracket());
        // 2^100 - sqrt(2^200 - 1): nearly all digits cancel.
        let large = Dyadic::from(2f64.powi(100));
        let small = &Root::of_quadratic(&dyadic(1), &-&large, &dyadic(1)).unwrap()[0];
        let bracket = small.bracket();
        assert!(bracket.low < 2f64.powi(-101) * (1.0 + 1e-15) && bracket.high > 2f64.powi(-101));
        assert!(bracket.high - bracket.low < 1e-15 * bracket.high);
    }

    #[test]
    fn brackets_hold_numbers_that_are_not_positive() {
        // 3 - sqrt(9), and -sqrt(2).
        let zero = roots(1, -3, 0)[0].bracket();
        assert!(zero.low < 0.0 && zero.high > 0.0 && zero.high - zero.low < 1e-300);
        let negative = roots(1, 0, -2)[0].bracket();
        let two = 2f64.sqrt();
        assert!(
            negative.low <= -two && negative.high >= -two && negative.high - negative.low < 1e-15
        );
    }

    #[test]
    fn brackets_reach_beyond_the_range() {
        let (huge, least) = (Dyadic::from(f64::MAX), Dyadic::from(f64::from_bits(1)));
        let above = Root::ratio(huge.square(), dyadic(1)).bracket();
        assert!(above.high == f64::INFINITY && above.low == f64::MAX);
        let below = Root::ratio(least.square(), dyadic(1)).bracket();
        assert_eq!(
            below,
            Bracket {
                low: 0.0,
                high: f64::from_bits(1)
            }
        );
    }
}
