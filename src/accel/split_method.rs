//! The methods of building a tree.

use crate::named::named;

/// How a tree is built (PBR book, 3rd edition, section 4.3). Images and hits do not depend on it.
///
/// The names, such as `"sah"`, are those of `--accel`.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum SplitMethod {
    /// No tree: one list of all primitives. Slow; a baseline for tests.
    None,
    /// Splits at the middle of the centroids' extent.
    Middle,
    /// Splits into two halves of equal count.
    Equal,
    /// Splits where the surface area heuristic is least.
    #[default]
    Sah,
    /// Groups primitives by Morton codes into treelets, and joins these by the surface area
    /// heuristic.
    Hlbvh,
}

named!(SplitMethod:
    None => "none",
    Middle => "middle",
    Equal => "equal",
    Sah => "sah",
    Hlbvh => "hlbvh",
);
