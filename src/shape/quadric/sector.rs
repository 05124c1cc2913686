//! The sector of a turn about the z axis that `phimax` leaves.

use crate::exact::degrees;

/// Angles about the z axis from 0, the direction of x, to less than 360 degrees, both ends
/// included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sector {
    /// The last angle, in degrees.
    pub degrees: f64,
    /// Its sine, correctly rounded.
    pub sine: f64,
    /// Its cosine, correctly rounded.
    pub cosine: f64,
}

impl Sector {
    /// Angles from 0 to `phi_max` degrees, clamped to a full turn as in pbrt-v3; `None` for a full
    /// turn.
    pub fn new(phi_max: f64) -> Option<Sector> {
        let degrees = phi_max.clamp(0.0, 360.0);
        let (sine, cosine) = (degrees::sine, degrees::cosine);
        (degrees < 360.0).then(|| Sector {
            degrees,
            sine: sine(degrees),
            cosine: cosine(degrees),
        })
    }

    /// Whether a point is in the sector, as far as that is known; `beyond` says whether its `normal
    /// . q` reaches an offset.
    ///
    /// With p the angle of the point and m that of the end, `x sin m - y cos m` is `sin(m - p)`
    /// times the distance from the axis. So in the half of the turn that the end lies in, it is
    /// negative just beyond the end. On the axis the angle is 0, as in pbrt.
    pub(super) fn holds(&self, beyond: impl Fn([f64; 3], f64) -> Option<bool>) -> Option<bool> {
        let first_half = beyond([0.0, 1.0, 0.0], 0.0);
        let before_end = beyond([self.sine, -self.cosine, 0.0], 0.0);
        if self.sine < 0.0 {
            return either(first_half, before_end);
        }
        // At 180 degrees both conditions are y >= 0.
        let within = both(first_half, before_end);
        // If the sine is 0, `x sin m - y cos m` is -y: also 0 at an angle of 180 degrees.
        if self.is_narrow() {
            both(within, beyond([1.0, 0.0, 0.0], 0.0))
        } else {
            within
        }
    }

    /// Whether the sine of the end is 0 for some test of the surface, in `f64` or `f32`, though the
    /// end is not at 180 degrees. The numbers in the test decide, not the degrees: the sine of
    /// 1e-322 degrees rounds to 0.
    fn is_narrow(&self) -> bool {
        self.cosine > 0.0 && self.sine as f32 == 0.0
    }
}

/// Whether both hold, as far as that is known.
pub(super) fn both(a: Option<bool>, b: Option<bool>) -> Option<bool> {
    match (a, b) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    }
}

/// Whether one of them holds, as far as that is known.
fn either(a: Option<bool>, b: Option<bool>) -> Option<bool> {
    both(a.map(|a| !a), b.map(|b| !b)).map(|neither| !neither)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(sector: &Sector, x: f64, y: f64) -> bool {
        sector
            .holds(|normal, offset| Some(normal[0] * x + normal[1] * y >= offset))
            .unwrap()
    }

    /// Points whose angles are known without a sine: those of the axes and the diagonals, and some
    /// that are next to the axes.
    #[test]
    fn points_of_known_angles_are_there_up_to_the_end() {
        let tiny = 1e-310;
        let near = |side: f64| side.to_radians().recip() * tiny;
        let points = [
            ([1.0, 0.0], 0.0),
            ([1.0, tiny], near(1.0)),
            ([1.0, 1.0], 45.0),
            ([0.0, 1.0], 90.0),
            ([-1.0, 1.0], 135.0),
            ([-1.0, 0.0], 180.0),
            ([-1.0, -1.0], 225.0),
            ([0.0, -1.0], 270.0),
            ([1.0, -1.0], 315.0),
        ];
        let around = |degrees: f64| [degrees.next_down(), degrees, degrees.next_up()];
        let ends = [90.0, 180.0, 270.0, 360.0].into_iter().flat_map(around);
        let small = [
            0.0, 5e-324, 1e-322, 1.4e-322, 1.5e-322, 1e-320, 1e-307, 1e-300, 1e-46, 1e-40, 1e-9,
            44.9, 45.1,
        ];
        for degrees in ends.chain(small) {
            let Some(sector) = Sector::new(degrees) else {
                continue;
            };
            for ([x, y], angle) in points {
                assert_eq!(
                    holds(&sector, x, y),
                    angle <= degrees,
                    "{x} {y} of {degrees} degrees"
                );
            }
            assert!(holds(&sector, 0.0, 0.0), "the axis, {degrees} degrees");
        }
    }

    #[test]
    fn what_is_out_of_range_is_clamped() {
        assert_eq!(
            [360.0, 400.0, f64::INFINITY, f64::NAN].map(Sector::new),
            [None; 4]
        );
        for degrees in [-0.0, -5.0, f64::NEG_INFINITY] {
            let sector = Sector::new(degrees).unwrap();
            assert!(
                holds(&sector, 1.0, 0.0) && !holds(&sector, -1.0, 0.0) && !holds(&sector, 1.0, 1.0)
            );
        }
    }
}
