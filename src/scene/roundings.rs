//! What the roundings of transforms do to a scene: followed on demand, since only a measurement asks.

use crate::geometry::RoundedTransform;
use std::sync::Arc;

/// How far rules R2 and R3 take the transforms of a scene from those that the file means.
#[derive(Debug)]
pub struct Roundings {
    /// The current transform at `Camera`, camera space from world space: the camera uses its inverse.
    pub camera: Arc<RoundedTransform>,
    /// The current transform at each `Shape` statement, in the order of shape numbers: the first is number 1.
    pub shapes: Vec<Arc<RoundedTransform>>,
    /// The current transform at each `ObjectInstance`.
    pub instances: Vec<Arc<RoundedTransform>>,
}

impl Default for Roundings {
    /// Those of a world without shapes, and of the default camera, which is exact.
    fn default() -> Roundings {
        Roundings {
            camera: Arc::new(RoundedTransform::IDENTITY),
            shapes: Vec::new(),
            instances: Vec::new(),
        }
    }
}
