//! Primitives for crates that leave the test of one ray against one primitive to their users.

mod ball;
mod triangle;

pub(super) use ball::Ball;
pub(super) use triangle::Triangle;

use crate::geometry::Geometry;
use glam::Vec3A;

/// A primitive.
pub(super) trait Solid: Copy + Send + Sync {
    /// All of them, in the order of their numbers.
    fn all_of(geometry: &Geometry) -> Vec<Self>;

    /// The lowest and the highest corner of its box.
    fn bounds(&self) -> [Vec3A; 2];

    /// Where a ray first meets it, above 0 and below `t_max`.
    fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<f32>;
}
