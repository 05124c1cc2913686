//! Bounds of how far the roundings of rules R2 to R4 move a primitive.

use super::bound::{length, with_slack};
use super::rounded_transform::RoundedTransform;
use super::roundings::Roundings;
use crate::exact::{Rounded, UNIT_ROUNDOFF as U};
use crate::geometry::Point;
use crate::per_axis::per_axis;
use crate::shape::{Form, Geometry, InstancedId, Primitive};

/// More than the products of a vertex lose by underflow.
const TINY: f64 = f64::from_bits(1 << 4);

/// A bound of how far any point of a primitive is from its unrounded position, in the world.
pub(super) fn of_primitive(geometry: &Geometry, roundings: &Roundings, placed: InstancedId) -> f64 {
    let shape = roundings.shape(geometry.shape_number(placed));
    let (primitive, instance) = (placed.primitive(), placed.instance());
    // Primitives in an instance have the product of both transforms.
    let rounded = match instance {
        Some(instance) => roundings.instance(instance).times(shape),
        None => *shape,
    };
    let store = instance.map_or(geometry, |instance| geometry.object_of(instance));
    let of_corner = |corner: &Point| match instance {
        // Objects store the vertices of their files.
        Some(_) => length(of_vertex(&rounded, corner.to_array().map(f64::abs))),
        None => of_world_vertex(&rounded, *corner),
    };
    let of_corners = |corners: &[Point]| corners.iter().map(of_corner).fold(0.0, f64::max);
    // The matrix of any other curved surface has errors, but none of its points has been rounded.
    let extent = match store.own_surface(primitive) {
        Primitive::Triangle(triangle) => return of_corners(&triangle.0),
        Primitive::Quadric(quadric) if quadric.form == Form::Patch => {
            // A point of a patch is a mean of its corners, and moves no farther.
            return of_corners(&quadric.patch().corners);
        }
        Primitive::Quadric(quadric) => quadric.extent(),
        Primitive::Segment(segment) => segment.extent(),
    };
    extent.map_or(f64::INFINITY, |extent| length(of_matrix(&rounded, extent)))
}

/// A bound of the error of a transformed vertex along each axis. `p` bounds the absolute
/// coordinates of the vertex in object space.
fn of_vertex(rounded: &RoundedTransform, p: [f64; 3]) -> [f64; 3] {
    let (by_matrix, by_rounding) = (of_matrix(rounded, p), of_rounding(rounded, p));
    per_axis(|k| with_slack(by_matrix[k] + by_rounding[k]))
}

/// The part of the error that comes from the matrix.
fn of_matrix(rounded: &RoundedTransform, p: [f64; 3]) -> [f64; 3] {
    let errors = rounded.error.matrix;
    errors.map(|e| with_slack(e[0] * p[0] + e[1] * p[1] + e[2] * p[2] + e[3]))
}

/// The part of the error that comes from rule R4, which rounds products, except those with 0 and 1,
/// and sums of terms that are not 0. No partial sum exceeds the sum of all absolute terms, except
/// for roundings of 2^-53, which `with_slack` covers.
fn of_rounding(rounded: &RoundedTransform, p: [f64; 3]) -> [f64; 3] {
    rounded.transform.matrix.rows.map(|m| {
        let m = m.map(f64::abs);
        let terms = [m[0] * p[0], m[1] * p[1], m[2] * p[2], m[3]];
        let rounded = (0..3).filter(|j| m[*j] != 0.0 && m[*j] != 1.0);
        let products = rounded.map(|j| U * terms[j] + TINY).sum::<f64>();
        let sums = m
            .iter()
            .filter(|entry| **entry != 0.0)
            .count()
            .saturating_sub(1);
        with_slack(products + sums as f64 * (U * terms.iter().sum::<f64>()))
    })
}

/// A bound of the error of a vertex `w` in the world, without knowing its position `p` in object
/// space.
///
/// Let M be the exact matrix and d the displacement: w = M p + d, so p = M^-1 w - M^-1 d. A
/// monotone affine function F of |p| bounds |d|. So |p| <= H(|p|), with H(x) = |M^-1 w| + |M^-1|
/// F(x) and H(0) > 0. If H(x) <= x, then |p| <= x. Otherwise let s > 1 be the least factor with |p|
/// <= s x; but |p| <= H(s x) <= s H(x) - (s - 1) H(0) < s x.
fn of_world_vertex(rounded: &RoundedTransform, w: Point) -> f64 {
    let inverse = rounded.inverse();
    let about = inverse.map(|row| {
        let product = |j: usize| row[j] * Rounded::exactly(w[j]);
        (product(0) + product(1) + product(2) + row[3]).most()
    });
    // Above 0 in all components, and hardly larger than they are.
    let largest = about.into_iter().fold(f64::MIN_POSITIVE, f64::max);
    let about = about.map(|component| component + largest / (1u64 << 60) as f64);
    let bound = |p: [f64; 3]| {
        let d = of_vertex(rounded, p);
        let moved = inverse.map(|row| (0..3).map(|j| row[j].most() * d[j]).sum::<f64>());
        per_axis(|k| with_slack(about[k] + with_slack(moved[k])))
    };
    // Twice the second iterate from 0: the first one ignores how much other components contribute
    // to one that is nearly 0.
    let guess = bound(bound([0.0; 3])).map(|component| 2.0 * component);
    let p = bound(guess);
    let is_proven = (0..3).all(|k| p[k] <= guess[k] && p[k] < f64::INFINITY);
    if is_proven {
        length(of_vertex(rounded, p))
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::super::high_precision::{self, High, chain};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        #[test]
        fn errors_of_vertices_are_within_their_bounds(
            chain in chain(),
            p in prop::array::uniform3(
                prop_oneof![-9.0f64..9.0, -1e6f64..1e6, Just(0.0), Just(1.0)]
            ),
        ) {
            let (rounded, meant) = chain;
            let w = rounded.transform.matrix.apply(p.into());
            let exact = p.map(High::from);
            let image = meant.matrix.map(|row| high_precision::dot(&row, &exact).plus(&row[3]));
            let errors = std::array::from_fn(|k| image[k].minus(&w[k].into()));
            let off = high_precision::length(&errors);
            let known = length(of_vertex(&rounded, p.map(f64::abs)));
            let unknown = of_world_vertex(&rounded, w);
            prop_assert!(off.is_within(known) && off.is_within(unknown));
        }
    }

    #[test]
    fn identities_have_no_error_and_sums_round() {
        let point = Point::new(0.1, 0.2, 0.3);
        assert_eq!(of_world_vertex(&RoundedTransform::IDENTITY, point), 0.0);
        let moved = RoundedTransform::translate([0.0, 4.0, 0.0]);
        let displacement = of_world_vertex(&moved, Point::new(0.1, 4.2, 0.3));
        assert!(
            displacement > 3.0 * U && displacement < 6.0 * U,
            "{displacement}"
        );
        let flat = RoundedTransform::scale([1.0, 0.0, 1.0]);
        assert_eq!(of_world_vertex(&flat, point), f64::INFINITY);
    }
}
