//! The slab test of one ray against boxes of an object, as an instance places them.
//!
//! A box of the object has the range l to h on axis j, in the object's anchor space. Relative to
//! the origin of the ray, and in the units of the world's anchor space, it is in the range from
//! sum_j min(P_kj l, P_kj h) + B_k to the same with maxima, where P is the transform between the
//! two spaces and B the place of the object's anchor. Which of l and h has the minimum is decided
//! by the sign of P_kj.
//!
//! # Bounds
//!
//! Let u = 2^-24, and let T_k = 2^33 sum_j |P_kj| + |B_k| + |O_k|, where O is the origin in the
//! world's anchor space. No coordinate in the object's anchor space exceeds 2^33. P and B are
//! rounded to `f32`, and the three products and sums round again: up to 5 u T_k in all. B is
//! computed in `f64` in six roundings of its absolute terms, which may cancel. To this comes the
//! error of the placement itself ([`Placement::slack`]).
//!
//! Answers in `f32` must not depend on the tree: the box is entered no later than those of its
//! primitives, which are rounded outward in the world's space, by up to 2 u of their distance from
//! the anchor, and whose faces are rounded again relative to the origin. That is less than 6 u T_k.
//! What remains of the entry is the same rounding for both, which is monotone.
//!
//! So every face is moved outward by 16 u T_k, the errors of `f64`, and a tiny number for
//! underflow. An overflow makes this infinite, and faces infinite or NaN, which cut nothing off.

use super::box_test::{BoxTest, Entered, Slabs, used};
use crate::accel::instance::Placement;
use crate::accel::space::{AnchorSpace, SlabRay};
use crate::accel::tree::WideNode;
use crate::exact::UNIT_ROUNDOFF;
use crate::geometry::Ray;
use crate::simd::{F32s, Lanes};

/// A ray and the boxes of an object in an instance.
pub(super) struct PlacedBoxes<'a> {
    slab: &'a SlabRay,
    /// P of the module head.
    world_from_object: [[f32; 3]; 3],
    /// B, moved outward for the low faces and for the high ones.
    anchor: [[f32; 2]; 3],
}

/// Bounds the coordinates of boxes in the anchor space of an object.
const REACH: f64 = (1u64 << 33) as f64;
/// Exceeds the roundings to `f32`, relative to T of the module head.
const ROUNDING: f64 = 1.0 / (1 << 20) as f64;
/// Covers the loss by underflow.
const UNDERFLOW: f64 = 1.0 / (1u128 << 100) as f64;

impl<'a> PlacedBoxes<'a> {
    pub(super) fn new(
        ray: &Ray,
        slab: &'a SlabRay,
        world: &AnchorSpace,
        object: &AnchorSpace,
        placement: &Placement,
    ) -> PlacedBoxes<'a> {
        let units = world.units();
        let mut boxes = PlacedBoxes {
            slab,
            world_from_object: [[0.0; 3]; 3],
            anchor: [[0.0; 2]; 3],
        };
        let object_anchor = object.anchor();
        for k in 0..3 {
            let row = &placement.world_from_instance.rows[k];
            let (mut sum, mut terms, mut linear) = (row[3] - ray.origin[k], 0.0, 0.0);
            for j in 0..3 {
                let entry = row[j] * (units / object.units());
                boxes.world_from_object[k][j] = entry as f32;
                linear += entry.abs();
                sum += row[j] * object_anchor[j];
                terms += (row[j] * object_anchor[j]).abs();
            }
            terms += row[3].abs() + ray.origin[k].abs();
            let place = sum * units;
            let from_anchor = (ray.origin[k] - world.anchor()[k]) * units;
            let in_f32 = REACH * linear + place.abs() + from_anchor.abs();
            let in_f64 = 16.0 * UNIT_ROUNDOFF * terms * units;
            let slack = ROUNDING * in_f32 + in_f64 + 2.0 * placement.slack[k] * units + UNDERFLOW;
            boxes.anchor[k] = [place - slack, place + slack].map(|place| place as f32);
        }
        boxes
    }
}

impl<S: Lanes> BoxTest<S> for PlacedBoxes<'_> {
    #[inline(always)]
    fn enter(&self, simd: S, node: &WideNode, limit: f32) -> Entered {
        let slab = self.slab;
        let mut slabs = Slabs::new(simd);
        for k in 0..3 {
            let mut faces = [simd.splat(self.anchor[k][0]), simd.splat(self.anchor[k][1])];
            for j in 0..3 {
                let entry = self.world_from_object[k][j];
                let corners = [&node.low[j], &node.high[j]];
                let side = usize::from(entry < 0.0);
                let entry = simd.splat(entry);
                faces[0] = simd.load(corners[side]).fused_or_not(entry, faces[0]);
                faces[1] = simd.load(corners[1 - side]).fused_or_not(entry, faces[1]);
            }
            let side = slab.near_corner[k] & 1;
            slabs.cut(simd, slab, k, faces[side], faces[1 - side]);
        }
        let mut entered = slabs.entered(simd, limit);
        entered.lanes &= used(simd, node);
        entered
    }
}
