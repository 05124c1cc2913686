//! The names of all structures: bins, or a tree by one of the split methods.

use super::split_method::SplitMethod;
use crate::named::named;

/// How rays find primitives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Accelerator {
    /// No tree: the primitives of a view are sorted into [`Bins`](super::Bins).
    Raster,
    /// A tree over the whole scene.
    Tree(SplitMethod),
}

named!(Accelerator:
    Raster => "raster",
    Tree(SplitMethod::None) => "none",
    Tree(SplitMethod::Middle) => "middle",
    Tree(SplitMethod::Equal) => "equal",
    Tree(SplitMethod::Sah) => "sah",
    Tree(SplitMethod::Hlbvh) => "hlbvh",
);
