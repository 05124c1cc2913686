//! Sixteen numbers at once, by whatever instructions the machine has.
//!
//! An algorithm is written once, over the trait `Lanes`, as a `Kernel`; `Level::run` compiles it for each level and runs
//! the one asked for. All that a kernel calls on lanes must be inlined into it (`#[inline(always)]`), or it would be
//! compiled without the instructions.
//!
//! Another level (NEON, say) is a file that implements the four traits and a line in [`Level`].

mod lanes;
mod level;
mod portable;
mod unrolled;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use lanes::{F32s, F64s, LANES, Lanes, Mask};
pub(crate) use level::Kernel;
pub use level::{Level, UnavailableLevel};

#[cfg(test)]
mod tests;
