//! A sphere.

use super::Solid;
use crate::geometry::Geometry;
use glam::{Vec3A, vec3a};

/// A centre and a radius.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Ball {
    centre: Vec3A,
    radius: f32,
}

impl Solid for Ball {
    fn all_of(geometry: &Geometry) -> Vec<Ball> {
        let Geometry::Spheres(spheres) = geometry else {
            return Vec::new();
        };
        spheres
            .iter()
            .map(|&[x, y, z, radius]| Ball {
                centre: vec3a(x, y, z),
                radius,
            })
            .collect()
    }

    #[inline]
    fn bounds(&self) -> [Vec3A; 2] {
        [self.centre - self.radius, self.centre + self.radius]
    }

    /// From the point of the ray nearest to the centre half a chord back, or forth where that is behind the origin.
    #[inline]
    fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<f32> {
        let inverse = 1.0 / direction.length_squared();
        let to_centre = self.centre - origin;
        let middle = to_centre.dot(direction) * inverse;
        let off = to_centre - direction * middle;
        let square = (self.radius * self.radius - off.length_squared()) * inverse;
        if square < 0.0 {
            return None;
        }
        let half = square.sqrt();
        let t = if middle - half > 0.0 {
            middle - half
        } else {
            middle + half
        };
        (t > 0.0 && t < t_max).then_some(t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_hit_from_outside_and_inside() {
        let ball = Ball {
            centre: vec3a(0.0, 0.0, 10.0),
            radius: 2.0,
        };
        let hit = |z, direction| {
            ball.intersect(
                vec3a(0.0, 0.0, z),
                vec3a(0.0, 0.0, direction),
                f32::INFINITY,
            )
        };
        assert_eq!(
            [hit(0.0, 2.0), hit(10.0, 2.0), hit(20.0, 2.0)],
            [Some(4.0), Some(1.0), None]
        );
        assert_eq!(
            ball.intersect(vec3a(0.0, 3.0, 0.0), vec3a(0.0, 0.0, 1.0), f32::INFINITY),
            None
        );
        assert_eq!(ball.intersect(Vec3A::ZERO, vec3a(0.0, 0.0, 1.0), 7.0), None);
    }
}
