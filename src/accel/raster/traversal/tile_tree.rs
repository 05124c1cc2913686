//! A tree as a tile sees it.

use super::tile_from_tree::TileFromTree;
use crate::accel::tree::WideNode;

/// A tree as a tile sees it, over blocks of the type `B`.
pub(crate) struct TileTree<'a, B: ?Sized> {
    pub(crate) from_tree: TileFromTree,
    pub(crate) nodes: &'a [WideNode],
    pub(crate) blocks: &'a B,
}
