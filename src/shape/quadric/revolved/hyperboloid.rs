//! Hyperboloids: pbrt-v3's surface through a line that turns about the z axis.

use crate::exact::UNIT_ROUNDOFF;
use crate::per_axis::per_axis;
use crate::shape::Sector;

/// The number of points that pbrt's loop may try: it never ends for lines that meet the axis at
/// z = 0, such as that of its own defaults.
const MOST_TRIALS: usize = 10;

/// The points of `across (x^2 + y^2) - along z^2 = 1` with z between the two points, at the angles
/// of the sector. They count from the line through the points, at the same z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hyperboloid {
    /// The point where v is 0.
    pub p1: [f64; 3],
    /// The point where v is 1.
    pub p2: [f64; 3],
    /// pbrt's `ah`; infinite or NaN if its loop does not end.
    pub across: f64,
    /// pbrt's `ch`.
    pub along: f64,
    /// `None` for a full turn.
    pub sector: Option<Sector>,
}

impl Hyperboloid {
    /// The hyperboloid as pbrt-v3 reads it (rule R12). If the z of `p2` is 0, both points change
    /// places.
    ///
    /// pbrt takes a centre at z = 0 for granted. So the surface contains the circle of p2, but the
    /// line only if it is nearest to the axis at z = 0.
    pub fn new(p1: [f64; 3], p2: [f64; 3], phi_max: f64) -> Hyperboloid {
        let [p1, p2] = if p2[2] == 0.0 { [p2, p1] } else { [p1, p2] };
        let square = |[x, y, _]: [f64; 3]| x * x + y * y;
        let mut hyperboloid = Hyperboloid {
            p1,
            p2,
            across: f64::NAN,
            along: f64::NAN,
            sector: Sector::new(phi_max),
        };
        let (of_p2, height) = (square(p2), p2[2] * p2[2]);
        let mut point = p1;
        for _ in 0..MOST_TRIALS {
            point = per_axis(|k| point[k] + 2.0 * (p2[k] - p1[k]));
            let (of_point, up) = (square(point), point[2] * point[2]);
            let below = of_point * height;
            let across = (1.0 / of_point - up / below) / (1.0 - of_p2 * up / below);
            let along = (across * of_p2 - 1.0) / height;
            if across.is_finite() {
                (hyperboloid.across, hyperboloid.along) = (across, along);
                break;
            }
        }
        hyperboloid
    }

    /// The lowest and the highest z.
    pub fn ends(&self) -> [f64; 2] {
        let (a, b) = (self.p1[2], self.p2[2]);
        if a > b { [b, a] } else { [a, b] }
    }

    /// An upper bound of the distance from the axis; `None` if no ray can hit it.
    pub(super) fn widest(&self) -> Option<f64> {
        let numbers = self.p1.iter().chain(&self.p2);
        let is_there = numbers
            .chain([&self.across, &self.along])
            .all(|x| x.is_finite())
            && self.across != 0.0
            && self.p1[2] != self.p2[2];
        is_there.then_some(())?;
        let [low, high] = self.ends();
        // The square is (1 + along z^2) / across. It takes four roundings.
        let square = |z: f64| {
            let (size, up) = (self.across.abs(), self.along * (z * z));
            let numerator = if self.across > 0.0 {
                1.0 + up
            } else {
                -1.0 - up
            };
            (numerator + 8.0 * UNIT_ROUNDOFF * (1.0 + up.abs())) / size
        };
        let at_waist = if low < 0.0 && high > 0.0 {
            square(0.0)
        } else {
            0.0
        };
        let largest = square(low).max(square(high)).max(at_waist).max(0.0);
        Some(largest.sqrt() * (1.0 + 4.0 * f64::EPSILON) + f64::MIN_POSITIVE)
    }

