//! Reports rows as text, Markdown, HTML, CSV, JSON and plots.

mod columns;
mod csv;
mod html;
mod json;
mod markdown;
mod marks;
mod notes;
mod page;
mod pareto;
mod plot;
mod scale;
mod table;
mod value;

pub use columns::{accelerator_table, ray_table};
pub use csv::to_csv;
pub use json::to_json;
pub use markdown::to_markdown;
pub use notes::notes;
pub use page::{Section, is_report, to_html};
pub use plot::to_svg;
pub use table::TextTable;
