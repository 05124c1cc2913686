//! Baseline kernels: the usual ones of other renderers, in `f32` without error bounds. `bench`
//! compares speed and errors with them; `render` never uses them.

mod moeller_trumbore;
mod quadric;
mod ray32;
mod segment;
mod watertight;

use crate::accel::{Depth, Tracer, TraversalCounts};
use crate::geometry::{Point, Ray};
use crate::parallel::CollectVec;
use crate::shape::vector32::dot;
use crate::shape::{
    FilterRay, Geometry, InstancedId, Primitive, PrimitiveKind, SpaceCache, Triangle,
};
use quadric::{Quadratic, Quadric32};
use ray32::{Corners, Ray32};
use rayon::prelude::*;

/// The baseline kernels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Baseline {
    /// The triangle of Moeller and Trumbore (1997), quadrics by the textbook quadratic formula.
    MoellerTrumbore,
    /// The watertight triangle of Woop, Benthin and Wald (2013), quadrics by pbrt's formula.
    Watertight,
}

/// A baseline kernel with its geometry: in world space, rounded to `f32`.
pub struct BaselineKernel<'a> {
    baseline: Baseline,
    geometry: &'a Geometry,
    /// The triangles in no instance. Others are rounded when they are tested.
    triangles: Vec<Corners>,
    /// The quadrics in no instance.
    quadrics: Vec<Quadric32>,
}

