//! Exact arithmetic: integers times powers of two, and functions rounded once.

pub mod degrees;
mod dyadic;

pub use dyadic::Dyadic;
