//! Measures and checks of finished trees.

mod anatomy;
mod node_boxes;
mod overlap;
mod statistics;
mod validate;

pub use self::anatomy::{Anatomy, Level, TreeKind};
pub use self::node_boxes::NodeBox;
pub use self::statistics::Statistics;
