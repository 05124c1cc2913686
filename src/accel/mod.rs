//! Aggregates: which primitives a ray has to be tested against.
//!
//! Every split method fills the same nodes, and one traversal visits them, so that methods can be compared.

mod aggregate;
mod build;
mod depth;
mod hit;
mod instance;
mod node;
mod overlap;
mod precision;
mod ray;
mod space;
mod split_method;
mod statistics;
mod tile;
mod tree;
mod validate;

pub use aggregate::Aggregate;
pub use build::BuildOptions;
pub use depth::Depth;
pub use hit::{Fallbacks, Hit, Work};
pub use precision::Precision;
pub use ray::Tracer;
pub use split_method::SplitMethod;
pub use statistics::Statistics;
pub(crate) use tile::TILE;
pub use tile::{TileOptions, TileTracer, Tiles, TracedTile};
