//! Instruction sets: detection, names, and running a kernel with one.

use super::lanes::SimdKernel;
use super::portable::Portable;
use std::fmt;
use std::str::FromStr;

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

impl Level {
    /// All levels of this architecture, the simplest first.
    pub const ALL: &[Level] = &[
        Level::Portable,
        #[cfg(target_arch = "x86_64")]
        Level::Sse,
        #[cfg(target_arch = "x86_64")]
        Level::Avx2,
        #[cfg(target_arch = "x86_64")]
        Level::Avx512,
    ];

    /// The best level that this machine has.
    pub fn detect() -> Level {
        Level::ALL
            .iter()
            .copied()
            .rfind(|level| level.is_available())
            .unwrap_or(Level::Portable)
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

    /// The name in reports and on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            Level::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Level::Sse => "sse4.1",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "avx512",
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

impl FromStr for Level {
    type Err = UnavailableLevel;

    fn from_str(name: &str) -> Result<Level, UnavailableLevel> {
        let mut available = Level::ALL
            .iter()
            .copied()
            .filter(|level| level.is_available());
        available
            .find(|level| level.as_str() == name)
            .ok_or(UnavailableLevel)
    }
}

/// The error for a name that is no instruction set of this machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UnavailableLevel;

impl fmt::Display for UnavailableLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let available = Level::ALL
            .iter()
            .copied()
            .filter(|level| level.is_available());
        let names: Vec<_> = available.map(Level::as_str).collect();
        write!(f, "this machine has {}", names.join(", "))
    }
}

impl std::error::Error for UnavailableLevel {}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}
