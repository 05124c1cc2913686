//! Where the shapes of a scene are: their boxes, what is odd about them, and which of them a camera
//! may see.
//!
//! Everything here is decided by boxes, without a ray. A box may be larger than its shape, so a
//! shape that is said to be out of the picture certainly is; one that reaches it may still be
//! hidden.

mod oddity;
mod shapes;
mod sight;
mod view_volume;

pub use oddity::{Finding, Oddity};
pub use shapes::{Source, Survey, SurveyedShape};
pub use sight::Sight;
pub use view_volume::{ViewVolume, Visibility};
