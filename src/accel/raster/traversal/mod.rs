//! The traversal of a tile: nodes on the film, hierarchical Z, and blocks prefetched from memory.

mod hi_z;
mod node_footprints;
mod prefetch;
mod stack;
mod tile_from_tree;
mod tile_tree;

pub(super) use self::hi_z::{HiZ, pixel_blocks_between};
pub(super) use self::prefetch::PrefetchQueue;
pub(super) use self::stack::TileStack;
pub(super) use self::tile_from_tree::TileFromTree;
pub(super) use self::tile_tree::TileTree;

#[cfg(test)]
mod tests;
