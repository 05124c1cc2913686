//! Points, vectors, boxes, rays and transforms, all in `f64`.

mod bounds;
#[cfg(test)]
pub(crate) mod high_precision;
mod matrix;
mod point;
mod ray;
mod transform;
mod transform_error;

pub use bounds::Bounds;
pub use matrix::Matrix;
pub use point::{Point, Vector};
pub use ray::Ray;
pub use transform::Transform;
pub use transform_error::{RoundedTransform, TransformError};
