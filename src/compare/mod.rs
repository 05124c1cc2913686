//! What is different between two images of the same pixels: hits, primitives and depths, each kind apart.

mod comparison;
mod tally;
mod ulps;

pub use comparison::{Comparison, Difference, Incomparable};
pub use tally::Tally;
pub use ulps::{Ulps, ulps_between};
