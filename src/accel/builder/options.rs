//! What may be chosen of a tree.

use crate::accel::SplitMethod;

/// How to build.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BuildOptions {
    /// How lists of primitives are split.
    pub method: SplitMethod,
    /// Primitives in a leaf at most (pbrt's `maxnodeprims`), 1 or more; without meaning for [`SplitMethod::None`].
    pub max_leaf: usize,
}

impl BuildOptions {
    /// As many as a test of a tile against a leaf takes at a time. pbrt's default is 4.
    pub const MAX_LEAF: usize = 16;

    /// `method` with leaves of the usual size.
    pub fn new(method: SplitMethod) -> BuildOptions {
        BuildOptions {
            method,
            max_leaf: Self::MAX_LEAF,
        }
    }
}
