//! Rays through an aggregate, one after the other.

use super::any_hit::AnyHit;
use super::exact_search::ExactSearch;
use super::fast_search::FastSearch;
use super::foreign_search::ForeignSearch;
use super::ties::Ties;
use super::traversal::{Search, Stacks, traverse};
use crate::accel::hit::{ExactFallbacks, Hit, TraversalCounts};
use crate::accel::space::SlabRay;
use crate::accel::{Aggregate, Depth, Precision};
use crate::geometry::Ray;
use crate::shape::{Geometry, InstancedId};

/// Casts rays, one after the other. Each thread has its own.
pub struct Tracer<'a> {
    aggregate: &'a Aggregate,
    geometry: &'a Geometry,
    precision: Precision,
    stacks: Stacks,
    ties: Ties,
    fallbacks: ExactFallbacks,
}

impl<'a> Tracer<'a> {
    /// For rays through `aggregate`, which was built over `geometry`.
    pub fn new(
        aggregate: &'a Aggregate,
        geometry: &'a Geometry,
        precision: Precision,
    ) -> Tracer<'a> {
        let (stacks, ties, fallbacks) = (Stacks::new(), Ties::default(), ExactFallbacks::default());
        Tracer {
            aggregate,
            geometry,
            precision,
            stacks,
            ties,
            fallbacks,
        }
    }

    /// The nearest hit of `ray`; of several at one `t`, the primitive that comes first in the file (rule E3).
    pub fn closest_hit(&mut self, ray: &Ray) -> Option<Hit> {
        self.trace::<false, false>(ray, &mut TraversalCounts::default())
    }

    /// Some hit of `ray`, if it has any: which one, depends on the tree.
    pub fn any_hit(&mut self, ray: &Ray) -> Option<Hit> {
        self.trace::<false, true>(ray, &mut TraversalCounts::default())
    }

    /// As [`Tracer::closest_hit`], adding to `work` what it took.
    pub fn closest_hit_counted(&mut self, ray: &Ray, work: &mut TraversalCounts) -> Option<Hit> {
        self.trace::<true, false>(ray, work)
    }

    /// The nearest hit of `ray` where `intersect` tells the `t` at which it meets a primitive, and which one that is. Of several at one
    /// `t` the first that is tested wins, so the answer may depend on the tree. Adds to `work` what it took.
    pub fn closest_hit_by<const COUNTED: bool>(
        &mut self,
        ray: &Ray,
        intersect: impl FnMut(InstancedId) -> Option<f32>,
        work: &mut TraversalCounts,
    ) -> Option<Hit> {
        if !ray.can_hit() {
            return None;
        }
        let slab = self.aggregate.space.ray(ray);
        let search = ForeignSearch::new(&slab, intersect);
        traverse::<COUNTED, _>(
            self.aggregate,
            self.geometry,
            &slab,
            search,
            &mut self.stacks,
            work,
        )
    }

    /// How far away the `hit` of `ray` is.
    pub fn depth(&mut self, ray: &Ray, hit: &Hit) -> Depth {
        let (depth, roundings) = Depth::of(hit, ray, self.geometry, self.precision);
        if roundings > 0 {
            let rays = u64::from(!hit.is_hard);
            self.fallbacks += ExactFallbacks {
                roundings,
                rays,
                ..ExactFallbacks::default()
            };
        }
        depth
    }

    /// How often integers were needed so far.
    pub fn fallbacks(&self) -> ExactFallbacks {
        self.fallbacks
    }
}

impl Tracer<'_> {
    #[inline]
    fn trace<const COUNTED: bool, const ANY: bool>(
        &mut self,
        ray: &Ray,
        work: &mut TraversalCounts,
    ) -> Option<Hit> {
        if !ray.can_hit() {
            return None;
        }
        let Tracer {
            aggregate,
            geometry,
            ..
        } = *self;
        let slab = aggregate.space.ray(ray);
        match self.precision {
            Precision::Exact => {
                let mut fallbacks = ExactFallbacks::default();
                let search = ExactSearch::new(geometry, ray, &slab, &mut self.ties, &mut fallbacks);
                let hit = run::<COUNTED, ANY, _>(
                    aggregate,
                    geometry,
                    &slab,
                    search,
                    &mut self.stacks,
                    work,
                );
                if fallbacks.is_any() {
                    self.fallbacks += ExactFallbacks {
                        rays: 1,
                        ..fallbacks
                    };
                }
                hit
            }
            Precision::Fast => {
                let search = FastSearch::new(geometry, &aggregate.space, ray, &slab);
                run::<COUNTED, ANY, _>(aggregate, geometry, &slab, search, &mut self.stacks, work)
            }
        }
    }
}

/// Takes a search through the tree, to its end or to its first hit.
#[inline]
fn run<const COUNTED: bool, const ANY: bool, S: Search>(
    aggregate: &Aggregate,
    geometry: &Geometry,
    slab: &SlabRay,
    search: S,
    stacks: &mut Stacks,
    work: &mut TraversalCounts,
) -> Option<Hit> {
    if ANY {
        traverse::<COUNTED, _>(aggregate, geometry, slab, AnyHit::new(search), stacks, work)
    } else {
        traverse::<COUNTED, _>(aggregate, geometry, slab, search, stacks, work)
    }
}
