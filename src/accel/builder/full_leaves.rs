//! Leaf sizes, and splits that fill leaves.

/// The largest number of primitives in a leaf; 1 or more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LeafSize(pub(super) usize);

impl LeafSize {
    /// The number of leaves that `count` primitives need.
    #[inline]
    pub(super) fn leaves(self, count: usize) -> usize {
        count.div_ceil(self.0)
    }

    /// The same as a float, by a multiplication instead of a division. It may be off by one unless
    /// the leaf size is a power of two.
    #[inline]
    pub(super) fn approximate_leaves(self, count: u32) -> f32 {
        let per_primitive = 1.0 / self.0 as f32;
        ((count as f32 + (self.0 - 1) as f32) * per_primitive) as i32 as f32
    }

    /// The split of `len` primitives nearest to `count` for which both parts together need no more
    /// leaves than the whole, and neither part is empty. The list must be longer than a leaf.
    pub(super) fn full(self, len: usize, count: usize) -> usize {
        let spare = self.leaves(len) * self.0 - len;
        // With at least this many primitives, the last leaf of the left part uses no more than the
        // spare places.
        let enough = self.0 - spare;
        let last = count % self.0;
        if last == 0 || last >= enough {
            return count;
        }
        let (fewer, more) = (count - last, count - last + enough);
        if fewer == 0 || more < len && more - count < count - fewer {
            more
        } else {
            fewer
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn approximate_leaves_are_off_by_one_at_most() {
        for leaf_size in [1, 3, 4, 16, 255].map(LeafSize) {
            for count in 1..3000 {
                let exact = leaf_size.leaves(count) as f32;
                let off = (leaf_size.approximate_leaves(count as u32) - exact).abs();
                assert!(
                    off <= if leaf_size.0.is_power_of_two() {
                        0.0
                    } else {
                        1.0
                    },
                    "{count} in {leaf_size:?}"
                );
            }
        }
    }

    fn fills(leaf_size: LeafSize, len: usize, count: usize) -> bool {
        leaf_size.leaves(count) + leaf_size.leaves(len - count) == leaf_size.leaves(len)
    }

    #[test]
    fn the_full_split_is_the_nearest_that_fills_leaves() {
        for leaf_size in [1, 2, 3, 4, 16].map(LeafSize) {
            for len in leaf_size.0 + 1..70 {
                let fills = |count: &usize| fills(leaf_size, len, *count);
                let all: Vec<usize> = (1..len).filter(fills).collect();
                for count in 1..len {
                    let full = leaf_size.full(len, count);
                    assert!(
                        all.contains(&full),
                        "{count} of {len} in {leaf_size:?}: {full}"
                    );
                    let distance = all.iter().map(|other| other.abs_diff(count)).min();
                    assert_eq!(
                        Some(full.abs_diff(count)),
                        distance,
                        "{count} of {len} in {leaf_size:?}"
                    );
                }
            }
        }
    }
}
