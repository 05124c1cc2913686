//! Exact arithmetic: integers times powers of two, and functions rounded once.

pub mod degrees;
mod dyadic;
mod powers;

pub use dyadic::Dyadic;
pub use powers::{exponent_of, power_of_two};
