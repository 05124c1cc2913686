//! A triangle.

use super::Solid;
use crate::geometry::Geometry;
use glam::Vec3A;

/// A corner, the edges from it, and the normal: all that the test needs.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Triangle {
    corner: Vec3A,
    edge1: Vec3A,
    edge2: Vec3A,
    normal: Vec3A,
}

impl Triangle {
    fn new([a, b, c]: [Vec3A; 3]) -> Triangle {
        let (edge1, edge2) = (b - a, c - a);
        Triangle {
            corner: a,
            edge1,
            edge2,
            normal: edge1.cross(edge2),
        }
    }
}

impl Solid for Triangle {
    fn all_of(geometry: &Geometry) -> Vec<Triangle> {
        let Geometry::Triangles {
            vertices,
            triangles,
        } = geometry
        else {
            return Vec::new();
        };
        let triangle = |corners: &[u32; 3]| {
            Triangle::new(corners.map(|corner| vertices[corner as usize].into()))
        };
        triangles.iter().map(triangle).collect()
    }

    #[inline]
    fn bounds(&self) -> [Vec3A; 2] {
        let (b, c) = (self.corner + self.edge1, self.corner + self.edge2);
        [self.corner.min(b).min(c), self.corner.max(b).max(c)]
    }

    /// Möller and Trumbore, 1997, from both sides, with the normal made beforehand.
    #[inline]
    fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<f32> {
        let inverse = 1.0 / self.normal.dot(direction);
        let to_corner = self.corner - origin;
        let across = to_corner.cross(direction);
        let (u, v) = (
            across.dot(self.edge2) * inverse,
            -across.dot(self.edge1) * inverse,
        );
        let t = self.normal.dot(to_corner) * inverse;
        // No branch until all is known: they are hard to foresee.
        ((u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (t > 0.0) & (t < t_max)).then_some(t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3a;

    #[test]
    fn hits_from_both_sides_within_the_edges_only() {
        let triangle = Triangle::new([
            vec3a(0.0, 0.0, 2.0),
            vec3a(4.0, 0.0, 2.0),
            vec3a(0.0, 4.0, 2.0),
        ]);
        let ahead = vec3a(0.0, 0.0, 1.0);
        let hit = |x, y, direction| triangle.intersect(vec3a(x, y, 0.0), direction, f32::INFINITY);
        assert_eq!(hit(1.0, 1.0, ahead), Some(2.0));
        assert_eq!(hit(1.0, 1.0, -ahead), None, "behind");
        assert_eq!(
            triangle.intersect(vec3a(1.0, 1.0, 5.0), -ahead, 9.0),
            Some(3.0),
            "from the other side"
        );
        assert_eq!(
            triangle.intersect(vec3a(1.0, 1.0, 5.0), -ahead, 2.0),
            None,
            "too far"
        );
        assert_eq!(
            [
                hit(-0.1, 1.0, ahead),
                hit(1.0, -0.1, ahead),
                hit(2.1, 2.1, ahead)
            ],
            [None; 3]
        );
        assert_eq!([hit(3.5, 0.2, ahead), hit(0.2, 3.5, ahead)], [Some(2.0); 2]);
    }
}
