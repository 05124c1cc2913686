//! The tree builder: from primitives to nodes, by each split method.

mod binning;
mod branch;
mod build_primitive;
mod centre_grid;
mod collection;
mod f32x4;
mod full_leaves;
mod hlbvh;
mod morton;
mod options;
mod partition;
mod radix_sort;
mod splitter;
mod top_down;
mod triangle_boxes;
mod world_space;

use self::build_primitive::bounds_of;
use self::full_leaves::LeafSize;
use self::splitter::Splitter;
use self::top_down::TopDown;
use super::SplitMethod;
use super::tree::{BinaryTree, MAX_DEPTH, Node, Subtree};
use crate::parallel::CollectVec;
use crate::progress::Progress;
use crate::shape::PrimitiveId;
use rayon::prelude::*;

pub(super) use self::build_primitive::BuildPrimitive;
pub(super) use self::collection::{Collected, collect};
pub use self::options::BuildOptions;
pub(super) use self::world_space::space_around;

/// Builds a tree over `primitives`. `item_of_bits` turns their bits into the items that the tree
/// holds. `progress` counts primitives.
pub(super) fn build<T>(
    mut primitives: Vec<BuildPrimitive>,
    options: BuildOptions,
    progress: Progress,
    item_of_bits: fn(u32) -> T,
) -> BinaryTree<T> {
    if primitives.is_empty() {
        return BinaryTree::EMPTY;
    }
    let leaf_size = LeafSize(options.max_leaf.clamp(1, PrimitiveId::MOST_TRIANGLES));
    let max_depth = MAX_DEPTH as u32;
    let (Subtree { root, below }, order) = match options.method {
        SplitMethod::Hlbvh => hlbvh::build(&primitives, leaf_size, max_depth, progress),
        method => {
            let subtree = if method == SplitMethod::None {
                list(&primitives, progress)
            } else {
                let splitter = Splitter { method, leaf_size };
                TopDown {
                    splitter,
                    max_depth,
                    progress,
                }
                .build(&mut primitives, 0)
            };
            let order = primitives
                .par_iter()
                .map(BuildPrimitive::bits)
                .collect_vec();
            (subtree, order)
        }
    };
    drop(primitives);
    let order = order.into_iter().map(item_of_bits).collect();
    BinaryTree {
        root: Some(root),
        below,
        order,
    }
}

/// One leaf with all primitives.
fn list(primitives: &[BuildPrimitive], progress: Progress) -> Subtree {
    progress.advance(primitives.len());
    let root = Node::leaf(bounds_of(primitives), 0, primitives.len() as u32);
    Subtree {
        root,
        below: Vec::new(),
    }
}
