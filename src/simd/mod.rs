//! Sixteen SIMD lanes, with the best instruction set that the machine has.
//!
//! An algorithm is written once, over the trait `Lanes`, as a `SimdKernel`. `Level::run` compiles
//! it for each level and runs the chosen one. Every function that a kernel calls on lanes must be
//! inlined into it (`#[inline(always)]`), or it would be compiled without the instruction set.
//!
//! To add a level, such as NEON, implement the four traits in a file and add a variant to
//! [`Level`].
//!
//! `text` works on bytes instead, for readers of text. It needs no level: every x86-64 has SSE2.

mod lanes;
mod level;
mod portable;
mod text;
mod unrolled;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use lanes::{F32s, F64s, LANES, Lanes, Mask, SimdKernel, TABLE};
pub use level::Level;
pub(crate) use text::{blanks, four_numbers};

#[cfg(test)]
mod tests;
