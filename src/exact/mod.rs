//! Exact arithmetic: integers times powers of two, roots compared by signs, and functions rounded
//! once.

mod approximation;
mod bracket;
pub mod degrees;
mod dyadic;
mod integer;
mod nearest;
mod pair;
mod powers;
mod root;
mod rounded;
mod underflow;
mod vector;

pub use approximation::Approximation;
pub use bracket::Bracket;
pub use dyadic::Dyadic;
pub use nearest::nearest_f32;
pub use pair::Pair;
pub use powers::{UNIT_ROUNDOFF, exponent_of, power_of_two, times_power_of_two};
pub use root::Root;
pub use rounded::Rounded;
pub use underflow::may_underflow_below;
pub use vector::ExactVector;
