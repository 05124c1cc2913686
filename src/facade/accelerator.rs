//! The trees that a user may build.

use crate::accel::SplitMethod;
use crate::error::Error;
use crate::named::UnknownName;
use std::fmt;
use std::str::FromStr;

/// How the tree of a [`Structure`](crate::Structure) is split. Images and hits do not depend on it.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Accelerator {
    /// One node that holds all primitives: each ray tests all of them.
    None,
    /// Nodes are split in the middle.
    Middle,
    /// Nodes are split into halves of equal numbers.
    Equal,
    /// Nodes are split by the surface area heuristic.
    #[default]
    Sah,
    /// Groups of neighbours are joined by the surface area heuristic.
    Hlbvh,
}

impl Accelerator {
    /// All of them.
    pub const ALL: &'static [Accelerator] = &[
        Accelerator::None,
        Accelerator::Middle,
        Accelerator::Equal,
        Accelerator::Sah,
        Accelerator::Hlbvh,
    ];

    /// The name, as in `--accel`.
    pub fn name(self) -> &'static str {
        self.split_method().name()
    }

    pub(super) fn split_method(self) -> SplitMethod {
        match self {
            Accelerator::None => SplitMethod::None,
            Accelerator::Middle => SplitMethod::Middle,
            Accelerator::Equal => SplitMethod::Equal,
            Accelerator::Sah => SplitMethod::Sah,
            Accelerator::Hlbvh => SplitMethod::Hlbvh,
        }
    }
}

impl fmt::Display for Accelerator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Accelerator {
    type Err = Error;

    fn from_str(name: &str) -> Result<Accelerator, Error> {
        let mut all = Accelerator::ALL.iter().copied();
        all.find(|accelerator| accelerator.name() == name)
            .ok_or_else(|| {
                let names: Vec<&str> = Accelerator::ALL.iter().map(|known| known.name()).collect();
                Error::usage(UnknownName::new(name, &names).to_string())
            })
    }
}
