//! Lanes in the registers of x86-64: SSE 4.1, AVX2 with FMA, AVX-512.
//!
//! This module has the only unsafe code of `simd`. Each level has a file of operations on its
//! registers, which are safe where the instruction set is enabled; the macro [`level`] builds lanes
//! from them. A token proves that the machine has the instruction set: only `detect` returns one,
//! and lanes can only be made with one.
#![allow(unsafe_code)]

mod avx2;
mod avx512;
mod level;
mod sse;
mod text;

pub(super) use avx2::Avx2;
pub(super) use avx512::Avx512;
pub(super) use sse::Sse;
pub(super) use text::{blanks, four_numbers};
