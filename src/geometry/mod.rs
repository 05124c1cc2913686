//! Points, vectors, boxes, rays and transforms, all in `f64`.

mod bounds;
mod matrix;
mod motion;
mod point;
mod quaternion;
mod ray;
mod stretch;
mod transform;

pub use bounds::Bounds;
pub use matrix::Matrix;
pub use point::{Point, Vector};
pub use ray::Ray;
pub use transform::Transform;
