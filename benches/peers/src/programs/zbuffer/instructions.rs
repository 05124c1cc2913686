//! Runs loops as compiled for the widest instruction set of this machine, or for a smaller one.

#![allow(unsafe_code)]

use crate::args::Isa;

/// What the loops may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Instructions {
    /// The least of x86-64, or another architecture.
    Portable,
    Sse41,
    Avx2,
    Avx512,
}

/// Loops that the compiler translates once for each instruction set. Everything that they call
/// must be `#[inline(always)]`.
pub(super) trait Work {
    fn run(self);
}

impl Instructions {
    /// The widest that this machine has, up to that of `limit`.
    pub(super) fn detect(limit: Option<Isa>) -> Instructions {
        let limit = match limit {
            None | Some(Isa::Avx512) => Instructions::Avx512,
            Some(Isa::Avx2) => Instructions::Avx2,
            Some(Isa::Avx | Isa::Sse42) => Instructions::Sse41,
            Some(Isa::Sse2) => Instructions::Portable,
        };
        limit.min(widest())
    }

    /// Runs `work`.
    pub(super) fn run(self, work: impl Work) {
        #[cfg(target_arch = "x86_64")]
        match self {
            // SAFETY: `detect` returns only what this machine has.
            Instructions::Avx512 => return unsafe { avx512(work) },
            // SAFETY: as above.
            Instructions::Avx2 => return unsafe { avx2(work) },
            // SAFETY: as above.
            Instructions::Sse41 => return unsafe { sse41(work) },
            Instructions::Portable => {}
        }
        work.run();
    }
}

/// Asks the memory for something that will be read soon.
#[inline(always)]
pub(super) fn prefetch<T>(item: &T) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: a prefetch changes nothing, whatever the address.
    unsafe {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(item).cast());
    }
}

#[cfg(target_arch = "x86_64")]
fn widest() -> Instructions {
    let has_avx2 = is_x86_feature_detected!("avx2");
    let has_avx512 = is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl");
    match (has_avx512, has_avx2, is_x86_feature_detected!("sse4.1")) {
        (true, true, true) => Instructions::Avx512,
        (false, true, true) => Instructions::Avx2,
        (_, _, true) => Instructions::Sse41,
        _ => Instructions::Portable,
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn widest() -> Instructions {
    Instructions::Portable
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2")]
fn avx512(work: impl Work) {
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2(work: impl Work) {
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "sse4.1")]
fn sse41(work: impl Work) {
    work.run();
}
