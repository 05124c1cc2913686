//! Build options.

use crate::accel::SplitMethod;

/// Chooses how trees are built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BuildOptions {
    /// The split method.
    pub method: SplitMethod,
    /// The largest number of primitives in a leaf (pbrt's `maxnodeprims`), 1 or more.
    /// [`SplitMethod::None`] ignores it.
    pub max_leaf: usize,
}

impl BuildOptions {
    /// The default: a tile tests this many primitives at once. pbrt's default is 4.
    pub const MAX_LEAF: usize = 16;

    /// `method` with the default leaf size.
    pub fn new(method: SplitMethod) -> BuildOptions {
        BuildOptions {
            method,
            max_leaf: Self::MAX_LEAF,
        }
    }
}
