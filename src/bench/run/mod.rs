//! Runs all configurations of a scene in turn, and collects rows of measurements.

mod machine;
mod measure;
mod owned_structure;
mod pictures;
mod plan;
mod row;
mod spread;
mod surface_points;
mod total;
mod trace_parts;

pub use machine::Machine;
pub use measure::{Bench, Measured, timed};
pub use pictures::{PictureFiles, Pictures};
pub use plan::{Build, Plan, Rounds};
pub use row::Row;
pub use spread::Spread;
pub use total::totals;
pub use trace_parts::TraceParts;

#[cfg(test)]
pub(super) mod tests;
