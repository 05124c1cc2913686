//! Random points on the surfaces of a scene, to estimate the overlap of trees.

use crate::accel::Aggregate;
use crate::bench::trace::Random;
use crate::geometry::Point;
use crate::parallel::CollectVec;
use crate::shape::{Geometry, PrimitiveId};
use rayon::prelude::*;

/// Number of points; the standard error of an overlap is about a percent.
const COUNT: usize = 1 << 14;

/// Points on triangles, distributed evenly over their area.
pub(super) struct SurfacePoints(Vec<(PrimitiveId, Point)>);

impl SurfacePoints {
    /// Chooses the points. `None` if the scene has quadrics or instances, or no finite area.
    pub(super) fn of(geometry: &Geometry, random: &mut Random) -> Option<SurfacePoints> {
        if geometry.curved_count() > 0 || !geometry.instances().is_empty() {
            return None;
        }
        let area = |index| {
            let [a, b, c] = geometry.triangle(index).0;
            let normal = (b - a).cross(c - a);
            let area = normal.dot(normal).sqrt();
            if area.is_finite() { area } else { 0.0 }
        };
        let indices = (0..geometry.triangle_count()).into_par_iter();
        let mut up_to: Vec<f64> = indices.map(area).collect_vec();
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
            // One half of a parallelogram (Turk, "Generating random points in triangles", Graphics
            // Gems, 1990).
            let (u, v) = match (unit(), unit()) {
                (u, v) if u + v > 1.0 => (1.0 - u, 1.0 - v),
                pair => pair,
            };
            let [a, b, c] = geometry.triangle(index).0;
            (PrimitiveId::triangle(index), a + (b - a) * u + (c - a) * v)
        };
        Some(SurfacePoints((0..COUNT).map(|_| point()).collect()))
    }

    /// The end-point overlap of a tree over the same scene: the mean over all points.
    pub(super) fn overlap(&self, aggregate: &Aggregate) -> f64 {
        // In order, so that the sum does not depend on threads.
        let points = self.0.par_iter();
        let costs = points.map(|(primitive, point)| aggregate.overlap_at(*primitive, *point));
        let costs: Vec<f64> = costs.collect_vec();
        costs.iter().sum::<f64>() / costs.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Matrix;

    #[test]
    fn points_are_even_over_the_area_and_lie_within_triangles() {
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
    fn quadrics_and_empty_scenes_have_no_points() {
        let mut geometry = Geometry::default();
        assert!(SurfacePoints::of(&geometry, &mut Random::new(3)).is_none());
        let transform = geometry.add_transform(Matrix::IDENTITY);
        geometry.add_sphere(1.0, None, transform, 1).unwrap();
        assert!(SurfacePoints::of(&geometry, &mut Random::new(3)).is_none());
    }
}
