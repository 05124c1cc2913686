//! The traversal of a tile: projected nodes, hierarchical Z, and blocks prefetched from memory.

mod film_from_tree;
mod hi_z;
mod prefetch;
mod projected_node;
mod stack;

pub(super) use self::film_from_tree::FilmFromTree;
pub(super) use self::hi_z::{HiZ, pixel_blocks_between};
pub(super) use self::prefetch::{PrefetchQueue, ViewTree};
pub(super) use self::projected_node::{ProjectNodes, ProjectedNode, project};
pub(super) use self::stack::TileStack;
