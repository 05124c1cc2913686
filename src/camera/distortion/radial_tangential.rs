//! OpenCV's radial and tangential model (Brown, "Decentering distortion of lenses", 1966).

use super::polynomial::{
    Exactly, LEAST_GROWTH, MAX_COEFFICIENT, MAX_EXACT_STEPS, MAX_STEPS, Number, PAIR_ERROR,
    one_and, reach, slope,
};
use crate::exact::{Dyadic, Pair};

/// A lens that shows what is at x and y in the plane at distance 1, with s = x^2 + y^2, at
///
/// ```text
/// x f(s) + 2 p1 x y + p2 (s + 2 x^2)
/// y f(s) + p1 (s + 2 y^2) + 2 p2 x y
/// f(s) = (1 + k1 s + k2 s^2 + k3 s^3 + k s^4) / (1 + k4 s + k5 s^2 + k6 s^3)
/// ```
///
/// where y points down. OpenCV has no k, and nerfstudio calls it k4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RadialTangential {
    /// k1, k2, k3 and k.
    radial: [f64; 4],
    /// k4, k5 and k6.
    divisor: [f64; 3],
    /// p1 and p2.
    tangential: [f64; 2],
    /// The largest radius: inside, the map is the gradient of a convex function, so that no two
    /// places appear at one.
    reach: f64,
    /// Nothing within the reach appears farther from the principal point than this.
    farthest: f64,
}

/// The square of a step, in parts of the place, whose next one is a rounding.
const LAST_STEP: f64 = 1e-18;

/// The square of a step, in parts of the place, that leads to the solution in any case.
const SHORT_STEP: f64 = 1e-12;

/// The largest radius of any lens: 89.1 degrees from the axis.
const MAX_REACH: f64 = 64.0;

impl RadialTangential {
    /// The lens with the coefficients `radial` (k1, k2, k3 and that of s^4), `divisor` (k4 to k6)
    /// and `tangential` (p1 and p2); `None` if one of them is not a number or above a million.
    pub fn new(
        radial: [f64; 4],
        divisor: [f64; 3],
        tangential: [f64; 2],
    ) -> Option<RadialTangential> {
        let mut lens = RadialTangential {
            radial,
            divisor,
            tangential,
            reach: MAX_REACH,
            farthest: f64::INFINITY,
        };
        let is_sound = lens.coefficients().all(|k| k.abs() <= MAX_COEFFICIENT);
        // Radii are tried by their angles: lenses fold back where they see far to the side.
        let most = MAX_REACH.atan();
        let angle = reach(most, |angle| lens.growth(tangent(angle)));
        lens.reach = tangent(angle).min(MAX_REACH);
        lens.farthest = lens.farthest_seen();
        is_sound.then_some(lens)
    }

    /// Bounds how far from the principal point anything within the reach appears: the radial part
    /// grows with the radius r, and the tangential one is at most 3 |p| r^2.
    fn farthest_seen(&self) -> f64 {
        let s = self.reach * self.reach;
        let [f, _] = self.factor(s);
        let [p1, p2] = self.tangential;
        (f * self.reach + 3.0 * (p1 * p1 + p2 * p2).sqrt() * s) * (1.0 + 1e-9)
    }

    /// All coefficients: k1, k2, k3, that of s^4, k4, k5, k6, p1 and p2.
    pub fn coefficients(&self) -> impl Iterator<Item = f64> {
        let (radial, divisor) = (self.radial, self.divisor);
        radial.into_iter().chain(divisor).chain(self.tangential)
    }

    /// The largest distance from the axis, in the plane at distance 1, that the lens shows.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The factor f and its derivative by s.
    fn factor(&self, s: f64) -> [f64; 2] {
        let (over, under) = (one_and(&self.radial, &s), one_and(&self.divisor, &s));
        let f = over / under;
        let rising = (slope(&self.radial, s) - f * slope(&self.divisor, s)) / under;
        [f, rising]
    }

