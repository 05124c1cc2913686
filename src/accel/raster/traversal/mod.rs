//! The traversal of a tile: nodes on the film, hierarchical Z, and blocks prefetched from memory.

mod hi_z;
mod node_footprints;
mod prefetch;
mod stack;
mod tile_from_tree;

pub(super) use self::hi_z::{HiZ, pixel_blocks_between};
pub(super) use self::prefetch::{PrefetchQueue, TileTree};
pub(super) use self::stack::TileStack;
pub(super) use self::tile_from_tree::TileFromTree;

#[cfg(test)]
mod tests;
