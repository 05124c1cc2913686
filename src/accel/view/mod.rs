//! The camera as the builder and the rasterizer see it: a matrix to the film, with error bounds.

mod camera_view;
mod magnitudes;
mod pixel_grid;
mod tile_frame;

pub(super) use self::camera_view::{CameraView, ROUNDING, UNDERFLOW};
pub(crate) use self::tile_frame::TILE;
pub(super) use self::tile_frame::TileFrame;
