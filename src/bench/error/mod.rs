//! Errors of answers: against exact ground truth, and bounds on the error of the input itself.

mod confidence;
mod errors;
mod ground_truth;
mod input_rounding;

pub use confidence::confidence_interval;
pub use errors::Errors;
pub(super) use ground_truth::{Checked, SEED};
pub use ground_truth::{GroundTruth, has_ground_truth};
pub use input_rounding::InputError;
