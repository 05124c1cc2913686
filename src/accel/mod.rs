//! Aggregates: which primitives a ray has to be tested against.
//!
//! Every split method fills the same nodes, and the same traversals visit them, so that methods can
//! be compared.

mod aggregate;
mod builder;
mod depth;
mod hit;
mod instance;
mod precision;
mod quality;
mod raster;
mod ray;
mod space;
mod split_method;
mod tree;
mod view;

pub use aggregate::Aggregate;
pub use builder::BuildOptions;
pub use depth::Depth;
pub use hit::{ExactFallbacks, Hit, TraversalCounts};
pub use precision::Precision;
pub use quality::Statistics;
pub use raster::{TileOptions, TileTracer, Tiles, TracedTile};
pub use ray::Tracer;
pub use split_method::SplitMethod;
pub(crate) use view::TILE;
