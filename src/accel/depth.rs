//! Depths and distances of hits, each rounded once.

use super::Precision;
use super::hit::{ExactFallbacks, Hit};
use crate::camera::Projection;
use crate::exact::{Bracket, Dyadic, ExactVector, exponent_of, nearest_f32, power_of_two};
use crate::geometry::{Ray, Vector};
use crate::shape::Geometry;

/// The depth of a hit, as images store it (rule E4).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Depth {
    /// The ray's parameter: the planar depth in units of camera space. For a spherical camera the
    /// distance.
    pub z: f32,
    /// The distance from the ray's origin in units of world space.
    pub distance: f32,
}

impl Depth {
    /// The depth of the `hit` of `ray` in `geometry`. Counts exact roundings in `fallbacks`.
    pub(super) fn of(
        hit: &Hit,
        ray: &Ray,
        geometry: &Geometry,
        precision: Precision,
        fallbacks: &mut ExactFallbacks,
    ) -> Depth {
        let length = length(ray.direction);
        if precision == Precision::Fast {
            let (z, distance) = (hit.t.low as f32, (hit.t.low * length) as f32);
            return Depth { z, distance };
        }
        let bracket = hit.t.times(&length_bracket(length));
        let known = (hit.t.nearest_f32(), bracket.nearest_f32());
        if let (Some(z), Some(distance)) = known {
            return Depth { z, distance };
        }
        fallbacks.roundings += u64::from(known.0.is_none()) + u64::from(known.1.is_none());
        fallbacks.rays += u64::from(!hit.is_hard);
        Depth::rounded_exactly(hit, ray, geometry, known, &bracket)
    }

    /// The depth as a camera of this projection defines it: without a plane, `Z` is the distance.
    pub fn seen_by(self, projection: &Projection) -> Depth {
        let z = if projection.has_planar_depth() {
            self.z
        } else {
            self.distance
        };
        Depth { z, ..self }
    }

    /// Rounds the numbers that are not `known` by exact comparisons.
    #[cold]
    fn rounded_exactly(
        hit: &Hit,
        ray: &Ray,
        geometry: &Geometry,
        known: (Option<f32>, Option<f32>),
        distance: &Bracket,
    ) -> Depth {
        let root = geometry.exact_t(hit.primitive, ray);
        let direction = ExactVector::from(ray.direction);
        let square = direction.dot(&direction);
        let z = || nearest_f32(&hit.t, |x: &Dyadic| root.compare_with(x));
        let distance = || {
            nearest_f32(distance, |x: &Dyadic| {
                root.times_root_compare_with(&square, x)
            })
        };
        Depth {
            z: known.0.unwrap_or_else(z),
            distance: known.1.unwrap_or_else(distance),
        }
    }
}

/// The bracket of the distance to a hit, from the bracket of the ray's parameter.
pub fn distance_bracket(t: &Bracket, direction: Vector) -> Bracket {
    t.times(&length_bracket(length(direction)))
}

/// The length of a ray's direction. Its largest component is scaled to about 1, so that no square
/// leaves the range of `f64`.
fn length(direction: Vector) -> f64 {
    let scale = power_of_two(exponent_of(direction.largest()).max(-1022));
    let scaled = Vector::from(direction.to_array().map(|component| component / scale));
    scaled.dot(scaled).sqrt() * scale
}

/// Encloses the exact length: the sum of squares has an error of three units of 2^-53, which the
/// root halves, and the root adds one. If the length underflows or overflows, the ends of the
/// bracket are one step away or infinite.
fn length_bracket(length: f64) -> Bracket {
    let mut bracket = Bracket::around(length, 2.0 * f64::EPSILON * length);
    if bracket.low.is_nan() || bracket.low <= 0.0 {
        bracket.low = 0.0;
    }
    bracket
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
        fn the_bracket_encloses_the_length(
            components in prop::array::uniform3(-1.0f64..1.0),
            exponents in prop::array::uniform3(-1074i32..1024),
            same in any::<bool>(),
        ) {
            let exponent = |k: usize| if same { exponents[0] + k as i32 } else { exponents[k] };
            let component = |k: usize| times_power_of_two(components[k], exponent(k));
            let direction = Vector::from([0, 1, 2].map(component));
            prop_assume!(direction.is_finite() && direction != Vector::default());
            let bracket = length_bracket(length(direction));
            let exact = ExactVector::from(direction);
            let square = exact.dot(&exact);
            prop_assert!(Dyadic::from(bracket.low).square().cmp(&square) != Greater);
            let is_above = |high: f64| Dyadic::from(high).square().cmp(&square) != Less;
            prop_assert!(bracket.high == f64::INFINITY || is_above(bracket.high));
        }
    }
}
