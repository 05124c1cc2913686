//! A factor for the limits on what input files may expand to.

use std::fmt;
use std::num::NonZeroU32;

/// The largest expansion of a file that is not made to fill the memory.
pub(super) const MOST_TIMES: u64 = 256;
/// The bytes that an image may have beyond that: one of misses alone shrinks a thousand times.
const FREE_IMAGE: u64 = 256 << 20;

/// The command line's flag that raises all limits.
const FLAG: &str = "--input-budget";

/// A factor for the usual limits on expansion; 1 by default.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BudgetFactor(NonZeroU32);

impl BudgetFactor {
    /// The usual limits.
    pub const ONCE: BudgetFactor = BudgetFactor(NonZeroU32::MIN);
    /// The largest factor.
    pub const MAX: u32 = 1_000_000;

    /// `factor`, if it is from 1 to [`BudgetFactor::MAX`].
    pub fn new(factor: u32) -> Option<BudgetFactor> {
        NonZeroU32::new(factor)
            .filter(|factor| factor.get() <= Self::MAX)
            .map(BudgetFactor)
    }

    pub(super) fn times(self, limit: u64) -> u64 {
        limit.saturating_mul(self.0.get().into())
    }

    /// The bytes that the pixels of an image may take if its file has `size` bytes.
    pub(crate) fn image_limit(self, size: u64) -> u64 {
        self.times(size.saturating_mul(MOST_TIMES).saturating_add(FREE_IMAGE))
    }

    /// The advice when a limit is reached.
    pub(crate) fn advice(self) -> String {
        let wanted = self.0.get().saturating_mul(2).min(Self::MAX);
        format!("if this is meant, raise what input files may expand to: {FLAG} {wanted}")
    }
}

impl Default for BudgetFactor {
    fn default() -> BudgetFactor {
        BudgetFactor::ONCE
    }
}

impl fmt::Display for BudgetFactor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
