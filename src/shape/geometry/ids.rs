//! The ids of the primitives in no instance.

use super::Geometry;
use crate::shape::PrimitiveId;
use rayon::prelude::*;

impl Geometry {
    /// All primitives in no instance, kind by kind.
    pub fn primitives(&self) -> impl Iterator<Item = PrimitiveId> + use<> {
        let triangles = (0..self.triangles.len()).map(PrimitiveId::triangle);
        triangles.chain((0..self.curved_count()).map(self.curved_ids()))
    }

    /// Counts the primitives in no instance that no ray can hit, because they have no area or are
    /// not finite, on the threads of the current rayon pool.
    pub fn never_hit(&self) -> usize {
        let never_hit = |primitive: &PrimitiveId| !self.own_surface(*primitive).can_be_hit();
        let triangles = (0..self.triangles.len()).into_par_iter();
        let curved = (0..self.curved_count()).into_par_iter();
        let primitives = triangles.map(PrimitiveId::triangle);
        let primitives = primitives.chain(curved.map(self.curved_ids()));
        primitives.filter(never_hit).count()
    }

    /// The number of quadrics and segments in no instance, including those that can never be hit.
    pub fn curved_count(&self) -> usize {
        self.quadric_count() + self.segment_count()
    }

    /// The ids of all quadrics and then all segments, by a number below
    /// [`Geometry::curved_count`].
    pub fn curved_ids(&self) -> impl Fn(usize) -> PrimitiveId + Copy + Send + Sync + use<> {
        let quadrics = self.quadric_count();
        move |place| match place.checked_sub(quadrics) {
            None => PrimitiveId::quadric(place),
            Some(segment) => PrimitiveId::segment(segment),
        }
    }
}
