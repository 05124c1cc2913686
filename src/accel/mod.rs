//! Aggregates: which primitives a ray has to be tested against.
//!
//! Every split method fills the same nodes, and the same traversals visit them, so that methods can
//! be compared.

mod accelerator;
mod aggregate;
mod bins;
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
mod structure;
mod tree;
mod view;

pub use accelerator::Accelerator;
pub use aggregate::Aggregate;
pub use bins::Bins;
pub use builder::BuildOptions;
pub use depth::{Depth, distance_bracket};
pub use hit::{ExactFallbacks, Hit, TraversalCounts};
pub use precision::Precision;
pub use quality::{Anatomy, Level, NodeBox, Statistics, TreeKind};
pub use raster::{TileOptions, TileTracer, Tiles, TracedTile};
pub use ray::{Tracer, TracerMemory};
pub use split_method::SplitMethod;
pub use structure::Structure;
pub(crate) use view::TILE;
