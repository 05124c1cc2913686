//! One ray at a time through a tree.

mod any_hit;
mod exact_search;
mod fast_search;
mod foreign_search;
mod nearest;
mod ties;
mod tracer;
mod traversal;

pub(super) use self::fast_search::FastSearch;
pub(super) use self::nearest::Nearest;
pub(super) use self::ties::Ties;
pub use self::tracer::Tracer;
pub(super) use self::traversal::Search;
