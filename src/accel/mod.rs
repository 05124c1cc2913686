//! Aggregates: which primitives a ray has to be tested against.
//!
//! Every split method fills the same nodes, and one traversal visits them, so that methods can be compared.

mod aggregate;
mod anchor_space;
mod any_hit;
mod binning;
mod box32;
mod branch;
mod build_primitive;
mod depth;
mod exact_search;
mod fast_search;
mod full_leaves;
mod hit;
mod hlbvh;
mod lanes;
mod morton;
mod node;
mod partition;
mod precision;
mod radix_sort;
mod rounding;
mod slab_ray;
mod split_method;
mod splitter;
mod statistics;
mod tile;
mod top_down;
mod tracer;
mod traversal;
mod triangle_block;
mod validate;
mod visibility;

pub use aggregate::{Aggregate, BuildOptions};
pub use depth::Depth;
pub use hit::{Fallbacks, Hit, Work};
pub use precision::Precision;
pub use split_method::SplitMethod;
pub use statistics::Statistics;
pub(crate) use tile::TILE;
pub use tile::{TileOptions, TileTracer, Tiles, TracedTile};
pub use tracer::Tracer;
