//! Traces single rays through an aggregate.

use super::any_hit::AnyHit;
use super::closure_search::ClosureSearch;
use super::exact_search::ExactSearch;
use super::fast_search::FastSearch;
use super::ties::Ties;
use super::traversal::{RayStacks, Search, traverse};
use crate::accel::hit::{ExactFallbacks, Hit, TraversalCounts};
use crate::accel::space::SlabRay;
use crate::accel::{Aggregate, Depth, Precision};
use crate::geometry::Ray;
use crate::shape::{Geometry, InstancedId};

/// Traces rays, one after the other. Each thread needs its own.
pub struct Tracer<'a> {
    aggregate: &'a Aggregate,
    geometry: &'a Geometry,
    precision: Precision,
    stacks: RayStacks,
    ties: Ties,
    fallbacks: ExactFallbacks,
}

impl<'a> Tracer<'a> {
    /// Prepares to trace rays through `aggregate`, which was built over `geometry`.
    pub fn new(
        aggregate: &'a Aggregate,
        geometry: &'a Geometry,
        precision: Precision,
    ) -> Tracer<'a> {
        Tracer {
            aggregate,
            geometry,
            precision,
            stacks: RayStacks::new(),
            ties: Ties::default(),
            fallbacks: ExactFallbacks::default(),
        }
    }

    /// The nearest hit of `ray`. At equal `t` the primitive that comes first in the file wins (rule
    /// E3).
    pub fn closest_hit(&mut self, ray: &Ray) -> Option<Hit> {
        self.trace::<false, false>(ray, &mut TraversalCounts::default())
    }

    /// Any hit of `ray`. Which one it is depends on the tree.
    pub fn any_hit(&mut self, ray: &Ray) -> Option<Hit> {
        self.trace::<false, true>(ray, &mut TraversalCounts::default())
    }

    /// Like [`Tracer::closest_hit`], and adds the nodes and primitives that were tested to
    /// `counts`.
    pub fn closest_hit_counted(&mut self, ray: &Ray, counts: &mut TraversalCounts) -> Option<Hit> {
        self.trace::<true, false>(ray, counts)
    }

    /// The nearest hit of `ray`, where `intersect` returns the `t` at which the ray hits a
    /// primitive.
    ///
    /// At equal `t` the first primitive that is tested wins, so the result may depend on the tree.
    /// Adds the nodes and primitives that were tested to `counts`.
    pub fn closest_hit_by<const COUNTED: bool>(
        &mut self,
        ray: &Ray,
        intersect: impl FnMut(InstancedId) -> Option<f32>,
        counts: &mut TraversalCounts,
    ) -> Option<Hit> {
        if !ray.can_hit() {
            return None;
        }
        let slab = self.aggregate.space.ray(ray);
        let search = ClosureSearch::new(&slab, intersect);
        let (aggregate, geometry, stacks) = (self.aggregate, self.geometry, &mut self.stacks);
        traverse::<COUNTED, _>(aggregate, geometry, &slab, search, stacks, counts)
    }

    /// The depth of the `hit` of `ray`.
    pub fn depth(&mut self, ray: &Ray, hit: &Hit) -> Depth {
        Depth::of(hit, ray, self.geometry, self.precision, &mut self.fallbacks)
    }

    /// The number of exact fallbacks so far.
    pub fn fallbacks(&self) -> ExactFallbacks {
        self.fallbacks
    }

    #[inline]
    fn trace<const COUNTED: bool, const ANY: bool>(
        &mut self,
        ray: &Ray,
        counts: &mut TraversalCounts,
    ) -> Option<Hit> {
        if !ray.can_hit() {
            return None;
        }
        let (aggregate, geometry, stacks) = (self.aggregate, self.geometry, &mut self.stacks);
        let slab = aggregate.space.ray(ray);
        match self.precision {
            Precision::Exact => {
                let mut fallbacks = ExactFallbacks::default();
                let search = ExactSearch::new(geometry, ray, &slab, &mut self.ties, &mut fallbacks);
                let hit =
                    run::<COUNTED, ANY, _>(aggregate, geometry, &slab, search, stacks, counts);
                self.fallbacks.add_ray(fallbacks);
                hit
            }
            Precision::Fast => {
                let search = FastSearch::new(geometry, &aggregate.space, ray, &slab);
                run::<COUNTED, ANY, _>(aggregate, geometry, &slab, search, stacks, counts)
            }
        }
    }
}

/// Runs a search through the trees, to its end or to its first hit.
#[inline]
fn run<const COUNTED: bool, const ANY: bool, S: Search>(
    aggregate: &Aggregate,
    geometry: &Geometry,
    slab: &SlabRay,
    search: S,
    stacks: &mut RayStacks,
    counts: &mut TraversalCounts,
) -> Option<Hit> {
    if ANY {
        let search = AnyHit::new(search);
        traverse::<COUNTED, _>(aggregate, geometry, slab, search, stacks, counts)
    } else {
        traverse::<COUNTED, _>(aggregate, geometry, slab, search, stacks, counts)
    }
}
