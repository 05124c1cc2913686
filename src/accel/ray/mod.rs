//! Single rays through the trees, with different searches for the nearest hit.

mod any_hit;
mod closure_search;
mod exact_search;
mod fast_search;
mod nearest;
mod ties;
mod tracer;
mod traversal;

pub(super) use self::fast_search::FastSearch;
pub(super) use self::nearest::Nearest;
pub(super) use self::ties::Ties;
pub use self::tracer::Tracer;
pub(super) use self::traversal::Search;
