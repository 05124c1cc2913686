//! Triangles in world space.

mod exact;
mod filter;
mod normal;
mod single;
mod weights;

pub(crate) use single::intersect_single;

use crate::exact::{ExactVector, UNIT_ROUNDOFF as U};
use crate::geometry::{Bounds, Point};

/// Three corners in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle(pub [Point; 3]);

impl Triangle {
    /// The box around the corners.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.0)
    }

    /// Whether any ray can hit it: all corners finite, and an area that is not exactly 0 (rule E1).
    pub fn can_be_hit(&self) -> bool {
        self.0.iter().all(|corner| corner.is_finite())
            && (self.surely_has_area() || self.has_exact_area())
    }

    /// Whether arithmetic without branches can decide that [it can be hit](Triangle::can_be_hit).
    #[inline(always)]
    pub(crate) fn can_surely_be_hit(&self) -> bool {
        let [a, b, c] = self.0;
        // Infinite or NaN if one of them is; perhaps also if they are huge.
        let sum = ((a.x + a.y) + (a.z + b.x)) + ((b.y + b.z) + (c.x + c.y)) + c.z;
        (sum.abs() < f64::INFINITY) & self.surely_has_area()
    }

    #[inline(always)]
    fn surely_has_area(&self) -> bool {
        let [a, b, c] = self.0;
        let (u, v) = (b - a, c - a);
        // The error of a component of the cross product is at most the roundings of two
        // differences, one product and one sum: 4U of its terms' absolute sum. 8U is ample. Below
        // 1e-290 underflow may lose bits. A triangle without area that passed would not be hit
        // either, only counted.
        let surely_not_zero =
            |p: f64, q: f64| (p - q).abs() > 8.0 * U * (p.abs() + q.abs()) + 1e-290;
        surely_not_zero(u.y * v.z, u.z * v.y)
            | surely_not_zero(u.z * v.x, u.x * v.z)
            | surely_not_zero(u.x * v.y, u.y * v.x)
    }

    #[cold]
    fn has_exact_area(&self) -> bool {
        let [a, b, c] = self.0;
        if a == b || b == c || c == a {
            return false;
        }
        let [a, b, c] = self.0.map(ExactVector::from);
        !b.minus(&a).cross(&c.minus(&a)).is_zero()
    }

    /// Whether both have the same corners in any order: then every ray that hits one hits the other
    /// at the same `t`.
    pub fn coincides_with(&self, other: &Triangle) -> bool {
        self.0.iter().all(|corner| other.0.contains(corner))
            && other.0.iter().all(|corner| self.0.contains(corner))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Ray, Vector};
    use crate::shape::{FilterRay, FilterResult};

    const RIGHT: Triangle = Triangle([
        Point::new(0.0, 0.0, 2.0),
        Point::new(4.0, 0.0, 2.0),
        Point::new(0.0, 4.0, 2.0),
    ]);

    fn along_z(x: f64, y: f64) -> Ray {
        Ray {
            origin: Point::new(x, y, 0.0),
            direction: Vector::new(0.0, 0.0, 0.5),
        }
    }

    /// The exact `t`, with which the filter must not disagree.
    fn intersect(triangle: &Triangle, ray: &Ray) -> Option<f64> {
        let exact = triangle.exact(ray);
        assert!(exact.iter().all(|t| *t == triangle.exact_t(ray)));
        let exact = exact.map(|t| t.bracket());
        match (triangle.filter(&FilterRay::new(ray)), exact) {
            (FilterResult::Miss, None) | (FilterResult::Unsure, _) => {}
            (FilterResult::Hit(filtered), Some(exact)) => {
                assert!(
                    filtered.low <= exact.high && exact.low <= filtered.high,
                    "{filtered:?} is not {exact:?}"
                );
            }
            (verdict, _) => panic!("{verdict:?} but {exact:?}"),
        }
        exact.map(|bracket| 0.5 * (bracket.low + bracket.high))
    }

    #[test]
    fn is_a_closed_set() {
        for (x, y) in [
            (0.0, 0.0),
            (4.0, 0.0),
            (0.0, 4.0),
            (2.0, 2.0),
            (2.0, 0.0),
            (1.0, 1.0),
        ] {
            assert_eq!(intersect(&RIGHT, &along_z(x, y)), Some(4.0), "({x}, {y})");
        }
        for (x, y) in [(-1e-300, 0.0), (2.0, 2.0000000000000004), (5.0, -1.0)] {
            assert_eq!(intersect(&RIGHT, &along_z(x, y)), None, "({x}, {y})");
        }
    }

    #[test]
    fn both_sides_count_and_the_way_back_does_not() {
        let [a, b, c] = RIGHT.0;
        assert_eq!(
            intersect(&Triangle([a, c, b]), &along_z(1.0, 1.0)),
            Some(4.0)
        );
        let behind = Ray {
            origin: Point::new(1.0, 1.0, 3.0),
            ..along_z(1.0, 1.0)
        };
        assert_eq!(intersect(&RIGHT, &behind), None);
        let on_it = Ray {
            origin: Point::new(1.0, 1.0, 2.0),
            ..along_z(1.0, 1.0)
        };
        assert_eq!(intersect(&RIGHT, &on_it), None);
    }

    #[test]
    fn a_ray_in_its_plane_misses() {
        let ray = Ray {
            origin: Point::new(-1.0, 1.0, 2.0),
            direction: Vector::new(1.0, 0.0, 0.0),
        };
        assert_eq!(intersect(&RIGHT, &ray), None);
    }

    #[test]
    fn knows_what_can_never_be_hit() {
        let point = |x: f64| Point::new(x, 3.0 * x, 7.0 * x);
        assert!(RIGHT.can_be_hit());
        assert!(
            !Triangle([point(1.0), point(1.0), point(2.0)]).can_be_hit(),
            "two corners in one place"
        );
        assert!(
            !Triangle([point(1.0), point(2.0), point(4.0)]).can_be_hit(),
            "collinear"
        );
        // Exactly on a line, though no difference is exact.
        let large = 2f64.powi(53);
        let line = [
            Point::new(-large, -3.0 * large, 0.0),
            Point::new(1.0, 3.0, 0.0),
            Point::new(3.0, 9.0, 0.0),
        ];
        assert!(!Triangle(line).can_be_hit());
        let bent = Point::new(2.0, 6.0, f64::from_bits(14f64.to_bits() + 1));
        assert!(
            Triangle([point(1.0), bent, point(4.0)]).can_be_hit(),
            "collinear but for one bit"
        );
        assert!(!Triangle([point(1.0), point(2.0), Point::new(0.0, f64::NAN, 0.0)]).can_be_hit());
        let tiny = |x: f64, y: f64| Point::new(x * 1e-310, y * 1e-310, 1e-310);
        assert!(
            Triangle([tiny(0.0, 0.0), tiny(1.0, 0.0), tiny(0.0, 1.0)]).can_be_hit(),
            "products underflow"
        );
    }
}
