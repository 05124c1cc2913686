//! What floating point can tell of a primitive and a ray.

use crate::exact::Bracket;

/// The answer of a filter: right where it is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FilterResult {
    /// Surely no hit.
    Miss,
    /// Surely a hit, at a `t` within the bracket.
    Hit(Bracket),
    /// Too close to call: only exact arithmetic can tell.
    Unsure,
}
