//! Pictures of the boxes of a tree: a mesh of quads, and lines over a depth picture.

mod film_projection;
mod overlay;
mod palette;
mod ply_file;

pub use overlay::draw_boxes;
pub use palette::{Palette, Rgb};
pub use ply_file::write_ply;
