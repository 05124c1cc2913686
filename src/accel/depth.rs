//! How far away a hit is, rounded once.

use super::Precision;
use super::hit::Hit;
use crate::exact::{Bracket, Dyadic, ExactVector, exponent_of, nearest_f32, power_of_two};
use crate::geometry::{Ray, Vector};
use crate::shape::Geometry;

/// How far away a hit is, as images hold it (rule E4).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Depth {
    /// The ray's parameter: the planar depth in units of camera space.
    pub z: f32,
    /// The distance from the ray's origin in units of world space.
    pub t: f32,
}

impl Depth {
    /// The depth of the `hit` of `ray` in `geometry`, and how many of the two numbers were rounded by integers.
    pub(super) fn of(
        hit: &Hit,
        ray: &Ray,
        geometry: &Geometry,
        precision: Precision,
    ) -> (Depth, u64) {
        let speed = speed(ray.direction);
        if precision == Precision::Fast {
            return (
                Depth {
                    z: hit.t.low as f32,
                    t: (hit.t.low * speed) as f32,
                },
                0,
            );
        }
        let distance = hit.t.times(&speed_bracket(speed));
        match (hit.t.nearest_f32(), distance.nearest_f32()) {
            (Some(z), Some(t)) => (Depth { z, t }, 0),
            (z, t) => {
                let roundings = u64::from(z.is_none()) + u64::from(t.is_none());
                (
                    Depth::rounded_exactly(hit, ray, geometry, (z, t), &distance),
                    roundings,
                )
            }
        }
    }

    /// Rounds by exact comparisons what is not known yet.
    #[cold]
    fn rounded_exactly(
        hit: &Hit,
        ray: &Ray,
        geometry: &Geometry,
        known: (Option<f32>, Option<f32>),
        distance: &Bracket,
    ) -> Depth {
        let root = geometry.surface(hit.primitive).exact_t(ray);
        let direction = ExactVector::from(ray.direction);
        let square_of_speed = direction.dot(&direction);
        let z = || nearest_f32(&hit.t, |x: &Dyadic| root.compare_with(x));
        let t = || {
            nearest_f32(distance, |x: &Dyadic| {
                root.times_root_compare_with(&square_of_speed, x)
            })
        };
        Depth {
            z: known.0.unwrap_or_else(z),
            t: known.1.unwrap_or_else(t),
        }
    }
}

/// The length of a ray's direction. Its largest component is scaled to about 1, so that no square leaves the range.
fn speed(direction: Vector) -> f64 {
    let scale = power_of_two(exponent_of(direction.largest()).max(-1022));
    let scaled = Vector::from(direction.to_array().map(|component| component / scale));
    scaled.dot(scaled).sqrt() * scale
}

/// Where the length lies: three units of 2^-53 come from the sum of squares, of which the root keeps half, and one from
/// the root. Of a result that underflows, or is too large, the ends of the bracket are one step away or infinite.
fn speed_bracket(speed: f64) -> Bracket {
    let bracket = Bracket::around(speed, 2.0 * f64::EPSILON * speed);
    if bracket.low > 0.0 {
        bracket
    } else {
        Bracket {
            low: 0.0,
            ..bracket
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::times_power_of_two;
    use proptest::prelude::*;
    use std::cmp::Ordering::{Greater, Less};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn the_length_lies_in_its_bracket(
            components in prop::array::uniform3(-1.0f64..1.0),
            exponents in prop::array::uniform3(-1074i32..1024),
            same in any::<bool>(),
        ) {
            let exponent = |k: usize| if same { exponents[0] + k as i32 } else { exponents[k] };
            let direction = Vector::from(std::array::from_fn(|k| times_power_of_two(components[k], exponent(k))));
            prop_assume!(direction.is_finite() && direction != Vector::default());
            let bracket = speed_bracket(speed(direction));
            let exact = ExactVector::from(direction);
            let square = exact.dot(&exact);
            prop_assert!(Dyadic::from(bracket.low).square().cmp(&square) != Greater);
            prop_assert!(bracket.high == f64::INFINITY || Dyadic::from(bracket.high).square().cmp(&square) != Less);
        }
    }
}
