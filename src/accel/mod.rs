//! Aggregates: which primitives a ray has to be tested against.
//!
//! Every split method fills the same nodes, and one traversal visits them, so that methods can be compared.

mod aggregate;
mod builder;
mod depth;
mod hit;
mod instance;
mod node;
mod overlap;
mod precision;
mod raster;
mod ray;
mod space;
mod split_method;
mod statistics;
mod tree;
mod validate;

pub use aggregate::Aggregate;
pub use builder::BuildOptions;
pub use depth::Depth;
pub use hit::{ExactFallbacks, Hit, TraversalCounts};
pub use precision::Precision;
pub(crate) use raster::TILE;
pub use raster::{TileOptions, TileTracer, Tiles, TracedTile};
pub use ray::Tracer;
pub use split_method::SplitMethod;
pub use statistics::Statistics;
