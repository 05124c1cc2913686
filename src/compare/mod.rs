//! What is different between two images of the same pixels: hits, primitives and depths, each kind apart. Of pictures for people,
//! what is different in their colours.

mod colors;
mod comparison;
mod details;
pub mod picture;
mod tally;
mod ulps;

pub use colors::{ColorComparison, ColorDifference, ColorTally, Hits};
pub use comparison::{Comparison, Difference, Incomparable, Pair};
pub use details::Details;
pub use picture::difference_picture;
pub use tally::Tally;
pub use ulps::{Ulps, ulps_between};