    /// The coordinates of a point in a frame that turns with the line, times the distance of the
    /// line from the axis and the sign of p2.z - p1.z: along the direction of the line at the z of
    /// the point, and across it.
    pub(in crate::shape::quadric) fn relative_to_line(&self, [x, y, z]: [f64; 3]) -> [f64; 2] {
        let [a, b] = [self.p2[2] - z, z - self.p1[2]];
        let sign = (self.p2[2] - self.p1[2]).signum();
        let line = |k: usize| sign * (a * self.p1[k] + b * self.p2[k]);
        let (line_x, line_y) = (line(0), line(1));
        [line_x * x + line_y * y, line_x * y - line_y * x]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line that is nearest to the axis at z = 0: the surface contains all of it.
    #[test]
    fn a_line_that_is_nearest_at_the_origin_lies_within() {
        let hyperboloid = Hyperboloid::new([1.0, -1.0, -2.0], [1.0, 2.0, 4.0], 360.0);
        let Hyperboloid { across, along, .. } = hyperboloid;
        assert!((across - 1.0).abs() < 1e-15 && (along - 0.25).abs() < 1e-15);
        for v in [0.0, 0.25, 0.5, 1.0] {
            let [x, y, z] =
                [0, 1, 2].map(|k: usize| (1.0 - v) * hyperboloid.p1[k] + v * hyperboloid.p2[k]);
            assert_eq!(x * x + y * y - 0.25 * z * z, 1.0, "{v}");
            let [along, across] = hyperboloid.relative_to_line([x, y, z]);
            assert!(along > 0.0 && across == 0.0, "{v}: on the line");
        }
        assert_eq!(hyperboloid.ends(), [-2.0, 4.0]);
        let widest = hyperboloid.widest().unwrap();
        assert!(widest >= 5f64.sqrt() && widest < 2.2361);
    }

    #[test]
    fn the_circle_of_p2_lies_within_whatever_the_line() {
        let points = [
            ([3.0, 1.2, 1.0], [1.0, -0.5, -1.0]),
            ([-3.2, 0.8, 0.4], [-1.0, -0.5, -1.25]),
            ([1.0, 0.0, 0.0], [0.5, 0.0, 1.0]),
        ];
        for (p1, p2) in points {
            let Hyperboloid { across, along, .. } = Hyperboloid::new(p1, p2, 360.0);
            let [x, y, z] = p2;
            let off = across * (x * x + y * y) - along * (z * z) - 1.0;
            assert!(off.abs() < 1e-14, "{p1:?} {p2:?}: {off}");
        }
        // The second trial counts: the first point lies on the axis.
        let second = Hyperboloid::new([1.0, 0.0, 0.0], [0.5, 0.0, 1.0], 360.0);
        assert_eq!((second.across, second.along), (5.0, 0.25));
    }

    #[test]
    fn points_change_places_if_the_second_is_at_the_origin_of_z() {
        let swapped = Hyperboloid::new([2.0, 0.0, 3.0], [1.0, 0.5, 0.0], 90.0);
        assert_eq!((swapped.p1, swapped.p2), ([1.0, 0.5, 0.0], [2.0, 0.0, 3.0]));
        assert_eq!(swapped.ends(), [0.0, 3.0]);
    }

    #[test]
    fn the_loop_ends_where_pbrt_would_not() {
        for (p1, p2) in [
            ([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]),
            ([1.0, 0.0, 1.0], [2.0, 0.0, 2.0]),
            ([0.0, 0.0, 1.0], [0.0, 0.0, 2.0]),
            ([1.0, 0.0, 0.0], [2.0, 0.0, 0.0]),
            ([f64::NAN, 0.0, 0.0], [2.0, 0.0, 1.0]),
            ([1.0, 0.0, 1.0], [2.0, 0.0, 1.0]),
            ([1.0, 0.0, 1.0], [f64::INFINITY, 0.0, 2.0]),
        ] {
            assert_eq!(
                Hyperboloid::new(p1, p2, 360.0).widest(),
                None,
                "{p1:?} {p2:?}"
            );
        }
        // The circle of the next point lies in the opposite plane: `across` is 0.
        assert_eq!(
            Hyperboloid::new([1.0, 0.0, 3.0], [2.0, 0.0, 1.0], 360.0).widest(),
            None
        );
    }
}
