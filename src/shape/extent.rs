//! The box around a scene.

use super::{Geometry, Pose, Primitive, PrimitiveId, ShapeRun};
use crate::geometry::{Bounds, Matrix};
use crate::parallel::CollectVec;
use rayon::prelude::*;

impl Geometry {
    /// The box in the world around all primitives that can be hit; empty if there are none. An
    /// instance counts with the box around its object's box, which may be too large.
    pub fn extent(&self) -> Bounds {
        let objects = self.extents_of_objects();
        let placed = (0..self.instances().len()).into_par_iter();
        let placed = placed.map(|instance| self.extent_of_instance(instance, &objects));
        let placed = placed.reduce(|| Bounds::EMPTY, Bounds::union);
        placed.union(self.extent_of(self.own_count(), &self.own_ids()))
    }

    /// The box around the primitives of a run that can be hit.
    pub fn extent_of_run(&self, run: &ShapeRun) -> Bounds {
        self.extent_of(run.count(), &|place| run.primitive(place))
    }

    /// The box around `count` primitives that can be hit.
    fn extent_of(&self, count: usize, ids: &(dyn Fn(usize) -> PrimitiveId + Sync)) -> Bounds {
        let places = (0..count).into_par_iter().with_min_len(1 << 12);
        places
            .map(|place| extent_of(&self.own_surface(ids(place))))
            .reduce(|| Bounds::EMPTY, Bounds::union)
    }

    /// The boxes around the objects, in the space of their instances.
    pub fn extents_of_objects(&self) -> Vec<Bounds> {
        let objects = self.objects().par_iter();
        objects.map(Geometry::extent_of_object).collect_vec()
    }

    /// The box in the world around the box of an instance's object, one of `objects`.
    pub fn extent_of_instance(&self, instance: usize, objects: &[Bounds]) -> Bounds {
        let instance = &self.instances()[instance];
        let corners = objects[instance.object()].corners();
        let corners = corners.map(|corner| instance.world_from_instance().apply(corner));
        Bounds::of(corners.into_iter().filter(|corner| corner.is_finite()))
    }

    fn extent_of_object(&self) -> Bounds {
        let mut pose = Pose::new(self, Matrix::IDENTITY);
        let surfaces = self.primitives().map(|primitive| pose.surface(primitive));
        let bounds = surfaces.map(|surface| extent_of(&surface));
        bounds.fold(Bounds::EMPTY, Bounds::union)
    }
}

/// The box around a primitive, if it can be hit.
fn extent_of(surface: &Primitive) -> Bounds {
    if surface.can_be_hit() {
        surface.bounds()
    } else {
        Bounds::EMPTY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    fn triangle(corners: [[f64; 3]; 3]) -> Vec<Point> {
        corners.map(|[x, y, z]| Point::new(x, y, z)).to_vec()
    }

    #[test]
    fn holds_all_that_can_be_hit() {
        let mut geometry = Geometry::default();
        assert!(geometry.extent().is_empty());
        let dead = triangle([[9.0, 9.0, 9.0]; 3]);
        geometry
            .add_mesh(dead, vec![[0, 1, 2]], &Matrix::IDENTITY, 1)
            .unwrap();
        assert!(geometry.extent().is_empty());
        let corners = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
        geometry
            .add_mesh(
                corners.clone(),
                vec![[0, 1, 2]],
                &Matrix::translate([0.0, 0.0, 3.0]),
                2,
            )
            .unwrap();
        let around = |low: [f64; 3], high: [f64; 3]| Bounds {
            low: low.into(),
            high: high.into(),
        };
        assert_eq!(geometry.extent(), around([0.0, 0.0, 3.0], [1.0, 2.0, 3.0]));
        let mut object = Geometry::default();
        let transform = object.add_transform(Matrix::scale([2.0, 2.0, 2.0]));
        object
            .add_object_mesh(corners, vec![[0, 1, 2]], transform, 3)
            .unwrap();
        let number = geometry.add_object(object);
        assert_eq!(geometry.extent().low.z, 3.0, "nothing shows the object");
        geometry
            .add_instance(number, Matrix::scale([-1.0, 1.0, 1.0]))
            .unwrap();
        assert_eq!(geometry.extent(), around([-2.0, 0.0, 0.0], [1.0, 4.0, 3.0]));
        geometry
            .add_instance(number, Matrix::scale([f64::NAN, 1.0, 1.0]))
            .unwrap();
        assert_eq!(geometry.extent().low.x, -2.0);
    }
}
