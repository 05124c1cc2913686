//! The nearest hit of a ray, as `f32` has it.

use super::traversal::Search;
use crate::accel::hit::Hit;
use crate::accel::space::{AnchorSpace, SingleRay, SlabRay};
use crate::exact::Bracket;
use crate::geometry::{Point, Ray};
use crate::shape::{Primitive, Shapes, SingleQuadric, intersect_single};

/// The best hit so far of a ray among the primitives that were tested. Everything is relative to the anchor and in `f32`.
///
/// Rounding may place a hit a little outside the primitive's box, where a tree would never have looked. So a hit counts
/// only if the ray enters that box, and not before it does; then every node around it is entered no later, and the answer
/// is the same for every tree, and for none.
pub(in crate::accel) struct FastSearch<'a> {
    shapes: &'a Shapes,
    space: &'a AnchorSpace,
    ray: SingleRay,
    slab: &'a SlabRay,
    best: Option<(f32, Primitive)>,
}

impl<'a> FastSearch<'a> {
    pub(in crate::accel) fn new(
        shapes: &'a Shapes,
        space: &'a AnchorSpace,
        ray: &Ray,
        slab: &'a SlabRay,
    ) -> FastSearch<'a> {
        FastSearch { shapes, space, ray: space.single_ray(ray), slab, best: None }
    }

    #[inline]
    fn intersect(&self, primitive: Primitive) -> Option<f32> {
        let SingleRay { origin, direction, largest_axis, .. } = self.ray;
        if primitive.is_sphere() {
            let quadric = self.shapes.sphere(primitive.index());
            let centre = self.space.place(&Point::from(quadric.world_from_object.column(3)));
            let from_centre = std::array::from_fn(|k| origin[k] - centre[k]);
            return SingleQuadric::new(&quadric, self.space.units()).intersect(from_centre, direction);
        }
        let corners = self.shapes.triangle(primitive.index()).0.map(|corner| {
            let corner = self.space.place(&corner);
            std::array::from_fn(|k| corner[k] - origin[k])
        });
        intersect_single(corners, direction, largest_axis)
    }

    fn offer(&mut self, t: f32, primitive: Primitive) {
        if self.best.is_some_and(|(best, _)| t > best) {
            return;
        }
        let corners = self.space.enclose(&self.shapes.bounds(primitive)).corners();
        let Some(entry) = self.slab.enter(&corners) else { return };
        let t = t.max(entry);
        let is_better =
            self.best.is_none_or(|(best, other)| t < best || (t == best && self.shapes.precedes(primitive, other)));
        if is_better {
            self.best = Some((t, primitive));
        }
    }
}

impl Search for FastSearch<'_> {
    #[inline]
    fn test(&mut self, primitive: Primitive) {
        if let Some(t) = self.intersect(primitive) {
            self.offer(t, primitive);
        }
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.best.map_or(f32::INFINITY, |(t, _)| t)
    }

    #[inline]
    fn has_hit(&self) -> bool {
        self.best.is_some()
    }

    fn into_hit(self) -> Option<Hit> {
        let t_of = |t| Bracket::exactly(self.ray.unscaled(t));
        self.best.map(|(t, primitive)| Hit { primitive, t: t_of(t), is_hard: false })
    }
}
