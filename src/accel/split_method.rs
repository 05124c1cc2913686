//! The methods of building a tree.

use std::fmt;
use std::str::FromStr;

/// How an aggregate is built (PBR book, 3rd edition, section 4.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SplitMethod {
    /// No tree: one list of all primitives. Slow; a baseline for tests.
    None,
    /// Splits at the middle of the centroids' extent.
    Middle,
    /// Splits into two halves of equal count.
    Equal,
    /// Splits where the surface area heuristic is least.
    Sah,
    /// Groups primitives by Morton codes into treelets, and joins these by the surface area
    /// heuristic.
    Hlbvh,
}

impl SplitMethod {
    /// All of them, simplest first.
    pub const ALL: [SplitMethod; 5] = [
        SplitMethod::None,
        SplitMethod::Middle,
        SplitMethod::Equal,
        SplitMethod::Sah,
        SplitMethod::Hlbvh,
    ];

    /// The name on the command line and in scene files.
    pub fn name(self) -> &'static str {
        match self {
            SplitMethod::None => "none",
            SplitMethod::Middle => "middle",
            SplitMethod::Equal => "equal",
            SplitMethod::Sah => "sah",
            SplitMethod::Hlbvh => "hlbvh",
        }
    }
}

impl fmt::Display for SplitMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The name is none of the known ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UnknownSplitMethod;

impl fmt::Display for UnknownSplitMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = SplitMethod::ALL.map(SplitMethod::name);
        write!(f, "expected one of {}", names.join(", "))
    }
}

impl std::error::Error for UnknownSplitMethod {}

impl FromStr for SplitMethod {
    type Err = UnknownSplitMethod;

    fn from_str(name: &str) -> Result<SplitMethod, UnknownSplitMethod> {
        SplitMethod::ALL
            .into_iter()
            .find(|method| method.name() == name)
            .ok_or(UnknownSplitMethod)
    }
}