    /// The smallest factor by which the lens may stretch at the distance `radius` from its axis, in
    /// any direction. The radial part stretches by f and by f + 2 s f'. The tangential part has the
    /// eigenvalues 4 (p1 y + p2 x) + 2 |p| r and 4 (p1 y + p2 x) - 2 |p| r, at least -6 |p| r.
    pub fn growth(&self, radius: f64) -> f64 {
        // A pole ends the lens, as a fold does.
        if one_and(&self.divisor, &(radius * radius)) > 0.0 {
            self.stretch(radius)[0]
        } else {
            f64::NEG_INFINITY
        }
    }

    /// Bounds of the factors by which the lens stretches at the distance `radius` from its axis:
    /// the smallest and the largest.
    pub fn stretch(&self, radius: f64) -> [f64; 2] {
        let s = radius * radius;
        let [f, rising] = self.factor(s);
        let [p1, p2] = self.tangential;
        let sideways = 6.0 * (p1 * p1 + p2 * p2).sqrt() * radius;
        let along = f + 2.0 * s * rising;
        [f.min(along) - sideways, f.max(along) + sideways]
    }

    /// How far `place` appears from `seen`, times the divisor of f.
    fn missing<N: Number>(&self, [x, y]: &[N; 2], seen: [f64; 2]) -> [N; 2] {
        let (xx, yy) = (x.clone() * x.clone(), y.clone() * y.clone());
        let s = xx.clone() + yy.clone();
        let over = one_and(&self.radial, &s);
        let under = one_and(&self.divisor, &s);
        let [mut across, mut down] = seen.map(|place| N::from(-place));
        if self.tangential != [0.0; 2] {
            let [p1, p2] = self.tangential.map(N::from);
            let two = || N::from(2.0);
            let xy = two() * x.clone() * y.clone();
            let (x2, y2) = (s.clone() + two() * xx, s + two() * yy);
            across = p1.clone() * xy.clone() + p2.clone() * x2 + across;
            down = p1 * y2 + p2 * xy + down;
        }
        [
            x.clone() * over.clone() + across * under.clone(),
            y.clone() * over + down * under,
        ]
    }

    /// The step of Newton's method that makes up for `missing` at `place`.
    fn step(&self, [x, y]: [f64; 2], missing: [f64; 2]) -> [f64; 2] {
        let s = x * x + y * y;
        let [f, rising] = self.factor(s);
        let [p1, p2] = self.tangential;
        let a = f + 2.0 * x * x * rising + 2.0 * p1 * y + 6.0 * p2 * x;
        let b = 2.0 * x * y * rising + 2.0 * p1 * x + 2.0 * p2 * y;
        let d = f + 2.0 * y * y * rising + 6.0 * p1 * y + 2.0 * p2 * x;
        let under = one_and(&self.divisor, &s) * (a * d - b * b);
        let [u, v] = missing;
        [(b * v - d * u) / under, (b * u - a * v) / under]
    }

    /// Where `seen` comes from in the plane at distance 1: the nearest `f64`. `None` beyond the
    /// reach.
    pub(super) fn undistorted(&self, seen: [f64; 2]) -> Option<[f64; 2]> {
        if square_length(seen).sqrt() > self.farthest {
            return None;
        }
        let place = self.near(seen)?;
        let found = self
            .quick(place, seen)
            .unwrap_or_else(|| self.settled(place, seen));
        (square_length(found) < self.reach * self.reach).then_some(found)
    }

    /// Where `seen` comes from, up to roundings, by Newton's method. The step shortens what is
    /// missing, as it does for every gradient of a convex function if it is short enough.
    fn near(&self, seen: [f64; 2]) -> Option<[f64; 2]> {
        let most = self.reach * self.reach;
        let size = |place: [f64; 2], missing: [f64; 2]| {
            let under = one_and(&self.divisor, &square_length(place));
            square_length(missing) / (under * under)
        };
        let mut place = [0.0; 2];
        let mut missing = self.missing(&place, seen);
        for _ in 0..MAX_STEPS {
            let step = self.step(place, missing);
            let is_last = square_length(step) <= LAST_STEP * (1.0 + square_length(place));
            let before = size(place, missing);
            let mut shares = (0..40).map(|halvings| 0.5f64.powi(halvings));
            let better = shares.find_map(|share| {
                let next = [0, 1].map(|k| place[k] + share * step[k]);
                let missing = self.missing(&next, seen);
                let is_better = square_length(next) < most && size(next, missing) < before;
                (is_better || is_last).then_some((next, missing))
            });
            let Some(next) = better else {
                // Roundings may hide that a short step is one: exact arithmetic goes on from here.
                let is_short = square_length(step) <= SHORT_STEP * (1.0 + square_length(place));
                return is_short.then_some(place);
            };
            (place, missing) = next;
            if is_last {
                return Some(place);
            }
        }
        None
    }

