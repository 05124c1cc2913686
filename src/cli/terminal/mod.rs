//! The output of commands: results on standard output, messages and progress on standard error.

mod batch_progress;
pub(super) mod failures;
pub(super) mod progress;
mod repetitions;
pub(super) mod reporter;
pub(super) mod scene_summary;
pub(super) mod stdout;
pub(super) mod words;
