//! The rays of a rectangle of pixels, all at once.

use crate::camera::Camera;
use crate::exact::Bracket;
use crate::geometry::{Bounds, Ray};

/// Intervals that hold the origins and the directions of some rays.
#[derive(Debug)]
pub(super) struct Beam {
    origin: [Bracket; 3],
    direction: [Bracket; 3],
}

const ANYTHING: Bracket = Bracket {
    low: f64::NEG_INFINITY,
    high: f64::INFINITY,
};

impl Beam {
    /// Of the rays that pass the plane at distance 1 between `x` and `y`.
    ///
    /// Rounding is monotone, so each component of a ray, as rule R5 computes it, goes up or down with x and with y; its extremes are
    /// at the corners.
    pub(super) fn new(camera: &Camera, x: Bracket, y: Bracket) -> Beam {
        let corners = [
            [x.low, y.low],
            [x.low, y.high],
            [x.high, y.low],
            [x.high, y.high],
        ];
        let rays = corners.map(|corner| camera.ray_through(corner));
        let hull = |of: &dyn Fn(&Ray) -> f64| {
            let values = rays.each_ref().map(of);
            if values.iter().any(|value| !value.is_finite()) {
                return ANYTHING;
            }
            Bracket {
                low: values.into_iter().fold(f64::INFINITY, f64::min),
                high: values.into_iter().fold(f64::NEG_INFINITY, f64::max),
            }
        };
        Beam {
            origin: std::array::from_fn(|k| hull(&|ray| ray.origin[k])),
            direction: std::array::from_fn(|k| hull(&|ray| ray.direction[k])),
        }
    }

    /// Whether any of the rays may meet the box: false only where none does. Interval arithmetic, rounded outward; whatever is
    /// no number leaves everything open.
    pub(super) fn may_meet(&self, bounds: &Bounds) -> bool {
        let way: [Bracket; 3] =
            std::array::from_fn(|k| minus(bounds.low[k], bounds.high[k], &self.origin[k]));
        let mut t = Bracket::POSITIVE;
        for (way, direction) in way.iter().zip(&self.direction) {
            let (enter, exit) = crossing(way, direction);
            (t.low, t.high) = (t.low.max(enter), t.high.min(exit));
        }
        // An axis along which rays go either way says nothing about t, but t says how far they get.
        let is_reached = |(way, direction): (&Bracket, &Bracket)| {
            let reach = |speed: f64| if speed == 0.0 { 0.0 } else { t.high * speed };
            let misses = reach(direction.low).next_down() > way.high
                || reach(direction.high).next_up() < way.low;
            !(goes_either_way(direction) && misses)
        };
        // Neither end is ever a NaN: `max` and `min` pass over them.
        t.low <= t.high && way.iter().zip(&self.direction).all(is_reached)
    }
}

fn goes_either_way(direction: &Bracket) -> bool {
    !(direction.low > 0.0 || direction.high < 0.0)
}

/// From any of the origins to any place between `low` and `high`.
fn minus(low: f64, high: f64, origin: &Bracket) -> Bracket {
    Bracket {
        low: (low - origin.high).next_down(),
        high: (high - origin.low).next_up(),
    }
}

/// The `t` at which rays can be in a slab: after the first, before the second.
fn crossing(way: &Bracket, direction: &Bracket) -> (f64, f64) {
    if goes_either_way(direction) {
        return (0.0, f64::INFINITY);
    }
    // Mirrored, if need be, so that rays go up.
    let (way, direction) = match direction.low > 0.0 {
        true => (*way, *direction),
        false => (
            Bracket {
                low: -way.high,
                high: -way.low,
            },
            Bracket {
                low: -direction.high,
                high: -direction.low,
            },
        ),
    };
    let enter = way.low
        / if way.low > 0.0 {
            direction.high
        } else {
            direction.low
        };
    let exit = way.high
        / if way.high > 0.0 {
            direction.low
        } else {
            direction.high
        };
    (enter.next_down(), exit.next_up())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Projection, ScreenWindow};
    use crate::geometry::{Matrix, Point};
    use proptest::prelude::*;

    fn camera(projection: Projection, matrix: Matrix) -> Camera {
        Camera {
            world_from_camera: matrix,
            projection,
            screen_window: ScreenWindow::of_aspect(1.0),
            resolution: [16, 16],
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// A box around a point of a ray is met by every beam that holds the ray.
        #[test]
        fn never_misses_what_a_ray_meets(
            rows in prop::array::uniform3(prop::array::uniform4(prop_oneof![-2.0f64..2.0, Just(0.0), Just(1.0)])),
            tangent in prop_oneof![Just(0.0), 0.01f64..3.0],
            place in prop::array::uniform2(-1.0f64..1.0),
            low in prop::array::uniform2(0.0f64..0.5),
            high in prop::array::uniform2(0.0f64..0.5),
            t in 0.0f64..10.0,
            size in prop_oneof![Just(0.0), 0.0f64..1.0],
        ) {
            let projection = if tangent > 0.0 { Projection::Perspective { tangent } } else { Projection::Orthographic };
            let camera = camera(projection, Matrix { rows });
            let ray = camera.ray_through(place);
            let end = |k: usize| ray.origin[k] + t * ray.direction[k];
            // The sum is rounded: some room.
            let room = |k: usize| size + 1e-14 * (1.0 + end(k).abs() + ray.origin[k].abs());
            let corner = |sign: f64| Point::new(end(0) + sign * room(0), end(1) + sign * room(1), end(2) + sign * room(2));
            let bounds = Bounds { low: corner(-1.0), high: corner(1.0) };
            let side = |k: usize| Bracket { low: place[k] - low[k], high: place[k] + high[k] };
            prop_assert!(Beam::new(&camera, side(0), side(1)).may_meet(&bounds));
        }
    }

    #[test]
    fn rules_out_what_is_beside_behind_and_too_far_up() {
        let camera = camera(Projection::perspective(90.0), Matrix::IDENTITY);
        let beam = Beam::new(
            &camera,
            Bracket {
                low: -0.1,
                high: 0.1,
            },
            Bracket {
                low: -0.1,
                high: 0.1,
            },
        );
        let cube = |x: f64, y: f64, z: f64| Bounds {
            low: Point::new(x - 0.1, y - 0.1, z - 0.1),
            high: Point::new(x + 0.1, y + 0.1, z + 0.1),
        };
        assert!(beam.may_meet(&cube(0.0, 0.0, 2.0)) && beam.may_meet(&cube(0.25, -0.25, 2.0)));
        let missed = [
            cube(0.35, 0.0, 2.0),
            cube(0.0, -0.35, 2.0),
            cube(0.0, 0.0, -2.0),
        ];
        assert!(missed.iter().all(|bounds| !beam.may_meet(bounds)));
    }

    #[test]
    fn what_is_no_number_leaves_everything_open() {
        let broken = camera(
            Projection::perspective(90.0),
            Matrix::scale([f64::NAN, 1.0, 1.0]),
        );
        let beam = Beam::new(&broken, Bracket::exactly(0.5), Bracket::exactly(0.5));
        let far = Bounds {
            low: Point::new(90.0, 0.0, 1.0),
            high: Point::new(91.0, 1.0, 2.0),
        };
        assert!(beam.may_meet(&far));
    }
}
