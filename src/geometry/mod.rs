//! Points, vectors, boxes, rays and transforms, all in `f64`.

mod point;

pub use point::{Point, Vector};
