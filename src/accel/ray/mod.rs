//! Single rays through the trees, with different searches for the nearest hit.

mod any_hit;
mod binary_traversal;
mod box_test;
mod closure_search;
mod exact_search;
mod fast_search;
mod narrow_ray;
mod nearest;
mod placed_boxes;
mod search;
mod surely_missed;
mod ties;
mod tracer;
mod wide_stack;
mod wide_traversal;

pub(super) use self::fast_search::FastSearch;
pub(super) use self::nearest::Nearest;
pub(super) use self::search::Search;
pub(super) use self::ties::Ties;
pub use self::tracer::{Tracer, TracerMemory};

#[cfg(test)]
mod tests;
