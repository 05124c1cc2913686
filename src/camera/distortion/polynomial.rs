//! Polynomials, evaluated in `f64`, in pairs, or exactly.

use crate::exact::{Dyadic, Pair};
use std::ops::{Add, Mul, Sub};

/// Numbers with the operations of polynomials. Formulas are written once, and evaluated with the
/// precision that a decision needs.
pub(super) trait Number:
    Clone + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    fn to_f64(&self) -> f64;
}

impl Number for f64 {
    fn to_f64(&self) -> f64 {
        *self
    }
}

impl Number for Pair {
    fn to_f64(&self) -> f64 {
        self.high
    }
}

/// An exact number. The trait takes numbers by value.
#[derive(Debug, Clone)]
pub(super) struct Exactly(pub(super) Dyadic);

impl From<f64> for Exactly {
    fn from(value: f64) -> Exactly {
        Exactly(Dyadic::from(value))
    }
}

impl Add for Exactly {
    type Output = Exactly;

    fn add(self, other: Exactly) -> Exactly {
        Exactly(&self.0 + &other.0)
    }
}

impl Sub for Exactly {
    type Output = Exactly;

    fn sub(self, other: Exactly) -> Exactly {
        Exactly(&self.0 - &other.0)
    }
}

impl Mul for Exactly {
    type Output = Exactly;

    fn mul(self, other: Exactly) -> Exactly {
        Exactly(&self.0 * &other.0)
    }
}

impl Number for Exactly {
    fn to_f64(&self) -> f64 {
        self.0.to_f64()
    }
}

/// `1 + c0 s + c1 s^2 + ...`
pub(super) fn one_and<N: Number>(coefficients: &[f64], s: &N) -> N {
    let mut terms = coefficients.iter().rev().skip_while(|c| **c == 0.0);
    let Some(last) = terms.next() else {
        return N::from(1.0);
    };
    let last = N::from(*last) * s.clone();
    N::from(1.0) + terms.fold(last, |sum, c| (sum + N::from(*c)) * s.clone())
}

/// The derivative of [`one_and`] by s.
pub(super) fn slope(coefficients: &[f64], s: f64) -> f64 {
    let terms = coefficients.iter().enumerate().rev();
    terms.fold(0.0, |sum, (k, c)| sum * s + (k + 1) as f64 * c)
}

/// The largest radius, up to `most`, below which a lens spreads what it sees: `growth`, the
/// smallest factor by which it stretches at a radius, is [`LEAST_GROWTH`] or more. Radii are tried
/// at 1024 equal steps; the first step that fails is halved until it ends.
pub(super) fn reach(most: f64, growth: impl Fn(f64) -> f64) -> f64 {
    let grows = |r: f64| growth(r) >= LEAST_GROWTH;
    let step = |k: u32| most * (f64::from(k) / 1024.0);
    let Some(failed) = (0..=1024).find(|k| !grows(step(*k))) else {
        return most;
    };
    let (mut inside, mut outside) = (step(failed.saturating_sub(1)), step(failed));
    loop {
        let middle = 0.5 * (inside + outside);
        if middle <= inside || middle >= outside {
            return inside;
        }
        if grows(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
}

/// A lens that stretches less than this is taken to fold back.
pub(super) const LEAST_GROWTH: f64 = 1.0 / 1024.0;

/// The largest coefficient. Those of lenses are below some tens.
pub(super) const MAX_COEFFICIENT: f64 = 1e6;

/// Bounds the error of a formula of at most 32 operations in pairs, in parts of the sum of the
/// absolute values of its terms.
pub(super) const PAIR_ERROR: f64 = 1.0 / (1u128 << 96) as f64;

/// Steps of Newton's method until the last bits settle; many more than it takes.
pub(super) const MAX_STEPS: usize = 100;

/// Exact steps, each of which finds some forty bits more; then a number counts as the middle
/// between two `f64`.
pub(super) const MAX_EXACT_STEPS: usize = 24;
