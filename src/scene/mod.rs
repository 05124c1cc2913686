//! Scene files: text to directives, directives to geometry.

pub mod parser;
pub mod spelling;
