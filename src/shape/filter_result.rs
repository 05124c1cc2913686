//! The result of a filter.

use crate::exact::Bracket;

/// What floating point decides about a ray and a primitive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FilterResult {
    /// Certainly no hit.
    Miss,
    /// Certainly a hit, at a `t` within the bracket.
    Hit(Bracket),
    /// Undecided: only exact arithmetic can decide.
    Unsure,
}
