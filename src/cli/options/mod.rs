//! Options that several commands share, and parsers of their values.

pub(super) mod batch;
pub(super) mod cameras;
pub(super) mod engine;
pub(super) mod input;
pub(super) mod messages;
pub(super) mod output;
pub(super) mod region;
pub(super) mod scene;
pub(super) mod values;