impl<'a> BaselineKernel<'a> {
    /// Rounds all `geometry`.
    pub fn new(baseline: Baseline, geometry: &'a Geometry) -> BaselineKernel<'a> {
        let triangle = |index| corners(&geometry.triangle(index));
        BaselineKernel {
            baseline,
            geometry,
            triangles: (0..geometry.triangle_count())
                .into_par_iter()
                .map(triangle)
                .collect_vec(),
            quadrics: (0..geometry.quadric_count())
                .map(|index| Quadric32::new(&geometry.quadric(index)))
                .collect(),
        }
    }

    /// A function from a primitive to the `t` at which `ray` hits it.
    #[inline]
    pub fn of_ray(&self, ray: &Ray) -> impl FnMut(InstancedId) -> Option<f32> {
        let (world_ray, ray) = (*ray, Ray32::new(ray));
        move |placed| match self.geometry.alpha_of(placed) {
            None => self.intersect(&ray, placed),
            Some(_) => self.intersect_cut_out(&world_ray, &ray, placed),
        }
    }

    /// The closest hit of `ray` and its depth.
    #[inline]
    pub fn closest_hit(&self, tracer: &mut Tracer, ray: &Ray) -> Option<(InstancedId, Depth)> {
        let hit = tracer.closest_hit_by::<false>(
            ray,
            self.of_ray(ray),
            &mut TraversalCounts::default(),
        )?;
        let z = hit.t.low as f32;
        let direction = ray.direction.to_array().map(|component| component as f32);
        let distance = z * dot(direction, direction).sqrt();
        Some((hit.primitive, Depth { z, distance }))
    }

    #[inline]
    fn intersect(&self, ray: &Ray32, placed: InstancedId) -> Option<f32> {
        let primitive = placed.primitive();
        let index = primitive.index();
        match (placed.instance(), primitive.kind()) {
            (None, PrimitiveKind::Triangle) => self.hit_triangle(ray, &self.triangles[index]),
            (None, PrimitiveKind::Quadric) => self.hit_quadric(ray, &self.quadrics[index]),
            _ => match self.geometry.surface(placed) {
                Primitive::Triangle(triangle) => self.hit_triangle(ray, &corners(&triangle)),
                Primitive::Quadric(quadric) => self.hit_quadric(ray, &Quadric32::new(&quadric)),
                Primitive::Segment(segment) => segment::intersect(ray, &segment),
            },
        }
    }

    /// The hit with a primitive that has an alpha, which decides whether it counts. Kernels differ
    /// in triangles and segments only: the hit of a quadric is the exact one, rounded.
    #[cold]
    fn intersect_cut_out(&self, ray: &Ray, ray32: &Ray32, placed: InstancedId) -> Option<f32> {
        if placed.primitive().kind() != PrimitiveKind::Quadric {
            let t = self.intersect(ray32, placed)?;
            return self.geometry.keeps(placed, ray, 0).then_some(t);
        }
        let surface = self.geometry.surface(placed);
        if !surface.can_be_hit() {
            return None;
        }
        let (ray, mut spaces) = (FilterRay::new(ray), SpaceCache::default());
        let t = self
            .geometry
            .t_of_kept(placed, &surface, &ray, &mut spaces)?;
        Some(t.low as f32)
    }

    #[inline]
    fn hit_triangle(&self, ray: &Ray32, corners: &Corners) -> Option<f32> {
        match self.baseline {
            Baseline::MoellerTrumbore => moeller_trumbore::intersect(ray, corners),
            Baseline::Watertight => watertight::intersect(ray, corners),
        }
    }

    fn hit_quadric(&self, ray: &Ray32, quadric: &Quadric32) -> Option<f32> {
        let quadratic = match self.baseline {
            Baseline::MoellerTrumbore => Quadratic::Textbook,
            Baseline::Watertight => Quadratic::Pbrt,
        };
        quadric.intersect(ray, quadratic)
    }
}

fn corners(triangle: &Triangle) -> Corners {
    triangle
        .0
        .map(|corner: Point| corner.to_array().map(|x| x as f32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Vector};
    use crate::reference;
    use crate::shape::{Cut, Disk, Form};
    use proptest::prelude::*;

    const BOTH: [Baseline; 2] = [Baseline::MoellerTrumbore, Baseline::Watertight];

    /// The answers of the reference and of each kernel.
    fn answers(geometry: &Geometry, ray: &Ray) -> (Option<f32>, [Option<f32>; 2]) {
        let nearest = |baseline| {
            let kernel = BaselineKernel::new(baseline, geometry);
            let hits = geometry.all().filter_map(kernel.of_ray(ray));
            hits.min_by(f32::total_cmp)
        };
        (
            reference::closest_hit(geometry, ray).map(|hit| hit.z),
            BOTH.map(nearest),
        )
    }

    fn agree(exact: Option<f32>, baseline: Option<f32>, tolerance: f32) -> bool {
        match (exact, baseline) {
            (None, None) => true,
            (Some(exact), Some(baseline)) => (exact - baseline).abs() <= tolerance * exact,
            _ => false,
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// All agree if the ray passes edges at a distance of at least a thousandth.
        #[test]
        fn triangles_are_hit_if_no_edge_is_close(
            corners in prop::array::uniform3(prop::array::uniform3(-1.0f64..1.0)),
            weights in prop::array::uniform3(-1.0f64..2.0),
            eye in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let sum: f64 = weights.iter().sum();
            let is_inside = |weight: &f64| (weight / sum).abs() > 1e-3;
            prop_assume!(sum.abs() > 0.1 && weights.iter().all(is_inside));
            let target = |k: usize| (0..3).map(|i| weights[i] / sum * corners[i][k]).sum::<f64>();
            let (origin, target) = (Point::from(eye), Point::new(target(0), target(1), target(2)));
            let ray = Ray { origin, direction: target - origin };
            let [a, b, c] = corners.map(Point::from);
            let normal = (b - a).cross(c - a);
            // Nearly edge-on and tiny triangles are close everywhere.
            prop_assume!(normal.dot(ray.direction).abs() > 1e-2);
            let mut geometry = Geometry::default();
            geometry.add_mesh(vec![a, b, c], vec![[0, 1, 2]], &Matrix::IDENTITY, 1).unwrap();
            let (exact, baseline) = answers(&geometry, &ray);
            let all_agree = baseline.iter().all(|baseline| agree(exact, *baseline, 1e-3));
            prop_assert!(all_agree, "{exact:?} {baseline:?}");
        }

        /// Surfaces of size 1 seen from nearby, without grazing rays.
        #[test]
        fn quadrics_are_hit_if_no_rim_is_close(
            form in prop::sample::select(vec![
                Form::Sphere(None),
                Form::Sphere(Cut::new(1.0, -0.5, 0.75, 300.0)),
                Form::Cylinder(Cut::of_cylinder(-1.0, 1.0, 360.0)),
                Form::Cylinder(Cut::of_cylinder(-1.0, 0.5, 135.0)),
                Form::Disk(Disk::new(0.25, 0.125, 360.0)),
                Form::Disk(Disk::new(0.0, 0.0, 45.0)),
            ]),
            eye in prop::array::uniform3(-4.0f64..4.0),
            target in prop::array::uniform3(-1.5f64..1.5),
            offset in -2.0f64..2.0,
        ) {
            let ray = |nudge: f64| {
                let origin = Point::from(eye);
                let direction = Point::from(target) - origin;
                let [x, y, z] = direction.to_array();
                Ray { origin, direction: Vector::new(x + nudge, y - nudge, z + nudge) }
            };
            let mut geometry = Geometry::default();
            let transform = geometry.add_transform(Matrix::translate([offset, 0.0, -offset]));
            geometry.add_quadric(1.0, form, transform, 1).unwrap();
            // If rays beside this one differ much from it, it is close to a rim.
            let z = |nudge| reference::closest_hit(&geometry, &ray(nudge)).map(|hit| hit.z);
            let beside = [-1e-2, 0.0, 1e-2].map(z);
            prop_assume!(beside.iter().all(|z| agree(*z, beside[1], 0.1)));
            let (exact, baseline) = answers(&geometry, &ray(0.0));
            let all_agree = baseline.iter().all(|baseline| agree(exact, *baseline, 1e-2));
            prop_assert!(all_agree, "{exact:?} {baseline:?}");
        }
    }

    #[test]
    fn instances_are_hit() {
        let mut object = Geometry::default();
        let transform = object.add_transform(Matrix::IDENTITY);
        object.add_sphere(1.0, None, transform, 1).unwrap();
        let mut geometry = Geometry::default();
        let number = geometry.add_object(object);
        geometry
            .add_instance(number, Matrix::translate([0.0, 0.0, 5.0]))
            .unwrap();
        let ray = Ray {
            origin: Point::new(0.0, 0.0, 0.0),
            direction: Vector::new(0.0, 0.0, 2.0),
        };
        assert_eq!(answers(&geometry, &ray), (Some(2.0), [Some(2.0); 2]));
    }
}
