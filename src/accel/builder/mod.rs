//! Building a tree: from the primitives of a scene to nodes.

mod binning;
mod branch;
mod build_primitive;
mod full_leaves;
mod hlbvh;
mod lanes;
mod morton;
mod options;
mod partition;
mod radix_sort;
mod splitter;
mod top_down;
mod triangle_block;
mod visibility;

use self::build_primitive::bounds_of;
use self::full_leaves::LeafSize;
use self::splitter::Splitter;
use self::top_down::TopDown;
use super::SplitMethod;
use super::node::{Node, Subtree};
use crate::progress::Progress;
use crate::shape::PrimitiveId;
use rayon::prelude::*;

pub(super) use self::build_primitive::{BuildPrimitive, Collected, collect, space_around};
pub use self::options::BuildOptions;
pub(super) use self::visibility::Visibility;

/// No tree is deeper, so no traversal needs a longer stack: 64 levels of free choice, then halving.
pub(super) const MAX_DEPTH: usize = 96;

/// The tree over `primitives`, which are not empty, and their bits in the order of its leaves.
pub(super) fn build_tree(
    mut primitives: Vec<BuildPrimitive>,
    options: BuildOptions,
    progress: Progress,
) -> (Subtree, Vec<u32>) {
    let leaf_size = LeafSize(options.max_leaf.clamp(1, PrimitiveId::MAX_COUNT));
    let subtree = match options.method {
        SplitMethod::None => {
            progress.advance(primitives.len());
            Subtree {
                root: Node::leaf(bounds_of(&primitives), 0, primitives.len() as u32),
                below: Vec::new(),
            }
        }
        SplitMethod::Hlbvh => {
            return hlbvh::build(&primitives, leaf_size, MAX_DEPTH as u32, progress);
        }
        method => {
            let splitter = Splitter { method, leaf_size };
            TopDown {
                splitter,
                max_depth: MAX_DEPTH as u32,
                progress,
            }
            .build(&mut primitives, 0)
        }
    };
    (
        subtree,
        primitives.par_iter().map(BuildPrimitive::bits).collect(),
    )
}
