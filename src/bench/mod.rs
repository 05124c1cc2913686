//! How fast accelerators are built and traced: measured, and told in a table and in JSON.

mod json;
mod machine;
mod measure;
mod row;
mod spread;
mod table;
mod yardstick;

pub use json::to_json;
pub use machine::Machine;
pub use measure::{Configuration, Rounds, measure};
pub use row::{Errors, Row};
pub use spread::Spread;
pub use table::Table;
pub use yardstick::{Classic, Yardstick};
