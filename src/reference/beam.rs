//! A beam: intervals around all rays of a rectangle of pixels.

use crate::camera::Camera;
use crate::exact::Bracket;
use crate::geometry::{Bounds, Ray};

/// Intervals that contain the origins and the directions of some rays.
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
    /// The beam of these rays.
    pub(super) fn around(rays: impl Iterator<Item = Ray>) -> Beam {
        const NOTHING: Bracket = Bracket {
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
        };
        let mut beam = Beam {
            origin: [NOTHING; 3],
            direction: [NOTHING; 3],
        };
        let widen = |bracket: &mut Bracket, value: f64| {
            *bracket = match value.is_finite() {
                true => Bracket {
                    low: bracket.low.min(value),
                    high: bracket.high.max(value),
                },
                false => ANYTHING,
            };
        };
        for ray in rays {
            for k in 0..3 {
                widen(&mut beam.origin[k], ray.origin[k]);
                widen(&mut beam.direction[k], ray.direction[k]);
            }
        }
        beam
    }

    /// The beam of the rays that pass through the rectangle `x` by `y` in the plane at distance 1.
    ///
    /// Rounding is monotone, so each component of a ray, as rule R5 computes it, is monotone in x
    /// and in y: its extremes are at the corners.
    pub(super) fn through(camera: &Camera, x: Bracket, y: Bracket) -> Beam {
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

    /// Tests whether any of the rays may meet the box, by interval arithmetic that is rounded
    /// outward. Returns false only if none does. NaN rules nothing out.
    pub(super) fn may_meet(&self, bounds: &Bounds) -> bool {
        let way: [Bracket; 3] =
            std::array::from_fn(|k| minus(bounds.low[k], bounds.high[k], &self.origin[k]));
        let mut t = Bracket::POSITIVE;
        for (way, direction) in way.iter().zip(&self.direction) {
            let (enter, exit) = crossing(way, direction);
            (t.low, t.high) = (t.low.max(enter), t.high.min(exit));
        }
        // An axis along which rays go both ways does not limit t, but t limits how far they get.
        let is_reached = |(way, direction): (&Bracket, &Bracket)| {
            let reach = |speed: f64| if speed == 0.0 { 0.0 } else { t.high * speed };
            let misses = reach(direction.low).next_down() > way.high
                || reach(direction.high).next_up() < way.low;
            !(goes_both_ways(direction) && misses)
        };
        // Neither end is ever NaN: `max` and `min` ignore it.
        t.low <= t.high && way.iter().zip(&self.direction).all(is_reached)
    }
}

fn goes_both_ways(direction: &Bracket) -> bool {
    !(direction.low > 0.0 || direction.high < 0.0)
}

/// The difference from any of the origins to any coordinate between `low` and `high`.
fn minus(low: f64, high: f64, origin: &Bracket) -> Bracket {
    Bracket {
        low: (low - origin.high).next_down(),
        high: (high - origin.low).next_up(),
    }
}

/// The range of `t` in which rays can be in a slab.
fn crossing(way: &Bracket, direction: &Bracket) -> (f64, f64) {
    if goes_both_ways(direction) {
        return (0.0, f64::INFINITY);
    }
    // Mirrored if necessary, so that rays go up.
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

        /// Every beam that contains a ray meets a box around a point of that ray.
        #[test]
        fn a_beam_never_misses_a_box_that_its_ray_meets(
            rows in prop::array::uniform3(
                prop::array::uniform4(prop_oneof![-2.0f64..2.0, Just(0.0), Just(1.0)])),
            tangent in prop_oneof![Just(0.0), 0.01f64..3.0],
            place in prop::array::uniform2(-1.0f64..1.0),
            low in prop::array::uniform2(0.0f64..0.5),
            high in prop::array::uniform2(0.0f64..0.5),
            t in 0.0f64..10.0,
            size in prop_oneof![Just(0.0), 0.0f64..1.0],
        ) {
            let projection = match tangent > 0.0 {
                true => Projection::Perspective { tangent },
                false => Projection::Orthographic,
            };
            let camera = camera(projection, Matrix { rows });
            let ray = camera.ray_through(place);
            let end = |k: usize| ray.origin[k] + t * ray.direction[k];
            // Room for the rounding of the sum.
            let room = |k: usize| size + 1e-14 * (1.0 + end(k).abs() + ray.origin[k].abs());
            let corner = |sign: f64| Point::from([0, 1, 2].map(|k| end(k) + sign * room(k)));
            let bounds = Bounds { low: corner(-1.0), high: corner(1.0) };
            let side = |k: usize| Bracket { low: place[k] - low[k], high: place[k] + high[k] };
            prop_assert!(Beam::through(&camera, side(0), side(1)).may_meet(&bounds));
        }
    }

    #[test]
    fn rules_out_boxes_beside_behind_and_above() {
        let camera = camera(Projection::perspective(90.0), Matrix::IDENTITY);
        let beam = Beam::through(
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
    fn nan_rules_nothing_out() {
        let broken = camera(
            Projection::perspective(90.0),
            Matrix::scale([f64::NAN, 1.0, 1.0]),
        );
        let beam = Beam::through(&broken, Bracket::exactly(0.5), Bracket::exactly(0.5));
        let far = Bounds {
            low: Point::new(90.0, 0.0, 1.0),
            high: Point::new(91.0, 1.0, 2.0),
        };
        assert!(beam.may_meet(&far));
    }
}
