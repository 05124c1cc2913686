//! Compares two images of the same pixels: hits, primitives and depths, each kind apart.

mod comparison;
mod details;
pub mod picture;
mod tally;
mod ulps;

pub use comparison::{Comparison, Difference, Incomparable, MeasurePair, NumberPair};
pub use details::Details;
pub use picture::difference_picture;
pub use tally::Tally;
pub use ulps::{Ulps, ulps_between};
