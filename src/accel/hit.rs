//! What a ray meets first, and what it took to know.

use crate::exact::Bracket;
use crate::shape::InstancedId;
use std::ops::AddAssign;

/// What a ray meets first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// What was hit.
    pub primitive: InstancedId,
    /// Where the ray's parameter lies at the hit; with [`super::Precision::Fast`] both ends are the computed one.
    pub t: Bracket,
    /// Whether integers were needed to find it.
    pub(super) is_hard: bool,
}

/// What rays cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TraversalCounts {
    /// Boxes of nodes that were tested.
    pub nodes: u64,
    /// Primitives that were tested, those of instances too.
    pub primitives: u64,
}

/// How often `f64` was not enough.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExactFallbacks {
    /// Tests of a primitive that were decided on integers.
    pub unsure_tests: u64,
    /// Comparisons of two hits that were decided on integers.
    pub comparisons: u64,
    /// Depths and distances that were rounded by comparing integers.
    pub roundings: u64,
    /// Rays for which any of this was needed.
    pub rays: u64,
}

impl ExactFallbacks {
    /// What came after `before`.
    pub fn since(&self, before: &ExactFallbacks) -> ExactFallbacks {
        ExactFallbacks {
            unsure_tests: self.unsure_tests - before.unsure_tests,
            comparisons: self.comparisons - before.comparisons,
            roundings: self.roundings - before.roundings,
            rays: self.rays - before.rays,
        }
    }

    /// Whether integers were needed at all, the rays not counted.
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
