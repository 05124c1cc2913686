//! Exact or fast decisions.

use crate::named::named;

/// How hits are decided and rounded.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// The right result: `f64` if its error is known to be small enough, otherwise exact integers.
    #[default]
    Exact,
    /// Plain `f32` arithmetic without error bounds.
    Fast,
}

named!(Precision: Exact => "exact", Fast => "fast");
