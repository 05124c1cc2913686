//! One ray at a time through a tree.

mod any_hit;
mod exact_search;
mod fast_search;
mod foreign_search;
mod tracer;
mod traversal;

pub(super) use self::exact_search::ExactSearch;
pub(super) use self::fast_search::FastSearch;
pub use self::tracer::Tracer;
pub(super) use self::traversal::Search;
