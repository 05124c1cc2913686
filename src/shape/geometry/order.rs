//! The numbers of primitives and shapes, in the order of the file.

use super::Geometry;
use super::runs::{FirstNumber, QuadricRun};
use crate::geometry::Matrix;
use crate::shape::{InstancedId, PrimitiveId, PrimitiveKind};
use std::ops::Range;

impl Geometry {
    /// The primitive number, counted from 0 in the order of the file (rule E3).
    #[inline]
    pub fn number(&self, placed: InstancedId) -> u64 {
        match placed.instance() {
            None => self.own_number(placed.primitive()).in_all(),
            Some(instance) => {
                let within = self
                    .object_of(instance)
                    .own_number(placed.primitive())
                    .alone;
                self.instances[instance].first_number() + u64::from(within)
            }
        }
    }

    /// The number of a primitive in `prim` channels, counted from 1: in the whole scene or, if
    /// there are [too many](Geometry::counts_within_instances), within the instance or among the
    /// primitives in none.
    #[inline]
    pub fn image_number(&self, placed: InstancedId) -> u32 {
        if !self.counts_within_instances() {
            return self.number(placed) as u32 + 1;
        }
        self.owner_of(placed).own_number(placed.primitive()).alone + 1
    }

    /// The number of a primitive in no instance.
    #[inline]
    fn own_number(&self, primitive: PrimitiveId) -> FirstNumber {
        let index = primitive.index() as u32;
        let (first, place) = match primitive.kind() {
            PrimitiveKind::Triangle => {
                let run = self.mesh_of(index);
                (run.first_number, index - run.first_triangle)
            }
            PrimitiveKind::Quadric => {
                let starts = |run: &QuadricRun| run.first_quadric <= index;
                let run = &self.quadric_runs[self.quadric_runs.partition_point(starts) - 1];
                (run.first_number, index - run.first_quadric)
            }
            PrimitiveKind::Segment => {
                let run = self.curves.run_of(index);
                (run.first_number, index - run.first_segment)
            }
        };
        FirstNumber {
            alone: first.alone + place,
            ..first
        }
    }

    /// The geometry that stores a primitive: the scene, or an object.
    #[inline]
    pub(crate) fn owner_of(&self, placed: InstancedId) -> &Geometry {
        match placed.instance() {
            None => self,
            Some(instance) => self.object_of(instance),
        }
    }

    /// The radius of quadric `index`, which lies beside the number of its transform.
    #[inline]
    pub(crate) fn radius_of_quadric(&self, index: usize) -> &f64 {
        &self.quadrics[index].radius
    }

    /// The transform of quadric `index`.
    #[inline]
    pub(crate) fn transform_of_quadric(&self, index: usize) -> &Matrix {
        self.transform(self.quadrics[index].transform)
    }

    /// The triangles of the mesh of a triangle.
    pub(crate) fn mesh_around(&self, triangle: u32) -> Range<u32> {
        let mesh = self
            .meshes
            .partition_point(|run| run.first_triangle <= triangle)
            - 1;
        let end = self
            .meshes
            .get(mesh + 1)
            .map_or(u32::MAX, |next| next.first_triangle);
        self.meshes[mesh].first_triangle..end
    }

    /// The transform of the mesh of a triangle in an object.
    #[inline]
    pub(crate) fn transform_of_mesh(&self, triangle: u32) -> &Matrix {
        let number = self
            .mesh_of(triangle)
            .transform
            .expect("meshes of objects keep their transforms");
        &self.transforms[number as usize]
    }

    /// The number of the `Shape` statement, counted from 1.
    #[inline]
    pub fn shape_number(&self, placed: InstancedId) -> u32 {
        let geometry = self.owner_of(placed);
        let primitive = placed.primitive();
        let index = primitive.index();
        match primitive.kind() {
            PrimitiveKind::Triangle => geometry.mesh_of(index as u32).shape,
            PrimitiveKind::Quadric => geometry.quadrics[index].shape,
            PrimitiveKind::Segment => geometry.curves.run_of(index as u32).shape,
        }
    }

    /// Whether `a` comes before `b` in the file, and so wins a tie (rule E3).
    pub fn precedes(&self, a: InstancedId, b: InstancedId) -> bool {
        let (p, q) = (a.primitive(), b.primitive());
        if a.instance() == b.instance() && p.kind() == q.kind() {
            p < q
        } else {
            self.number(a) < self.number(b)
        }
    }
}
