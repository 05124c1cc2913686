//! Scene files: text to directives, directives to geometry.

pub mod spelling;
