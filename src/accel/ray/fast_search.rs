//! The nearest hit of a ray, computed in `f32`.

use super::search::Search;
use crate::accel::hit::Hit;
use crate::accel::space::{AnchorSpace, SingleRay, SlabRay};
use crate::exact::Bracket;
use crate::geometry::{Point, Ray};
use crate::shape::{
    FilterRay, Form, Geometry, InstancedId, Primitive, SingleQuadric, SingleSegment, SpaceCache,
    intersect_patch, intersect_single,
};

/// The best hit so far of a ray among the primitives that were tested, in `f32` relative to the
/// anchor.
///
/// Rounding may place a hit slightly outside the primitive's box, where a tree would never have
/// looked. So a hit counts only if the ray enters that box, and is moved to the entry if it lies
/// before it. Every node around the box is entered no later, so the result is the same for every
/// tree, and without one.
pub(crate) struct FastSearch<'a> {
    geometry: &'a Geometry,
    space: &'a AnchorSpace,
    ray: SingleRay,
    /// The ray of the camera.
    world_ray: &'a Ray,
    slab: &'a SlabRay,
    best: Option<(f32, InstancedId)>,
}

impl<'a> FastSearch<'a> {
    pub(crate) fn new(
        geometry: &'a Geometry,
        space: &'a AnchorSpace,
        ray: &'a Ray,
        slab: &'a SlabRay,
    ) -> FastSearch<'a> {
        FastSearch {
            geometry,
            space,
            ray: space.single_ray(ray),
            world_ray: ray,
            slab,
            best: None,
        }
    }

    #[inline]
    fn intersect(&self, surface: &Primitive) -> Option<f32> {
        let SingleRay {
            origin,
            direction,
            largest_axis,
            ..
        } = self.ray;
        let from_origin = |point: &Point| -> [f32; 3] {
            let point = self.space.place(point);
            [
                point[0] - origin[0],
                point[1] - origin[1],
                point[2] - origin[2],
            ]
        };
        match surface {
            Primitive::Quadric(quadric) if quadric.form == Form::Patch => intersect_patch(
                quadric.patch().corners.each_ref().map(from_origin),
                direction,
            ),
            Primitive::Quadric(quadric) => {
                let from_centre =
                    from_origin(&quadric.world_from_object.column(3).into()).map(|x| -x);
                SingleQuadric::new(quadric, self.space.units()).intersect(from_centre, direction)
            }
            Primitive::Segment(segment) => {
                let from_middle = from_origin(&SingleSegment::middle(segment)).map(|x| -x);
                SingleSegment::new(segment, self.space.units()).intersect(from_middle, direction)
            }
            Primitive::Triangle(triangle) => intersect_single(
                triangle.0.each_ref().map(from_origin),
                direction,
                largest_axis,
            ),
        }
    }

    /// The `t` of a primitive with an alpha (rule A1). The hit of a triangle or a segment counts
    /// where its alpha says so; that of a quadric is the exact one, rounded.
    #[cold]
    fn intersect_cut_out(&self, placed: InstancedId, surface: &Primitive) -> Option<f32> {
        match surface {
            Primitive::Triangle(_) | Primitive::Segment(_) => {
                let t = self.intersect(surface)?;
                self.geometry.keeps(placed, self.world_ray, 0).then_some(t)
            }
            Primitive::Quadric(_) => {
                let ray = FilterRay::new(self.world_ray);
                let mut spaces = SpaceCache::default();
                let t = self
                    .geometry
                    .t_of_kept(placed, surface, &ray, &mut spaces)?;
                Some(self.ray.scaled(t.low))
            }
        }
    }

    fn offer(&mut self, t: f32, primitive: InstancedId, surface: &Primitive) {
        if self.best.is_some_and(|(best, _)| t > best) {
            return;
        }
        let corners = self.space.enclose(&surface.bounds()).corners();
        let Some(entry) = self.slab.enter(&corners) else {
            return;
        };
        let t = t.max(entry);
        let is_better = self.best.is_none_or(|(best, other)| {
            t < best || (t == best && self.geometry.precedes(primitive, other))
        });
        if is_better {
            self.best = Some((t, primitive));
        }
    }
}

impl Search for FastSearch<'_> {
    #[inline]
    fn test(&mut self, primitive: InstancedId) {
        let Some(surface) = self.geometry.surface_in_tree(primitive) else {
            return;
        };
        let t = match self.geometry.alpha_of(primitive) {
            None => self.intersect(&surface),
            Some(_) => self.intersect_cut_out(primitive, &surface),
        };
        if let Some(t) = t {
            self.offer(t, primitive, &surface);
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

    fn is_exact(&self) -> bool {
        false
    }

    fn hit(&self) -> Option<Hit> {
        let t_of = |t| Bracket::exactly(self.ray.unscaled(t));
        self.best.map(|(t, primitive)| Hit {
            primitive,
            t: t_of(t),
            is_hard: false,
        })
    }
}
