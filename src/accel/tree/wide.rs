//! The tree that tiles and single rays traverse: sixteen children per node, whatever the split method.

use crate::accel::space::Box32;
use crate::simd::LANES;

/// Up to sixteen children, side by side.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
pub(crate) struct WideNode {
    /// Low corners of the children's boxes by axis, in anchor space; infinite in unused lanes.
    pub(crate) low: [[f32; LANES]; 3],
    /// High corners; minus infinity in unused lanes.
    pub(crate) high: [[f32; LANES]; 3],
    /// The contents of each child.
    pub(crate) children: [Child; LANES],
}

/// The contents of a child: blocks of primitives, or a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Child {
    /// The index of the first block, or of the node.
    pub(crate) first: u32,
    /// The number of blocks; 0 for a node.
    pub(crate) blocks: u32,
}

/// A tree with sixteen children per node over blocks of primitives.
///
/// It is a binary tree with levels left out: no box changes.
#[derive(Debug, PartialEq)]
pub(crate) struct WideTree<B> {
    pub(crate) nodes: Vec<WideNode>,
    pub(crate) blocks: Vec<B>,
}

impl<B> WideTree<B> {
    /// The memory of the tree in bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.blocks[..])
    }
}

impl WideNode {
    /// Lanes that have a child, lane k as bit k.
    pub(super) fn used(&self) -> u32 {
        let is_used = |lane: usize| u32::from(self.low[0][lane] <= self.high[0][lane]);
        (0..LANES).fold(0, |used, lane| used | is_used(lane) << lane)
    }

    /// The same node in a list where nodes and blocks have moved back.
    pub(super) fn shifted(&self, nodes: u32, blocks: u32) -> WideNode {
        let mut shifted = self.clone();
        let used = self.used();
        for lane in (0..LANES).filter(|lane| used >> lane & 1 == 1) {
            let child = &mut shifted.children[lane];
            child.first += if child.blocks > 0 { blocks } else { nodes };
        }
        shifted
    }

    /// A node whose children have these boxes and no contents yet.
    pub(crate) fn over(boxes: impl Iterator<Item = Box32>) -> WideNode {
        let Box32 { low, high } = Box32::EMPTY;
        let mut node = WideNode {
            low: low.map(|x| [x; LANES]),
            high: high.map(|x| [x; LANES]),
            children: [Child::default(); LANES],
        };
        for (lane, bounds) in boxes.enumerate() {
            for axis in 0..3 {
                node.low[axis][lane] = bounds.low[axis];
                node.high[axis][lane] = bounds.high[axis];
            }
        }
        node
    }
}

/// A range of consecutive items in the leaves' order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) first: u32,
    pub(crate) count: u32,
}

impl Run {
    /// The items of the run in `order`.
    #[inline]
    pub(crate) fn of<T>(self, order: &[T]) -> &[T] {
        &order[self.first as usize..][..self.count as usize]
    }
}
