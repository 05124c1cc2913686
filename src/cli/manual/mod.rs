//! The manual: pages, completions for shells, and the version.

pub(super) mod completions;
pub(super) mod man;
pub(super) mod version;
