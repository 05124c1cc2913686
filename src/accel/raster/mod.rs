//! The tile rasterizer: finds the nearest hits of 16 x 16 rays at once.
//!
//! A tile finds primitives in a tree or in the bins of its view ([`bins`]), the nearest first. Seen
//! from a camera, the box of a node is a rectangle of pixels with a nearest point. A tile visits a
//! node if the rectangle overlaps the tile and some pixel of the overlap has not hit anything nearer
//! yet (hierarchical Z); entries of bins pass the same test. The triangles are then set up sixteen
//! at a time and rasterized into the tile's depth buffer, sixteen pixels at a time.
//!
//! Decisions are made in `f32` with bounds on their errors; see [`setup::setup_f32`], and
//! [`setup::setup_f64`] for the few triangles that need `f64`. Pixels that stay unresolved go to
//! the exact fallback, which tests single rays. Depths are computed last, for visible primitives
//! only; see [`depth_planes`].

mod bins;
mod depth_buffer;
mod depth_planes;
mod exact_fallback;
mod fronts;
mod instances;
mod rasterize;
mod resolve;
mod setup;
mod tile;
mod tile_kernel;
mod tile_tracer;
mod traced_tile;
mod traversal;

pub use tile_tracer::{TileOptions, TileTracer, Tiles};
pub use traced_tile::TracedTile;

#[cfg(test)]
mod tests;