    /// The nearest numbers, if pairs decide them.
    fn quick(&self, place: [f64; 2], seen: [f64; 2]) -> Option<[f64; 2]> {
        // Newton's last step left an error of roundings: its square is beyond the last bit.
        let missing = self.missing(&place.map(Pair::from), seen);
        let step = self.step(place, missing.map(|rest| rest.high));
        let better = [0, 1].map(|k| Pair::of_sum(place[k], step[k]));
        let size = self.with_absolute_values();
        let at = better.map(|pair| pair.high.abs());
        let terms = size.missing(&at, seen.map(|x| -x.abs()));
        let missing = self.missing(&better, seen);
        let rest = [0, 1].map(|k| missing[k].high.abs() + PAIR_ERROR * terms[k]);
        let error = self.error_of(better.map(|pair| pair.high), rest);
        let nearest = [0, 1].map(|k| match self.is_zero(k, seen) {
            true => Some(0.0),
            false => better[k].nearest(error),
        });
        Some([nearest[0]?, nearest[1]?])
    }

    /// Bounds how far a place is off where no more than this is `missing`, times the divisor. The
    /// map grows by [`growth`](Self::growth) at least; half of it makes up for roundings, and for
    /// its changes within such a distance.
    fn error_of(&self, place: [f64; 2], missing: [f64; 2]) -> f64 {
        let s = square_length(place);
        let under = one_and(&self.divisor, &s);
        square_length(missing).sqrt() / (0.5 * under * self.growth(s.sqrt()).max(LEAST_GROWTH))
    }

    /// Whether a coordinate is 0 because everything is symmetric.
    fn is_zero(&self, axis: usize, seen: [f64; 2]) -> bool {
        let [p1, p2] = self.tangential;
        seen[axis] == 0.0 && [p2, p1][axis] == 0.0
    }

    /// The nearest numbers, from some close to them, by exact arithmetic.
    fn settled(&self, place: [f64; 2], seen: [f64; 2]) -> [f64; 2] {
        let mut exact = place.map(Exactly::from);
        for _ in 0..MAX_EXACT_STEPS {
            let missing = self.missing(&exact, seen).map(|rest| rest.to_f64());
            let at = exact.clone().map(|x| x.to_f64());
            let error = self.error_of(at, missing);
            let ends = |x: &Exactly| {
                let error = Dyadic::from(error);
                [&x.0 - &error, &x.0 + &error].map(|end| end.to_f64())
            };
            let decided = (0..2).all(|k| {
                let [low, high] = ends(&exact[k]);
                low == high || self.is_zero(k, seen)
            });
            if decided {
                break;
            }
            let step = self.step(at, missing);
            exact = [0, 1].map(|k| exact[k].clone() + Exactly::from(step[k]));
        }
        [0, 1].map(|k| match self.is_zero(k, seen) {
            true => 0.0,
            false => exact[k].to_f64(),
        })
    }

    fn with_absolute_values(&self) -> RadialTangential {
        RadialTangential {
            radial: self.radial.map(f64::abs),
            divisor: self.divisor.map(f64::abs),
            tangential: self.tangential.map(f64::abs),
            ..*self
        }
    }
}

/// The tangent of an angle from 0 to below a quarter turn, from sine and cosine, each correctly
/// rounded.
fn tangent(angle: f64) -> f64 {
    let [sine, cosine] = crate::exact::degrees::sine_and_cosine_of_radians(angle);
    sine / cosine
}

fn square_length([x, y]: [f64; 2]) -> f64 {
    x * x + y * y
}

#[cfg(test)]
mod tests;
