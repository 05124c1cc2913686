//! Instruction sets: detection, names, and running a kernel with one.

use super::lanes::SimdKernel;
use super::portable::Portable;
use crate::named::named;

/// An instruction set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Plain code that the compiler may vectorize, on any machine.
    Portable,
    /// SSE 4.1: four lanes per register.
    #[cfg(target_arch = "x86_64")]
    Sse,
    /// AVX2 and FMA: eight lanes per register.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// AVX-512 F, DQ, BW, VL: sixteen lanes per register.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

named!(Level:
    Portable => "portable",
    #[cfg(target_arch = "x86_64")]
    Sse => "sse4.1",
    #[cfg(target_arch = "x86_64")]
    Avx2 => "avx2",
    #[cfg(target_arch = "x86_64")]
    Avx512 => "avx512",
);

impl Level {
    /// The levels that this machine has, the simplest first.
    pub fn available() -> impl Iterator<Item = Level> {
        Level::ALL.into_iter().filter(|level| level.is_available())
    }

    /// The best level that this machine has.
    pub fn detect() -> Level {
        Level::available().last().unwrap_or(Level::Portable)
    }

    /// Tests whether this machine has the instruction set.
    pub fn is_available(self) -> bool {
        match self {
            Level::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Level::Sse => super::x86::Sse::detect().is_some(),
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => super::x86::Avx2::detect().is_some(),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => super::x86::Avx512::detect().is_some(),
        }
    }

    /// Runs `kernel` with this instruction set, or as plain code if the machine does not have it.
    pub(crate) fn run<K: SimdKernel>(self, kernel: K) -> K::Output {
        #[cfg(target_arch = "x86_64")]
        {
            use super::x86::{Avx2, Avx512, Sse};
            match self {
                Level::Portable => {}
                Level::Sse => {
                    if let Some(sse) = Sse::detect() {
                        return sse.run(kernel);
                    }
                }
                Level::Avx2 => {
                    if let Some(avx2) = Avx2::detect() {
                        return avx2.run(kernel);
                    }
                }
                Level::Avx512 => {
                    if let Some(avx512) = Avx512::detect() {
                        return avx512.run(kernel);
                    }
                }
            }
        }
        kernel.run(Portable)
    }
}
