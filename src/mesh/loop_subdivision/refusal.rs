//! Reasons why a control mesh cannot be subdivided.

/// Why a surface cannot be subdivided.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// The part that is wrong.
    pub place: Place,
    /// What was found.
    pub message: String,
    /// What to do about it.
    pub advice: String,
}

/// The part of a surface that a [`Refusal`] is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A corner, counted from 0 through all faces.
    Index(usize),
    /// The number of levels.
    Levels,
}
