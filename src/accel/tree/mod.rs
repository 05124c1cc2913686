//! Trees as data: binary nodes, the wide tree collapsed from them, and blocks of primitives.

mod binary;
mod bounding_ellipsoid;
mod collapse;
mod measure;
mod node;
mod primitive_block;
mod wide;

pub(super) use self::binary::{BinaryTree, MAX_DEPTH};
pub(super) use self::bounding_ellipsoid::SHAPE_ENTRIES;
pub(super) use self::collapse::collapse;
pub(super) use self::node::{Children, Node, PackedNode, Subtree};
pub(super) use self::primitive_block::{
    BLOCK_SIZE, PrimitiveBlock, TriangleLanes, primitive_blocks,
};
pub(super) use self::wide::{Child, Run, WideNode, WideTree};
