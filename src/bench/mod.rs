//! Measures speed against error: builds and traces scenes by several accelerators and kernels, in
//! turn, and compares the answers with exact ones.

mod baseline;
mod error;
mod kernel;
mod report;
mod run;
mod trace;

pub use baseline::{Baseline, BaselineKernel};
pub use error::{Errors, GroundTruth, InputError, confidence_interval, has_ground_truth};
pub use kernel::Kernel;
pub use report::{
    Section, TextTable, accelerator_table, is_report, notes, ray_table, to_csv, to_html, to_json,
    to_markdown, to_svg,
};
pub use run::{
    Bench, Build, Machine, Measured, PictureFiles, Pictures, Plan, Rounds, Row, Spread, TraceParts,
    timed, totals,
};
