//! Roots of quadratic equations, compared without taking a square root.

use super::{Bracket, Dyadic};
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// The number `(rational + sign * sqrt(radicand)) / divisor`: the `t` of a ray on a plane or a
/// quadric.
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
    /// If `denominator` is 0.
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

    /// The roots of `a t^2 + 2 b t + c = 0` in order, perhaps equal; `None` if they are not real.
    /// `a` is positive.
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

    /// How `c0 + c1 * self + c2 * self^2` compares with 0.
    pub fn sign_of_quadratic(&self, coefficients: &[Dyadic; 3]) -> Ordering {
        let [rational, factor] = self.value_of(coefficients);
        let sign = times(self.sign, factor.sign());
        sign_with_root(&rational, sign, &factor, &self.radicand)
    }

    /// The quotient of two quadratic polynomials at this number, given by their coefficients from
    /// the constant one up.
    ///
    /// # Panics
    /// If the denominator is 0 there.
    pub fn quotient(&self, numerator: &[Dyadic; 3], denominator: &[Dyadic; 3]) -> Root {
        let signed = |[rational, factor]: [Dyadic; 2]| match self.sign {
            Less => (rational, -&factor),
            Equal => (rational, Dyadic::zero()),
            Greater => (rational, factor),
        };
        // (x + y sqrt q) / (z + w sqrt q)
        let q = &self.radicand;
        let (x, y) = signed(self.value_of(numerator));
        let (z, w) = signed(self.value_of(denominator));
        let norm = &z.square() - &(&w.square() * q);
        if norm.is_zero() {
            // sqrt q = z / w: with the other sign, the denominator would be 0.
            let twice = &(&z * &w) * &Dyadic::from(2.0);
            return Root::ratio(&(&x * &w) + &(&y * &z), twice);
        }
        let rational = &(&x * &z) - &(&(&y * &w) * q);
        let factor = &(&y * &z) - &(&x * &w);
        let is_negative = norm.sign() == Less;
        Root {
            rational: if is_negative { -&rational } else { rational },
            sign: times(norm.sign(), factor.sign()),
            radicand: &factor.square() * q,
            divisor: norm.abs(),
        }
    }

    /// The rational part, and the factor of `sign * sqrt(radicand)`, of a quadratic polynomial at
    /// this number, times the square of the divisor.
    fn value_of(&self, [c0, c1, c2]: &[Dyadic; 3]) -> [Dyadic; 2] {
        let (p, d) = (&self.rational, &self.divisor);
        let mut square = p.square();
        if self.sign != Equal {
            square = &square + &self.radicand;
        }
        let linear = &(c0 * d) + &(c1 * p);
        let rational = &(&linear * d) + &(c2 * &square);
        let factor = &(c1 * d) + &(&(c2 * p) * &Dyadic::from(2.0));
        [rational, factor]
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

    /// The bracket of the number, as narrow as an `f64` or two; not below 0 for a positive number.
    pub fn bracket(&self) -> Bracket {
        let mut bits = 128;
        loop {
            let (low, high) = self.numerator(bits);
            // The two ends agree in 60 bits: their quotients differ by less than a rounding. Fewer
            // bits would also be correct, but leave more to integers. If a square root makes the
            // number 0, the ends meet.
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

    /// Bounds of `rational + sign * sqrt(radicand)`, the root taken to so many bits.
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
    /// The difference times both divisors is `x + s1 y sqrt(q1) - s2 z sqrt(q2)` with positive `y`
    /// and `z`. If its first two terms and the last have opposite signs, their squares decide.
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
mod tests;
