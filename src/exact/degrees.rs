//! Sine, cosine and tangent of angles in degrees, quarter turns and radians, correctly rounded
//! (rules R2 and R5).
//!
//! The platform's `sin` differs between systems, and degrees times pi/180 is rounded before it
//! starts. Here the angle is reduced exactly, as an integer over a power of two; the function is
//! bracketed on integers; and the precision is doubled until both ends of the bracket round to the
//! same `f64` (Ziv, "Fast evaluation of elementary mathematical functions with correctly rounded
//! last bit", 1991). That ends: by Niven's theorem the only rational values at rational degrees are
//! 0, 1/2 and 1 (0 and 1 for the tangent), which are treated first, and an irrational value is
//! never a tie.

mod quarter_turns;
mod radians;
mod series;

pub use quarter_turns::sine_and_cosine_of_quarter_turns;
pub use radians::sine_and_cosine_of_radians;

use super::Dyadic;
use super::powers::mantissa_and_exponent;
use num_bigint::{BigInt, BigUint};
use series::{Bracket, pi, series};

/// The sine of `angle` degrees; NaN if that is not finite.
pub fn sine(angle: f64) -> f64 {
    reduce(angle).map_or(f64::NAN, |turn| turn.sine())
}

/// The cosine of `angle` degrees; NaN if that is not finite.
pub fn cosine(angle: f64) -> f64 {
    // cos x = sin(90 + x), added after the reduction, where the sum is exact.
    reduce(angle).map_or(f64::NAN, |turn| turn.advanced_by_quarter().sine())
}

/// The tangent of half of `angle` degrees, for angles between 0 and 180.
pub fn tangent_of_half(angle: f64) -> f64 {
    assert!(
        angle > 0.0 && angle < 180.0,
        "{angle} degrees have no finite positive tangent of the half"
    );
    if angle == 90.0 {
        return 1.0;
    }
    let half = reduce(angle).expect("a finite angle").halved();
    let (acute, complemented) = half.acute();
    let ratio = |p: u64| {
        let (sine, cosine) = sine_and_cosine(&acute, p);
        let (over, under) = if complemented {
            (cosine, sine)
        } else {
            (sine, cosine)
        };
        let quotient = |n: &BigInt, d: &BigInt| {
            Dyadic::new(n.clone(), 0).quotient_to_f64(&Dyadic::new(d.clone(), 0))
        };
        (
            quotient(&over.low, &under.high),
            quotient(&over.high, &under.low),
        )
    };
    refine(&acute, ratio)
}

/// An angle of `numerator / 2^scale` degrees, from 0 up to 360.
struct Angle {
    numerator: BigUint,
    scale: u64,
}

/// `angle` modulo 360, and its sign: exact.
fn reduce(angle: f64) -> Option<Angle> {
    if !angle.is_finite() {
        return None;
    }
    // The remainder of two `f64` is exact, and has the sign of the angle.
    let remainder = angle % 360.0;
    let (mantissa, exponent) = mantissa_and_exponent(remainder);
    // Below 360 the exponent of the last bit is at most 9 - 53.
    let scale = u64::from(exponent.unsigned_abs());
    let magnitude = BigUint::from(mantissa);
    let numerator = if remainder < 0.0 {
        (BigUint::from(360u32) << scale) - magnitude
    } else {
        magnitude
    };
    Some(Angle { numerator, scale })
}

impl Angle {
    fn degrees(&self, whole: u32) -> BigUint {
        BigUint::from(whole) << self.scale
    }

    fn advanced_by_quarter(self) -> Angle {
        let numerator = (&self.numerator + self.degrees(90)) % self.degrees(360);
        Angle { numerator, ..self }
    }

    fn halved(self) -> Angle {
        Angle {
            scale: self.scale + 1,
            ..self
        }
    }

    fn sine(self) -> f64 {
        let half_turn = self.degrees(180);
        let negative = self.numerator >= half_turn;
        let folded = Angle {
            numerator: &self.numerator % &half_turn,
            scale: self.scale,
        };
        let magnitude = folded.sine_up_to_180();
        if negative && magnitude != 0.0 {
            -magnitude
        } else {
            magnitude
        }
    }

    fn sine_up_to_180(self) -> f64 {
        let mirrored = self.degrees(180) - &self.numerator;
        let nearer = Angle {
            numerator: mirrored.min(self.numerator),
            scale: self.scale,
        };
        if nearer.numerator == nearer.degrees(0) {
            return 0.0;
        }
        if nearer.numerator == nearer.degrees(30) {
            return 0.5;
        }
        if nearer.numerator == nearer.degrees(90) {
            return 1.0;
        }
        let (acute, complemented) = nearer.acute();
        refine(&acute, |p| {
            let (sine, cosine) = sine_and_cosine(&acute, p);
            let value = if complemented { cosine } else { sine };
            let round = |n: BigInt| Dyadic::new(n, -(p as i64)).to_f64();
            (round(value.low), round(value.high))
        })
    }

    /// An angle up to 90 as one up to 45, and whether it is the complement: then sine and cosine
    /// are exchanged.
    fn acute(self) -> (Angle, bool) {
        let complement = self.degrees(90) - &self.numerator;
        if complement < self.numerator {
            (
                Angle {
                    numerator: complement,
                    ..self
                },
                true,
            )
        } else {
            (self, false)
        }
    }

    /// The number of leading zero bits of the angle behind the binary point.
    fn leading_zeros(&self) -> u64 {
        self.scale.saturating_sub(self.numerator.bits())
    }
}

/// Doubles the precision, in bits behind the binary point, until both ends of the bracket agree.
fn refine(angle: &Angle, bracket: impl Fn(u64) -> (f64, f64)) -> f64 {
    let mut bits = 80;
    loop {
        let (low, high) = bracket(bits + angle.leading_zeros());
        if low == high {
            return low;
        }
        bits *= 2;
    }
}

/// Sine and cosine of an angle up to 45 degrees in units of `2^-p`, by their Taylor series on
/// integers. The angle in radians is off by less than 2 units: pi and one division, each truncated,
/// times less than 1.
fn sine_and_cosine(angle: &Angle, p: u64) -> (Bracket, Bracket) {
    let radians = ((BigInt::from(angle.numerator.clone()) * pi(p)) / 180) >> angle.scale;
    series(&radians, p)
}

#[cfg(test)]
mod tests;
