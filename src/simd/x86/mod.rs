//! Lanes in the registers of x86-64: SSE 4.1, AVX2 with FMA, AVX-512.
//!
//! The only unsafe code of the lanes. Each level has a file of operations on its registers, which are safe where the
//! instructions are switched on; [`level`] makes lanes of them. What proves that the machine has the instructions is a
//! token: it comes from `detect` alone, and lanes come from a token alone.
#![allow(unsafe_code)]

mod avx2;
mod avx512;
mod level;
mod sse;

pub(super) use avx2::Avx2;
pub(super) use avx512::Avx512;
pub(super) use sse::Sse;
