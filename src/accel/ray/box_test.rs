//! The slab test of one ray against the sixteen boxes of a wide node.

use crate::accel::space::SlabRay;
use crate::accel::tree::WideNode;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// Children that a ray enters.
pub(super) struct Entered {
    /// Where it enters each child, in scaled units.
    pub(super) near: [f32; LANES],
    /// The children that it enters, child k as bit k.
    pub(super) lanes: u32,
}

/// A test of a ray against boxes.
pub(super) trait BoxTest<S: Lanes> {
    /// The children of `node` that the ray enters no later than `limit`. It never misses one that
    /// contains a hit, and never enters it too late.
    fn enter(&self, simd: S, node: &WideNode, limit: f32) -> Entered;
}

/// A ray and the boxes of the world, in the same space.
///
/// The operations, and so the results, are those of [`SlabRay::enter`].
pub(super) struct WorldBoxes<'a> {
    pub(super) slab: &'a SlabRay,
}

impl<S: Lanes> BoxTest<S> for WorldBoxes<'_> {
    #[inline(always)]
    fn enter(&self, simd: S, node: &WideNode, limit: f32) -> Entered {
        let slab = self.slab;
        let mut slabs = Slabs::new(simd);
        for k in 0..3 {
            let corners = [&node.low[k], &node.high[k]];
            // The masks spare bounds checks.
            let side = slab.near_corner[k] & 1;
            let near_face = simd.load(corners[side]) - simd.splat(slab.near_origin[k]);
            let far_face = simd.load(corners[1 - side]) - simd.splat(slab.far_origin[k]);
            slabs.cut(simd, slab, k, near_face, far_face);
        }
        let mut entered = slabs.entered(simd, limit);
        entered.lanes &= used(simd, node);
        entered
    }
}

/// The lanes of a node that have a child, lane k as bit k. The corners of others are infinite, and
/// differences with an infinite origin have no meaning.
#[inline(always)]
pub(super) fn used<S: Lanes>(simd: S, node: &WideNode) -> u32 {
    (!simd.load(&node.low[0]).above(simd.load(&node.high[0]))).bits()
}

/// The intersection of the slabs of sixteen boxes along a ray.
pub(super) struct Slabs<S: Lanes> {
    near: S::F,
    far: S::F,
}

impl<S: Lanes> Slabs<S> {
    /// The whole ray.
    #[inline(always)]
    pub(super) fn new(simd: S) -> Slabs<S> {
        Slabs {
            near: simd.splat(0.0),
            far: simd.splat(f32::INFINITY),
        }
    }

    /// Intersects with the slabs between two faces across axis `k`, given relative to the origin.
    #[inline(always)]
    pub(super) fn cut(&mut self, simd: S, slab: &SlabRay, k: usize, near: S::F, far: S::F) {
        self.near = (near * simd.splat(slab.near_inverse[k])).max(self.near);
        self.far = (far * simd.splat(slab.far_inverse[k])).min(self.far);
    }

    /// The boxes that are entered no later than `limit`.
    #[inline(always)]
    pub(super) fn entered(&self, simd: S, limit: f32) -> Entered {
        let last = (self.far + simd.splat(f32::MIN_POSITIVE)).min(simd.splat(limit));
        let mut near = [0.0; LANES];
        self.near.store(&mut near);
        Entered {
            near,
            lanes: (!self.near.above(last)).bits(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::space::{AnchorSpace, Box32};
    use crate::geometry::{Bounds, Point, Ray, Vector};
    use crate::simd::{Level, SimdKernel};
    use proptest::prelude::*;

    struct Enter<'a> {
        slab: &'a SlabRay,
        node: &'a WideNode,
        limit: f32,
    }

    impl SimdKernel for Enter<'_> {
        type Output = Entered;

        #[inline(always)]
        fn run<S: Lanes>(self, simd: S) -> Entered {
            let boxes = WorldBoxes { slab: self.slab };
            boxes.enter(simd, self.node, self.limit)
        }
    }

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            4 => (-3i32..4).prop_map(f64::from),
            2 => -3.0f64..3.0,
            1 => prop::sample::select(vec![1e-310, -1e-40, 1e30, f64::MAX]),
        ]
    }

    fn triple() -> impl Strategy<Value = [f64; 3]> {
        prop::array::uniform3(coordinate())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        /// Lanes enter what a single box test enters, at the same number.
        #[test]
        fn lanes_agree_with_the_test_of_one_box(
            boxes in prop::collection::vec((triple(), triple()), 0..=LANES),
            origin in triple(),
            direction in triple(),
            limit in prop::sample::select(vec![f32::INFINITY, f32::NEG_INFINITY, 0.0, 1e9, 5e9]),
        ) {
            let space = AnchorSpace::new(Point::default(), 4.0);
            let boxes: Vec<Box32> = boxes
                .iter()
                .map(|(a, b)| space.enclose(&Bounds::of([*a, *b].map(Point::from))))
                .collect();
            let ray = Ray { origin: origin.into(), direction: Vector::from(direction) };
            prop_assume!(ray.can_hit());
            let (slab, node) = (space.ray(&ray), WideNode::over(boxes.iter().copied()));
            for level in Level::ALL {
                let entered = level.run(Enter { slab: &slab, node: &node, limit });
                prop_assert_eq!(entered.lanes >> boxes.len(), 0);
                for (lane, one) in boxes.iter().enumerate() {
                    let near = slab.enter(&one.corners()).filter(|near| *near <= limit);
                    let found =
                        (entered.lanes >> lane & 1 != 0).then_some(entered.near[lane]);
                    prop_assert_eq!(found, near, "{}", level);
                }
            }
        }
    }
}
