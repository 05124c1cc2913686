//! Reports rows as text, Markdown, HTML, CSV, JSON and plots.

mod columns;
mod contents;
mod csv;
mod figures;
mod html;
mod json;
mod markdown;
mod notes;
mod page;
mod plot;
mod section;
mod summary;
mod table;
mod value;

pub use columns::{accelerator_table, ray_table};
pub use csv::to_csv;
pub use json::to_json;
pub use markdown::to_markdown;
pub use notes::notes;
pub use page::{is_report, to_html};
pub use plot::to_svg;
pub use section::Section;
pub use table::TextTable;
