//! Measures and checks of finished trees.

mod overlap;
mod statistics;
mod validate;

pub use self::statistics::Statistics;
