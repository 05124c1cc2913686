//! The kernels that `bench` compares.

use super::baseline::Baseline;
use crate::accel::{Accelerator, Precision};
use crate::named::named;

/// How rays are traced and how hits are decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kernel {
    /// As `render` does: tiles of rays.
    Tiles(Precision),
    /// Exact answers, one ray at a time: the same traversal as the baseline kernels.
    ExactSingle,
    /// A baseline kernel, one ray at a time.
    Baseline(Baseline),
}

named!(Kernel:
    Tiles(Precision::Exact) => "exact", Tiles(Precision::Fast) => "fast",
    ExactSingle => "exact-single", Baseline(Baseline::MoellerTrumbore) => "moeller-trumbore",
    Baseline(Baseline::Watertight) => "watertight",
);

impl Kernel {
    /// Returns true if exact fallbacks decide what `f64` cannot.
    pub fn is_exact(self) -> bool {
        matches!(self, Kernel::Tiles(Precision::Exact) | Kernel::ExactSingle)
    }

    /// Returns true if the kernel traces single rays, which find primitives in a tree only.
    pub fn needs_tree(self) -> bool {
        !matches!(self, Kernel::Tiles(_))
    }

    /// Returns true if the kernel can be measured with `accelerator`.
    pub fn suits(self, accelerator: Accelerator) -> bool {
        !self.needs_tree() || accelerator != Accelerator::Raster
    }
}
