//! Aggregates: which primitives a ray has to be tested against.
//!
//! Every split method fills the same nodes, and one traversal visits them, so that methods can be compared.

mod aggregate;
mod anchor_space;
mod build_primitive;
mod hlbvh;
mod node;
mod split_method;
mod splitter;
mod statistics;
mod top_down;
mod traversal;
mod validate;

pub use aggregate::{Aggregate, BuildOptions};
pub use split_method::SplitMethod;
pub use statistics::Statistics;
pub use traversal::{Hit, Tracer, Work};
