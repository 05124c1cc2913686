//! Numbers of primitives and shapes, which follow the file.

use super::{FirstNumber, Geometry};
use crate::geometry::Matrix;
use crate::shape::{InstancedId, PrimitiveId};
use std::ops::Range;

impl Geometry {
    /// The primitive number, from 0 in the order of the file (rule E3).
    #[inline]
    pub fn number(&self, placed: InstancedId) -> u64 {
        match placed.instance() {
            None => self.own_number(placed.primitive()).in_all(),
            Some(instance) => {
                let within = self
                    .object_of(instance)
                    .geometry()
                    .own_number(placed.primitive())
                    .alone;
                self.instances[instance].first_number() + u64::from(within)
            }
        }
    }

    /// What `prim` channels call a primitive: its number plus 1, counted within the instance, or among the primitives that are in
    /// none, if there are [too many](Geometry::counts_within_instances).
    #[inline]
    pub fn image_number(&self, placed: InstancedId) -> u32 {
        if !self.counts_within_instances() {
            return self.number(placed) as u32 + 1;
        }
        let geometry = placed
            .instance()
            .map_or(self, |instance| self.object_of(instance).geometry());
        geometry.own_number(placed.primitive()).alone + 1
    }

    /// The number of a primitive that is in no instance.
    #[inline]
    fn own_number(&self, primitive: PrimitiveId) -> FirstNumber {
        let index = primitive.index() as u32;
        let (first, place) = if primitive.is_quadric() {
            let run = &self.quadric_runs[self
                .quadric_runs
                .partition_point(|run| run.first_quadric <= index)
                - 1];
            (run.first_number, index - run.first_quadric)
        } else {
            let run = self.mesh_of(index);
            (run.first_number, index - run.first_triangle)
        };
        FirstNumber {
            alone: first.alone + place,
            ..first
        }
    }

    /// The triangles of the mesh that a triangle belongs to.
    pub(in crate::shape) fn mesh_around(&self, triangle: u32) -> Range<u32> {
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

    /// The transform of the mesh of an object that a triangle belongs to.
    #[inline]
    pub(crate) fn transform_of_mesh(&self, triangle: u32) -> &Matrix {
        let number = self
            .mesh_of(triangle)
            .transform
            .expect("meshes of objects keep their transforms");
        &self.transforms[number as usize]
    }

    /// The number of the `Shape` statement, from 1.
    #[inline]
    pub fn shape_number(&self, placed: InstancedId) -> u32 {
        let geometry = placed
            .instance()
            .map_or(self, |instance| self.object_of(instance).geometry());
        let primitive = placed.primitive();
        if primitive.is_quadric() {
            geometry.quadrics[primitive.index()].shape
        } else {
            geometry.mesh_of(primitive.index() as u32).shape
        }
    }

    /// Whether `a` comes before `b` in the file: it wins a tie (rule E3).
    pub fn precedes(&self, a: InstancedId, b: InstancedId) -> bool {
        let (p, q) = (a.primitive(), b.primitive());
        if a.instance() == b.instance() && p.is_quadric() == q.is_quadric() {
            p < q
        } else {
            self.number(a) < self.number(b)
        }
    }
}
