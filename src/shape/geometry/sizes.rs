//! The number of primitives, and their memory.

use super::Geometry;
use std::collections::HashSet;

impl Geometry {
    /// The number of primitives in no instance, including those left out.
    pub(super) fn number_count(&self) -> u64 {
        self.own_count() as u64 + u64::from(self.left_out)
    }

    /// The number of primitives in no instance, without those left out.
    pub fn own_count(&self) -> usize {
        self.triangles.len() + self.curved_count()
    }

    /// The number of triangles in no instance, including those that can never be hit.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The number of quadrics in no instance, including those that can never be hit.
    pub fn quadric_count(&self) -> usize {
        self.quadrics.len()
    }

    /// The number of triangles; those of an object count once.
    pub fn stored_triangles(&self) -> usize {
        let of_objects = self.objects.iter().map(Geometry::stored_triangles);
        self.triangles.len() + of_objects.sum::<usize>()
    }

    /// The number of quadrics; those of an object count once.
    pub fn stored_quadrics(&self) -> usize {
        let of_objects = self.objects.iter().map(Geometry::stored_quadrics);
        self.quadrics.len() + of_objects.sum::<usize>()
    }

    /// The number of segments of curves; those of an object count once.
    pub fn stored_segments(&self) -> usize {
        let of_objects = self.objects.iter().map(Geometry::stored_segments);
        self.segment_count() + of_objects.sum::<usize>()
    }

    /// The memory that the geometry takes, in bytes.
    pub fn bytes(&self) -> usize {
        self.bytes_but_known(&mut HashSet::new())
    }

    /// The same, without images that are `known`, and adds those that are not.
    fn bytes_but_known(&self, known: &mut HashSet<usize>) -> usize {
        size_of_val(&self.vertices[..])
            + size_of_val(&self.triangles[..])
            + size_of_val(&self.meshes[..])
            + size_of_val(&self.quadrics[..])
            + size_of_val(&self.quadric_runs[..])
            + self.forms.bytes()
            + size_of_val(&self.patch_runs[..])
            + self.curves.bytes()
            + size_of_val(&self.transforms[..])
            + size_of_val(&self.instances[..])
            + self
                .attributes
                .as_ref()
                .map_or(0, |attributes| attributes.bytes())
            + self
                .cut_outs
                .as_ref()
                .map_or(0, |cut_outs| cut_outs.bytes(known))
            + self
                .objects
                .iter()
                .map(|object| size_of::<Geometry>() + object.bytes_but_known(known))
                .sum::<usize>()
    }
}
