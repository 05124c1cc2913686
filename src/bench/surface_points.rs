//! Points at random on the surfaces of a scene.

use super::random::Random;
use crate::accel::Aggregate;
use crate::geometry::Point;
use crate::shape::{Geometry, PrimitiveId};
use rayon::prelude::*;

/// Points that estimate an overlap: the standard error is a percent or so.
const COUNT: usize = 1 << 14;

/// Points on triangles, each part of the surface as likely as any other of its area.
pub(super) struct SurfacePoints(Vec<(PrimitiveId, Point)>);

impl SurfacePoints {
    /// `None` where there is more than triangles, instances among it, or no area that is a number.
    pub(super) fn of(geometry: &Geometry, random: &mut Random) -> Option<SurfacePoints> {
        if geometry.quadric_count() > 0 || !geometry.instances().is_empty() {
            return None;
        }
        let area = |index| {
            let [a, b, c] = geometry.triangle(index).0;
            let normal = (b - a).cross(c - a);
            let area = normal.dot(normal).sqrt();
            if area.is_finite() { area } else { 0.0 }
        };
        let mut up_to: Vec<f64> = (0..geometry.triangle_count())
            .into_par_iter()
            .map(area)
            .collect();
        let mut sum = 0.0;
        up_to.iter_mut().for_each(|area| {
            sum += *area;
            *area = sum;
        });
        if !(sum > 0.0 && sum.is_finite()) {
            return None;
        }
        let mut unit = || random.next() as f64 / 2f64.powi(64);
        let mut point = || {
            let target = unit() * sum;
            let index = up_to
                .partition_point(|sum| *sum <= target)
                .min(up_to.len() - 1);
            // Of a parallelogram the half (Turk, "Generating random points in triangles", Graphics Gems, 1990).
            let (u, v) = match (unit(), unit()) {
                (u, v) if u + v > 1.0 => (1.0 - u, 1.0 - v),
                pair => pair,
            };
            let [a, b, c] = geometry.triangle(index).0;
            (PrimitiveId::triangle(index), a + (b - a) * u + (c - a) * v)
        };
        Some(SurfacePoints((0..COUNT).map(|_| point()).collect()))
    }

    /// The end-point overlap of a tree over the same scene, by the mean over all points.
    pub(super) fn overlap(&self, aggregate: &Aggregate) -> f64 {
        // Added in order: a sum should not depend on threads.
        let costs: Vec<f64> = self
            .0
            .par_iter()
            .map(|(primitive, point)| aggregate.overlap_at(*primitive, *point))
            .collect();
        costs.iter().sum::<f64>() / costs.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Matrix;

    #[test]
    fn large_triangles_get_more_points_and_all_lie_within() {
        let corner = |x: f64, y: f64| Point::new(x, y, 0.0);
        let vertices = [
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(0.0, 1.0),
            corner(5.0, 0.0),
            corner(8.0, 0.0),
            corner(5.0, 1.0),
        ];
        let mut geometry = Geometry::default();
        geometry
            .add_mesh(
                vertices.to_vec(),
                vec![[0, 1, 2], [0, 0, 0], [3, 4, 5]],
                &Matrix::IDENTITY,
                1,
            )
            .unwrap();
        let SurfacePoints(points) = SurfacePoints::of(&geometry, &mut Random::new(3)).unwrap();
        let on_first = points
            .iter()
            .filter(|(primitive, _)| primitive.index() == 0)
            .count();
        assert!(on_first.abs_diff(COUNT / 4) < COUNT / 50, "{on_first}");
        for (primitive, point) in points {
            match primitive.index() {
                0 => assert!(point.x >= 0.0 && point.y >= 0.0 && point.x + point.y <= 1.0 + 1e-12),
                2 => assert!(
                    point.x >= 5.0
                        && point.y >= 0.0
                        && (point.x - 5.0) / 3.0 + point.y <= 1.0 + 1e-12
                ),
                _ => panic!("a triangle without area"),
            }
        }
    }

    #[test]
    fn spheres_and_nothing_have_no_overlap() {
        let mut geometry = Geometry::default();
        assert!(SurfacePoints::of(&geometry, &mut Random::new(3)).is_none());
        let transform = geometry.add_transform(Matrix::IDENTITY);
        geometry.add_sphere(1.0, None, transform, 1).unwrap();
        assert!(SurfacePoints::of(&geometry, &mut Random::new(3)).is_none());
    }
}
