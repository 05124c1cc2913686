//! OpenCV's fisheye model (Kannala and Brandt, "A generic camera model and calibration method for
//! conventional, wide-angle, and fish-eye lenses", 2006).

use super::polynomial::{
    Exactly, LEAST_GROWTH, MAX_COEFFICIENT, MAX_STEPS, Number, PAIR_ERROR, one_and, reach, slope,
};
use crate::exact::{Pair, degrees::sine_and_cosine_of_radians};
use std::cmp::Ordering;
use std::f64::consts::PI;

/// A lens that shows what is at the angle theta from its axis at the distance
/// `theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)` from the principal point, in
/// focal lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fisheye {
    /// k1 to k4.
    coefficients: [f64; 4],
    /// The largest angle in radians.
    reach: f64,
}

impl Fisheye {
    /// The lens with these k1 to k4; `None` if one of them is not a number or above a million.
    pub fn new(coefficients: [f64; 4]) -> Option<Fisheye> {
        let is_sound = coefficients.iter().all(|k| k.abs() <= MAX_COEFFICIENT);
        let mut lens = Fisheye {
            coefficients,
            reach: PI,
        };
        lens.reach = reach(PI, |angle| lens.growth(angle));
        is_sound.then_some(lens)
    }

    /// k1 to k4.
    pub fn coefficients(&self) -> [f64; 4] {
        self.coefficients
    }

    /// The largest angle from the axis that the lens shows, in radians: at most half a turn.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The derivative of the distance by the angle.
    pub fn growth(&self, angle: f64) -> f64 {
        let square = angle * angle;
        let factor = one_and(&self.coefficients, &square);
        factor + 2.0 * square * slope(&self.coefficients, square)
    }

    /// The factors by which the lens stretches angles at `angle`: the smallest and the largest, of
    /// those along the radius and around the axis.
    pub fn stretch(&self, angle: f64) -> [f64; 2] {
        let along = self.growth(angle);
        let sine = angle.sin();
        let around = match sine > 0.0 {
            true => self.missing(&angle, 0.0) / sine,
            false => 1.0,
        };
        [along.min(around), along.max(around)]
    }

    /// What is missing at `angle` to the distance.
    fn missing<N: Number>(&self, angle: &N, distance: f64) -> N {
        let factor = one_and(&self.coefficients, &(angle.clone() * angle.clone()));
        angle.clone() * factor - N::from(distance)
    }

    /// The direction of what appears at `seen`, y downwards.
    pub(super) fn direction(&self, [x, y]: [f64; 2]) -> Option<[f64; 3]> {
        let distance = (x * x + y * y).sqrt();
        if distance == 0.0 {
            return Some([0.0, 0.0, 1.0]);
        }
        let angle = self.angle(distance)?;
        let [sine, cosine] = sine_and_cosine_of_radians(angle);
        Some([x / distance * sine, y / distance * sine, cosine])
    }

    /// The `f64` nearest to the angle that appears at `distance`.
    fn angle(&self, distance: f64) -> Option<f64> {
        let angle = self.near(distance)?;
        Some(
            self.quick(angle, distance)
                .unwrap_or_else(|| self.settled(distance)),
        )
    }

    /// The angle, up to roundings, by Newton's method between bounds.
    fn near(&self, distance: f64) -> Option<f64> {
        let (mut low, mut high) = (0.0, self.reach);
        let beyond = self.missing(&high, distance);
        if beyond.is_nan() || beyond <= 0.0 {
            return None;
        }
        let mut angle = distance.min(0.5 * high);
        for _ in 0..MAX_STEPS {
            let missing = self.missing(&angle, distance);
            if missing > 0.0 {
                high = angle;
            } else {
                low = angle;
            }
            let step = angle - missing / self.growth(angle);
            let next = if step > low && step < high {
                step
            } else {
                0.5 * (low + high)
            };
            if (next - angle).abs() <= 4.0 * f64::EPSILON * next {
                return Some(next);
            }
            angle = next;
        }
        Some(angle)
    }

    /// The nearest angle, if pairs decide it.
    fn quick(&self, angle: f64, distance: f64) -> Option<f64> {
        let rest = self.missing(&Pair::from(angle), distance);
        let better = Pair::of_sum(angle, -rest.high / self.growth(angle));
        // The derivative hardly changes between the two, and is at least this.
        let error = self.error(better, distance) / (0.5 * LEAST_GROWTH);
        better.nearest(error)
    }

