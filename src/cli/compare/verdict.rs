//! Whether two images differ by more than they may.

use super::{CompareArgs, DIFFERENT};
use crate::cli::terminal::words::counted;
use indicatif::HumanCount;
use std::fmt::{self, Display, Formatter};

/// Pixels that differ, and how many may.
#[derive(Debug, Clone, Copy)]
pub(super) struct Verdict {
    pub(super) different: u64,
    pub(super) max_pixels: u64,
    /// How far depths and surfaces are off at most, where no pixel differs.
    max_error: u32,
}

impl Verdict {
    pub(super) fn new(args: &CompareArgs, different: u64, max_error: u32) -> Verdict {
        Verdict {
            different,
            max_pixels: args.max_pixels,
            max_error,
        }
    }

    pub(super) fn exit_code(&self) -> u8 {
        if self.different > self.max_pixels {
            DIFFERENT
        } else {
            0
        }
    }
}

impl Display for Verdict {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match (self.different, self.max_error) {
            (0, 0) => f.write_str("equal"),
            (0, error) => write!(
                f,
                "equal, but for values that are off by up to {}",
                counted(error.into(), "ulp")
            ),
            (1, _) => write!(f, "1 pixel differs, {} may", HumanCount(self.max_pixels)),
            (different, _) => write!(
                f,
                "{} differ, {} may",
                counted(different, "pixel"),
                HumanCount(self.max_pixels)
            ),
        }
    }
}
