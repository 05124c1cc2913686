//! The section of a scene in a report.

use crate::bench::run::{PictureFiles, Row};

/// The section of a scene.
#[derive(Debug)]
pub struct Section {
    /// The scene's name, its size, and how it was measured.
    pub title: String,
    /// The measurements.
    pub rows: Vec<Row>,
    /// The pictures.
    pub pictures: PictureFiles,
}
