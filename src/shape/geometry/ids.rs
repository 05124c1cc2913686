//! The ids of the primitives in no instance.

use super::Geometry;
use crate::shape::PrimitiveId;
use rayon::prelude::*;

impl Geometry {
    /// All primitives in no instance, kind by kind.
    pub fn primitives(&self) -> impl Iterator<Item = PrimitiveId> + use<> {
        (0..self.own_count()).map(self.own_ids())
    }

    /// Counts the primitives in no instance that no ray can hit, because they have no area or are
    /// not finite, on the threads of the current rayon pool.
    pub fn never_hit(&self) -> usize {
        let ids = self.own_ids();
        let never_hit = |place: &usize| !self.own_surface(ids(*place)).can_be_hit();
        let places = (0..self.own_count()).into_par_iter();
        places.filter(never_hit).count()
    }

    /// The ids of all primitives in no instance, kind by kind, by a number below
    /// [`Geometry::own_count`].
    pub(crate) fn own_ids(&self) -> impl Fn(usize) -> PrimitiveId + Copy + Send + Sync + use<> {
        let (triangles, curved) = (self.triangles.len(), self.curved_ids());
        move |place| match place.checked_sub(triangles) {
            None => PrimitiveId::triangle(place),
            Some(place) => curved(place),
        }
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
