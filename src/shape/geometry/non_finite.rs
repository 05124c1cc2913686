//! Counts the vertices that are not finite.

use crate::geometry::{Matrix, Point};
use rayon::prelude::*;

/// The numbers of vertices of a mesh with an infinite or NaN coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NonFiniteCounts {
    /// In the file.
    pub in_object_space: usize,
    /// In the world, where large numbers or a broken matrix may add some.
    pub in_world_space: usize,
}

impl NonFiniteCounts {
    /// Counts the vertices that [`Geometry::add_mesh`](super::Geometry::add_mesh) would count.
    pub fn of(vertices: &[Point], world_from_object: &Matrix) -> NonFiniteCounts {
        let count =
            |vertex: &Point| NonFiniteCounts::between(vertex, &world_from_object.apply(*vertex));
        vertices
            .par_iter()
            .map(count)
            .reduce(NonFiniteCounts::default, NonFiniteCounts::plus)
    }

    fn between(in_object_space: &Point, in_world_space: &Point) -> NonFiniteCounts {
        let count = |vertex: &Point| usize::from(!vertex.is_finite());
        NonFiniteCounts {
            in_object_space: count(in_object_space),
            in_world_space: count(in_world_space),
        }
    }

    fn plus(self, other: NonFiniteCounts) -> NonFiniteCounts {
        NonFiniteCounts {
            in_object_space: self.in_object_space + other.in_object_space,
            in_world_space: self.in_world_space + other.in_world_space,
        }
    }
}

/// Moves `vertices` to world space, and counts them in the same pass.
pub(super) fn move_to_world(vertices: &mut [Point], world_from_object: &Matrix) -> NonFiniteCounts {
    let moved = vertices.par_iter_mut().map(|vertex| {
        let in_object_space = std::mem::replace(vertex, world_from_object.apply(*vertex));
        NonFiniteCounts::between(&in_object_space, vertex)
    });
    moved.reduce(NonFiniteCounts::default, NonFiniteCounts::plus)
}
