//! Tiles of rays that travel together.
//!
//! All rays of a tile visit a node at once: seen from a camera, the box of a node is a rectangle of pixels with a
//! nearest point, and the tile visits it if they overlap, and if some pixel of the overlap has hit nothing nearer yet. Sixteen
//! triangles are then prepared at once and drawn into the tile's pixels, sixteen pixels at once.
//!
//! Decisions are made in `f32` with bounds on their errors; see [`narrow`], and [`wide`] for the few triangles that need `f64`. What
//! the bounds leave open is settled by the exact search for single rays. Depths are worked out last, for what is hit; see [`kept`].

mod ahead;
mod block;
mod cast;
mod corners;
mod draw;
mod frame;
mod fronts;
mod instances;
mod kept;
mod narrow;
mod pixels;
mod planes;
mod resolve;
mod search;
mod spheres;
mod traced;
mod tracer;
mod view;
mod view_node;
mod walk;
mod wide;
mod wide_tree;

pub(super) use block::{BLOCK, Block, blocks_of};
pub(crate) use frame::TILE;
pub use traced::TracedTile;
pub use tracer::{TileOptions, TileTracer, Tiles};
pub(super) use view::{MAX_PIXEL_ERROR, OnFilm, View};
pub(super) use wide_tree::runs_of;
pub(crate) use wide_tree::{Run, WideTree};

#[cfg(test)]
mod tests;
