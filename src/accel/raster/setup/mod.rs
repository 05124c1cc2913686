//! Primitive setup: from sixteen primitives to footprints and linear functions of the pixel.

pub(super) mod setup_f32;
pub(super) mod setup_f64;

mod corners_f64;
mod edge_planes;
mod edge_setup;
mod error_bounds_f64;
mod footprint;
mod lane_vectors;
mod projected_corners;
mod quadric_bounds;

pub(super) use self::corners_f64::{CornersF64, Coverage, TrianglesF64};
pub(super) use self::edge_planes::{EdgePlanes, PixelFunction, Setup};
pub(super) use self::footprint::Footprint;
pub(super) use self::lane_vectors::{cross, dot, row_times};
pub(super) use self::quadric_bounds::QuadricBounds;
