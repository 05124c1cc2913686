//! Hits of rays, traversal counts, and counts of exact fallbacks.

use crate::exact::Bracket;
use crate::shape::InstancedId;
use std::ops::AddAssign;

/// The nearest hit of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The primitive that is hit.
    pub primitive: InstancedId,
    /// Encloses the ray's parameter at the hit. With [`super::Precision::Fast`] both ends are the
    /// computed number.
    pub t: Bracket,
    /// Whether exact arithmetic was needed to find the hit.
    pub(super) is_hard: bool,
}

/// The nodes and primitives that rays test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TraversalCounts {
    /// Tests of a node's box.
    pub nodes: u64,
    /// Tests of a primitive, including those of instances.
    pub primitives: u64,
}

/// How often `f64` was not precise enough, so that exact integer arithmetic decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExactFallbacks {
    /// Exact tests of a primitive.
    pub unsure_tests: u64,
    /// Exact comparisons of two hits.
    pub comparisons: u64,
    /// Exact roundings of a depth or a distance.
    pub roundings: u64,
    /// Rays that needed any of these.
    pub rays: u64,
}

impl ExactFallbacks {
    /// The fallbacks since `before`.
    pub fn since(&self, before: &ExactFallbacks) -> ExactFallbacks {
        ExactFallbacks {
            unsure_tests: self.unsure_tests - before.unsure_tests,
            comparisons: self.comparisons - before.comparisons,
            roundings: self.roundings - before.roundings,
            rays: self.rays - before.rays,
        }
    }

    /// Adds the fallbacks of one ray.
    pub(super) fn add_ray(&mut self, of_ray: ExactFallbacks) {
        if of_ray.is_any() {
            *self += ExactFallbacks { rays: 1, ..of_ray };
        }
    }

    /// Tests whether there was any fallback.
    pub(super) fn is_any(&self) -> bool {
        self.unsure_tests + self.comparisons + self.roundings > 0
    }
}

impl AddAssign for TraversalCounts {
    fn add_assign(&mut self, other: TraversalCounts) {
        self.nodes += other.nodes;
        self.primitives += other.primitives;
    }
}

impl AddAssign for ExactFallbacks {
    fn add_assign(&mut self, other: ExactFallbacks) {
        self.unsure_tests += other.unsure_tests;
        self.comparisons += other.comparisons;
        self.roundings += other.roundings;
        self.rays += other.rays;
    }
}
