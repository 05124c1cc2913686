//! Speed against error: accelerators and kernels measured in turn, their answers compared with the exact ones, and what came of it
//! told in tables, files for programs, a plot and a page.

mod caster;
mod confidence;
mod csv;
mod errors;
mod input_error;
mod json;
mod judge;
mod kernel;
mod machine;
mod markdown;
mod measure;
mod pareto;
mod pictures;
mod pixels;
mod plan;
mod plot;
mod random;
mod report;
mod row;
mod spread;
mod surface_points;
mod table;
mod text_table;
mod total;
mod yardstick;

pub use confidence::confidence_interval;
pub use csv::to_csv;
pub use errors::Errors;
pub use input_error::InputError;
pub use json::to_json;
pub use judge::{Judge, can_be_judged, judged_pixels};
pub use kernel::Kernel;
pub use machine::Machine;
pub use markdown::to_markdown;
pub use measure::{Bench, Measured, timed};
pub use pictures::{PictureFiles, Pictures};
pub use plan::{Plan, Rounds};
pub use plot::to_svg;
pub use report::{Section, is_report, notes, to_html};
pub use row::Row;
pub use spread::Spread;
pub use table::{ray_table, tree_table};
pub use text_table::TextTable;
pub use total::totals;
pub use yardstick::{Classic, Yardstick};