    /// Bounds what is missing at `angle`.
    fn error(&self, angle: Pair, distance: f64) -> f64 {
        let size = Fisheye {
            coefficients: self.coefficients.map(f64::abs),
            ..*self
        };
        let terms = size.missing(&angle.high, -distance);
        self.missing(&angle, distance).high.abs() + PAIR_ERROR * terms
    }

    /// The nearest angle by exact signs: the distance grows with the angle. Halving all numbers up to
    /// the reach takes no longer for lenses whose roundings hide the solution.
    fn settled(&self, distance: f64) -> f64 {
        let sign = |angle: Exactly| self.missing(&angle, distance).0.sign();
        // The bits of positive numbers are in their order.
        let (mut low, mut high) = (0, self.reach.to_bits());
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            match sign(Exactly::from(f64::from_bits(middle))) {
                Ordering::Greater => high = middle,
                _ => low = middle,
            }
        }
        let [low, high] = [low, high].map(f64::from_bits);
        let middle = (Exactly::from(low) + Exactly::from(high)) * Exactly::from(0.5);
        match sign(middle) {
            Ordering::Less => high,
            _ => low,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn without_coefficients_the_distance_is_the_angle() {
        let lens = Fisheye::new([0.0; 4]).unwrap();
        assert_eq!(lens.reach(), PI);
        for angle in [1e-9, 0.1, 1.0, 3.0] {
            let [sine, cosine] = sine_and_cosine_of_radians(angle);
            assert_eq!(lens.direction([angle, 0.0]), Some([sine, 0.0, cosine]));
        }
        assert_eq!(lens.direction([0.0, 0.0]), Some([0.0, 0.0, 1.0]));
        assert_eq!(lens.direction([3.0, 3.0]), None);
    }

    #[test]
    fn a_lens_ends_where_it_folds_back() {
        let lens = Fisheye::new([-0.1, 0.0, 0.0, 0.0]).unwrap();
        // 1 - 0.3 theta^2 is 1/1024.
        assert!((lens.reach() - ((1.0 - LEAST_GROWTH) / 0.3).sqrt()).abs() < 1e-12);
        let most = lens.missing(&lens.reach(), 0.0);
        assert!(lens.direction([most * 0.999, 0.0]).is_some());
        assert_eq!(lens.direction([most * 1.001, 0.0]), None);
        assert_eq!(Fisheye::new([f64::NAN, 0.0, 0.0, 0.0]), None);
        assert_eq!(Fisheye::new([0.0, 0.0, 0.0, 2e6]), None);
    }

    /// Roundings are larger than what they add up to.
    #[test]
    fn extreme_coefficients_end() {
        for k in [
            [1e6, -1e6, 1e6, -1e6],
            [-1e6, 1e6, -1e6, 1e6],
            [1e6, 1e6, 1e6, -1e-3],
        ] {
            let lens = Fisheye::new(k).unwrap();
            for distance in [1e-300, 1e-9, 1e-3, 0.1, 1.0, 1e3, 1e10, 1e300] {
                if let Some([x, y, z]) = lens.direction([distance, -distance]) {
                    assert!(
                        (x * x + y * y + z * z - 1.0).abs() < 1e-9,
                        "{k:?} {distance}"
                    );
                }
            }
        }
    }

    fn lens() -> impl Strategy<Value = Fisheye> {
        let small = || prop_oneof![Just(0.0), -0.05f64..0.05, -1.0f64..1.0];
        [small(), small(), small(), small()].prop_map(|k| Fisheye::new(k).unwrap())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5_000))]

        #[test]
        fn angles_are_the_nearest(lens in lens(), share in 0.001f64..1.0) {
            let distance = lens.missing(&(lens.reach() * share), 0.0);
            prop_assume!(distance > 0.0);
            if let Some(near) = lens.near(distance) {
                let settled = lens.settled(distance);
                prop_assert!((settled - lens.reach() * share).abs() < 1e-9);
                if let Some(quick) = lens.quick(near, distance) {
                    prop_assert_eq!(quick, settled);
                }
            }
        }
    }
}
