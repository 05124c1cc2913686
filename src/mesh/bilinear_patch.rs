//! Bilinear patches that are triangles.
//!
//! A patch is the surface `(1-u)(1-v) p00 + u(1-v) p10 + (1-u)v p01 + uv p11`, with u and v from 0
//! to 1 ("Physically Based Rendering", 4th edition, section 6.6). If its corners form a flat convex
//! quadrilateral, two triangles are the same set of points. Otherwise it is curved or folded.

use crate::exact::{ExactVector, UNIT_ROUNDOFF};
use crate::geometry::Point;
use crate::shape::CornerUv;
use std::cmp::Ordering;

/// The two triangles of a patch with the corners p00, p10, p01 and p11, in this order (rule R7).
pub fn triangles([p00, p10, p01, p11]: [u32; 4]) -> [[u32; 3]; 2] {
    [[p00, p10, p11], [p00, p11, p01]]
}

/// u and v at the corners of the triangles.
pub const UV: [CornerUv; 2] = [
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]],
    [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
];

/// Whether the patch with the corners p00, p10, p01 and p11 is flat and convex, so that its two
/// triangles are the same set of points; decided exactly. A patch with a corner that is not finite
/// counts as flat, since it is never hit.
pub fn is_flat_and_convex([p00, p10, p01, p11]: [Point; 4]) -> bool {
    let around = [p00, p10, p11, p01];
    if !around.iter().all(|corner| corner.is_finite()) {
        return true;
    }
    if is_surely_curved(&around) {
        return false;
    }
    let around = around.map(ExactVector::from);
    let corner = |k: usize| &around[k % 4];
    let sides: [ExactVector; 4] = std::array::from_fn(|k| corner(k + 1).minus(corner(k)));
    // If all corners turn the same way, seen from anywhere, no normal is opposite to another.
    let normals: [ExactVector; 4] = std::array::from_fn(|k| sides[(k + 3) % 4].cross(&sides[k]));
    let is_flat = normals[0].dot(&sides[1]).is_zero();
    is_flat && (0..4).all(|i| (0..i).all(|j| normals[i].dot(&normals[j]).sign() != Ordering::Less))
}

/// Whether the volume between the corners is certainly not 0. A term of it takes three differences,
/// two products, and three roundings of differences and sums.
fn is_surely_curved(around: &[Point; 4]) -> bool {
    let [a, b, c] = [1, 2, 3].map(|k| around[k] - around[0]);
    let terms = a.absolute().dot(b.absolute_cross(c));
    // Overflow is uncertain, and so is a value so small that underflow might matter.
    terms > 1e-280
        && terms < f64::INFINITY
        && a.dot(b.cross(c)).abs() > 16.0 * UNIT_ROUNDOFF * terms
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn patch(corners: [[i32; 3]; 4]) -> [Point; 4] {
        corners.map(|corner| Point::from(corner.map(f64::from)))
    }

    #[test]
    fn a_patch_is_split_from_its_first_corner_to_the_opposite_one() {
        assert_eq!(triangles([4, 5, 6, 7]), [[4, 5, 7], [4, 7, 6]]);
    }

    #[test]
    fn flat_and_convex_is_meant_exactly() {
        let square = patch([[0, 0, 0], [1, 0, 1], [0, 1, 0], [1, 1, 1]]);
        assert!(is_flat_and_convex(square));
        let mut bent = square;
        bent[3].z = bent[3].z.next_up();
        assert!(!is_flat_and_convex(bent), "by one unit in the last place");
        let sizes = [1e-300, 1e-160, 1e160, 1e300]
            .map(|size| square.map(|p| Point::new(p.x * size, p.y, p.z * size)));
        assert!(sizes.into_iter().all(is_flat_and_convex));
        assert!(
            !is_flat_and_convex(patch([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])),
            "crossed sides"
        );
        assert!(
            !is_flat_and_convex(patch([[0, 0, 0], [1, 1, 0], [0, 4, 0], [4, 0, 0]])),
            "a corner that turns inward"
        );
        assert!(
            is_flat_and_convex(patch([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0]])),
            "a triangle"
        );
        assert!(is_flat_and_convex([
            Point::new(f64::NAN, 0.0, 0.0),
            square[1],
            square[2],
            square[3]
        ]));
    }

    proptest! {
        /// Small whole numbers: flat ones are frequent, and in `f64` nothing is rounded.
        #[test]
        fn flat_patches_have_no_volume(corners in prop::array::uniform4(prop::array::uniform3(-2i32..3))) {
            let [p00, p10, p01, p11] = patch(corners);
            let volume = (p10 - p00).dot((p01 - p00).cross(p11 - p00));
            prop_assert!(volume == 0.0 || !is_flat_and_convex([p00, p10, p01, p11]));
            prop_assert_eq!(is_surely_curved(&[p00, p10, p11, p01]), volume != 0.0);
        }

        /// Corners of a plane, but for roundings: what `f64` is sure of is so.
        #[test]
        fn what_is_surely_curved_has_a_volume(
            sides in prop::array::uniform2(prop::array::uniform3(-1.0f64..1.0)),
            weights in prop::array::uniform2(-2.0f64..2.0),
            origin in prop::array::uniform3(prop::sample::select(vec![0.0, 0.1, 1e3, 1e9])),
        ) {
            let at = |u: f64, v: f64| Point::from([0, 1, 2].map(|k| origin[k] + u * sides[0][k] + v * sides[1][k]));
            let around = [at(0.0, 0.0), at(1.0, 0.0), at(weights[0], weights[1]), at(0.0, 1.0)];
            let [a, b, c] = [1, 2, 3].map(|k| ExactVector::from(around[k]).minus(&ExactVector::from(around[0])));
            prop_assert!(!is_surely_curved(&around) || !a.dot(&b.cross(&c)).is_zero());
        }
    }
}
