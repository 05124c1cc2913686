//! How fast accelerators are built and traced: measured, and told in a table and in JSON.

mod input_error;
mod json;
mod machine;
mod measure;
mod row;
mod spread;
mod table;
mod yardstick;

pub use input_error::InputError;
pub use json::to_json;
pub use machine::Machine;
pub use measure::{Configuration, Rounds, measure};
pub use row::{Errors, Row};
pub use spread::Spread;
pub use table::Table;
pub use yardstick::{Classic, Yardstick};
