//! Traces single rays through an aggregate.

use super::any_hit::AnyHit;
use super::binary_traversal::{BinaryStacks, traverse};
use super::closure_search::ClosureSearch;
use super::exact_search::ExactSearch;
use super::fast_search::FastSearch;
use super::search::Search;
use super::ties::Ties;
use super::wide_traversal::{WideStacks, WideTraversal};
use crate::accel::hit::{ExactFallbacks, Hit, TraversalCounts};
use crate::accel::space::SlabRay;
use crate::accel::{Aggregate, Depth, Precision};
use crate::geometry::Ray;
use crate::shape::{Geometry, InstancedId};
use crate::simd::Level;

/// Traces rays, one after the other. Each thread needs its own.
pub struct Tracer<'a> {
    aggregate: &'a Aggregate,
    geometry: &'a Geometry,
    precision: Precision,
    level: Level,
    stacks: Stacks,
    ties: Ties,
    fallbacks: ExactFallbacks,
}

/// The memory of a tracer, which the next one may take over.
///
/// It holds answers about primitives, so both must trace through the same geometry.
#[derive(Default)]
pub struct TracerMemory {
    stacks: Stacks,
    ties: Ties,
}

/// The stacks of both traversals; those of the binary trees once rays are counted.
#[derive(Default)]
struct Stacks {
    binary: Option<Box<BinaryStacks>>,
    wide: WideStacks,
}

impl Stacks {
    fn binary(&mut self) -> &mut BinaryStacks {
        self.binary
            .get_or_insert_with(|| Box::new(BinaryStacks::new()))
    }
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
            level: Level::detect(),
            stacks: Stacks::default(),
            ties: Ties::default(),
            fallbacks: ExactFallbacks::default(),
        }
    }

    /// The same tracer with the instructions of `level` instead of the best that the machine has.
    /// Hits do not depend on them.
    pub fn with_level(self, level: Level) -> Tracer<'a> {
        Tracer { level, ..self }
    }

    /// The same tracer with the memory of another one of the same geometry. Hits do not depend on
    /// it.
    pub fn with_memory(self, memory: TracerMemory) -> Tracer<'a> {
        let TracerMemory { stacks, ties } = memory;
        Tracer {
            stacks,
            ties,
            ..self
        }
    }

    /// The memory, for the next tracer.
    pub fn into_memory(self) -> TracerMemory {
        TracerMemory {
            stacks: self.stacks,
            ties: self.ties,
        }
    }

    /// The nearest hit of `ray`. At equal `t` the primitive that comes first in the file wins (rule
    /// E3).
    pub fn closest_hit(&mut self, ray: &Ray) -> Option<Hit> {
        self.trace(ray, &mut Traversal::Closest)
    }

    /// Any hit of `ray`. Which one it is depends on the tree.
    pub fn any_hit(&mut self, ray: &Ray) -> Option<Hit> {
        self.trace(ray, &mut Traversal::Any)
    }

    /// Like [`Tracer::closest_hit`], and adds the nodes and primitives that were tested to
    /// `counts`. The ray traverses the binary tree, which costs are defined by.
    pub fn closest_hit_counted(&mut self, ray: &Ray, counts: &mut TraversalCounts) -> Option<Hit> {
        self.trace(ray, &mut Traversal::Counted(counts))
    }

    /// The nearest hit of `ray`, where `intersect` returns the `t` at which the ray hits a
    /// primitive.
    ///
    /// At equal `t` the first primitive that is tested wins, so the result may depend on the tree.
    /// The ray traverses the binary tree. Adds the nodes and primitives that were tested to
    /// `counts`.
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
        let mut search = ClosureSearch::new(&slab, intersect);
        let (aggregate, geometry, stacks) = (self.aggregate, self.geometry, self.stacks.binary());
        traverse::<COUNTED, _>(aggregate, geometry, &slab, &mut search, stacks, counts);
        search.hit()
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
    fn trace(&mut self, ray: &Ray, traversal: &mut Traversal) -> Option<Hit> {
        if !ray.can_hit() {
            return None;
        }
        let (aggregate, geometry) = (self.aggregate, self.geometry);
        let slab = aggregate.space.ray(ray);
        let trees = Trees {
            aggregate,
            geometry,
            level: self.level,
            ray,
            slab: &slab,
            stacks: &mut self.stacks,
        };
        match self.precision {
            Precision::Exact => {
                let mut fallbacks = ExactFallbacks::default();
                let ties = &mut self.ties;
                let mut search = ExactSearch::new(geometry, ray, &slab, ties, &mut fallbacks);
                let hit = trees.traverse(traversal, &mut search);
                self.fallbacks.add_ray(fallbacks);
                hit
            }
            Precision::Fast => {
                let mut search = FastSearch::new(geometry, &aggregate.space, ray, &slab);
                trees.traverse(traversal, &mut search)
            }
        }
    }
}

/// How a ray traverses the trees.
enum Traversal<'c> {
    /// The wide trees, to the end.
    Closest,
    /// The wide trees, to the first hit.
    Any,
    /// The binary trees, to the end. Adds the tests.
    Counted(&'c mut TraversalCounts),
}

/// The trees and a ray.
struct Trees<'a> {
    aggregate: &'a Aggregate,
    geometry: &'a Geometry,
    level: Level,
    ray: &'a Ray,
    slab: &'a SlabRay,
    stacks: &'a mut Stacks,
}

impl Trees<'_> {
    #[inline]
    fn traverse<S: Search>(self, traversal: &mut Traversal, search: &mut S) -> Option<Hit> {
        match traversal {
            Traversal::Closest => self.traverse_wide(search),
            Traversal::Any => self.traverse_wide(&mut AnyHit::new(search)),
            Traversal::Counted(counts) => {
                let stacks = self.stacks.binary();
                traverse::<true, _>(
                    self.aggregate,
                    self.geometry,
                    self.slab,
                    search,
                    stacks,
                    counts,
                );
            }
        }
        search.hit()
    }

    fn traverse_wide(self, search: &mut dyn Search) {
        self.level.run(WideTraversal {
            aggregate: self.aggregate,
            geometry: self.geometry,
            ray: self.ray,
            slab: self.slab,
            stacks: &mut self.stacks.wide,
            search,
        });
    }
}
