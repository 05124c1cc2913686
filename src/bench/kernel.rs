//! The ways to decide hits that are compared.

use super::Classic;
use crate::accel::Precision;
use std::fmt;
use std::str::FromStr;

/// How rays travel and how hits are decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kernel {
    /// As `render` does: tiles of rays together.
    Tiles(Precision),
    /// Exact answers, a ray at a time: the traversal that the classic kernels have, too.
    ExactSingle,
    /// A yardstick, a ray at a time.
    Classic(Classic),
}

impl Kernel {
    /// All of them, ours first.
    pub const ALL: [Kernel; 5] = [
        Kernel::Tiles(Precision::Exact),
        Kernel::Tiles(Precision::Fast),
        Kernel::ExactSingle,
        Kernel::Classic(Classic::MoellerTrumbore),
        Kernel::Classic(Classic::Watertight),
    ];

    /// The name on the command line and in results.
    pub fn name(self) -> &'static str {
        match self {
            Kernel::Tiles(precision) => precision.name(),
            Kernel::ExactSingle => "exact-single",
            Kernel::Classic(Classic::MoellerTrumbore) => "moeller-trumbore",
            Kernel::Classic(Classic::Watertight) => "watertight",
        }
    }

    /// Whether integers decide what `f64` cannot.
    pub fn is_exact(self) -> bool {
        matches!(self, Kernel::Tiles(Precision::Exact) | Kernel::ExactSingle)
    }
}

impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The name is none of the known ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UnknownKernel;

impl fmt::Display for UnknownKernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "expected some of {}",
            Kernel::ALL.map(Kernel::name).join(", ")
        )
    }
}

impl std::error::Error for UnknownKernel {}

impl FromStr for Kernel {
    type Err = UnknownKernel;

    fn from_str(name: &str) -> Result<Kernel, UnknownKernel> {
        Kernel::ALL
            .into_iter()
            .find(|kernel| kernel.name() == name)
            .ok_or(UnknownKernel)
    }
}
