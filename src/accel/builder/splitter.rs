//! Splits one list of primitives, by each method.

use super::binning::best_plane;
use super::build_primitive::{BuildPrimitive, centre_bounds};
use super::full_leaves::LeafSize;
use super::partition::partition;
use crate::accel::SplitMethod;

/// Lists of up to this many leaves are split so that leaves come out full.
const FULL_LEAVES: usize = 16;

/// Splits lists into a left and a right part, neither of which is empty.
#[derive(Debug, Clone, Copy)]
pub(super) struct Splitter {
    pub(super) method: SplitMethod,
    pub(super) leaf_size: LeafSize,
}

impl Splitter {
    /// Reorders `primitives` so that the left part comes first, and returns its length; `None` if
    /// they should form a leaf.
    pub(super) fn split(&self, primitives: &mut [BuildPrimitive]) -> Option<usize> {
        if primitives.len() <= self.leaf_size.0 || self.method == SplitMethod::None {
            return None;
        }
        let len = primitives.len();
        let parted = match self.method {
            SplitMethod::Sah => self.split_by_sah(primitives),
            SplitMethod::Middle => split_in_the_middle(primitives),
            _ => None,
        };
        Some(match parted {
            Some((_, count)) if len > FULL_LEAVES * self.leaf_size.0 => count,
            Some((axis, count)) => {
                move_boundary(primitives, axis, count, self.leaf_size.full(len, count))
            }
            None => split_at(primitives, self.leaf_size.full(len, len / 2)),
        })
    }

    /// The axis and the number of primitives on the left; `None` if all centres coincide.
    fn split_by_sah(&self, primitives: &mut [BuildPrimitive]) -> Option<(usize, usize)> {
        let plane = best_plane(primitives, self.leaf_size)?;
        let count = partition(primitives, |primitive| {
            primitive.centre_along(plane.axis) < plane.at
        });
        both_sides(plane.axis, count, primitives.len())
    }
}

fn both_sides(axis: usize, count: usize, len: usize) -> Option<(usize, usize)> {
    (count > 0 && count < len).then_some((axis, count))
}

/// Halves a list at the median of its centres along their widest axis; arbitrarily if all coincide.
pub(super) fn split_evenly(primitives: &mut [BuildPrimitive]) -> usize {
    split_at(primitives, primitives.len() / 2)
}

/// Splits off the first `count` primitives along the widest axis of the centres.
fn split_at(primitives: &mut [BuildPrimitive], count: usize) -> usize {
    let extent = centre_bounds(primitives).extent();
    let axis = extent.widest_axis();
    if extent.0[axis] > 0.0 {
        select(primitives, axis, count);
    }
    count
}

fn split_in_the_middle(primitives: &mut [BuildPrimitive]) -> Option<(usize, usize)> {
    let bounds = centre_bounds(primitives);
    let axis = bounds.extent().widest_axis();
    let middle = 0.5 * (bounds.low.0[axis] + bounds.high.0[axis]);
    let count = partition(primitives, |primitive| {
        primitive.centre_along(axis) < middle
    });
    both_sides(axis, count, primitives.len())
}

/// Moves the boundary of a list that is partitioned along `axis` at `count` to `wanted`.
fn move_boundary(
    primitives: &mut [BuildPrimitive],
    axis: usize,
    count: usize,
    wanted: usize,
) -> usize {
    if wanted < count {
        select(&mut primitives[..count], axis, wanted);
    } else if wanted > count {
        select(&mut primitives[count..], axis, wanted - count);
    }
    wanted
}

/// Moves the first `count` primitives along `axis` to the front. Their bits break ties, so the
/// selection does not depend on the order of the list.
fn select(primitives: &mut [BuildPrimitive], axis: usize, count: usize) {
    let key = |primitive: &BuildPrimitive| {
        u64::from(rank(primitive.centre_along(axis))) << 32 | u64::from(primitive.bits())
    };
    // Selecting among numbers is faster than among boxes.
    let mut keys: Vec<u64> = primitives.iter().map(key).collect();
    let limit = *keys.select_nth_unstable(count).1;
    partition(primitives, |primitive| key(primitive) < limit);
}

/// An integer that grows with `x`, in the order of [`f32::total_cmp`].
#[inline]
fn rank(x: f32) -> u32 {
    let bits = x.to_bits();
    bits ^ ((bits as i32 >> 31) as u32 | 1 << 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_ascend() {
        let ascending = [
            f32::NEG_INFINITY,
            -2.0,
            -1.5,
            -0.0,
            0.0,
            f32::from_bits(1),
            1.0,
            f32::INFINITY,
            f32::NAN,
        ];
        assert!(ascending.map(rank).is_sorted_by(|a, b| a < b));
    }
}
